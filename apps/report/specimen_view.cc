#include "apps/report/specimen_view.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkClipDataSet.h>
#include <vtkDataSetMapper.h>
#include <vtkDoubleArray.h>
#include <vtkFloatArray.h>
#include <vtkLight.h>
#include <vtkNew.h>
#include <vtkOpenGLSphereMapper.h>
#include <vtkPlane.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkScalarBarActor.h>
#include <vtkTextProperty.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace platen::apps::report {
namespace {

constexpr double rise = 0.12; // tangent of the angle from which the cut is seen, about 7 degrees from above
constexpr int panel_width = 760, picture_height = 1240, bar_width = 260;

vtkSmartPointer<vtkPolyData> spheres_as_points(const CutView &view) {
  vtkNew<vtkPoints> points;
  vtkNew<vtkFloatArray> radius; // the mapper takes its bytes for floats, whatever they are
  vtkNew<vtkDoubleArray> value;
  radius->SetName("radius");
  value->SetName("value");
  for (const std::size_t k : rows_shown(view.spheres, view.is_whole)) {
    points->InsertNextPoint(view.spheres.position[k].data());
    radius->InsertNextValue(static_cast<float>(view.spheres.radius[k]));
    value->InsertNextValue(view.values[k]);
  }
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  vtkNew<vtkCellArray> vertices;
  for (vtkIdType k = 0; k < points->GetNumberOfPoints(); ++k)
    vertices->InsertNextCell(1, &k);
  data->SetVerts(vertices);
  data->GetPointData()->AddArray(radius);
  data->GetPointData()->AddArray(value);
  return data;
}

void add_spheres(vtkRenderer *renderer, const CutView &view, vtkScalarsToColors *colours) {
  vtkNew<vtkOpenGLSphereMapper> mapper;
  mapper->SetInputData(spheres_as_points(view));
  mapper->SetScaleArray("radius");
  mapper->SetScalarModeToUsePointFieldData();
  mapper->SelectColorArray("value");
  mapper->SetLookupTable(colours);
  mapper->UseLookupTableScalarRangeOn();
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetAmbient(0.3);
  actor->GetProperty()->SetDiffuse(0.8);
  actor->GetProperty()->SetSpecular(0.12);
  actor->GetProperty()->SetSpecularPower(20);
  renderer->AddActor(actor);
}

// Black lines on white ones, so that they show on every colour, moved towards the eye along the line of
// sight: their picture stays where it is.
void add_outlines(vtkRenderer *renderer, std::vector<Outline> outlines, double nearer) {
  if (outlines.empty()) return;
  vtkMapper::SetResolveCoincidentTopologyToPolygonOffset(); // of all mappers from here on
  for (Outline &outline : outlines)
    for (Position &place : outline)
      place[1] += nearer, place[2] += rise * nearer;
  add_lines(renderer, outlines, 1, 10);
  vtkPolyDataMapper *upper = add_lines(renderer, outlines, 0, 5);
  upper->SetRelativeCoincidentTopologyLineOffsetParameters(0, -8);
}

} // namespace

std::vector<std::size_t> rows_shown(const Spheres &spheres, bool whole) {
  std::vector<std::size_t> rows;
  for (std::size_t k = 0; k < spheres.size(); ++k)
    if (whole || spheres.initial[k][1] <= 0) rows.push_back(k);
  return rows;
}

std::vector<double> ticks_for(const std::vector<CutView> &views) {
  std::vector<double> all;
  for (const CutView &view : views)
    for (const std::size_t k : rows_shown(view.spheres, view.is_whole))
      all.push_back(view.values[k]);
  if (all.empty()) return {0, 1};
  const auto place = all.begin() + static_cast<std::ptrdiff_t>(0.98 * static_cast<double>(all.size() - 1));
  std::nth_element(all.begin(), place, all.end());
  return round_ticks(0, *place > 0 ? *place : 1, 5);
}

vtkRenderer *add_panel(Canvas &canvas, int k, int panel_width, const std::string &caption) {
  constexpr int foot = 80;
  const double width = canvas.width(), height = canvas.height();
  const double left = k * panel_width / width, right = (k + 1) * panel_width / width;
  canvas.add_text(caption, 0.5 * (left + right), 0.5 * foot / height, text_size, 0.95 * (right - left));
  return canvas.add_renderer({left, foot / height, right, 1 - Canvas::head_height / height});
}

void add_colour_bar(Canvas &canvas, const Colouring &colouring, double left, double right, double bottom,
                    double top) {
  if (colouring.ramp == Ramp::pieces) return; // their colours mean nothing
  vtkRenderer *renderer = canvas.add_renderer({left, bottom, right, top});
  vtkNew<vtkScalarBarActor> bar;
  bar->SetLookupTable(colour_ramp(colouring.ramp, colouring.ticks.front(), colouring.ticks.back()));
  bar->SetTitle((colouring.title + "\n ").c_str());
  bar->SetNumberOfLabels(static_cast<int>(colouring.ticks.size()));
  bar->SetLabelFormat("%g");
  bar->SetMaximumNumberOfColors(256);
  bar->UnconstrainedFontSizeOn();
  set_letters(bar->GetTitleTextProperty(), small_size);
  set_letters(bar->GetLabelTextProperty(), small_size);
  bar->SetBarRatio(0.25);
  bar->SetTextPad(4 * oversampling);
  bar->SetPosition(0.05, 0.2);
  bar->SetWidth(0.9);
  bar->SetHeight(0.6);
  renderer->AddActor2D(bar);
}

void look_at_cut(const Canvas &canvas, vtkRenderer *renderer, const Extent &extent, double margin) {
  const double middle = 0.5 * (extent.bottom + extent.top), far = 10 * (extent.height() + extent.half_width);
  renderer->GetActiveCamera()->ParallelProjectionOn();
  renderer->GetActiveCamera()->SetFocalPoint(0, 0, middle);
  renderer->GetActiveCamera()->SetPosition(0, far, middle + rise * far);
  renderer->GetActiveCamera()->SetViewUp(0, 0, 1);
  const double for_height = 0.5 * extent.height() + margin,
               for_width = (extent.half_width + margin) / canvas.aspect(renderer);
  renderer->GetActiveCamera()->SetParallelScale(std::max(for_height, for_width));
  renderer->ResetCameraClippingRange();
}

vtkPolyDataMapper *add_lines(vtkRenderer *renderer, const std::vector<Outline> &lines, double grey,
                             float width) {
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> cells;
  for (const Outline &line : lines) {
    cells->InsertNextCell(static_cast<int>(line.size()));
    for (const Position &place : line)
      cells->InsertCellPoint(points->InsertNextPoint(place.data()));
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetLines(cells);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(grey, grey, grey);
  actor->GetProperty()->SetLineWidth(width * oversampling);
  actor->GetProperty()->LightingOff();
  renderer->AddActor(actor);
  return mapper;
}

void light_cut(vtkRenderer *renderer) {
  renderer->RemoveAllLights();
  renderer->AutomaticLightCreationOff();
  const auto add = [renderer](double right, double up, double intensity) {
    vtkNew<vtkLight> light;
    light->SetLightTypeToCameraLight(); // in camera axes: x right, y up, z towards the eye
    light->SetPosition(right, up, 1);
    light->SetFocalPoint(0, 0, 0);
    light->SetIntensity(intensity);
    renderer->AddLight(light);
  };
  add(-0.6, 0.8, 0.8);
  add(0.7, 0.1, 0.3);
}

void add_platens(vtkRenderer *renderer, vtkUnstructuredGrid *platens, double before, const Colour &colour) {
  const bool whole = std::isinf(before);
  vtkNew<vtkPlane> plane;
  plane->SetOrigin(0, whole ? 0 : before, 0);
  plane->SetNormal(0, -1, 0);
  vtkNew<vtkClipDataSet> half;
  half->SetInputData(platens);
  half->SetClipFunction(plane);
  vtkNew<vtkDataSetMapper> mapper;
  if (whole)
    mapper->SetInputData(platens);
  else
    mapper->SetInputConnection(half->GetOutputPort());
  mapper->ScalarVisibilityOff();
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(colour[0] / 255.0, colour[1] / 255.0, colour[2] / 255.0);
  actor->GetProperty()->SetInterpolationToFlat();
  actor->GetProperty()->SetAmbient(0.25);
  renderer->AddActor(actor);
}

void save_cut_views(const std::string &title, const std::string &subtitle, const std::vector<CutView> &views,
                    const Extent &extent, const Colouring &colouring, const std::filesystem::path &png) {
  const int side = colouring.ramp == Ramp::pieces ? 0 : bar_width; // no bar, no room
  const int width = static_cast<int>(views.size()) * panel_width + side;
  Canvas canvas(width, picture_height);
  const auto colours = colour_ramp(colouring.ramp, colouring.ticks.front(), colouring.ticks.back());
  for (std::size_t k = 0; k < views.size(); ++k) {
    vtkRenderer *renderer = add_panel(canvas, static_cast<int>(k), panel_width, views[k].caption);
    add_spheres(renderer, views[k], colours);
    const double cut = !views[k].is_whole     ? 0
                       : views[k].shows_front ? std::numeric_limits<double>::infinity()
                                              : 0.9 * extent.half_depth;
    if (views[k].platens) add_platens(renderer, views[k].platens, cut);
    if (views[k].sleeve) add_platens(renderer, views[k].sleeve, 0, {120, 94, 88});
    light_cut(renderer);
    add_outlines(renderer, views[k].outlines, 2 * extent.half_depth);
    look_at_cut(canvas, renderer, extent, 0.12 * extent.height());
    for (const Note &note : views[k].notes) {
      const auto [x, y] = canvas.on_window(renderer, note.place);
      canvas.add_text(note.text, x, y, small_size);
    }
  }
  add_colour_bar(canvas, colouring, 1 - double(bar_width) / width);
  canvas.add_head(title, subtitle);
  canvas.save(png);
}

} // namespace platen::apps::report
