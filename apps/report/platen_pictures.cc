// Pictures of the platens: what presses on them and where it sticks.
#include <vtkAxis.h>
#include <vtkChartXY.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPlotPoints.h>
#include <vtkTable.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "apps/report/chart.h"
#include "apps/report/pictures.h"
#include "apps/report/platen_contacts.h"

namespace platen::apps::report {
namespace {

constexpr double mm_per_m = 1e3, pa_per_mpa = 1e6;
constexpr int rings = 5; // of equal area; the last one is wider than a sphere's radius

const char *word(PlatenEnd end) {
  return end == PlatenEnd::top ? "top" : "bottom";
}

std::vector<double> scaled(std::vector<double> values, double factor) {
  for (double &value : values)
    value *= factor;
  return values;
}

void add_dots(vtkChartXY &chart, const PlatenContacts &contacts, bool sliding, bool heavy, double mean,
              Colour colour) {
  vtkNew<vtkDoubleArray> xs, ys;
  xs->SetName("x");
  ys->SetName("y");
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    if (contacts.sliding[k] != sliding || (contacts.normal_force[k] > mean) != heavy) continue;
    xs->InsertNextValue(contacts.x[k] * mm_per_m);
    ys->InsertNextValue(contacts.y[k] * mm_per_m);
  }
  if (xs->GetNumberOfValues() == 0) return;
  if (xs->GetNumberOfValues() == 1) { // VTK draws no plot of one point
    xs->InsertNextValue(xs->GetValue(0));
    ys->InsertNextValue(ys->GetValue(0));
  }
  vtkNew<vtkTable> table;
  table->AddColumn(xs);
  table->AddColumn(ys);
  vtkPlot *plot = chart.AddPlot(vtkChart::POINTS);
  plot->SetInputData(table, 0, 1);
  plot->SetColor(colour[0], colour[1], colour[2], 255);
  auto *points = vtkPlotPoints::SafeDownCast(plot);
  // Shapes tell what colours tell: filled discs stick, crosses slide.
  points->SetMarkerStyle(sliding ? vtkPlotPoints::CROSS : vtkPlotPoints::CIRCLE);
  points->SetMarkerSize((heavy ? 20.0F : 10.0F) * oversampling);
}

std::string counted(PlatenEnd end, const PlatenContacts &contacts) {
  const auto sliding = std::count(contacts.sliding.begin(), contacts.sliding.end(), true);
  return std::string(word(end)) + ": " + std::to_string(static_cast<long>(contacts.size()) - sliding) +
         " stick, " + std::to_string(sliding) + " slide";
}

} // namespace

void draw_platen_profiles(const Run &run, const Extent &extent, const std::filesystem::path &png) {
  Chart pressure, shear;
  for (const PlatenEnd end : {PlatenEnd::bottom, PlatenEnd::top}) {
    const PlatenContacts contacts = contacts_with(end, run.contacts.nearest(run.moments.peak_time));
    const RingProfile profile = profile_of(contacts, extent.half_width, rings);
    const std::vector<double> radius = scaled(profile.middle, mm_per_m);
    const Colour colour = end == PlatenEnd::top ? colours::vermilion : colours::blue;
    const Stroke stroke = end == PlatenEnd::top ? Stroke::dashed : Stroke::solid;
    pressure.curves.push_back({std::string(word(end)) + " platen", radius,
                               scaled(profile.pressure, 1 / pa_per_mpa), colour, stroke, 5});
    shear.curves.push_back({std::string(word(end)) + " platen", radius,
                            scaled(profile.inward_shear, 1 / pa_per_mpa), colour, stroke, 5});
  }
  pressure.x_title = shear.x_title = "Distance from the axis (mm)";
  pressure.y_title = "Pressure (MPa)";
  shear.y_title = "Inward shear (MPa)";
  pressure.x_range = shear.x_range = {0, extent.half_width * mm_per_m};
  save_charts(run.title, "What the platens do to the ends at the peak, five rings of equal area",
              {pressure, shear}, {600, 600}, png);
}

void draw_stick_and_slip(const Run &run, const Extent &extent, const std::filesystem::path &png) {
  constexpr int plot = 760, left = 170, right = 60, foot = 150, caption = 70;
  Canvas canvas(2 * (left + plot + right), Canvas::head_height + caption + plot + foot);
  std::vector<vtkSmartPointer<vtkChartXY>> charts;
  const double reach = 1.05 * std::max(extent.half_width, extent.half_depth) * mm_per_m;
  for (const PlatenEnd end : {PlatenEnd::bottom, PlatenEnd::top}) {
    const PlatenContacts contacts = contacts_with(end, run.contacts.nearest(run.moments.peak_time));
    double mean = 0;
    for (const double force : contacts.normal_force)
      mean += force / static_cast<double>(contacts.size());
    const double start = end == PlatenEnd::bottom ? left : 2.0 * left + plot + right;
    const PlotArea area{start, foot, plot, plot};
    const auto chart = frame_chart(area);
    for (const bool heavy : {false, true}) {
      add_dots(*chart, contacts, false, heavy, mean, colours::blue);
      add_dots(*chart, contacts, true, heavy, mean, colours::vermilion);
    }
    set_axis(chart->GetAxis(vtkAxis::BOTTOM), {-reach, reach}, 6);
    set_axis(chart->GetAxis(vtkAxis::LEFT), {-reach, reach}, 6);
    charts.push_back(chart);
    add_axis_titles(canvas, area, "x (mm)", "y (mm)");
    canvas.add_text(counted(end, contacts), (start + 0.5 * plot) / canvas.width(),
                    (foot + plot + 0.5 * caption) / canvas.height(), text_size, 0.48);
  }
  add_chart_scene(canvas, charts);
  canvas.add_head(run.title,
                  "Ends at the peak: blue discs stick, red crosses slide; large: above the mean pressure");
  canvas.save(png);
}

} // namespace platen::apps::report
