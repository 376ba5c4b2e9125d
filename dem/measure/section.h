// The section of a bar of spheres: how far its mass, and what carries its forces, lie from its axis.
#pragma once

#include "dem/bonds.h"
#include "dem/particles.h"

namespace platen::dem {

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
