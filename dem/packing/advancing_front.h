// Constructive packing by an advancing front: spheres are added one by one, none ever moves. SI units.
#pragma once

#include <cstdint>

#include "dem/packing/radius_distribution.h"
#include "dem/packing/specimen.h"

namespace platen::dem {

// Fills the shape from its middle outwards. Three touching spheres start the front; the front is first in,
// first out: around its oldest sphere every place is taken where a sphere of the next radius touches that
// sphere and two others, overlaps none and lies inside the shape, then that sphere leaves the front. (The
// kind of packing of Feng, Han and Owen 2002, in closed form and in space.) Each sphere so touches three
// earlier ones: 3 N - 6 contacts, coordination just below 6, packing fraction near .553 far from walls, none
// of the walls touched on purpose. A radius that fits nowhere on one sphere is kept for the next, so that the
// distribution is not thinned out where space is short. The same seed gives the same packing bit for bit.
// Spheres are numbered in the order of placing. Throws std::invalid_argument: shape not valid, or not even
// one of the largest spheres fits into it.
Specimen advancing_front(const Shape &shape, const RadiusDistribution &radii, std::uint64_t seed);

} // namespace platen::dem
