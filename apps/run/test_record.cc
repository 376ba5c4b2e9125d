#include "apps/run/test_record.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/output/machine.h"
#include "base/pi.h"
#include "coupling/program_of_test.h"
#include "dem/measure/gauge.h"

namespace platen::apps {
std::size_t bytes_per_bond(const dem::Model &model) {
  if (!model.bonds) return 0;
  const dem::Bonds &b = *model.bonds;
  return b.table.bytes_per_row() + b.records.bytes_per_row() + sizeof(b.blocks.ends[0]);
}

bool measures_pattern(const Scene &scene, const coupling::PlatenTest &problem) {
  return scene.loading.test == LoadingTest::compression && problem.shape().kind != dem::ShapeKind::disc &&
         !problem.bent() && coupling::loaded_axis(problem) == 2;
}

TestRecord::TestRecord(const Scene &of, const coupling::PlatenTest &test, const Results &record,
                       const RunCosts &spent)
    : scene(of),
      problem(test),
      model(test.model),
      results(record),
      emission(record.emission()),
      costs(spent),
      peak(record.peak()),
      at_modulus(record.modulus_state()),
      slowness(apps::slowness(test, record)),
      path(pressure_path(test, record)),
      tiling(tiling_of(of, test.shape())),
      fragments(dem::find_fragments(model.particles, model.bonds.get())) {
  if (model.bonds && model.settings().crack_log)
    widths = dem::crack_widths(dem::openings(model.particles, *model.bonds), model.particles, *model.bonds,
                               model.settings().bond_layout, test.shape(), scene.output.crack_roughness);
  if (is_disc() && model.bonds) split = dem::split_pattern(model.particles, *model.bonds, test.shape());
}

bool TestRecord::is_tension() const {
  return scene.loading.test == LoadingTest::tension || problem.bent() || is_disc();
}

bool TestRecord::presses(coupling::Side side, int but_axis) const {
  return coupling::axis_of(side) != but_axis && problem.platen(side) != nullptr;
}

bool TestRecord::presses_sides() const {
  return std::any_of(coupling::all_sides.begin(), coupling::all_sides.end(),
                     [&](coupling::Side side) { return presses(side, 2); });
}

double TestRecord::particle_steps_per_second() const {
  const auto steps = static_cast<double>(costs.steps_here);
  return costs.step_seconds > 0 ? static_cast<double>(model.particles.size()) * steps / costs.step_seconds
                                : not_measured;
}

std::uint64_t TestRecord::peak_memory_bytes() const {
  return apps::peak_memory_bytes();
}

Json TestRecord::stage_seconds() const {
  Json stages;
  for (int k = 0; k < dem::stage_count; ++k)
    stages[dem::stage_names[static_cast<std::size_t>(k)]] = model.clock.seconds(static_cast<dem::Stage>(k));
  return stages;
}

// Of a run that was stopped before its peak nothing is reported: the way to it is not known.
bool TestRecord::is_slowness_known() const {
  return knows_slowness(peak.reached(), costs.ended_by) &&
         (!std::isnan(slowness.kinetic) || !std::isnan(slowness.wave_transits));
}

std::vector<std::string> TestRecord::signs_of_haste() const {
  return is_slowness_known() ? reasons_not_quasi_static(slowness, problem.bent())
                             : std::vector<std::string>{};
}

double TestRecord::flexural_modulus() const {
  const double stress_per_deflection = results.secant(&Sample::deflection); // Pa/m
  return stress_per_deflection * problem.three_points().deflection(1, 1, assumed_poisson_ratio);
}

double TestRecord::moment_over_nominal() const {
  const double load = results.strength() * problem.nominal_area();
  return results.at_peak(&Sample::midspan_moment) / (0.25 * load * problem.three_points().span);
}

double TestRecord::oscillations_to_peak() const {
  return problem.bending_period() > 0 ? results.time_at_peak() / problem.bending_period() : not_measured;
}

double TestRecord::work_of_fracture() const {
  return results.work_over_strain() * problem.nominal_area() * problem.shape().height;
}

double TestRecord::cracks_near_midspan() const {
  return dem::broken_near_midspan(model.particles, *model.bonds, problem.shape().height);
}

const dem::FailureMeasures &TestRecord::failure(bool last) const {
  return (last ? results.last_pattern() : results.pattern()).failure;
}

bool TestRecord::has_emission() const {
  return scene.model.crack_log && model.bonds && !std::isnan(results.last_pattern().time);
}

std::string TestRecord::word_of_pattern(bool last) const {
  return dem::word_of(dem::judge_failure(failure(last)).pattern);
}

std::vector<std::string> TestRecord::reasons_of_pattern(bool last) const {
  return {reason_words(failure(last)), "top: " + cone_words(dead_zone(last, dem::top_end)),
          "bottom: " + cone_words(dead_zone(last, dem::bottom_end))};
}

std::string cone_words(const dem::DeadZone &d) {
  if (d.is_cone())
    return fmt::format(
        "r0 {:.2f}, {:.3g} mm high, half-angle {:.0f} degrees, {:.2f} of the volume, confidence {:.2f}",
        d.base_ratio, 1e3 * d.height, d.half_angle / degree, d.volume_fraction, d.confidence);
  if (std::isnan(d.base_ratio)) return fmt::format("none: {}", dem::words_of(d.verdict));
  return fmt::format("none: {} (r0 {:.2f}, {:.2f} of the volume)", dem::words_of(d.verdict), d.base_ratio,
                     d.volume_fraction);
}

std::string reason_words(const dem::FailureMeasures &m) {
  const dem::CrackPlane &plane = m.planes.largest;
  switch (dem::judge_failure(m).by) {
    case dem::DecidedBy::two_cones:
      return m.dead[dem::top_end].is_cone() && m.dead[dem::bottom_end].is_cone()
                 ? "what moves with the platens is a cone on each"
                 : "what moves with the platens is a cone on one and a dome on the other";
    case dem::DecidedBy::one_plane:
      return fmt::format("{:.0f} % of the lost bonds lie in one plane, {:.0f} degrees from the axis",
                         100 * plane.bonds / m.planes.broken, plane.inclination / degree);
    case dem::DecidedBy::columns:
      return fmt::format("{:.0f} sound pieces reach from platen to platen", m.columns);
    case dem::DecidedBy::steep_planes:
      return fmt::format("{:.0f} % of the lost bonds lie in planes within 15 degrees of the axis",
                         100 * m.planes.steep_fraction);
    case dem::DecidedBy::few_broken:
      return fmt::format("{:.1f} % of the bonds are broken", 100 * m.broken_fraction);
    case dem::DecidedBy::crushed_end:
      return fmt::format("one end has lost {:.0f} % of its bonds", 100 * m.damage.worse_end());
    case dem::DecidedBy::nothing:
      break;
  }
  return fmt::format("damage of the ends {:.2f} and {:.2f}, of the middle {:.2f}: no rule holds",
                     m.damage.end_top, m.damage.end_bottom, m.damage.middle);
}

} // namespace platen::apps
