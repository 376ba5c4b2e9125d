// The grid of a tube: rings of hexahedra.
#include <deal.II/grid/tria.h>

#include <cmath>
#include <stdexcept>
#include <string>

#include "base/pi.h"
#include "base/require.h"
#include "fem/grids.h"

namespace platen::fem {
Grid make_grid(const Tube &tube) {
  require(tube.inner_radius > 0, "tube grid: inner radius must be positive");
  require(tube.thickness > 0, "tube grid: thickness must be positive");
  require(tube.height > 0, "tube grid: height must be positive");
  require(tube.elements_around >= 3, "tube grid: at least 3 elements around");
  require(tube.elements_along >= 1, "tube grid: at least one element along the axis");
  require(tube.elements_through >= 1, "tube grid: at least one element through the wall");
  const int around = tube.elements_around, along = tube.elements_along, through = tube.elements_through;
  const auto number = [&](int k, int i, int j) { // height, angle, radius
    return static_cast<unsigned int>((k * around + i % around) * (through + 1) + j);
  };
  std::vector<dealii::Point<3>> points;
  for (int k = 0; k <= along; ++k)
    for (int i = 0; i < around; ++i)
      for (int j = 0; j <= through; ++j) {
        const double r = tube.inner_radius + tube.thickness * j / through, angle = 2 * pi * i / around;
        points.emplace_back(r * std::cos(angle), r * std::sin(angle), tube.z_low + tube.height * k / along);
      }
  std::vector<dealii::CellData<3>> cells;
  dealii::SubCellData sides;
  const auto add_side = [&](unsigned int a, unsigned int b, unsigned int c, unsigned int d, int tag) {
    dealii::CellData<2> face;
    face.vertices = {a, b, c, d};
    face.boundary_id = static_cast<dealii::types::boundary_id>(tag);
    sides.boundary_quads.push_back(face);
  };
  for (int k = 0; k < along; ++k)
    for (int i = 0; i < around; ++i) {
      for (int j = 0; j < through; ++j) { // x of the cell runs outwards, y around, z along
        dealii::CellData<3> cell;
        cell.vertices = {number(k, i, j),         number(k, i, j + 1),        number(k, i + 1, j),
                         number(k, i + 1, j + 1), number(k + 1, i, j),        number(k + 1, i, j + 1),
                         number(k + 1, i + 1, j), number(k + 1, i + 1, j + 1)};
        cells.push_back(cell);
        for (const int end : {0, along})
          if (k == (end > 0 ? end - 1 : 0))
            add_side(number(end, i, j), number(end, i, j + 1), number(end, i + 1, j),
                     number(end, i + 1, j + 1), end == 0 ? low_end_tag : high_end_tag);
      }
      for (const int j : {0, through})
        add_side(number(k, i, j), number(k, i + 1, j), number(k + 1, i, j), number(k + 1, i + 1, j),
                 j == 0 ? inner_tag : mantle_tag);
    }
  auto grid = std::make_shared<dealii::Triangulation<3>>();
  grid->create_triangulation(points, cells, sides);
  return grid;
}

} // namespace platen::fem
