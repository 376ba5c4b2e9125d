#include "apps/run/at_peak.h"

#include "dem/measure/bending.h"

namespace platen::apps {

double crossings_to_peak(const coupling::Problem &problem, const Results &results) {
  return problem.wave_crossing() > 0 ? results.axial_time_to_peak() / problem.wave_crossing() : not_measured;
}

double flexural_modulus(const coupling::Problem &problem, const Results &results) {
  const dem::ThreePoints bar = problem.three_points();
  return results.stress_per_deflection() * bar.deflection(1, 1, assumed_poisson_ratio);
}

double moment_over_nominal(const coupling::Problem &problem, const Results &results) {
  const double load = results.strength() * problem.nominal_area();
  return results.midspan_moment_at_peak() / (0.25 * load * problem.three_points().span);
}

double swings_to_peak(const coupling::Problem &problem, const Results &results) {
  return problem.swing() > 0 ? results.time_at_peak() / problem.swing() : not_measured;
}

} // namespace platen::apps
