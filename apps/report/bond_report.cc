// Pictures of bond tests: load against way, and by hand.
#include "apps/report/other_results.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <ostream>

#include "apps/report/csv.h"
#include "apps/report/head.h"

namespace platen::apps::report {
namespace {

namespace fs = std::filesystem;

// What stands by hand beside a row is of its way, its load or its strain ratio: that which the difference in
// the same row tells.
enum class ByHand { way, load, strain_ratio };
ByHand by_hand_of(const CsvTable &table, const std::vector<double> &way, const std::vector<double> &load) {
  double best = std::numeric_limits<double>::infinity();
  ByHand of = ByHand::way;
  const std::vector<double> &by_hand = table.column("by_hand"), &difference = table.column("difference");
  const auto look = [&](ByHand candidate, const std::vector<double> &measured) {
    double error = 0;
    int rows = 0;
    for (std::size_t k = 0; k < table.rows; ++k)
      if (std::isfinite(difference[k]) && std::isfinite(measured[k]) && by_hand[k] != 0)
        error = std::max(error, std::abs(measured[k] / by_hand[k] - 1 - difference[k])), ++rows;
    if (rows > 0 && error < best) best = error, of = candidate;
  };
  look(ByHand::way, way), look(ByHand::load, load);
  if (table.has("strain_ratio")) look(ByHand::strain_ratio, table.column("strain_ratio"));
  return of;
}

bool any_motion(const std::vector<double> &values) {
  return std::any_of(values.begin(), values.end(), [](double v) { return std::isfinite(v) && v != 0; });
}

void draw_bond_paths(const std::string &title, const CsvTable &table, const fs::path &png) {
  const bool turns = any_motion(table.column("moment_nm"));
  const std::vector<double> &way = table.column(turns ? "rotation_rad" : "displacement_m"),
                            &load = table.column(turns ? "moment_nm" : "force_n"),
                            &by_hand = table.column("by_hand"), &run = table.column("run");
  const ByHand of = by_hand_of(table, way, load);
  const double way_unit = turns ? 1e3 : 1e6;
  Chart path = chart_with_axes(turns ? "Rotation (mrad)" : "Displacement (micrometres)",
                               turns ? "Moment (N m)" : "Force (N)");
  std::map<double, std::vector<std::size_t>> rows;
  for (std::size_t k = 0; k < table.rows; ++k)
    rows[run[k]].push_back(k);
  std::size_t colour = 0;
  for (const auto &[number, of_run] : rows) {
    Curve measured{"", {0}, {0}, run_colour(colour), Stroke::solid, 5},
        hand{"", {0}, {0}, colours::black, Stroke::dashed, 2};
    for (const std::size_t k : of_run) {
      measured.x.push_back(way[k] * way_unit), measured.y.push_back(load[k]);
      if (of == ByHand::strain_ratio || !std::isfinite(by_hand[k])) continue;
      hand.x.push_back((of == ByHand::way ? by_hand[k] : way[k]) * way_unit);
      hand.y.push_back(of == ByHand::load ? by_hand[k] : load[k]);
    }
    const std::size_t first = of_run.front();
    measured.label =
        fmt::format("modulus {:.4g} GPa, stiffness ratio {:.3g}", table.column("modulus_pa")[first] * 1e-9,
                    table.column("stiffness_ratio")[first]);
    if (colour == 0 && hand.x.size() > 1) hand.label = "by hand";
    path.curves.push_back(std::move(measured));
    path.curves.push_back(std::move(hand));
    ++colour;
  }
  std::vector<Chart> charts{path};
  if (of == ByHand::strain_ratio) {
    Chart ratio = chart_with_axes("Stiffness ratio of the bonds", "Strain ratio of the triangle");
    for (const auto &[number, of_run] : rows) {
      const std::size_t last = of_run.back();
      const double x = table.column("stiffness_ratio")[last];
      ratio.marks.push_back({x, table.column("strain_ratio")[last],
                             number == rows.begin()->first ? "measured" : "", colours::blue});
      ratio.marks.push_back({x, by_hand[last], number == rows.begin()->first ? "by hand" : "",
                             colours::vermilion, MarkShape::diamond});
    }
    ratio.x_range = snug_x_range(ratio);
    charts.push_back(ratio);
  }
  save_charts(title, "Load against way of each run; dashed: by hand", charts,
              std::vector<int>(charts.size(), 700), png);
}

} // namespace

void write_bonds_report(const fs::path &folder, const fs::path &pictures,
                        const std::function<void()> &ensure_display, std::ostream &out) {
  const CsvTable table = read_csv(folder / "bonds.csv");
  for (const char *column : {"run", "modulus_pa", "stiffness_ratio", "force_n", "displacement_m", "moment_nm",
                             "rotation_rad", "by_hand", "difference"})
    table.column(column);
  const Json summary = summary_of(folder);
  const std::string title = title_of(summary, folder);
  std::vector<std::string> remarks;
  if (table.rows == 0) remarks.emplace_back("bonds.csv has no row: there is nothing to draw");
  TableOfFigures figures{{"run", "modulus (GPa)", "stiffness ratio", "stiffness", "by hand", "break load",
                          "by hand", "largest difference"},
                         {}};
  const auto runs = summary.find("runs");
  for (std::size_t k = 0; runs != summary.end() && runs->is_array() && k < runs->size(); ++k) {
    const Json &run = (*runs)[k];
    const auto text = [&](const char *key, double unit = 1) {
      const double value = number_in(run, key) * unit;
      return std::isnan(value) ? std::string("-") : fmt::format("{:.5g}", value);
    };
    figures.rows.push_back({std::to_string(k + 1), text("modulus_pa", 1e-9), text("stiffness_ratio"),
                            text("stiffness"), text("stiffness_by_hand"), text("break_load"),
                            text("break_load_by_hand"), text("largest_difference")});
  }
  ensure_display();
  Album album(pictures);
  add_head(folder, album);
  album.begin("Load and way");
  if (table.rows > 0)
    album.add("bonds.png", "Load against way of each run, and by hand.", draw_bond_paths, title, table);
  for (const std::string &remark : remarks)
    out << remark << '\n';
  album.finish(title, figures, remarks, out);
}

} // namespace platen::apps::report
