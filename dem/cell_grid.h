// Pairs of spheres closer than a margin, by a hash of cells.
#pragma once

#include <vector>

#include "base/parallel.h"
#include "base/vector3.h"

namespace platen::dem {

struct IndexPair {
  int first, second; // first < second
};
inline bool operator<(const IndexPair &a, const IndexPair &b) {
  return a.first != b.first ? a.first < b.first : a.second < b.second;
}
inline bool operator==(const IndexPair &a, const IndexPair &b) {
  return a.first == b.first && a.second == b.second;
}

// All pairs with |x_j - x_i| < R_i + R_j + margin, sorted by (first, second). Cost grows with n + pairs, for
// any radii and any distances between spheres. Throws NotFinite if a centre is not finite. `measured`, if
// given, receives the number of pairs whose distance was checked. With a list of blocks: only pairs whose
// first sphere lies in them.
std::vector<IndexPair> near_pairs(const Vector3 *centres, const double *radii, std::size_t count,
                                  double margin, std::size_t *measured = nullptr,
                                  const BlockList *listed = nullptr);

} // namespace platen::dem

template <>
struct platen::NumbersOf<platen::dem::IndexPair> {
  using Number = int;
};
