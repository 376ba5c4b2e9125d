#include "apps/run/summary_of_run.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "apps/io/machine.h"
#include "apps/run/problem_setup.h"
#include "apps/scene/version.h"
#include "dem/measure/bending.h"
#include "dem/measure/fragments.h"
#include "dem/measure/split.h"

namespace platen::apps {
namespace {

using Json = nlohmann::ordered_json;

Json stage_seconds(const dem::StageClock &clock) {
  Json stages;
  for (int k = 0; k < dem::stage_count; ++k)
    stages[dem::stage_names[static_cast<std::size_t>(k)]] = clock.seconds(static_cast<dem::Stage>(k));
  return stages;
}

void add_pattern(Json &to, const char *prefix, const Pattern &p) {
  const std::string start = prefix;
  to[start + "end_damage_top"] = p.end_top;
  to[start + "end_damage_bottom"] = p.end_bottom;
  to[start + "middle_damage"] = p.middle;
  to[start + "end_spread"] = p.end_spread;
}

// Speed of a slow test: how often a wave crosses the specimen until the peak.
double crossings_to_peak(const coupling::Problem &problem, const Results &results) {
  return problem.wave_crossing() > 0 ? results.time_at_peak() / problem.wave_crossing() : not_measured;
}

const char *word_of(LoadingTest test) {
  switch (test) {
    case LoadingTest::tension:
      return "tension";
    case LoadingTest::hydrostatic:
      return "hydrostatic";
    case LoadingTest::uniaxial_strain:
      return "uniaxial strain";
    case LoadingTest::three_point_bending:
      return "three point bending";
    case LoadingTest::compression:
      break;
  }
  return "compression";
}

// Of a pressure on the skin: where it acts, and what the hydrostatic stage says.
void add_cell(Json &to, const coupling::Problem &problem, const Results &results) {
  const dem::Confinement *skin = problem.confinement();
  if (skin == nullptr) return;
  to["confining_pressure_pa"] = skin->pressure();
  to["deviator_strength_pa"] = results.deviator_strength();
  to["bulk_modulus_pa"] = results.bulk_modulus();
  to["skin_spheres"] = skin->size();
  to["skin_coverage"] = skin->coverage(problem.model.particles, problem.end_planes());
  to["confinement_work_j"] = skin->work();
}

// What a test says nothing of.
void withdraw_moduli(Json &to) {
  for (const char *key :
       {"youngs_modulus_gauge_pa", "youngs_modulus_platen_pa", "poisson_ratio", "poisson_ratio_extremal"})
    to[key] = nullptr;
}

// Between a stiff wall neither Young's modulus nor Poisson's ratio is measured, but these.
void add_wall(Json &to, const coupling::Problem &problem, const Results &results) {
  if (problem.wall() == nullptr) return;
  to["wall_seats"] = problem.wall()->seats();
  to["constrained_modulus_pa"] = results.youngs_modulus_gauge();
  to["lateral_over_axial_stress"] = results.lateral_over_axial();
  withdraw_moduli(to);
}

// Of a disc: strength is 2 P / (pi D t); Young's modulus is not measured.
void add_disc(Json &to, const coupling::Problem &problem, const Results &results) {
  if (problem.shape().kind != dem::ShapeKind::disc) return;
  to["failure_load_n"] = results.strength() * problem.shape().cross_section();
  to["opening_at_peak_m"] = results.opening_at_peak();
  withdraw_moduli(to);
  if (!problem.model.bonds) return;
  const dem::SplitPattern p =
      dem::split_pattern(problem.model.particles, *problem.model.bonds, problem.shape());
  to["cracks_on_loaded_diameter"] = p.on_diameter;
  to["cracks_in_middle_of_diameter"] = p.in_middle;
  to["first_cracks_in_middle_of_diameter"] = p.first_in_middle;
}

// Poisson's ratio of the share of shear in a deflection, which a bent bar does not tell: between 0.1 and 0.3
// the share changes by a sixth.
constexpr double assumed_poisson_ratio = 0.2;

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

// Of a bent bar: stresses are 3 P L / (2 b d^2); what is true of the moduli is in the deflection.
void add_bar(Json &to, const coupling::Problem &problem, const Results &results) {
  if (!problem.bent()) return;
  to["failure_load_n"] = results.strength() * problem.nominal_area();
  to["deflection_at_peak_m"] = results.deflection_at_peak();
  to["flexural_modulus_pa"] = flexural_modulus(problem, results);
  to["shear_over_bending_deflection"] = problem.three_points().shear_share(assumed_poisson_ratio);
  to["moment_over_nominal"] = moment_over_nominal(problem, results);
  to["swings_to_peak"] = swings_to_peak(problem, results);
  to["cracks_near_midspan"] =
      dem::broken_near_midspan(problem.model.particles, *problem.model.bonds, problem.shape().height);
  withdraw_moduli(to);
}

} // namespace

const char *app_of(const coupling::Problem &problem) {
  return problem.shape().kind == dem::ShapeKind::disc ? "platen-brazilian" : "platen-compress";
}

std::size_t bytes_per_bond(const dem::Model &model) {
  if (!model.bonds) return 0;
  const dem::Bonds &b = *model.bonds;
  return b.table.bytes_per_row() + b.records.bytes_per_row() + sizeof(b.blocks.ends[0]);
}

Json summary_of_run(const std::string &status, const Scene &scene, const coupling::Problem &problem,
                    const Results &results, const RunCosts &costs) {
  const dem::Model &model = problem.model;
  const double particles = static_cast<double>(model.particles.size());
  Json s;
  s["status"] = status;
  s["app"] = app_of(problem);
  s["scene"] = scene.general.title.empty() ? scene.name : scene.general.title;
  s["version"] = version_line();
  s["effects"] = effects_on(scene);
  s["effects_off"] = effects_off(scene);
  s["test"] = word_of(scene.loading.test);
  s["particles"] = model.particles.size();
  s["bonds"] = model.bonds ? model.bonds->initial_count() : 0;
  s["coordination_number"] = problem.coordination_number();
  s["packing_fraction"] = problem.packing_fraction();
  s["grain_density_kg_m3"] = problem.grain_density();
  s["seated_top"] = problem.top_layer.seats();
  s["seated_bottom"] = problem.bottom_layer.seats();
  s["steps"] = problem.steps();
  s["time_step_s"] = problem.time_step();
  s["time_step_reason"] = problem.time_step_reason();
  s["instruction_set"] = dem::name(model.settings().instruction_set);
  s["threads"] = costs.threads;
  s["wall_seconds"] = costs.wall_seconds;
  s["setup_seconds"] = costs.setup_seconds;
  s["particle_steps_per_second"] =
      costs.step_seconds > 0 ? particles * static_cast<double>(costs.steps_here) / costs.step_seconds
                             : not_measured;
  s["stage_seconds"] = stage_seconds(model.clock);
  s["peak_memory_bytes"] = peak_memory_bytes();
  s["bytes_per_particle"] = model.particles.table.bytes_per_row();
  s["bytes_per_bond"] = bytes_per_bond(model);
  s["bytes_in_columns_and_search"] = problem.bytes();
  s["strength_pa"] = results.strength();
  s["strain_at_peak_platen"] = results.strain_at_peak_platen();
  s["strain_at_peak_gauge"] = results.strain_at_peak_gauge();
  s["youngs_modulus_gauge_pa"] = results.youngs_modulus_gauge();
  s["youngs_modulus_platen_pa"] = results.youngs_modulus_platen();
  s["poisson_ratio"] = results.poisson_ratio();
  s["poisson_ratio_extremal"] = results.poisson_ratio_extremal();
  s["youngs_modulus_voigt_pa"] = problem.voigt_modulus() > 0 ? problem.voigt_modulus() : not_measured;
  add_cell(s, problem, results);
  add_wall(s, problem, results);
  add_disc(s, problem, results);
  add_bar(s, problem, results);
  s["broken_tension"] = model.broken(dem::BondState::broken_in_tension);
  s["broken_shear"] = model.broken(dem::BondState::broken_in_shear);
  s["energy_residual_relative"] = results.energy_residual_relative();
  s["kinetic_to_internal_max"] = results.kinetic_to_internal_max();
  s["wave_crossings_to_peak"] = crossings_to_peak(problem, results);
  add_pattern(s, "", results.pattern());
  add_pattern(s, "final_", results.last_pattern());
  s["barrel_at_peak"] = results.barrel_at_peak();
  const dem::Fragments fragments = dem::find_fragments(model.particles, model.bonds.get());
  s["fragments"] = fragments.count;
  s["loose_particles"] = fragments.single;
  s["cone_top"] = nullptr; // not measured by this app yet
  s["cone_bottom"] = nullptr;
  return s;
}

namespace {

// Lines for the screen, of what has been measured.
class Report {
public:
  template <class... Numbers>
  void line(const char *what, const char *format, Numbers... numbers) {
    if ((std::isnan(static_cast<double>(numbers)) || ...)) return;
    text_ += fmt::format("  {:<36}{}\n", what, fmt::format(fmt::runtime(format), numbers...));
  }
  const std::string &text() const { return text_; }

private:
  std::string text_;
};

void report_strength(Report &report, const Scene &scene, const coupling::Problem &problem,
                     const Results &results) {
  const bool disc = problem.shape().kind == dem::ShapeKind::disc,
             tension = scene.loading.test == LoadingTest::tension;
  if (disc || problem.bent())
    report.line("load at failure", "{:.2f} kN", results.strength() * problem.nominal_area() / 1e3);
  report.line(disc             ? "splitting strength, 2P/(pi D t)"
              : problem.bent() ? "flexural strength, 3PL/(2bd^2)"
              : tension        ? "tensile strength"
                               : "compressive strength",
              "{:.2f} MPa", results.strength() / 1e6);
  if (problem.confinement() != nullptr) {
    report.line("largest deviator", "{:.2f} MPa", results.deviator_strength() / 1e6);
    report.line("bulk modulus", "{:.2f} GPa", results.bulk_modulus() / 1e9);
  }
}

void report_stiffness(Report &report, const coupling::Problem &problem, const Results &results) {
  if (problem.bent()) {
    report.line("deflection at peak", "{:.2f} um", 1e6 * results.deflection_at_peak());
    report.line("flexural modulus", "{:.2f} GPa (deflection by shear over bending {:.2f}, at nu = 0.2)",
                flexural_modulus(problem, results) / 1e9,
                problem.three_points().shear_share(assumed_poisson_ratio));
    report.line("moment at mid-span over PL/4", "{:.3f}", moment_over_nominal(problem, results));
    return;
  }
  report.line("strain at peak (platen, gauge)", "{:.5f}, {:.5f}", results.strain_at_peak_platen(),
              results.strain_at_peak_gauge());
  if (problem.shape().kind == dem::ShapeKind::disc) return;
  const bool walled = problem.wall() != nullptr;
  report.line(walled ? "constrained modulus (gauge, platen)" : "Young's modulus (gauge, platen)",
              "{:.2f}, {:.2f} GPa", results.youngs_modulus_gauge() / 1e9,
              results.youngs_modulus_platen() / 1e9);
  if (walled)
    report.line("lateral over axial stress", "{:.3f}", results.lateral_over_axial());
  else
    report.line("Poisson's ratio", "{:.3f}", results.poisson_ratio());
}

void report_damage(Report &report, const Scene &scene, const coupling::Problem &problem,
                   const Results &results) {
  const dem::Model &model = problem.model;
  report.line("broken bonds (tension, shear)", "{}, {} of {}",
              model.broken(dem::BondState::broken_in_tension), model.broken(dem::BondState::broken_in_shear),
              model.bonds ? model.bonds->initial_count() : 0);
  if (problem.bent()) {
    report.line("cracks within d/2 of mid-span", "{:.2f}",
                dem::broken_near_midspan(model.particles, *model.bonds, problem.shape().height));
    return;
  }
  if (problem.shape().kind == dem::ShapeKind::disc) {
    if (!model.bonds) return;
    const dem::SplitPattern s = dem::split_pattern(model.particles, *model.bonds, problem.shape());
    report.line("cracks on the loaded diameter", "{:.2f}, of the first twenty in its middle half {:.2f}",
                s.on_diameter, s.first_in_middle);
    return;
  }
  const Pattern &p = results.pattern();
  if (std::isnan(p.strain) || scene.loading.test == LoadingTest::tension) return;
  report.line("damage at 0.8 of the peak, after it", "top {:.2f}, bottom {:.2f}, middle {:.2f}", p.end_top,
              p.end_bottom, p.middle);
  report.line("end spread, barrel at peak", "{:.2f}, {:.2f}", p.end_spread, results.barrel_at_peak());
}

} // namespace

std::string report_of_run(const Scene &scene, const coupling::Problem &problem, const Results &results,
                          const RunCosts &costs) {
  Report report;
  report_strength(report, scene, problem, results);
  report_stiffness(report, problem, results);
  report_damage(report, scene, problem, results);
  report.line("energy residual over work", "{:.2e}", results.energy_residual_relative());
  report.line("kinetic over internal, to peak", "{:.2e}", results.kinetic_to_internal_max());
  const double crossings = crossings_to_peak(problem, results);
  if (problem.bent())
    report.line("swings of the bar to the peak", "{:.1f}", swings_to_peak(problem, results));
  else
    report.line("wave crossings to the peak", crossings < 100 ? "{:.0f} (fast: 120 are advised)" : "{:.0f}",
                crossings);
  report.line("steps, seconds", "{}, {:.1f} ({:.1f} M bond-steps/s)", problem.steps(), costs.wall_seconds,
              problem.model.bonds && costs.step_seconds > 0
                  ? 1e-6 * static_cast<double>(problem.model.bonds->initial_count()) *
                        static_cast<double>(costs.steps_here) / costs.step_seconds
                  : 0.0);
  return report.text();
}

} // namespace platen::apps
