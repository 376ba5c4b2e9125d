#include "apps/run/validity.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "apps/run/at_peak.h"
#include "apps/run/controls.h"
#include "apps/run/failure_summary.h"
#include "apps/run/pressure_path.h"
#include "apps/run/specimen_check.h"
#include "apps/run/summary_of_run.h"
#include "dem/measure/gauge.h"

namespace platen::apps {
namespace {

using Figures = std::vector<const char *>;

const Figures of_strength{"strength_pa",           "deviator_strength_pa",   "failure_load_n",
                          "strain_at_peak_platen", "strain_at_peak_gauge",   "opening_at_peak_m",
                          "deflection_at_peak_m",  "side_stress_at_peak_pa", "barrel_at_peak",
                          "moment_over_nominal"};
const Figures of_gauge{"youngs_modulus_gauge_pa", "poisson_ratio"};
const Figures of_young{"youngs_modulus_gauge_pa", "youngs_modulus_platen_pa", "poisson_ratio",
                       "poisson_ratio_extremal", "flexural_modulus_pa"};
const Figures of_ratio{"poisson_ratio", "poisson_ratio_extremal"};
// With those that a wall has instead.
const Figures of_modulus{"youngs_modulus_gauge_pa",  "youngs_modulus_platen_pa", "poisson_ratio",
                         "poisson_ratio_extremal",   "flexural_modulus_pa",      "constrained_modulus_pa",
                         "lateral_over_axial_stress"};
const Figures of_damage{"end_damage_top", "end_damage_bottom", "worse_end_damage", "middle_damage",
                        "end_spread",     "cone_top",          "cone_bottom",      "pattern"};
const Figures of_cell{"bulk_modulus_pa"};
// Loads over the section of the specimen.
const Figures of_section{"strength_pa",         "deviator_strength_pa",    "side_stress_at_peak_pa",
                         "moment_over_nominal", "youngs_modulus_gauge_pa", "youngs_modulus_platen_pa",
                         "flexural_modulus_pa", "constrained_modulus_pa",  "lateral_over_axial_stress",
                         "bulk_modulus_pa"};

// Nothing in a test is better known than its energy is balanced.
constexpr double most_residual = 0.1; // of the work
// Where both platens do not bear the same, their mean is no stress of the specimen. Oscillations of a slow
// test are a tenth of this.
constexpr double most_unequal = 0.1; // of the mean
// Readings until a figure is read off; between fewer the curve is a guess.
constexpr std::size_t fewest_to_modulus = 3, fewest_to_peak = 8;
// A network of bonds is no stiffer than under affine strain, along the load and not in the mean of
// directions: a lattice has twice that mean along its bonds. Grains that touch without a bond add a little,
// and the middle of a specimen is not its mean.
constexpr double most_over_affine = 1.2;
// Without a peak a modulus is told of an elastic specimen alone. Of the energy in the bonds:
constexpr double most_plastic = 0.01;
// Twelve numbers are fitted to the motion of the gauge's spheres, three of each.
constexpr std::size_t fewest_in_gauge = 12;

bool has_axial_stage(const Results &results) {
  return std::any_of(results.samples().begin(), results.samples().end(),
                     [](const Sample &s) { return s.axial_stage != 0; });
}

void judge_strength(Validity &of, const coupling::PlatenTest &problem, const Results &results) {
  if (!has_axial_stage(results)) {
    of.add(of_strength, "the test has no stage that loads the specimen along its axis");
    return;
  }
  if (!results.is_ever_loaded_on())
    of.add(of_strength,
           "no stage drives the loaded axis on, or asks it for more stress, while the other sides "
           "are asked the same: its largest stress is no strength");
  else if (const std::string words = words_against(results.peak()); !words.empty()) {
    of.add(of_strength, words);
    if (results.goes_on_by_command())
      of.add(of_strength,
             "what comes after the largest deviator under loading comes by command: a stage holds, "
             "unloads, follows a share, lowers a stress or changes the sides");
  }
  if (problem.settings().loading.start_strain > 0) return; // the way to it is solved for, without readings
  if (const std::size_t n = results.readings_to_peak(); n > 0 && n < fewest_to_peak)
    of.add(of_strength, fmt::format("{} readings before the peak, {} at least: a smaller Output/Every", n,
                                    fewest_to_peak));
}

void judge_shared_load(Validity &of, const Results &results) {
  const auto check = [&](const Figures &figures, double unequal, const char *where) {
    if (unequal > most_unequal)
      of.add(figures,
             fmt::format("the stresses of both platens differ by {:.0f} % of their mean {}, {:.0f} % at "
                         "most: too fast to be one stress",
                         100 * unequal, where, 100 * most_unequal));
  };
  check(of_strength, results.unequal_at_peak(), "at the peak");
  check(of_modulus, results.unequal_at_modulus(), "at 40 % of the peak");
}

void judge_residual(Validity &of, const Results &results) {
  const double residual = results.energy_residual_relative();
  if (!(residual > most_residual)) return;
  const std::string reason = fmt::format("the energy balance leaves {:.0f} % of the work, {:.0f} % at most",
                                         100 * residual, 100 * most_residual);
  for (const Figures *all : {&of_strength, &of_modulus, &of_damage})
    of.add(*all, reason);
}

// Stresses, pressures and a path that were asked are part of what a figure says.
void judge_controls(Validity &of, const coupling::PlatenTest &problem, const Results &results) {
  const auto check = [&](const Figures &figures, double time) {
    for (const std::string &reason : controls_against(problem, results, time))
      of.add(figures, reason);
    if (const std::string reason = confinement_against(results, time); !reason.empty())
      of.add(figures, reason);
  };
  check(of_strength, results.time_at_peak());
  check(of_modulus, results.modulus_state().time);
  check(of_damage, results.pattern().time);
  check(of_cell, results.consolidation_end());
  if (const double off = pressure_path(problem, results).deviation; off > most_off_path)
    of.add(of_strength,
           fmt::format("the pressure was {:.1f} % off its path before the peak, {:.0f} % at most", 100 * off,
                       100 * most_off_path));
}

// Figures that rest on single columns, or none.
const std::vector<std::pair<std::string, Figures>> of_column{
    {"axial_strain_gauge",
     {"youngs_modulus_gauge_pa", "poisson_ratio", "strain_at_peak_gauge", "constrained_modulus_pa"}},
    {"lateral_strain", {"poisson_ratio"}},
    {"volumetric_strain", of_cell},
    {"lateral_strain_extremal", {"poisson_ratio_extremal"}},
    {"axial_strain_extremal", {"poisson_ratio_extremal"}},
    {"unbalanced_force_ratio", {"unbalanced_force_median", "quasi_static", "signs_of_haste"}},
    {"platen_speed_m_s", {"inertial_number_max", "quasi_static", "signs_of_haste"}},
    {"opening_m", {"opening_at_peak_m"}},
    {"deflection_m", {"deflection_at_peak_m", "flexural_modulus_pa"}},
    {"midspan_moment_n_m", {"moment_over_nominal"}},
    {"platen_unbalanced_work_j", {"platen_unbalanced_work_relative"}},
    {"time_step_s", {}},
    {"grain_contacts", {}},
    {"volumetric_strain_sleeve", {}},
    {"sleeve_deviator_pa", {}},
    {"stage", {}}};
// On all others every figure that is read off the history: its peak, from which the rest is counted, would be
// another, or its energy balance is not known.
const Figures of_history{"peak_reached",
                         "peak_is",
                         "peak_time_s",
                         "fall_time_s",
                         "largest_stress_pa",
                         "largest_stress_time_s",
                         "largest_deviator_pa",
                         "largest_deviator_time_s",
                         "stress_at_end_pa",
                         "confining_pressure_pa",
                         "consolidation_end_time_s",
                         "moduli_at_stress_pa",
                         "pressure_path_deviation",
                         "pressure_path_ended_at_strain",
                         "platen_unbalanced_work_relative",
                         "energy_residual_relative",
                         "kinetic_to_internal_max",
                         "wave_crossings_to_peak",
                         "swings_to_peak",
                         "unbalanced_force_median",
                         "inertial_number_max",
                         "quasi_static",
                         "signs_of_haste"};

// s, of the first sample with a number in that column that is not finite though the test measures it. A
// column without spheres is missing in all samples; bonds bear forces from a tenth of the peak on.
std::optional<double> first_fault(std::size_t column, const coupling::PlatenTest &problem,
                                  const Results &results) {
  using Missing = HistoryColumn::Missing;
  const HistoryColumn &of = history_columns()[column];
  const std::vector<Sample> samples =
      of.missing == Missing::without_forces ? results.rise() : results.samples();
  std::optional<double> first;
  std::size_t missing = 0;
  for (Sample s : samples) {
    const double value = value_of(s, column);
    const bool bears = of.missing == Missing::without_forces && s.intact_bonds > 0;
    const bool may = may_be(value, of, problem) && !(bears && std::isnan(value));
    missing += may && !std::isfinite(value);
    const bool lacks = (of.missing == Missing::without_spheres && !std::isfinite(value)) ||
                       (of.missing == Missing::without_pressure && s.cell_pressure > 0 && std::isnan(value));
    if ((!may || lacks) && !first) first = s.time;
  }
  return of.missing == Missing::without_spheres && missing == samples.size() ? std::nullopt : first;
}

// What passes over a number that is not finite tells a figure that nobody has measured.
void judge_numbers(Validity &of, const coupling::PlatenTest &problem, const Results &results) {
  for (std::size_t k = 0; k < history_columns().size(); ++k) {
    const HistoryColumn &column = history_columns()[k];
    if (column.member == nullptr || !is_there(column, &problem)) continue; // no figure rests on the former
    const std::optional<double> since = first_fault(k, problem, results);
    if (!since) continue;
    const std::string reason = fmt::format(
        "the history has a number that is not finite in {} at the time {:.6g} s", column.name, *since);
    const auto found = std::find_if(of_column.begin(), of_column.end(),
                                    [&](const auto &one) { return one.first == column.name; });
    if (found != of_column.end()) {
      of.add(found->second, reason);
      continue;
    }
    for (const Figures *all : {&of_strength, &of_modulus, &of_damage, &of_cell, &of_history})
      of.add(*all, reason);
  }
}

// What a test says nothing of.
void judge_kind_of_test(Validity &of, const coupling::PlatenTest &problem, const Results &results) {
  if (problem.shape().kind == dem::ShapeKind::disc) {
    of.add(of_young, "the stress in a disc is not even: a splitting test has no modulus");
    of.add({"strain_at_peak_platen"},
           "closure over the diameter is no strain of the material: opening_at_peak_m");
  } else if (problem.bent()) {
    of.add({"youngs_modulus_gauge_pa", "youngs_modulus_platen_pa", "poisson_ratio", "poisson_ratio_extremal"},
           "the stress in a bent bar is not even: its modulus is flexural_modulus_pa");
    of.add({"strain_at_peak_platen", "strain_at_peak_gauge"},
           "closure over the depth is no strain of the material: deflection_at_peak_m");
  } else if (problem.settings().loading.cell && problem.settings().loading.cell->path != 0)
    of.add(of_young,
           "the pressure changes along its path: the ratio of stress and strain is no Young's modulus");
  else if (problem.wall() != nullptr)
    of.add(of_young, "a wall holds the sides: the ratio of stress and strain is constrained_modulus_pa");
  else if (!further_sides(problem).empty())
    of.add(of_young, "platens hold the sides: the ratio of stress and strain is no Young's modulus");
  if (results.axis() != 2)
    of.add({"strain_at_peak_gauge", "youngs_modulus_gauge_pa", "poisson_ratio", "barrel_at_peak"},
           "the gauge is of tests along z");
}

void judge_moduli(Validity &of, const coupling::PlatenTest &problem, const Results &results) {
  if (!has_axial_stage(results)) {
    of.add(of_modulus, "the test has no stage that loads the specimen along its axis");
    return;
  }
  const ModulusState at = results.modulus_state();
  if (!at.found) {
    of.add(of_modulus, "the specimen bore nothing");
    return;
  }
  if (problem.settings().loading.start_strain == 0 && at.readings < fewest_to_modulus)
    of.add(of_modulus, fmt::format("{} readings before 40 % of the largest stress, {} at least: a smaller "
                                   "Output/Every",
                                   at.readings, fewest_to_modulus));
  if (!at.loaded_on)
    of.add(of_modulus,
           "at 40 % of the largest stress the specimen was not loaded on, or its sides were asked "
           "something else than where the strains begin");
  if (results.peak().reached()) return;
  if (at.broken > 0)
    of.add(of_young, fmt::format("no peak was reached, and at 40 % of the largest stress {:.0f} bonds had "
                                 "broken: the ratio is not of the sound specimen",
                                 at.broken));
  if (at.plastic_share > most_plastic)
    of.add(of_young, fmt::format("no peak was reached, and at 40 % of the largest stress bonds had yielded: "
                                 "plastic work is {:.2g} of their energy, {:g} at most",
                                 at.plastic_share, most_plastic));
}

void judge_gauge(Validity &of, const coupling::PlatenTest &problem) {
  const dem::Gauge gauge(problem.model.particles, problem.shape(), problem.model.bonds.get());
  if (gauge.size() < fewest_in_gauge)
    of.add({"youngs_modulus_gauge_pa", "poisson_ratio", "strain_at_peak_gauge", "constrained_modulus_pa",
            "bulk_modulus_pa"},
           fmt::format("{} spheres in the middle half of the specimen, {} at least", gauge.size(),
                       fewest_in_gauge));
}

// What no elastic specimen has, whatever the reason.
void judge_values(Validity &of, const coupling::PlatenTest &problem, const Results &results) {
  const double most = problem.facts().affine_moduli[static_cast<std::size_t>(results.axis())];
  const auto modulus = [&](const char *figure, double value) {
    if (std::isnan(value) || !of.holds(figure)) return;
    if (!std::isfinite(value) || value <= 0)
      of.add({figure}, fmt::format("{:.3g} GPa: no modulus of a solid", 1e-9 * value));
    else if (most > 0 && value > most_over_affine * most)
      of.add({figure}, fmt::format("{:.3g} GPa is more than the bonds can have along the load, {:.3g} GPa by "
                                   "affine strain (Voigt's bound)",
                                   1e-9 * value, 1e-9 * most));
  };
  modulus("youngs_modulus_gauge_pa", results.youngs_modulus_gauge());
  modulus("youngs_modulus_platen_pa", results.youngs_modulus_platen());
  const auto ratio = [&](const char *figure, double value) {
    if (of.holds(figure) && !std::isnan(value) && !(value > -1 && value <= 0.5))
      of.add({figure}, fmt::format("{:.3g}: an elastic specimen has -1 to 0.5", value));
  };
  ratio("poisson_ratio", results.poisson_ratio());
  ratio("poisson_ratio_extremal", results.poisson_ratio_extremal());
  if (problem.cell() && of.holds("bulk_modulus_pa") && results.bulk_modulus() <= 0)
    of.add({"bulk_modulus_pa"},
           fmt::format("{:.3g} GPa: no modulus of a solid", 1e-9 * results.bulk_modulus()));
}

void judge_damage(Validity &of, const Scene &scene, const coupling::PlatenTest &problem,
                  const Results &results) {
  if (!tells_pattern(scene, problem)) {
    of.add({"end_spread", "cone_top", "cone_bottom", "pattern"},
           "ends and cones are told of cylinders and boxes that are compressed along z");
    return;
  }
  if (std::isnan(results.pattern().time) || !results.peak().reached()) {
    of.add(of_damage, "the stress has not fallen to 0.8 of its peak");
    return;
  }
  const auto cone = [&](const char *figure, const dem::DeadZone &zone) {
    if (!zone.is_cone()) of.add({figure}, cone_words(zone));
  };
  cone("cone_top", results.pattern().failure.dead[dem::top_end]);
  cone("cone_bottom", results.pattern().failure.dead[dem::bottom_end]);
}

// Bonds that were found without any test of this kind say nothing about their material in it: neither what it
// bears nor how it breaks.
void judge_calibration(Validity &of, const Scene &scene, const coupling::PlatenTest &problem) {
  using Figure = CalibratedFigure;
  const CalibratedFor &bonds = scene.bond.calibrated;
  const auto check = [&](const Figures &figures, Figure needed) {
    if (const std::string reason = bonds.against(needed); !reason.empty()) of.add(figures, reason);
  };
  check(of_modulus, Figure::elastic);
  const LoadingTest test = scene.loading.test;
  const bool tension =
      test == LoadingTest::tension || problem.bent() || problem.shape().kind == dem::ShapeKind::disc;
  if (!tension) check(of_ratio, Figure::secant_ratio);
  const bool confined = problem.cell() || problem.wall() != nullptr || !further_sides(problem).empty();
  for (const Figures *figures : {&of_strength, &of_damage}) {
    check(*figures, tension ? Figure::tension : Figure::compression);
    if (!tension && confined) check(*figures, Figure::confined);
  }
}

void judge_section(Validity &of, const coupling::PlatenTest &problem) {
  const dem::SolidSection &section = problem.section();
  if (section.fills() || problem.section_share() != 1) return;
  of.add(of_section,
         "the spheres and their pores fill " + text_of(section) +
             ": a stress over the nominal section is not that of the material" +
             (section.same_at_all_heights() ? ". Specimen/Section = net divides by what is filled" : ""));
}

// What summary.json says the validity of, in this order.
const Figures headline{"strength_pa",
                       "deviator_strength_pa",
                       "failure_load_n",
                       "strain_at_peak_platen",
                       "strain_at_peak_gauge",
                       "opening_at_peak_m",
                       "deflection_at_peak_m",
                       "youngs_modulus_gauge_pa",
                       "youngs_modulus_platen_pa",
                       "poisson_ratio",
                       "poisson_ratio_extremal",
                       "bulk_modulus_pa",
                       "constrained_modulus_pa",
                       "lateral_over_axial_stress",
                       "flexural_modulus_pa",
                       "side_stress_at_peak_pa",
                       "barrel_at_peak",
                       "end_damage_top",
                       "end_damage_bottom",
                       "worse_end_damage",
                       "middle_damage",
                       "end_spread",
                       "pattern",
                       "cone_top",
                       "cone_bottom"};

bool is_missing(const Json &value) {
  return value.is_null() || (value.is_number_float() && !std::isfinite(value.get<double>()));
}

} // namespace

void Validity::add(const std::vector<const char *> &figures, const std::string &reason) {
  for (const char *figure : figures)
    reasons_[figure].push_back(reason);
}

const std::vector<std::string> &Validity::reasons(const std::string &figure) const {
  static const std::vector<std::string> none;
  const auto found = reasons_.find(figure);
  return found == reasons_.end() ? none : found->second;
}

void Validity::complete(Json &summary) const {
  for (const auto &[figure, reasons] : reasons_)
    if (summary.contains(figure)) summary[figure] = nullptr;
  Json validity = Json::object();
  for (const char *figure : headline) {
    if (!summary.contains(figure)) continue;
    if (!holds(figure))
      validity[figure] = reasons(figure);
    else if (is_missing(summary[figure]))
      validity[figure] = Json::array({"not measured by this test"});
    else
      validity[figure] = "valid";
  }
  summary["validity"] = validity;
}

Validity judge(const Scene &scene, const coupling::PlatenTest &problem, const Results &results) {
  Validity of;
  judge_numbers(of, problem, results);
  judge_kind_of_test(of, problem, results);
  judge_section(of, problem);
  judge_calibration(of, scene, problem);
  judge_strength(of, problem, results);
  judge_moduli(of, problem, results);
  judge_shared_load(of, results);
  judge_residual(of, results);
  judge_controls(of, problem, results);
  judge_gauge(of, problem);
  judge_values(of, problem, results);
  judge_damage(of, scene, problem, results);
  return of;
}

} // namespace platen::apps
