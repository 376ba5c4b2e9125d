// The pieces of the specimen and the cones among them.
#include <cmath>

#include "apps/report/cones.h"
#include "apps/report/pictures.h"
#include "apps/report/specimen_view.h"
#include "base/pi.h"

namespace platen::apps::report {
namespace {

constexpr double degree = pi / 180;
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

// The outline where the cone is now, and its angle (or that there is none) beside the specimen.
void mark_cone(CutView &view, const FittedCone &cone, PlatenEnd end, const Extent &extent) {
  if (cone.verdict == FittedCone::Verdict::not_measured) return;
  const double up = end == PlatenEnd::top ? 1 : -1;
  const double beside = extent.half_width + 0.19 * extent.height() / 2,
               height = (end == PlatenEnd::top ? extent.top : extent.bottom) - up * 0.09 * extent.height();
  if (cone.verdict == FittedCone::Verdict::none) {
    view.notes.push_back({{beside, 0, height}, "no cone"});
    return;
  }
  const std::array<double, 3> moved = carried(cone, view.spheres);
  Outline outline;
  for (const auto &[x, z] : section_of(cone, end, extent))
    outline.push_back({x + moved[0], moved[1], z + moved[2]});
  if (!outline.empty()) view.outlines.push_back(std::move(outline));
  view.notes.push_back({{beside, 0, height},
                        "half-angle\n" + std::to_string(std::lround(cone.half_angle / degree)) + "\xC2\xB0"});
}

CutView view_of_pieces(const Run &run, const Extent &extent, ConeTime moment) {
  const double time = moment == ConeTime::fall ? run.pattern_time() : run.moments.end_time;
  CutView view;
  view.caption = moment == ConeTime::fall ? "at " + run.pattern_words() : "at the end";
  view.spheres = read_spheres(run.specimen.nearest(time));
  view.values = colours_of_pieces(view.spheres);
  if (!run.platens.empty()) view.platens = read_frame(run.platens.nearest(time));
  for (const PlatenEnd end : {PlatenEnd::top, PlatenEnd::bottom})
    mark_cone(view, cone_of(run, end, moment), end, extent);
  return view;
}

} // namespace

bool tells_fragments(const Run &run) {
  return !run.specimen.empty() && !read_spheres(run.specimen.frames.front()).fragment.empty();
}

void draw_fragments(const Run &run, const Extent &extent, const std::filesystem::path &png) {
  std::vector<CutView> views;
  if (run.moments.post_peak_time) views.push_back(view_of_pieces(run, extent, ConeTime::fall));
  views.push_back(view_of_pieces(run, extent, ConeTime::end));
  const Colouring colouring{Ramp::pieces, {0, coloured}, ""};
  save_cut_views(run.title, "Pieces that bonds hold together (grey: below 30 spheres) and fitted cones",
                 views, extent, colouring, png);
}

void draw_fragments_comparison(const std::vector<Run> &runs, const std::filesystem::path &png) {
  std::vector<CutView> views;
  Extent largest;
  for (const Run &run : runs) {
    if (!tells_fragments(run)) continue;
    const Extent extent = extent_of(read_spheres(run.specimen.frames.front()));
    views.push_back(view_of_pieces(run, extent, ConeTime::end));
    views.back().caption = run.name + ", at the end";
    if (extent.height() > largest.height()) largest = extent;
  }
  const Colouring colouring{Ramp::pieces, {0, coloured}, ""};
  save_cut_views("Pieces and cones compared", "Grey: pieces of fewer than 30 spheres", views, largest,
                 colouring, png);
}

std::string fragments_caption(const Run &run) {
  std::string text = "Half specimen, the pieces that bonds still hold together in colours.";
  const auto say = [&](const std::string &when, ConeTime time) {
    const FittedCone top = cone_of(run, PlatenEnd::top, time), bottom = cone_of(run, PlatenEnd::bottom, time);
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
