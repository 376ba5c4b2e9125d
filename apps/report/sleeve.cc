#include "apps/report/sleeve.h"

#include <vtkCell.h>
#include <vtkDataArray.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "apps/report/joined.h"
#include "apps/scene/errors.h"

namespace platen::apps::report {
namespace {

double radius_of(const Position &p) {
  return std::hypot(p[0], p[1]);
}

double distance(const Position &a, const Position &b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

// From low to high along z, and around in one sense: low, low, high, high.
std::array<int, 4> ordered(std::array<int, 4> face, const std::vector<Position> &place) {
  const auto at = [&](int corner) -> const Position & { return place[static_cast<std::size_t>(corner)]; };
  std::sort(face.begin(), face.end(), [&](int a, int b) { return at(a)[2] < at(b)[2]; });
  const auto is_before = [&](int a, int b) { // around, the shorter way
    return at(a)[0] * at(b)[1] - at(a)[1] * at(b)[0] > 0;
  };
  if (!is_before(face[0], face[1])) std::swap(face[0], face[1]);
  if (is_before(face[2], face[3])) std::swap(face[2], face[3]);
  return face;
}

// Calls back with the corners of each face of each element.
template <class Act>
void for_each_face(vtkUnstructuredGrid &grid, const Frame &frame, const Act &act) {
  for (vtkIdType k = 0; k < grid.GetNumberOfCells(); ++k) {
    vtkCell *cell = grid.GetCell(k);
    if (cell->GetCellType() != VTK_HEXAHEDRON)
      throw InputError(frame.parts.front().string() + ": holds other elements than hexahedra");
    for (int face = 0; face < cell->GetNumberOfFaces(); ++face)
      act(cell->GetFace(face)->GetPointIds());
  }
}

} // namespace

SleeveFaces faces_of_sleeve(const Frame &frame) {
  constexpr double nearly = 0.01; // of the wall's thickness
  const vtkSmartPointer<vtkUnstructuredGrid> grid = read_frame(frame);
  vtkDataArray &displacement = point_data(*grid, "displacement", 3, frame);
  const std::vector<vtkIdType> joined = joined_points(*grid);
  SleeveFaces faces;
  faces.points_in_frame = grid->GetNumberOfPoints();
  std::map<vtkIdType, int> corner_of;
  double least = INFINITY, largest = 0; // m, radii
  for (vtkIdType k = 0; k < grid->GetNumberOfPoints(); ++k) {
    if (joined[static_cast<std::size_t>(k)] != k) continue;
    corner_of[k] = static_cast<int>(faces.points.size());
    faces.points.push_back(k);
    Position place;
    grid->GetPoint(k, place.data());
    for (int axis = 0; axis < 3; ++axis)
      place[static_cast<std::size_t>(axis)] -= displacement.GetComponent(k, axis);
    faces.initial.push_back(place);
    least = std::min(least, radius_of(place));
    largest = std::max(largest, radius_of(place));
  }
  const double wall = largest - least;
  for_each_face(*grid, frame, [&](vtkIdList *points) {
    std::array<int, 4> face{};
    bool is_inner = true, is_outer = true;
    for (int k = 0; k < 4; ++k) {
      const int corner = corner_of.at(joined[static_cast<std::size_t>(points->GetId(k))]);
      face[static_cast<std::size_t>(k)] = corner;
      const double radius = radius_of(faces.initial[static_cast<std::size_t>(corner)]);
      is_inner = is_inner && radius < least + nearly * wall;
      is_outer = is_outer && radius > largest - nearly * wall;
    }
    if (is_inner) faces.inner.push_back(ordered(face, faces.initial));
    if (is_outer) faces.outer.push_back(ordered(face, faces.initial));
  });
  if (faces.inner.empty() || faces.outer.empty())
    throw InputError(frame.parts.front().string() + ": no tube around the axis");
  return faces;
}

namespace {

vtkSmartPointer<vtkUnstructuredGrid> same_sleeve(const SleeveFaces &faces, const Frame &frame) {
  vtkSmartPointer<vtkUnstructuredGrid> grid = read_frame(frame);
  if (grid->GetNumberOfPoints() != faces.points_in_frame)
    throw InputError(frame.parts.front().string() + ": another sleeve than in the first frame");
  return grid;
}

std::vector<Position> places_in(const SleeveFaces &faces, vtkUnstructuredGrid &grid) {
  std::vector<Position> places(faces.points.size());
  for (std::size_t k = 0; k < places.size(); ++k)
    grid.GetPoint(faces.points[k], places[k].data());
  return places;
}

} // namespace

std::vector<Position> sleeve_places(const SleeveFaces &faces, const Frame &frame) {
  return places_in(faces, *same_sleeve(faces, frame));
}

SleeveState sleeve_state(const SleeveFaces &faces, const Frame &frame) {
  const vtkSmartPointer<vtkUnstructuredGrid> grid = same_sleeve(faces, frame);
  vtkDataArray &pressure = point_data(*grid, "contact_pressure", 1, frame),
               &slip = point_data(*grid, "slip", 1, frame);
  const std::vector<Position> places = places_in(faces, *grid);
  SleeveState state;
  for (const auto &face : faces.inner) {
    const auto length = [&face](const std::vector<Position> &of, std::size_t a, std::size_t b) {
      return distance(of[static_cast<std::size_t>(face[a])], of[static_cast<std::size_t>(face[b])]);
    };
    const auto stretch = [&](std::size_t a, std::size_t b, std::size_t c, std::size_t d) {
      return (length(places, a, b) + length(places, c, d)) /
                 (length(faces.initial, a, b) + length(faces.initial, c, d)) -
             1;
    };
    const auto mean = [&](vtkDataArray &values) {
      double sum = 0;
      for (const int corner : face)
        sum += values.GetComponent(faces.points[static_cast<std::size_t>(corner)], 0);
      return sum / 4;
    };
    state.around.push_back(stretch(0, 1, 2, 3));
    state.along.push_back(stretch(0, 3, 1, 2));
    state.pressure.push_back(mean(pressure));
    state.slip.push_back(mean(slip));
  }
  return state;
}

} // namespace platen::apps::report
