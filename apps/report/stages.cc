#include "apps/report/stages.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "apps/report/chart.h"
#include "apps/report/letters.h"
#include "apps/report/report.h"
#include "apps/report/sides.h"
#include "base/largest.h"

namespace platen::apps::report {
namespace {

constexpr double ms_per_s = 1e3;
constexpr const char *circumferential = "circumferential_strain";

std::string section_of(int number) {
  return "Loading/Stage " + std::to_string(number) + "/";
}

// What the summary says of a stage; null where it says nothing.
Json entry_of(const Run &run, int number) {
  const auto stages = run.summary.find("stages");
  if (stages == run.summary.end() || !stages->is_array()) return {};
  for (const Json &stage : *stages)
    if (stage.is_object() && stage.value("stage", 0) == number) return stage;
  return {};
}

bool is_led_by_width(const Run &run) {
  return run.history.has(circumferential);
}

// Across the loaded axis, negative where the specimen widens: around it, of the gauge, or of the platens
// there.
std::vector<double> strain_across(const Run &run) {
  if (is_led_by_width(run)) return scaled(run.since_zero(circumferential), -1);
  if (run.axis == 2) return run.since_zero("lateral_strain");
  std::vector<double> mean(run.history.rows, 0);
  const std::array<const char *, 3> columns{"strain_x", "strain_y", "axial_strain_platen"};
  std::vector<std::vector<double>> others;
  for (const int axis : {0, 1, 2})
    if (const char *column = columns[static_cast<std::size_t>(axis)];
        axis != run.axis && run.history.has(column))
      others.push_back(run.since_zero(column));
  for (const std::vector<double> &strain : others)
    for (std::size_t k = 0; k < mean.size(); ++k)
      mean[k] += strain[k] / static_cast<double>(others.size());
  return mean;
}

// Okabe and Ito's, then three of Tol's (muted); after ten they come again, dashed.
Colour stage_colour(std::size_t k) {
  constexpr std::array<Colour, 3> further{{{136, 34, 85}, {153, 153, 51}, {51, 34, 136}}};
  constexpr std::size_t first = 7;
  return k % 10 < first ? run_colour(k % 10) : further.at(k % 10 - first);
}

// Earlier stages are drawn wider, so that a path is seen on which a later one comes back.
Curve curve_of(const StageRows &rows, std::size_t k, std::size_t count, const std::vector<double> &x,
               const std::vector<double> &y) {
  constexpr double narrow = 4, wide = 10; // pixels
  const auto part = [&](const std::vector<double> &values) {
    const auto at = [&](std::size_t row) { return values.begin() + static_cast<std::ptrdiff_t>(row); };
    return std::vector<double>(at(rows.first), at(rows.last + 1));
  };
  const double share = count > 1 ? static_cast<double>(k) / static_cast<double>(count - 1) : 1;
  return {"",
          part(x),
          part(y),
          stage_colour(k),
          k < 10 ? Stroke::solid : Stroke::dashed,
          wide + share * (narrow - wide)};
}

Chart stress_strain(const Run &run, const std::vector<StageRows> &stages) {
  Chart chart;
  const std::vector<double> strain = scaled(run.strain(), mm_per_m),
                            stress = scaled(run.stress(), 1 / pa_per_mpa);
  for (std::size_t k = 0; k < stages.size(); ++k) {
    chart.curves.push_back(curve_of(stages[k], k, stages.size(), strain, stress));
    const std::string words = stage_words(run, stages[k].number);
    chart.curves.back().label =
        shortened(fmt::format("{}{}{}", stages[k].number, words.empty() ? "" : ": ", words), 64);
  }
  chart.x_title = run.strain_title();
  chart.y_title = run.stress_title();
  return chart;
}

// Along to the right, across to the left, as laboratories draw it.
Chart along_and_across(const Run &run, const std::vector<StageRows> &stages) {
  Chart chart;
  const bool confined = has_stress_path(run), led = is_led_by_width(run);
  const std::vector<double> along = scaled(run.strain(), mm_per_m),
                            across = scaled(strain_across(run), mm_per_m),
                            stress = scaled(confined ? stress_path_of(run).deviator : run.stress(),
                                            1 / pa_per_mpa);
  double furthest = 0;
  for (std::size_t k = 0; k < stages.size(); ++k)
    for (const std::vector<double> *strain : {&along, &across})
      chart.curves.push_back(curve_of(stages[k], k, stages.size(), *strain, stress));
  for (const double value : along)
    furthest = std::fmax(furthest, value);
  chart.x_range = x_range_of(chart);
  constexpr double most_of_axial = 1.2; // of what opens once it has failed
  if (!led && furthest > 0) chart.x_range[0] = std::max(chart.x_range[0], -most_of_axial * furthest);
  chart.x_title =
      fmt::format("Strain {} (left) and along {}{} (mm/m), compression positive", led ? "around" : "across",
                  run.axis == 2 ? "the axis" : std::string(1, "xyz"[run.axis]), run.strain_origin());
  chart.y_title = confined ? "Deviator q (MPa)" : run.stress_title();
  return chart;
}

Chart over_time(const Run &run, const std::vector<StageRows> &stages) {
  Chart chart;
  const std::vector<double> time = scaled(run.history.column("time_s"), ms_per_s);
  const std::array<const char *, 3> pairs{"left and right platens", "front and back platens",
                                          "bottom and top platens"};
  const auto stresses = axis_stresses(run);
  if (has_stress_path(run) && !has_further_sides(run))
    chart.curves.push_back({"pressure on the sides", time, scaled(stresses[0], 1 / pa_per_mpa), colours::grey,
                            Stroke::dashed, 4});
  else if (has_further_sides(run))
    for (const int axis : {0, 1, 2})
      if (axis != run.axis && run.history.has(axis == 2   ? "axial_stress_top_pa"
                                              : axis == 1 ? "stress_back_pa"
                                                          : "stress_left_pa"))
        chart.curves.push_back({pairs[static_cast<std::size_t>(axis)], time,
                                scaled(stresses[static_cast<std::size_t>(axis)], 1 / pa_per_mpa),
                                axis == (run.axis + 1) % 3 ? colours::grey : colours::black, Stroke::dashed,
                                3});
  const std::vector<double> stress = scaled(run.stress(), 1 / pa_per_mpa);
  for (std::size_t k = 0; k < stages.size(); ++k) {
    chart.curves.push_back(curve_of(stages[k], k, stages.size(), time, stress));
    chart.curves.back().width = 5;
    if (stages.size() > 1)
      chart.spans.push_back({time[stages[k].first], time[stages[k].last], std::to_string(stages[k].number)});
  }
  chart.x_title = "Time (ms)";
  chart.y_title = run.stress_title();
  return chart;
}

} // namespace

std::vector<StageRows> stages_of(const Run &run) {
  std::vector<StageRows> stages;
  if (!run.history.has("stage")) return stages;
  const std::vector<double> &stage = run.history.column("stage");
  for (std::size_t k = 0; k < stage.size(); ++k) {
    const int number = static_cast<int>(stage[k]);
    if (stages.empty() || stages.back().number != number) stages.push_back({number, k > 0 ? k - 1 : k, k});
    stages.back().last = k;
  }
  return stages;
}

std::size_t end_of_consolidation(const Run &run) {
  std::size_t row = 0;
  for (const StageRows &stage : stages_of(run)) {
    const Json entry = entry_of(run, stage.number);
    if (!entry.is_object() || !entry.value("consolidation", false)) break;
    row = stage.last;
  }
  return row;
}

std::string stage_words(const Run &run, int number) {
  std::vector<std::string> words;
  const std::filesystem::path scene = run.folder / "scene.prm";
  for (const std::string side :
       {"Axial", "Lateral", "Lateral x", "Lateral y", "Bottom", "Top", "Left", "Right", "Front", "Back"})
    if (const std::string asked = scene_entry(scene, section_of(number) + side); !asked.empty())
      words.push_back(side + " " + asked);
  return fmt::format("{}", fmt::join(words, ", "));
}

void draw_stages(const Run &run, const std::filesystem::path &png) {
  const std::vector<StageRows> stages = stages_of(run);
  std::vector<Chart> charts{stress_strain(run, stages)};
  constexpr std::size_t few = 3; // lines of a legend for which there is room anyway
  constexpr int line = 36;       // pixels
  std::vector<int> heights{800 + line * static_cast<int>(std::max(stages.size(), few) - few)};
  if (has_stress_path(run) || is_led_by_width(run))
    charts.push_back(along_and_across(run, stages)), heights.push_back(700);
  charts.push_back(over_time(run, stages)), heights.push_back(500);
  save_charts(
      run.title,
      stages.size() > 1 ? "Each stage has its colour, and its number over the lowest chart" : "One stage",
      charts, heights, png);
}

TableOfFigures table_of_stages(const Run &run) {
  const bool confined = has_stress_path(run);
  const std::vector<double> strain = run.strain(), stress = run.stress(), across = strain_across(run),
                            deviator = confined ? stress_path_of(run).deviator : stress,
                            &time = run.history.column("time_s");
  TableOfFigures table;
  table.header = {"stage",   "asked",         "until",        "ended by",
                  "at (ms)", "strain (mm/m)", "stress (MPa)", "largest stress (MPa)"};
  table.header.insert(table.header.begin() + 6,
                      is_led_by_width(run) ? "circumferential strain (mm/m)" : "lateral strain (mm/m)");
  if (confined) table.header.push_back("deviator q (MPa)");
  const auto or_dash = [](const std::string &words) { return words.empty() ? "-" : words; };
  for (const StageRows &rows : stages_of(run)) {
    const Json entry = entry_of(run, rows.number);
    const bool told = entry.is_object() && entry.contains("ended_by") && entry["ended_by"].is_string();
    Largest largest;
    for (std::size_t k = rows.first; k <= rows.last; ++k)
      largest.add(stress[k]);
    const auto number = [](double value, double unit, int digits) {
      return fmt::format("{:.{}f}", value * unit, digits);
    };
    const std::size_t end = rows.last;
    table.rows.push_back({std::to_string(rows.number), or_dash(stage_words(run, rows.number)),
                          or_dash(scene_entry(run.folder / "scene.prm", section_of(rows.number) + "Until")),
                          told ? entry["ended_by"].get<std::string>() : "-", number(time[end], ms_per_s, 3),
                          number(strain[end], mm_per_m, 3), number(across[end], mm_per_m, 3),
                          number(stress[end], 1 / pa_per_mpa, 2),
                          number(largest.value(), 1 / pa_per_mpa, 2)});
    if (confined) table.rows.back().push_back(number(deviator[end], 1 / pa_per_mpa, 2));
  }
  return table;
}

} // namespace platen::apps::report
