#include "coupling/metal_settings.h"

#include <cmath>

#include "base/require.h"
#include "fem/materials/structural_steel.h"

namespace platen::coupling {

fem::Hardening MetalSettings::hardening(double young_modulus) const {
  require(yield_strength > 0, "metal: its yield strength must be positive");
  require(std::isnan(ultimate_strength) || points.empty(), "metal: an ultimate strength or points, not both");
  require(!(ultimate_strength < yield_strength), "metal: its ultimate strength is below its yield strength");
  fem::Hardening all;
  if (ultimate_strength > yield_strength)
    all = fem::structural_steel(yield_strength, ultimate_strength, young_modulus);
  else
    all.points[all.count++] = {0, yield_strength};
  require(points.size() < fem::Hardening::most_points, "metal: at most 31 points after the yield strength");
  for (const fem::Hardening::Point &point : points)
    all.points[all.count++] = point;
  all.saturation = saturation, all.rate = saturation_rate;
  all.require_valid();
  return all;
}

} // namespace platen::coupling
