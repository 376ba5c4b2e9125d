// Points in cubic cells, for the generation and the check of sphere packings: points may be added one at a
// time. (The running model has its own search, dem/cell_grid.h, built at once from sorted columns.)
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "base/vector3.h"

namespace platen::dem {

class PointGrid {
public:
  // Cells of at least the given edge (m) over the box [low, high]; points outside fall into the outermost
  // cells. There are never more than about max_cells of them, so that a few points in a large box stay cheap.
  PointGrid(const Vector3 &low, const Vector3 &high, double edge,
            std::size_t max_cells = std::size_t{1} << 24)
      : low_(low) {
    const Vector3 extent = high - low;
    while (cells_along(extent.x, edge) * cells_along(extent.y, edge) * cells_along(extent.z, edge) >
           static_cast<double>(max_cells))
      edge *= 1.26; // about half the number of cells
    for (int k = 0; k < 3; ++k) {
      n_[k] = static_cast<int>(cells_along(extent[k], edge));
      const double length = std::max(extent[k] / n_[k], edge);
      per_length_[k] = 1.0 / length;
    }
    head_.assign(static_cast<std::size_t>(n_[0]) * n_[1] * n_[2], -1);
  }

  // The points are numbered 0, 1, 2 ... in the order they are added.
  void add(const Vector3 &p) {
    const std::size_t cell = cell_of(p);
    next_.push_back(head_[cell]);
    head_[cell] = static_cast<int>(next_.size()) - 1;
  }

  // Calls visit(number) for every point in the cells that overlap the cube of half-edge reach (m) around p,
  // always in the same order. The caller tests the distance.
  template <class Visit>
  void for_each_near(const Vector3 &p, double reach, const Visit &visit) const {
    int first[3], last[3];
    for (int k = 0; k < 3; ++k)
      first[k] = slot(p[k] - reach, k), last[k] = slot(p[k] + reach, k);
    for (int c = first[2]; c <= last[2]; ++c)
      for (int b = first[1]; b <= last[1]; ++b)
        for (int a = first[0]; a <= last[0]; ++a)
          for (int i = head_[index(a, b, c)]; i >= 0; i = next_[i])
            visit(i);
  }
  std::size_t cell_of(const Vector3 &p) const { return index(slot(p.x, 0), slot(p.y, 1), slot(p.z, 2)); }

private:
  static double cells_along(double extent, double edge) {
    return extent > edge ? std::min(static_cast<double>(static_cast<long>(extent / edge)), 1e6) : 1.0;
  }
  int slot(double x, int k) const {
    const double s = (x - low_[k]) * per_length_[k];
    return s <= 0 ? 0 : (s >= n_[k] ? n_[k] - 1 : static_cast<int>(s));
  }
  std::size_t index(int a, int b, int c) const {
    return (static_cast<std::size_t>(c) * n_[1] + b) * n_[0] + a;
  }

  Vector3 low_;
  int n_[3];
  double per_length_[3];
  std::vector<int> head_, next_;
};

} // namespace platen::dem
