#include "apps/report/chart.h"

#include <fmt/format.h>
#include <vtkAxis.h>
#include <vtkBrush.h>
#include <vtkChartLegend.h>
#include <vtkContextActor.h>
#include <vtkContextScene.h>
#include <vtkDoubleArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPen.h>
#include <vtkPlotArea.h>
#include <vtkPlotHistogram2D.h>
#include <vtkPlotPoints.h>
#include <vtkStringArray.h>
#include <vtkTable.h>
#include <vtkTextProperty.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "apps/output/file.h"
#include "apps/report/chart_svg.h"
#include "apps/report/letters.h"

namespace platen::apps::report {
namespace {

constexpr int left_margin = 170, right_margin = 60, foot = 150, plot_width = 1370; // pixels

vtkSmartPointer<vtkTable> table_of(const std::vector<std::vector<double>> &columns) {
  auto table = vtkSmartPointer<vtkTable>::New();
  for (const std::vector<double> &values : columns) {
    vtkNew<vtkDoubleArray> column;
    column->SetName(std::to_string(table->GetNumberOfColumns()).c_str());
    for (const double value : values)
      column->InsertNextValue(value);
    table->AddColumn(column);
  }
  return table;
}

vtkSmartPointer<vtkTable> table_of_finite(const std::vector<double> &x, const std::vector<double> &y) {
  std::vector<std::vector<double>> columns(2);
  for (std::size_t k = 0; k < x.size(); ++k)
    if (std::isfinite(x[k]) && std::isfinite(y[k])) columns[0].push_back(x[k]), columns[1].push_back(y[k]);
  return table_of(columns);
}

void add_label(vtkPlot *plot, const std::string &label) {
  constexpr std::size_t longest = 80;
  plot->SetLabel(" " + shortened(label, longest)); // VTK leaves no gap after the stroke
  plot->SetLegendVisibility(!label.empty());
}

// Ends of all curves and marks along one axis, a little air beyond them. Zero belongs into the picture: all
// that is drawn here is a sum or a strain since the start.
std::array<double, 2> range_of(const Chart &chart, std::size_t axis) {
  double low = 0, high = 0;
  for (const std::array<double, 2> &point : points_of(chart)) {
    low = std::min(low, point[axis]);
    high = std::max(high, point[axis]);
  }
  if (low == high) return {0, 1};
  const double air = 0.04 * (high - low);
  return {low < 0 ? low - air : 0, high > 0 ? high + air : 0};
}

void set_ticks(vtkAxis *axis, std::array<double, 2> range, const std::vector<Tick> &ticks) {
  vtkNew<vtkDoubleArray> positions;
  vtkNew<vtkStringArray> words;
  for (const Tick &tick : ticks) {
    positions->InsertNextValue(tick.place);
    words->InsertNextValue(tick.words);
  }
  axis->SetUnscaledRange(range[0], range[1]);
  axis->SetBehavior(vtkAxis::FIXED);
  axis->SetCustomTickPositions(positions, words);
  axis->SetTitle(""); // VTK would write it over the numbers; see add_axis_titles()
  set_letters(axis->GetLabelProperties(), small_size);
  axis->SetTickLength(8 * oversampling);
  axis->SetLabelOffset(12 * oversampling);
  axis->GetPen()->SetWidth(2 * oversampling);
  axis->GetPen()->SetColor(0, 0, 0);
  axis->GetGridPen()->SetColor(225, 225, 225);
  axis->GetGridPen()->SetWidth(oversampling);
}

void add_piece(vtkChartXY &chart, const Curve &curve) {
  const auto points = table_of({curve.x, curve.y});
  vtkPlot *plot = chart.AddPlot(vtkChart::LINE);
  plot->SetInputData(points, 0, 1);
  plot->SetColor(curve.colour[0], curve.colour[1], curve.colour[2], 255);
  plot->SetWidth(static_cast<float>(oversampling * curve.width));
  plot->GetPen()->SetLineType(curve.stroke == Stroke::solid ? vtkPen::SOLID_LINE : vtkPen::DASH_LINE);
  add_label(plot, curve.label);
}

void add_curve(vtkChartXY &chart, const Curve &curve) {
  for (const Curve &piece : pieces_of(curve))
    add_piece(chart, piece);
}

void add_mark(vtkChartXY &chart, const Mark &mark) {
  vtkPlot *plot =
      add_dots(chart, {mark.x}, {mark.y}, mark.colour,
               mark.shape == MarkShape::circle ? vtkPlotPoints::CIRCLE : vtkPlotPoints::DIAMOND, 16);
  plot->SetWidth(7 * oversampling); // the legend's sign is 2.3 times as large
  add_label(plot, mark.label);
}

std::vector<Tick> axis_ticks(std::array<double, 2> range, int intervals, Sign sign) {
  const std::vector<double> round = round_ticks(range[0], range[1], intervals);
  const double step = round.size() > 1 ? round[1] - round[0] : 1;
  const int digits = std::max(0, static_cast<int>(-std::floor(std::log10(step) + 1e-9)));
  const double slack = 1e-9 * step; // a tick on the border but for rounding is within
  std::vector<Tick> ticks;
  for (const double tick : round)
    if (tick >= range[0] - slack && tick <= range[1] + slack)
      ticks.push_back({tick, fmt::format("{:.{}f}", sign == Sign::dropped ? std::abs(tick) : tick, digits)});
  return ticks;
}

// From the x axis up, over the whole width; before the curves, which then lie on it.
void add_band(vtkChartXY &item, const Chart &chart, std::array<double, 2> x, double floor) {
  if (!(chart.band_top > floor)) return;
  constexpr int stations = 5; // VTK fills nothing between two
  std::vector<double> places;
  for (int k = 0; k < stations; ++k)
    places.push_back(x[0] + (x[1] - x[0]) * k / (stations - 1));
  auto *area = vtkPlotArea::SafeDownCast(item.AddPlot(vtkChart::AREA));
  area->SetInputData(table_of(
      {places, std::vector<double>(stations, floor), std::vector<double>(stations, chart.band_top)}));
  for (const int column : {0, 1, 2})
    area->SetInputArray(column, std::to_string(column));
  area->SetColor(228, 228, 228, 255);
  add_label(area, chart.band_label);
}

// All that stands in the legend.
std::string legend_words(const Chart &chart) {
  std::string words = chart.band_label;
  for (const Curve &curve : chart.curves)
    words += curve.label;
  for (const Mark &mark : chart.marks)
    words += mark.label;
  return words;
}

// Width and height of the legend in pixels, from the count and length of its lines; on the large side.
std::array<double, 2> legend_size(const Chart &chart) {
  double lines = 0, longest = 0;
  const auto count = [&](const std::string &label) {
    if (label.empty()) return;
    ++lines;
    longest = std::max(longest, std::min(80.0, static_cast<double>(code_points(label).size())));
  };
  for (const Curve &curve : chart.curves)
    count(curve.label);
  for (const Mark &mark : chart.marks)
    count(mark.label);
  if (!std::isnan(chart.band_top)) count(chart.band_label);
  return {100 + 0.56 * small_size * longest, 24 + 1.3 * small_size * lines};
}

void set_legend(vtkChartXY &chart, bool left, const std::string &words) {
  chart.SetShowLegend(true);
  vtkChartLegend *legend = chart.GetLegend();
  legend->SetInline(true);
  legend->SetDragEnabled(false);
  legend->SetHorizontalAlignment(left ? vtkChartLegend::LEFT : vtkChartLegend::RIGHT);
  legend->SetVerticalAlignment(vtkChartLegend::TOP);
  legend->SetLabelSize(oversampling * small_size);
  set_letters(legend->GetLabelProperties(), small_size, false, words);
  legend->SetSymbolWidth(60 * oversampling);
  legend->SetPadding(8 * oversampling);
  legend->GetBrush()->SetOpacity(0);
  legend->GetPen()->SetOpacity(0);
}

bool given(const std::array<double, 2> &range) {
  return range[0] != 0 || range[1] != 0;
}

std::array<double, 2> shown_x(const Chart &chart) {
  return given(chart.x_range) ? chart.x_range : x_range_of(chart);
}

void add_span_words(Canvas &canvas, const PlotArea &area, const Chart &chart) {
  constexpr double over = 24, width_of_letter = 0.6 * small_size; // pixels
  const std::array<double, 2> x = shown_x(chart);
  const double scale = area.width / (x[1] - x[0]); // pixels per unit
  for (const Span &span : chart.spans) {
    if ((span.to - span.from) * scale < width_of_letter * static_cast<double>(span.words.size())) continue;
    const double middle = area.left + scale * (0.5 * (span.from + span.to) - x[0]);
    canvas.add_text(span.words, middle / canvas.width(), (area.bottom + area.height + over) / canvas.height(),
                    small_size);
  }
}

vtkSmartPointer<vtkChartXY> chart_item(const ChartLayout &layout, const PlotArea &area) {
  const Chart &chart = layout.chart;
  auto item = frame_chart(area);
  add_band(*item, chart, layout.x, layout.y[0]);
  for (const Span &span : chart.spans)
    for (const double end : {span.from, span.to})
      add_curve(*item, {"", {end, end}, {layout.y[0], layout.y[1]}, {190, 190, 190}, Stroke::solid, 2});
  for (const Curve &curve : chart.curves)
    add_curve(*item, curve);
  for (const Mark &mark : chart.marks)
    add_mark(*item, mark);
  set_ticks(item->GetAxis(vtkAxis::BOTTOM), layout.x, layout.x_ticks);
  set_ticks(item->GetAxis(vtkAxis::LEFT), layout.y, layout.y_ticks);
  set_legend(*item, layout.legend_left, legend_words(chart));
  return item;
}

} // namespace

ChartLayout layout_of(const Chart &given_chart, double width, double height) {
  const Scale scale = given_chart.scale;
  ChartLayout layout;
  layout.chart = scale == Scale::linear ? given_chart : in_decades(given_chart);
  const Chart &chart = layout.chart;
  layout.x = shown_x(chart);
  layout.y = given(chart.y_range) ? chart.y_range : range_of(chart, 1);
  const auto [legend_width, legend_height] = legend_size(chart);
  const LegendPlace place =
      place_legend(chart, layout.x, layout.y, legend_width / width, legend_height / height);
  layout.legend_left = place.left;
  layout.y[1] = place.y_top;
  const bool x_decades = scale != Scale::linear, y_decades = scale == Scale::logarithmic;
  layout.x_ticks = x_decades ? decade_ticks(layout.x[0], layout.x[1]) : axis_ticks(layout.x, 8, Sign::shown);
  layout.y_ticks = y_decades ? decade_ticks(layout.y[0], layout.y[1])
                             : axis_ticks(layout.y, height > 700 ? 8 : 5, Sign::shown);
  return layout;
}

std::array<double, 2> x_range_of(const Chart &chart) {
  return range_of(chart, 0);
}

vtkSmartPointer<vtkChartXY> frame_chart(const PlotArea &area) {
  auto chart = vtkSmartPointer<vtkChartXY>::New();
  chart->SetLayoutStrategy(vtkChart::AXES_TO_RECT);
  const auto pixels = [](double size) { return static_cast<float>(oversampling * size); };
  chart->SetSize(vtkRectf(pixels(area.left), pixels(area.bottom), pixels(area.width), pixels(area.height)));
  return chart;
}

void set_axis(vtkAxis *axis, std::array<double, 2> range, int intervals, Sign sign) {
  set_ticks(axis, range, axis_ticks(range, intervals, sign));
}

vtkPlot *add_dots(vtkChartXY &chart, std::vector<double> x, std::vector<double> y, Colour colour, int marker,
                  float size) {
  if (x.size() == 1) // VTK draws no plot of one point; of the same point twice it does
    x.push_back(x[0]), y.push_back(y[0]);
  vtkPlot *plot = chart.AddPlot(vtkChart::POINTS);
  plot->SetInputData(table_of_finite(x, y), 0, 1);
  plot->SetColor(colour[0], colour[1], colour[2], 255);
  auto *points = vtkPlotPoints::SafeDownCast(plot);
  points->SetMarkerStyle(marker);
  points->SetMarkerSize(size * oversampling);
  return plot;
}

vtkSmartPointer<vtkChartXY> image_chart(const PlotArea &area, vtkImageData *image,
                                        vtkColorTransferFunction *ramp, std::array<double, 2> x,
                                        std::array<double, 2> y, Sign sign) {
  auto chart = frame_chart(area);
  vtkNew<vtkPlotHistogram2D> plot;
  plot->SetInputData(image);
  plot->SetTransferFunction(ramp);
  chart->AddPlot(plot);
  set_axis(chart->GetAxis(vtkAxis::BOTTOM), x, 4, sign);
  set_axis(chart->GetAxis(vtkAxis::LEFT), y, 8);
  return chart;
}

void add_axis_titles(Canvas &canvas, const PlotArea &area, const std::string &x_title,
                     const std::string &y_title) {
  constexpr double below = 80, beside = 135; // pixels, from axis to middle of the letters
  canvas.add_text(x_title, (area.left + 0.5 * area.width) / canvas.width(),
                  (area.bottom - below) / canvas.height(), text_size);
  canvas.add_upright_text(y_title, (area.left - beside) / canvas.width(),
                          (area.bottom + 0.5 * area.height) / canvas.height(), text_size, area.height + 60);
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
  ChartSvg svg(canvas.width(), height);
  double bottom = height - Canvas::head_height;
  for (std::size_t k = 0; k < charts.size(); ++k) {
    bottom -= heights[k];
    const PlotArea area{left_margin, bottom, plot_width, static_cast<double>(heights[k])};
    const ChartLayout layout = layout_of(charts[k], area.width, area.height);
    items.push_back(chart_item(layout, area));
    svg.add(layout, area);
    add_axis_titles(canvas, area, charts[k].x_title, charts[k].y_title);
    add_span_words(canvas, area, charts[k]);
    bottom -= foot;
  }
  add_chart_scene(canvas, items);
  canvas.add_head(title, subtitle);
  canvas.save(png);
  write_text_aside(std::filesystem::path(png).replace_extension(".svg"), svg.text(title, subtitle));
}

} // namespace platen::apps::report
