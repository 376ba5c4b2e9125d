#include "apps/report/field_files.h"

#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkUnsignedCharArray.h>
#include <vtkXMLImageDataWriter.h>

#include <algorithm>
#include <cmath>

#include "apps/io/file.h"
#include "apps/io/output_folder.h"
#include "apps/io/pvd.h"
#include "apps/io/vtu.h"
#include "apps/report/field_frame.h"

namespace platen::apps::report {
namespace {

constexpr double reach = 3.5; // of the averages, mean radii

// What holds specimen and platens before the test, a little wider for what spreads.
dem::RegularGrid grid_through(const Run &run, const Spheres &before_test) {
  const Extent extent = extent_of(before_test);
  const double spacing = mean_radius(before_test);
  double box[] = {-extent.half_width, extent.half_width, -extent.half_depth,
                  extent.half_depth,  extent.bottom,     extent.top};
  if (!run.platens.empty()) {
    const auto platens = read_frame(run.platens.frames.front());
    const double *bounds = platens->GetBounds();
    for (int d = 0; d < 3; ++d) {
      box[2 * d] = std::min(box[2 * d], bounds[2 * d]);
      box[2 * d + 1] = std::max(box[2 * d + 1], bounds[2 * d + 1]);
    }
  }
  dem::RegularGrid grid;
  grid.spacing = spacing;
  for (int d = 0; d < 3; ++d) {
    grid.origin[d] = box[2 * d] - spacing;
    grid.nodes[static_cast<std::size_t>(d)] =
        3 + static_cast<int>(std::ceil((box[2 * d + 1] - box[2 * d]) / spacing));
  }
  return grid;
}

template <class Rows>
void add_array(vtkImageData &image, const char *name, int components, const Rows &rows) {
  vtkNew<vtkFloatArray> array;
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(static_cast<vtkIdType>(rows.size()));
  for (std::size_t node = 0; node < rows.size(); ++node)
    for (int c = 0; c < components; ++c)
      array->SetComponent(static_cast<vtkIdType>(node), c, rows[node][c]);
  image.GetPointData()->AddArray(array);
}

// One number a row, read as a row of one.
struct Scalars {
  const std::vector<double> &values;
  std::size_t size() const { return values.size(); }
  const double *operator[](std::size_t node) const { return &values[node]; }
};

// Tensors as VTK takes them.
struct Tensors {
  const std::vector<std::array<double, 9>> &values;
  std::size_t size() const { return values.size(); }
  const double *operator[](std::size_t node) const { return values[node].data(); }
};

void write_image(const std::filesystem::path &file, const FieldFrame &frame) {
  const auto image = image_of(frame.grid);
  const dem::CoarseFields &f = frame.fields;
  add_array(*image, "stress", 9, Tensors{f.stress});
  add_array(*image, "strain", 9, Tensors{f.strain});
  add_array(*image, "displacement", 3, f.displacement);
  add_array(*image, "damage", 1, Scalars{f.damage});
  add_array(*image, "solid_share", 1, Scalars{f.solid_share});
  vtkNew<vtkUnsignedCharArray> body;
  body->SetName("body");
  for (const Body b : frame.body)
    body->InsertNextValue(static_cast<unsigned char>(b));
  image->GetPointData()->AddArray(body);
  vtkNew<vtkXMLImageDataWriter> writer;
  writer->SetInputData(image);
  write_vtk_aside(file, *writer);
}

} // namespace

std::filesystem::path write_fields(const Run &run) {
  const Spheres before_test = read_spheres(run.specimen.frames.front());
  const dem::RegularGrid grid = grid_through(run, before_test);
  const OutputPaths paths(run.folder);
  create_folder(run.folder / "frames");
  PvdSeries series(run.folder / "fields.pvd");
  int count = 0;
  for (const Frame &frame : run.specimen.frames) {
    const std::string name =
        std::filesystem::path(OutputPaths::frame_name("fields", count++)).replace_extension("vti").string();
    write_image(run.folder / name, field_frame(run, frame.time, grid, reach * mean_radius(before_test)));
    series.append(frame.time, name);
  }
  return series.path();
}

} // namespace platen::apps::report
