#include <cmath>

#include "dem/bonds.h"

namespace platen::dem {
namespace {

constexpr double pi = 3.14159265358979323846;

double reduced(double a, double b) {
  return a * b / (a + b);
}

} // namespace

void Bonds::add_dashpots(const Particles &p, double alpha) {
  const double ratio = law.parameters.stiffness_ratio;
  dashpot_shear_ratio = std::sqrt(ratio);
  dashpot_twist_ratio = std::sqrt(2 * ratio);
  dashpot = &table.add<double>("dashpot", "N s/m");
  dashpot_force = &table.add<Vector3>("dashpot_force", "N");
  if (p.has_rotation() && law.parameters.moments) {
    dashpot_bending = &table.add<double>("dashpot_bending", "N m s");
    dashpot_moment = &table.add<Vector3>("dashpot_moment", "N m");
  }
  for (std::size_t k = 0; k < size(); ++k) {
    const std::size_t i = static_cast<std::size_t>(first[k]), j = static_cast<std::size_t>(second[k]);
    const double square = bond_radius[k] * bond_radius[k], axial = normal_stiffness[k] * pi * square;
    (*dashpot)[k] = 2 * alpha * std::sqrt(axial * reduced(p.mass[i], p.mass[j]));
    if (dashpot_bending != nullptr)
      (*dashpot_bending)[k] =
          2 * alpha * std::sqrt(0.25 * square * axial * reduced((*p.inertia)[i], (*p.inertia)[j]));
  }
}

} // namespace platen::dem
