#include "apps/run/summary_of_run.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "apps/io/machine.h"
#include "apps/run/problem_setup.h"
#include "apps/scene/version.h"
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

// Between a stiff wall neither Young's modulus nor Poisson's ratio is measured, but these.
void add_wall(Json &to, const coupling::Problem &problem, const Results &results) {
  if (problem.wall() == nullptr) return;
  to["wall_seats"] = problem.wall()->seats();
  to["constrained_modulus_pa"] = results.youngs_modulus_gauge();
  to["lateral_over_axial_stress"] = results.lateral_over_axial();
  for (const char *key :
       {"youngs_modulus_gauge_pa", "youngs_modulus_platen_pa", "poisson_ratio", "poisson_ratio_extremal"})
    to[key] = nullptr;
}

// Of a disc: strength is 2 P / (pi D t); Young's modulus is not measured.
void add_disc(Json &to, const coupling::Problem &problem, const Results &results) {
  if (problem.shape().kind != dem::ShapeKind::disc) return;
  to["failure_load_n"] = results.strength() * problem.shape().cross_section();
  to["opening_at_peak_m"] = results.opening_at_peak();
  for (const char *key :
       {"youngs_modulus_gauge_pa", "youngs_modulus_platen_pa", "poisson_ratio", "poisson_ratio_extremal"})
    to[key] = nullptr;
  if (!problem.model.bonds) return;
  const dem::SplitPattern p =
      dem::split_pattern(problem.model.particles, *problem.model.bonds, problem.shape());
  to["cracks_on_loaded_diameter"] = p.on_diameter;
  to["cracks_in_middle_of_diameter"] = p.in_middle;
  to["first_cracks_in_middle_of_diameter"] = p.first_in_middle;
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

std::string report_of_run(const Scene &scene, const coupling::Problem &problem, const Results &results,
                          const RunCosts &costs) {
  const bool tension = scene.loading.test == LoadingTest::tension;
  const Pattern &p = results.pattern();
  std::string text;
  const auto line = [&](const std::string &what, const std::string &value) {
    text += fmt::format("  {:<36}{}\n", what, value);
  };
  const bool disc = problem.shape().kind == dem::ShapeKind::disc;
  if (disc)
    line("load at failure",
         fmt::format("{:.2f} kN", results.strength() * problem.shape().cross_section() / 1e3));
  line(disc      ? "splitting strength, 2P/(pi D t)"
       : tension ? "tensile strength"
                 : "compressive strength",
       fmt::format("{:.2f} MPa", results.strength() / 1e6));
  if (problem.confinement() != nullptr) {
    line("largest deviator", fmt::format("{:.2f} MPa", results.deviator_strength() / 1e6));
    line("bulk modulus", fmt::format("{:.2f} GPa", results.bulk_modulus() / 1e9));
  }
  line("strain at peak (platen, gauge)",
       fmt::format("{:.5f}, {:.5f}", results.strain_at_peak_platen(), results.strain_at_peak_gauge()));
  const bool walled = problem.wall() != nullptr;
  if (!disc) {
    line(walled ? "constrained modulus (gauge, platen)" : "Young's modulus (gauge, platen)",
         fmt::format("{:.2f}, {:.2f} GPa", results.youngs_modulus_gauge() / 1e9,
                     results.youngs_modulus_platen() / 1e9));
    if (walled)
      line("lateral over axial stress", fmt::format("{:.3f}", results.lateral_over_axial()));
    else
      line("Poisson's ratio", fmt::format("{:.3f}", results.poisson_ratio()));
  }
  line("broken bonds (tension, shear)",
       fmt::format("{}, {} of {}", problem.model.broken(dem::BondState::broken_in_tension),
                   problem.model.broken(dem::BondState::broken_in_shear),
                   problem.model.bonds ? problem.model.bonds->initial_count() : 0));
  if (disc && problem.model.bonds) {
    const dem::SplitPattern s =
        dem::split_pattern(problem.model.particles, *problem.model.bonds, problem.shape());
    line("cracks on the loaded diameter", fmt::format("{:.2f}, of the first twenty in its middle half {:.2f}",
                                                      s.on_diameter, s.first_in_middle));
  }
  if (!std::isnan(p.strain) && !tension && !disc) {
    line("damage at 0.8 of the peak, after it",
         fmt::format("top {:.2f}, bottom {:.2f}, middle {:.2f}", p.end_top, p.end_bottom, p.middle));
    line("end spread, barrel at peak", fmt::format("{:.2f}, {:.2f}", p.end_spread, results.barrel_at_peak()));
  }
  line("energy residual over work", fmt::format("{:.2e}", results.energy_residual_relative()));
  line("kinetic over internal, to peak", fmt::format("{:.2e}", results.kinetic_to_internal_max()));
  const double crossings = crossings_to_peak(problem, results);
  line("wave crossings to the peak",
       fmt::format("{:.0f}{}", crossings, crossings < 100 ? " (fast: 120 are advised)" : ""));
  line("steps, seconds",
       fmt::format("{}, {:.1f} ({:.1f} M bond-steps/s)", problem.steps(), costs.wall_seconds,
                   problem.model.bonds && costs.step_seconds > 0
                       ? 1e-6 * static_cast<double>(problem.model.bonds->initial_count()) *
                             static_cast<double>(costs.steps_here) / costs.step_seconds
                       : 0.0));
  return text;
}

} // namespace platen::apps
