// Search for unbonded pairs that may touch. Two lists: all near pairs, rebuilt rarely with a grid; and the
// few of them that can touch soon, rebuilt from the first. In an intact specimen the second is almost empty.
#pragma once

#include <vector>

#include "base/archive.h"
#include "dem/bonds.h"
#include "dem/cell_grid.h"
#include "dem/pair_lists.h"
#include "dem/particles.h"

namespace platen::dem {

class ContactSearch {
public:
  // skins in m: margins of the wide and the close list.
  ContactSearch(double wide_skin, double close_skin) : wide_skin_(wide_skin), close_skin_(close_skin) {}

  // No particle has moved by more than `distance` (m) since the last call.
  void moved(double distance);
  // Whether update() will search all particles.
  bool wide_due() const;
  // Updates the lists; returns true if close_pairs() was rebuilt. `bonds` may be null. With a list of blocks:
  // only pairs whose first particle lies in them.
  bool update(const Particles &particles, const Bonds *bonds, const BlockList *listed = nullptr);
  // Rebuilds the second list from the first at the present positions; does nothing before the first update().
  void renew_close(const Particles &particles) {
    if (made()) rebuild_close(particles);
  }
  // Adds a pair that is no longer bonded to both lists. Does nothing before the first update(), which finds
  // the pair. Returns whether the pair is new in the list of close pairs.
  bool add_pair(IndexPair pair);
  // Distance (m) at which a pair starts to touch, if it is less than R_i + R_j.
  void set_rest_distance(IndexPair pair, double distance);
  double rest_distance(IndexPair pair, const Particles &particles) const;

  std::vector<IndexPair> close_pairs() const { return close_.rows(); } // sorted
  bool made() const { return wide_valid_ && close_valid_; }            // by an update()
  std::vector<IndexPair> wide_pairs() const { return wide_.rows(); }   // sorted
  std::size_t bytes() const { return wide_.bytes() + close_.bytes() + rest_.bytes(); }
  // Bytes moved to insert pairs one at a time.
  std::size_t bytes_moved() const { return wide_.bytes_moved() + close_.bytes_moved() + rest_.bytes_moved(); }
  // Drops pairs whose first particle is not in a marked block.
  void keep_blocks(const std::vector<char> &marked);
  // Calls visit(rows) for every list; visit may change the rows. Rows are sorted by their pair.
  template <class Visit>
  void visit_lists(const Visit &visit) {
    const auto of = [&](auto &list) {
      auto rows = list.rows();
      visit(rows);
      list.assign(rows);
    };
    of(wide_), of(close_), of(rest_);
  }
  struct RestDistance {
    IndexPair pair;
    double distance; // m
    operator IndexPair() const { return pair; }
  };

  // Includes all that decides when lists are rebuilt and what they contain, so that sums over rows are
  // grouped after a restart as without it.
  void describe(Archive &archive);

private:
  void rebuild_wide(const Particles &particles, const Bonds *bonds, const BlockList *listed);
  void rebuild_close(const Particles &particles);

  double wide_skin_, close_skin_;
  double moved_since_wide_ = 0, moved_since_close_ = 0; // m
  bool wide_valid_ = false, close_valid_ = false;
  PairLists<IndexPair> wide_, close_;
  PairLists<RestDistance> rest_; // pairs with a rest distance of their own
};

} // namespace platen::dem
