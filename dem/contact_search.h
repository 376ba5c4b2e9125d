// Which unbonded pairs may touch. Two lists: all near pairs, rebuilt rarely through a grid; and the few of
// them that can touch soon, rebuilt from the first. In an intact specimen the second is almost empty.
#pragma once

#include <vector>

#include "base/archive.h"
#include "dem/bonds.h"
#include "dem/cell_grid.h"
#include "dem/particles.h"

namespace platen::dem {

class ContactSearch {
public:
  // skins in m: margins of the wide and the close list.
  ContactSearch(double wide_skin, double close_skin) : wide_skin_(wide_skin), close_skin_(close_skin) {}

  // No particle has moved by more than `distance` (m) since the last call.
  void moved(double distance);
  // Brings the lists up to date; true where close_pairs() changed. `bonds` may be null.
  bool update(const Particles &particles, const Bonds *bonds);
  // A pair that was bonded and is no longer.
  void add_pair(IndexPair pair);
  // Distance at which a pair starts to touch, where it is less than R_i + R_j (m).
  void set_rest_distance(IndexPair pair, double distance);
  double rest_distance(IndexPair pair, const Particles &particles) const;

  const std::vector<IndexPair> &close_pairs() const { return close_; }
  std::size_t bytes() const;

  // Everything that decides when lists are rebuilt and what they hold, so that sums over rows are grouped as
  // they would have been without a stop.
  void describe(Archive &archive);

private:
  struct RestDistance {
    IndexPair pair;
    double distance; // m
  };
  void rebuild_wide(const Particles &particles, const Bonds *bonds);
  void rebuild_close(const Particles &particles);

  double wide_skin_, close_skin_;
  double moved_since_wide_ = 0, moved_since_close_ = 0; // m
  bool wide_valid_ = false, close_valid_ = false;
  std::vector<IndexPair> wide_, close_;
  std::vector<RestDistance> rest_; // pairs with a rest distance of their own, sorted
};

} // namespace platen::dem
