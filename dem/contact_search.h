// Which unbonded pairs may touch. Two lists: all near pairs, rebuilt rarely through a grid; and the few of
// them that can touch soon, rebuilt from the first. In an intact specimen the second is almost empty.
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
  // Whether update() will go through all particles.
  bool wide_due() const;
  // Brings the lists up to date; true where close_pairs() changed. `bonds` may be null. With a list of
  // blocks: of pairs whose first particle lies in them.
  bool update(const Particles &particles, const Bonds *bonds, const BlockList *listed = nullptr);
  // The second list from the first by the places as they are now; nothing before the first update().
  void renew_close(const Particles &particles) {
    if (made()) rebuild_close(particles);
  }
  // A pair that was bonded and is no longer: it is in both lists from now on. Nothing before the first
  // update(), which finds it. Whether the list of close pairs has gained it.
  bool add_pair(IndexPair pair);
  // Distance at which a pair starts to touch, where it is less than R_i + R_j (m).
  void set_rest_distance(IndexPair pair, double distance);
  double rest_distance(IndexPair pair, const Particles &particles) const;

  std::vector<IndexPair> close_pairs() const { return close_.rows(); } // sorted
  std::size_t close_count() const { return close_.size(); }
  bool made() const { return wide_valid_ && close_valid_; }          // by an update()
  std::vector<IndexPair> wide_pairs() const { return wide_.rows(); } // sorted
  std::size_t bytes() const { return wide_.bytes() + close_.bytes() + rest_.bytes(); }
  // By pairs that were added one at a time.
  std::size_t bytes_moved() const { return wide_.bytes_moved() + close_.bytes_moved() + rest_.bytes_moved(); }
  // Drops what does not begin in the blocks that are marked.
  void keep_blocks(const std::vector<char> &marked);
  // visit(rows) for every list, which may change them. Rows are sorted by the pair that they convert to.
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

  // Everything that decides when lists are rebuilt and what they hold, so that sums over rows are grouped as
  // they would have been without a stop.
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
