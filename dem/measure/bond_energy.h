// What the bonds of a slightly deformed network store, by the way they are strained.
#pragma once

#include <vector>

#include "dem/bonds.h"
#include "dem/particles.h"

namespace platen::dem {

// J. Bending holds the shear springs too: in a beam the two are one, the work of its end moments (Andre et
// al. 2012, section 5.2.1).
struct EnergyShares {
  double axial = 0, bending = 0, torsion = 0;
  double total() const { return axial + bending + torsion; }
  EnergyShares &operator+=(const EnergyShares &b) {
    axial += b.axial, bending += b.bending, torsion += b.torsion;
    return *this;
  }
};

// Strain of one bond for small motion from where it was made: stretch along n and slip across it at its point
// of contact (m), twist along n and bend across it (rad).
struct SmallStrain {
  Vector3 normal; // n, of the bond as it was made
  double stretch = 0, twist = 0;
  Vector3 slip, bend;
};
// `displacement` (m) and `turn` (rad) hold one row per particle; turns may be empty where spheres do not
// turn.
SmallStrain small_strain(const Particles &particles, const Bonds &bonds, std::size_t row,
                         const std::vector<Vector3> &displacement, const std::vector<Vector3> &turn);
// Force on the first particle, N, by the tangent at rest.
Vector3 small_force(const Bonds &bonds, std::size_t row, const SmallStrain &strain);

EnergyShares energy_shares(const Particles &particles, const Bonds &bonds,
                           const std::vector<Vector3> &displacement, const std::vector<Vector3> &turn);
// The same of where the particles are now, their rotations being small.
EnergyShares energy_shares(const Particles &particles, const Bonds &bonds);

} // namespace platen::dem
