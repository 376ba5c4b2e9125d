#include "apps/report/fields.h"

#include <vtkBoundingBox.h>
#include <vtkDataArray.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkProbeFilter.h>
#include <vtkUnsignedCharArray.h>
#include <vtkXMLImageDataWriter.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <unordered_map>

#include "apps/output/file.h"
#include "apps/output/output_folder.h"
#include "apps/output/pvd.h"
#include "apps/output/vtu.h"
#include "base/pi.h"

namespace platen::apps::report {
namespace {

constexpr double reach_in_files = 3.5; // of the averages, mean radii
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
// Solid share from which a node is in the specimen. Dense packings have 0.55 to 0.64 within, half of it at a
// flat surface, and less where the ends were packed against a wall.
constexpr double at_surface = 0.2;

Vector3 vector_at(vtkDataArray &array, vtkIdType k) {
  return {array.GetComponent(k, 0), array.GetComponent(k, 1), array.GetComponent(k, 2)};
}

void add_contacts(dem::SphereColumns &spheres, const std::unordered_map<long long, std::size_t> &row_of_id,
                  const Frame &frame, double packing_fraction) {
  const vtkSmartPointer<vtkUnstructuredGrid> grid = read_frame(frame, Points::maybe_none);
  if (grid->GetNumberOfPoints() == 0) return;
  vtkDataArray &normal = point_data(*grid, "normal", 3, frame), &shear = point_data(*grid, "shear", 3, frame),
               &size = point_data(*grid, "normal_force", 1, frame),
               &particle = point_data(*grid, "particle", 1, frame);
  for (vtkIdType k = 0; k < grid->GetNumberOfPoints(); ++k) {
    const auto found = row_of_id.find(std::llround(particle.GetComponent(k, 0)));
    if (found == row_of_id.end()) continue; // of a frame of another time
    const std::size_t i = found->second;
    const double *p = grid->GetPoint(k), r = spheres.radius[i];
    const Vector3 arm = Vector3{p[0], p[1], p[2]} - spheres.position[i],
                  force = size.GetComponent(k, 0) * vector_at(normal, k) + vector_at(shear, k);
    const double volume = 4.0 / 3 * pi * r * r * r / packing_fraction;
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b)
        spheres.stress[i][static_cast<std::size_t>(3 * a + b)] +=
            0.5 * (arm[a] * force[b] + arm[b] * force[a]) / volume;
  }
}

// What the platens are at the nodes: inside or not, and their stress where they have one.
void add_platens(FieldFrame &frame, vtkUnstructuredGrid *platens) {
  vtkNew<vtkProbeFilter> probe;
  probe->SetInputData(image_of(frame.grid));
  probe->SetSourceData(platens);
  probe->Update();
  vtkPointData *found = probe->GetOutput()->GetPointData();
  vtkDataArray *inside = found->GetArray(probe->GetValidPointMaskArrayName()),
               *stress = found->GetArray("stress"); // rigid ones have none
  for (std::size_t node = 0; node < frame.body.size(); ++node) {
    const vtkIdType k = static_cast<vtkIdType>(node);
    if (inside->GetComponent(k, 0) == 0) continue;
    frame.body[node] = Body::platen;
    for (int c = 0; c < 9; ++c)
      frame.fields.stress[node][static_cast<std::size_t>(c)] =
          stress != nullptr ? stress->GetComponent(k, c) : nan;
  }
}

// Nothing but the stress in platens, nothing at all outside.
void empty_outside(FieldFrame &frame) {
  dem::CoarseFields &f = frame.fields;
  for (std::size_t node = 0; node < frame.body.size(); ++node) {
    if (frame.body[node] == Body::specimen) continue;
    f.solid_share[node] = 0;
    f.damage[node] = nan;
    f.displacement[node] = {nan, nan, nan};
    f.strain[node].fill(nan);
    if (frame.body[node] == Body::outside) f.stress[node].fill(nan);
  }
}

// What holds specimen and platens before the test, a little wider for what spreads.
dem::RegularGrid grid_through(const Run &run, const Spheres &before_test) {
  const Extent extent = extent_of(before_test);
  const double spacing = mean_radius(before_test);
  vtkBoundingBox box(-extent.half_width, extent.half_width, -extent.half_depth, extent.half_depth,
                     extent.bottom, extent.top);
  if (!run.platens.empty()) box.AddBounds(read_frame(run.platens.front())->GetBounds());
  dem::RegularGrid grid;
  grid.spacing = spacing;
  for (int d = 0; d < 3; ++d) {
    grid.origin[d] = box.GetMinPoint()[d] - spacing;
    grid.nodes[static_cast<std::size_t>(d)] = 3 + static_cast<int>(std::ceil(box.GetLength(d) / spacing));
  }
  return grid;
}

// `at(node)`: its `components` numbers.
template <class At>
void add_array(vtkImageData &image, const char *name, int components, const At &at) {
  vtkNew<vtkFloatArray> array;
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(image.GetNumberOfPoints());
  for (vtkIdType node = 0; node < image.GetNumberOfPoints(); ++node)
    for (int c = 0; c < components; ++c)
      array->SetComponent(node, c, at(static_cast<std::size_t>(node))[c]);
  image.GetPointData()->AddArray(array);
}

void write_image(const std::filesystem::path &file, const FieldFrame &frame) {
  const auto image = image_of(frame.grid);
  const dem::CoarseFields &f = frame.fields;
  add_array(*image, "stress", 9, [&f](std::size_t node) { return f.stress[node].data(); });
  add_array(*image, "strain", 9, [&f](std::size_t node) { return f.strain[node].data(); });
  add_array(*image, "displacement", 3, [&f](std::size_t node) { return f.displacement[node]; });
  add_array(*image, "damage", 1, [&f](std::size_t node) { return &f.damage[node]; });
  add_array(*image, "solid_share", 1, [&f](std::size_t node) { return &f.solid_share[node]; });
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

bool tells_stress(const Run &run) {
  return !run.specimen.empty() && !run.contacts.empty() &&
         !std::isnan(number_in(run.summary, "packing_fraction")) &&
         read_frame(run.specimen.front())->GetPointData()->HasArray("stress") &&
         read_frame(nearest(run.contacts, run.moments.peak_time))->GetPointData()->HasArray("particle");
}

dem::SphereColumns stressed_spheres(const Run &run, double time) {
  const Frame &frame = nearest(run.specimen, time);
  const Spheres spheres = read_spheres(frame);
  const vtkSmartPointer<vtkUnstructuredGrid> grid = read_frame(frame);
  vtkDataArray &stress = point_data(*grid, "stress", 9, frame);
  dem::SphereColumns columns;
  std::unordered_map<long long, std::size_t> row_of_id;
  for (std::size_t k = 0; k < spheres.size(); ++k) {
    const Position &now = spheres.position[k], &before = spheres.initial[k];
    columns.position.push_back({now[0], now[1], now[2]});
    columns.displacement.push_back({now[0] - before[0], now[1] - before[1], now[2] - before[2]});
    columns.damage.push_back(spheres.damage(k));
    stress.GetTuple(static_cast<vtkIdType>(k), columns.stress.emplace_back().data());
    row_of_id[spheres.id[k]] = k;
  }
  columns.radius = spheres.radius;
  add_contacts(columns, row_of_id, nearest(run.contacts, frame.time),
               number_in(run.summary, "packing_fraction"));
  return columns;
}

FieldFrame field_frame(const Run &run, double time, const dem::RegularGrid &grid, double reach) {
  FieldFrame frame;
  frame.time = nearest(run.specimen, time).time;
  frame.grid = grid;
  frame.fields = dem::coarse_grain(stressed_spheres(run, time), grid, reach);
  for (const double share : frame.fields.solid_share)
    frame.body.push_back(share > at_surface ? Body::specimen : Body::outside);
  if (!run.platens.empty()) add_platens(frame, read_frame(nearest(run.platens, frame.time)));
  empty_outside(frame);
  return frame;
}

vtkSmartPointer<vtkImageData> image_of(const dem::RegularGrid &grid) {
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(grid.nodes[0], grid.nodes[1], grid.nodes[2]);
  image->SetOrigin(grid.origin.x, grid.origin.y, grid.origin.z);
  image->SetSpacing(grid.spacing, grid.spacing, grid.spacing);
  return image;
}

double mean_radius(const Spheres &spheres) {
  return std::accumulate(spheres.radius.begin(), spheres.radius.end(), 0.0) /
         static_cast<double>(spheres.size());
}

std::filesystem::path write_fields(const Run &run) {
  const Spheres before_test = read_spheres(run.specimen.front());
  const dem::RegularGrid grid = grid_through(run, before_test);
  const OutputPaths paths(run.folder);
  create_folder(run.folder / "frames");
  const std::filesystem::path pvd = run.folder / "fields.pvd";
  PvdSeries series(pvd);
  int count = 0;
  for (const Frame &frame : run.specimen) {
    const std::string name =
        std::filesystem::path(OutputPaths::frame_name("fields", count++)).replace_extension("vti").string();
    write_image(run.folder / name,
                field_frame(run, frame.time, grid, reach_in_files * mean_radius(before_test)));
    series.append(frame.time, name);
  }
  return pvd;
}

} // namespace platen::apps::report
