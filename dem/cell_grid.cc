#include "dem/cell_grid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>

#include "base/parallel.h"
#include "base/rows.h"
#include "dem/particles.h"

namespace platen::dem {
namespace {

// Spheres whose reach (radius and half the margin) agrees within a factor of two are in one grid: every
// larger sphere searches the grids of smaller ones, never the reverse. The smallest class also contains all
// smaller reaches.
constexpr int most_classes = 24;
constexpr double cell_slack = 1e-6; // cells; far above the round-off of a position near the origin

// Cubic cells of one edge length, found by a hash of their position. Memory and cost depend on the number of
// spheres, not on the space that they span: a sphere that flies away costs nothing.
class HashedCells {
public:
  // `by_larger`: larger spheres, which reach many cells at once, will also search. If cells contain few
  // spheres, the cells are made larger.
  HashedCells(const Vector3 *centres, const double *radii, const std::vector<int> &spheres, double margin,
              bool by_larger) {
    Vector3 zero;
    for (const int i : spheres) {
      largest_ = std::max(largest_, radii[i]);
      for (int k = 0; k < 3; ++k)
        zero[k] += 0 * centres[i][k];
    }
    if (!(norm_squared(zero) == 0)) throw NotFinite("the place of a sphere is not finite");
    const double edge = 2 * largest_ + std::max(margin, 0.0);
    if (edge > smallest_edge) inverse_edge_ = 1.0 / edge; // points: any edge is correct
    std::vector<Cell> cell = cells_of(centres, spheres);
    while (by_larger && keys_in(cell) > 8 + most_keys_a_sphere * static_cast<double>(spheres.size())) {
      inverse_edge_ *= 0.5;
      cell = cells_of(centres, spheres);
    }
    std::size_t buckets = 64;
    while (buckets < 2 * spheres.size())
      buckets *= 2;
    last_bucket_ = buckets - 1;
    start_.assign(buckets + 1, 0);
    for (const Cell &c : cell)
      ++start_[bucket(c) + 1];
    std::partial_sum(start_.begin(), start_.end(), start_.begin());
    members_.resize(spheres.size());
    std::vector<int> next(start_.begin(), start_.end() - 1);
    for (std::size_t s = 0; s < spheres.size(); ++s)
      members_[static_cast<std::size_t>(next[bucket(cell[s])]++)] = {key(cell[s]), spheres[s]};
  }

  double largest() const { return largest_; } // m, radius

  // Calls visit(sphere) for every sphere whose centre may lie within `reach` (m) of x along each axis. Checks
  // the cells there, or all spheres if these are fewer.
  template <class Visit>
  void near(const Vector3 &x, double reach, const Visit &visit) const {
    Cell from, to;
    double cells = 1;
    for (int k = 0; k < 3; ++k) {
      const double at = std::clamp(x[k] * inverse_edge_, -most_slots, most_slots);
      const double span = std::max(reach, 0.0) * inverse_edge_ + cell_slack + round_off * std::abs(at);
      from[k] = slot(at - span);
      to[k] = slot(at + span);
      cells *= static_cast<double>(to[k] - from[k] + 1);
    }
    if (cells > std::min(static_cast<double>(members_.size()) + 27, most_cells)) {
      for (const Member &member : members_)
        visit(member.sphere);
      return;
    }
    for (std::int64_t z = from[2]; z <= to[2]; ++z)
      for (std::int64_t y = from[1]; y <= to[1]; ++y) {
        const std::uint64_t row_key = key({0, y, z}), row_bucket = bucket_of_row(row_key);
        // Runs of cells with consecutive keys and buckets: one run, unless keys or buckets start again.
        for (std::int64_t x0 = from[0]; x0 <= to[0];) {
          const std::uint64_t cut = static_cast<std::uint64_t>(x0) & key_mask, wanted = row_key | cut;
          const std::size_t b = (row_bucket + static_cast<std::uint64_t>(x0)) & last_bucket_;
          const std::uint64_t run = std::min({static_cast<std::uint64_t>(to[0] - x0) + 1, key_mask + 1 - cut,
                                              static_cast<std::uint64_t>(last_bucket_ + 1 - b)});
          for (int m = start_[b], end = start_[b + run]; m < end; ++m)
            if (members_[m].key - wanted < run) visit(members_[m].sphere);
          x0 += static_cast<std::int64_t>(run);
        }
      }
  }

private:
  using Cell = std::array<std::int64_t, 3>;
  struct Member {
    std::uint64_t key;
    int sphere;
  };
  static constexpr double smallest_edge = 1e-300, most_slots = 1e15, round_off = 1e-15;
  static constexpr double most_cells = 1e6; // fewer than keys along an axis, so that no key occurs twice
  static constexpr int key_bits = 21;       // of each axis: cells of one key are two million edges distant
  static constexpr std::uint64_t key_mask = (std::uint64_t{1} << key_bits) - 1;

  static constexpr double most_keys_a_sphere = 0.8;

  std::vector<Cell> cells_of(const Vector3 *centres, const std::vector<int> &spheres) const {
    std::vector<Cell> cell(spheres.size());
    for (std::size_t s = 0; s < spheres.size(); ++s)
      for (int k = 0; k < 3; ++k)
        cell[s][k] = slot(centres[spheres[s]][k] * inverse_edge_);
    return cell;
  }
  static double keys_in(const std::vector<Cell> &cells) {
    std::vector<std::uint64_t> keys;
    for (const Cell &c : cells)
      keys.push_back(key(c));
    std::sort(keys.begin(), keys.end());
    return static_cast<double>(std::unique(keys.begin(), keys.end()) - keys.begin());
  }
  static std::int64_t slot(double at) {
    return static_cast<std::int64_t>(std::floor(std::clamp(at, -most_slots, most_slots)));
  }
  static std::uint64_t key(const Cell &c) {
    std::uint64_t sum = 0;
    for (int k = 0; k < 3; ++k)
      sum |= (static_cast<std::uint64_t>(c[k]) & key_mask) << (k * key_bits);
    return sum;
  }
  // Neighbours along x are neighbours in memory.
  static std::uint64_t bucket_of_row(std::uint64_t row_key) {
    const std::uint64_t mixed = (row_key >> key_bits) * 0x9e3779b97f4a7c15u; // 2^64 over the golden ratio
    return mixed ^ mixed >> 32;
  }
  std::size_t bucket(const Cell &c) const {
    return (bucket_of_row(key({0, c[1], c[2]})) + static_cast<std::uint64_t>(c[0])) & last_bucket_;
  }

  double largest_ = 0, inverse_edge_ = 1;
  std::size_t last_bucket_ = 0;
  std::vector<int> start_; // members of bucket b: members_[start_[b] .. start_[b + 1]), ascending
  std::vector<Member> members_;
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
  std::vector<HashedCells> grids; // of the classes that have spheres
  std::vector<std::size_t> grid_of(most_classes, 0);
  for (std::size_t c = 0; c < spheres.size(); ++c) {
    grid_of[c] = grids.size();
    if (!spheres[c].empty()) grids.emplace_back(centres, radii, spheres[c], margin, !grids.empty());
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
        grids[g].near(centres[i], radii[i] + grids[g].largest() + margin, [&](int j) {
          if (g == own && j <= static_cast<int>(i)) return;
          ++checked[block];
          const double reach = radii[i] + radii[j] + margin;
          if (reach > 0 && norm_squared(centres[j] - centres[i]) < reach * reach) partners.push_back(j);
        });
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
