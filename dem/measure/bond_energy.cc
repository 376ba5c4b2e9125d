#include "dem/measure/bond_energy.h"

#include "base/parallel.h"

namespace platen::dem {

SmallStrain small_strain(const Particles &p, const Bonds &b, std::size_t row,
                         const std::vector<Vector3> &displacement, const std::vector<Vector3> &turn) {
  const std::size_t i = static_cast<std::size_t>(b.first[row]), j = static_cast<std::size_t>(b.second[row]);
  const Vector3 d = b.reference[row];
  SmallStrain s;
  s.normal = d / norm(d);
  Vector3 u = displacement[j] - displacement[i];
  if (p.has_rotation() && !turn.empty()) {
    u -= cross(turn[j], (1 - b.lever[row]) * d) + cross(turn[i], b.lever[row] * d);
    const Vector3 relative = turn[j] - turn[i];
    s.twist = dot(relative, s.normal);
    s.bend = relative - s.twist * s.normal;
  }
  s.stretch = dot(u, s.normal);
  s.slip = u - s.stretch * s.normal;
  return s;
}

Vector3 small_force(const Bonds &b, std::size_t row, const SmallStrain &s) {
  const BondStiffness k = b.stiffness(row);
  return k.axial * s.stretch * s.normal + k.shear * s.slip;
}

EnergyShares energy_shares(const Particles &p, const Bonds &b, const std::vector<Vector3> &displacement,
                           const std::vector<Vector3> &turn) {
  return ordered_sum<EnergyShares>(b.size(), [&](std::size_t first, std::size_t last) {
    EnergyShares sum;
    for (std::size_t row = first; row < last; ++row) {
      const BondStiffness k = b.stiffness(row);
      const SmallStrain s = small_strain(p, b, row, displacement, turn);
      sum.axial += 0.5 * k.axial * s.stretch * s.stretch;
      sum.bending += 0.5 * (k.shear * norm_squared(s.slip) + k.bending * norm_squared(s.bend));
      sum.torsion += 0.5 * k.twisting * s.twist * s.twist;
    }
    return sum;
  });
}

EnergyShares energy_shares(const Particles &p, const Bonds &b) {
  std::vector<Vector3> displacement(p.size()), turn(p.has_rotation() ? p.size() : 0);
  for (std::size_t i = 0; i < p.size(); ++i) {
    displacement[i] = p.position[i] - p.reference_position[i];
    if (turn.empty()) continue;
    const Quaternion &q = (*p.orientation)[i];
    turn[i] = (q.w < 0 ? -2.0 : 2.0) * vector_part(q);
  }
  return energy_shares(p, b, displacement, turn);
}

} // namespace platen::dem
