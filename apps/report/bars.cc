#include "apps/report/bars.h"

#include <vtkActor2D.h>
#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper2D.h>
#include <vtkProperty2D.h>

#include <algorithm>

#include "apps/report/canvas.h"

namespace platen::apps::report {
namespace {

// A filled rectangle; fractions of the canvas.
void add_rectangle(vtkRenderer *renderer, const Canvas &canvas, const std::array<double, 4> &x0_y0_x1_y1,
                   Colour colour) {
  const double w = oversampling * canvas.width(), h = oversampling * canvas.height();
  const auto &[x0, y0, x1, y1] = x0_y0_x1_y1;
  vtkNew<vtkPoints> points;
  points->InsertNextPoint(x0 * w, y0 * h, 0);
  points->InsertNextPoint(x1 * w, y0 * h, 0);
  points->InsertNextPoint(x1 * w, y1 * h, 0);
  points->InsertNextPoint(x0 * w, y1 * h, 0);
  vtkNew<vtkCellArray> face;
  face->InsertNextCell({0, 1, 2, 3});
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetPolys(face);
  vtkNew<vtkPolyDataMapper2D> mapper;
  mapper->SetInputData(data);
  vtkNew<vtkActor2D> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(colour[0] / 255.0, colour[1] / 255.0, colour[2] / 255.0);
  renderer->AddActor2D(actor);
}

} // namespace

void save_bars(const std::string &title, const std::string &subtitle, const std::vector<Bar> &bars,
               double mark, const std::filesystem::path &png) {
  constexpr int width = 1640, row = 74, foot = 50;
  constexpr double names = 0.14, left = 0.28, right = 0.78, words = 0.88; // fractions of the width
  const int rows = row * static_cast<int>(bars.size()), height = Canvas::head_height + rows + foot;
  double most = mark;
  for (const Bar &bar : bars)
    most = std::max(most, bar.value);
  if (!(most > 0)) most = 1;
  Canvas canvas(width, height);
  vtkRenderer *renderer = canvas.add_renderer({0, 0, 1, 1});
  for (std::size_t k = 0; k < bars.size(); ++k) {
    const double middle =
        1 - (Canvas::head_height + row * (static_cast<double>(k) + 0.5)) / static_cast<double>(height);
    const double half = 0.35 * row / height, reach = left + (right - left) * bars[k].value / most;
    add_rectangle(renderer, canvas, {left, middle - half, reach, middle + half}, bars[k].colour);
    canvas.add_text(bars[k].name, names, middle, small_size, 2 * names - 0.02);
    canvas.add_text(bars[k].words, words, middle, small_size, 2 * (1 - words));
  }
  if (mark > 0) {
    const double x = left + (right - left) * mark / most, half = 0.0012;
    add_rectangle(renderer, canvas, {x - half, double(foot) / height, x + half, double(foot + rows) / height},
                  colours::black);
  }
  canvas.add_head(title, subtitle);
  canvas.save(png);
}

} // namespace platen::apps::report
