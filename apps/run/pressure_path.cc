#include "apps/run/pressure_path.h"

#include <algorithm>
#include <cmath>

#include "base/largest.h"

namespace platen::apps {

PressurePath pressure_path(const coupling::PlatenTest &problem, const Results &results) {
  PressurePath found;
  const std::optional<coupling::CellSettings> &cell = problem.settings().loading.cell;
  if (!cell || cell->path == 0) return found;
  const std::vector<Sample> &samples = results.samples();
  double strain_found = not_measured;
  Largest deviation;
  for (const Sample &s : samples) {
    if (s.axial_stage == 0) {
      strain_found = s.strain_platen;
      continue;
    }
    const double asked = cell->pressure + cell->path * s.deviator();
    if (asked <= 0 && s.confining_pressure <= 0) {
      found.ended_at_strain = s.strain_platen - strain_found;
      return found;
    }
    deviation.add(std::abs(s.confining_pressure - std::max(0.0, asked)) / std::max(cell->pressure, asked));
    found.deviation = deviation.value();
    if (s.time >= results.time_at_peak()) return found;
  }
  return found;
}

} // namespace platen::apps
