#include "dem/measure/bending.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace platen::dem {
namespace {

double mean_sag(const Particles &p, const std::vector<int> &rows) {
  double sum = 0;
  for (const int row : rows) {
    const std::size_t i = static_cast<std::size_t>(row);
    sum += p.reference_position[i].z - p.position[i].z;
  }
  return sum / static_cast<double>(rows.size());
}

} // namespace

Deflection::Deflection(const Particles &p, const Shape &shape, double span) {
  double radii = 0;
  for (std::size_t i = 0; i < p.size(); ++i)
    radii += p.radius[i];
  const double half = std::max(shape.height / 8, 2 * radii / static_cast<double>(p.size()));
  const double beyond = std::min(half, 0.5 * (shape.width_x - span));
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Vector3 &x = p.reference_position[i];
    if (std::abs(x.z - 0.5 * shape.height) > half) continue;
    if (std::abs(x.x) <= half) middle_.push_back(static_cast<int>(i));
    if (std::abs(x.x + 0.5 * span) <= beyond) left_.push_back(static_cast<int>(i));
    if (std::abs(x.x - 0.5 * span) <= beyond) right_.push_back(static_cast<int>(i));
  }
  if (left_.empty() || middle_.empty() || right_.empty())
    throw std::invalid_argument("no sphere lies at half the depth above a support or at mid-span");
}

double Deflection::operator()(const Particles &p) const {
  return mean_sag(p, middle_) - 0.5 * (mean_sag(p, left_) + mean_sag(p, right_));
}

double broken_near_midspan(const Particles &p, const Bonds &b, double depth) {
  double all = 0, near = 0;
  for (std::size_t k = 0; k < b.initial_count(); ++k) {
    if (b.state[k] < static_cast<int>(BondState::broken_in_tension)) continue;
    const double x = 0.5 * (p.reference_position[static_cast<std::size_t>(b.record_first[k])].x +
                            p.reference_position[static_cast<std::size_t>(b.record_second[k])].x);
    all += 1;
    if (std::abs(x) <= 0.5 * depth) near += 1;
  }
  return all > 0 ? near / all : std::numeric_limits<double>::quiet_NaN();
}

} // namespace platen::dem
