// Which way cracks face.
#pragma once

#include <array>

#include "base/vector3.h"

namespace platen::dem {

// Area of broken bonds by the angle of their normals to the axis z, in nine bins of ten degrees from along it
// (cracks across the specimen) to across it (cracks along the specimen).
struct CrackRose {
  static constexpr int bins = 9;
  std::array<double, bins> area{}; // m^2

  // A unit normal, of either sense; m^2.
  void add(const Vector3 &normal, double crack_area);
  // Share of the area over the bin's share of all directions: 1 everywhere where cracks face all ways alike.
  // NaN without cracks.
  std::array<double, bins> over_isotropic() const;
};

} // namespace platen::dem
