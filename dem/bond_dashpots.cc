#include <algorithm>
#include <cmath>
#include <limits>

#include "dem/bonds.h"

namespace platen::dem {
namespace {

// Onate's dashpot acts only along the normal, c_n = 2 gamma alpha (r_c/|D|) sqrt(m k_n), with alpha r_c^2 the
// square of the bond's radius (docs/theory.md).
double fraction_of(const Bonds &b, std::size_t k, double smaller_radius, double alpha) {
  if (!bonds_by_range(b.law)) return alpha;
  return alpha * b.bond_radius[k] * b.bond_radius[k] / (smaller_radius * b.rest_length[k]);
}

} // namespace

// If the ratios differ between bonds, the smallest is used, so that no dashpot is above its fraction of
// critical.
void Bonds::add_dashpots(const Particles &p, double alpha) {
  const bool moments = p.has_rotation() && bends(law);
  double shear = std::numeric_limits<double>::infinity(), twist = shear;
  for (std::size_t k = 0; k < size(); ++k) {
    const BondStiffness s = stiffness(k);
    shear = std::min(shear, s.shear / s.axial);
    if (moments) twist = std::min(twist, s.twisting / s.bending);
  }
  dashpot_shear_ratio = std::isfinite(shear) && !bonds_by_range(law) ? std::sqrt(shear) : 0;
  dashpot_twist_ratio = std::isfinite(twist) ? std::sqrt(twist) : 0;
  dashpot = &table.add<double>("dashpot", "N s/m", at_least(0));
  dashpot_force = &table.add<Vector3>("dashpot_force", "N");
  if (moments) {
    dashpot_bending = &table.add<double>("dashpot_bending", "N m s", at_least(0));
    dashpot_moment = &table.add<Vector3>("dashpot_moment", "N m");
  }
  for (std::size_t k = 0; k < size(); ++k) {
    const int i = first[k], j = second[k];
    const BondStiffness s = stiffness(k);
    (*dashpot)[k] = 2 * fraction_of(*this, k, std::min(p.radius[i], p.radius[j]), alpha) *
                    std::sqrt(s.axial * reduced(p.mass[i], p.mass[j]));
    if (moments)
      (*dashpot_bending)[k] = 2 * alpha * std::sqrt(s.bending * reduced((*p.inertia)[i], (*p.inertia)[j]));
  }
  cut_blocks(); // rows hold velocities from now on
}

} // namespace platen::dem
