// Platens on several sides of a box: shapes with such sides, and clearances between platens.
#include <algorithm>
#include <string>

#include "base/shortest_text.h"
#include "coupling/platens_of_test.h"

namespace platen::coupling {
namespace {

constexpr double default_edge_gap = 0.02; // of the specimen's length across the edge

bool has_sides(const PlatenSettings &p) {
  return p.left || p.right || p.front || p.back;
}

} // namespace

void require_edge_gaps(const dem::Shape &shape, const PlatenSettings &settings) {
  if (!has_sides(settings)) return;
  for (const int axis : {0, 1, 2}) {
    const double most = 0.25 * length(shape, axis);
    if (edge_gap(shape, settings, axis) > most)
      throw BadSetup("platens.edge_gap", "leaves too little of a platen. Allowed: up to " + text_of(most) +
                                             " m, a quarter of the specimen.");
  }
}

bool has_neighbours(const PlatenSettings &settings, Side side) {
  return std::any_of(all_sides.begin(), all_sides.end(), [&](Side other) {
    return axis_of(other) != axis_of(side) && settings.side(other) != nullptr;
  });
}

double edge_gap(const dem::Shape &shape, const PlatenSettings &settings, int axis) {
  return settings.edge_gap > 0 ? settings.edge_gap : default_edge_gap * length(shape, axis);
}

void require_short_of_neighbours(const dem::Specimen &specimen, const PlatenTestSettings &settings, Side side,
                                 const fem::SurfaceMesh &surface) {
  constexpr double round_off = 1e-9; // of a length
  constexpr std::array<const char *, 3> names{"x", "y", "z"};
  for (const Side neighbour : all_sides) {
    const int axis = axis_of(neighbour);
    if (axis == axis_of(side) || settings.platens.side(neighbour) == nullptr) continue;
    const double plane = extent(specimen.shape, axis)[is_high(neighbour)], inwards = inward(neighbour)[axis],
                 gap = edge_gap(specimen.shape, settings.platens, axis);
    for (const Vector3 &x : surface.vertices)
      if (inwards * (x[axis] - plane) < (1 - round_off) * gap)
        throw BadSetup(std::string("platens.") + name_of(side) + ".grid",
                       "reaches to " + text_of(x[axis]) + " m along " +
                           names[static_cast<std::size_t>(axis)] + ", where the platen " +
                           name_of(neighbour) + " is. Allowed: up to " + text_of(plane + inwards * gap) +
                           " m, short of it by `platens.edge_gap`.");
  }
}

} // namespace platen::coupling
