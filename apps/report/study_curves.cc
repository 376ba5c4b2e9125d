// Strength against the friction of platens and against slenderness, with the laboratory's points.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "apps/report/chart.h"
#include "apps/report/platen_study.h"

namespace platen::apps::report {
namespace {

constexpr double nearly = 1e-9;    // of a slenderness
constexpr double about = 0.05;     // of a slenderness that the laboratory's stands beside
constexpr double dry_steel = 0.57; // where the laboratory's platens of steel are drawn
constexpr double half_cap = 0.006; // of the x axis: ends of the bars of scatter
constexpr double aside = 0.02;     // of the x axis: the laboratory's points beside the study's
constexpr double gain_step = 0.1;  // ratios are drawn between multiples of this
constexpr const char *gain = "gain over free ends", *relative = "strength over that at slenderness 2";

std::string height_words(double slenderness) {
  return fmt::format("height/width {:.3g}", slenderness);
}

constexpr Spread nothing_measured{no_band, no_band, no_band};

struct Point {
  double x;
  Spread y;
};

// The strength and, below it, one of its ratios over the same quantity.
struct Figure {
  const StudyResults &study;
  const std::vector<std::size_t> &cases;
  double StudiedCase::*x;
  const char *effect;
  double span;    // of the x axis
  bool from_zero; // whether a 0 on the x axis says something
  Chart strength, ratio;
};

// Points joined in the order of x, with bars of scatter.
void add_points(Chart &chart, std::vector<Point> points, const std::string &label, Colour colour,
                double span) {
  std::sort(points.begin(), points.end(), [](const Point &a, const Point &b) { return a.x < b.x; });
  Curve joined{label, {}, {}, colour};
  for (const Point &p : points) {
    joined.x.push_back(p.x), joined.y.push_back(p.y.mean); // not a number: a gap
    if (std::isnan(p.y.mean)) continue;
    add_bar(chart, p.x, p.y.low, p.y.high, half_cap * span, colour);
    chart.marks.push_back({p.x, p.y.mean, points.size() == 1 ? label : "", colour, MarkShape::circle});
  }
  chart.curves.push_back(std::move(joined));
}

// Both curves of the cases that may be taken; whether there are ratios. Where they are taken over, they are
// one.
template <class May>
bool add_curves(Figure &figure, const std::string &label, Colour colour, const May &may) {
  std::vector<Point> strengths, ratios;
  const StudiedCase *reference = nullptr;
  for (const std::size_t k : figure.cases) {
    const StudiedCase &one = figure.study.cases[k];
    if (!may(one)) continue;
    if (one.without_peak > 0) { // a gap
      strengths.push_back({one.*figure.x, nothing_measured});
      ratios.push_back({one.*figure.x, nothing_measured});
      continue;
    }
    strengths.push_back({one.*figure.x, one.strength});
    const StudiedRatio *found = figure.study.ratio_of(k, figure.effect);
    if (found == nullptr || !found->reason.empty()) continue;
    ratios.push_back({one.*figure.x, found->ratio});
    reference = &figure.study.cases[found->over];
  }
  add_points(figure.strength, strengths, label, colour, figure.span);
  if (reference == nullptr) return false;
  ratios.push_back({reference->*figure.x, {1, 1, 1}});
  add_points(figure.ratio, ratios, label, colour, figure.span);
  return true;
}

void add_laboratory(Figure &figure, double x, const Spread &y, const std::string &label, Colour colour) {
  add_bar(figure.ratio, x, y.low, y.high, half_cap * figure.span, colour);
  figure.ratio.marks.push_back({x, y.mean, label, colour, MarkShape::diamond});
}

// The ratio between round values around all that is drawn, one among them.
void set_ratio_range(Chart &chart) {
  double low = 1, high = 1;
  for (const auto &[x, y] : points_of(chart))
    low = std::min(low, y), high = std::max(high, y);
  chart.y_range = {gain_step * (std::floor(low / gain_step + nearly) - 1),
                   gain_step * (std::ceil(high / gain_step - nearly) + 1)};
}

std::string scatter_words(const StudyResults &study) {
  int most = 0;
  for (const StudiedCase &one : study.cases)
    most = std::max(most, one.runs);
  return words_of_scatter(most);
}

// At one x axis.
void save(Figure &figure, const std::string &subtitle, const std::string &x_title,
          const std::string &ratio_title, const std::filesystem::path &png) {
  figure.strength.x_title = figure.ratio.x_title = x_title;
  figure.strength.y_title = "Strength (MPa)";
  figure.ratio.y_title = ratio_title;
  std::vector<Chart> charts{figure.strength};
  if (!figure.ratio.curves.empty()) {
    set_ratio_range(figure.ratio);
    charts.push_back(figure.ratio);
  }
  std::array<double, 2> range = figure.from_zero ? x_range_of(charts.back()) : snug_x_range(charts.back());
  const auto [low, high] = figure.from_zero ? x_range_of(charts.front()) : snug_x_range(charts.front());
  range = {std::min(range[0], low), std::max(range[1], high)};
  for (Chart &chart : charts)
    chart.x_range = range;
  save_charts(figure.study.title, subtitle + scatter_words(figure.study), charts,
              std::vector<int>(charts.size(), 700), png);
}

std::vector<double> slendernesses_of(const StudyResults &study, const std::vector<std::size_t> &cases) {
  std::set<double> values;
  for (const std::size_t k : cases)
    values.insert(study.cases[k].slenderness);
  return {values.begin(), values.end()};
}

std::vector<std::string> surfaces_of(const StudyResults &study, const std::vector<std::size_t> &cases) {
  std::vector<std::string> words;
  for (const std::size_t k : cases)
    if (std::find(words.begin(), words.end(), study.cases[k].surface) == words.end())
      words.push_back(study.cases[k].surface);
  return words;
}

} // namespace

void draw_friction(const StudyResults &study, const std::vector<std::size_t> &cases,
                   const std::filesystem::path &png) {
  Figure figure{study, cases, &StudiedCase::friction, gain, dry_steel, true, {}, {}};
  for (const std::size_t k : cases)
    if (study.cases[k].plain) figure.span = std::max(figure.span, study.cases[k].friction);
  std::size_t count = 0;
  for (const double slenderness : slendernesses_of(study, cases)) {
    const Colour colour = run_colour(count++);
    const auto may = [&](const StudiedCase &one) { return one.plain && one.slenderness == slenderness; };
    if (!add_curves(figure, height_words(slenderness), colour, may)) continue;
    for (const LaboratoryPoint &p : study.laboratory)
      if (p.effect == gain && std::abs(p.slenderness - slenderness) <= about * slenderness)
        add_laboratory(figure, dry_steel + aside * figure.span, p.ratio,
                       height_words(p.slenderness) + ", " + p.source, colour);
  }
  save(figure, "Strength against the friction of the platens", "Coefficient of friction of the platens",
       "Gain over free ends", png);
}

void draw_slenderness(const StudyResults &study, const std::vector<std::size_t> &cases,
                      const std::filesystem::path &png) {
  const std::vector<double> heights = slendernesses_of(study, cases);
  const double span = heights.back();
  Figure figure{study, cases, &StudiedCase::slenderness, relative, span, false, {}, {}};
  std::size_t count = 0;
  for (const std::string &surface : surfaces_of(study, cases))
    add_curves(figure, surface, run_colour(count++),
               [&](const StudiedCase &one) { return one.surface == surface; });
  std::set<std::string> named;
  for (const LaboratoryPoint &p : study.laboratory) {
    if (figure.ratio.curves.empty() || p.effect != relative ||
        p.slenderness < (1 - about) * heights.front() || p.slenderness > (1 + about) * span)
      continue;
    const std::string words = (p.free_ends ? "Teflon, " : "steel, ") + p.source;
    const bool band = p.ratio.low < p.ratio.high;
    add_laboratory(figure, p.slenderness + (band ? (p.free_ends ? -aside : aside) * span : 0.0), p.ratio,
                   named.insert(words).second ? words : "",
                   !band ? colours::black : (p.free_ends ? colours::orange : colours::grey));
  }
  save(figure, "Strength against slenderness", "Height over width", "Strength over that at 2", png);
}

} // namespace platen::apps::report
