// From an over-full system of soft spheres to one that is just jammed, for all growth packings.
#pragma once

#include <cstddef>
#include <vector>

#include "base/random.h"
#include "dem/packing/growth.h"
#include "dem/packing/soft_spheres.h"

namespace platen::dem {

// Packing fraction of a large jammed packing, and its loss at walls in units of mean radius times surface
// over volume: fitted to this program's own packings, used only to estimate the number of spheres.
constexpr double bulk_fraction = 0.6465, wall_loss = 0.29;

// Relative growth of mean radii at which spheres that would fill a container are over-full: low enough to
// stay amorphous, high enough to be solid.
double overfull_scale();

// Mean of factor^3 for factors uniform between 1 - spread/2 and 1 + spread/2.
double mean_cube(double spread);

// One radius from each of n equal slices of that distribution, in random order: the mean is exact for any
// seed.
std::vector<double> radius_factors(std::size_t n, double spread, Random &random);

// Residual force over mean contact force at which a stage counts as at rest. With a larger value, spheres
// from random positions overshoot: the system still creeps towards denser states, and the last stage then
// takes far longer.
constexpr double at_rest_from_random = 4e-3;

// Shrinks an over-full system in stages, each at rest, until its mean overlap is 5e-5 mean radii, then seats
// the loose spheres. Fills stages, iterations, loose_spheres, contacts_per_sphere, overlaps and
// residual_force of the report (iterations are added). Throws std::runtime_error if the packing does not jam.
void decompress(SoftSpheres &spheres, Random &random, GrowthReport &made,
                double at_rest = at_rest_from_random);

} // namespace platen::dem
