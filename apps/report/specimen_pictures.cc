// Pictures of the cut specimen: outward displacement, damage, and several runs side by side.
#include <algorithm>

#include "apps/report/pictures.h"
#include "apps/report/specimen_view.h"

namespace platen::apps::report {
namespace {

enum class Quantity { outward_displacement, displacement, damage };

std::vector<double> values_of(const Spheres &spheres, Quantity quantity) {
  constexpr double mm_per_m = 1e3;
  std::vector<double> values(spheres.size());
  for (std::size_t k = 0; k < values.size(); ++k)
    values[k] = quantity == Quantity::damage         ? spheres.damage(k)
                : quantity == Quantity::displacement ? spheres.displacement(k) * mm_per_m
                                                     : spheres.outward_displacement(k) * mm_per_m;
  return values;
}

CutView view_at(const Run &run, double time, Quantity quantity, const std::string &caption) {
  CutView view;
  view.caption = caption;
  view.spheres = read_spheres(run.specimen.nearest(time));
  view.values = values_of(view.spheres, quantity);
  if (!run.platens.empty()) view.platens = read_frame(run.platens.nearest(time));
  return view;
}

Colouring colouring_of(Quantity quantity, const std::vector<CutView> &views) {
  if (quantity == Quantity::damage) return {Ramp::damage, round_ticks(0, 1, 5), "Share of\nbonds broken"};
  const std::string which =
      quantity == Quantity::displacement ? "Displacement\n(mm)" : "Outward\ndisplacement\n(mm)";
  return {Ramp::displacement, ticks_for(views), which};
}

void draw_pattern_and_end(const Run &run, const Extent &extent, Quantity quantity, const std::string &what,
                          const std::filesystem::path &png) {
  std::vector<CutView> views;
  if (run.moments.post_peak_time)
    views.push_back(view_at(run, *run.moments.post_peak_time, quantity, "at " + run.pattern_words()));
  views.push_back(view_at(run, run.moments.end_time, quantity, "at the end"));
  save_cut_views(run.title, what + ", half of the specimen", views, extent, colouring_of(quantity, views),
                 png);
}

void draw_three_moments(const Run &run, const Extent &extent, bool whole, const std::filesystem::path &png) {
  std::vector<CutView> views;
  const auto add = [&](double time, const std::string &caption) {
    views.push_back(view_at(run, time, Quantity::displacement, caption));
    views.back().is_whole = whole;
  };
  add(run.specimen.frames.front().time, "before the test");
  add(run.moments.peak_time, "near the peak");
  add(run.moments.end_time, "at the end");
  save_cut_views(run.title, whole ? "The specimen from outside" : "The specimen cut in half", views, extent,
                 colouring_of(Quantity::displacement, views), png);
}

// Damage where the pattern is measured, displacement at the end: that is when each shows the most.
void draw_side_by_side(const std::vector<Run> &runs, Quantity quantity, const std::string &title,
                       const std::filesystem::path &png) {
  std::vector<CutView> views;
  Extent largest;
  for (const Run &run : runs) {
    if (run.specimen.empty()) continue;
    views.push_back(quantity == Quantity::damage
                        ? view_at(run, run.pattern_time(), quantity, run.name + ", at " + run.pattern_words())
                        : view_at(run, run.moments.end_time, quantity, run.name + ", at the end"));
    const Extent extent = extent_of(read_spheres(run.specimen.frames.front()));
    if (extent.height() > largest.height()) largest = extent;
  }
  save_cut_views(title, "Half of each specimen", views, largest, colouring_of(quantity, views), png);
}

} // namespace

void draw_outward_displacement(const Run &run, const Extent &extent, const std::filesystem::path &png) {
  draw_pattern_and_end(run, extent, Quantity::outward_displacement, "Outward displacement", png);
}

void draw_outside(const Run &run, const Extent &extent, const std::filesystem::path &png) {
  draw_three_moments(run, extent, true, png);
}

void draw_inside(const Run &run, const Extent &extent, const std::filesystem::path &png) {
  draw_three_moments(run, extent, false, png);
}

void draw_damage(const Run &run, const Extent &extent, const std::filesystem::path &png) {
  draw_pattern_and_end(run, extent, Quantity::damage, "Damage", png);
}

void draw_damage_comparison(const std::vector<Run> &runs, const std::filesystem::path &png) {
  draw_side_by_side(runs, Quantity::damage, "Damage compared", png);
}

void draw_displacement_comparison(const std::vector<Run> &runs, const std::filesystem::path &png) {
  draw_side_by_side(runs, Quantity::outward_displacement, "Outward displacement compared", png);
}

} // namespace platen::apps::report
