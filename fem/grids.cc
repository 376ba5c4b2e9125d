#include "fem/grids.h"

#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/tria.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/pi.h"
#include "base/portable.h"
#include "base/require.h"

namespace platen::fem {
namespace {

// Number of rings around the core of a disc with `across` cells across.
int rings_of(int across) {
  return std::max(1, across / 4);
}

// Square core of n x n cells, surrounded by `rings` rings of 4 n cells that blend from the square to the
// circle.
class DiscMesh {
public:
  DiscMesh(double radius, int across) : radius_(radius), rings_(rings_of(across)), n_(across - 2 * rings_) {
    for (int j = 0; j <= n_; ++j)
      for (int i = 0; i <= n_; ++i)
        points_.push_back(core_point(i, j));
    for (int ring = 1; ring <= rings_; ++ring)
      for (int k = 0; k < 4 * n_; ++k)
        points_.push_back(ring_point(ring, k));
    for (int j = 0; j < n_; ++j)
      for (int i = 0; i < n_; ++i)
        add_cell(core(i, j), core(i + 1, j), core(i + 1, j + 1), core(i, j + 1));
    for (int ring = 0; ring < rings_; ++ring)
      for (int k = 0; k < 4 * n_; ++k)
        add_cell(around(ring, k), around(ring + 1, k), around(ring + 1, k + 1), around(ring, k + 1));
  }
  void create(dealii::Triangulation<2> &disc) const {
    disc.create_triangulation(points_, cells_, dealii::SubCellData());
  }

private:
  // The core's sides bulge a little towards the circle, so that the corners of the first ring stay wide.
  dealii::Point<2> core_point(int i, int j) const {
    const double share = static_cast<double>(n_) / (n_ + 2.0 * rings_), bulge = 0.15;
    const double a = 2.0 * i / n_ - 1.0, b = 2.0 * j / n_ - 1.0;
    const double s = radius_ * share;
    return {s * a * (1.0 - bulge * b * b), s * b * (1.0 - bulge * a * a)};
  }
  dealii::Point<2> ring_point(int ring, int k) const {
    const double t = static_cast<double>(ring) / rings_, angle = 2.0 * pi * k / (4.0 * n_) - 0.75 * pi;
    const dealii::Point<2> inner = points_[static_cast<std::size_t>(around(0, k))];
    const dealii::Point<2> outer(radius_ * portable::cos(angle), radius_ * portable::sin(angle));
    return dealii::Point<2>((1.0 - t) * inner + t * outer);
  }
  int core(int i, int j) const { return j * (n_ + 1) + i; }
  // Vertex k of a ring, counter-clockwise from the corner (-, -); ring 0 is the rim of the core.
  int around(int ring, int k) const {
    k %= 4 * n_;
    if (ring > 0) return (n_ + 1) * (n_ + 1) + (ring - 1) * 4 * n_ + k;
    const int side = k / n_, along = k % n_;
    if (side == 0) return core(along, 0);
    if (side == 1) return core(n_, along);
    if (side == 2) return core(n_ - along, n_);
    return core(0, n_ - along);
  }
  // Corners counter-clockwise; deal.II expects the last two swapped.
  void add_cell(int a, int b, int c, int d) {
    dealii::CellData<2> cell;
    cell.vertices = {static_cast<unsigned int>(a), static_cast<unsigned int>(b), static_cast<unsigned int>(d),
                     static_cast<unsigned int>(c)};
    cells_.push_back(cell);
  }

  double radius_;
  int rings_, n_;
  std::vector<dealii::Point<2>> points_;
  std::vector<dealii::CellData<2>> cells_;
};

void tag_ends(dealii::Triangulation<3> &grid, double z_low, double thickness) {
  for (const auto &face : grid.active_face_iterators()) {
    if (!face->at_boundary()) continue;
    const double height = (face->center()[2] - z_low) / thickness;
    face->set_boundary_id(height < 1e-6 ? low_end_tag : (height > 1.0 - 1e-6 ? high_end_tag : 0));
  }
}

} // namespace

double cells_in(const CylinderPlate &plate) {
  const double rings = rings_of(plate.elements_across), core = plate.elements_across - 2 * rings;
  return (core * core + 4 * core * rings) * plate.elements_thick;
}

Grid make_grid(const CylinderPlate &plate) {
  require(plate.radius > 0, "platen grid: radius must be positive");
  require(plate.thickness > 0, "platen grid: thickness must be positive");
  require(plate.elements_across >= 3, "platen grid: a round plate needs at least 3 elements across");
  require(plate.elements_thick >= 1, "platen grid: at least one element through the thickness");
  dealii::Triangulation<2> disc;
  DiscMesh(plate.radius, plate.elements_across).create(disc);
  auto grid = std::make_shared<dealii::Triangulation<3>>();
  dealii::GridGenerator::extrude_triangulation(disc, static_cast<unsigned int>(plate.elements_thick) + 1,
                                               plate.thickness, *grid);
  // Heights from whole numbers of layers: every vertex of an end gets the same number, so the end is flat.
  const double layers = plate.elements_thick;
  const auto raise = [&](dealii::Point<3> p) {
    p[2] = plate.z_low + plate.thickness * (std::round(p[2] / plate.thickness * layers) / layers);
    return p;
  };
  dealii::GridTools::transform(raise, *grid);
  tag_ends(*grid, plate.z_low, plate.thickness);
  return grid;
}

Grid make_grid(const BoxPlate &plate) {
  for (std::size_t k = 0; k < 3; ++k) {
    require(plate.high[k] > plate.low[k],
            "platen grid: the high corner of a box must lie above its low corner");
    require(plate.elements[k] >= 1, "platen grid: at least one element along each side of a box");
  }
  const auto count = [&](std::size_t k) { return static_cast<unsigned int>(plate.elements[k]); };
  auto grid = std::make_shared<dealii::Triangulation<3>>();
  dealii::GridGenerator::subdivided_hyper_rectangle(
      *grid, {count(0), count(1), count(2)}, dealii::Point<3>(plate.low[0], plate.low[1], plate.low[2]),
      dealii::Point<3>(plate.high[0], plate.high[1], plate.high[2]), true);
  for (const auto &cell : grid->active_cell_iterators())
    cell->set_material_id(0); // the generator sets ids by octant
  return grid;
}

namespace {

bool touch(const BoxPlate &a, const BoxPlate &b) {
  for (std::size_t k = 0; k < 3; ++k)
    if (a.high[k] < b.low[k] || b.high[k] < a.low[k]) return false;
  return true;
}

// Largest distance of a point outside a box along an axis, m; 0 inside.
double outside(const BoxPlate &box, const dealii::Point<3> &p) {
  double most = 0;
  for (unsigned int k = 0; k < 3; ++k)
    most = std::max({most, box.low[k] - p[k], p[k] - box.high[k]});
  return most;
}

// The side of a box that a face of its grid lies in, numbered as BoxPlate's are.
unsigned int side_of(const BoxPlate &box, const dealii::Point<3> &middle) {
  unsigned int nearest = 0;
  double least = std::numeric_limits<double>::infinity();
  for (unsigned int side = 0; side < 6; ++side) {
    const std::size_t k = side / 2;
    const double distance = std::abs(middle[side / 2] - (side % 2 == 0 ? box.low[k] : box.high[k]));
    if (distance < least) least = distance, nearest = side;
  }
  return nearest;
}

} // namespace

namespace {

// Makes boxes one by one and merges them; merging keeps materials but not the tags of the sides.
Grid merged(const std::vector<BoxPlate> &boxes, const std::function<Grid(const BoxPlate &)> &make) {
  require(!boxes.empty(), "platen grid: there are no boxes");
  for (std::size_t k = 0; k < boxes.size(); ++k)
    for (std::size_t other = 0; other < k; ++other)
      require(!touch(boxes[k], boxes[other]), "platen grid: two boxes of one grid touch");
  std::vector<Grid> parts;
  std::vector<const dealii::Triangulation<3> *> all;
  for (const BoxPlate &box : boxes) {
    parts.push_back(make(box));
    all.push_back(parts.back().get());
  }
  auto grid = std::make_shared<dealii::Triangulation<3>>();
  dealii::GridGenerator::merge_triangulations(all, *grid, 0.0);
  for (const auto &face : grid->active_face_iterators()) {
    if (!face->at_boundary()) continue;
    const dealii::Point<3> middle = face->center();
    const auto nearer = [&](const BoxPlate &a, const BoxPlate &b) {
      return outside(a, middle) < outside(b, middle);
    };
    face->set_boundary_id(side_of(*std::min_element(boxes.begin(), boxes.end(), nearer), middle));
  }
  return grid;
}

} // namespace

Grid make_grid(const std::vector<BoxPlate> &boxes) {
  return merged(boxes, [](const BoxPlate &box) { return make_grid(box); });
}

Grid make_grid(const std::vector<BoxPlate> &boxes, const std::vector<Layer> &layers) {
  return merged(boxes, [&](const BoxPlate &box) { return make_grid(box, layers); });
}

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
        points.emplace_back(r * portable::cos(angle), r * portable::sin(angle),
                            tube.z_low + tube.height * k / along);
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
