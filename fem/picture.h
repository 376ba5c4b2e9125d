// A body as pictures show it: its elements with fields, as plain arrays. The program writes the files.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "base/vector3.h"
#include "fem/surface.h"

namespace platen::fem {

struct PictureField {
  std::string name;
  int components = 1; // 1: scalar, 3: vector, 9: tensor, row by row
  std::vector<double> values;
};

// Fields of points begin with the displacement (m), contact_shear (Pa), contact_pressure (Pa) and slip (m).
struct Picture {
  std::vector<Vector3> points;         // m, current
  int nodes_per_cell = 8;              // 27: of degree 2
  std::vector<int> cells;              // points of each hexahedron, in VTK's order
  std::vector<PictureField> of_points; // one row for each point
  std::vector<PictureField> of_cells;
};

template <class Rows> // vectors or tensors
PictureField picture_field(const char *name, const Rows &rows, int components) {
  PictureField field{name, components, {}};
  for (const auto &row : rows)
    for (std::size_t k = 0; k < static_cast<std::size_t>(components); ++k)
      field.values.push_back(row[k]);
  return field;
}

// A body that has nodes at `reference` (m), its elements' corners with x of an element fastest. `node`: of
// each vertex of its surface; tractions and slip are zero at other nodes. `slip`: one value per vertex, or
// empty. Throws std::invalid_argument, naming `who`, where it has another length.
Picture picture_of(const std::string &who, const LoadedSurface &body, const std::vector<int> &node,
                   const std::vector<double> &slip, const std::vector<Vector3> &reference,
                   const std::vector<Vector3> &displacement, const std::vector<std::array<int, 8>> &cells);

} // namespace platen::fem
