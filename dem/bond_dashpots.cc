#include <cmath>

#include "dem/bonds.h"
#include "dem/parallel.h"

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
  if (torque_first != nullptr) {
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

// A row that has just broken exerts nothing and books the half of its last force that is still open.
double add_bond_dashpots(const Particles &p, Bonds &b, double dt) {
  const bool turning = p.has_rotation();
  const double shear = b.dashpot_shear_ratio, twist = b.dashpot_twist_ratio;
  return ordered_sum<double>(b.size(), [&](std::size_t first, std::size_t last) {
    double work = 0;
    for (std::size_t k = first; k < last; ++k) {
      const std::size_t i = static_cast<std::size_t>(b.first[k]), j = static_cast<std::size_t>(b.second[k]);
      const Vector3 d = p.position[j] - p.position[i], ri = b.lever[k] * d, rj = ri - d;
      const double per_square = 1 / norm_squared(d);
      Vector3 v = p.velocity[j] - p.velocity[i];
      if (turning) v += cross((*p.angular_velocity)[j], rj) - cross((*p.angular_velocity)[i], ri);
      const Vector3 along = (dot(v, d) * per_square) * d;
      const Vector3 force = (*b.dashpot)[k] * (along + shear * (v - along));
      b.force[k] += force;
      work += dot(force + (*b.dashpot_force)[k], v);
      (*b.dashpot_force)[k] = force;
      if (!turning) continue;
      const Vector3 w = (*p.angular_velocity)[j] - (*p.angular_velocity)[i];
      const Vector3 twisting = (dot(w, d) * per_square) * d;
      const Vector3 moment = (*b.dashpot_bending)[k] * (w - twisting + twist * twisting);
      (*b.torque_first)[k] += cross(ri, force) + moment;
      (*b.torque_second)[k] -= cross(rj, force) + moment;
      work += dot(moment + (*b.dashpot_moment)[k], w);
      (*b.dashpot_moment)[k] = moment;
    }
    return 0.5 * dt * work;
  });
}

} // namespace platen::dem
