// The tangent of a HyperelasticSolid, for tests.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "fem/hyperelastic_solid.h"

namespace platen::fem {

// Derivative of (internal - pressure) forces times a vector, one per node.
inline std::vector<Vector3> stiffness_times(const HyperelasticSolid &solid,
                                            const std::vector<Vector3> &direction) {
  const SolidMesh &mesh = solid.mesh();
  const auto index = [](int k) { return static_cast<std::size_t>(k); };
  std::vector<Vector3> result(direction.size(), Vector3{});
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    const CellStiffness k =
        cell_stiffness(solid.material().law, mesh.cells[c], mesh.gather(c, solid.displacement()));
    const Corners own = mesh.gather(c, direction);
    for (std::size_t m = 0; m < 24; ++m)
      for (std::size_t n = 0; n < 24; ++n)
        result[index(mesh.cell_nodes[c][m / 3])][m % 3] += k[24 * m + n] * own[n / 3][n % 3];
  }
  for (const BoundaryFace &face : mesh.faces) {
    FaceCorners place, own;
    for (std::size_t k = 0; k < 4; ++k)
      place[k] = solid.node_place(face.nodes[k]), own[k] = direction[index(face.nodes[k])];
    const std::array<double, 144> gradient = corner_area_gradient(place);
    for (std::size_t m = 0; m < 12; ++m)
      for (std::size_t n = 0; n < 12; ++n)
        result[index(face.nodes[m / 3])][m % 3] +=
            solid.pressure(face.tag) * gradient[12 * m + n] * own[n / 3][n % 3];
  }
  return result;
}

} // namespace platen::fem
