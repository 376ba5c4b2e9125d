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
      {"Pieces that bonds hold together (grey: below 30 spheres)", "Pieces compared",
       "Grey: pieces of fewer than 30 spheres", ""},
      {"What moves with the bottom platen (blue) and with the top one (orange), and cones by displacement",
       "What moves with the platens, and cones by displacement",
       "Blue: with the bottom one; orange: with the top one", ""}};
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
  if (quantity == Quantity::dead_zones) return {spheres.moves_with.begin(), spheres.moves_with.end()};
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
  const double beside = extent.half_width + 0.205 * extent.height() / 2,
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
  view.notes.push_back({{beside, 0, height},
                        fmt::format("half-angle\n{}\xC2\xB0\nconfidence\n{:.2f}",
                                    std::lround(cone.half_angle / degree), cone.confidence)});
}

// The specimen turned about its axis, so that the cut lies at the angle.
void turn(CutView &view, double angle) {
  for (std::vector<Position> *column : {&view.spheres.position, &view.spheres.initial})
    for (Position &place : *column)
      place = turned(place, angle);
  if (!view.platens) return;
  for (vtkIdType k = 0; k < view.platens->GetNumberOfPoints(); ++k) {
    Position place;
    view.platens->GetPoint(k, place.data());
    view.platens->GetPoints()->SetPoint(k, turned(place, angle).data());
  }
}

// On top and at the bottom, where a box stays as it is and a cylinder is turned to their axes.
void mark_cones(CutView &view, const Run &run, ConeTime moment, const Extent &extent) {
  const FittedCone top = cone_of(run, Side::top, moment), bottom = cone_of(run, Side::bottom, moment);
  const bool turns = extent.form == Extent::Form::cylinder;
  const double angle = turns ? angle_of_axes({top, bottom}, extent.height()) : 0;
  if (turns) turn(view, angle);
  mark_cone(view, turned(top, angle), Side::top, extent);
  mark_cone(view, turned(bottom, angle), Side::bottom, extent);
}

CutView view_at(const Run &run, double time, Quantity quantity, const std::string &caption) {
  CutView view;
  view.caption = caption;
  view.spheres = read_spheres(nearest(run.specimen, time));
  view.values = values_of(view.spheres, quantity);
  if (!run.platens.empty()) view.platens = read_frame(nearest(run.platens, time));
  return view;
}

// At the fall to 0.8 of the peak, or at the end; with the cones that were fitted then where dead zones are
// shown.
CutView view_of(const Run &run, ConeTime moment, Quantity quantity, const Extent &extent) {
  CutView view = moment == ConeTime::fall
                     ? view_at(run, run.pattern_time(), quantity, "at " + run.pattern_words())
                     : view_at(run, run.moments.end_time, quantity, "at the end");
  if (quantity == Quantity::dead_zones) mark_cones(view, run, moment, extent);
  return view;
}

// What is compared when the stress has fallen, not at the end.
bool is_of_fall(Quantity quantity) {
  return quantity == Quantity::damage || quantity == Quantity::dead_zones;
}

Colouring colouring_of(Quantity quantity, const std::vector<CutView> &views) {
  const char *bar = words_of(quantity).bar;
  if (quantity == Quantity::pieces || quantity == Quantity::dead_zones)
    return {Ramp::pieces, {0, coloured}, bar};
  if (quantity == Quantity::damage) return {Ramp::damage, round_ticks(0, 1, 5), bar};
  return {Ramp::displacement, ticks_for(views), bar};
}

} // namespace

bool tells_fragments(const Run &run) {
  return !run.specimen.empty() && !read_spheres(run.specimen.front()).fragment.empty();
}

bool tells_dead_zones(const Run &run) {
  return run.moments.post_peak_time && !run.specimen.empty() &&
         !read_spheres(run.specimen.back()).moves_with.empty();
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
    if (run.specimen.empty() || (quantity == Quantity::pieces && !tells_fragments(run)) ||
        (quantity == Quantity::dead_zones && !tells_dead_zones(run)))
      continue;
    const Extent extent = extent_of(read_spheres(run.specimen.front()));
    views.push_back(view_of(run, is_of_fall(quantity) ? ConeTime::fall : ConeTime::end, quantity, extent));
    views.back().caption = run.name + ", " + views.back().caption;
    if (extent.height() > largest.height()) largest = extent;
  }
  const Words words = words_of(quantity);
  save_cut_views(words.title_compared, words.subtitle_compared, views, largest, colouring_of(quantity, views),
                 png);
}

namespace {

// " Cone at the end: on top ..., at the bottom ... ." of each time that is known.
std::string cones_in_words(const Run &run) {
  std::string text;
  const auto say = [&](const std::string &when, ConeTime time) {
    const FittedCone top = cone_of(run, Side::top, time), bottom = cone_of(run, Side::bottom, time);
    if (top.verdict == FittedCone::Verdict::not_measured &&
        bottom.verdict == FittedCone::Verdict::not_measured)
      return;
    text += " Cone " + when + ": on top " + words_of(top) + ", at the bottom " + words_of(bottom) + ".";
  };
  if (run.moments.post_peak_time) say("at " + run.pattern_words(), ConeTime::fall);
  say("at the end", ConeTime::end);
  return text;
}

} // namespace

std::string dead_zones_caption(const Run &run) {
  return "Half specimen, cut where the axes of the cones lie. Blue has moved with the bottom platen since "
         "the peak, "
         "orange with the top one." +
         cones_in_words(run) + " Outlines: the cone by displacement, fitted to what is coloured.";
}

} // namespace platen::apps::report
