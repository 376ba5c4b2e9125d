// The length that margins and windows of a specimen are measured in.
#pragma once

#include "dem/particles.h"

namespace platen::dem {

// m; 1 of no particles.
inline double mean_radius(const Particles &particles) {
  double sum = 0;
  for (const double r : particles.radius)
    sum += r;
  return particles.size() == 0 ? 1.0 : sum / static_cast<double>(particles.size());
}

} // namespace platen::dem
