#include "dem/packing/soft_partners.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/parallel.h"
#include "dem/instruction_set.h"
#include "dem/kernels/near_kernel.h"

namespace platen::dem {
namespace {

using kernels::soft_group;

// Fraction of the extent: more than positions lose in single precision.
constexpr double relative_slack = 1e-6;

// Edge of cells over the largest reach of a ball: most reach far less.
constexpr double cell_edge = 1.25;

// The kernel for this processor; all give the same result.
kernels::FindNear find_near() {
  static const kernels::FindNear best =
      for_set<kernels::FindNear>(best_instruction_set(), kernels::find_near_baseline, kernels::find_near_avx2,
                                 kernels::find_near_avx512);
  return best;
}

// Cells over the box around all balls.
class Cells {
public:
  explicit Cells(const std::vector<SoftBall> &balls) {
    std::array<double, 3> high;
    low_.fill(std::numeric_limits<double>::infinity());
    high.fill(-std::numeric_limits<double>::infinity());
    for (const SoftBall &b : balls) {
      largest_ = std::max(largest_, b.radius + b.reach);
      for (int k = 0; k < 3; ++k)
        low_[k] = std::min(low_[k], b.centre[k]), high[k] = std::max(high[k], b.centre[k]);
    }
    const double most = 4.0 * static_cast<double>(balls.size()) + 64.0;
    double edge = cell_edge * largest_;
    const auto along = [&](int k) { return std::floor((high[k] - low_[k]) / edge) + 1; };
    while (along(0) * along(1) * along(2) > most)
      edge *= 1.26;
    for (int k = 0; k < 3; ++k)
      cells_[k] = static_cast<int>(along(k));
    slack_ = relative_slack * norm(Vector3{high[0] - low_[0], high[1] - low_[1], high[2] - low_[2]});
    per_length_ = 1 / edge;
    fill(balls);
  }

  // Writes the numbers of all balls that this one may touch, without itself, from index `count` on, in the
  // order of cells. Returns the index after them. The space beyond it is spare.
  std::size_t find(const SoftBall &own, int self, std::vector<int> &found, std::size_t count) const {
    const double far = own.radius + own.reach + largest_;
    std::array<int, 3> from, to;
    for (int k = 0; k < 3; ++k)
      from[k] = slot(own.centre[k] - far, k), to[k] = slot(own.centre[k] + far, k);
    kernels::NearBall me = member_of(own, slack_);
    me.ball = self;
    const kernels::NearColumns members{x_.data(), y_.data(), z_.data(), reach_.data(), ball_.data()};
    const kernels::FindNear near = find_near();
    for (int w = from[2]; w <= to[2]; ++w)
      for (int v = from[1]; v <= to[1]; ++v) {
        const int first = start_[index(from[0], v, w)], last = start_[index(to[0], v, w) + 1];
        const std::size_t most = count + static_cast<std::size_t>(last - first) + kernels::near_spare;
        if (found.size() < most) found.resize(2 * most);
        count += near(members, me, first, last, found.data() + count);
      }
    return count;
  }

private:
  void fill(const std::vector<SoftBall> &balls) {
    start_.assign(static_cast<std::size_t>(cells_[0]) * cells_[1] * cells_[2] + 1, 0);
    std::vector<int> cell(balls.size());
    for (std::size_t m = 0; m < balls.size(); ++m) {
      const Vector3 &c = balls[m].centre;
      ++start_[(cell[m] = index(slot(c.x, 0), slot(c.y, 1), slot(c.z, 2))) + 1];
    }
    std::partial_sum(start_.begin(), start_.end(), start_.begin());
    std::vector<int> next(start_.begin(), start_.end() - 1);
    for (std::vector<float> *column : {&x_, &y_, &z_, &reach_})
      column->resize(balls.size() + kernels::near_spare);
    ball_.resize(balls.size() + kernels::near_spare);
    for (std::size_t m = 0; m < balls.size(); ++m) {
      const int to = next[cell[m]]++;
      const kernels::NearBall b = member_of(balls[m], 0);
      x_[to] = b.x, y_[to] = b.y, z_[to] = b.z, reach_[to] = b.reach;
      ball_[to] = static_cast<int>(m);
    }
  }
  // The radius includes the reach.
  kernels::NearBall member_of(const SoftBall &b, double slack) const {
    return {static_cast<float>(b.centre.x - low_[0]), static_cast<float>(b.centre.y - low_[1]),
            static_cast<float>(b.centre.z - low_[2]), static_cast<float>(b.radius + b.reach + slack), 0};
  }
  int slot(double x, int k) const {
    return std::clamp(static_cast<int>((x - low_[k]) * per_length_), 0, cells_[k] - 1);
  }
  int index(int a, int b, int c) const { return (c * cells_[1] + b) * cells_[0] + a; }

  std::array<double, 3> low_;
  double largest_ = 0; // reach of a ball
  double per_length_ = 1;
  double slack_ = 0;
  std::array<int, 3> cells_{{1, 1, 1}};
  std::vector<int> start_;
  std::vector<float> x_, y_, z_, reach_; // of the members of cell c: [start_[c] .. start_[c + 1])
  std::vector<int> ball_;
};

// Work space of one thread for making lists.
struct Found {
  std::vector<int> ball;
  std::array<int, block_rows + soft_group + 1> first;
  std::array<int, block_rows + soft_group> order;

  int count(int row) const { return first[row + 1] - first[row]; }
};

// Sorts the rows of the block, in whole groups, by falling number of partners: groups then have few empty
// lanes.
void sort_rows(Found &found, int rows) {
  int most = 0;
  for (int r = 0; r < rows; ++r)
    most = std::max(most, found.count(r));
  std::vector<int> next(static_cast<std::size_t>(most) + 2, 0); // place of the first row with so many
  for (int r = 0; r < rows; ++r)
    ++next[most - found.count(r) + 1];
  std::partial_sum(next.begin(), next.end(), next.begin());
  for (int r = 0; r < rows; ++r)
    found.order[next[most - found.count(r)]++] = r;
}

// Reserves an eighth more than needed, whereas a plain vector would double its memory.
template <class T>
void resize_column(AlignedVector<T> &column, std::size_t size) {
  if (column.capacity() < size) {
    AlignedVector<T>().swap(column);
    column.reserve(size + size / 8);
  }
  column.resize(size);
}

unsigned offset(int row) {
  return static_cast<unsigned>(row * sizeof(kernels::SoftRow));
}

void write(const std::vector<SoftBall> &balls, int first, int rows, const Found &found, SoftPartners &to) {
  const int lanes = static_cast<int>(soft_group);
  to.row.clear(), to.steps.clear();
  std::size_t steps = 0;
  for (int r = 0; r < rows; ++r) {
    to.row.push_back(first + found.order[r]);
    if (r % lanes == 0) to.steps.push_back(found.count(found.order[r])), steps += to.steps.back();
  }
  resize_column(to.partner, soft_group * steps), resize_column(to.separation, 4 * soft_group * steps);
  unsigned *partner = to.partner.data();
  float *separation = to.separation.data();
  for (int r = 0; r < rows; r += lanes)
    for (int k = 0; k < to.steps[r / lanes]; ++k, partner += lanes, separation += 4 * lanes)
      for (int l = 0; l < lanes; ++l) {
        const int row = found.order[r + l];
        if (k >= found.count(row)) {
          partner[l] = offset(first + row);
          separation[l] = separation[lanes + l] = separation[2 * lanes + l] = 0,
          separation[3 * lanes + l] = kernels::no_partner;
          continue;
        }
        const SoftBall &a = balls[first + row], &b = balls[found.ball[found.first[row] + k]];
        const Vector3 d = b.centre - a.centre;
        const double reach = a.radius + b.radius;
        partner[l] = offset(b.row);
        separation[l] = static_cast<float>(d.x), separation[lanes + l] = static_cast<float>(d.y);
        separation[2 * lanes + l] = static_cast<float>(d.z);
        separation[3 * lanes + l] = static_cast<float>(norm_squared(d) - reach * reach);
      }
}

} // namespace

void find_soft_partners(const std::vector<SoftBall> &balls, std::size_t own,
                        std::vector<SoftPartners> &blocks) {
  const Cells cells(balls);
  blocks.resize(number_of_blocks(own));
  for_each_block(own, [&](std::size_t first, std::size_t last, std::size_t block) {
    Found found;
    const int rows = static_cast<int>(number_of_blocks(last - first, soft_group) * soft_group);
    std::size_t count = 0;
    for (int r = 0; r < rows; ++r) {
      const std::size_t i = first + static_cast<std::size_t>(r);
      found.first[r] = static_cast<int>(count);
      if (i < last) count = cells.find(balls[i], static_cast<int>(i), found.ball, count);
    }
    found.first[rows] = static_cast<int>(count);
    sort_rows(found, rows);
    write(balls, static_cast<int>(first), rows, found, blocks[block]);
  });
}

} // namespace platen::dem
