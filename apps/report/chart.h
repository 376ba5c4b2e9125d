// Line charts in the house form: white ground, units at the axes, round ticks, a legend that hides no curve.
#pragma once

#include <vtkChartXY.h>
#include <vtkSmartPointer.h>

#include <array>
#include <limits>
#include <string>
#include <vector>

#include "apps/report/canvas.h"

class vtkImageData;

namespace platen::apps::report {

constexpr double mm_per_m = 1e3, pa_per_mpa = 1e6; // of axes and colour bars

enum class Stroke { solid, dashed };

struct Curve {
  std::string label;        // empty: not in the legend
  std::vector<double> x, y; // a point with a value that is not finite leaves a gap
  Colour colour = colours::black;
  Stroke stroke = Stroke::solid;
  double width = 4; // pixels
};

enum class MarkShape { circle, diamond };

struct Mark { // a dot
  double x = 0, y = 0;
  std::string label; // as above
  Colour colour = colours::black;
  MarkShape shape = MarkShape::circle;
};

constexpr double no_band = std::numeric_limits<double>::quiet_NaN();

struct Span { // of the x axis: lines at its ends, words over the plot where there is room for them
  double from = 0, to = 0;
  std::string words;
};

enum class Scale { linear, logarithmic_x, logarithmic };

struct Chart {
  std::string x_title, y_title; // with units
  std::vector<Curve> curves;
  std::vector<Mark> marks;
  std::array<double, 2> x_range{0, 0}; // both 0: from the curves
  std::array<double, 2> y_range{0, 0}; // the same
  // Of both axes, or of x alone. Logarithmic: the range from the curves, points above 0 alone.
  Scale scale = Scale::linear;
  double band_top = no_band; // grey from the x axis up to here
  std::string band_label;    // as above
  std::vector<Span> spans;   // of a linear scale
};

// An empty one.
Chart chart_with_axes(const std::string &x_title, const std::string &y_title);

// All values times a factor.
std::vector<double> scaled(std::vector<double> values, double factor);

// A bar of scatter from `low` to `high`, with caps of half a width in units of x; nothing where both are the
// same.
void add_bar(Chart &chart, double x, double low, double high, double half_cap, Colour colour);

// The same chart with decimal logarithms for values along its logarithmic axes, ranges around all of them,
// the top of the band among them.
Chart in_decades(Chart chart);

// A little beyond both ends: for axes on which nothing stands still at 0, as a size or a slenderness.
std::array<double, 2> snug_range(double low, double high);
// The x range of all points of the chart, snug.
std::array<double, 2> snug_x_range(const Chart &chart);

// The pieces of a curve between its gaps, each of two points or more; the first has the label.
std::vector<Curve> pieces_of(const Curve &curve);

// Places of ticks between two decimal logarithms, and what stands there: powers of ten, with multiples of
// them where there are few.
struct Tick {
  double place;
  std::string words;
};
std::vector<Tick> decade_ticks(double low, double high);

// All points of its curves and marks, but for those that are not finite.
std::vector<std::array<double, 2>> points_of(const Chart &chart);
// The x range that a chart takes from its curves and marks; holds zero.
std::array<double, 2> x_range_of(const Chart &chart);

// Where the legend stands and how far the y axis reaches for it.
struct LegendPlace {
  bool left = false; // in the upper left corner, else in the upper right
  double y_top = 0;  // upper end of the y axis
};

// The upper corner where a legend of the given size (fractions of the plot) hides no curve; where each does,
// the y axis is made longer. `x` and `y` are the ranges of the axes without a legend.
LegendPlace place_legend(const Chart &chart, std::array<double, 2> x, std::array<double, 2> y, double width,
                         double height);

// A chart as it is drawn: logarithms taken, ranges and ticks chosen, the legend placed.
struct ChartLayout {
  Chart chart;
  std::array<double, 2> x{}, y{}; // ranges of the axes
  std::vector<Tick> x_ticks, y_ticks;
  bool legend_left = false;
};
// In a plot of the given size in pixels.
ChartLayout layout_of(const Chart &chart, double width, double height);

// Draws charts one above the other, plots of the given heights (pixels, one a chart or more), with a head
// over all, and writes them as `png` and as SVG beside it. Throws OutputError.
void save_charts(const std::string &title, const std::string &subtitle, const std::vector<Chart> &charts,
                 const std::vector<int> &heights, const std::filesystem::path &png);

// Pieces that other pictures use too.

// Where the axes of a chart stand, in pixels of the written picture, origin lower left.
struct PlotArea {
  double left = 0, bottom = 0, width = 0, height = 0;
};
// An empty chart whose axes stand there.
vtkSmartPointer<vtkChartXY> frame_chart(const PlotArea &area);
enum class Sign { shown, dropped };
// An axis over `range` with round ticks, about `intervals` of them.
void set_axis(vtkAxis *axis, std::array<double, 2> range, int intervals, Sign sign = Sign::shown);
// Dots of one colour, `size` pixels wide; `marker`: of vtkPlotPoints.
vtkPlot *add_dots(vtkChartXY &chart, std::vector<double> x, std::vector<double> y, Colour colour, int marker,
                  float size);
// A chart of coloured cells in mm, one a pixel of the image. `sign`: of the numbers below.
vtkSmartPointer<vtkChartXY> image_chart(const PlotArea &area, vtkImageData *image,
                                        vtkColorTransferFunction *ramp, std::array<double, 2> x,
                                        std::array<double, 2> y, Sign sign = Sign::shown);
// The titles of its axes.
void add_axis_titles(Canvas &canvas, const PlotArea &area, const std::string &x_title,
                     const std::string &y_title);
// Lays charts over the whole canvas.
void add_chart_scene(Canvas &canvas, const std::vector<vtkSmartPointer<vtkChartXY>> &charts);

} // namespace platen::apps::report
