// Some hundred spheres between platens, for tests of whole problems.
#pragma once

#include "dem/packing/advancing_front.h"

namespace platen::coupling {

inline dem::Specimen small_cylinder(unsigned seed = 5) {
  dem::Shape shape;
  shape.radius = 6e-3;
  shape.height = 14e-3;
  return dem::advancing_front(shape, {dem::RadiusDistribution::Kind::uniform, 0.7e-3, 1e-3}, seed);
}

} // namespace platen::coupling
