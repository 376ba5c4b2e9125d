#include "apps/report/confinement.h"

#include <algorithm>
#include <array>

#include "apps/report/chart.h"

namespace platen::apps::report {
namespace {

constexpr double ms_per_s = 1e3;

struct Line {
  const char *column, *words;
  Colour colour;
  Stroke stroke;
};

constexpr std::array<Line, 2> deviators{
    {{"deviator_pa", "between platens and cell", colours::blue, Stroke::solid},
     {"sleeve_deviator_pa", "what platens press on the sleeve's ends", colours::vermilion, Stroke::dashed}}};
constexpr std::array<Line, 2> volumes{
    {{"volumetric_strain", "gauge (middle half)", colours::green, Stroke::solid},
     {"volumetric_strain_sleeve", "all that is within the sleeve", colours::purple, Stroke::dashed}}};

void add_lines(Chart &chart, const Run &run, const std::array<Line, 2> &lines, double factor,
               bool since_zero) {
  const std::vector<double> strain = scaled(run.from_zero(run.strain()), mm_per_m);
  for (const Line &line : lines) {
    if (!run.history.has(line.column)) continue;
    const std::vector<double> values =
        since_zero ? run.since_zero(line.column) : run.history.column(line.column);
    chart.curves.push_back(
        {line.words, strain, scaled(run.from_zero(values), factor), line.colour, line.stroke, 4});
  }
}

} // namespace

bool has_cell(const Run &run) {
  if (!run.history.has("deviator_pa") || !run.history.has("confining_pressure_pa")) return false;
  const std::vector<double> &pressure = run.history.column("confining_pressure_pa");
  return std::any_of(pressure.begin(), pressure.end(), [](double p) { return p > 0; });
}

void draw_confinement(const Run &run, const std::filesystem::path &png) {
  Chart deviator = chart_with_axes(run.strain_title(), "Deviator (MPa)"),
        volume = chart_with_axes(run.strain_title(), "Volumetric strain (mm/m)"),
        pressure = chart_with_axes("Time (ms)", "Pressure of the cell (MPa)");
  add_lines(deviator, run, deviators, 1 / pa_per_mpa, false);
  add_lines(volume, run, volumes, mm_per_m, true);
  const std::vector<double> time = scaled(run.history.column("time_s"), ms_per_s),
                            cell = scaled(run.history.column("confining_pressure_pa"), 1 / pa_per_mpa);
  pressure.curves.push_back({"", time, cell, colours::black, Stroke::solid, 4});
  if (run.zero > 0) pressure.spans.push_back({time.front(), time[run.zero], "consolidation"});
  save_charts(run.title, "Deviator, volume (compression positive) and pressure of the cell",
              {deviator, volume, pressure}, {560, 420, 320}, png);
}

} // namespace platen::apps::report
