// Stress of each particle from the forces of its bonds and contacts.
#pragma once

#include <array>
#include <vector>

#include "dem/bonds.h"
#include "dem/contacts.h"
#include "dem/particles.h"

namespace platen::dem {

// Symmetric part of (1/V) sum r (x) F, tension positive, Pa, row by row; V is the sphere's volume over the
// packing fraction. Platen forces are not in it. `bonds`, `contacts` may be null.
std::vector<std::array<double, 9>> particle_stress(const Particles &particles, const Bonds *bonds,
                                                   const Contacts *contacts, double packing_fraction);

} // namespace platen::dem
