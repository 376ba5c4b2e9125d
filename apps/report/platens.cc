#include "apps/report/platens.h"

#include <fmt/format.h>
#include <vtkAxis.h>
#include <vtkChartXY.h>
#include <vtkDataArray.h>
#include <vtkDoubleArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPlotPoints.h>
#include <vtkPointData.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "apps/report/chart.h"
#include "apps/report/specimen_view.h"

namespace platen::apps::report {
namespace {

// Contacts at the rim of a platen may press aslant; those of a sleeve press sideways.
constexpr double upright = 0.7;

constexpr double most_over_mean = 2.5; // of colours of pressure: what is above looks alike

constexpr int rings = 5; // of equal area; the last one is wider than a sphere's radius

// A chart for each platen: low sides below the high ones of their axis where there are more than two, else
// beside; all in one scale, as wide as the longest edge.
class FacePanels {
public:
  FacePanels(const Run &run, const Extent &extent, int right, double spare, int bar = 0)
      : sides_(sides_of(run)),
        right_(right),
        canvas_(columns() * (left + plot + right) + bar,
                Canvas::head_height + rows() * (caption + plot + foot)) {
    double longest = 0;
    for (const int axis : {0, 1, 2})
      if (axis != 2 || rows() > 1)
        longest = std::max(longest, reach(extent, axis)[1] - reach(extent, axis)[0]);
    half_ = 0.5 * spare * longest * mm_per_m;
    middle_ = rows() > 1 ? 0.5 * (extent.bottom + extent.top) * mm_per_m : 0;
  }
  static std::array<double, 2> reach(const Extent &extent, int axis) { // m
    if (axis == 2) return {extent.bottom, extent.top};
    const double half = axis == 0 ? extent.half_width : extent.half_depth;
    return {-half, half};
  }
  const std::vector<Side> &sides() const { return sides_; }
  Canvas &canvas() { return canvas_; }
  std::array<double, 2> range(int axis) const {
    return axis == 2 ? std::array<double, 2>{middle_ - half_, middle_ + half_}
                     : std::array<double, 2>{-half_, half_};
  }
  PlotArea area(std::size_t k) const {
    const int column = rows() > 1 ? static_cast<int>(k / 2) : static_cast<int>(k),
              row = rows() > 1 ? static_cast<int>(k % 2) : 0;
    return {static_cast<double>(left + column * (left + plot + right_)),
            static_cast<double>(foot + row * (caption + plot + foot)), plot, plot};
  }
  void add_words(std::size_t k, const std::string &words) {
    constexpr std::array<const char *, 3> names{"x (mm)", "y (mm)", "z (mm)"};
    const PlotArea at = area(k);
    const auto [across, up] = plane_of(sides_[k]);
    add_axis_titles(canvas_, at, names[static_cast<std::size_t>(across)],
                    names[static_cast<std::size_t>(up)]);
    canvas_.add_text(words, (at.left + 0.5 * plot) / canvas_.width(),
                     (at.bottom + plot + 0.5 * caption) / canvas_.height(), text_size, 0.96 / columns());
  }

private:
  static constexpr int plot = 760, left = 170, foot = 150, caption = 70;
  int rows() const { return sides_.size() > 2 ? 2 : 1; }
  int columns() const { return static_cast<int>(sides_.size()) / rows(); }
  std::vector<Side> sides_;
  int right_;
  Canvas canvas_;
  double half_ = 0, middle_ = 0; // mm
};

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

PlatenContacts contacts_with(Side side, const Frame &frame) {
  const vtkSmartPointer<vtkUnstructuredGrid> grid = read_frame(frame, Points::maybe_none);
  if (grid->GetNumberOfPoints() == 0) return {};
  vtkDataArray &normal = point_data(*grid, "normal", 3, frame), &shear = point_data(*grid, "shear", 3, frame),
               &force = point_data(*grid, "normal_force", 1, frame),
               &sliding = point_data(*grid, "sliding", 1, frame);
  vtkDataArray *slip = grid->GetPointData()->GetArray("slip");
  const int axis = coupling::axis_of(side);
  const double inward = coupling::inward(side)[axis];
  const auto [across, up] = plane_of(side);
  PlatenContacts contacts;
  for (vtkIdType k = 0; k < grid->GetNumberOfPoints(); ++k) {
    if (!(inward * normal.GetComponent(k, axis) > upright)) continue;
    const double x = grid->GetPoint(k)[across], y = grid->GetPoint(k)[up], radius = std::hypot(x, y);
    const double sx = shear.GetComponent(k, across), sy = shear.GetComponent(k, up);
    contacts.push_back(
        {x, y, force.GetComponent(k, 0), radius > 0 ? -(sx * x + sy * y) / radius : 0,
         sliding.GetComponent(k, 0) != 0,
         std::hypot(shear.GetComponent(k, 0), shear.GetComponent(k, 1), shear.GetComponent(k, 2)),
         slip != nullptr ? slip->GetComponent(k, 0) : 0});
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
  for (const Side end : {Side::bottom, Side::top}) {
    const PlatenContacts contacts = contacts_with(end, nearest(run.contacts, run.moments.peak_time));
    const RingProfile profile = profile_of(contacts, extent.half_width, rings);
    const std::vector<double> radius = scaled(profile.middle, mm_per_m);
    const Colour colour = end == Side::top ? colours::vermilion : colours::blue;
    const Stroke stroke = end == Side::top ? Stroke::dashed : Stroke::solid;
    const auto add = [&](Chart &chart, const std::vector<double> &stress) {
      chart.curves.push_back({std::string(coupling::name_of(end)) + " platen", radius,
                              scaled(stress, 1 / pa_per_mpa), colour, stroke, 5});
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
  constexpr int right = 60;
  FacePanels panels(run, extent, right, 1.05);
  std::vector<vtkSmartPointer<vtkChartXY>> charts;
  for (std::size_t k = 0; k < panels.sides().size(); ++k) {
    const Side side = panels.sides()[k];
    const PlatenContacts contacts = contacts_with(side, nearest(run.contacts, run.moments.peak_time));
    double mean = 0;
    for (const PlatenContact &one : contacts)
      mean += one.normal_force / static_cast<double>(contacts.size());
    const auto chart = frame_chart(panels.area(k));
    for (const bool heavy : {false, true})
      for (const bool slides : {false, true})
        add_contacts(*chart, contacts, slides, heavy, mean);
    const auto [across, up] = plane_of(side);
    set_axis(chart->GetAxis(vtkAxis::BOTTOM), panels.range(across), 6);
    set_axis(chart->GetAxis(vtkAxis::LEFT), panels.range(up), 6);
    charts.push_back(chart);
    const auto sliding =
        std::count_if(contacts.begin(), contacts.end(), [](const PlatenContact &one) { return one.sliding; });
    panels.add_words(k, fmt::format("{}: {} stick, {} slide", coupling::name_of(side),
                                    static_cast<long>(contacts.size()) - sliding, sliding));
  }
  add_chart_scene(panels.canvas(), charts);
  panels.canvas().add_head(run.title,
                           std::string(panels.sides().size() > 2 ? "Platens" : "Ends") +
                               " at the peak: blue discs stick, red crosses slide; large: above the mean "
                               "pressure");
  panels.canvas().save(png);
}

FacePressure pressure_over(const PlatenContacts &contacts, std::array<double, 2> low,
                           std::array<double, 2> high, double square) {
  const double width = high[0] - low[0], height = high[1] - low[1];
  const auto parts = [square](double length) {
    return std::max(1, static_cast<int>(std::lround(length / square)));
  };
  FacePressure face{parts(width), parts(height), {}};
  face.pressure.assign(static_cast<std::size_t>(face.columns * face.rows), 0.0);
  const double area = width * height / (face.columns * face.rows);
  const auto place = [](double share, int count) {
    return std::clamp(static_cast<int>(std::floor(share * count)), 0, count - 1);
  };
  for (const PlatenContact &one : contacts) {
    const int column = place((one.x - low[0]) / width, face.columns),
              row = place((one.y - low[1]) / height, face.rows);
    face.pressure[static_cast<std::size_t>(row * face.columns + column)] += one.normal_force / area;
  }
  return face;
}

namespace {

double mean_of(const FacePressure &face) { // Pa
  return std::accumulate(face.pressure.begin(), face.pressure.end(), 0.0) /
         static_cast<double>(face.pressure.size());
}

// Over its mean, a pixel a square, its origin the lower left corner; mm.
vtkSmartPointer<vtkImageData> image_of(const FacePressure &face, std::array<double, 2> low,
                                       std::array<double, 2> high) {
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(face.columns, face.rows, 1);
  image->SetOrigin(low[0] * mm_per_m, low[1] * mm_per_m, 0);
  image->SetSpacing((high[0] - low[0]) / face.columns * mm_per_m, (high[1] - low[1]) / face.rows * mm_per_m,
                    1);
  const double mean = mean_of(face);
  vtkNew<vtkDoubleArray> values;
  values->SetName("pressure");
  for (const double pressure : face.pressure)
    values->InsertNextValue(mean > 0 ? std::min(pressure / mean, most_over_mean) : 0);
  image->GetPointData()->SetScalars(values);
  return image;
}

} // namespace

void draw_face_pressures(const Run &run, const Extent &extent, double radius,
                         const std::filesystem::path &png) {
  constexpr int right = 60, bar = 260;
  FacePanels panels(run, extent, right, 1.05, bar);
  const Colouring colouring{Ramp::displacement, round_ticks(0, most_over_mean, 5),
                            "Pressure\nover the\nmean of\nthe platen"};
  std::vector<vtkSmartPointer<vtkChartXY>> charts;
  for (std::size_t k = 0; k < panels.sides().size(); ++k) {
    const Side side = panels.sides()[k];
    const auto [across, up] = plane_of(side);
    const auto a = FacePanels::reach(extent, across), b = FacePanels::reach(extent, up);
    const std::array<double, 2> low{a[0], b[0]}, high{a[1], b[1]};
    const FacePressure face = pressure_over(contacts_with(side, nearest(run.contacts, run.moments.peak_time)),
                                            low, high, 4 * radius);
    charts.push_back(image_chart(panels.area(k), image_of(face, low, high),
                                 colour_ramp(colouring.ramp, colouring.ticks.front(), colouring.ticks.back()),
                                 panels.range(across), panels.range(up)));
    panels.add_words(k,
                     fmt::format("{}: mean {:.2f} MPa", coupling::name_of(side), mean_of(face) / pa_per_mpa));
  }
  add_chart_scene(panels.canvas(), charts);
  add_colour_bar(panels.canvas(), colouring, 1 - double(bar) / panels.canvas().width());
  panels.canvas().add_head(run.title, "Pressure on the platens near the peak, each in its own plane");
  panels.canvas().save(png);
}

} // namespace platen::apps::report
