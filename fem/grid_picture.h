// A grid with fields on its vertices as VTU: what bodies of linear cells have in common to show.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "fem/grids.h"

namespace platen::fem {

struct VertexField {
  std::string name;
  std::size_t parts = 1;      // 1: scalar, 3: vector, 9: tensor, row by row
  std::vector<double> values; // `parts` for each vertex of the grid
};

struct CellField {
  std::string name;
  std::vector<double> values; // one per cell
};

// Binary, zlib; the same fields give the same file. The first of `fields` is the displacement (m): vertices
// are drawn where it takes them.
void write_picture(std::ostream &stream, const Grid &grid, const std::vector<VertexField> &fields,
                   const std::vector<CellField> &cells = {});

} // namespace platen::fem
