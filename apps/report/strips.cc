#include "apps/report/strips.h"

#include <algorithm>
#include <cmath>

#include "apps/report/chart.h"

namespace platen::apps::report {
namespace {

constexpr double n_per_m_of_kn = 1e3;

struct Strip {
  std::string name;
  PlatenContacts contacts;
  Colour colour;
  Stroke stroke;
};

std::vector<Strip> strips_of(const Run &run) {
  const Frame &frame = nearest(run.contacts, run.moments.peak_time);
  std::vector<Strip> strips{{"top", contacts_with(Side::top, frame), colours::vermilion, Stroke::solid}};
  const PlatenContacts below = contacts_with(Side::bottom, frame);
  if (!(number_of_scene(run.folder, "Platens/Span", "m") > 0)) {
    strips.push_back({"bottom", below, colours::blue, Stroke::dashed});
    return strips;
  }
  for (const bool left : {true, false}) {
    Strip support{
        left ? "left support" : "right support", {}, left ? colours::blue : colours::green, Stroke::dashed};
    std::copy_if(below.begin(), below.end(), std::back_inserter(support.contacts),
                 [left](const PlatenContact &one) { return (one.x < 0) == left; });
    strips.push_back(std::move(support));
  }
  return strips;
}

} // namespace

bool has_strips(const Run &run) {
  return number_of_scene(run.folder, "Platens/Strip width", "m") > 0;
}

std::vector<double> load_along(const PlatenContacts &contacts, double half_depth, int parts) {
  std::vector<double> load(static_cast<std::size_t>(parts), 0.0);
  const double length = 2 * half_depth / parts;
  for (const PlatenContact &one : contacts) {
    const int part = std::clamp(static_cast<int>(std::floor((one.y + half_depth) / length)), 0, parts - 1);
    load[static_cast<std::size_t>(part)] += one.normal_force / length;
  }
  return load;
}

void draw_strip_loads(const Run &run, const Extent &extent, double radius, const std::filesystem::path &png) {
  constexpr double spheres = 2; // to a part, so that most have one at least
  const int parts = std::max(3, static_cast<int>(extent.half_depth / (spheres * radius)));
  Chart chart = chart_with_axes("y, along the strips (mm)", "Load (kN/m)");
  for (const Strip &strip : strips_of(run)) {
    const std::vector<double> load = load_along(strip.contacts, extent.half_depth, parts);
    Curve curve{strip.name, {}, {}, strip.colour, strip.stroke, 4};
    for (int part = 0; part < parts; ++part) // as steps
      for (const int end : {0, 1}) {
        curve.x.push_back((2.0 * (part + end) / parts - 1) * extent.half_depth * mm_per_m);
        curve.y.push_back(load[static_cast<std::size_t>(part)] / n_per_m_of_kn);
      }
    chart.curves.push_back(std::move(curve));
  }
  chart.x_range = {-extent.half_depth * mm_per_m, extent.half_depth * mm_per_m};
  save_charts(run.title, "Load along the strips near the peak", {chart}, {700}, png);
}

bool tells_opening(const Run &run) {
  return run.history.has("opening_m") || run.history.has("deflection_m");
}

void draw_opening(const Run &run, const std::filesystem::path &png) {
  const bool bent = run.history.has("deflection_m");
  const std::vector<double> way = scaled(run.history.column(bent ? "deflection_m" : "opening_m"), mm_per_m),
                            stress = scaled(run.stress(), 1 / pa_per_mpa);
  Chart chart =
      chart_with_axes(bent ? "Deflection at mid-span (mm)" : "Widening across the loaded diameter (mm)",
                      bent ? "Nominal flexural stress (MPa)" : "Splitting stress (MPa)");
  chart.curves.push_back({"", way, stress, colours::blue, Stroke::solid, 5});
  chart.marks.push_back({way[run.moments.peak_row], stress[run.moments.peak_row], "peak", colours::blue});
  save_charts(run.title, bent ? "Stress against deflection" : "Stress against widening", {chart}, {800}, png);
}

} // namespace platen::apps::report
