// Normal stress of bonds against their direction.
#pragma once

#include <vector>

#include "dem/bonds.h"
#include "dem/particles.h"

namespace platen::dem {

// Bonds whose angle to the horizontal lies in [low, high), rad; those that have broken carry what they carry
// as contacts where their law says so, and are left out where it does not.
struct DirectionClass {
  double low = 0, high = 0;
  int bonds = 0, pressed = 0;
  double mean = 0;         // Pa, of all, compression positive; NaN without bonds
  double mean_pressed = 0; // Pa, of those in compression; NaN without
};
// `classes` of equal width from 0 to a right angle.
std::vector<DirectionClass> bond_stress_by_direction(const Particles &particles, const Bonds &bonds,
                                                     int classes);

} // namespace platen::dem
