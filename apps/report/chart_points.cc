// Charts as numbers: their points, ranges, ticks of decades, and where a legend hides none of them.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "apps/report/chart.h"

namespace platen::apps::report {

Chart chart_with_axes(const std::string &x_title, const std::string &y_title) {
  Chart chart;
  chart.x_title = x_title, chart.y_title = y_title;
  return chart;
}

std::vector<double> scaled(std::vector<double> values, double factor) {
  for (double &value : values)
    value *= factor;
  return values;
}

std::vector<std::array<double, 2>> points_of(const Chart &chart) {
  std::vector<std::array<double, 2>> points;
  const auto add = [&points](double x, double y) {
    if (std::isfinite(x) && std::isfinite(y)) points.push_back({x, y});
  };
  for (const Curve &curve : chart.curves)
    for (std::size_t k = 0; k < curve.x.size(); ++k)
      add(curve.x[k], curve.y[k]);
  for (const Mark &mark : chart.marks)
    add(mark.x, mark.y);
  return points;
}

void add_bar(Chart &chart, double x, double low, double high, double half_cap, Colour colour) {
  if (!(high > low)) return;
  constexpr double width = 3; // pixels
  chart.curves.push_back({"", {x, x}, {low, high}, colour, Stroke::solid, width});
  for (const double end : {low, high})
    chart.curves.push_back({"", {x - half_cap, x + half_cap}, {end, end}, colour, Stroke::solid, width});
}

std::array<double, 2> snug_range(double low, double high) {
  constexpr double air = 0.06, alone = 0.1; // of the range; of the value where there is one alone
  const double beyond = high > low ? air * (high - low) : low == 0 ? 1 : alone * std::abs(low);
  return {low - beyond, high + beyond};
}

std::array<double, 2> snug_x_range(const Chart &chart) {
  const std::vector<std::array<double, 2>> points = points_of(chart);
  if (points.empty()) return {0, 1};
  const auto [low, high] = std::minmax_element(points.begin(), points.end(),
                                               [](const auto &a, const auto &b) { return a[0] < b[0]; });
  return snug_range((*low)[0], (*high)[0]);
}

std::vector<Curve> pieces_of(const Curve &curve) {
  std::vector<Curve> pieces;
  Curve piece = curve;
  piece.x.clear(), piece.y.clear();
  const auto end = [&]() {
    if (piece.x.size() > 1) pieces.push_back(piece), piece.label.clear();
    piece.x.clear(), piece.y.clear();
  };
  for (std::size_t k = 0; k < curve.x.size(); ++k)
    if (std::isfinite(curve.x[k]) && std::isfinite(curve.y[k]))
      piece.x.push_back(curve.x[k]), piece.y.push_back(curve.y[k]);
    else
      end();
  end();
  return pieces;
}

Chart in_decades(Chart chart) {
  const bool y_too = chart.scale != Scale::logarithmic_x;
  constexpr double infinite = std::numeric_limits<double>::infinity(), air = 0.06; // of an axis
  std::array<double, 2> x{infinite, -infinite}, y = x;
  const auto take = [](double &value, std::array<double, 2> &range) {
    value = value > 0 ? std::log10(value) : std::numeric_limits<double>::quiet_NaN();
    if (!std::isfinite(value)) return;
    range = {std::min(range[0], value), std::max(range[1], value)};
  };
  for (Curve &curve : chart.curves)
    for (std::size_t k = 0; k < curve.x.size(); ++k) {
      take(curve.x[k], x);
      if (y_too) take(curve.y[k], y);
    }
  for (Mark &mark : chart.marks) {
    take(mark.x, x);
    if (y_too) take(mark.y, y);
  }
  if (y_too) take(chart.band_top, y);
  const auto widened = [&](const std::array<double, 2> &range) -> std::array<double, 2> {
    if (!(range[1] >= range[0])) return {-1, 1};
    const double beyond = std::max(0.1, air * (range[1] - range[0]));
    return {range[0] - beyond, range[1] + beyond};
  };
  chart.x_range = widened(x);
  if (y_too) chart.y_range = widened(y);
  return chart;
}

std::vector<Tick> decade_ticks(double low, double high) {
  std::vector<double> factors{1, 2, 5};
  if (high - low > 3) factors = {1};
  if (high - low < 1) factors = {1, 2, 3, 4, 5, 6, 7, 8, 9};
  std::vector<Tick> ticks;
  for (double decade = std::floor(low); decade <= high; ++decade)
    for (const double factor : factors) {
      const double place = decade + std::log10(factor);
      if (place < low || place > high) continue;
      ticks.push_back({place, fmt::format("{:g}", factor * std::pow(10, decade))});
    }
  return ticks;
}

LegendPlace place_legend(const Chart &chart, std::array<double, 2> x, std::array<double, 2> y, double width,
                         double height) {
  const double span_x = x[1] - x[0], floor_y = y[1] - height * (y[1] - y[0]);
  double highest[] = {-std::numeric_limits<double>::infinity(),
                      -std::numeric_limits<double>::infinity()}; // right, left
  for (const auto &[px, py] : points_of(chart)) {
    if (px > x[1] - width * span_x) highest[0] = std::max(highest[0], py);
    if (px < x[0] + width * span_x) highest[1] = std::max(highest[1], py);
  }

  LegendPlace place{highest[1] < highest[0], y[1]};
  const double obstacle = std::min(highest[0], highest[1]);
  if (obstacle > floor_y) place.y_top = y[0] + (obstacle - y[0]) / (1 - std::min(height, 0.6) - 0.02);
  place.y_top = std::max(place.y_top, y[1]);
  return place;
}

} // namespace platen::apps::report
