#include "apps/report/platens.h"

#include <fmt/format.h>
#include <vtkAxis.h>
#include <vtkChartXY.h>
#include <vtkDataArray.h>
#include <vtkPlotPoints.h>

#include <algorithm>
#include <cmath>

#include "apps/report/chart.h"

namespace platen::apps::report {
namespace {

// Contacts at the rim of a platen may press aslant; those of a sleeve press sideways.
constexpr double upright = 0.7;

constexpr int rings = 5; // of equal area; the last one is wider than a sphere's radius

const char *word(PlatenEnd end) {
  return end == PlatenEnd::top ? "top" : "bottom";
}

// Shapes tell what colours tell: filled discs stick, crosses slide.
void add_contacts(vtkChartXY &chart, const PlatenContacts &contacts, bool sliding, bool heavy, double mean) {
  std::vector<double> x, y;
  for (const PlatenContact &one : contacts)
    if (one.sliding == sliding && (one.normal_force > mean) == heavy)
      x.push_back(one.x * mm_per_m), y.push_back(one.y * mm_per_m);
  if (!x.empty())
    add_dots(chart, x, y, sliding ? colours::vermilion : colours::blue,
             sliding ? vtkPlotPoints::CROSS : vtkPlotPoints::CIRCLE, heavy ? 20 : 10);
}

} // namespace

PlatenContacts contacts_with(PlatenEnd end, const Frame &frame) {
  const vtkSmartPointer<vtkUnstructuredGrid> grid = read_frame(frame);
  vtkDataArray &normal = point_data(*grid, "normal", 3, frame), &shear = point_data(*grid, "shear", 3, frame),
               &force = point_data(*grid, "normal_force", 1, frame),
               &sliding = point_data(*grid, "sliding", 1, frame);
  PlatenContacts contacts;
  for (vtkIdType k = 0; k < grid->GetNumberOfPoints(); ++k) {
    const double up = normal.GetComponent(k, 2);
    if (!(end == PlatenEnd::bottom ? up > upright : up < -upright)) continue;
    const double *p = grid->GetPoint(k);
    const double radius = std::hypot(p[0], p[1]);
    const double sx = shear.GetComponent(k, 0), sy = shear.GetComponent(k, 1);
    contacts.push_back({p[0], p[1], force.GetComponent(k, 0),
                        radius > 0 ? -(sx * p[0] + sy * p[1]) / radius : 0, sliding.GetComponent(k, 0) != 0});
  }
  return contacts;
}

RingProfile profile_of(const PlatenContacts &contacts, double radius, int rings) {
  RingProfile profile;
  const std::size_t n = static_cast<std::size_t>(rings);
  profile.pressure.assign(n, 0.0);
  profile.inward_shear.assign(n, 0.0);
  for (std::size_t k = 0; k < n; ++k)
    profile.middle.push_back(radius * std::sqrt((static_cast<double>(k) + 0.5) / rings));
  const double area = pi * radius * radius / rings;
  for (const PlatenContact &one : contacts) {
    const double share = (one.x * one.x + one.y * one.y) / (radius * radius);
    const std::size_t ring =
        std::min(n - 1, static_cast<std::size_t>(share * rings)); // the last holds what lies beyond
    profile.pressure[ring] += one.normal_force / area;
    profile.inward_shear[ring] += one.inward_shear / area;
  }
  return profile;
}

void draw_platen_profiles(const Run &run, const Extent &extent, const std::filesystem::path &png) {
  Chart pressure, shear;
  for (const PlatenEnd end : {PlatenEnd::bottom, PlatenEnd::top}) {
    const PlatenContacts contacts = contacts_with(end, nearest(run.contacts, run.moments.peak_time));
    const RingProfile profile = profile_of(contacts, extent.half_width, rings);
    const std::vector<double> radius = scaled(profile.middle, mm_per_m);
    const Colour colour = end == PlatenEnd::top ? colours::vermilion : colours::blue;
    const Stroke stroke = end == PlatenEnd::top ? Stroke::dashed : Stroke::solid;
    const auto add = [&](Chart &chart, const std::vector<double> &stress) {
      chart.curves.push_back(
          {std::string(word(end)) + " platen", radius, scaled(stress, 1 / pa_per_mpa), colour, stroke, 5});
    };
    add(pressure, profile.pressure);
    add(shear, profile.inward_shear);
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
    const PlatenContacts contacts = contacts_with(end, nearest(run.contacts, run.moments.peak_time));
    double mean = 0;
    for (const PlatenContact &one : contacts)
      mean += one.normal_force / static_cast<double>(contacts.size());
    const double start = end == PlatenEnd::bottom ? left : 2.0 * left + plot + right;
    const PlotArea area{start, foot, plot, plot};
    const auto chart = frame_chart(area);
    for (const bool heavy : {false, true})
      for (const bool slides : {false, true})
        add_contacts(*chart, contacts, slides, heavy, mean);
    set_axis(chart->GetAxis(vtkAxis::BOTTOM), {-reach, reach}, 6);
    set_axis(chart->GetAxis(vtkAxis::LEFT), {-reach, reach}, 6);
    charts.push_back(chart);
    add_axis_titles(canvas, area, "x (mm)", "y (mm)");
    const auto sliding =
        std::count_if(contacts.begin(), contacts.end(), [](const PlatenContact &one) { return one.sliding; });
    canvas.add_text(fmt::format("{}: {} stick, {} slide", word(end),
                                static_cast<long>(contacts.size()) - sliding, sliding),
                    (start + 0.5 * plot) / canvas.width(), (foot + plot + 0.5 * caption) / canvas.height(),
                    text_size, 0.48);
  }
  add_chart_scene(canvas, charts);
  canvas.add_head(run.title,
                  "Ends at the peak: blue discs stick, red crosses slide; large: above the mean pressure");
  canvas.save(png);
}

} // namespace platen::apps::report
