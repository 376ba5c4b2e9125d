#include "dem/measure/disjoint_sets.h"

#include <algorithm>
#include <numeric>

namespace platen::dem {

DisjointSets::DisjointSets(std::size_t n) : parent_(n) {
  std::iota(parent_.begin(), parent_.end(), 0);
}

int DisjointSets::name(int member) {
  while (parent_[member] != member)
    member = parent_[member] = parent_[parent_[member]];
  return member;
}

void DisjointSets::join(int one, int other) {
  const int a = name(one), b = name(other);
  parent_[std::max(a, b)] = std::min(a, b);
}

std::vector<std::vector<int>> DisjointSets::all(const std::vector<char> &counted) {
  std::vector<std::vector<int>> sets;
  std::vector<int> number(parent_.size());
  for (int i = 0; i < static_cast<int>(parent_.size()); ++i) {
    if (!counted.empty() && !counted[i]) continue;
    const int set = name(i);
    if (set == i) {
      number[i] = static_cast<int>(sets.size());
      sets.emplace_back();
    }
    sets[number[set]].push_back(i);
  }
  return sets;
}

} // namespace platen::dem
