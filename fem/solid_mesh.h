// A grid with what loops over its cells need, integrated by deal.II once, at the start.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "fem/grids.h"
#include "fem/hyperelastic_cell.h"

namespace platen::fem {

// Nodes are the vertices of the grid, with its numbers.
struct SolidMesh {
  std::vector<Vector3> nodes; // m, reference positions
  std::vector<ReferenceCell> cells;
  std::vector<std::array<int, 8>> cell_nodes; // x fastest
  std::vector<double> node_volume;            // m^3, integral of each shape function
  std::vector<BoundaryFace> faces;
  // Corners that meet at node n: [first_corner[n], first_corner[n + 1]) of `corner`, each 8 cell + corner,
  // ascending.
  std::vector<std::size_t> first_corner, corner;

  Corners gather(std::size_t cell, const std::vector<Vector3> &values) const {
    Corners own;
    for (std::size_t a = 0; a < 8; ++a)
      own[a] = values[static_cast<std::size_t>(cell_nodes[cell][a])];
    return own;
  }
  // Nodes on faces of a tag, ascending.
  std::vector<int> nodes_of(int tag) const;
};

// Throws std::invalid_argument where a cell is folded (naming it) or a node belongs to no cell.
SolidMesh read_mesh(const Grid &grid);

} // namespace platen::fem
