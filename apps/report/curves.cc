#include "apps/report/curves.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "apps/report/chart.h"
#include "apps/report/stages.h"

namespace platen::apps::report {
namespace {

std::string peak_words(const Run &run) {
  const std::size_t zero = zero_row(run);
  return fmt::format("peak {:.1f} MPa at {:.2f} mm/m{}", run.moments.peak_stress / pa_per_mpa,
                     (run.strain()[run.moments.peak_row] - run.strain()[zero]) * mm_per_m,
                     zero > 0 ? " since consolidation" : "");
}

// What the platens of the other axes have closed, where those of the sides load.
void add_strains_across(Chart &chart, const Run &run, const std::vector<double> &stress) {
  const std::array<const char *, 3> columns{"strain_x", "strain_y", "axial_strain_platen"};
  for (const int axis : {0, 1, 2}) {
    const char *column = columns[static_cast<std::size_t>(axis)];
    if (axis == run.axis || !run.history.has(column)) continue;
    chart.curves.push_back({fmt::format("along {}, between platens", "xyz"[axis]),
                            scaled(run.history.column(column), mm_per_m), stress,
                            axis == 2 ? colours::green : colours::vermilion, Stroke::solid, 3});
  }
}

// With one run the kinds of strain have colours, with several the runs have; the lateral strain is told apart
// by its side then.
void add_stress_curves(Chart &chart, const Run &run, std::size_t k, bool several) {
  const std::vector<double> stress = scaled(run.stress(), 1 / pa_per_mpa);
  const std::string along = run.axis == 2 ? "axial" : fmt::format("along {}", "xyz"[run.axis]);
  chart.curves.push_back({(several ? run.name : along) + ", between platens: " + peak_words(run),
                          scaled(run.strain(), mm_per_m), stress, several ? run_colour(k) : colours::blue,
                          Stroke::solid, 5});
  chart.marks.push_back({run.strain()[run.moments.peak_row] * mm_per_m, run.moments.peak_stress / pa_per_mpa,
                         "", several ? run_colour(k) : colours::blue});
  if (run.axis != 2) { // the gauge measures along z
    if (!several) add_strains_across(chart, run, stress);
    return;
  }
  const auto add = [&](const char *column, const std::string &label, Stroke stroke, Colour colour,
                       double width) {
    if (!run.history.has(column)) return;
    chart.curves.push_back({label, scaled(run.history.column(column), mm_per_m), stress,
                            several ? run_colour(k) : colour, stroke, width});
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
    chart.curves.push_back({several ? run.name + ", " + words : words, scaled(run.strain(), mm_per_m),
                            run.history.column(column), several ? run_colour(k) : colour,
                            in_tension ? Stroke::solid : Stroke::dashed, 4});
  }
}

void add_volume(Chart &chart, const Run &run, std::size_t k, bool several) {
  if (!run.history.has("volumetric_strain")) return;
  const std::vector<double> axial = scaled(run.strain(), mm_per_m),
                            volume = scaled(run.history.column("volumetric_strain"), mm_per_m);
  const Colour colour = several ? run_colour(k) : colours::green;
  chart.curves.push_back(
      {several ? run.name : "gauge (middle half)", axial, volume, colour, Stroke::solid, 4});
  chart.marks.push_back({axial[run.moments.peak_row], volume[run.moments.peak_row], "", colour});
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
  stress.x_title = several ? "Lateral (left) and axial strain (mm/m), compression positive"
                           : "Strain (mm/m), compression positive";
  stress.y_title = runs[0].stress_title();
  broken.x_title = runs[0].strain_title();
  broken.y_title = "Broken bonds";
  stress.x_range = strain_range(stress, runs);
  broken.x_range = stress.x_range; // one above the other, strain under strain
  volume.x_title = broken.x_title;
  volume.y_title = "Volumetric strain (mm/m)";
  std::vector<Chart> charts{stress, broken};
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
    const bool before = time[k] < run.moments.peak_time;
    if (before == (stage == Stage::before_peak) && !std::isnan(all[k])) magnitudes.push_back(all[k]);
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
  return std::log10(events) - b * (magnitude - limit);
}

FittedLine line_of(const Run &run, Stage stage) {
  FittedLine line;
  const std::string start = stage == Stage::before_peak ? "acoustic/b_before" : "acoustic/b_after";
  line.b = number_in(run.summary, start);
  line.error = number_in(run.summary, start + "_error");
  line.limit = number_in(run.summary, start + "_limit");
  line.events = number_in(run.summary, start + "_events");
  line.is_there = !std::isnan(line.b + line.error + line.limit + line.events);
  return line;
}

void draw_acoustic(const Run &run, const std::filesystem::path &png) {
  Chart chart;
  double low = 0, high = -100; // of all magnitudes
  for (const Stage stage : {Stage::before_peak, Stage::after_peak}) {
    const bool before = stage == Stage::before_peak;
    const MagnitudeCount count = count_of(run, stage);
    if (count.magnitude.empty()) continue;
    low = std::min(low, count.magnitude.front());
    high = std::max(high, count.magnitude.back());
    const Colour colour = before ? colours::blue : colours::vermilion;
    const std::string when = before ? "before the peak" : "after the peak";
    chart.curves.push_back({std::to_string(count.magnitude.size()) + " events " + when, count.magnitude,
                            count.log_count, colour, Stroke::solid, 4});
    const FittedLine line = line_of(run, stage);
    if (!line.is_there) continue;
    const double end = line.limit + std::log10(line.events) / line.b; // where one event is left
    chart.curves.push_back({fmt::format("b = {:.2f} +- {:.2f} {}", line.b, line.error, when),
                            {line.limit, end},
                            {line.log_count(line.limit), 0},
                            colours::black,
                            before ? Stroke::solid : Stroke::dashed,
                            3});
    high = std::max(high, end);
  }
  chart.x_range = {std::floor(2 * low) / 2, std::ceil(2 * high) / 2};
  chart.x_title = "Magnitude M";
  chart.y_title = "log10 of events of M and more";
  save_charts(run.title, "Acoustic events by magnitude; black: the fitted b-values", {chart}, {800}, png);
}

} // namespace platen::apps::report
