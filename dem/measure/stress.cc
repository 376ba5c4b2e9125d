#include "dem/measure/stress.h"

#include "base/pi.h"

namespace platen::dem {
namespace {

void add(std::array<double, 9> &s, const Vector3 &arm, const Vector3 &force) {
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c)
      s[static_cast<std::size_t>(3 * r + c)] += 0.5 * (arm[r] * force[c] + arm[c] * force[r]);
}

} // namespace

std::vector<std::array<double, 9>> particle_stress(const Particles &p, const Bonds *bonds,
                                                   const Contacts *contacts, double packing_fraction) {
  std::vector<std::array<double, 9>> stress(p.size(), std::array<double, 9>{});
  const auto pair = [&](std::size_t i, std::size_t j, const Vector3 &force) {
    const Vector3 d = p.position[j] - p.position[i];
    const double lever = p.radius[i] / (p.radius[i] + p.radius[j]);
    add(stress[i], lever * d, force);
    add(stress[j], (lever - 1) * d, -force);
  };
  if (bonds != nullptr)
    for (std::size_t k = 0; k < bonds->size(); ++k) {
      const Triple<double> force = bonds->response(k, p).force;
      pair(static_cast<std::size_t>(bonds->first[k]), static_cast<std::size_t>(bonds->second[k]),
           {force.x, force.y, force.z});
    }
  if (contacts != nullptr)
    for (std::size_t k = 0; k < contacts->table.size(); ++k)
      if (contacts->touching[k])
        pair(static_cast<std::size_t>(contacts->first[k]), static_cast<std::size_t>(contacts->second[k]),
             contacts->force[k]);
  for (std::size_t i = 0; i < p.size(); ++i) {
    const double r = p.radius[i], volume = 4.0 / 3.0 * pi * r * r * r / packing_fraction;
    for (double &s : stress[i])
      s /= volume;
  }
  return stress;
}

} // namespace platen::dem
