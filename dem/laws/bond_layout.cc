#include "dem/laws/bond_layout.h"

#include <algorithm>
#include <cmath>

#include "base/pi.h"

namespace platen::dem {

double BondLayout::bond_radius(double ri, double rj) const {
  const double multiplier = radius_multiplier * std::sqrt(area_factor);
  switch (radius_rule) {
    case RadiusRule::minimum:
      return multiplier * std::min(ri, rj);
    case RadiusRule::mean:
      return multiplier * 0.5 * (ri + rj);
    case RadiusRule::harmonic:
      return multiplier * 2 * ri * rj / (ri + rj);
    case RadiusRule::given:
      break;
  }
  return multiplier * radius;
}

double BondLayout::axial_stiffness(double ri, double rj) const {
  const double rb = bond_radius(ri, rj);
  return normal_stiffness(ri, rj) * pi * rb * rb;
}

double BondLayout::reach(double ri, double rj) const {
  return by_range ? interaction_range * (ri + rj) : gap.length(std::min(ri, rj));
}

double BondLayout::largest_overlap(double ri, double rj) const {
  return by_range ? interaction_range * (ri + rj) : std::numeric_limits<double>::infinity();
}

} // namespace platen::dem
