#include "dem/packing/radius_distribution.h"

#include <cmath>
#include <stdexcept>

namespace platen::dem {

namespace {

RadiusDistribution checked(const RadiusDistribution &radii) {
  if (!(radii.small > 0) || !(radii.large >= radii.small) || !std::isfinite(radii.large))
    throw std::invalid_argument("sphere radii must be positive, finite, and the smaller given first");
  if (!(radii.fraction_of_large >= 0) || !(radii.fraction_of_large <= 1))
    throw std::invalid_argument("the fraction of large spheres must lie in [0, 1]");
  return radii;
}

} // namespace

double RadiusDistribution::draw(Random &random) const {
  if (kind == Kind::equal) return small;
  const double u = random.uniform();
  if (kind == Kind::two_sizes) return u < fraction_of_large ? large : small;
  return small + (large - small) * u;
}

double RadiusDistribution::mean() const {
  if (kind == Kind::two_sizes) return small + (large - small) * fraction_of_large;
  return 0.5 * (small + large);
}

RadiusDistribution equal_radii(double radius) {
  return checked({RadiusDistribution::Kind::equal, radius, radius, 0});
}

RadiusDistribution two_radii(double small, double large, double fraction_of_large) {
  return checked({RadiusDistribution::Kind::two_sizes, small, large, fraction_of_large});
}

RadiusDistribution uniform_radii(double smallest, double largest) {
  return checked({RadiusDistribution::Kind::uniform, smallest, largest, 0});
}

RadiusDistribution uniform_radii_of_spread(double mean, double spread) {
  return uniform_radii(mean * (1 - 0.5 * spread), mean * (1 + 0.5 * spread));
}

} // namespace platen::dem
