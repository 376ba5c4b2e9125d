// Broken bonds as discs in the half specimen, and their density over radius and height.
#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkDoubleArray.h>
#include <vtkFeatureEdges.h>
#include <vtkGlyph3DMapper.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRegularPolygonSource.h>

#include <algorithm>
#include <cmath>

#include "apps/report/crack_density.h"
#include "apps/report/heat_map.h"
#include "apps/report/pictures.h"
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
    if (crack.place.y > 0) continue;
    points->InsertNextPoint(crack.place.x, crack.place.y, crack.place.z);
    normals->InsertNextTuple3(crack.nx, crack.ny, crack.nz);
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
void add_outline(vtkRenderer *renderer, const Extent &extent) {
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> lines;
  const auto line = [&](const std::vector<std::array<double, 3>> &path) {
    lines->InsertNextCell(static_cast<int>(path.size()));
    for (const auto &point : path)
      lines->InsertCellPoint(points->InsertNextPoint(point.data()));
  };
  const double w = extent.half_width, d = extent.half_depth;
  constexpr int segments = 48;
  if (extent.form == Extent::Form::disc) {
    const double middle = 0.5 * (extent.bottom + extent.top), h = 0.5 * extent.height();
    for (const double y : {0.0, -d}) {
      std::vector<std::array<double, 3>> rim;
      for (int k = 0; k <= 2 * segments; ++k)
        rim.push_back({w * std::cos(pi * k / segments), y, middle + h * std::sin(pi * k / segments)});
      line(rim);
    }
  } else {
    for (const double z : {extent.bottom, extent.top}) {
      std::vector<std::array<double, 3>> rim{{w, 0, z}};
      const bool is_round = extent.form == Extent::Form::cylinder;
      for (int k = 1; k < segments && is_round; ++k)
        rim.push_back({w * std::cos(pi * k / segments), -w * std::sin(pi * k / segments), z});
      if (!is_round) rim.insert(rim.end(), {{w, -d, z}, {-w, -d, z}});
      rim.push_back({-w, 0, z});
      rim.push_back({w, 0, z});
      line(rim);
    }
    for (const double x : {-w, w})
      line({{x, 0, extent.bottom}, {x, 0, extent.top}});
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetLines(lines);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(0.3, 0.3, 0.3);
  actor->GetProperty()->SetLineWidth(3 * oversampling);
  actor->GetProperty()->LightingOff();
  renderer->AddActor(actor);
}

vtkSmartPointer<vtkColorTransferFunction> one_colour(Colour colour) {
  auto function = vtkSmartPointer<vtkColorTransferFunction>::New();
  for (const double x : {0.0, 1.0})
    function->AddRGBPoint(x, colour[0] / 255.0, colour[1] / 255.0, colour[2] / 255.0);
  return function;
}

// The k-th panel from the left.
void add_panel(Canvas &canvas, int k, const std::vector<Disc> &discs, vtkScalarsToColors *colours,
               const Extent &extent, const std::string &caption) {
  constexpr int foot = 80;
  const double width = canvas.width(), height = canvas.height();
  const double left = k * panel_width / width, right = (k + 1) * panel_width / width;
  vtkRenderer *renderer = canvas.add_renderer({left, foot / height, right, 1 - Canvas::head_height / height});
  add_discs(renderer, discs, colours);
  add_outline(renderer, extent);
  light_cut(renderer);
  look_at_cut(canvas, renderer, extent, 0.06 * extent.height());
  canvas.add_text(caption, 0.5 * (left + right), 0.5 * foot / height, text_size, 0.95 * (right - left));
}

} // namespace

void draw_cracks(const Run &run, const Spheres &before_test, const std::filesystem::path &png) {
  const std::vector<Crack> cracks = cracks_until(*run.cracks, run.pattern_time(), before_test);
  Canvas canvas(2 * panel_width, picture_height);
  for (const bool in_tension : {true, false}) {
    std::vector<Disc> discs;
    for (const Crack &crack : cracks)
      if (crack.in_tension == in_tension) discs.push_back({&crack, 0});
    add_panel(canvas, in_tension ? 0 : 1, discs, one_colour(in_tension ? colours::vermilion : colours::blue),
              extent_of(before_test),
              std::to_string(discs.size()) + (in_tension ? " in tension" : " in shear") + " (both halves)");
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
    add_panel(canvas, before ? 0 : 1, discs, ramp, extent_of(before_test),
              std::to_string(discs.size()) + (before ? " before the peak" : " after it") + " (both halves)");
  }
  add_colour_bar(canvas, colouring, 1 - double(bar_width) / canvas.width());
  canvas.add_head(run.title, "Bonds broken until " + run.pattern_words() + ", by time");
  canvas.save(png);
}

void draw_crack_density(const Run &run, const Spheres &before_test, const std::filesystem::path &png) {
  const std::vector<Crack> cracks = cracks_until(*run.cracks, run.pattern_time(), before_test);
  std::vector<Place> bonds;
  if (!run.bonds.empty()) bonds = bond_midpoints(run.bonds.frames.front());
  save_heat_map(run.title, "Bonds broken until " + run.pattern_words(),
                crack_density(cracks, bonds, extent_of(before_test)), png);
}

} // namespace platen::apps::report
