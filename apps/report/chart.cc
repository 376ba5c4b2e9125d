#include "apps/report/chart.h"

#include <vtkAxis.h>
#include <vtkBrush.h>
#include <vtkChartLegend.h>
#include <vtkContextActor.h>
#include <vtkContextScene.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPen.h>
#include <vtkPlotArea.h>
#include <vtkPlotPoints.h>
#include <vtkStringArray.h>
#include <vtkTable.h>
#include <vtkTextProperty.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace platen::apps::report {
namespace {

constexpr int left_margin = 170, right_margin = 60, foot = 150, plot_width = 1370; // pixels

vtkSmartPointer<vtkTable> table_of(const std::vector<double> &x, const std::vector<double> &y) {
  vtkNew<vtkDoubleArray> xs, ys;
  xs->SetName("x");
  ys->SetName("y");
  for (std::size_t k = 0; k < x.size(); ++k)
    if (std::isfinite(x[k]) && std::isfinite(y[k])) {
      xs->InsertNextValue(x[k]);
      ys->InsertNextValue(y[k]);
    }
  auto table = vtkSmartPointer<vtkTable>::New();
  table->AddColumn(xs);
  table->AddColumn(ys);
  return table;
}

// Ends of all curves and marks along one axis, a little air beyond them. Zero belongs into the picture: all
// that is drawn here is a sum or a strain since the start.
std::array<double, 2> range_of(const Chart &chart, std::vector<double> Curve::*values, double Mark::*place) {
  double low = 0, high = 0;
  for (const Curve &curve : chart.curves)
    for (std::size_t k = 0; k < curve.x.size(); ++k)
      if (std::isfinite(curve.x[k]) && std::isfinite(curve.y[k])) {
        low = std::min(low, (curve.*values)[k]);
        high = std::max(high, (curve.*values)[k]);
      }
  for (const Mark &mark : chart.marks) {
    low = std::min(low, mark.*place);
    high = std::max(high, mark.*place);
  }
  if (low == high) return {0, 1};
  const double air = 0.04 * (high - low);
  return {low < 0 ? low - air : 0, high > 0 ? high + air : 0};
}

void style_axis(vtkAxis *axis) {
  axis->SetTitle(""); // VTK would write it over the numbers; see add_axis_titles()
  set_letters(axis->GetLabelProperties(), small_size);
  axis->SetTickLength(8 * oversampling);
  axis->SetLabelOffset(12 * oversampling);
  axis->GetPen()->SetWidth(2 * oversampling);
  axis->GetPen()->SetColor(0, 0, 0);
  axis->GetGridPen()->SetColor(225, 225, 225);
  axis->GetGridPen()->SetWidth(oversampling);
}

int digits_of(const std::vector<double> &ticks) {
  const double step = ticks.size() > 1 ? ticks[1] - ticks[0] : 1;
  return std::max(0, static_cast<int>(-std::floor(std::log10(step) + 1e-9)));
}

void add_curve(vtkChartXY &chart, const Curve &curve) {
  const auto table = table_of(curve.x, curve.y);
  if (table->GetNumberOfRows() < 2) return;
  vtkPlot *plot = chart.AddPlot(vtkChart::LINE);
  plot->SetInputData(table, 0, 1);
  plot->SetColor(curve.colour[0], curve.colour[1], curve.colour[2], 255);
  plot->SetWidth(static_cast<float>(oversampling * curve.width));
  plot->GetPen()->SetLineType(curve.stroke == Stroke::solid ? vtkPen::SOLID_LINE : vtkPen::DASH_LINE);
  plot->SetLabel(" " + curve.label); // VTK leaves no gap after the stroke
  plot->SetLegendVisibility(!curve.label.empty());
}

void add_mark(vtkChartXY &chart, const Mark &mark) {
  vtkPlot *plot = chart.AddPlot(vtkChart::POINTS);
  // A plot of one point is not drawn by VTK; the same point twice is.
  plot->SetInputData(table_of({mark.x, mark.x}, {mark.y, mark.y}), 0, 1);
  plot->SetColor(mark.colour[0], mark.colour[1], mark.colour[2], 255);
  plot->SetWidth(7 * oversampling); // the legend's sign is 2.3 times as large
  auto *points = vtkPlotPoints::SafeDownCast(plot);
  points->SetMarkerStyle(mark.shape == MarkShape::circle ? vtkPlotPoints::CIRCLE : vtkPlotPoints::DIAMOND);
  points->SetMarkerSize(16 * oversampling);
  plot->SetLabel(" " + mark.label);
  plot->SetLegendVisibility(!mark.label.empty());
}

// From the x axis up, over the whole width; before the curves, which then lie on it.
void add_band(vtkChartXY &item, const Chart &chart, std::array<double, 2> x, double floor) {
  if (!(chart.band_top > floor)) return;
  constexpr int stations = 5; // VTK fills nothing between two
  vtkNew<vtkTable> table;
  const auto add_column = [&](const char *name, double at_left, double at_right) {
    vtkNew<vtkDoubleArray> column;
    column->SetName(name);
    for (int k = 0; k < stations; ++k)
      column->InsertNextValue(at_left + (at_right - at_left) * k / (stations - 1));
    table->AddColumn(column);
  };
  add_column("x", x[0], x[1]);
  add_column("low", floor, floor);
  add_column("high", chart.band_top, chart.band_top);
  auto *area = vtkPlotArea::SafeDownCast(item.AddPlot(vtkChart::AREA));
  area->SetInputData(table);
  area->SetInputArray(0, "x");
  area->SetInputArray(1, "low");
  area->SetInputArray(2, "high");
  area->SetColor(228, 228, 228, 255);
  area->SetLabel(" " + chart.band_label);
  area->SetLegendVisibility(!chart.band_label.empty());
}

// Width and height of the legend in pixels, from the count and length of its lines; on the large side.
std::array<double, 2> legend_size(const Chart &chart) {
  double lines = 0, longest = 0;
  const auto count = [&](const std::string &label) {
    if (label.empty()) return;
    ++lines;
    longest = std::max(longest, static_cast<double>(label.size()));
  };
  for (const Curve &curve : chart.curves)
    count(curve.label);
  for (const Mark &mark : chart.marks)
    count(mark.label);
  if (!std::isnan(chart.band_top)) count(chart.band_label);
  return {100 + 0.56 * small_size * longest, 24 + 1.3 * small_size * lines};
}

void set_legend(vtkChartXY &chart, bool left) {
  chart.SetShowLegend(true);
  vtkChartLegend *legend = chart.GetLegend();
  legend->SetInline(true);
  legend->SetDragEnabled(false);
  legend->SetHorizontalAlignment(left ? vtkChartLegend::LEFT : vtkChartLegend::RIGHT);
  legend->SetVerticalAlignment(vtkChartLegend::TOP);
  legend->SetLabelSize(oversampling * small_size);
  set_letters(legend->GetLabelProperties(), small_size);
  legend->SetSymbolWidth(60 * oversampling);
  legend->SetPadding(8 * oversampling);
  legend->GetBrush()->SetOpacity(0);
  legend->GetPen()->SetOpacity(0);
}

void set_decades(vtkAxis *axis, std::array<double, 2> range) {
  vtkNew<vtkDoubleArray> positions;
  vtkNew<vtkStringArray> words;
  for (const Tick &tick : decade_ticks(range[0], range[1])) {
    positions->InsertNextValue(tick.place);
    words->InsertNextValue(tick.words);
  }
  axis->SetUnscaledRange(range[0], range[1]);
  axis->SetBehavior(vtkAxis::FIXED);
  axis->SetCustomTickPositions(positions, words);
  style_axis(axis);
}

vtkSmartPointer<vtkChartXY> chart_item(const Chart &given_chart, const PlotArea &area) {
  const bool decades = given_chart.scale == Scale::logarithmic;
  const Chart chart = decades ? in_decades(given_chart) : given_chart;
  const auto given = [](const std::array<double, 2> &range) { return range[0] != 0 || range[1] != 0; };
  const std::array<double, 2> x = given(chart.x_range) ? chart.x_range : x_range_of(chart),
                              y = given(chart.y_range) ? chart.y_range : range_of(chart, &Curve::y, &Mark::y);
  const auto [legend_width, legend_height] = legend_size(chart);
  const LegendPlace place = place_legend(chart, x, y, legend_width / area.width, legend_height / area.height);

  auto item = frame_chart(area);
  add_band(*item, chart, x, y[0]);
  for (const Curve &curve : chart.curves)
    add_curve(*item, curve);
  for (const Mark &mark : chart.marks)
    add_mark(*item, mark);
  if (decades) {
    set_decades(item->GetAxis(vtkAxis::BOTTOM), x);
    set_decades(item->GetAxis(vtkAxis::LEFT), {y[0], place.y_top});
  } else {
    set_axis(item->GetAxis(vtkAxis::BOTTOM), x, 8);
    set_axis(item->GetAxis(vtkAxis::LEFT), {y[0], place.y_top}, area.height > 700 ? 8 : 5);
  }
  set_legend(*item, place.left);
  return item;
}

} // namespace

std::array<double, 2> x_range_of(const Chart &chart) {
  return range_of(chart, &Curve::x, &Mark::x);
}

void add_bar(Chart &chart, double x, double low, double high, double half_cap, Colour colour) {
  if (!(high > low)) return;
  constexpr double width = 3; // pixels
  chart.curves.push_back({"", {x, x}, {low, high}, colour, Stroke::solid, width});
  for (const double end : {low, high})
    chart.curves.push_back({"", {x - half_cap, x + half_cap}, {end, end}, colour, Stroke::solid, width});
}

Chart in_decades(Chart chart) {
  constexpr double infinite = std::numeric_limits<double>::infinity(), air = 0.06; // of an axis
  std::array<double, 2> x{infinite, -infinite}, y = x;
  const auto take = [](double &value, std::array<double, 2> &range) {
    value = value > 0 ? std::log10(value) : std::numeric_limits<double>::quiet_NaN();
    if (!std::isfinite(value)) return;
    range = {std::min(range[0], value), std::max(range[1], value)};
  };
  for (Curve &curve : chart.curves)
    for (std::size_t k = 0; k < curve.x.size(); ++k)
      take(curve.x[k], x), take(curve.y[k], y);
  for (Mark &mark : chart.marks)
    take(mark.x, x), take(mark.y, y);
  take(chart.band_top, y);
  const auto widened = [&](const std::array<double, 2> &range) -> std::array<double, 2> {
    if (!(range[1] >= range[0])) return {-1, 1};
    const double beyond = std::max(0.1, air * (range[1] - range[0]));
    return {range[0] - beyond, range[1] + beyond};
  };
  chart.x_range = widened(x), chart.y_range = widened(y);
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
      char text[32];
      std::snprintf(text, sizeof text, "%g", factor * std::pow(10, decade));
      ticks.push_back({place, text});
    }
  return ticks;
}

LegendPlace place_legend(const Chart &chart, std::array<double, 2> x, std::array<double, 2> y, double width,
                         double height) {
  const double span_x = x[1] - x[0], floor_y = y[1] - height * (y[1] - y[0]);
  double highest[] = {-std::numeric_limits<double>::infinity(),
                      -std::numeric_limits<double>::infinity()}; // right, left
  const auto meet = [&](double px, double py) {
    if (px > x[1] - width * span_x) highest[0] = std::max(highest[0], py);
    if (px < x[0] + width * span_x) highest[1] = std::max(highest[1], py);
  };
  for (const Curve &curve : chart.curves)
    for (std::size_t k = 0; k < curve.x.size(); ++k)
      if (std::isfinite(curve.y[k])) meet(curve.x[k], curve.y[k]);
  for (const Mark &mark : chart.marks)
    meet(mark.x, mark.y);

  LegendPlace place{highest[1] < highest[0], y[1]};
  const double obstacle = std::min(highest[0], highest[1]);
  if (obstacle > floor_y) place.y_top = y[0] + (obstacle - y[0]) / (1 - std::min(height, 0.6) - 0.02);
  place.y_top = std::max(place.y_top, y[1]);
  return place;
}

vtkSmartPointer<vtkChartXY> frame_chart(const PlotArea &area) {
  auto chart = vtkSmartPointer<vtkChartXY>::New();
  chart->SetLayoutStrategy(vtkChart::AXES_TO_RECT);
  const auto pixels = [](double size) { return static_cast<float>(oversampling * size); };
  chart->SetSize(vtkRectf(pixels(area.left), pixels(area.bottom), pixels(area.width), pixels(area.height)));
  return chart;
}

void set_axis(vtkAxis *axis, std::array<double, 2> range, int intervals, Sign sign) {
  const std::vector<double> ticks = round_ticks(range[0], range[1], intervals);
  vtkNew<vtkDoubleArray> positions;
  vtkNew<vtkStringArray> words;
  for (const double tick : ticks) {
    if (tick < range[0] - 1e-9 || tick > range[1] + 1e-9) continue;
    positions->InsertNextValue(tick);
    char text[32];
    std::snprintf(text, sizeof text, "%.*f", digits_of(ticks), sign == Sign::dropped ? std::abs(tick) : tick);
    words->InsertNextValue(text);
  }
  axis->SetUnscaledRange(range[0], range[1]);
  axis->SetBehavior(vtkAxis::FIXED);
  axis->SetCustomTickPositions(positions, words);
  style_axis(axis);
}

void add_axis_titles(Canvas &canvas, const PlotArea &area, const std::string &x_title,
                     const std::string &y_title) {
  constexpr double below = 80, beside = 135; // pixels, from axis to middle of the letters
  canvas.add_text(x_title, (area.left + 0.5 * area.width) / canvas.width(),
                  (area.bottom - below) / canvas.height(), text_size);
  canvas.add_upright_text(y_title, (area.left - beside) / canvas.width(),
                          (area.bottom + 0.5 * area.height) / canvas.height(), text_size);
}

void add_chart_scene(Canvas &canvas, const std::vector<vtkSmartPointer<vtkChartXY>> &charts) {
  vtkRenderer *renderer = canvas.add_renderer({0, 0, 1, 1});
  vtkNew<vtkContextActor> actor;
  renderer->AddActor(actor);
  actor->GetScene()->SetRenderer(renderer);
  for (const auto &chart : charts)
    actor->GetScene()->AddItem(chart);
}

void save_charts(const std::string &title, const std::string &subtitle, const std::vector<Chart> &charts,
                 const std::vector<int> &heights, const std::filesystem::path &png) {
  int height = Canvas::head_height;
  for (std::size_t k = 0; k < charts.size(); ++k)
    height += heights[k] + foot;
  Canvas canvas(left_margin + plot_width + right_margin, height);
  std::vector<vtkSmartPointer<vtkChartXY>> items;
  double bottom = height - Canvas::head_height;
  for (std::size_t k = 0; k < charts.size(); ++k) {
    bottom -= heights[k];
    const PlotArea area{left_margin, bottom, plot_width, static_cast<double>(heights[k])};
    items.push_back(chart_item(charts[k], area));
    add_axis_titles(canvas, area, charts[k].x_title, charts[k].y_title);
    bottom -= foot;
  }
  add_chart_scene(canvas, items);
  canvas.add_head(title, subtitle);
  canvas.save(png);
}

} // namespace platen::apps::report
