// The lateral surface of a body of spheres, shared out to the spheres that make it.
//
// Each sphere is given a ball of twice its radius, so that neighbours' balls overlap and leave no pore
// between grains that touch. The power diagram of the balls cuts each to a cell; what is left of the ball's
// own surface (a solid of 32 faces stands for it) is its part of the skin, and the sum of the outward area
// vectors of these faces is the sphere's area. A cell is closed, so areas depend on where the ball's surface
// is cut and not on how it bulges between. The planes of the platens end the skin; pores and narrow cracks
// have none.
#pragma once

#include <vector>

#include "dem/outside.h"
#include "dem/particles.h"

namespace platen::dem {

struct Skin {
  std::vector<int> particle; // rows, ascending
  std::vector<Vector3> area; // m^2, outward
};

// Of the spheres marked in `body` (one mark per row).
Skin find_skin(const Particles &particles, const std::vector<char> &body, const EndPlanes &planes);

// Changes area vectors by as little as their own size allows, each by |a| (b + w x (x - c)), so that a
// uniform pressure has neither force nor moment: sum a = 0 and sum x x a = 0. Returns |sum a| before, over
// the sum of |a|. A skin of fewer than three spheres stays as it is.
double balance(Skin &skin, const Particles &particles);

} // namespace platen::dem
