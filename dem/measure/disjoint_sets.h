// Sets that grow by joining pairs.
#pragma once

#include <cstddef>
#include <vector>

namespace platen::dem {

// Of the members 0 ... n - 1, each a set of its own at first. A set is named by its smallest member, so that
// names do not depend on the order in which pairs are joined.
class DisjointSets {
public:
  explicit DisjointSets(std::size_t n);
  int name(int member);
  void join(int one, int other);
  // Members of each set, ascending; sets by their names. Of those alone that are counted, where that is said:
  // counted and other members must not have been joined.
  std::vector<std::vector<int>> all(const std::vector<char> &counted = {});

private:
  std::vector<int> parent_;
};

} // namespace platen::dem
