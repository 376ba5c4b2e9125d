#include "apps/run/summary_of_run.h"

#include <cmath>

#include "apps/output/machine.h"
#include "apps/run/app_output.h"
#include "apps/run/at_peak.h"
#include "apps/run/controls.h"
#include "apps/run/failure_summary.h"
#include "apps/run/pressure_path.h"
#include "apps/run/problem_setup.h"
#include "apps/run/quasi_static.h"
#include "apps/run/specimen_setup.h"
#include "apps/run/stages_of_run.h"
#include "apps/run/validity.h"
#include "dem/measure/damage.h"
#include "dem/measure/fragments.h"
#include "dem/measure/gauge.h"

namespace platen::apps {
namespace {

// What stresses are over, and how much of the shape's section is filled by height.
Json figures_of_section(const coupling::PlatenTest &problem) {
  const dem::SolidSection &section = problem.section();
  Json json;
  json["over"] = problem.section_share() == 1 ? "nominal" : "net";
  json["area_m2"] = problem.nominal_area();
  json["filled_mean"] = section.mean, json["filled_least"] = section.least;
  json["filled_largest"] = section.largest;
  return json;
}

Json stage_seconds(const dem::StageClock &clock) {
  Json stages;
  for (int k = 0; k < dem::stage_count; ++k)
    stages[dem::stage_names[static_cast<std::size_t>(k)]] = clock.seconds(static_cast<dem::Stage>(k));
  return stages;
}

void add_pattern(Json &to, const char *prefix, const Pattern &p) {
  const std::string start = prefix;
  to[start + "end_damage_top"] = p.failure.damage.end_top;
  to[start + "end_damage_bottom"] = p.failure.damage.end_bottom;
  to[start + "worse_end_damage"] = p.failure.damage.worse_end();
  to[start + "middle_damage"] = p.failure.damage.middle;
  to[start + "end_spread"] = p.failure.end_spread;
}

// Of a pressure on the lateral surface: where it acts, and what the hydrostatic stage says. The largest
// deviator may be another than that at the peak where the pressure changes or a stage holds the platens.
void add_cell(Json &to, const coupling::PlatenTest &problem, const Results &results) {
  if (!problem.cell()) return;
  const LargestReading deviator = results.largest_deviator();
  to["confining_pressure_pa"] = results.confining_pressure();
  to["deviator_strength_pa"] = results.deviator_strength();
  to["largest_deviator_pa"] = deviator.value;
  to["largest_deviator_time_s"] = deviator.time;
  to["bulk_modulus_pa"] = results.bulk_modulus();
  if (problem.settings().loading.cell->path != 0) {
    const PressurePath path = pressure_path(problem, results);
    to["pressure_path_deviation"] = path.deviation;
    to["pressure_path_ended_at_strain"] = path.ended_at_strain;
  }
  if (const coupling::Sleeve *sleeve = problem.sleeve()) {
    to["sleeve_elements"] = sleeve->solid().mesh().cells.size();
    to["sleeve_seats"] = sleeve->layer().seats();
    to["sleeve_steps_of_interval"] = sleeve->steps_of_interval();
    to["sleeve_mass_scaling"] = sleeve->mass_scaling();
    to["sleeve_interval_cuts"] = sleeve->cuts();
    to["sleeve_volumetric_strain"] = problem.sleeve_volumetric_strain();
    to["sleeve_deviator_pa"] = problem.sleeve_deviator();
    to["confinement_work_j"] = sleeve->solid().pressure_work();
  }
  if (problem.skin() == nullptr) return;
  const dem::Confinement &skin = problem.skin()->skin();
  to["skin_spheres"] = skin.size();
  to["skin_coverage"] = skin.coverage(problem.model.particles, problem.end_planes());
  to["confinement_work_j"] = skin.work();
}

// What a test says nothing of.
void withdraw_moduli(Json &to) {
  for (const char *key :
       {"youngs_modulus_gauge_pa", "youngs_modulus_platen_pa", "poisson_ratio", "poisson_ratio_extremal"})
    to[key] = nullptr;
}

// Between a stiff wall neither Young's modulus nor Poisson's ratio is measured, but these.
void add_wall(Json &to, const coupling::PlatenTest &problem, const Results &results) {
  if (problem.wall() == nullptr) return;
  to["wall_seats"] = problem.wall()->seats();
  to["constrained_modulus_pa"] = results.youngs_modulus_gauge();
  to["lateral_over_axial_stress"] = results.lateral_over_axial();
  withdraw_moduli(to);
}

// Platens hold the sides: what a bare test calls Young's modulus and Poisson's ratio is neither.
void add_sides(Json &to, const coupling::PlatenTest &problem, const Results &results) {
  const std::vector<coupling::Side> sides = further_sides(problem);
  if (sides.empty()) return;
  Json seats, stresses;
  for (const coupling::Side side : sides)
    seats[coupling::name_of(side)] = problem.platen(side)->layer().seats();
  for (const coupling::Side side : further_sides(problem, results.axis()))
    stresses[coupling::name_of(side)] = results.side_stress_at_peak(side);
  to["seated_sides"] = seats;
  to["side_stress_at_peak_pa"] = stresses;
  withdraw_moduli(to);
}

// Of a disc: strength is 2 P / (pi D t); Young's modulus is not measured.
void add_disc(Json &to, const coupling::PlatenTest &problem, const Results &results) {
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

// Of a bent bar: stresses are 3 P L / (2 b d^2); what is true of the moduli is in the deflection.
void add_bar(Json &to, const coupling::PlatenTest &problem, const Results &results) {
  if (!problem.bent()) return;
  to["failure_load_n"] = results.strength() * problem.nominal_area();
  to["deflection_at_peak_m"] = results.deflection_at_peak();
  to["flexural_modulus_pa"] = flexural_modulus(problem, results);
  to["shear_over_bending_deflection"] = problem.three_points().shear_share(assumed_poisson_ratio);
  to["moment_over_nominal"] = moment_over_nominal(problem, results);
  to["swings_to_peak"] = oscillations_to_peak(problem, results);
  to["cracks_near_midspan"] =
      dem::broken_near_midspan(problem.model.particles, *problem.model.bonds, problem.shape().height);
  withdraw_moduli(to);
}

// Null where nothing loads the specimen along its axis.
void add_peak(Json &to, const Results &results) {
  const PeakOfCurve peak = results.peak();
  const LargestReading largest = results.largest_stress();
  const bool loaded = results.largest_deviator().value > 0;
  to["peak_reached"] = loaded ? Json(peak.reached()) : Json();
  to["peak_is"] = !loaded                          ? Json()
                  : peak.kind == PeakKind::fallen  ? Json("fallen")
                  : peak.kind == PeakKind::plateau ? Json("plateau")
                                                   : Json("not reached");
  to["peak_time_s"] = peak.reached() ? results.time_at_peak() : not_measured;
  to["fall_time_s"] = peak.reached() ? results.pattern().time : not_measured;
  to["largest_stress_pa"] = largest.value;
  to["largest_stress_time_s"] = largest.time;
  to["stress_at_end_pa"] = results.stress_at_end();
}

// Of a run that was stopped before its peak nothing is told: the way to it is not known.
void add_slowness(Json &to, const coupling::PlatenTest &problem, const Results &results,
                  const RunCosts &costs) {
  const Slowness slow = slowness(problem, results);
  to["unbalanced_force_median"] = slow.unbalanced;
  to["inertial_number_max"] = slow.inertial;
  const bool told = knows_slowness(results, costs.ended_by) &&
                    (!std::isnan(slow.kinetic) || !std::isnan(slow.wave_transits));
  const std::vector<std::string> reasons =
      told ? reasons_not_quasi_static(slow, problem.bent()) : std::vector<std::string>{};
  to["quasi_static"] = told ? Json(reasons.empty()) : Json();
  to["signs_of_haste"] = reasons;
}

} // namespace

const char *app_of(const coupling::PlatenTest &problem) {
  return problem.shape().kind == dem::ShapeKind::disc ? "platen-brazilian" : "platen-compress";
}

std::vector<coupling::Side> further_sides(const coupling::PlatenTest &problem, int axis) {
  std::vector<coupling::Side> sides;
  for (const coupling::Side side : coupling::all_sides)
    if (coupling::axis_of(side) != axis && problem.platen(side) != nullptr) sides.push_back(side);
  return sides;
}

std::size_t bytes_per_bond(const dem::Model &model) {
  if (!model.bonds) return 0;
  const dem::Bonds &b = *model.bonds;
  return b.table.bytes_per_row() + b.records.bytes_per_row() + sizeof(b.blocks.ends[0]);
}

Json summary_of_run(const std::string &status, const Scene &scene, const coupling::PlatenTest &problem,
                    const Results &results, const RunCosts &costs) {
  const dem::Model &model = problem.model;
  const double particles = static_cast<double>(model.particles.size());
  Json s = summary_head(scene, app_of(problem), status, effects_on(scene));
  s["effects_off"] = effects_off(scene);
  s["ended_by"] = costs.ended_by.empty() ? Json() : Json(costs.ended_by);
  s["test"] = word_of(loading_tests, scene.loading.test);
  s["loaded_axis"] = std::string(1, "xyz"[results.axis()]);
  s["particles"] = model.particles.size();
  s["bonds"] = model.bonds ? model.bonds->initial_count() : 0;
  s["coordination_number"] = problem.coordination_number();
  s["packing_fraction"] = problem.facts().packing_fraction;
  s["mean_radius_m"] = problem.facts().mean_radius;
  if (const Tiling tiling = tiling_of(scene, problem.shape()); tiling.tiles > 0) {
    s["tiles"] = tiling.tiles;
    s["tile_period_m"] = tiling.period;
  }
  s["section"] = figures_of_section(problem);
  s["grain_density_kg_m3"] = problem.facts().grain_density;
  s["seated_top"] = problem.top().layer().seats();
  s["seated_bottom"] = problem.bottom().layer().seats();
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
  add_peak(s, results);
  s["strength_pa"] = results.strength();
  s["strain_at_peak_platen"] = results.strain_at_peak_platen();
  s["strain_at_peak_gauge"] = results.strain_at_peak_gauge();
  s["consolidation_end_time_s"] = results.consolidation_end();
  s["youngs_modulus_gauge_pa"] = results.youngs_modulus_gauge();
  s["youngs_modulus_platen_pa"] = results.youngs_modulus_platen();
  s["poisson_ratio"] = results.poisson_ratio();
  s["poisson_ratio_extremal"] = results.poisson_ratio_extremal();
  s["moduli_at_stress_pa"] = results.modulus_state().stress;
  s["youngs_modulus_voigt_pa"] =
      problem.facts().voigt_modulus > 0 ? problem.facts().voigt_modulus : not_measured;
  add_cell(s, problem, results);
  add_wall(s, problem, results);
  add_sides(s, problem, results);
  add_stages(s, scene, problem, results);
  add_controls(s, problem);
  add_disc(s, problem, results);
  add_bar(s, problem, results);
  s["broken_tension"] = model.broken(dem::BondState::broken_in_tension);
  s["broken_shear"] = model.broken(dem::BondState::broken_in_shear);
  s["energy_residual_relative"] = results.energy_residual_relative();
  if (problem.without_inertia())
    s["platen_unbalanced_work_relative"] = results.platen_unbalanced_work_relative();
  s["kinetic_to_internal_max"] = results.kinetic_to_internal_max();
  s["wave_crossings_to_peak"] = wave_transits_to_peak(problem, results);
  add_slowness(s, problem, results, costs);
  add_pattern(s, "", results.pattern());
  add_pattern(s, "final_", results.last_pattern());
  s["barrel_at_peak"] = results.barrel_at_peak();
  const dem::Fragments fragments = dem::find_fragments(model.particles, model.bonds.get());
  s["fragments"] = fragments.count;
  s["loose_particles"] = fragments.single;
  add_failure(s, scene, problem, results);
  judge(scene, problem, results).complete(s);
  return s;
}

} // namespace platen::apps
