// Strength against the friction of platens and against slenderness, with the laboratory's points.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>

#include "apps/report/chart.h"
#include "apps/report/study_pictures.h"

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
  char text[48];
  std::snprintf(text, sizeof text, "height/width %.3g", slenderness);
  return text;
}

struct Point {
  double x;
  Spread y;
};

// Points joined in the order of x, with bars of scatter; `span` is the length of the x axis.
void add_points(Chart &chart, std::vector<Point> points, const std::string &label, Colour colour,
                double span) {
  std::sort(points.begin(), points.end(), [](const Point &a, const Point &b) { return a.x < b.x; });
  Curve joined{label, {}, {}, colour};
  for (const Point &p : points) {
    if (std::isnan(p.y.mean)) continue;
    joined.x.push_back(p.x), joined.y.push_back(p.y.mean);
    add_bar(chart, p.x, p.y.low, p.y.high, half_cap * span, colour);
    chart.marks.push_back({p.x, p.y.mean, points.size() == 1 ? label : "", colour, MarkShape::circle});
  }
  chart.curves.push_back(std::move(joined));
}

void add_laboratory(Chart &chart, double x, const Spread &y, const std::string &label, Colour colour,
                    double span) {
  add_bar(chart, x, y.low, y.high, half_cap * span, colour);
  chart.marks.push_back({x, y.mean, label, colour, MarkShape::diamond});
}

// Between round ratios around all that is drawn, one among them.
void set_ratio_range(Chart &chart) {
  double low = 1, high = 1;
  const auto hold = [&](double y) { low = std::min(low, y), high = std::max(high, y); };
  for (const Curve &curve : chart.curves)
    for (const double y : curve.y)
      hold(y);
  for (const Mark &mark : chart.marks)
    hold(mark.y);
  chart.y_range = {gain_step * (std::floor(low / gain_step + nearly) - 1),
                   gain_step * (std::ceil(high / gain_step - nearly) + 1)};
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
  Chart strength, gains;
  double span = dry_steel;
  for (const std::size_t k : cases)
    if (study.cases[k].plain) span = std::max(span, study.cases[k].friction);
  std::size_t colour = 0;
  for (const double slenderness : slendernesses_of(study, cases)) {
    std::vector<Point> strengths, ratios;
    const StudiedCase *free_ends = nullptr;
    for (const std::size_t k : cases) {
      const StudiedCase &one = study.cases[k];
      if (!one.plain || one.without_peak > 0 || one.slenderness != slenderness) continue;
      strengths.push_back({one.friction, one.strength});
      const StudiedRatio *ratio = study.ratio_of(k, gain);
      if (ratio == nullptr) continue;
      ratios.push_back({one.friction, ratio->ratio});
      free_ends = &study.cases[ratio->over];
    }
    const Colour own = run_colour(colour++);
    const std::string words = height_words(slenderness);
    add_points(strength, strengths, words, own, span);
    if (ratios.empty()) continue;
    if (free_ends != nullptr) ratios.push_back({free_ends->friction, {1, 1, 1}});
    add_points(gains, ratios, words, own, span);
    for (const LaboratoryPoint &p : study.laboratory)
      if (p.effect == gain && std::abs(p.slenderness - slenderness) <= about * slenderness)
        add_laboratory(gains, dry_steel + aside * span, p.ratio,
                       height_words(p.slenderness) + ", " + p.source, own, span);
  }
  strength.x_title = gains.x_title = "Coefficient of friction of the platens";
  strength.y_title = "Strength (MPa)";
  gains.y_title = "Gain over free ends";
  std::vector<Chart> charts{strength};
  std::vector<int> heights{700};
  if (!gains.curves.empty()) {
    set_ratio_range(gains);
    gains.x_range = x_range_of(gains);
    charts.front().x_range = gains.x_range; // one above the other
    charts.push_back(gains);
    heights.push_back(700);
  }
  save_charts(study.title, "Strength against the friction of the platens", charts, heights, png);
}

void draw_slenderness(const StudyResults &study, const std::vector<std::size_t> &cases,
                      const std::filesystem::path &png) {
  Chart strength, ratio;
  const std::vector<double> heights_drawn = slendernesses_of(study, cases);
  const double span = heights_drawn.back();
  std::size_t colour = 0;
  for (const std::string &surface : surfaces_of(study, cases)) {
    std::vector<Point> strengths, ratios;
    for (const std::size_t k : cases) {
      const StudiedCase &one = study.cases[k];
      if (one.without_peak > 0 || one.surface != surface) continue;
      strengths.push_back({one.slenderness, one.strength});
      if (const StudiedRatio *found = study.ratio_of(k, relative))
        ratios.push_back({one.slenderness, found->ratio});
    }
    const Colour own = run_colour(colour++);
    add_points(strength, strengths, surface, own, span);
    if (ratios.empty()) continue;
    ratios.push_back({2, {1, 1, 1}});
    add_points(ratio, ratios, surface, own, span);
  }
  if (!ratio.curves.empty()) {
    std::set<std::string> named;
    for (const LaboratoryPoint &p : study.laboratory) {
      if (p.effect != relative || p.slenderness < (1 - about) * heights_drawn.front() ||
          p.slenderness > (1 + about) * span)
        continue;
      const std::string words = (p.free_ends ? "Teflon, " : "steel, ") + p.source;
      const bool band = p.ratio.low < p.ratio.high;
      add_laboratory(ratio, p.slenderness + (band ? (p.free_ends ? -aside : aside) * span : 0.0), p.ratio,
                     named.insert(words).second ? words : "",
                     !band ? colours::black : (p.free_ends ? colours::orange : colours::grey), span);
    }
    set_ratio_range(ratio);
  }
  strength.x_title = ratio.x_title = "Height over width";
  strength.y_title = "Strength (MPa)";
  ratio.y_title = "Strength over that at 2";
  std::vector<Chart> charts{strength};
  std::vector<int> heights{700};
  if (!ratio.curves.empty()) {
    ratio.x_range = x_range_of(ratio);
    charts.front().x_range = ratio.x_range;
    charts.push_back(ratio);
    heights.push_back(700);
  }
  save_charts(study.title, "Strength against slenderness", charts, heights, png);
}

} // namespace platen::apps::report
