// Stress of particles and of bonds; mean stress, mean strain and moduli of a part of a specimen.
#pragma once

#include <array>
#include <vector>

#include "dem/bonds.h"
#include "dem/contacts.h"
#include "dem/packing/specimen.h"
#include "dem/particles.h"

namespace platen::dem {

// Symmetric part of (1/V) sum r (x) F, tension positive, Pa, row by row; V is the sphere's volume over the
// packing fraction. Platen forces are not included. `bonds`, `contacts` may be null.
std::vector<std::array<double, 9>> particle_stress(const Particles &particles, const Bonds *bonds,
                                                   const Contacts *contacts, double packing_fraction);

// Bonds with an angle to the horizontal in [low, high), rad; broken bonds count with their contact force if
// their law has one, otherwise they are left out.
struct DirectionClass {
  double low = 0, high = 0;
  int bonds = 0, pressed = 0;
  double mean = 0;         // Pa, of all bonds, compression positive; NaN without bonds
  double mean_pressed = 0; // Pa, of those in compression; NaN without
};
// `classes` of equal width from 0 to a right angle.
std::vector<DirectionClass> bond_stress_by_direction(const Particles &particles, const Bonds &bonds,
                                                     int classes);

// A box or cylinder about the z axis, its lower end at `bottom` (m).
struct Region {
  Shape shape;
  double bottom = 0;
  bool holds(const Vector3 &point) const;
  // Fraction of the path from `from` to `to` that lies inside.
  double fraction_inside(const Vector3 &from, const Vector3 &to) const;
};

using Tensor = std::array<std::array<double, 3>, 3>;

// (1/V) sum over bonds of (the part of their length inside) (x) force, symmetric part, Pa, tension positive:
// the exact mean stress of forces along straight lines from centre to centre, without a packing fraction. For
// small motion (m, rad, one row per particle) from where bonds were made.
Tensor mean_stress(const Region &region, const Particles &particles, const Bonds &bonds,
                   const std::vector<Vector3> &displacement, const std::vector<Vector3> &turn);

// Symmetric part of the best-fit gradient of displacement on reference position over the particles with
// centres inside; NaN if they are too few. `counted` selects the rows that count, because loose spheres stay
// behind; empty: all.
Tensor mean_strain(const Region &region, const Particles &particles, const std::vector<Vector3> &displacement,
                   const std::vector<char> &counted = {});

// Isotropic moduli nearest to six pairs of strain and stress that span all strains: stiffness C from stress =
// C strain, then its mean over all directions (Voigt). `anisotropy`: largest difference of a component of C
// from the isotropic one, over the largest component. All NaN if strains are not independent.
struct Moduli {
  double youngs = 0, poisson = 0; // Pa, 1
  double anisotropy = 0;
};
Moduli isotropic_moduli(const std::array<Tensor, 6> &strain, const std::array<Tensor, 6> &stress);

} // namespace platen::dem
