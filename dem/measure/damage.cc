#include "dem/measure/damage.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace platen::dem {
namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

double half_width(const Shape &shape) {
  return shape.kind == ShapeKind::cylinder ? shape.radius : 0.5 * std::min(shape.width_x, shape.width_y);
}

// Distance from the axis: of the circle, or of the square for a box, through x.
double from_axis(const Vector3 &x, const Shape &shape) {
  if (shape.kind == ShapeKind::cylinder) return std::hypot(x.x, x.y);
  return std::max(std::abs(x.x), std::abs(x.y));
}

Vector3 outward(const Vector3 &x, const Shape &shape) {
  if (shape.kind == ShapeKind::cylinder) {
    const double r = std::hypot(x.x, x.y);
    return r > 0 ? Vector3{x.x / r, x.y / r, 0} : Vector3{};
  }
  return std::abs(x.x) >= std::abs(x.y) ? Vector3{std::copysign(1.0, x.x), 0, 0}
                                        : Vector3{0, std::copysign(1.0, x.y), 0};
}

struct Mean {
  double all = 0, sum = 0;
  void add(double value) { all += 1, sum += value; }
  double value() const { return all == 0 ? not_a_number : sum / all; }
};

constexpr std::size_t first_bonds = 20;

} // namespace

bool is_broken(int state) {
  return state >= static_cast<int>(BondState::broken_in_tension);
}

Vector3 reference_midpoint(const Particles &p, const Bonds &b, std::size_t record) {
  return 0.5 * (p.reference_position[b.record_first[record]] + p.reference_position[b.record_second[record]]);
}

std::vector<double> bond_losses(const Bonds &b) {
  std::vector<double> losses(b.initial_count());
  for (std::size_t k = 0; k < losses.size(); ++k)
    losses[k] = is_broken(b.state[k]);
  if (damaged_rows_separate(b.law))
    for (std::size_t k = 0; k < b.size(); ++k)
      losses[static_cast<std::size_t>(b.record[k])] = b.damage(k);
  return losses;
}

DamageByRegion damage_by_region(const Particles &p, const Bonds &b, const Shape &shape,
                                const std::vector<double> &losses) {
  const double rc = half_width(shape), h = shape.height;
  Mean top, bottom, middle;
  for (std::size_t k = 0; k < b.initial_count(); ++k) {
    const Vector3 m = reference_midpoint(p, b, k);
    if (from_axis(m, shape) >= 0.5 * rc) continue;
    if (m.z < 0.5 * rc) bottom.add(losses[k]);
    if (m.z > h - 0.5 * rc) top.add(losses[k]);
    if (std::abs(m.z - 0.5 * h) < 0.25 * rc) middle.add(losses[k]);
  }
  return {top.value(), bottom.value(), middle.value()};
}

std::vector<double> skin_opening(const std::vector<Vector3> &centre, const std::vector<Vector3> &displacement,
                                 const Shape &shape, const std::vector<char> &counted) {
  std::vector<double> sum(10, 0.0), n(10, 0.0);
  for (std::size_t i = 0; i < centre.size(); ++i) {
    const Vector3 &x = centre[i];
    if ((!counted.empty() && !counted[i]) || from_axis(x, shape) <= 0.8 * half_width(shape)) continue;
    const std::size_t slice =
        static_cast<std::size_t>(std::clamp(static_cast<int>(10 * x.z / shape.height), 0, 9));
    sum[slice] += dot(displacement[i], outward(x, shape));
    n[slice] += 1;
  }
  for (std::size_t s = 0; s < 10; ++s)
    sum[s] = n[s] > 0 ? sum[s] / n[s] : not_a_number;
  return sum;
}

std::vector<double> skin_opening(const Particles &p, const Bonds &b, const Shape &shape) {
  const BondCounts counts = bond_counts(p, b);
  const std::vector<Vector3> centre(p.reference_position.begin(), p.reference_position.end());
  std::vector<Vector3> displacement(p.size());
  std::vector<char> bonded(p.size());
  for (std::size_t i = 0; i < p.size(); ++i) {
    displacement[i] = p.position[i] - centre[i];
    bonded[i] = counts.intact[i] > 0;
  }
  return skin_opening(centre, displacement, shape, bonded);
}

double end_spread(const std::vector<double> &opening) {
  double largest = -std::numeric_limits<double>::infinity();
  for (const double o : opening)
    largest = std::fmax(largest, o); // of slices that have a skin
  const double ends = std::fmax(opening.front(), opening.back());
  return largest > 0 ? ends / largest : not_a_number;
}

double barrel(const std::vector<double> &opening) {
  const double middle = 0.5 * (opening[4] + opening[5]);
  return std::isgreater(middle, 0.0) ? 0.5 * (opening.front() + opening.back()) / middle : not_a_number;
}

BondCounts bond_counts(const Particles &p, const Bonds &b) {
  BondCounts counts;
  counts.intact.assign(p.size(), 0);
  counts.broken = counts.intact;
  for (std::size_t k = 0; k < b.initial_count(); ++k) {
    std::vector<int> &column = is_broken(b.state[k]) ? counts.broken : counts.intact;
    ++column[b.record_first[k]];
    ++column[b.record_second[k]];
  }
  return counts;
}

SplitPattern split_pattern(const Particles &p, const Bonds &b, const Shape &shape) {
  std::vector<std::size_t> broken;
  for (std::size_t k = 0; k < b.initial_count(); ++k)
    if (is_broken(b.state[k])) broken.push_back(k);
  std::stable_sort(broken.begin(), broken.end(), [&](std::size_t one, std::size_t other) {
    return b.break_time[one] < b.break_time[other];
  });
  double on = 0, middle = 0, first = 0;
  for (std::size_t n = 0; n < broken.size(); ++n) {
    const std::size_t k = broken[n];
    const Vector3 x = reference_midpoint(p, b, k);
    if (std::abs(x.x) > 0.25 * shape.radius) continue;
    on += 1;
    if (std::abs(x.z - 0.5 * shape.height) > 0.5 * shape.radius) continue;
    middle += 1;
    if (n < first_bonds) first += 1;
  }
  const double all = static_cast<double>(broken.size());
  return {on / all, middle / all, first / std::min(all, static_cast<double>(first_bonds))};
}

double broken_near_midspan(const Particles &p, const Bonds &b, double depth) {
  Mean near;
  for (std::size_t k = 0; k < b.initial_count(); ++k)
    if (is_broken(b.state[k])) near.add(std::abs(reference_midpoint(p, b, k).x) <= 0.5 * depth);
  return near.value();
}

} // namespace platen::dem
