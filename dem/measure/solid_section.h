// How much of its shape a specimen fills, section by section: what a stress over the nominal section is
// worth. SI units.
#pragma once

#include <limits>

#include "dem/packing/specimen.h"

namespace platen::dem {

// Shares of the shape's section that grains and their regular pores fill, of slices one largest diameter
// thick across an axis, without a diameter at each end, where platens are seated. 1: the specimen fills its
// shape.
struct SolidSection {
  // Packings in their shape are within these, for their mean and for each slice.
  static constexpr double accuracy = 0.05, of_slice = 0.08;
  static constexpr double none = std::numeric_limits<double>::quiet_NaN();
  double mean = none, least = none, largest = none;

  bool fills() const { return mean >= 1 - accuracy && least >= 1 - of_slice; }
  bool same_at_all_heights() const { return largest - least <= of_slice * mean; }
};

// The shape ends where its outermost spheres do across the axis; what is beyond is not filled. Within, its
// space is shared out to the spheres, each point to that whose surface is nearest. A sphere that no hole
// touches fills its part, whatever that is: pores between neighbours are the material's. One at a hole fills
// as much as the others in proportion to its volume, of its part what is nearest to it. A hole is where one
// more of the largest spheres has room. Exact of lattices, whose holes end half-way to where the next sphere
// would be. By points a third of a radius apart, further apart beyond ten thousand spheres. axis: 0 x, 1 y,
// 2 z. NaN without spheres.
SolidSection solid_section(const Specimen &specimen, int axis);

} // namespace platen::dem
