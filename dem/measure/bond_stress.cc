#include "dem/measure/bond_stress.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/pi.h"

namespace platen::dem {
std::vector<DirectionClass> bond_stress_by_direction(const Particles &p, const Bonds &b, int classes) {
  std::vector<DirectionClass> all(static_cast<std::size_t>(classes));
  const double width = 0.5 * pi / classes;
  for (int c = 0; c < classes; ++c)
    all[static_cast<std::size_t>(c)].low = c * width, all[static_cast<std::size_t>(c)].high = (c + 1) * width;
  for (std::size_t k = 0; k < b.size(); ++k) {
    if (b.normal_stiffness[k] == 0.0) continue;
    const Vector3 d =
        p.position[static_cast<std::size_t>(b.second[k])] - p.position[static_cast<std::size_t>(b.first[k])];
    const double angle = std::asin(std::min(1.0, std::abs(d.z) / norm(d)));
    DirectionClass &to = all[std::min(all.size() - 1, static_cast<std::size_t>(angle / width))];
    const double area = pi * b.bond_radius[k] * b.bond_radius[k];
    const double stress = -b.response(k, p).normal_force / area;
    ++to.bonds;
    to.mean += stress;
    if (stress > 0) ++to.pressed, to.mean_pressed += stress;
  }
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  for (DirectionClass &c : all) {
    c.mean = c.bonds > 0 ? c.mean / c.bonds : none;
    c.mean_pressed = c.pressed > 0 ? c.mean_pressed / c.pressed : none;
  }
  return all;
}

} // namespace platen::dem
