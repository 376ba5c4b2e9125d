#include "apps/report/platen_contacts.h"

#include <vtkDataArray.h>
#include <vtkPointData.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "apps/scene/errors.h"
#include "base/pi.h"

namespace platen::apps::report {
namespace {

// Contacts at the rim of a platen may press aslant; those of a sleeve press sideways.
constexpr double upright = 0.7;

vtkDataArray *field(vtkUnstructuredGrid &grid, const char *name, int components, const Frame &frame) {
  vtkDataArray *array = grid.GetPointData()->GetArray(name);
  if (array == nullptr || array->GetNumberOfComponents() != components)
    throw InputError(frame.parts.front().string() + ": no point data \"" + name + "\" of " +
                     std::to_string(components) + " components");
  return array;
}

} // namespace

double PlatenContacts::sliding_share() const {
  if (size() == 0) return std::numeric_limits<double>::quiet_NaN();
  return static_cast<double>(std::count(sliding.begin(), sliding.end(), true)) / static_cast<double>(size());
}

PlatenContacts contacts_with(PlatenEnd end, const Frame &frame) {
  const vtkSmartPointer<vtkUnstructuredGrid> grid = read_frame(frame);
  vtkDataArray *normal = field(*grid, "normal", 3, frame), *shear = field(*grid, "shear", 3, frame),
               *force = field(*grid, "normal_force", 1, frame), *sliding = field(*grid, "sliding", 1, frame);
  PlatenContacts contacts;
  for (vtkIdType k = 0; k < grid->GetNumberOfPoints(); ++k) {
    const double up = normal->GetComponent(k, 2);
    if (!(end == PlatenEnd::bottom ? up > upright : up < -upright)) continue;
    const double *p = grid->GetPoint(k);
    const double radius = std::hypot(p[0], p[1]);
    const double sx = shear->GetComponent(k, 0), sy = shear->GetComponent(k, 1);
    contacts.x.push_back(p[0]);
    contacts.y.push_back(p[1]);
    contacts.normal_force.push_back(force->GetComponent(k, 0));
    contacts.inward_shear.push_back(radius > 0 ? -(sx * p[0] + sy * p[1]) / radius : 0);
    contacts.shear.push_back(std::hypot(sx, sy, shear->GetComponent(k, 2)));
    contacts.sliding.push_back(sliding->GetComponent(k, 0) != 0);
  }
  return contacts;
}

RingProfile profile_of(const PlatenContacts &contacts, double radius, int rings) {
  RingProfile profile;
  const std::size_t n = static_cast<std::size_t>(rings);
  profile.pressure.assign(n, 0.0);
  profile.inward_shear.assign(n, 0.0);
  for (std::size_t k = 0; k < n; ++k)
    profile.middle.push_back(radius * std::sqrt((static_cast<double>(k) + 0.5) / rings));
  const double area = pi * radius * radius / rings;
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const double share = (contacts.x[k] * contacts.x[k] + contacts.y[k] * contacts.y[k]) / (radius * radius);
    const std::size_t ring =
        std::min(n - 1, static_cast<std::size_t>(share * rings)); // the last holds what lies beyond
    profile.pressure[ring] += contacts.normal_force[k] / area;
    profile.inward_shear[ring] += contacts.inward_shear[k] / area;
  }
  return profile;
}

} // namespace platen::apps::report
