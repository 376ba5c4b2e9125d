#include "apps/run/validity.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "apps/run/specimen_check.h"
#include "dem/measure/gauge.h"

namespace platen::apps {
namespace {

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
// Without a peak only an elastic specimen has a modulus. Of the energy in the bonds:
constexpr double most_plastic = 0.01;
// A tail that falls as the square of the way has P w left at its end (Elices, Guinea and Planas 1992): at
// five times the way to the peak this share of the load is an eighth of the work.
constexpr double most_load_at_end = 0.05; // of the peak
// Twelve numbers are fitted to the motion of the gauge's spheres, three of each.
constexpr std::size_t fewest_in_gauge = 12;

using Words = std::vector<std::string>;
using Test = const TestRecord &;

Words when(bool holds, const std::string &reason) {
  return holds ? Words{reason} : Words{};
}

// What a test says nothing of.
Words against_bare(Test t) {
  if (t.is_disc()) return {"the stress in a disc is not even: a splitting test has no modulus"};
  if (t.problem.bent()) return {"the stress in a bent bar is not even: its modulus is flexural_modulus_pa"};
  if (t.is_on_path())
    return {"the pressure changes along its path: the ratio of stress and strain is no Young's modulus"};
  if (t.problem.wall() != nullptr)
    return {"a wall holds the sides: the ratio of stress and strain is constrained_modulus_pa"};
  if (t.problem.tube() != nullptr)
    return {"a tube or a wrap holds the sides: the ratio of stress and strain is no Young's modulus"};
  return when(t.presses_sides(),
              "platens hold the sides: the ratio of stress and strain is no Young's modulus");
}

Words against_section(Test t) {
  const dem::SolidSection &section = t.problem.section();
  if (section.fills() || t.problem.section_fraction() != 1) return {};
  return {"the spheres and their pores fill " + text_of(section) +
          ": a stress over the nominal section is not that of the material" +
          (section.same_at_all_heights() ? ". Specimen/Section = net divides by what is filled" : "")};
}

// Bonds that were found without any test of this kind say nothing about their material in it: neither what it
// bears nor how it breaks.
Words against_bonds(Test t, bool holds, CalibratedFigure needed) {
  const std::string reason = t.scene.bond.calibrated.against(needed);
  return when(holds && !reason.empty(), reason);
}
bool is_confined(Test t) {
  return t.problem.cell() || t.problem.wall() != nullptr || t.problem.tube() != nullptr || t.presses_sides();
}

constexpr const char *no_axial_stage = "the test has no stage that loads the specimen along its axis";

Words against_peak(Test t) {
  if (!t.results.has_axial_stage()) return {no_axial_stage};
  if (!t.results.is_ever_loaded_on())
    return {
        "no stage drives the loaded axis on, or asks it for more stress, while the other sides are asked the "
        "same: its largest stress is no strength"};
  const std::string words = words_against(t.peak);
  if (words.empty()) return {};
  if (!t.results.goes_on_by_command()) return {words};
  return {words,
          "what comes after the largest deviator under loading comes by command: a stage holds, unloads, "
          "follows a share, lowers a stress or changes the sides"};
}

// None where the way to the peak is solved for, without readings.
Words against_readings_to_peak(Test t) {
  const std::size_t n = t.results.readings_to_peak();
  return when(
      t.problem.settings().loading.start_strain == 0 && n > 0 && n < fewest_to_peak,
      fmt::format("{} readings before the peak, {} at least: a smaller Output/Every", n, fewest_to_peak));
}

Words against_modulus(Test t) {
  if (!t.results.has_axial_stage()) return {no_axial_stage};
  if (!t.at_modulus.found) return {"the specimen bore nothing"};
  Words words;
  if (t.problem.settings().loading.start_strain == 0 && t.at_modulus.readings < fewest_to_modulus)
    words.push_back(
        fmt::format("{} readings before 40 % of the largest stress, {} at least: a smaller Output/Every",
                    t.at_modulus.readings, fewest_to_modulus));
  if (!t.at_modulus.loaded_on)
    words.push_back(
        "at 40 % of the largest stress the specimen was not loaded on, or its sides were asked something "
        "else "
        "than where the strains begin");
  return words;
}

Words against_elastic(Test t) {
  const ModulusState &at = t.at_modulus;
  if (t.peak.reached()) return {};
  Words words =
      when(at.broken > 0,
           fmt::format("no peak was reached, and at 40 % of the largest stress {:.0f} bonds had broken: "
                       "the ratio is not of the intact specimen",
                       at.broken));
  if (at.plastic_share > most_plastic)
    words.push_back(
        fmt::format("no peak was reached, and at 40 % of the largest stress bonds had yielded: "
                    "plastic work is {:.2g} of their energy, {:g} at most",
                    at.plastic_share, most_plastic));
  return words;
}

Words against_shared_load(double unequal, const char *where) {
  return when(
      unequal > most_unequal,
      fmt::format("the stresses of both platens differ by {:.0f} % of their mean {}, {:.0f} % at most: too "
                  "fast to be one stress",
                  100 * unequal, where, 100 * most_unequal));
}

Words against_recess(Test t) {
  return when(
      t.problem.tube() != nullptr && t.problem.settings().loading.tube->recess > 0,
      "the specimen stands off a platen (Sleeve/Recess): what the platens press is no strength of it");
}

Words against_residual(Test t) {
  const double residual = t.results.energy_residual_relative();
  return when(residual > most_residual,
              fmt::format("the energy balance leaves {:.0f} % of the work, {:.0f} % at most", 100 * residual,
                          100 * most_residual));
}

// Stresses, pressures and a path that were asked are part of what a figure says.
Words against_controls(Test t, double time) {
  Words words = controls_against(t.problem, t.results, time);
  if (const std::string reason = confinement_against(t.results, time); !reason.empty())
    words.push_back(reason);
  return words;
}
Words against_path(Test t) {
  return when(t.path.deviation > most_off_path,
              fmt::format("the pressure was {:.1f} % off its path before the peak, {:.0f} % at most",
                          100 * t.path.deviation, 100 * most_off_path));
}

Words against_gauge(Test t) {
  const std::size_t n = dem::Gauge(t.model.particles, t.problem.shape(), t.model.bonds.get()).size();
  return when(n < fewest_in_gauge,
              fmt::format("{} spheres in the middle half of the specimen, {} at least", n, fewest_in_gauge));
}

bool has_fallen(Test t) {
  return !std::isnan(t.results.pattern().time) && t.peak.reached();
}
Words against_cone(Test t, dem::End end) {
  const dem::DeadZone &zone = t.dead_zone(false, end);
  return when(measures_pattern(t.scene, t.problem) && has_fallen(t) && !zone.is_cone(), cone_words(zone));
}

Words against_break_through(Test t) {
  Words words = when(t.scene.effects.gravity,
                     "gravity bends the bar too, and its work is not counted: Effects/Gravity");
  if (t.load_at_end_over_peak() > most_load_at_end)
    words.push_back(
        fmt::format("the bar bears {:.2g} of its largest load at the end, {:g} at most: the work to break it "
                    "through is not known. A lower Loading/Stop at residual, or a later end",
                    t.load_at_end_over_peak(), most_load_at_end));
  return words;
}

// What speaks against all figures that need one of these.
struct Reason {
  unsigned needs; // of Need
  Words (*against)(Test);
};
const std::vector<Reason> reasons{
    {bare, against_bare},
    {closure,
     [](Test t) {
       return when(t.is_disc(), "closure over the diameter is no strain of the material: opening_at_peak_m");
     }},
    {strain,
     [](Test t) {
       return when(t.problem.bent(),
                   "closure over the depth is no strain of the material: deflection_at_peak_m");
     }},
    {along_z, [](Test t) { return when(t.results.axis() != 2, "the gauge is of tests along z"); }},
    {section, against_section},
    {modulus, [](Test t) { return against_bonds(t, true, CalibratedFigure::elastic); }},
    {ratio, [](Test t) { return against_bonds(t, !t.is_tension(), CalibratedFigure::secant_ratio); }},
    {peak | damage,
     [](Test t) {
       return against_bonds(t, true,
                            t.is_tension() ? CalibratedFigure::tension : CalibratedFigure::compression);
     }},
    {peak | damage,
     [](Test t) { return against_bonds(t, !t.is_tension() && is_confined(t), CalibratedFigure::confined); }},
    {peak | modulus | damage, against_recess},
    {peak, against_peak},
    {peak, against_readings_to_peak},
    {modulus, against_modulus},
    {elastic, against_elastic},
    {peak, [](Test t) { return against_shared_load(t.results.unequal_at_peak(), "at the peak"); }},
    {modulus, [](Test t) { return against_shared_load(t.at_modulus.unequal, "at 40 % of the peak"); }},
    {peak | modulus | damage, against_residual},
    {peak, [](Test t) { return against_controls(t, t.results.time_at_peak()); }},
    {modulus, [](Test t) { return against_controls(t, t.at_modulus.time); }},
    {damage, [](Test t) { return against_controls(t, t.results.pattern().time); }},
    {consolidation, [](Test t) { return against_controls(t, t.results.consolidation_end()); }},
    {peak, against_path},
    {gauge, against_gauge},
    {torn,
     [](Test t) {
       return when(t.results.before_tear() == nullptr,
                   "no part of the wrap has torn after the first rows of history.csv");
     }},
    {whole_bar,
     [](Test t) { return when(t.problem.notched(), "the bar has a notch: beam theory knows of none"); }},
    {ligament,
     [](Test t) {
       return when(!t.problem.notched(),
                   "the bar has no notch, above which a ligament breaks: Specimen/Notch depth");
     }},
    {broken_through, [](Test t) { return t.problem.notched() ? against_break_through(t) : Words{}; }},
    {compressed,
     [](Test t) {
       return when(!measures_pattern(t.scene, t.problem),
                   "ends and cones are told of cylinders and boxes that are compressed along z");
     }},
    {damage,
     [](Test t) {
       return when(measures_pattern(t.scene, t.problem) && !has_fallen(t),
                   "the stress has not fallen to 0.8 of its peak");
     }},
    {top_cone, [](Test t) { return against_cone(t, dem::top_end); }},
    {bottom_cone, [](Test t) { return against_cone(t, dem::bottom_end); }}};

// What no elastic specimen has, whatever the reason; of figures that nothing else speaks against.
struct Bound {
  unsigned needs;
  std::string (*against)(Test, double value);
};
const std::vector<Bound> bounds{
    {stiffness | consolidation,
     [](Test, double value) {
       return std::isfinite(value) && value > 0
                  ? ""
                  : fmt::format("{:.3g} GPa: no modulus of a solid", 1e-9 * value);
     }},
    {stiffness,
     [](Test t, double value) {
       const double most = t.problem.facts().affine_moduli[static_cast<std::size_t>(t.results.axis())];
       return !(most > 0 && value > most_over_affine * most)
                  ? ""
                  : fmt::format(
                        "{:.3g} GPa is more than the bonds can have along the load, {:.3g} GPa by affine "
                        "strain (Voigt's bound)",
                        1e-9 * value, 1e-9 * most);
     }},
    {ratio, [](Test, double value) {
       return value > -1 && value <= 0.5 ? ""
                                         : fmt::format("{:.3g}: an elastic specimen has -1 to 0.5", value);
     }}};

// s, of the first sample with a number in that column that is not finite though the test measures it. A
// column without spheres is missing in all samples; bonds bear forces from a tenth of the peak on.
std::optional<double> first_fault(std::size_t column, Test t) {
  using Missing = HistoryColumn::Missing;
  const HistoryColumn &of = history_columns()[column];
  const std::vector<Sample> samples =
      of.missing == Missing::without_forces ? t.results.rise() : t.results.samples();
  std::optional<double> first;
  std::size_t missing = 0;
  for (Sample s : samples) {
    const double value = value_of(s, column);
    const bool bears = of.missing == Missing::without_forces && s.intact_bonds > 0;
    const bool may = may_be(value, of, t.problem) && !(bears && std::isnan(value));
    missing += may && !std::isfinite(value);
    const bool lacks = (of.missing == Missing::without_spheres && !std::isfinite(value)) ||
                       (of.missing == Missing::without_pressure && s.cell_pressure > 0 && std::isnan(value));
    if ((!may || lacks) && !first) first = s.time;
  }
  return of.missing == Missing::without_spheres && missing == samples.size() ? std::nullopt : first;
}

bool names(const Figure &figure, const std::string &column) {
  return (' ' + figure.columns + ' ').find(' ' + column + ' ') != std::string::npos;
}

// What passes over a number that is not finite tells a figure that nobody has measured. Of a column that no
// row names as its own, all that is read off the history: its peak, from which the rest is counted, would be
// another, or its energy balance is not known.
void add_columns(Reasons &to, Test t, const std::vector<Figure> &told) {
  static const Words idle{"time_step_s", "grain_contacts", "volumetric_strain_sleeve", "sleeve_deviator_pa",
                          "stage"}; // no figure rests on these
  for (std::size_t k = 0; k < history_columns().size(); ++k) {
    const HistoryColumn &column = history_columns()[k];
    if (column.member == nullptr || !is_there(column, &t.problem)) continue; // no figure rests on the former
    if (std::count(idle.begin(), idle.end(), column.name) > 0) continue;
    const std::optional<double> since = first_fault(k, t);
    if (!since) continue;
    const bool owned = std::any_of(figures().begin(), figures().end(),
                                   [&](const Figure &one) { return names(one, column.name); });
    for (const Figure &one : told)
      if (owned ? names(one, column.name) : one.is_read_off())
        to[one.key].push_back(fmt::format(
            "the history has a number that is not finite in {} at the time {:.6g} s", column.name, *since));
  }
}

} // namespace

Reasons reasons_against(const TestRecord &test, const std::vector<Figure> &told, const Json &values) {
  Reasons all;
  add_columns(all, test, told);
  for (const Reason &reason : reasons) {
    const Words words = reason.against(test);
    for (const Figure &figure : told)
      if (!words.empty() && (figure.needs & reason.needs) != 0)
        all[figure.key].insert(all[figure.key].end(), words.begin(), words.end());
  }
  for (const Figure &figure : told)
    for (const Bound &bound : bounds) {
      const double value = (figure.needs & bound.needs) != 0 ? number_in(values, figure.key) : not_measured;
      if (std::isnan(value) || all.count(figure.key) > 0) continue;
      if (const std::string words = bound.against(test, value); !words.empty())
        all[figure.key].push_back(words);
    }
  return all;
}

} // namespace platen::apps
