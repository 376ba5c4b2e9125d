// Grids of plates and tubes.
#include "fem/grids.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "base/pi.h"
#include "base/portable.h"
#include "base/require.h"

namespace platen::fem {
namespace {

// Boundary ids of the sides x-, x+ ... z+ of the cells of one grid.
using SideTags = std::array<int, 6>;
constexpr SideTags box_tags{0, 1, 2, 3, low_end_tag, high_end_tag},
    disc_tags{mantle_tag, mantle_tag, mantle_tag, mantle_tag, low_end_tag, high_end_tag},
    tube_tags{inner_tag, mantle_tag, mantle_tag, mantle_tag, low_end_tag, high_end_tag};

// Corners of each side of a cell, counter-clockwise seen from outside.
constexpr std::array<std::array<int, 4>, 6> sides{
    {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};

Grid finished(Hexahedra grid, const SideTags &tags) {
  grid.material.assign(grid.cells.size(), 0);
  grid.faces = boundary_faces(grid.cells);
  for (BoundaryFace &face : grid.faces)
    face.tag =
        tags[static_cast<std::size_t>(std::find(sides.begin(), sides.end(), face.corners) - sides.begin())];
  return std::make_shared<const Hexahedra>(std::move(grid));
}

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
        cells_.push_back({core(i, j), core(i + 1, j), core(i, j + 1), core(i + 1, j + 1)});
    for (int ring = 0; ring < rings_; ++ring)
      for (int k = 0; k < 4 * n_; ++k)
        cells_.push_back(
            {around(ring, k), around(ring + 1, k), around(ring, k + 1), around(ring + 1, k + 1)});
  }

  // Layers of it, from z_low; heights come from whole numbers of layers, so that the ends are flat to the
  // last bit.
  Hexahedra raised(double z_low, double thickness, int layers) const {
    Hexahedra grid;
    for (int k = 0; k <= layers; ++k)
      for (const Vector3 &p : points_)
        grid.vertices.push_back({p.x, p.y, z_low + thickness * (static_cast<double>(k) / layers)});
    const int level = static_cast<int>(points_.size());
    for (const std::array<int, 4> &flat : cells_)
      for (int k = 0; k < layers; ++k) {
        std::array<int, 8> &cell = grid.cells.emplace_back();
        for (std::size_t v = 0; v < 8; ++v)
          cell[v] = flat[v % 4] + (k + static_cast<int>(v / 4)) * level;
      }
    return grid;
  }

private:
  // The core's sides bulge a little towards the circle, so that the corners of the first ring stay wide.
  Vector3 core_point(int i, int j) const {
    const double core_fraction = static_cast<double>(n_) / (n_ + 2.0 * rings_), bulge = 0.15;
    const double a = 2.0 * i / n_ - 1.0, b = 2.0 * j / n_ - 1.0;
    const double s = radius_ * core_fraction;
    return {s * a * (1.0 - bulge * b * b), s * b * (1.0 - bulge * a * a), 0};
  }
  Vector3 ring_point(int ring, int k) const {
    const double t = static_cast<double>(ring) / rings_, angle = 2.0 * pi * k / (4.0 * n_) - 0.75 * pi;
    const Vector3 inner = points_[static_cast<std::size_t>(around(0, k))],
                  outer{radius_ * portable::cos(angle), radius_ * portable::sin(angle), 0};
    return (1.0 - t) * inner + t * outer;
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

  double radius_;
  int rings_, n_;
  std::vector<Vector3> points_;
  std::vector<std::array<int, 4>> cells_; // x of the cell runs fastest
};

// Cells of a block of vertices, numbered as number(i, j, k) along x, y, z of the cells.
template <class Number>
void add_cells(Hexahedra &grid, const std::array<int, 3> &count, const Number &number) {
  for (int k = 0; k < count[2]; ++k)
    for (int j = 0; j < count[1]; ++j)
      for (int i = 0; i < count[0]; ++i) {
        std::array<int, 8> &cell = grid.cells.emplace_back();
        for (int v = 0; v < 8; ++v)
          cell[static_cast<std::size_t>(v)] = number(i + v % 2, j + v / 2 % 2, k + v / 4);
      }
}

bool touch(const BoxPlate &a, const BoxPlate &b) {
  for (std::size_t k = 0; k < 3; ++k)
    if (a.high[k] < b.low[k] || b.high[k] < a.low[k]) return false;
  return true;
}

// Makes boxes one by one, with their cells and vertices one after the other.
template <class Make>
Grid merged(const std::vector<BoxPlate> &boxes, const Make &make) {
  require(!boxes.empty(), "platen grid: there are no boxes");
  for (std::size_t k = 0; k < boxes.size(); ++k)
    for (std::size_t other = 0; other < k; ++other)
      require(!touch(boxes[k], boxes[other]), "platen grid: two boxes of one grid touch");
  Hexahedra all;
  for (const BoxPlate &box : boxes) {
    const Grid one = make(box);
    const int vertices = static_cast<int>(all.vertices.size()), cells = static_cast<int>(all.cells.size());
    all.vertices.insert(all.vertices.end(), one->vertices.begin(), one->vertices.end());
    all.material.insert(all.material.end(), one->material.begin(), one->material.end());
    for (std::array<int, 8> cell : one->cells) {
      for (int &v : cell)
        v += vertices;
      all.cells.push_back(cell);
    }
    for (BoundaryFace face : one->faces) {
      for (int &v : face.nodes)
        v += vertices;
      face.cell += cells;
      all.faces.push_back(face);
    }
  }
  return std::make_shared<const Hexahedra>(std::move(all));
}

} // namespace

std::vector<BoundaryFace> boundary_faces(const std::vector<std::array<int, 8>> &cells) {
  std::vector<std::pair<std::array<int, 4>, std::size_t>> keys; // sorted nodes of a face, its number
  keys.reserve(6 * cells.size());
  for (std::size_t c = 0; c < cells.size(); ++c)
    for (std::size_t f = 0; f < 6; ++f) {
      std::array<int, 4> nodes;
      for (std::size_t k = 0; k < 4; ++k)
        nodes[k] = cells[c][static_cast<std::size_t>(sides[f][k])];
      std::sort(nodes.begin(), nodes.end());
      keys.emplace_back(nodes, 6 * c + f);
    }
  std::sort(keys.begin(), keys.end());
  std::vector<std::size_t> outer;
  for (std::size_t k = 0; k < keys.size(); ++k) {
    const bool as_before = k > 0 && keys[k - 1].first == keys[k].first,
               as_next = k + 1 < keys.size() && keys[k + 1].first == keys[k].first;
    if (!as_before && !as_next) outer.push_back(keys[k].second);
  }
  std::sort(outer.begin(), outer.end());
  std::vector<BoundaryFace> faces;
  for (const std::size_t number : outer) {
    const std::size_t c = number / 6;
    BoundaryFace face{{}, 0, static_cast<int>(c), sides[number % 6]};
    for (std::size_t k = 0; k < 4; ++k)
      face.nodes[k] = cells[c][static_cast<std::size_t>(face.corners[k])];
    faces.push_back(face);
  }
  return faces;
}

double cells_in(const CylinderPlate &plate) {
  const double rings = rings_of(plate.elements_across), core = plate.elements_across - 2 * rings;
  return (core * core + 4 * core * rings) * plate.elements_thick;
}

Grid make_grid(const CylinderPlate &plate) {
  require(plate.radius > 0, "platen grid: radius must be positive");
  require(plate.thickness > 0, "platen grid: thickness must be positive");
  require(plate.elements_across >= 3, "platen grid: a round plate needs at least 3 elements across");
  require(plate.elements_thick >= 1, "platen grid: at least one element through the thickness");
  const DiscMesh disc(plate.radius, plate.elements_across);
  return finished(disc.raised(plate.z_low, plate.thickness, plate.elements_thick), disc_tags);
}

Grid make_grid(const BoxPlate &plate) {
  for (std::size_t k = 0; k < 3; ++k) {
    require(plate.high[k] > plate.low[k],
            "platen grid: the high corner of a box must lie above its low corner");
    require(plate.elements[k] >= 1, "platen grid: at least one element along each side of a box");
  }
  const std::array<int, 3> &n = plate.elements;
  const auto at = [&](std::size_t k, int i) {
    return plate.low[k] + i * ((plate.high[k] - plate.low[k]) / n[k]);
  };
  Hexahedra grid;
  for (int k = 0; k <= n[2]; ++k)
    for (int j = 0; j <= n[1]; ++j)
      for (int i = 0; i <= n[0]; ++i)
        grid.vertices.push_back({at(0, i), at(1, j), at(2, k)});
  add_cells(grid, n, [&](int i, int j, int k) { return (k * (n[1] + 1) + j) * (n[0] + 1) + i; });
  return finished(std::move(grid), box_tags);
}

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
  Hexahedra grid;
  for (int k = 0; k <= along; ++k)
    for (int i = 0; i < around; ++i)
      for (int j = 0; j <= through; ++j) {
        const double r = tube.inner_radius + tube.thickness * j / through, angle = 2 * pi * i / around;
        grid.vertices.push_back(
            {r * portable::cos(angle), r * portable::sin(angle), tube.z_low + tube.height * k / along});
      }
  // x of a cell runs outwards, y around, z along.
  add_cells(grid, {through, around, along},
            [&](int j, int i, int k) { return (k * around + i % around) * (through + 1) + j; });
  return finished(std::move(grid), tube_tags);
}

} // namespace platen::fem
