// Pictures of the specimen, whole or cut: displacement, damage, the pieces and the cones among them; several
// runs side by side.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/report/chart.h"
#include "apps/report/cones.h"
#include "apps/report/specimen_view.h"

namespace platen::apps::report {
namespace {

// What stands at the pictures of a quantity: of one run, of several compared, at the colour bar.
struct Words {
  const char *title, *title_compared, *subtitle_compared, *bar;
};

// In the order of Quantity.
Words words_of(Quantity quantity) {
  static constexpr Words all[] = {
      {"Outward displacement, half of the specimen", "Outward displacement compared", "Half of each specimen",
       "Outward\ndisplacement\n(mm)"},
      {"The specimen cut in half", "", "", "Displacement\n(mm)"},
      {"Damage, half of the specimen", "Damage compared", "Half of each specimen", "Share of\nbonds broken"},
      {"Pieces that bonds hold together (grey: below 30 spheres) and fitted cones",
       "Pieces and cones compared", "Grey: pieces of fewer than 30 spheres", ""}};
  return all[static_cast<std::size_t>(quantity)];
}

constexpr int coloured = 7, smallest = 30; // pieces; spheres

std::vector<double> colours_of_pieces(const Spheres &spheres) {
  std::vector<int> count;
  for (const int f : spheres.fragment) {
    if (f >= static_cast<int>(count.size())) count.resize(static_cast<std::size_t>(f) + 1);
    ++count[static_cast<std::size_t>(f)];
  }
  std::vector<double> colour;
  for (const int f : spheres.fragment)
    colour.push_back(f < coloured && count[static_cast<std::size_t>(f)] >= smallest ? f + 1 : 0);
  return colour;
}

std::vector<double> values_of(const Spheres &spheres, Quantity quantity) {
  if (quantity == Quantity::pieces) return colours_of_pieces(spheres);
  std::vector<double> values(spheres.size());
  for (std::size_t k = 0; k < values.size(); ++k)
    values[k] = quantity == Quantity::damage         ? spheres.damage(k)
                : quantity == Quantity::displacement ? spheres.displacement(k) * mm_per_m
                                                     : spheres.outward_displacement(k) * mm_per_m;
  return values;
}

// The outline where the cone is now, and its angle (or that there is none) beside the specimen.
void mark_cone(CutView &view, const FittedCone &cone, Side end, const Extent &extent) {
  if (cone.verdict == FittedCone::Verdict::not_measured) return;
  const double up = end == Side::top ? 1 : -1;
  const double beside = extent.half_width + 0.19 * extent.height() / 2,
               height = (end == Side::top ? extent.top : extent.bottom) - up * 0.09 * extent.height();
  if (cone.verdict == FittedCone::Verdict::none) {
    view.notes.push_back({{beside, 0, height}, "no cone"});
    return;
  }
  const Position moved = carried(cone, view.spheres);
  Outline outline;
  for (const auto &[x, z] : section_of(cone, end, extent))
    outline.push_back({x + moved[0], moved[1], z + moved[2]});
  if (!outline.empty()) view.outlines.push_back(std::move(outline));
  view.notes.push_back(
      {{beside, 0, height}, fmt::format("half-angle\n{}\xC2\xB0", std::lround(cone.half_angle / degree))});
}

CutView view_at(const Run &run, double time, Quantity quantity, const std::string &caption) {
  CutView view;
  view.caption = caption;
  view.spheres = read_spheres(nearest(run.specimen, time));
  view.values = values_of(view.spheres, quantity);
  if (!run.platens.empty()) view.platens = read_frame(nearest(run.platens, time));
  return view;
}

// At the fall to 0.8 of the peak, or at the end; with the cones that were fitted then where pieces are shown.
CutView view_of(const Run &run, ConeTime moment, Quantity quantity, const Extent &extent) {
  CutView view = moment == ConeTime::fall
                     ? view_at(run, run.pattern_time(), quantity, "at " + run.pattern_words())
                     : view_at(run, run.moments.end_time, quantity, "at the end");
  if (quantity == Quantity::pieces)
    for (const Side end : {Side::top, Side::bottom})
      mark_cone(view, cone_of(run, end, moment), end, extent);
  return view;
}

Colouring colouring_of(Quantity quantity, const std::vector<CutView> &views) {
  const char *bar = words_of(quantity).bar;
  if (quantity == Quantity::pieces) return {Ramp::pieces, {0, coloured}, bar};
  if (quantity == Quantity::damage) return {Ramp::damage, round_ticks(0, 1, 5), bar};
  return {Ramp::displacement, ticks_for(views), bar};
}

} // namespace

bool tells_fragments(const Run &run) {
  return !run.specimen.empty() && !read_spheres(run.specimen.front()).fragment.empty();
}

void draw_three_moments(const Run &run, const Extent &extent, bool whole, const std::filesystem::path &png) {
  std::vector<CutView> views{
      view_at(run, run.specimen.front().time, Quantity::displacement, "before the test"),
      view_at(run, run.moments.peak_time, Quantity::displacement, "near the peak"),
      view_at(run, run.moments.end_time, Quantity::displacement, "at the end")};
  for (CutView &view : views)
    view.is_whole = whole, view.shows_front = !has_further_sides(run);
  save_cut_views(run.title,
                 whole
                     ? (has_further_sides(run) ? "The specimen from outside, the platen before it taken away"
                                               : "The specimen from outside")
                     : words_of(Quantity::displacement).title,
                 views, extent, colouring_of(Quantity::displacement, views), png);
}

void draw_pattern_and_end(const Run &run, const Extent &extent, Quantity quantity,
                          const std::filesystem::path &png) {
  std::vector<CutView> views;
  if (run.moments.post_peak_time) views.push_back(view_of(run, ConeTime::fall, quantity, extent));
  views.push_back(view_of(run, ConeTime::end, quantity, extent));
  save_cut_views(run.title, words_of(quantity).title, views, extent, colouring_of(quantity, views), png);
}

void draw_side_by_side(const std::vector<Run> &runs, Quantity quantity, const std::filesystem::path &png) {
  std::vector<CutView> views;
  Extent largest;
  for (const Run &run : runs) {
    if (run.specimen.empty() || (quantity == Quantity::pieces && !tells_fragments(run))) continue;
    const Extent extent = extent_of(read_spheres(run.specimen.front()));
    views.push_back(
        view_of(run, quantity == Quantity::damage ? ConeTime::fall : ConeTime::end, quantity, extent));
    views.back().caption = run.name + ", " + views.back().caption;
    if (extent.height() > largest.height()) largest = extent;
  }
  const Words words = words_of(quantity);
  save_cut_views(words.title_compared, words.subtitle_compared, views, largest, colouring_of(quantity, views),
                 png);
}

std::string fragments_caption(const Run &run) {
  std::string text = "Half specimen, the pieces that bonds still hold together in colours.";
  const auto say = [&](const std::string &when, ConeTime time) {
    const FittedCone top = cone_of(run, Side::top, time), bottom = cone_of(run, Side::bottom, time);
    if (top.verdict == FittedCone::Verdict::not_measured &&
        bottom.verdict == FittedCone::Verdict::not_measured)
      return;
    text += " Cone " + when + ": on top " + words_of(top) + ", at the bottom " + words_of(bottom) + ".";
  };
  if (run.moments.post_peak_time) say("at " + run.pattern_words(), ConeTime::fall);
  say("at the end", ConeTime::end);
  return text + " Outlines: where the cone, fitted to spheres that kept most of their bonds, meets the cut.";
}

} // namespace platen::apps::report
