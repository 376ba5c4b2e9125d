#include "apps/run/at_peak.h"

#include "dem/measure/gauge.h"

namespace platen::apps {

double wave_transits(const coupling::PlatenTest &problem, int axis, double seconds) {
  const double share = coupling::length(problem.shape(), axis) / problem.shape().height;
  const double transit = share * problem.facts().wave_transit;
  return transit > 0 ? seconds / transit : not_measured;
}

double wave_transits_to_peak(const coupling::PlatenTest &problem, const Results &results) {
  return wave_transits(problem, results.axis(), results.axial_time_to_peak());
}

double flexural_modulus(const coupling::PlatenTest &problem, const Results &results) {
  const dem::ThreePoints bar = problem.three_points();
  return results.stress_per_deflection() * bar.deflection(1, 1, assumed_poisson_ratio);
}

double moment_over_nominal(const coupling::PlatenTest &problem, const Results &results) {
  const double load = results.strength() * problem.nominal_area();
  return results.midspan_moment_at_peak() / (0.25 * load * problem.three_points().span);
}

double oscillations_to_peak(const coupling::PlatenTest &problem, const Results &results) {
  return problem.bending_period() > 0 ? results.time_at_peak() / problem.bending_period() : not_measured;
}

} // namespace platen::apps
