// Sizes of spheres to be packed. SI units.
#pragma once

#include "base/random.h"

namespace platen::dem {

// Radii by number: all equal, two sizes, or even between two bounds. Made by the functions below, which throw
// std::invalid_argument on radii that are not positive, finite and in order, or fractions outside [0, 1].
struct RadiusDistribution {
  enum class Kind { equal, two_sizes, uniform };
  Kind kind = Kind::equal;
  double small = 0, large = 0;  // m
  double fraction_of_large = 0; // by number, two sizes only

  double draw(Random &random) const;
  double mean() const; // m
};

RadiusDistribution equal_radii(double radius);                                      // m
RadiusDistribution two_radii(double small, double large, double fraction_of_large); // m, m, by number
RadiusDistribution uniform_radii(double smallest, double largest);                  // m
// Even between (1 - spread/2) and (1 + spread/2) of the mean (m); spread = (largest - smallest) / mean in [0,
// 2).
RadiusDistribution uniform_radii_of_spread(double mean, double spread);

} // namespace platen::dem
