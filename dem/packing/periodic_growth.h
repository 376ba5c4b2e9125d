// Random close packing without walls: a box of jammed spheres, periodic along x, y and z. SI units.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "dem/packing/growth.h"
#include "dem/packing/specimen.h"

namespace platen::dem {

// With fewer spheres some would touch their own images.
constexpr std::size_t fewest_periodic_spheres = 200, most_periodic_spheres = 5000000;

// A periodic box of spheres, grown as in random_close_packing() but without walls: centres lie in the box,
// spheres extend through its faces and touch the images of others there. Radii are uniform between (1 -
// spread/2) and (1 + spread/2) of a mean that follows from the box. The same seed gives the same packing bit
// for bit on any number of threads.
//
// Throws std::invalid_argument: shape not a box or not valid, an edge under half of the longest, spread
// outside [0, 1.9], a number of spheres outside the above; std::runtime_error if the packing does not jam.
Specimen periodic_close_packing(const Shape &box, std::size_t spheres, double spread, std::uint64_t seed,
                                GrowthReport *report = nullptr);

// The same from given positions (m, anywhere) and relative radii of mean 1.
Specimen periodic_close_packing_from(const Shape &box, const std::vector<Vector3> &places,
                                     const std::vector<double> &factors, std::uint64_t seed,
                                     GrowthReport *report = nullptr);

} // namespace platen::dem
