#include "apps/report/curves.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "apps/report/chart.h"
#include "apps/report/stages.h"

namespace platen::apps::report {
namespace {

// A curve from the end of the consolidation on.
Curve curve_from_zero(const Run &run, const std::string &label, const std::vector<double> &x,
                      const std::vector<double> &y, Colour colour, Stroke stroke, double width) {
  return {label, run.from_zero(x), run.from_zero(y), colour, stroke, width};
}

std::string peak_words(const Run &run) {
  if (run.moments.peak_stress == 0) return "no stress";
  return fmt::format("{} {:.1f} MPa at {:.2f} mm/m",
                     run.peak_reached().value_or(true) ? "peak" : "no peak reached, largest",
                     run.moments.peak_stress / pa_per_mpa, run.strain()[run.moments.peak_row] * mm_per_m);
}

// What the platens of the other axes have closed, where those of the sides load.
void add_strains_across(Chart &chart, const Run &run, const std::vector<double> &stress) {
  const std::array<const char *, 3> columns{"strain_x", "strain_y", "axial_strain_platen"};
  for (const int axis : {0, 1, 2}) {
    const char *column = columns[static_cast<std::size_t>(axis)];
    if (axis == run.axis || !run.history.has(column)) continue;
    chart.curves.push_back(curve_from_zero(
        run, fmt::format("along {}, between platens", "xyz"[axis]), scaled(run.since_zero(column), mm_per_m),
        stress, axis == 2 ? colours::green : colours::vermilion, Stroke::solid, 3));
  }
}

// With one run the kinds of strain have colours, with several the runs have; the lateral strain is told apart
// by its side then.
void add_stress_curves(Chart &chart, const Run &run, std::size_t k, bool several) {
  const std::vector<double> stress = scaled(run.stress(), 1 / pa_per_mpa),
                            strain = scaled(run.strain(), mm_per_m);
  const std::string along = run.axis == 2 ? "axial" : fmt::format("along {}", "xyz"[run.axis]);
  const Colour of_run = several ? run_colour(k) : colours::blue;
  chart.curves.push_back(
      curve_from_zero(run, (several ? run.name : along) + ", between platens: " + peak_words(run), strain,
                      stress, of_run, Stroke::solid, 5));
  chart.marks.push_back({strain[run.moments.peak_row], run.moments.peak_stress / pa_per_mpa, "", of_run});
  if (run.axis != 2) { // the gauge measures along z
    if (!several) add_strains_across(chart, run, stress);
    return;
  }
  const auto add = [&](const char *column, const std::string &label, Stroke stroke, Colour colour,
                       double width) {
    if (!run.history.has(column)) return;
    chart.curves.push_back(curve_from_zero(run, label, scaled(run.since_zero(column), mm_per_m), stress,
                                           several ? run_colour(k) : colour, stroke, width));
  };
  add("axial_strain_gauge", several ? run.name + ", gauge" : "axial, gauge (middle half)", Stroke::dashed,
      colours::vermilion, 4);
  add("lateral_strain", several ? "" : "lateral, gauge (middle half)", Stroke::solid, colours::green, 3);
}

// Once it has failed, the middle may open a hundred times as wide as it was short, and shorten more than what
// is between the platens: such strains are cut off, so that what leads to the peak is seen.
std::array<double, 2> strain_range(const Chart &stress, const std::vector<Run> &runs) {
  constexpr double most_of_axial = 1.2, most_along = 1.5;
  double axial = 0;
  for (const Run &run : runs)
    for (const double strain : run.strain())
      axial = std::fmax(axial, strain * mm_per_m);
  const std::array<double, 2> all = x_range_of(stress);
  if (!(axial > 0)) return all;
  return {std::max(all[0], -most_of_axial * axial), std::min(all[1], most_along * axial)};
}

void add_broken_bonds(Chart &chart, const Run &run, std::size_t k, bool several) {
  for (const bool in_tension : {true, false}) {
    const char *column = in_tension ? "broken_tension" : "broken_shear";
    if (!run.history.has(column)) continue;
    const std::string words = in_tension ? "broken in tension" : "broken in shear";
    const Colour colour = in_tension ? colours::vermilion : colours::blue;
    chart.curves.push_back(curve_from_zero(run, several ? run.name + ", " + words : words,
                                           scaled(run.strain(), mm_per_m), run.history.column(column),
                                           several ? run_colour(k) : colour,
                                           in_tension ? Stroke::solid : Stroke::dashed, 4));
  }
}

void add_volume(Chart &chart, const Run &run, std::size_t k, bool several) {
  if (!run.history.has("volumetric_strain")) return;
  const std::vector<double> axial = scaled(run.strain(), mm_per_m),
                            volume = scaled(run.since_zero("volumetric_strain"), mm_per_m);
  const Colour colour = several ? run_colour(k) : colours::green;
  chart.curves.push_back(curve_from_zero(run, several ? run.name : "gauge (middle half)", axial, volume,
                                         colour, Stroke::solid, 4));
  chart.marks.push_back({axial[run.moments.peak_row], volume[run.moments.peak_row], "", colour});
}

// "" where some runs have a consolidation and others none.
std::string common_origin(const std::vector<Run> &runs) {
  const bool any = std::any_of(runs.begin(), runs.end(), [](const Run &run) { return run.zero > 0; });
  const bool all = std::all_of(runs.begin(), runs.end(), [](const Run &run) { return run.zero > 0; });
  return !any  ? ""
         : all ? " from the end of consolidation"
               : " from the end of consolidation, where there is one";
}

struct LedgerLine {
  const char *column, *words;
  Colour colour;
  Stroke stroke;
};

constexpr LedgerLine ledger[] = {
    {"boundary_work_j", "work of the platens", colours::black, Stroke::solid},
    {"bond_energy_j", "elastic, bonds", colours::blue, Stroke::solid},
    {"contact_energy_j", "elastic, contacts", colours::sky_blue, Stroke::solid},
    {"body_energy_j", "elastic, platens and sleeve", colours::green, Stroke::solid},
    {"kinetic_energy_j", "kinetic", colours::purple, Stroke::solid},
    {"fracture_work_j", "broken bonds", colours::vermilion, Stroke::dashed},
    {"plastic_work_j", "crushed interfaces", colours::purple, Stroke::dashed},
    {"friction_work_j", "friction", colours::orange, Stroke::dashed},
    {"damping_work_j", "damping", colours::grey, Stroke::dashed},
    {"energy_residual_j", "residual (error of the ledger)", colours::green, Stroke::dashed},
};

} // namespace

void draw_stress_strain(const std::vector<Run> &runs, const std::filesystem::path &png) {
  const bool several = runs.size() > 1;
  Chart stress, broken, volume;
  for (std::size_t k = 0; k < runs.size(); ++k) {
    add_stress_curves(stress, runs[k], k, several);
    add_broken_bonds(broken, runs[k], k, several);
    add_volume(volume, runs[k], k, several);
  }
  const std::string origin = common_origin(runs);
  stress.x_title =
      (several ? "Lateral (left) and axial strain" : "Strain") + origin + " (mm/m), compression positive";
  stress.y_title = runs[0].stress_title();
  broken.x_title = several ? "Strain between platens" + origin + " (mm/m)" : runs[0].strain_title();
  broken.y_title = "Broken bonds";
  stress.x_range = strain_range(stress, runs);
  broken.x_range = stress.x_range; // one above the other, strain under strain
  volume.x_title = broken.x_title;
  volume.y_title = "Volumetric strain (mm/m)";
  std::vector<Chart> charts{stress};
  if (!broken.curves.empty()) charts.push_back(broken);
  if (!volume.curves.empty()) charts.push_back(volume);
  save_charts(several ? "Runs compared" : runs[0].title,
              "Stress, broken bonds and volume (compression positive) against strain", charts,
              std::vector<int>{800, 450, 450}, png);
}

void draw_energies(const Run &run, const std::filesystem::path &png) {
  Chart chart;
  const std::vector<double> strain = scaled(run.strain(), mm_per_m);
  for (const LedgerLine &line : ledger) {
    if (!run.history.has(line.column)) continue;
    const std::vector<double> &energy = run.history.column(line.column);
    const bool plays_a_part =
        std::any_of(energy.begin(), energy.end(), [](double e) { return std::abs(e) > 0; });
    if (plays_a_part) chart.curves.push_back({line.words, strain, energy, line.colour, line.stroke, 4});
  }
  chart.x_title = run.strain_title();
  chart.y_title = "Energy (J)";
  save_charts(run.title, "Where the work of the platens went", {chart}, {900}, png);
}

MagnitudeCount count_of(const Run &run, Stage stage) {
  const std::vector<double> &time = run.events->column("time_s"), &all = run.events->column("magnitude");
  std::vector<double> magnitudes;
  for (std::size_t k = 0; k < time.size(); ++k) {
    const bool before = !(time[k] > run.moments.peak_time);
    if (before == (stage == Stage::before_peak) && std::isfinite(all[k])) magnitudes.push_back(all[k]);
  }
  std::sort(magnitudes.begin(), magnitudes.end());
  MagnitudeCount count;
  for (std::size_t k = 0; k < magnitudes.size(); ++k) {
    count.magnitude.push_back(magnitudes[k]);
    count.log_count.push_back(std::log10(static_cast<double>(magnitudes.size() - k)));
  }
  return count;
}

double FittedLine::log_count(double magnitude) const {
  return std::log10(law.count(magnitude));
}

FittedLine line_of(const Run &run, Stage stage) {
  FittedLine line;
  const std::string start = stage == Stage::before_peak ? "acoustic/b_before" : "acoustic/b_after";
  line.law.b = number_in(run.summary, start);
  line.law.error = number_in(run.summary, start + "_error");
  line.law.limit = number_in(run.summary, start + "_limit");
  line.law.events = number_in(run.summary, start + "_events");
  const double above = number_in(run.summary, start + "_above"),
               upper = number_in(run.summary, start + "_upper");
  line.law.above = std::isnan(above) ? 0 : above;
  line.law.upper = std::isnan(upper) ? std::numeric_limits<double>::infinity() : upper;
  const Json::json_pointer reason("/" + start + "_reason");
  if (run.summary.contains(reason) && run.summary[reason].is_string()) line.reason = run.summary[reason];
  line.is_there =
      !std::isnan(line.law.b + line.law.error + line.law.limit + line.law.events) && line.law.b > 0;
  return line;
}

Curve FittedLine::curve(const std::string &when, Stroke stroke) const {
  constexpr int stations = 60;
  // Where one event is left, or the range ends.
  const double last = std::min(law.upper, law.limit + std::log10(law.events) / law.b);
  Curve curve{
      fmt::format("b = {:.2f} +- {:.2f} {}, M from {:.1f} {}: {:.0f} events", law.b, law.error, when,
                  law.limit, std::isinf(law.upper) ? "on" : fmt::format("to {:.1f}", law.upper), law.events),
      {},
      {},
      colours::black,
      stroke,
      3};
  for (int k = 0; k <= stations; ++k) {
    const double m = law.limit + (last - law.limit) * k / stations, count = log_count(m);
    if (!(count >= 0)) break; // a bounded law falls to nothing at its end
    curve.x.push_back(m), curve.y.push_back(count);
  }
  return curve;
}

bool tells_magnitudes(const Run &run) {
  if (!run.events || !run.events->has("magnitude")) return false;
  const std::vector<double> &all = run.events->column("magnitude");
  return std::any_of(all.begin(), all.end(), [](double magnitude) { return std::isfinite(magnitude); });
}

std::string acoustic_caption(const Run &run) {
  std::string caption =
      "Cracks near in place and time are one event. b says how their number falls with the "
      "magnitude, over the range where it follows a power law.";
  for (const Stage stage : {Stage::before_peak, Stage::after_peak})
    if (const FittedLine line = line_of(run, stage); !line.reason.empty())
      caption += fmt::format(" No b-value {} the peak: {}.", stage == Stage::before_peak ? "before" : "after",
                             line.reason);
  return caption;
}

void draw_acoustic(const Run &run, const std::filesystem::path &png) {
  Chart chart;
  for (const Stage stage : {Stage::before_peak, Stage::after_peak}) {
    const bool before = stage == Stage::before_peak;
    const MagnitudeCount count = count_of(run, stage);
    if (count.magnitude.empty()) continue;
    const std::string when = before ? "before the peak" : "after the peak";
    const FittedLine line = line_of(run, stage);
    chart.curves.push_back(
        {fmt::format("{} events {}{}", count.magnitude.size(), when, line.is_there ? "" : ": no b-value"),
         count.magnitude, count.log_count, before ? colours::blue : colours::vermilion, Stroke::solid, 4});
    if (line.is_there) chart.curves.push_back(line.curve(when, before ? Stroke::solid : Stroke::dashed));
  }
  std::array<double, 2> range{0, 0};
  for (const auto &[m, count] : points_of(chart))
    range = range[0] == 0 && range[1] == 0
                ? std::array<double, 2>{m, m}
                : std::array<double, 2>{std::min(range[0], m), std::max(range[1], m)};
  chart.x_range = {std::floor(2 * range[0]) / 2, std::floor(2 * range[1]) / 2 + 0.5};
  chart.x_title = "Magnitude M";
  chart.y_title = "log10 of events of M and more";
  save_charts(run.title, "Acoustic events by magnitude; black: the fitted b-values, over their ranges",
              {chart}, {800}, png);
}

} // namespace platen::apps::report
