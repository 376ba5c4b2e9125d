// Constructive packing by an advancing front: spheres of given sizes are added one by one and never move. SI
// units.
#pragma once

#include <cstdint>

#include "base/random.h"
#include "dem/packing/specimen.h"

namespace platen::dem {

// Radii by number: equal, two sizes, or uniform between two bounds. Made by the functions below, which throw
// std::invalid_argument for radii that are not positive, finite and in order, or fractions outside [0, 1].
struct RadiusDistribution {
  enum class Kind { equal, two_sizes, uniform };
  Kind kind = Kind::equal;
  double small = 0, large = 0;  // m
  double fraction_of_large = 0; // by number, two sizes only

  double draw(Random &random) const;
};

RadiusDistribution equal_radii(double radius);                                      // m
RadiusDistribution two_radii(double small, double large, double fraction_of_large); // m, m, by number
// Uniform between (1 - spread/2) and (1 + spread/2) of the mean (m); spread = (largest - smallest) / mean in
// [0, 2).
RadiusDistribution uniform_radii_of_spread(double mean, double spread);

// Fills the shape from its middle outwards. Three touching spheres start the front, which is first in, first
// out: around its oldest sphere every place is filled where a sphere of the next radius touches that sphere
// and two others, overlaps none and lies inside the shape; then that sphere leaves the front. (The kind of
// packing of Feng, Han and Owen 2002, in closed form and in three dimensions.) Each sphere thus touches three
// earlier ones: 3 N - 6 contacts, coordination just below 6, packing fraction near .553 far from walls, no
// deliberate contacts with walls. A radius that fits nowhere at one sphere is kept for the next, so that
// narrow space does not change the distribution. The same seed gives the same packing bit for bit. Spheres
// are numbered in the order of placing. Throws std::invalid_argument if the shape is not valid or is too
// small for one of the largest spheres.
Specimen advancing_front(const Shape &shape, const RadiusDistribution &radii, std::uint64_t seed);

} // namespace platen::dem
