#include "dem/measure/circumference.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "dem/measure/gauge.h"

namespace platen::dem {
namespace {

// Largest value of a sphere, in medians.
constexpr double most_of_median = 3;

struct FromAxis {
  double distance = 0, depth = 0; // m, of a centre: from the axis or middle plane; below the surface
  Vector3 outward{};
};

FromAxis from_axis(const Shape &shape, const Vector3 &x) {
  if (shape.kind != ShapeKind::box) {
    const double r = std::hypot(x.x, x.y);
    return {r, shape.radius - r, r > 0 ? Vector3{x.x / r, x.y / r, 0} : Vector3{}};
  }
  const double of_x = 0.5 * shape.width_x - std::abs(x.x), of_y = 0.5 * shape.width_y - std::abs(x.y);
  if (of_x < of_y) return {std::abs(x.x), of_x, {std::copysign(1.0, x.x), 0, 0}};
  return {std::abs(x.y), of_y, {0, std::copysign(1.0, x.y), 0}};
}

} // namespace

Circumference::Circumference(const Particles &p, const Shape &shape, const Bonds *bonds) {
  const std::vector<char> bonded = ever_bonded(p, bonds);
  double sum = 0;
  for (const double r : p.radius)
    sum += r;
  const double deepest = 2 * sum / static_cast<double>(std::max<std::size_t>(p.size(), 1));
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Vector3 &x = p.reference_position[i];
    if (!bonded[i] || std::abs(x.z - 0.5 * shape.height) > 0.25 * shape.height) continue;
    const FromAxis at = from_axis(shape, x);
    if (at.depth > deepest || !(at.distance > 0)) continue;
    rows_.push_back(static_cast<int>(i));
    outward_.push_back(1 / at.distance * at.outward);
  }
}

double Circumference::strain(const Particles &p) const {
  if (rows_.empty()) return std::numeric_limits<double>::quiet_NaN();
  strains_.resize(rows_.size());
  for (std::size_t k = 0; k < rows_.size(); ++k)
    strains_[k] = dot(p.position[rows_[k]] - p.reference_position[rows_[k]], outward_[k]);
  const auto middle = strains_.begin() + static_cast<std::ptrdiff_t>(strains_.size() / 2);
  std::nth_element(strains_.begin(), middle, strains_.end());
  const double most = most_of_median * std::abs(*middle);
  double sum = 0;
  for (const double strain : strains_)
    sum += std::clamp(strain, -most, most);
  return sum / static_cast<double>(strains_.size());
}

} // namespace platen::dem
