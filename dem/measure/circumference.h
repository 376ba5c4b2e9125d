// What a chain around a specimen would read.
#pragma once

#include <vector>

#include "dem/bonds.h"
#include "dem/packing/specimen.h"
#include "dem/particles.h"

namespace platen::dem {

// Mean over the spheres of the lateral surface in the middle half of the height of what each has moved
// outwards, over its distance from the axis (of a box: from the middle plane of its side): the strain of the
// circumference. None counts more than three times the median: pieces that fly off do not go on widening it.
// The surface is what lies within a mean diameter of it; spheres that never had a bond are passed over.
class Circumference {
public:
  // The same whenever it is made, as Gauge. `bonds` may be null.
  Circumference(const Particles &particles, const Shape &shape, const Bonds *bonds);
  double strain(const Particles &particles) const; // positive where it widens; NaN without a sphere
  std::size_t size() const { return rows_.size(); }
  const std::vector<int> &rows() const { return rows_; } // ascending

private:
  std::vector<int> rows_;
  std::vector<Vector3> outward_; // over the distance, 1/m
  mutable std::vector<double> strains_;
};

} // namespace platen::dem
