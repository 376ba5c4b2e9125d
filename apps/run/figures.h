// Figures: what summary.json says of a test between platens, each said once, in its order. A row is the key,
// the unit, what the figure needs, how the screen shows it, which columns of history.csv are its own, and how
// it is computed.
//
// From these rows follow summary.json and its `validity` (summary_of_run.cc; reasons against figures:
// validity.cc), the screen, the entries of section Expect, and what is null in tests of other programs.
// docs/outputs.md, which says what each means, is compared with them (scripts/check_outputs.py). How a figure
// is computed is a generic lambda: it is compiled where a test is asked and not where keys and units are
// listed alone, so that the reader of scenes is linked with nothing of a test.
#pragma once

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "apps/run/figure_list.h"
#include "apps/run/figures_of_failure.h"
#include "apps/run/history.h"
#include "coupling/side.h"

namespace platen::apps {

template <class List>
void list_run(List &list) {
  list.add("effects_off", "", [](auto &t) { return effects_off(t.scene); });
  list.add("ended_by", "", [](auto &t) { return word_or_null(t.costs.ended_by); });
  list.add("test", "", 0, {"test"}, [](auto &t) { return word_of(loading_tests, t.scene.loading.test); });
  list.add("loaded_axis", "", 0, {"loaded along"},
           [](auto &t) { return std::string(1, "xyz"[t.results.axis()]); });
  list.add("particles", "1", of_every_test, [](auto &t) { return t.model.particles.size(); });
  list.add("bonds", "1", of_every_test, [](auto &t) { return t.bonds(); });
  list.add("coordination_number", "1", of_every_test,
           [](auto &t) { return t.problem.coordination_number(); });
  list.add("packing_fraction", "1", of_every_test,
           [](auto &t) { return t.problem.facts().packing_fraction; });
  list.add("mean_radius_m", "m", [](auto &t) { return t.problem.facts().mean_radius; });
  list.where([](auto &t) { return t.tiling.tiles > 0; });
  list.add("tiles", "1", [](auto &t) { return t.tiling.tiles; });
  list.add("tile_period_m", "m", [](auto &t) { return t.tiling.period; });
  list.where(everywhere);
  list.add("section/over", "", [](auto &t) { return t.problem.section_fraction() == 1 ? "nominal" : "net"; });
  list.add("section/area_m2", "m2", [](auto &t) { return t.problem.nominal_area(); });
  list.add("section/filled_mean", "1", [](auto &t) { return t.problem.section().mean; });
  list.add("section/filled_least", "1", [](auto &t) { return t.problem.section().least; });
  list.add("section/filled_largest", "1", [](auto &t) { return t.problem.section().largest; });
  list.add("grain_density_kg_m3", "kg/m3", [](auto &t) { return t.problem.facts().grain_density; });
  list.add("seated_top", "1", [](auto &t) { return t.problem.top().layer().seats(); });
  list.add("seated_bottom", "1", [](auto &t) { return t.problem.bottom().layer().seats(); });
}

template <class List>
void list_costs(List &list) {
  constexpr unsigned cost = of_machine, shared_cost = of_machine | of_every_test;
  list.add("steps", "1", of_every_test, {"steps", "{:.0f}"}, [](auto &t) { return t.problem.steps(); });
  list.add("time_step_s", "s", of_every_test, [](auto &t) { return t.problem.time_step(); });
  list.add("time_step_reason", "", of_every_test, [](auto &t) { return t.problem.time_step_reason(); });
  list.add("instruction_set", "", [](auto &t) { return name(t.model.settings().instruction_set); });
  list.add("threads", "1", shared_cost, [](auto &t) { return t.costs.threads; });
  list.add("wall_seconds", "s", shared_cost, {"seconds", "{:.1f}"},
           [](auto &t) { return t.costs.wall_seconds; });
  list.add("setup_seconds", "s", shared_cost, [](auto &t) { return t.costs.setup_seconds; });
  list.add("particle_steps_per_second", "1/s", shared_cost, {"sphere-steps in a second", "{:.3g} M", 1e-6},
           [](auto &t) { return t.particle_steps_per_second(); });
  list.add("stage_seconds", "", shared_cost, [](auto &t) { return t.stage_seconds(); });
  list.add("peak_memory_bytes", "B", shared_cost, [](auto &t) { return t.peak_memory_bytes(); });
  list.add("bytes_per_particle", "B", cost, [](auto &t) { return t.model.particles.table.bytes_per_row(); });
  list.add("bytes_per_bond", "B", cost, [](auto &t) { return t.bytes_per_bond(); });
  list.add("bytes_in_columns_and_search", "B", cost, [](auto &t) { return t.problem.bytes(); });
}

// Of the history, without a specimen that fails. Null where nothing loads it along its axis.
template <class List>
void list_peak(List &list) {
  list.add("peak_reached", "", history,
           [](auto &t) { return t.is_loaded() ? Json(t.peak.reached()) : Json(); });
  list.add("peak_is", "", history, {"peak"},
           [](auto &t) { return t.is_loaded() ? Json(word_of(t.peak.kind)) : Json(); });
  list.add("peak_time_s", "s", history,
           [](auto &t) { return t.peak.reached() ? t.results.time_at_peak() : not_measured; });
  list.add("fall_time_s", "s", history,
           [](auto &t) { return t.peak.reached() ? t.results.pattern().time : not_measured; });
  list.add("largest_stress_pa", "Pa", history, {"largest stress", "{:.2f} MPa", 1e-6},
           [](auto &t) { return t.results.largest_stress().value; });
  list.add("largest_stress_time_s", "s", history, [](auto &t) { return t.results.largest_stress().time; });
  list.add("stress_at_end_pa", "Pa", history, [](auto &t) { return t.results.stress_at_end(); });
  list.add("strength_pa", "Pa", peak | section | of_every_test, {"strength", "{:.2f} MPa", 1e-6},
           [](auto &t) { return t.results.strength(); });
  list.add("strain_at_peak_platen", "1", peak | closure | strain | of_every_test,
           {"strain at peak (platen)", "{:.5f}"},
           [](auto &t) { return t.results.strain_at_peak(platen_strain(t.results.axis())); });
  list.add("strain_at_peak_gauge", "1", peak | strain | gauge | along_z | of_every_test,
           {"strain at peak (gauge)", "{:.5f}"}, "axial_strain_gauge",
           [](auto &t) { return t.results.strain_at_peak(&Sample::strain_gauge); });
  list.add("consolidation_end_time_s", "s", history, [](auto &t) { return t.results.consolidation_end(); });
}

// Secants at 40 % of the largest stress.
template <class List>
void list_moduli(List &list) {
  list.add("youngs_modulus_gauge_pa", "Pa", youngs | gauge | along_z,
           {"Young's modulus (gauge)", "{:.2f} GPa", 1e-9}, "axial_strain_gauge",
           [](auto &t) { return t.results.secant(&Sample::strain_gauge); });
  list.add("youngs_modulus_platen_pa", "Pa", youngs, {"Young's modulus (platen)", "{:.2f} GPa", 1e-9},
           [](auto &t) { return t.results.secant(platen_strain(t.results.axis())); });
  list.add("poisson_ratio", "1", poissons | gauge | of_every_test, {"Poisson's ratio", "{:.3f}"},
           "axial_strain_gauge lateral_strain",
           [](auto &t) { return t.results.bulging(&Sample::lateral_strain, &Sample::strain_gauge); });
  list.add("poisson_ratio_extremal", "1", poissons, {}, "lateral_strain_extremal axial_strain_extremal",
           [](auto &t) { return t.results.bulging(&Sample::lateral_extremal, &Sample::axial_extremal); });
  list.add("moduli_at_stress_pa", "Pa", history, [](auto &t) { return t.at_modulus.stress; });
  list.add("youngs_modulus_voigt_pa", "Pa", [](auto &t) {
    const double modulus = t.problem.facts().voigt_modulus; // 0 without bonds
    return modulus > 0 ? modulus : not_measured;
  });
}

template <class Test>
double at_largest_load(const Test &t, double Sample::*value) {
  const Sample *largest = t.results.at_largest(&Sample::total_load);
  return largest == nullptr ? not_measured : largest->*value;
}

// Share of the pressure on the specimen that the stress of a wall does not bear at the largest load:
// pressures below a hundredth of the axial stress are not told.
template <class Test>
double inertia_share(const Test &t) {
  const Sample *largest = t.results.at_largest(&Sample::total_load);
  if (largest == nullptr) return not_measured;
  const double pressure = largest->tube_pressure,
               axial = 0.5 * std::abs(largest->stress_top + largest->stress_bottom);
  if (!(pressure > 0.01 * axial)) return not_measured;
  return 1 - largest->tube_hoop / (pressure * t.problem.tube()->hoop_over_pressure());
}

template <class Test>
double at_first_tear(const Test &t, double Sample::*value) {
  const Sample *last = t.results.before_tear();
  return last == nullptr ? not_measured : last->*value;
}

// Of a pressure on the lateral surface, and of a wall that holds it.
template <class List>
void list_cell(List &list) {
  list.where([](auto &t) { return t.problem.cell(); });
  list.add("confining_pressure_pa", "Pa", history, [](auto &t) { return t.results.confining_pressure(); });
  list.add("deviator_strength_pa", "Pa", peak | section, {"deviator at the peak", "{:.2f} MPa", 1e-6},
           [](auto &t) { return t.results.deviator_strength(); });
  list.add("largest_deviator_pa", "Pa", history, {"largest deviator", "{:.2f} MPa", 1e-6},
           [](auto &t) { return t.results.largest_deviator().value; });
  list.add("largest_deviator_time_s", "s", history,
           [](auto &t) { return t.results.largest_deviator().time; });
  list.add("bulk_modulus_pa", "Pa", consolidation | section | gauge, {"bulk modulus", "{:.2f} GPa", 1e-9},
           "volumetric_strain", [](auto &t) { return t.results.bulk_modulus(); });
  list.where([](auto &t) { return t.is_on_path(); });
  list.add("pressure_path_deviation", "1", history, [](auto &t) { return t.path.deviation; });
  list.add("pressure_path_ended_at_strain", "1", history, [](auto &t) { return t.path.ended_at_strain; });
  list.where([](auto &t) { return t.problem.sleeve() != nullptr; });
  list.add("sleeve_elements", "1", [](auto &t) { return t.problem.sleeve()->solid().mesh().cells.size(); });
  list.add("sleeve_seats", "1", [](auto &t) { return t.problem.sleeve()->layer().seats(); });
  list.add("sleeve_steps_of_interval", "1", [](auto &t) { return t.problem.sleeve()->steps_of_interval(); });
  list.add("sleeve_mass_scaling", "1", [](auto &t) { return t.problem.sleeve()->mass_scaling(); });
  list.add("sleeve_interval_cuts", "1", [](auto &t) { return t.problem.sleeve()->cuts(); });
  list.add("sleeve_volumetric_strain", "1", [](auto &t) { return t.problem.sleeve_volumetric_strain(); });
  list.add("sleeve_deviator_pa", "Pa", [](auto &t) { return t.problem.sleeve_deviator(); });
  list.where([](auto &t) { return t.problem.tube() != nullptr; });
  list.add("largest_load_n", "N", history | section, {"largest load on tube and specimen", "{:.1f} kN", 1e-3},
           "total_load_n", [](auto &t) { return at_largest_load(t, &Sample::total_load); });
  list.add("strain_at_largest_load", "1", history, {"strain there (platen)", "{:.5f}"}, "total_load_n",
           [](auto &t) { return at_largest_load(t, &Sample::strain_platen); });
  list.add("tube_load_at_largest_n", "N", history, {"of which on the tube", "{:.1f} kN", 1e-3},
           "total_load_n tube_load_n", [](auto &t) { return at_largest_load(t, &Sample::tube_load); });
  list.add("tube_axial_stress_at_largest_pa", "Pa", history,
           {"axial stress of the tube there", "{:.1f} MPa", 1e-6}, "total_load_n tube_axial_stress_pa",
           [](auto &t) { return at_largest_load(t, &Sample::tube_axial); });
  list.add("tube_hoop_stress_at_largest_pa", "Pa", history,
           {"hoop stress of the tube there", "{:.1f} MPa", 1e-6}, "total_load_n tube_hoop_stress_pa",
           [](auto &t) { return at_largest_load(t, &Sample::tube_hoop); });
  list.add("tube_pressure_at_largest_pa", "Pa", history,
           {"pressure on the specimen there", "{:.2f} MPa", 1e-6}, "total_load_n tube_pressure_pa",
           [](auto &t) { return at_largest_load(t, &Sample::tube_pressure); });
  list.add("tube_inertia_share", "1", history, {}, "total_load_n tube_hoop_stress_pa tube_pressure_pa",
           [](auto &t) { return inertia_share(t); });
  list.where([](auto &t) { return t.problem.tube() != nullptr && t.problem.tube()->yields(); });
  list.add("tube_plastic_work_j", "J", [](auto &t) { return t.problem.tube()->solid().plastic_work(); });
  list.where([](auto &t) { return t.problem.tube() != nullptr && t.problem.tube()->wraps(); });
  list.add("strain_at_first_tear", "1", torn, {"strain at the first tear (platen)", "{:.5f}"},
           "wrap_torn_share", [](auto &t) { return at_first_tear(t, &Sample::strain_platen); });
  list.add("hoop_strain_at_first_tear", "1", torn, {"mean strain of the hoops there", "{:.5f}"},
           "wrap_torn_share wrap_hoop_strain", [](auto &t) { return at_first_tear(t, &Sample::wrap_hoop); });
  list.add("wrap_torn_energy_j", "J", [](auto &t) { return t.problem.tube()->solid().torn_energy(); });
  list.where([](auto &t) { return t.problem.tube() != nullptr && t.problem.tube()->is_bonded(); });
  list.add("tube_bonded_share", "1", [](auto &t) { return t.problem.tube()->layer().bonded_share(); });
  list.where([](auto &t) { return t.problem.skin() != nullptr; });
  list.add("skin_spheres", "1", [](auto &t) { return t.problem.skin()->skin().size(); });
  list.add("skin_coverage", "1", [](auto &t) {
    return t.problem.skin()->skin().coverage(t.model.particles, t.problem.end_planes());
  });
  list.where([](auto &t) { return t.problem.sleeve() != nullptr || t.problem.skin() != nullptr; });
  list.add("confinement_work_j", "J", [](auto &t) {
    return t.problem.sleeve() != nullptr ? t.problem.sleeve()->solid().pressure_work()
                                         : t.problem.skin()->skin().work();
  });
  list.where([](auto &t) { return t.problem.wall() != nullptr; });
  list.add("wall_seats", "1", [](auto &t) { return t.problem.wall()->seats(); });
  list.add("constrained_modulus_pa", "Pa", modulus | section | gauge,
           {"constrained modulus", "{:.2f} GPa", 1e-9}, "axial_strain_gauge",
           [](auto &t) { return t.results.secant(&Sample::strain_gauge); });
  list.add("lateral_over_axial_stress", "1", modulus | section, {"lateral over axial stress", "{:.3f}"},
           [](auto &t) { return t.results.lateral_over_axial(); });
  list.where(everywhere);
}

// Of platens on the sides, and of stages.
template <class List>
void list_sides(List &list) {
  for (const coupling::Side side : coupling::all_sides) {
    list.where([=](auto &t) { return t.presses(side, 2); });
    list.add("seated_sides/" + std::string(coupling::name_of(side)), "1",
             [=](auto &t) { return t.problem.platen(side)->layer().seats(); });
  }
  list.where([](auto &t) { return t.presses_sides(); });
  list.add_object("side_stress_at_peak_pa", peak | section);
  for (const coupling::Side side : coupling::all_sides) {
    list.where([=](auto &t) { return t.presses_sides() && t.presses(side, t.results.axis()); });
    const std::string name = coupling::name_of(side);
    list.add("side_stress_at_peak_pa/" + name, "Pa", 0, {"stress at the peak, " + name, "{:.2f} MPa", 1e-6},
             [=](auto &t) { return t.results.at_peak(stress_of(side)); });
  }
  list.where([](auto &t) { return t.is_staged(); });
  list.add("stages", "", [](auto &t) { return stages_of(t); });
  list.where([](auto &t) { return !t.is_staged(); });
  list.add("controls", "", [](auto &t) { return controls_of(t); });
  list.where(everywhere);
}

// Of a notched bar that is broken through: RILEM 50-FMC (1985), EN 14651.
template <class List>
void list_notch(List &list) {
  constexpr unsigned fracture = peak | ligament | broken_through;
  list.where([](auto &t) { return t.problem.bent(); });
  list.add("net_strength_pa", "Pa", peak | ligament,
           {"flexural strength of the ligament", "{:.2f} MPa", 1e-6}, [](auto &t) {
             const auto bar = t.problem.three_points();
             return t.results.strength() * bar.nominal_area() / bar.net_area();
           });
  list.add("cmod_at_peak_m", "m", peak | ligament, {"mouth opening at peak", "{:.4g} um", 1e6}, "cmod_m",
           [](auto &t) { return t.results.at_peak(&Sample::mouth_opening); });
  list.add("load_at_end_over_peak", "1", peak | ligament, {"load at the end over the peak", "{:.3f}"},
           [](auto &t) { return t.load_at_end_over_peak(); });
  list.add("work_of_fracture_j", "J", fracture, [](auto &t) { return t.work_of_fracture(); });
  list.add("fracture_energy_j_m2", "J/m2", fracture, {"fracture energy", "{:.4g} J/m2"},
           [](auto &t) { return t.work_of_fracture() / t.problem.three_points().ligament_area(); });
  list.add("bond_fracture_energy_j_m2", "J/m2", fracture, {"of it lost in bonds", "{:.4g} J/m2"},
           [](auto &t) { return t.results.lost_in_bonds() / t.problem.three_points().ligament_area(); });
  list.where(everywhere);
}

// Of a disc and of a bent bar, whose stresses are 2 P / (pi D t) and 3 P L / (2 b d^2).
template <class List>
void list_disc_and_bar(List &list) {
  list.where([](auto &t) { return t.is_disc() || t.problem.bent(); });
  list.add("failure_load_n", "N", peak, {"load at failure", "{:.4g} kN", 1e-3},
           [](auto &t) { return t.results.strength() * t.problem.nominal_area(); });
  list.where([](auto &t) { return t.is_disc(); });
  list.add("opening_at_peak_m", "m", peak, {"opening at peak", "{:.4g} um", 1e6}, "opening_m",
           [](auto &t) { return t.results.at_peak(&Sample::opening); });
  list.where([](auto &t) { return t.split.has_value(); });
  list.add("cracks_on_loaded_diameter", "1", 0, {"cracks on the loaded diameter", "{:.2f}"},
           [](auto &t) { return t.split->on_diameter; });
  list.add("cracks_in_middle_of_diameter", "1", [](auto &t) { return t.split->in_middle; });
  list.add("first_cracks_in_middle_of_diameter", "1", 0, {"first cracks in its middle half", "{:.2f}"},
           [](auto &t) { return t.split->first_in_middle; });
  list.where([](auto &t) { return t.problem.bent(); });
  list.add("deflection_at_peak_m", "m", peak, {"deflection at peak", "{:.4g} um", 1e6}, "deflection_m",
           [](auto &t) { return t.results.at_peak(&Sample::deflection); });
  list.add("flexural_modulus_pa", "Pa", modulus | elastic | section | whole_bar,
           {"flexural modulus", "{:.2f} GPa", 1e-9}, "deflection_m",
           [](auto &t) { return t.flexural_modulus(); });
  list.add("shear_over_bending_deflection", "1", whole_bar,
           [](auto &t) { return t.problem.three_points().shear_fraction(t.assumed_poisson_ratio); });
  list.add("moment_over_nominal", "1", peak | section, {"moment at mid-span over PL/4", "{:.3f}"},
           "midspan_moment_n_m", [](auto &t) { return t.moment_over_nominal(); });
  list.add("swings_to_peak", "1", history, {"swings of the bar to the peak", "{:.1f}"},
           [](auto &t) { return t.oscillations_to_peak(); });
  list.add("cracks_near_midspan", "1", 0, {"cracks within d/2 of mid-span", "{:.2f}"},
           [](auto &t) { return t.cracks_near_midspan(); });
  list.where(everywhere);
}

// Bonds, energy, and whether the test was slow enough.
template <class List>
void list_whole_test(List &list) {
  list.add("broken_tension", "1", of_every_test, {"bonds broken in tension", "{:.0f}"},
           [](auto &t) { return t.model.broken(dem::BondState::broken_in_tension); });
  list.add("broken_shear", "1", of_every_test, {"bonds broken in shear", "{:.0f}"},
           [](auto &t) { return t.model.broken(dem::BondState::broken_in_shear); });
  list.add("energy_residual_relative", "1", history | of_every_test, {"energy residual over work", "{:.2e}"},
           [](auto &t) { return t.results.energy_residual_relative(); });
  list.where([](auto &t) { return t.problem.without_inertia(); });
  list.add("platen_unbalanced_work_relative", "1", history, {}, "platen_unbalanced_work_j",
           [](auto &t) { return t.results.platen_unbalanced_work_relative(); });
  list.where([](auto &t) { return t.problem.platens_yield(); });
  list.add("platen_plastic_strain", "1", 0, {"plastic strain of the platens", "{:.2e}"},
           [](auto &t) { return t.problem.platen_plastic_strain(); });
  list.where(everywhere);
  list.add("kinetic_to_internal_max", "1", history | of_every_test,
           {"kinetic over internal, to the peak", "{:.2e}"}, [](auto &t) { return t.slowness.kinetic; });
  list.add("wave_crossings_to_peak", "1", history, {"wave crossings", "{:.0f}"},
           [](auto &t) { return t.slowness.wave_transits; });
  list.add("unbalanced_force_median", "1", history, {"unbalanced over bond forces, median", "{:.2e}"},
           "unbalanced_force_ratio", [](auto &t) { return t.slowness.unbalanced; });
  list.add("inertial_number_max", "1", history, {}, "platen_speed_m_s",
           [](auto &t) { return t.slowness.inertial; });
  list.add("quasi_static", "", history, {}, "unbalanced_force_ratio platen_speed_m_s",
           [](auto &t) { return t.is_slowness_known() ? Json(t.signs_of_haste().empty()) : Json(); });
  list.add("signs_of_haste", "", history, {}, "unbalanced_force_ratio platen_speed_m_s",
           [](auto &t) { return t.signs_of_haste(); });
}

template <class List>
void list_figures(List &list) {
  list_run(list);
  list_costs(list);
  list_peak(list);
  list_moduli(list);
  list_cell(list);
  list_sides(list);
  list_disc_and_bar(list);
  list_notch(list);
  list_whole_test(list);
  list_damage(list);
  for (const bool last : {false, true}) {
    list_dead_zones(list, last);
    list_pattern(list, last);
  }
  list_crack_widths(list);
  list_emission(list);
}

// All rows, without their values.
struct Rows : FigureList<Rows> {
  std::vector<Figure> all;
  template <class Holds>
  void where(Holds) {}
  template <class Value>
  void take(Figure figure, Value) {
    all.push_back(std::move(figure));
  }
};
inline const std::vector<Figure> &figures() {
  static const std::vector<Figure> rows = [] {
    Rows list;
    list_figures(list);
    return std::move(list.all);
  }();
  return rows;
}

} // namespace platen::apps
