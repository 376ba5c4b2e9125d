// The stiffness of a bond as it is now, with the forces that are in it.
#pragma once

#include "dem/statics/network.h"

namespace platen::dem::statics {

// Minus the derivative of forces and torques (over the radius) by displacements and rotations (times the
// radius) of the two particles, made symmetric: by differences of the bond's own response.
BondBlocks<6> tangent_stiffness(const Particles &particles, const Bonds &bonds, std::size_t row);

} // namespace platen::dem::statics
