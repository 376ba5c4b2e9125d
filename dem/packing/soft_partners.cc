#include "dem/packing/soft_partners.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>

#include "base/parallel.h"

namespace platen::dem {
namespace {

using kernels::Ball;
using kernels::soft_pack;

constexpr std::size_t packs_of_block = block_rows / soft_pack;

// A ball in its cell: where it is, how far it reaches (radius, and the way that it may go), and who it is.
struct Member {
  double x, y, z, reach;
  std::uint64_t
      key; // sorts in the order of forces: by number, an image by its owner's; then the number itself
};

// Cells as wide as the farthest partner is away, over the box around all balls.
class Cells {
public:
  explicit Cells(const SoftBalls &balls) {
    const std::size_t images = balls.all - balls.first_image;
    std::vector<Member> all(balls.own + images);
    double largest = 0;
    std::array<double, 3> high;
    low_.fill(std::numeric_limits<double>::infinity());
    high.fill(-std::numeric_limits<double>::infinity());
    for (std::size_t m = 0; m < all.size(); ++m) {
      const std::size_t i = m < balls.own ? m : balls.first_image + (m - balls.own);
      const std::size_t place = m < balls.own ? m : static_cast<std::size_t>(balls.owner[m - balls.own]);
      const Ball &b = balls.ball[i];
      all[m] = {b.x, b.y, b.z, b.radius + balls.reach[place], std::uint64_t{place} << 32 | i};
      largest = std::max(largest, all[m].reach);
      const double at[3] = {b.x, b.y, b.z};
      for (int k = 0; k < 3; ++k)
        low_[k] = std::min(low_[k], at[k]), high[k] = std::max(high[k], at[k]);
    }
    const double most = 4.0 * static_cast<double>(all.size()) + 64.0;
    double edge = 2 * largest;
    const auto along = [&](int k) { return std::floor((high[k] - low_[k]) / edge) + 1; };
    while (along(0) * along(1) * along(2) > most)
      edge *= 1.26;
    for (int k = 0; k < 3; ++k)
      cells_[k] = static_cast<int>(along(k));
    per_length_ = 1 / edge;
    start_.assign(static_cast<std::size_t>(cells_[0]) * cells_[1] * cells_[2] + 1, 0);
    std::vector<int> cell(all.size());
    for (std::size_t m = 0; m < all.size(); ++m)
      ++start_[(cell[m] = cell_of(all[m])) + 1];
    std::partial_sum(start_.begin(), start_.end(), start_.begin());
    std::vector<int> next(start_.begin(), start_.end() - 1);
    member_.resize(all.size());
    for (std::size_t m = 0; m < all.size(); ++m)
      member_[next[cell[m]]++] = all[m];
  }

  // Keys of all that ball `i` of this reach may touch, sorted; itself left out.
  void find(const Ball &own, double reach, std::size_t i, std::vector<std::uint64_t> &found) const {
    const int x = slot(own.x, 0), y = slot(own.y, 1), z = slot(own.z, 2);
    const int left = std::max(x - 1, 0), right = std::min(x + 1, cells_[0] - 1);
    const std::uint64_t self = std::uint64_t{i} << 32 | i;
    std::size_t count = 0;
    for (int w = std::max(z - 1, 0); w <= std::min(z + 1, cells_[2] - 1); ++w)
      for (int v = std::max(y - 1, 0); v <= std::min(y + 1, cells_[1] - 1); ++v) {
        const int from = start_[index(left, v, w)], to = start_[index(right, v, w) + 1];
        found.resize(count + static_cast<std::size_t>(to - from));
        for (int m = from; m < to; ++m) { // no branch: one in four is near enough
          const Member &b = member_[m];
          const double dx = b.x - own.x, dy = b.y - own.y, dz = b.z - own.z, far = reach + b.reach;
          found[count] = b.key;
          count += (dx * dx + dy * dy + dz * dz < far * far) & (b.key != self) ? 1 : 0;
        }
      }
    found.resize(count);
    std::sort(found.begin(), found.end());
  }

private:
  int slot(double x, int k) const {
    return std::clamp(static_cast<int>((x - low_[k]) * per_length_), 0, cells_[k] - 1);
  }
  int index(int a, int b, int c) const { return (c * cells_[1] + b) * cells_[0] + a; }
  int cell_of(const Member &m) const { return index(slot(m.x, 0), slot(m.y, 1), slot(m.z, 2)); }

  std::array<double, 3> low_;
  double per_length_ = 1;
  std::array<int, 3> cells_{{1, 1, 1}};
  std::vector<int> start_;
  std::vector<Member> member_; // of cell c: member_[start_[c] .. start_[c + 1])
};

} // namespace

void SoftPartners::build(const SoftBalls &balls) {
  const std::size_t packs = number_of_blocks(balls.own, soft_pack);
  const int none = static_cast<int>(balls.first_image) - 1;
  const Cells cells(balls);
  earlier.assign(packs * soft_pack, 0.0);
  first.assign(packs + 1, 0);
  std::vector<std::vector<int>> rows(number_of_blocks(packs, packs_of_block));
  for_each_block(
      packs,
      [&](std::size_t from, std::size_t to, std::size_t block) {
        std::vector<int> &row = rows[block];
        std::array<std::vector<std::uint64_t>, soft_pack> found;
        for (std::size_t p = from; p < to; ++p) {
          std::size_t steps = 0;
          for (std::size_t l = 0; l < soft_pack; ++l) {
            const std::size_t i = soft_pack * p + l;
            found[l].clear();
            if (i < balls.own) cells.find(balls.ball[i], balls.ball[i].radius + balls.reach[i], i, found[l]);
            steps = std::max(steps, found[l].size());
            earlier[i] = static_cast<double>(
                std::lower_bound(found[l].begin(), found[l].end(), std::uint64_t{i} << 32) -
                found[l].begin());
          }
          for (std::size_t k = 0; k < steps; ++k)
            for (const std::vector<std::uint64_t> &lane : found)
              row.push_back(k < lane.size() ? static_cast<int>(lane[k] & 0xffffffffu) : none);
          first[p + 1] = steps * soft_pack;
        }
      },
      packs_of_block);
  std::partial_sum(first.begin(), first.end(), first.begin());
  partner.resize(first.back());
  for_each_block(
      packs,
      [&](std::size_t from, std::size_t, std::size_t block) {
        std::copy(rows[block].begin(), rows[block].end(),
                  partner.begin() + static_cast<std::ptrdiff_t>(first[from]));
      },
      packs_of_block);
}

} // namespace platen::dem
