#include "apps/report/heat_map.h"

#include <vtkAxis.h>
#include <vtkChartXY.h>
#include <vtkColorTransferFunction.h>
#include <vtkContextActor.h>
#include <vtkContextScene.h>
#include <vtkDoubleArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPlotHistogram2D.h>
#include <vtkPointData.h>

#include <algorithm>
#include <cmath>

#include "apps/report/canvas.h"
#include "apps/report/chart.h"
#include "apps/report/specimen_view.h"

namespace platen::apps::report {
namespace {

constexpr double mm_per_m = 1e3;

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

void save_heat_map(const std::string &title, const std::string &subtitle, const DensityMap &map,
                   const std::filesystem::path &png) {
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
  const auto item = frame_chart(area);
  vtkNew<vtkPlotHistogram2D> plot;
  plot->SetInputData(mirrored_image(map, factor));
  plot->SetTransferFunction(ramp);
  item->AddPlot(plot);
  set_axis(item->GetAxis(vtkAxis::BOTTOM), {-mm_radius, mm_radius}, 4, Sign::dropped);
  set_axis(item->GetAxis(vtkAxis::LEFT), {0, mm_height}, 8);
  add_axis_titles(canvas, area,
                  map.is_plane ? "Distance from the middle plane (mm)" : "Distance from the axis (mm)",
                  "Height (mm)");
  add_chart_scene(canvas, {item});
  add_colour_bar(canvas, colouring, 1 - (right - 60.0 + 0.5 * spare) / width);
  canvas.add_head(title, subtitle);
  canvas.save(png);
}

} // namespace platen::apps::report
