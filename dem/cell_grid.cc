#include "dem/cell_grid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "base/parallel.h"
#include "base/rows.h"
#include "dem/particles.h"

namespace platen::dem {
namespace {

// Spheres whose reach (radius and half the margin) is within a factor of two of each other share a grid:
// every larger one searches the grids of smaller ones, never the other way round. Reaches below the
// smallest class are in it too.
constexpr int most_classes = 24;
constexpr double cell_slack = 1e-6; // cells; far above the round-off of a place in them

// Cells of one edge length over the bounding box of some spheres, capped in number so that a lost particle
// cannot exhaust memory.
struct Grid {
  double largest = 0; // m, radius
  Vector3 low;
  double inverse_edge = 1;
  std::array<int, 3> cells{1, 1, 1};
  std::vector<int> start, member; // members of cell c: member[start[c] .. start[c + 1]), ascending

  Grid(const Vector3 *centres, const double *radii, const std::vector<int> &spheres, double margin) {
    Vector3 high = low = centres[spheres[0]], zero;
    for (const int i : spheres) {
      largest = std::max(largest, radii[i]);
      for (int k = 0; k < 3; ++k) {
        low[k] = std::min(low[k], centres[i][k]);
        high[k] = std::max(high[k], centres[i][k]);
        zero[k] += 0 * centres[i][k];
      }
    }
    // No cell holds such a centre, and no edge is long enough for an infinite box.
    if (!(norm_squared(zero) == 0 && std::isfinite(norm_squared(high - low))))
      throw NotFinite("the place of a sphere is not finite");
    const double most = std::min(4.0 * static_cast<double>(spheres.size()) + 64.0,
                                 static_cast<double>(most_rows)); // of the numbers of cells
    double edge = 2 * largest + std::max(margin, 0.0);
    if (!(edge > 0)) edge = 1; // points
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
    std::vector<int> cell(spheres.size());
    for (std::size_t s = 0; s < spheres.size(); ++s) {
      cell[s] = index(range(centres[spheres[s]], 0).from);
      ++start[cell[s] + 1];
    }
    std::partial_sum(start.begin(), start.end(), start.begin());
    member.resize(spheres.size());
    std::vector<int> next(start.begin(), start.end() - 1);
    for (std::size_t s = 0; s < spheres.size(); ++s)
      member[next[cell[s]]++] = spheres[s];
  }

  // Cells within `reach` (m) of a place.
  struct Range {
    std::array<int, 3> from, to;
  };
  Range range(const Vector3 &x, double reach) const {
    Range r;
    for (int k = 0; k < 3; ++k) {
      const double last = cells[k] - 1, at = (x[k] - low[k]) * inverse_edge;
      const double span = reach > 0 ? reach * inverse_edge + cell_slack : 0.0;
      r.from[k] = static_cast<int>(std::clamp(std::floor(at - span), 0.0, last));
      r.to[k] = static_cast<int>(std::clamp(std::floor(at + span), 0.0, last));
    }
    return r;
  }
  int index(const std::array<int, 3> &c) const { return (c[2] * cells[1] + c[1]) * cells[0] + c[0]; }
};

// Class of each sphere, 0 the largest.
std::vector<int> size_classes(const double *radii, std::size_t count, double margin) {
  const double half = 0.5 * std::max(margin, 0.0), largest = *std::max_element(radii, radii + count) + half;
  std::vector<int> of(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double reach = radii[i] + half;
    of[i] = reach > 0 ? std::min(std::ilogb(largest / reach), most_classes - 1) : most_classes - 1;
  }
  return of;
}

} // namespace

std::vector<IndexPair> near_pairs(const Vector3 *centres, const double *radii, std::size_t count,
                                  double margin, std::size_t *measured, const BlockList *listed) {
  if (measured != nullptr) *measured = 0;
  if (count < 2) return {};
  require_rows(count);
  const std::vector<int> class_of = size_classes(radii, count, margin);
  std::vector<std::vector<int>> spheres(most_classes);
  for (std::size_t i = 0; i < count; ++i)
    spheres[class_of[i]].push_back(static_cast<int>(i));
  std::vector<Grid> grids; // of the classes that there are
  std::vector<std::size_t> grid_of(most_classes, 0);
  for (std::size_t c = 0; c < spheres.size(); ++c) {
    grid_of[c] = grids.size();
    if (!spheres[c].empty()) grids.emplace_back(centres, radii, spheres[c], margin);
  }
  std::vector<std::vector<IndexPair>> found(number_of_blocks(count));
  std::vector<std::size_t> checked(found.size(), 0);
  // In one grid a pair is found by its first sphere; in several by its larger one.
  const BlockList *searched = grids.size() == 1 ? listed : nullptr;
  for_listed_blocks(searched, count, [&](std::size_t first, std::size_t last, std::size_t block) {
    std::vector<int> partners;
    for (std::size_t i = first; i < last; ++i) {
      partners.clear();
      const std::size_t own = grid_of[class_of[i]];
      for (std::size_t g = own; g < grids.size(); ++g) {
        const Grid &grid = grids[g];
        const Grid::Range near = grid.range(centres[i], radii[i] + grid.largest + margin);
        for (int z = near.from[2]; z <= near.to[2]; ++z)
          for (int y = near.from[1]; y <= near.to[1]; ++y)
            for (int c = grid.index({near.from[0], y, z}); c <= grid.index({near.to[0], y, z}); ++c)
              for (int m = grid.start[c]; m < grid.start[c + 1]; ++m) {
                const int j = grid.member[m];
                if (g == own && j <= static_cast<int>(i)) continue;
                ++checked[block];
                const double reach = radii[i] + radii[j] + margin;
                if (reach > 0 && norm_squared(centres[j] - centres[i]) < reach * reach) partners.push_back(j);
              }
      }
      std::sort(partners.begin(), partners.end());
      for (const int j : partners)
        found[block].push_back({std::min(static_cast<int>(i), j), std::max(static_cast<int>(i), j)});
    }
  });
  std::vector<IndexPair> pairs;
  require_rows(std::accumulate(found.begin(), found.end(), std::size_t{0},
                               [](std::size_t sum, const auto &f) { return sum + f.size(); }));
  for (const auto &f : found)
    pairs.insert(pairs.end(), f.begin(), f.end());
  if (grids.size() > 1) std::sort(pairs.begin(), pairs.end());
  if (listed != nullptr && searched == nullptr) {
    std::vector<char> marked(number_of_blocks(count), 0);
    for (const int block : *listed)
      marked[static_cast<std::size_t>(block)] = 1;
    const auto elsewhere = [&](const IndexPair &p) {
      return !marked[static_cast<std::size_t>(p.first) / block_rows];
    };
    pairs.erase(std::remove_if(pairs.begin(), pairs.end(), elsewhere), pairs.end());
  }
  if (measured != nullptr) *measured = std::accumulate(checked.begin(), checked.end(), std::size_t{0});
  return pairs;
}

} // namespace platen::dem
