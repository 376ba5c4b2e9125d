// Properties of a bonded network: the energy of its bonds by kind of strain, its elastic moduli before any
// load, and the section of a bar that carries its forces.
#pragma once

#include <array>
#include <vector>

#include "dem/bonds.h"
#include "dem/particles.h"

namespace platen::dem {

// J. Bending includes the shear springs: in a beam the two are one, the work of its end moments (Andre et al.
// 2012, section 5.2.1).
struct BondEnergies {
  double axial = 0, bending = 0, torsion = 0;
  double total() const { return axial + bending + torsion; }
  BondEnergies &operator+=(const BondEnergies &b) {
    axial += b.axial, bending += b.bending, torsion += b.torsion;
    return *this;
  }
};

// Strain of one bond for small motion from where it was made: stretch along n and slip across n at the point
// of contact (m), twist along n and bend across n (rad).
struct SmallStrain {
  Vector3 normal; // n, of the bond as it was made
  double stretch = 0, twist = 0;
  Vector3 slip, bend;
};
// `displacement` (m) and `turn` (rad) have one row per particle; `turn` may be empty if spheres do not
// rotate.
SmallStrain small_strain(const Particles &particles, const Bonds &bonds, std::size_t row,
                         const std::vector<Vector3> &displacement, const std::vector<Vector3> &turn);
// Force on the first particle, N, by the tangent at rest.
Vector3 small_force(const Bonds &bonds, std::size_t row, const SmallStrain &strain);

BondEnergies bond_energies(const Particles &particles, const Bonds &bonds,
                           const std::vector<Vector3> &displacement, const std::vector<Vector3> &turn);
// The same from the present positions; rotations must be small.
BondEnergies bond_energies(const Particles &particles, const Bonds &bonds);

struct NetworkModuli {
  double young_voigt = 0, poisson_voigt = 0; // affine motion: an upper bound on E; Pa, 1
  double young_reuss = 0, poisson_reuss = 0; // static: an estimate, not a bound
};

// Isotropic network, sum over bonds of l^2 k_n / V = K, k = k_s/k_n: Voigt E = (K/3)(2 + 3k)/(4 + k),
// nu = (1 - k)/(4 + k); Reuss E = (K/3) 5k/(2 + 3k), nu = (1 - k)/(2 + 3k). `volume` of the specimen, m^3.
NetworkModuli network_moduli(const Bonds &bonds, double volume);

// Young's modulus along x, y and z (Pa) if the network follows uniform strains along the three axes and the
// two lateral strains take the least energy: an upper bound of its modulus in each direction. Equal to
// Voigt's for an isotropic network; much larger for a lattice along its bonds. 0 without bonds.
std::array<double, 3> affine_moduli(const Bonds &bonds, double volume);

// Mean squares of the distance from the centre of the section, m^2.
struct Gyration {
  double centre_x = 0, centre_y = 0; // m
  double xx = 0, yy = 0;             // of x - centre_x, of y - centre_y
};

// For the mass of the spheres with centres in low <= z <= high, including the extent of each sphere.
Gyration mass_gyration(const Particles &particles, double low, double high);

// For the bonds, which carry the force along z, with their middle in low <= z <= high. Each counts at its
// middle with its weight in the axial stiffness under a uniform strain, l^2 (K_n n_z^4 + K_s n_z^2 (1 -
// n_z^2)). Forces act between the centres of spheres, so this section ends about a radius inside the surface:
// the "effective section" of Andre et al. 2012, section 6. Zero without bonds.
Gyration bond_gyration(const Particles &particles, const Bonds &bonds, double low, double high);

} // namespace platen::dem
