// How the stress flows from the platens through the specimen: sections along the axis.
#include <fmt/format.h>
#include <vtkChartXY.h>
#include <vtkColorTransferFunction.h>
#include <vtkDoubleArray.h>
#include <vtkMath.h>
#include <vtkNew.h>
#include <vtkPointData.h>

#include <algorithm>
#include <cmath>

#include "apps/report/chart.h"
#include "apps/report/fields.h"
#include "apps/report/specimen_view.h"

namespace platen::apps::report {
namespace {

constexpr double reach = 5, fineness = 0.25; // of averages, of nodes; mean radii

// The plane beside y = 0, which may lie between the bristles of a brush, through the specimen and the near
// quarter of its height of each platen.
dem::RegularGrid section_grid(const Extent &extent, double radius) {
  const double width = 1.35 * extent.half_width, beyond = 0.25 * extent.height(), spacing = fineness * radius;
  dem::RegularGrid grid;
  grid.origin = {-width, spacing, extent.bottom - beyond};
  grid.spacing = spacing;
  grid.nodes = {1 + static_cast<int>(2 * width / spacing), 1,
                1 + static_cast<int>((extent.height() + 2 * beyond) / spacing)};
  return grid;
}

// MPa, compression positive.
double vertical(const std::array<double, 9> &stress) {
  return -stress[8] / pa_per_mpa;
}

// MPa, half the difference of the outer principal stresses.
double largest_shear(const std::array<double, 9> &s) {
  if (std::isnan(s[0])) return s[0];
  double rows[3][3], values[3], vectors[3][3];
  double *row[] = {rows[0], rows[1], rows[2]}, *vector[] = {vectors[0], vectors[1], vectors[2]};
  for (std::size_t k = 0; k < 9; ++k)
    rows[k / 3][k % 3] = s[k];
  vtkMath::Jacobi(row, values, vector); // largest first
  return 0.5 * (values[0] - values[2]) / pa_per_mpa;
}

struct SectionMap {
  std::vector<double> values; // one a node
  std::string title;          // of the colour bar
};

// Round ends that hold all but the outer 2 % of the values, and zero.
std::vector<double> ticks_of(const std::vector<double> &values) {
  std::vector<double> known;
  for (const double value : values)
    if (!std::isnan(value)) known.push_back(value);
  if (known.empty()) return {0, 1};
  std::sort(known.begin(), known.end());
  const auto at = [&known](double share) {
    return known[static_cast<std::size_t>(share * static_cast<double>(known.size() - 1))];
  };
  return round_ticks(std::min(0.0, at(0.02)), std::max(0.0, at(0.98)), 5);
}

// Rigid platens, which have no stress, in grey: a colour below the ramp.
vtkSmartPointer<vtkImageData> coloured_image(const FieldFrame &frame, const SectionMap &map, double low,
                                             double high) {
  const auto image = image_of(frame.grid);
  const auto &o = frame.grid.origin;
  image->SetDimensions(frame.grid.nodes[0], frame.grid.nodes[2], 1);
  image->SetOrigin(o.x * mm_per_m, o.z * mm_per_m, 0);
  image->SetSpacing(frame.grid.spacing * mm_per_m, frame.grid.spacing * mm_per_m, 1);
  vtkNew<vtkDoubleArray> values;
  for (std::size_t node = 0; node < map.values.size(); ++node) {
    const double value = map.values[node];
    const bool rigid = std::isnan(value) && frame.body[node] == Body::platen;
    values->InsertNextValue(rigid               ? low - (high - low)
                            : std::isnan(value) ? value
                                                : std::clamp(value, low, high));
  }
  values->SetName("value");
  image->GetPointData()->SetScalars(values);
  return image;
}

vtkSmartPointer<vtkColorTransferFunction> ramp_over_grey(double low, double high) {
  const auto ramp = colour_ramp(Ramp::displacement, low, high);
  ramp->AddRGBPoint(low - (high - low), 0.72, 0.75, 0.78);
  ramp->AddRGBPoint(low - 0.5 * (high - low), 0.72, 0.75, 0.78);
  ramp->SetNanColor(1, 1, 1);
  return ramp;
}

} // namespace

void draw_stress_flow(const Run &run, const Spheres &before_test, const std::filesystem::path &png) {
  const Extent extent = extent_of(before_test);
  const double radius = mean_radius(before_test);
  const FieldFrame frame =
      field_frame(run, run.moments.peak_time, section_grid(extent, radius), reach * radius);
  SectionMap maps[] = {{{}, "Vertical stress\n(MPa,\ncompression +)"}, {{}, "Largest shear\nstress (MPa)"}};
  for (const auto &stress : frame.fields.stress) {
    maps[0].values.push_back(vertical(stress));
    maps[1].values.push_back(largest_shear(stress));
  }

  constexpr int plot_height = 1060, left = 170, bar = 290, foot = 130;
  const double mm_width = 2 * std::abs(frame.grid.origin.x) * mm_per_m,
               mm_height = frame.grid.spacing * (frame.grid.nodes[2] - 1) * mm_per_m,
               mm_low = frame.grid.origin.z * mm_per_m;
  const int plot_width = static_cast<int>(plot_height * mm_width / mm_height),
            panel = left + plot_width + bar;
  Canvas canvas(2 * panel, Canvas::head_height + plot_height + foot);
  std::vector<vtkSmartPointer<vtkChartXY>> charts;
  for (int k = 0; k < 2; ++k) {
    const std::vector<double> ticks = ticks_of(maps[k].values);
    const PlotArea area{static_cast<double>(k * panel + left), foot, static_cast<double>(plot_width),
                        plot_height};
    charts.push_back(image_chart(area, coloured_image(frame, maps[k], ticks.front(), ticks.back()),
                                 ramp_over_grey(ticks.front(), ticks.back()), {-mm_width / 2, mm_width / 2},
                                 {mm_low, mm_low + mm_height}));
    add_axis_titles(canvas, area, "x (mm)", "z (mm)");
  }
  add_chart_scene(canvas, charts); // a layer over the whole canvas: bars come after it
  const double width = canvas.width();
  for (int k = 0; k < 2; ++k)
    add_colour_bar(canvas, {Ramp::displacement, ticks_of(maps[k].values), maps[k].title},
                   (k * panel + left + plot_width + 20) / width, (k + 1) * panel / width);
  canvas.add_head(run.title, fmt::format("Section y = {:.2g} mm near the peak (frame at {:.3g} of its time), "
                                         "averages over {:.3g} mm",
                                         frame.grid.origin.y * mm_per_m, frame.time / run.moments.peak_time,
                                         2 * reach * radius * mm_per_m));
  canvas.save(png);
}

} // namespace platen::apps::report
