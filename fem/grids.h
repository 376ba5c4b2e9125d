// Finite-element grids of platens and sleeves as plain arrays, and the data that a body reads from them. A
// body that deforms has deal.II number them (fem/triangulation.h); a rigid one does not need it.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "fem/surface.h"

namespace platen::fem {

// A face of the boundary.
struct BoundaryFace {
  std::array<int, 4> nodes;   // vertices of the grid, counter-clockwise seen from outside
  int tag;                    // boundary id
  int cell;                   // to which it belongs
  std::array<int, 4> corners; // of that cell
};

struct Hexahedra {
  std::vector<Vector3> vertices;         // m
  std::vector<std::array<int, 8>> cells; // vertices: x of the cell runs fastest, then y, then z
  std::vector<int> material;             // id of each cell
  std::vector<BoundaryFace> faces;       // of the boundary: in the order of cells, of each x-, x+ ... z+
};
using Grid = std::shared_ptr<const Hexahedra>;

// Boundary ids of both kinds of plate, as in SurfaceMesh::face_tags. A box numbers its sides x-, x+, y-, y+ =
// 0 ... 3; the mantle of a cylinder is 0.
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

// A plate between two corners; all hexahedra are equal.
struct BoxPlate {
  Vector3 low{}, high{}; // m
  std::array<int, 3> elements{1, 1, 1};
};

// A tube about the z axis: a sleeve. Its nodes lie on circles, so its faces are chords: the inner face comes
// closer to the axis than its nodes by the fraction pi^2 / (2 n^2) of the radius at n elements around (.12 %
// at 64). Tags: inner_tag, mantle_tag, low_end_tag, high_end_tag.
struct Tube {
  double inner_radius = 0; // m, of the nodes
  double thickness = 0;    // m
  double z_low = 0;        // m
  double height = 0;       // m
  int elements_around = 48, elements_along = 24, elements_through = 1;
};

// Number of cells of a round plate, without building it.
double cells_in(const CylinderPlate &plate);

// All throw std::invalid_argument, naming the entry, where a size is not positive or a count too small.
Grid make_grid(const CylinderPlate &plate);
Grid make_grid(const BoxPlate &plate);
Grid make_grid(const Tube &tube);
// Boxes that do not touch, in one grid: strips of one rigid tool. Each box has the same tags as a single one.
// Throws std::invalid_argument as above, and where there are no boxes or two touch.
Grid make_grid(const std::vector<BoxPlate> &boxes);

// A layer of a layered plate; the first lies at the low end.
struct Layer {
  double thickness = 0; // m
  int elements = 1;     // through it
};
// Plates of several materials: cells of layer k have material id k. Layers replace the plate's elements along
// z; throws std::invalid_argument also where their thicknesses do not add up to the plate's.
Grid make_grid(const CylinderPlate &plate, const std::vector<Layer> &layers);
Grid make_grid(const BoxPlate &plate, const std::vector<Layer> &layers);
Grid make_grid(const std::vector<BoxPlate> &boxes, const std::vector<Layer> &layers); // same layers in all

// The grid with its vertices moved: a dished or skew plate from a flat one. Tags and materials do not change.
// The users of the grid check for inverted cells.
Grid moved_grid(const Grid &grid, const std::function<Vector3(const Vector3 &)> &place);

// Names the first cell that is inverted or warped through itself at a corner, with its number from 0 and the
// position of its middle; empty where there is none.
std::string inverted_cell(const Grid &grid);

// The faces of a grid that belong to one cell alone, with tag 0. Their corners are counter-clockwise seen
// from outside where the cell is not inverted.
std::vector<BoundaryFace> boundary_faces(const std::vector<std::array<int, 8>> &cells);

// The boundary of a grid as a surface of quadrilaterals: the faces of some tags, or all of them where `tags`
// is empty. Nodes are the vertices of the grid.
NodeSurface extract_surface(const Grid &grid, const std::vector<int> &tags = {});

// Integrals over the volume of a grid, exact for its trilinear cells.
struct VolumeMoments {
  double volume = 0;  // m^3
  Vector3 centroid{}; // m
  Matrix3 second{};   // m^5, integral of r_i r_j about the centroid, row by row
};
VolumeMoments volume_moments(const Grid &grid);

// An external grid as a platen: placed against the specimen, with its ends tagged.
//
// Shifts the grid along z so that its extreme plane on the specimen's side, the highest of a platen that
// faces up and the lowest of one that faces down, lies at z = `plane` (m); x and y do not change. Tags are
// rebuilt as low_end_tag and high_end_tag: at the machine's end, faces in the extreme plane; on the
// specimen's side, faces in the extreme plane, or, where none lies there (a convex platen), all whose normals
// are within 60 degrees of the axis. Every other face gets mantle_tag. Throws std::invalid_argument where no
// face lies in the plane of the machine's end.
Grid laid_platen(const Grid &grid, bool faces_up, double plane);

// Number of materials of a grid; material ids count from 0.
int materials_of(const Grid &grid);

} // namespace platen::fem
