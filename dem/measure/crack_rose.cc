#include "dem/measure/crack_rose.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/pi.h"

namespace platen::dem {
namespace {

constexpr double right_angle = pi / 2;

} // namespace

void CrackRose::add(const Vector3 &normal, double crack_area) {
  const double angle = std::acos(std::min(1.0, std::abs(normal.z)));
  area[static_cast<std::size_t>(std::min(bins - 1, static_cast<int>(bins * angle / right_angle)))] +=
      crack_area;
}

std::array<double, CrackRose::bins> CrackRose::over_isotropic() const {
  const double all = std::accumulate(area.begin(), area.end(), 0.0);
  std::array<double, bins> rose{};
  for (int k = 0; k < bins; ++k) {
    const double directions = std::cos(right_angle * k / bins) - std::cos(right_angle * (k + 1) / bins);
    rose[static_cast<std::size_t>(k)] = all > 0 ? area[static_cast<std::size_t>(k)] / all / directions
                                                : std::numeric_limits<double>::quiet_NaN();
  }
  return rose;
}

} // namespace platen::dem
