#include "apps/report/sides.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/report/report.h"
#include "base/largest.h"

namespace platen::apps::report {
namespace {

std::string stress_column(Side side) {
  const std::string name = coupling::name_of(side);
  return (coupling::axis_of(side) == 2 ? "axial_stress_" : "stress_") + name + "_pa";
}

std::vector<double> mean_of(const std::vector<const std::vector<double> *> &columns) {
  std::vector<double> mean(columns.front()->size(), 0.0);
  for (const std::vector<double> *column : columns)
    for (std::size_t k = 0; k < mean.size(); ++k)
      mean[k] += (*column)[k] / static_cast<double>(columns.size());
  return mean;
}

constexpr std::array<Colour, coupling::side_count> side_colours{
    colours::blue, colours::blue, colours::vermilion, colours::vermilion, colours::green, colours::green};

} // namespace

std::vector<Side> sides_of(const Run &run) {
  std::vector<Side> sides;
  for (const Side side : coupling::all_sides)
    if (coupling::axis_of(side) == 2 || run.history.has(stress_column(side))) sides.push_back(side);
  return sides;
}

Colour side_colour(Side side) {
  return side_colours[static_cast<std::size_t>(side)];
}

Stroke side_stroke(Side side) {
  return coupling::is_high(side) ? Stroke::dashed : Stroke::solid;
}

bool has_further_sides(const Run &run) {
  return sides_of(run).size() > 2;
}

const std::vector<double> &stress_on(const Run &run, Side side) {
  return run.history.column(stress_column(side));
}

std::array<std::vector<double>, 3> axis_stresses(const Run &run) {
  std::array<std::vector<const std::vector<double> *>, 3> columns;
  for (const Side side : sides_of(run))
    columns[static_cast<std::size_t>(coupling::axis_of(side))].push_back(&stress_on(run, side));
  std::array<std::vector<double>, 3> stresses;
  const bool pressed = run.history.has("confining_pressure_pa");
  for (std::size_t axis = 0; axis < 3; ++axis)
    stresses[axis] = !columns[axis].empty() ? mean_of(columns[axis])
                     : pressed              ? run.history.column("confining_pressure_pa")
                                            : std::vector<double>(run.history.rows, 0.0);
  return stresses;
}

StressPath stress_path_of(const Run &run) {
  const auto [x, y, z] = axis_stresses(run);
  StressPath path;
  for (std::size_t k = 0; k < z.size(); ++k) {
    path.mean.push_back((x[k] + y[k] + z[k]) / 3);
    const double xy = x[k] - y[k], yz = y[k] - z[k], zx = z[k] - x[k];
    path.deviator.push_back(std::sqrt(0.5 * (xy * xy + yz * yz + zx * zx)));
  }
  return path;
}

bool has_stress_path(const Run &run) {
  if (has_further_sides(run)) return true;
  if (!run.history.has("confining_pressure_pa")) return false;
  const std::vector<double> &pressure = run.history.column("confining_pressure_pa");
  return std::any_of(pressure.begin(), pressure.end(), [](double p) { return p > 0; });
}

void draw_side_stresses(const Run &run, const std::filesystem::path &png) {
  Chart chart;
  const std::vector<double> strain = scaled(run.strain(), mm_per_m);
  for (const Side side : sides_of(run)) {
    const std::vector<double> stress = scaled(stress_on(run, side), 1 / pa_per_mpa);
    chart.curves.push_back(
        {coupling::name_of(side), strain, stress, side_colour(side), side_stroke(side), 4});
    const std::size_t peak = run.moments.peak_row;
    if (coupling::is_high(side)) continue; // one of each pair
    chart.marks.push_back({strain[peak], stress[peak], "", side_colour(side)});
  }
  chart.x_title = run.strain_title();
  chart.y_title = "Stress (MPa), compression positive";
  save_charts(run.title, "Stress on each platen, over the face of the specimen; dots: at the peak", {chart},
              {900}, png);
}

void draw_stress_path(const std::vector<Run> &runs, const std::filesystem::path &png) {
  Chart chart;
  std::string title;
  std::size_t drawn = 0;
  for (std::size_t k = 0; k < runs.size(); ++k) {
    if (!has_stress_path(runs[k])) continue;
    const StressPath path = stress_path_of(runs[k]);
    const std::vector<double> mean = scaled(path.mean, 1 / pa_per_mpa),
                              deviator = scaled(path.deviator, 1 / pa_per_mpa);
    chart.curves.push_back({runs.size() > 1 ? runs[k].name : "path of the test", mean, deviator,
                            run_colour(k), Stroke::solid, 4});
    const std::size_t peak = runs[k].moments.peak_row;
    chart.marks.push_back({mean[peak], deviator[peak], "", run_colour(k)});
    title = runs[k].title;
    ++drawn;
  }
  double reach = 0; // MPa, of the line of a bare test, q = 3 p
  for (const auto &[p, q] : points_of(chart))
    reach = std::max(reach, std::min(p, q / 3));
  chart.curves.push_back(
      {"sides without stress, q = 3 p", {0, reach}, {0, 3 * reach}, colours::grey, Stroke::dashed, 3});
  chart.x_title = "Mean stress p (MPa), compression positive";
  chart.y_title = "Deviator q (MPa)";
  save_charts(drawn > 1 ? "Runs compared" : title,
              "Stress path: p = (s1 + s2 + s3) / 3, q = sqrt(3 J2); dots: at the peak", {chart}, {900}, png);
}

TableOfFigures table_of_sides(const Run &run) {
  TableOfFigures table;
  table.header = {"side", "largest stress (MPa)", "stress at the peak (MPa)", "work of friction (J)"};
  for (const Side side : sides_of(run)) {
    const std::vector<double> &stress = stress_on(run, side);
    Largest largest;
    for (const double now : stress)
      largest.add(now);
    const std::string work = std::string("friction_work_") + coupling::name_of(side) + "_j";
    table.rows.push_back(
        {coupling::name_of(side), fmt::format("{:.2f}", largest.value() / pa_per_mpa),
         fmt::format("{:.2f}", stress[run.moments.peak_row] / pa_per_mpa),
         run.history.has(work) ? fmt::format("{:.3g}", run.history.column(work).back()) : "-"});
  }
  return table;
}

} // namespace platen::apps::report
