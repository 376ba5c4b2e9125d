// What a bonded network says of itself: the energy of its bonds, by how they are strained, its elastic
// moduli before anything is loaded, and the section of a bar that carries its forces.
#pragma once

#include <array>
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

struct NetworkModuli {
  double young_voigt = 0, poisson_voigt = 0; // affine motion: an upper bound on E; Pa, 1
  double young_reuss = 0, poisson_reuss = 0; // static: an estimate, not a bound
};

// Isotropic network, sum over bonds of l^2 k_n / V = K, k = k_s/k_n: Voigt E = (K/3)(2 + 3k)/(4 + k),
// nu = (1 - k)/(4 + k); Reuss E = (K/3) 5k/(2 + 3k), nu = (1 - k)/(2 + 3k). `volume` of the specimen, m^3.
NetworkModuli network_moduli(const Bonds &bonds, double volume);

// Young's modulus along x, y and z where the network follows strains along the three axes and chooses those
// across for the least energy, Pa: an upper bound of its own modulus in each direction. Of an isotropic
// network Voigt's; of a lattice along its bonds much more than that. 0 without bonds.
std::array<double, 3> affine_moduli(const Bonds &bonds, double volume);

// Mean squares of the distance from the centre of the section, m^2.
struct Gyration {
  double centre_x = 0, centre_y = 0; // m
  double xx = 0, yy = 0;             // of x - centre_x, of y - centre_y
};

// Of the mass of the spheres whose centres lie in low <= z <= high, their own extent included.
Gyration mass_gyration(const Particles &particles, double low, double high);

// Of what carries force along z: bonds with their middle in low <= z <= high, each at its middle with the
// weight that it has in the axial stiffness under a uniform strain, l^2 (K_n n_z^4 + K_s n_z^2 (1 - n_z^2)).
// Forces run between the centres of spheres, so this section ends about a radius inside the surface: the
// "effective section" of Andre et al. 2012, section 6. Zero without bonds there.
Gyration bond_gyration(const Particles &particles, const Bonds &bonds, double low, double high);

} // namespace platen::dem
