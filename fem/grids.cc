#include "fem/grids.h"
#include "base/pi.h"
#include "base/require.h"
#include "fem/threads.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_nothing.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_q.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/tria.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <string>

namespace platen::fem {
namespace {

// Square core of n x n cells, surrounded by `rings` rings of 4 n cells that blend from the square to the
// circle.
class DiscMesh {
public:
  DiscMesh(double radius, int across)
      : radius_(radius), rings_(std::max(1, across / 4)), n_(across - 2 * rings_) {
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
  // The core's sides bulge a little towards the circle, which keeps the corners of the first ring open.
  dealii::Point<2> core_point(int i, int j) const {
    const double share = static_cast<double>(n_) / (n_ + 2.0 * rings_), bulge = 0.15;
    const double a = 2.0 * i / n_ - 1.0, b = 2.0 * j / n_ - 1.0;
    const double s = radius_ * share;
    return {s * a * (1.0 - bulge * b * b), s * b * (1.0 - bulge * a * a)};
  }
  dealii::Point<2> ring_point(int ring, int k) const {
    const double t = static_cast<double>(ring) / rings_, angle = 2.0 * pi * k / (4.0 * n_) - 0.75 * pi;
    const dealii::Point<2> inner = points_[static_cast<std::size_t>(around(0, k))];
    const dealii::Point<2> outer(radius_ * std::cos(angle), radius_ * std::sin(angle));
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
  // Corners counter-clockwise; deal.II wants the last two swapped.
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
    cell->set_material_id(0); // the generator numbers octants
  return grid;
}

namespace {

bool touch(const BoxPlate &a, const BoxPlate &b) {
  for (std::size_t k = 0; k < 3; ++k)
    if (a.high[k] < b.low[k] || b.high[k] < a.low[k]) return false;
  return true;
}

// How far outside a box a point lies along the axis that says most, m; 0 inside.
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

Grid make_grid(const std::vector<BoxPlate> &boxes) {
  require(!boxes.empty(), "platen grid: there are no boxes");
  for (std::size_t k = 0; k < boxes.size(); ++k)
    for (std::size_t other = 0; other < k; ++other)
      require(!touch(boxes[k], boxes[other]), "platen grid: two boxes of one grid touch");
  std::vector<Grid> parts;
  std::vector<const dealii::Triangulation<3> *> all;
  for (const BoxPlate &box : boxes) {
    parts.push_back(make_grid(box));
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

namespace {

void check(const std::vector<Layer> &layers, double whole) {
  require(!layers.empty(), "platen grid: there are no layers");
  double sum = 0;
  for (const Layer &layer : layers) {
    require(layer.thickness > 0, "platen grid: the thickness of a layer must be positive");
    require(layer.elements >= 1, "platen grid: at least one element through a layer");
    sum += layer.thickness;
  }
  require(std::abs(sum - whole) <= 1e-9 * whole, "platen grid: the layers are " + std::to_string(sum) +
                                                     " m thick together, the plate " + std::to_string(whole) +
                                                     " m");
}

int elements_of(const std::vector<Layer> &layers) {
  int sum = 0;
  for (const Layer &layer : layers)
    sum += layer.elements;
  return sum;
}

// From even heights between low and high to those of the layers, by whole numbers: ends keep their bits.
void stretch(dealii::Triangulation<3> &grid, const std::vector<Layer> &layers, double low, double high) {
  std::vector<double> heights = {low};
  std::vector<unsigned int> material;
  double below = low;
  for (std::size_t k = 0; k < layers.size(); ++k) {
    for (int j = 1; j <= layers[k].elements; ++j) {
      heights.push_back(below + layers[k].thickness * j / layers[k].elements);
      material.push_back(static_cast<unsigned int>(k));
    }
    below = heights.back();
  }
  heights.back() = high;
  const double count = static_cast<double>(material.size());
  const auto level = [&](double z) { return (z - low) / (high - low) * count; };
  for (const auto &cell : grid.active_cell_iterators())
    cell->set_material_id(material[static_cast<std::size_t>(level(cell->center()[2]))]);
  const auto raise = [&](dealii::Point<3> p) {
    p[2] = heights[static_cast<std::size_t>(std::lround(level(p[2])))];
    return p;
  };
  dealii::GridTools::transform(raise, grid);
}

} // namespace

Grid make_grid(const CylinderPlate &plate, const std::vector<Layer> &layers) {
  check(layers, plate.thickness);
  CylinderPlate even = plate;
  even.elements_thick = elements_of(layers);
  Grid grid = make_grid(even);
  stretch(*grid, layers, plate.z_low, plate.z_low + plate.thickness);
  return grid;
}

Grid make_grid(const BoxPlate &plate, const std::vector<Layer> &layers) {
  check(layers, plate.high[2] - plate.low[2]);
  BoxPlate even = plate;
  even.elements[2] = elements_of(layers);
  Grid grid = make_grid(even);
  stretch(*grid, layers, plate.low[2], plate.high[2]);
  return grid;
}

Grid moved_grid(const Grid &grid, const std::function<Vector3(const Vector3 &)> &place) {
  auto moved = std::make_shared<dealii::Triangulation<3>>();
  moved->copy_triangulation(*grid);
  dealii::GridTools::transform(
      [&](const dealii::Point<3> &p) {
        const Vector3 q = place({p[0], p[1], p[2]});
        return dealii::Point<3>(q[0], q[1], q[2]);
      },
      *moved);
  return moved;
}

std::string inverted_cell(const Grid &grid) {
  for (const auto &cell : grid->active_cell_iterators())
    for (const unsigned int v : cell->vertex_indices()) {
      // Edges along the cell's three axes, of which bits of v tell the direction.
      std::array<dealii::Tensor<1, 3>, 3> edge;
      for (unsigned int k = 0; k < 3; ++k)
        edge[k] = (v >> k & 1U ? -1.0 : 1.0) * (cell->vertex(v ^ (1U << k)) - cell->vertex(v));
      if (dealii::cross_product_3d(edge[0], edge[1]) * edge[2] > 0) continue;
      const dealii::Point<3> p = cell->center();
      std::ostringstream name;
      name << "cell " << cell->active_cell_index() << " at (" << p[0] << ", " << p[1] << ", " << p[2]
           << ") m";
      return name.str();
    }
  return "";
}

GridSurface extract_surface(const Grid &grid) {
  GridSurface result;
  std::vector<int> surface_vertex(grid->n_vertices(), -1);
  std::vector<std::array<unsigned int, 4>> corners;
  for (const auto &cell : grid->active_cell_iterators())
    for (const unsigned int f : cell->face_indices()) {
      if (!cell->face(f)->at_boundary()) continue;
      const auto face = cell->face(f);
      std::array<unsigned int, 4> ring = {face->vertex_index(0), face->vertex_index(1), face->vertex_index(3),
                                          face->vertex_index(2)};
      const auto diagonals =
          dealii::cross_product_3d(face->vertex(3) - face->vertex(0), face->vertex(2) - face->vertex(1));
      if (diagonals * (face->center() - cell->center()) < 0) std::swap(ring[1], ring[3]);
      corners.push_back(ring);
      result.surface.face_tags.push_back(static_cast<int>(face->boundary_id()));
      for (const unsigned int v : ring)
        surface_vertex[v] = 0;
    }
  for (std::size_t v = 0; v < surface_vertex.size(); ++v) {
    if (surface_vertex[v] < 0) continue;
    surface_vertex[v] = static_cast<int>(result.grid_vertex.size());
    result.grid_vertex.push_back(static_cast<int>(v));
    const dealii::Point<3> &p = grid->get_vertices()[v];
    result.surface.vertices.push_back({p[0], p[1], p[2]});
  }
  for (const auto &ring : corners)
    result.surface.faces.push_back(
        {surface_vertex[ring[0]], surface_vertex[ring[1]], surface_vertex[ring[2]], surface_vertex[ring[3]]});
  result.surface.velocities.assign(result.surface.vertices.size(), Vector3{});
  return result;
}

VolumeMoments volume_moments(const Grid &grid) {
  // r_i r_j times the Jacobian of a trilinear map is of degree 4 along each axis: three Gauss points are
  // exact.
  const dealii::QGauss<3> quadrature(3);
  const dealii::FE_Nothing<3> element;
  const NoCellReuse same_for_any_threads;
  const dealii::MappingQ<3> mapping(1);
  dealii::FEValues<3> values(mapping, element, quadrature,
                             dealii::update_quadrature_points | dealii::update_JxW_values);
  VolumeMoments m;
  const auto integrate = [&](const auto &add) {
    for (const auto &cell : grid->active_cell_iterators()) {
      values.reinit(cell);
      for (const unsigned int q : values.quadrature_point_indices()) {
        const dealii::Point<3> &p = values.quadrature_point(q);
        add(Vector3{p[0], p[1], p[2]}, values.JxW(q));
      }
    }
  };
  integrate([&](const Vector3 &p, double weight) {
    m.volume += weight;
    m.centroid = m.centroid + weight * p;
  });
  m.centroid = (1.0 / m.volume) * m.centroid;
  integrate([&](const Vector3 &p, double weight) {
    const Vector3 r = p - m.centroid;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j)
        m.second[3 * i + j] += weight * r[i] * r[j];
  });
  return m;
}

} // namespace platen::fem
