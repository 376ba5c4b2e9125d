#include "dem/packing/direction_cells.h"

#include <cmath>

#include "base/pi.h"

namespace platen::dem {

namespace {

// Solid angle of the spherical triangle of three unit vectors (van Oosterom and Strackee 1983).
double solid_angle(const Vector3 &a, const Vector3 &b, const Vector3 &c) {
  return 2 * std::atan2(std::abs(dot(a, cross(b, c))), 1 + dot(a, b) + dot(b, c) + dot(c, a));
}

Vector3 unit(const Vector3 &v) {
  return v / norm(v);
}

// Corners of an icosahedron: cyclic permutations of (0, +-1, +-golden ratio).
std::array<Vector3, 12> icosahedron_corners() {
  const double golden = 0.5 * (1 + std::sqrt(5.0));
  std::array<Vector3, 12> corner;
  std::size_t n = 0;
  for (const double a : {-1.0, 1.0})
    for (const double b : {-golden, golden}) {
      corner[n++] = unit({0, a, b});
      corner[n++] = unit({a, b, 0});
      corner[n++] = unit({b, 0, a});
    }
  return corner;
}

bool is_edge(const Vector3 &a, const Vector3 &b) {
  return dot(a, b) > 0.4;
} // 1/sqrt 5 along an edge, else negative

} // namespace

DirectionCells::DirectionCells() {
  const std::array<Vector3, 12> corner = icosahedron_corners();
  std::size_t n = 0;
  for (std::size_t i = 0; i < 12; ++i)
    for (std::size_t j = i + 1; j < 12; ++j)
      for (std::size_t k = j + 1; k < 12; ++k)
        if (is_edge(corner[i], corner[j]) && is_edge(corner[j], corner[k]) && is_edge(corner[k], corner[i])) {
          const bool outward =
              dot(corner[i], cross(corner[j], corner[k])) > 0; // corners anticlockwise from outside
          face_[n++] = {{corner[i], outward ? corner[j] : corner[k], outward ? corner[k] : corner[j]}};
        }
  for (std::size_t f = 0; f < 20; ++f) {
    Triangle child[4], grandchild[4];
    split(face_[f], child);
    for (std::size_t a = 0; a < 4; ++a) {
      split(child[a], grandchild);
      for (std::size_t b = 0; b < 4; ++b) {
        const Vector3 *c = grandchild[b].corner;
        weight_[16 * f + 4 * a + b] = solid_angle(c[0], c[1], c[2]) / (4 * pi);
        middle_[16 * f + 4 * a + b] = unit(c[0] + c[1] + c[2]);
      }
    }
  }
  for (std::size_t cell = 0; cell < count; ++cell)
    opposite_[cell] = cell_of(-middle_[cell]);
}

// Three corner triangles, each in the place of its corner, then the one in the middle; corners on the unit
// sphere.
void DirectionCells::split(const Triangle &parent, Triangle child[4]) {
  const Vector3 *c = parent.corner;
  const Vector3 m01 = unit(c[0] + c[1]), m12 = unit(c[1] + c[2]), m20 = unit(c[2] + c[0]);
  child[0] = {{c[0], m01, m20}};
  child[1] = {{m01, c[1], m12}};
  child[2] = {{m20, m12, c[2]}};
  child[3] = {{m12, m20, m01}};
}

std::size_t DirectionCells::cell_of(const Vector3 &direction) const {
  std::size_t face = 0;
  double nearest = -2 * norm(direction);
  for (std::size_t f = 0; f < 20; ++f) { // faces of a regular solid: the nearest middle is the face itself
    const double along = dot(direction, face_[f].corner[0] + face_[f].corner[1] + face_[f].corner[2]) / 3;
    if (along > nearest) nearest = along, face = f;
  }
  Triangle triangle = face_[face], child[4];
  std::size_t cell = face;
  for (int level = 0; level < 2; ++level) {
    split(triangle, child);
    // Corner k is cut off by the great circle through the two corners of the middle triangle next to it.
    std::size_t part = 3;
    const Vector3 *m = child[3].corner; // opposite to corners 0, 1, 2
    for (std::size_t k = 0; k < 3 && part == 3; ++k)
      if (dot(direction, cross(m[(k + 1) % 3], m[(k + 2) % 3])) < 0) part = k;
    triangle = child[part];
    cell = 4 * cell + part;
  }
  return cell;
}

std::vector<AxisCell> count_axes(const std::vector<Vector3> &axes) {
  const DirectionCells cells;
  std::array<std::size_t, DirectionCells::count> hits{};
  for (const Vector3 &axis : axes)
    ++hits[cells.cell_of(axis)];
  std::vector<AxisCell> merged;
  for (std::size_t cell = 0; cell < DirectionCells::count; ++cell) {
    const std::size_t other = cells.opposite(cell);
    if (other < cell) continue;
    const Vector3 &middle = cells.middle(cell);
    merged.push_back({middle.z < 0 ? -middle : middle, cells.weight(cell) + cells.weight(other),
                      hits[cell] + hits[other]});
  }
  return merged;
}

double isotropy_chi_squared(const std::vector<AxisCell> &cells) {
  std::size_t axes = 0;
  for (const AxisCell &cell : cells)
    axes += cell.axes;
  if (axes == 0) return 0;
  const double n = static_cast<double>(axes);
  double sum = 0;
  for (const AxisCell &cell : cells) {
    const double excess = static_cast<double>(cell.axes) / n - cell.weight;
    sum += excess * excess / cell.weight;
  }
  return n * sum / static_cast<double>(cells.size() - 1);
}

} // namespace platen::dem
