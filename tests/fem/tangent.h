// The tangent of a HyperelasticSolid, for tests.
#pragma once

#include <Eigen/Sparse>

#include <array>
#include <cstddef>
#include <vector>

#include "fem/hyperelastic_solid.h"

namespace platen::fem {

using Tangent = Eigen::SparseMatrix<double>;

// Derivative of (internal - pressure) forces by displacements, three rows and columns per node.
inline Tangent tangent_of(const HyperelasticSolid &solid) {
  const SolidMesh &mesh = solid.mesh();
  std::vector<Eigen::Triplet<double>> entries;
  const auto add = [&](const auto &nodes, const auto &part, double factor) {
    const std::size_t size = 3 * nodes.size();
    const auto row = [&](std::size_t m) { return 3 * nodes[m / 3] + static_cast<int>(m % 3); };
    for (std::size_t m = 0; m < size; ++m)
      for (std::size_t n = 0; n < size; ++n)
        entries.emplace_back(row(m), row(n), factor * part[size * m + n]);
  };
  for (std::size_t c = 0; c < mesh.cells.size(); ++c)
    add(mesh.cell_nodes[c],
        cell_stiffness(solid.material().law, mesh.cells[c], mesh.gather(c, solid.displacement())), 1);
  for (const BoundaryFace &face : mesh.faces) {
    FaceCorners place;
    for (std::size_t k = 0; k < 4; ++k)
      place[k] = solid.node_place(face.nodes[k]);
    add(face.nodes, corner_area_gradient(place), solid.pressure(face.tag));
  }
  const auto size = static_cast<Eigen::Index>(3 * mesh.nodes.size());
  Tangent tangent(size, size);
  tangent.setFromTriplets(entries.begin(), entries.end());
  return tangent;
}

// One entry per component of each node.
inline Eigen::VectorXd as_column(const std::vector<Vector3> &field) {
  Eigen::VectorXd column(static_cast<Eigen::Index>(3 * field.size()));
  for (std::size_t m = 0; m < 3 * field.size(); ++m)
    column[static_cast<Eigen::Index>(m)] = field[m / 3][m % 3];
  return column;
}

} // namespace platen::fem
