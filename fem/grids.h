// Finite-element grids of platens, and what a body reads off them. deal.II stays in grids.cc.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "fem/surface_mesh.h"

namespace dealii {
template <int dim, int spacedim>
class Triangulation;
}

namespace platen::fem {

using Grid = std::shared_ptr<dealii::Triangulation<3, 3>>;

// Boundary ids of both kinds of plate, as SurfaceMesh::face_tags shows them. A box numbers its sides
// x-, x+, y-, y+ = 0 ... 3; the mantle of a cylinder is 0.
constexpr int low_end_tag = 4;  // face z = z_low
constexpr int high_end_tag = 5; // face z = z_low + thickness
constexpr int mantle_tag = 0;   // outer face of a tube
constexpr int inner_tag = 6;    // inner face of a tube

// A round plate: hexahedra in a square core with rings around it, all faces of both ends flat. The mantle is
// a polygon through points on the circle, so that the area is slightly below that of the circle (by 1 % at 12
// elements across).
struct CylinderPlate {
  double radius = 0;       // m
  double thickness = 0;    // m, along z
  double z_low = 0;        // m
  int elements_across = 8; // along a diameter, at least 3
  int elements_thick = 2;
};

// A plate between two corners, all hexahedra alike.
struct BoxPlate {
  Vector3 low{}, high{}; // m
  std::array<int, 3> elements{1, 1, 1};
};

// A tube about the z axis: a sleeve. Its nodes lie on circles, so its faces are chords: the inner face comes
// closer to the axis than its nodes by the share pi^2 / (2 n^2) of the radius at n elements around (.12 % at
// 64). Tags: inner_tag, mantle_tag, low_end_tag, high_end_tag.
struct Tube {
  double inner_radius = 0; // m, of the nodes
  double thickness = 0;    // m
  double z_low = 0;        // m
  double height = 0;       // m
  int elements_around = 48, elements_along = 24, elements_through = 1;
};

// All throw std::invalid_argument, naming the entry, where a size is not positive or a count too small.
Grid make_grid(const CylinderPlate &plate);
Grid make_grid(const BoxPlate &plate);
Grid make_grid(const Tube &tube);
// Boxes that do not touch, in one grid: strips of one rigid tool. Each has its own sides and ends by number.
// Throws std::invalid_argument as above, and where there are none or two touch.
Grid make_grid(const std::vector<BoxPlate> &boxes);

// A sheet of a layered plate; the first lies at the low end.
struct Layer {
  double thickness = 0; // m
  int elements = 1;     // through it
};
// Plates of several materials: cells of layer k have material id k. Layers take the place of the plate's
// elements along z; throws std::invalid_argument also where their thicknesses do not add up to the plate's.
Grid make_grid(const CylinderPlate &plate, const std::vector<Layer> &layers);
Grid make_grid(const BoxPlate &plate, const std::vector<Layer> &layers);

// The grid with its vertices moved: a dished or skew plate from a flat one. Tags and materials stay. Cells
// that this inverts are found by those who use them.
Grid moved_grid(const Grid &grid, const std::function<Vector3(const Vector3 &)> &place);

// Names the first cell that is inverted or warped through itself at a corner, with its number from 0 and the
// place of its middle; empty where there is none.
std::string inverted_cell(const Grid &grid);

// The boundary of a grid as a surface of quadrilaterals.
struct GridSurface {
  SurfaceMesh surface;          // velocities zero
  std::vector<int> grid_vertex; // vertex index in the grid, one per surface vertex, ascending
};
GridSurface extract_surface(const Grid &grid);

// Integrals over the volume of a grid, exact for its trilinear cells.
struct VolumeMoments {
  double volume = 0;  // m^3
  Vector3 centroid{}; // m
  Matrix3 second{};   // m^5, integral of r_i r_j about the centroid, row by row
};
VolumeMoments volume_moments(const Grid &grid);

} // namespace platen::fem
