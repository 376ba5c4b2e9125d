// Where the seconds of a run went, as bars.
#include <vtkActor2D.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper2D.h>
#include <vtkProperty2D.h>

#include <algorithm>
#include <cstdio>

#include "apps/report/canvas.h"
#include "apps/report/costs.h"
#include "apps/report/pictures.h"
#include "apps/report/style.h"

namespace platen::apps::report {
namespace {

// A filled rectangle; fractions of the canvas.
void add_bar(vtkRenderer *renderer, const Canvas &canvas, const std::array<double, 4> &x0_y0_x1_y1,
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

void draw_costs(const Run &run, const std::filesystem::path &png) {
  constexpr int width = 1640, row = 74, foot = 50;
  constexpr double names = 0.14, left = 0.28, right = 0.78, numbers = 0.88; // fractions of the width
  const std::vector<Cost> costs = costs_of(run);
  const int height = Canvas::head_height + row * static_cast<int>(costs.size()) + foot;
  double whole = 0, most = 0;
  for (const Cost &cost : costs) {
    whole += cost.seconds;
    most = std::max(most, cost.seconds);
  }
  Canvas canvas(width, height);
  vtkRenderer *renderer = canvas.add_renderer({0, 0, 1, 1});
  for (std::size_t k = 0; k < costs.size(); ++k) {
    const double middle =
        1 - (Canvas::head_height + row * (static_cast<double>(k) + 0.5)) / static_cast<double>(height);
    const double half = 0.35 * row / height, reach = left + (right - left) * costs[k].seconds / most;
    add_bar(renderer, canvas, {left, middle - half, reach, middle + half},
            costs[k].is_stage ? colours::blue : colours::grey);
    canvas.add_text(costs[k].name, names, middle, small_size, 2 * names - 0.02);
    char text[64];
    std::snprintf(text, sizeof text, "%.2f s   %.1f %%", costs[k].seconds, 100 * costs[k].seconds / whole);
    canvas.add_text(text, numbers, middle, small_size);
  }
  char words[96];
  std::snprintf(words, sizeof words, "Where %.1f seconds went; blue: stages of the steps", whole);
  canvas.add_head(run.title, words);
  canvas.save(png);
}

} // namespace platen::apps::report
