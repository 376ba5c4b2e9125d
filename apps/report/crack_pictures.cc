// Broken bonds as discs in the half specimen, and their density over radius and height.
#include <vtkActor.h>
#include <vtkDoubleArray.h>
#include <vtkGlyph3DMapper.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkProperty.h>
#include <vtkRegularPolygonSource.h>

#include <algorithm>
#include <cmath>

#include "apps/report/chart.h"
#include "apps/report/cracks.h"
#include "apps/report/specimen_view.h"
#include "base/pi.h"

namespace platen::apps::report {
namespace {

constexpr int panel_width = 820, picture_height = 1240, bar_width = 260; // pixels

struct Disc {
  const Crack *crack;
  double value; // coloured by
};

// Discs of the bonds' areas in the half y < 0, at right angles to their normals.
void add_discs(vtkRenderer *renderer, const std::vector<Disc> &discs, vtkScalarsToColors *colours) {
  vtkNew<vtkPoints> points;
  vtkNew<vtkDoubleArray> normals, sizes, values;
  normals->SetName("normal");
  normals->SetNumberOfComponents(3);
  sizes->SetName("radius");
  values->SetName("value");
  for (const Disc &shown : discs) {
    const Crack &crack = *shown.crack;
    if (crack.place[1] > 0) continue;
    points->InsertNextPoint(crack.place.data());
    normals->InsertNextTuple(crack.normal.data());
    sizes->InsertNextValue(std::sqrt(crack.area / pi));
    values->InsertNextValue(shown.value);
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->GetPointData()->AddArray(normals);
  data->GetPointData()->AddArray(sizes);
  data->GetPointData()->AddArray(values);
  vtkNew<vtkRegularPolygonSource> disc; // the mapper turns the x axis of the source into the normal
  disc->SetNumberOfSides(20);
  disc->SetRadius(1);
  disc->SetNormal(1, 0, 0);
  disc->GeneratePolylineOff();
  vtkNew<vtkGlyph3DMapper> mapper;
  mapper->SetInputData(data);
  mapper->SetSourceConnection(disc->GetOutputPort());
  mapper->SetOrientationArray("normal");
  mapper->SetOrientationModeToDirection();
  mapper->SetScaleArray("radius");
  mapper->SetScaleModeToScaleByMagnitude();
  mapper->SetScalarModeToUsePointFieldData();
  mapper->SelectColorArray("value");
  mapper->SetLookupTable(colours);
  mapper->UseLookupTableScalarRangeOn();
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetAmbient(0.4);
  actor->GetProperty()->SetDiffuse(0.65);
  renderer->AddActor(actor);
}

// The edges of the half specimen: its cut face and the rims behind it.
std::vector<Outline> outlines_of(const Extent &extent) {
  const double w = extent.half_width, d = extent.half_depth;
  constexpr int segments = 48;
  std::vector<Outline> outlines;
  if (extent.form == Extent::Form::disc) {
    const double middle = 0.5 * (extent.bottom + extent.top), h = 0.5 * extent.height();
    for (const double y : {0.0, -d}) {
      Outline &rim = outlines.emplace_back();
      for (int k = 0; k <= 2 * segments; ++k)
        rim.push_back({w * std::cos(pi * k / segments), y, middle + h * std::sin(pi * k / segments)});
    }
    return outlines;
  }
  for (const double z : {extent.bottom, extent.top}) {
    Outline rim{{w, 0, z}};
    const bool is_round = extent.form == Extent::Form::cylinder;
    for (int k = 1; k < segments && is_round; ++k)
      rim.push_back({w * std::cos(pi * k / segments), -w * std::sin(pi * k / segments), z});
    if (!is_round) rim.insert(rim.end(), {{w, -d, z}, {-w, -d, z}});
    rim.insert(rim.end(), {{-w, 0, z}, {w, 0, z}});
    outlines.push_back(std::move(rim));
  }
  for (const double x : {-w, w})
    outlines.push_back({{x, 0, extent.bottom}, {x, 0, extent.top}});
  return outlines;
}

vtkSmartPointer<vtkColorTransferFunction> one_colour(Colour colour) {
  auto function = vtkSmartPointer<vtkColorTransferFunction>::New();
  for (const double x : {0.0, 1.0})
    add_colour(function, x, colour);
  return function;
}

// The k-th panel from the left.
void add_discs_panel(Canvas &canvas, int k, const std::vector<Disc> &discs, vtkScalarsToColors *colours,
                     const Extent &extent, const std::string &which) {
  vtkRenderer *renderer =
      add_panel(canvas, k, panel_width, std::to_string(discs.size()) + which + " (both halves)");
  add_discs(renderer, discs, colours);
  add_lines(renderer, outlines_of(extent), 0.3, 3);
  light_cut(renderer);
  look_at_cut(canvas, renderer, extent, 0.06 * extent.height());
}

// One pixel per cell, in mm; pixel borders are cell borders. Heights count from the lower end.
vtkSmartPointer<vtkImageData> mirrored_image(const DensityMap &map, double factor) {
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(2 * map.columns, map.rows, 1);
  image->SetOrigin(-map.radius * mm_per_m, 0, 0);
  image->SetSpacing(map.radius * mm_per_m / map.columns, (map.top - map.bottom) * mm_per_m / map.rows, 1);
  vtkNew<vtkDoubleArray> values;
  values->SetName("density");
  for (int row = 0; row < map.rows; ++row)
    for (int k = -map.columns; k < map.columns; ++k)
      values->InsertNextValue(map.at(k < 0 ? -k - 1 : k, row) * factor);
  image->GetPointData()->SetScalars(values);
  return image;
}

double largest(const DensityMap &map) {
  double most = 0;
  for (const double value : map.values)
    if (std::isfinite(value)) most = std::max(most, value);
  return most;
}

} // namespace

void draw_cracks(const Run &run, const Spheres &before_test, const std::filesystem::path &png) {
  const std::vector<Crack> cracks = cracks_until(*run.cracks, run.pattern_time(), before_test);
  Canvas canvas(2 * panel_width, picture_height);
  for (const bool in_tension : {true, false}) {
    std::vector<Disc> discs;
    for (const Crack &crack : cracks)
      if (crack.in_tension == in_tension) discs.push_back({&crack, 0});
    add_discs_panel(canvas, in_tension ? 0 : 1, discs,
                    one_colour(in_tension ? colours::vermilion : colours::blue), extent_of(before_test),
                    in_tension ? " in tension" : " in shear");
  }
  canvas.add_head(run.title, "Bonds broken until " + run.pattern_words() + ", half of the specimen");
  canvas.save(png);
}

void draw_crack_times(const Run &run, const Spheres &before_test, const std::filesystem::path &png) {
  const std::vector<Crack> cracks = cracks_until(*run.cracks, run.pattern_time(), before_test);
  const double peak = run.moments.peak_time;
  double first = 1, last = 1; // over the time of the peak
  for (const Crack &crack : cracks) {
    first = std::min(first, crack.time / peak);
    last = std::max(last, crack.time / peak);
  }
  const Colouring colouring{Ramp::displacement, round_ticks(first, last, 6), "Time over\nthat of the\npeak"};
  Canvas canvas(2 * panel_width + bar_width, picture_height);
  const auto ramp = colour_ramp(colouring.ramp, colouring.ticks.front(), colouring.ticks.back());
  for (const bool before : {true, false}) {
    std::vector<Disc> discs;
    for (const Crack &crack : cracks)
      if ((crack.time < peak) == before) discs.push_back({&crack, crack.time / peak});
    add_discs_panel(canvas, before ? 0 : 1, discs, ramp, extent_of(before_test),
                    before ? " before the peak" : " after it");
  }
  add_colour_bar(canvas, colouring, 1 - double(bar_width) / canvas.width());
  canvas.add_head(run.title, "Bonds broken until " + run.pattern_words() + ", by time");
  canvas.save(png);
}

void draw_crack_density(const Run &run, const Spheres &before_test, const std::filesystem::path &png) {
  const std::vector<Crack> cracks = cracks_until(*run.cracks, run.pattern_time(), before_test);
  std::vector<Position> bonds;
  if (!run.bonds.empty()) bonds = bond_midpoints(run.bonds.front());
  const DensityMap map = crack_density(cracks, bonds, extent_of(before_test));

  constexpr int plot_height = 1000, left = 170, right = 330, foot = 125, least_width = 1000;
  constexpr double per_cm3 = 1e-6; // 1/m3 in 1/cm3
  const double mm_radius = map.radius * mm_per_m, mm_height = (map.top - map.bottom) * mm_per_m;
  const int plot_width = static_cast<int>(plot_height * 2 * mm_radius / mm_height);
  const int spare = std::max(0, least_width - plot_width - left - right); // for the letters of the head
  const int width = plot_width + left + right + spare, height = plot_height + Canvas::head_height + foot;

  const double factor = map.is_share ? 1 : per_cm3, most = largest(map) * factor;
  const Colouring colouring{Ramp::damage, round_ticks(0, map.is_share || most <= 0 ? 1 : most, 5),
                            map.is_share ? "Share of\nbonds broken" : "Broken bonds\nper cm3"};
  const auto ramp = colour_ramp(colouring.ramp, colouring.ticks.front(), colouring.ticks.back());
  ramp->SetNanColor(1, 1, 1);

  Canvas canvas(width, height);
  const PlotArea area{left + 0.5 * spare, foot, static_cast<double>(plot_width), plot_height};
  const auto chart = image_chart(area, mirrored_image(map, factor), ramp, {-mm_radius, mm_radius},
                                 {0, mm_height}, Sign::dropped);
  add_axis_titles(canvas, area,
                  map.is_plane ? "Distance from the middle plane (mm)" : "Distance from the axis (mm)",
                  "Height (mm)");
  add_chart_scene(canvas, {chart});
  add_colour_bar(canvas, colouring, 1 - (right - 60.0 + 0.5 * spare) / width);
  canvas.add_head(run.title, "Bonds broken until " + run.pattern_words());
  canvas.save(png);
}

} // namespace platen::apps::report
