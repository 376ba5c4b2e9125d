// Pictures of a bar: measures over strength of materials, and how its end swings.
#include "apps/report/other_results.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <ostream>

#include "apps/report/bars.h"
#include "apps/report/csv.h"
#include "apps/report/head.h"

namespace platen::apps::report {
namespace {

namespace fs = std::filesystem;

struct BarLoadWords {
  const char *load, *column, *axis;
  double unit;
};
constexpr BarLoadWords bar_loads[] = {{"tension", "end_z_m", "Stretch (micrometres)", 1e6},
                                      {"bending", "end_x_m", "Deflection (micrometres)", 1e6},
                                      {"torsion", "end_twist_rad", "Twist (mrad)", 1e3}};

void draw_swings(const std::string &title, const CsvTable &history, const Json &summary,
                 const fs::path &png) {
  const std::vector<std::string> &load = history.words.at("load");
  const std::vector<double> &time = history.column("time_s");
  std::vector<Chart> charts;
  for (const BarLoadWords &words : bar_loads) {
    Chart chart = chart_with_axes("Time since the load was let go (ms)", words.axis);
    Curve swing{std::string(words.load) + ", free end", {}, {}, colours::blue, Stroke::solid, 3};
    double start = std::nan("");
    for (std::size_t k = 0; k < history.rows; ++k) {
      if (load[k] != words.load) continue;
      if (std::isnan(start)) start = time[k];
      swing.x.push_back((time[k] - start) * 1e3);
      swing.y.push_back(history.column(words.column)[k] * words.unit);
    }
    if (swing.x.size() < 2) continue;
    const double end = swing.x.back();
    chart.curves.push_back(std::move(swing));
    const double by_hand = number_in(summary, std::string(words.load) + "/static_by_hand") * words.unit;
    if (!std::isnan(by_hand))
      chart.curves.push_back({fmt::format("under the load, strength of materials: {:.4g}", by_hand),
                              {0, end},
                              {by_hand, by_hand},
                              colours::vermilion,
                              Stroke::dashed,
                              3});
    charts.push_back(std::move(chart));
  }
  save_charts(title, "The bar let go: motion of its free end", charts, std::vector<int>(charts.size(), 500),
              png);
}

struct BarFigure {
  const char *title, *measured, *by_hand;
  double unit;
  const char *of;
};
constexpr BarFigure bar_figures[] = {
    {"stretch under tension", "tension/static_displacement_m", "tension/static_by_hand", 1e6, "micrometres"},
    {"deflection under bending", "bending/static_displacement_m", "bending/static_by_hand", 1e6,
     "micrometres"},
    {"twist under torsion", "torsion/static_twist_rad", "torsion/static_by_hand", 1e3, "mrad"},
    {"frequency in tension", "tension/frequency_hz", "tension/frequency_by_hand_hz", 1e-3, "kHz"},
    {"frequency in bending", "bending/frequency_hz", "bending/frequency_by_hand_hz", 1e-3, "kHz"},
    {"frequency in torsion", "torsion/frequency_hz", "torsion/frequency_by_hand_hz", 1e-3, "kHz"},
    {"wave speed after impact", "impact/wave_speed_m_s", "impact/wave_speed_by_hand_m_s", 1e-3, "km/s"}};

TableOfFigures table_of_bar(const Json &summary) {
  TableOfFigures table{{"figure", "unit", "measured", "strength of materials", "ratio"}, {}};
  for (const BarFigure &figure : bar_figures) {
    const double measured = number_in(summary, figure.measured) * figure.unit,
                 by_hand = number_in(summary, figure.by_hand) * figure.unit;
    if (std::isnan(measured) || std::isnan(by_hand)) continue;
    table.rows.push_back({figure.title, figure.of, fmt::format("{:.4g}", measured),
                          fmt::format("{:.4g}", by_hand), fmt::format("{:.4f}", measured / by_hand)});
  }
  return table;
}

void draw_bar_ratios(const std::string &title, const Json &summary, const fs::path &png) {
  std::vector<Bar> bars;
  for (const BarFigure &figure : bar_figures) {
    const double ratio = number_in(summary, figure.measured) / number_in(summary, figure.by_hand);
    if (!std::isnan(ratio))
      bars.push_back({figure.title, fmt::format("{:.4f}", ratio), std::max(ratio, 0.0), colours::blue});
  }
  save_bars(title, "Measured over strength of materials; line: the same", bars, 1, png);
}

} // namespace

void write_bar_report(const fs::path &folder, const fs::path &pictures,
                      const std::function<void()> &ensure_display, std::ostream &out) {
  const Json summary = summary_of(folder);
  const std::string title = title_of(summary, folder);
  std::vector<std::string> remarks;
  std::optional<CsvTable> history;
  if (fs::exists(folder / "history.csv"))
    history = read_csv(folder / "history.csv", {"load"});
  else
    remarks.emplace_back("history.csv is not there: no picture of how the bar swings");
  bool swings = false;
  if (history && history->words.count("load") > 0)
    for (const BarLoadWords &words : bar_loads) {
      const std::vector<std::string> &load = history->words["load"];
      if (std::count(load.begin(), load.end(), words.load) > 1) swings = true, history->column(words.column);
    }
  const TableOfFigures figures = table_of_bar(summary);
  ensure_display();
  Album album(pictures);
  add_head(folder, album);
  album.begin("Against strength of materials");
  if (!figures.rows.empty())
    album.add("bar.png", "What was measured over what strength of materials gives for the same bar.",
              draw_bar_ratios, title, summary);
  if (swings)
    album.add(
        "swings.png",
        "Motion of the free end after the load was let go; dashed: what the load holds it at by strength of "
        "materials.",
        draw_swings, title, *history, summary);
  if (album.size() == 0)
    remarks.emplace_back("neither summary.json nor history.csv tells of a load: nothing to draw");
  for (const std::string &remark : remarks)
    out << remark << '\n';
  album.finish(title, figures, remarks, out);
}

} // namespace platen::apps::report
