// Steel that yields, and blocks of it, for tests.
#pragma once

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <optional>
#include <vector>

#include "fem/hyperelastic_solid.h"

namespace platen::fem {

inline Hardening lines(std::initializer_list<Hardening::Point> points, double saturation = 0,
                       double rate = 0) {
  Hardening hardening;
  for (const Hardening::Point &point : points)
    hardening.points[hardening.count++] = point;
  hardening.saturation = saturation, hardening.rate = rate;
  return hardening;
}

inline const SolidMaterial ductile_steel{7850, NeoHookean::from_young(210e9, 0.3), lines({{0, 250e6}})};
// A plateau, a line, and a part that saturates.
inline const Hardening curved = lines({{0, 300e6}, {0.01, 300e6}, {0.05, 360e6}}, 90e6, 40);

inline Corners corners_of(const std::vector<Vector3> &field) {
  Corners corners;
  for (std::size_t a = 0; a < 8; ++a)
    corners[a] = field[a];
  return corners;
}

// A block of 3 x 3 x 3 elements of 1 cm whose inner nodes are moved out of their places.
inline Grid distorted_grid() {
  return moved_grid(
      make_grid(BoxPlate{{-0.015, -0.015, 0}, {0.015, 0.015, 0.03}, {3, 3, 3}}), [](const Vector3 &p) {
        const auto inside = [](double x, double low, double high) {
          return x > low + 1e-6 && x < high - 1e-6;
        };
        if (!inside(p.x, -0.015, 0.015) || !inside(p.y, -0.015, 0.015) || !inside(p.z, 0, 0.03)) return p;
        return p +
               2e-3 * Vector3{std::sin(900 * p.y + 500 * p.z), std::cos(700 * p.z), std::sin(800 * p.x + 3)};
      });
}

inline HyperelasticSolid distorted_block(const std::optional<Hardening> &hardening) {
  return HyperelasticSolid(distorted_grid(), {ductile_steel.density, ductile_steel.law, hardening});
}

inline ReferenceCell distorted_cell() {
  return read_mesh(distorted_grid()).cells[0];
}

// Moves all nodes with the deformation gradient f.
inline void deform(HyperelasticSolid &solid, const Eigen::Matrix<double, 3, 3, Eigen::RowMajor> &f) {
  std::vector<Vector3> displacement;
  for (const Vector3 &x : solid.mesh().nodes) {
    const Eigen::Vector3d place = f * Eigen::Vector3d(x.x, x.y, x.z);
    displacement.push_back(Vector3{place[0], place[1], place[2]} - x);
  }
  solid.set_displacement(displacement);
}

// N, of the solid on its machine at the nodes of a tag.
inline Vector3 face_force(const HyperelasticSolid &solid, int tag) {
  Vector3 sum{};
  for (const int n : solid.nodes_of(tag))
    sum = sum + solid.internal_forces()[static_cast<std::size_t>(n)];
  return sum;
}

inline double end_area(const Eigen::Matrix<double, 3, 3, Eigen::RowMajor> &f) { // m^2
  return 0.03 * 0.03 * f(0, 0) * f(1, 1);
}

inline double largest_inner_force(const HyperelasticSolid &solid) {
  std::vector<char> outside(solid.mesh().nodes.size(), 0);
  for (const BoundaryFace &face : solid.mesh().faces)
    for (const int n : face.nodes)
      outside[static_cast<std::size_t>(n)] = 1;
  double most = 0;
  for (std::size_t n = 0; n < outside.size(); ++n)
    if (!outside[n]) most = std::max(most, norm(solid.internal_forces()[n]));
  return most;
}

} // namespace platen::fem
