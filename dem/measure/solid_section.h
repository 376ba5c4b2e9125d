// Filled fraction of a specimen's shape, section by section, which shows whether a stress over the nominal
// section is meaningful. SI units.
#pragma once

#include <limits>

#include "dem/packing/specimen.h"

namespace platen::dem {

// Fractions of the shape's section that grains and their regular pores fill, for slices one largest diameter
// thick across an axis, without one diameter at each end, where platens are seated. 1: the specimen fills its
// shape.
struct SolidSection {
  // Packings in their shape are within these tolerances, for their mean and for each slice.
  static constexpr double accuracy = 0.05, of_slice = 0.08;
  static constexpr double none = std::numeric_limits<double>::quiet_NaN();
  double mean = none, least = none, largest = none;

  bool fills() const { return mean >= 1 - accuracy && least >= 1 - of_slice; }
  bool same_at_all_heights() const { return largest - least <= of_slice * mean; }
};

// Across the axis the shape ends at its outermost spheres; the space beyond is not filled. The space inside
// is divided among the spheres: each point belongs to the sphere with the nearest surface. A sphere that
// touches no hole fills its part completely: pores between neighbours belong to the material. A sphere at a
// hole fills as much as the others in proportion to its volume, the nearest points of its part. In a hole one
// more of the largest spheres would fit. Exact for lattices, whose holes end half-way to the next possible
// sphere. Points are a third of a radius apart, further apart beyond ten thousand spheres. axis: 0 x, 1 y, 2
// z. NaN without spheres.
SolidSection solid_section(const Specimen &specimen, int axis);

} // namespace platen::dem
