#include "dem/cell_grid.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "dem/not_finite.h"
#include "dem/parallel.h"

namespace platen::dem {
namespace {

// Cells of one edge length over the bounding box, capped in number so that a lost particle cannot exhaust
// memory.
struct Grid {
  Vector3 low;
  double inverse_edge = 1;
  std::array<int, 3> cells{1, 1, 1};
  std::vector<int> start, member; // members of cell c: member[start[c] .. start[c + 1]), ascending

  Grid(const Vector3 *centres, std::size_t count, double edge) {
    Vector3 high = low = centres[0], zero;
    for (std::size_t i = 0; i < count; ++i)
      for (int k = 0; k < 3; ++k) {
        low[k] = std::min(low[k], centres[i][k]);
        high[k] = std::max(high[k], centres[i][k]);
        zero[k] += 0 * centres[i][k];
      }
    // No cell holds such a centre, and no edge is long enough for an infinite box.
    if (!(norm_squared(zero) == 0 && std::isfinite(norm_squared(high - low))))
      throw NotFinite("the place of a sphere is not finite");
    const double most = 4.0 * static_cast<double>(count) + 64.0;
    for (;; edge *= 1.26) {
      double product = 1;
      for (int k = 0; k < 3; ++k)
        product *= std::floor((high[k] - low[k]) / edge) + 1;
      if (product <= most) break;
    }
    inverse_edge = 1.0 / edge;
    for (int k = 0; k < 3; ++k)
      cells[k] = static_cast<int>((high[k] - low[k]) * inverse_edge) + 1;
    start.assign(static_cast<std::size_t>(cells[0]) * cells[1] * cells[2] + 1, 0);
    std::vector<int> cell(count);
    for (std::size_t i = 0; i < count; ++i) {
      cell[i] = index(of(centres[i]));
      ++start[cell[i] + 1];
    }
    for (std::size_t c = 1; c < start.size(); ++c)
      start[c] += start[c - 1];
    member.resize(count);
    std::vector<int> next(start.begin(), start.end() - 1);
    for (std::size_t i = 0; i < count; ++i)
      member[next[cell[i]]++] = static_cast<int>(i);
  }

  std::array<int, 3> of(const Vector3 &x) const {
    std::array<int, 3> c;
    for (int k = 0; k < 3; ++k)
      c[k] = std::clamp(static_cast<int>((x[k] - low[k]) * inverse_edge), 0, cells[k] - 1);
    return c;
  }
  int index(const std::array<int, 3> &c) const { return (c[2] * cells[1] + c[1]) * cells[0] + c[0]; }
};

} // namespace

std::vector<IndexPair> near_pairs(const Vector3 *centres, const double *radii, std::size_t count,
                                  double margin) {
  if (count < 2) return {};
  const double largest = *std::max_element(radii, radii + count);
  const Grid grid(centres, count, 2 * largest + std::max(margin, 0.0));
  std::vector<std::vector<IndexPair>> found(number_of_blocks(count));
  for_each_block(count, [&](std::size_t first, std::size_t last, std::size_t block) {
    std::vector<int> partners;
    for (std::size_t i = first; i < last; ++i) {
      partners.clear();
      const std::array<int, 3> home = grid.of(centres[i]);
      for (int z = std::max(home[2] - 1, 0); z <= std::min(home[2] + 1, grid.cells[2] - 1); ++z)
        for (int y = std::max(home[1] - 1, 0); y <= std::min(home[1] + 1, grid.cells[1] - 1); ++y)
          for (int x = std::max(home[0] - 1, 0); x <= std::min(home[0] + 1, grid.cells[0] - 1); ++x) {
            const int c = grid.index({x, y, z});
            for (int m = grid.start[c]; m < grid.start[c + 1]; ++m) {
              const int j = grid.member[m];
              if (j <= static_cast<int>(i)) continue;
              const double reach = radii[i] + radii[j] + margin;
              if (reach > 0 && norm_squared(centres[j] - centres[i]) < reach * reach) partners.push_back(j);
            }
          }
      std::sort(partners.begin(), partners.end());
      for (const int j : partners)
        found[block].push_back({static_cast<int>(i), j});
    }
  });
  std::vector<IndexPair> pairs;
  for (const auto &f : found)
    pairs.insert(pairs.end(), f.begin(), f.end());
  return pairs;
}

} // namespace platen::dem
