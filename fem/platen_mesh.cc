#include "fem/platen_mesh.h"

#include <deal.II/grid/tria.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace platen::fem {
namespace {

constexpr double in_plane = 1e-6;     // of the height, for rounded coordinates
constexpr double looking_share = 0.5; // of a normal along the axis: 60 degrees

template <class Face>
bool lies_at(const Face &face, double z, double near) {
  for (const unsigned int v : face->vertex_indices())
    if (std::abs(face->vertex(v)[2] - z) > near) return false;
  return true;
}

// The share of the outward normal along z.
template <class Face>
double looks_along_z(const Face &face, const dealii::Point<3> &inside) {
  const auto normal =
      dealii::cross_product_3d(face->vertex(3) - face->vertex(0), face->vertex(2) - face->vertex(1));
  const double size = normal.norm(), side = normal * (face->center() - inside) > 0 ? 1 : -1;
  return size > 0 ? side * normal[2] / size : 0.0;
}

} // namespace

Grid laid_platen(const Grid &grid, bool faces_up, double plane) {
  const auto &points = grid->get_vertices();
  double low = points[0][2], high = low;
  for (const dealii::Point<3> &p : points)
    low = std::min(low, p[2]), high = std::max(high, p[2]);
  const double shift = plane - (faces_up ? high : low), near = in_plane * (high - low);
  const double fixed = (faces_up ? low : high) + shift;
  const Grid laid = moved_grid(grid, [&](const Vector3 &p) {
    const bool extreme = std::abs(p[2] + shift - plane) <= near; // what is flat is flat to the last bit
    return Vector3{p[0], p[1], extreme ? plane : p[2] + shift};
  });
  const int near_tag = faces_up ? high_end_tag : low_end_tag, far_tag = faces_up ? low_end_tag : high_end_tag;
  int flat = 0, clamped = 0;
  const auto tag_faces = [&](const auto &tag_of) {
    for (const auto &cell : laid->active_cell_iterators())
      for (const unsigned int f : cell->face_indices()) {
        const auto face = cell->face(f);
        if (face->at_boundary())
          face->set_boundary_id(static_cast<dealii::types::boundary_id>(tag_of(face, cell->center())));
      }
  };
  tag_faces([&](const auto &face, const dealii::Point<3> &) {
    const bool at_near = lies_at(face, plane, near), at_far = lies_at(face, fixed, near);
    flat += at_near, clamped += at_far;
    return at_near ? near_tag : at_far ? far_tag : mantle_tag;
  });
  if (clamped == 0)
    throw std::invalid_argument(std::string("has no face in the plane of its ") +
                                (faces_up ? "lowest" : "highest") +
                                " point: the machine has nothing to hold");
  if (flat > 0) return laid;
  tag_faces([&](const auto &face, const dealii::Point<3> &inside) {
    if (static_cast<int>(face->boundary_id()) == far_tag) return far_tag;
    return (faces_up ? 1 : -1) * looks_along_z(face, inside) > looking_share ? near_tag : mantle_tag;
  });
  return laid;
}

int materials_of(const Grid &grid) {
  int most = 0;
  for (const auto &cell : grid->active_cell_iterators())
    most = std::max(most, static_cast<int>(cell->material_id()));
  return most + 1;
}

} // namespace platen::fem
