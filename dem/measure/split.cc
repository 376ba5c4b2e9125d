#include "dem/measure/split.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace platen::dem {
namespace {

constexpr std::size_t first_bonds = 20;

double mean_of_x(const Particles &p, const std::vector<int> &rows) {
  double sum = 0;
  for (const int i : rows)
    sum += p.position[static_cast<std::size_t>(i)].x - p.reference_position[static_cast<std::size_t>(i)].x;
  return sum / static_cast<double>(rows.size()); // NaN of none
}

} // namespace

DiscOpening::DiscOpening(const Particles &p, const Shape &shape) {
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Vector3 &x = p.reference_position[i];
    if (std::abs(x.z - 0.5 * shape.height) > 0.25 * shape.radius) continue;
    if (x.x > 0.7 * shape.radius) right_.push_back(static_cast<int>(i));
    if (x.x < -0.7 * shape.radius) left_.push_back(static_cast<int>(i));
  }
}

double DiscOpening::operator()(const Particles &p) const {
  return mean_of_x(p, right_) - mean_of_x(p, left_);
}

SplitPattern split_pattern(const Particles &p, const Bonds &b, const Shape &shape) {
  std::vector<std::size_t> broken;
  for (std::size_t k = 0; k < b.initial_count(); ++k)
    if (b.state[k] >= static_cast<int>(BondState::broken_in_tension)) broken.push_back(k);
  std::stable_sort(broken.begin(), broken.end(), [&](std::size_t one, std::size_t other) {
    return b.break_time[one] < b.break_time[other];
  });
  double on = 0, middle = 0, first = 0;
  for (std::size_t n = 0; n < broken.size(); ++n) {
    const std::size_t k = broken[n];
    const Vector3 x = 0.5 * (p.reference_position[static_cast<std::size_t>(b.record_first[k])] +
                             p.reference_position[static_cast<std::size_t>(b.record_second[k])]);
    if (std::abs(x.x) > 0.25 * shape.radius) continue;
    on += 1;
    if (std::abs(x.z - 0.5 * shape.height) > 0.5 * shape.radius) continue;
    middle += 1;
    if (n < first_bonds) first += 1;
  }
  const double all = static_cast<double>(broken.size());
  return {on / all, middle / all, first / std::min(all, static_cast<double>(first_bonds))};
}

} // namespace platen::dem
