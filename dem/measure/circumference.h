// Strain of the circumference, as a chain around a specimen measures it.
#pragma once

#include <vector>

#include "dem/bonds.h"
#include "dem/packing/specimen.h"
#include "dem/particles.h"

namespace platen::dem {

// Mean over the spheres of the lateral surface in the middle half of the height: outward displacement over
// the distance from the axis (for a box: from the middle plane of its side). Each value is limited to three
// times the median, so that ejected pieces do not widen it further. Surface spheres lie within a mean
// diameter of the surface; spheres that never had a bond are skipped.
class Circumference {
public:
  // Gives the same object at any time of the run, as Gauge. `bonds` may be null.
  Circumference(const Particles &particles, const Shape &shape, const Bonds *bonds);
  double strain(const Particles &particles) const; // positive if it widens; NaN without spheres
  std::size_t size() const { return rows_.size(); }
  const std::vector<int> &rows() const { return rows_; } // ascending

private:
  std::vector<int> rows_;
  std::vector<Vector3> outward_; // divided by the distance, 1/m
  mutable std::vector<double> strains_;
};

} // namespace platen::dem
