#include "apps/report/field_frame.h"

#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkProbeFilter.h>

#include <limits>
#include <numeric>
#include <unordered_map>

#include "apps/scene/errors.h"
#include "base/pi.h"

namespace platen::apps::report {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
// Solid share from which a node is in the specimen. Dense packings have 0.55 to 0.64 within, half of it at a
// flat surface, and less where the ends were packed against a wall.
constexpr double at_surface = 0.2;

vtkDataArray &field(vtkUnstructuredGrid &grid, const char *name, int components, const Frame &frame) {
  vtkDataArray *array = grid.GetPointData()->GetArray(name);
  if (array == nullptr || array->GetNumberOfComponents() != components)
    throw InputError(frame.parts.front().string() + ": no point data \"" + name + "\" of " +
                     std::to_string(components) + " components");
  return *array;
}

Vector3 vector_at(vtkDataArray &array, vtkIdType k) {
  return {array.GetComponent(k, 0), array.GetComponent(k, 1), array.GetComponent(k, 2)};
}

void add_contacts(dem::SphereColumns &spheres, const std::unordered_map<long long, std::size_t> &row_of_id,
                  const Frame &frame, double packing_fraction) {
  const vtkSmartPointer<vtkUnstructuredGrid> grid = read_frame(frame, Points::maybe_none);
  if (grid->GetNumberOfPoints() == 0) return;
  vtkDataArray &normal = field(*grid, "normal", 3, frame), &shear = field(*grid, "shear", 3, frame),
               &size = field(*grid, "normal_force", 1, frame), &particle = field(*grid, "particle", 1, frame);
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

} // namespace

bool tells_stress(const Run &run) {
  const auto packing = run.summary.find("packing_fraction");
  return !run.specimen.empty() && !run.contacts.empty() && packing != run.summary.end() &&
         packing->is_number() &&
         read_frame(run.specimen.frames.front())->GetPointData()->HasArray("stress") &&
         read_frame(run.contacts.nearest(run.moments.peak_time))->GetPointData()->HasArray("particle");
}

dem::SphereColumns stressed_spheres(const Run &run, double time) {
  const Frame &frame = run.specimen.nearest(time);
  const Spheres spheres = read_spheres(frame);
  const vtkSmartPointer<vtkUnstructuredGrid> grid = read_frame(frame);
  vtkDataArray &stress = field(*grid, "stress", 9, frame);
  dem::SphereColumns columns;
  std::unordered_map<long long, std::size_t> row_of_id;
  for (std::size_t k = 0; k < spheres.size(); ++k) {
    columns.position.push_back({spheres.x[k], spheres.y[k], spheres.z[k]});
    columns.displacement.push_back(columns.position[k] -
                                   Vector3{spheres.x0[k], spheres.y0[k], spheres.z0[k]});
    columns.damage.push_back(spheres.damage(k));
    std::array<double, 9> s;
    for (int c = 0; c < 9; ++c)
      s[static_cast<std::size_t>(c)] = stress.GetComponent(static_cast<vtkIdType>(k), c);
    columns.stress.push_back(s);
    row_of_id[spheres.id[k]] = k;
  }
  columns.radius = spheres.radius;
  add_contacts(columns, row_of_id, run.contacts.nearest(frame.time),
               run.summary["packing_fraction"].get<double>());
  return columns;
}

FieldFrame field_frame(const Run &run, double time, const dem::RegularGrid &grid, double reach) {
  FieldFrame frame;
  frame.time = run.specimen.nearest(time).time;
  frame.grid = grid;
  frame.fields = dem::coarse_grain(stressed_spheres(run, time), grid, reach);
  for (const double share : frame.fields.solid_share)
    frame.body.push_back(share > at_surface ? Body::specimen : Body::outside);
  if (!run.platens.empty()) add_platens(frame, read_frame(run.platens.nearest(frame.time)));
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

} // namespace platen::apps::report
