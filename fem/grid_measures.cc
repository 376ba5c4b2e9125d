// Grids made from others (layered, moved, placed against a specimen), and measures of a grid.
#include <deal.II/base/multithread_info.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_nothing.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_q.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/tria.h>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <sstream>
#include <stdexcept>
#include <string>

#include "base/require.h"
#include "fem/grids.h"

namespace platen::fem {
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

// Moves uniform heights between low and high to those of the layers, by integers: ends keep their bits.
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

constexpr double in_plane = 1e-6;     // of the height, for rounded coordinates
constexpr double looking_share = 0.5; // axial component of a unit normal: 60 degrees

template <class Face>
bool lies_at(const Face &face, double z, double near) {
  for (const unsigned int v : face->vertex_indices())
    if (std::abs(face->vertex(v)[2] - z) > near) return false;
  return true;
}

// The z component of the outward unit normal.
template <class Face>
double looks_along_z(const Face &face, const dealii::Point<3> &inside) {
  const auto normal =
      dealii::cross_product_3d(face->vertex(3) - face->vertex(0), face->vertex(2) - face->vertex(1));
  const double size = normal.norm(), side = normal * (face->center() - inside) > 0 ? 1 : -1;
  return size > 0 ? side * normal[2] / size : 0.0;
}

// Several threads may create bodies at once.
void count(int more) {
  static std::mutex mutex;
  static int alive = 0;
  const std::lock_guard<std::mutex> lock(mutex);
  const int before = alive;
  alive += more;
  if (before == 0 || alive == 0) dealii::MultithreadInfo::set_thread_limit(alive == 0 ? 1 : 2);
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

NoCellReuse::NoCellReuse() {
  count(1);
}

NoCellReuse::~NoCellReuse() {
  count(-1);
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
      // Edges along the cell's three axes; the bits of v give the direction.
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

std::vector<BoundaryFace> boundary_faces(const Grid &grid) {
  std::vector<BoundaryFace> faces;
  for (const auto &cell : grid->active_cell_iterators())
    for (const unsigned int f : cell->face_indices()) {
      const auto face = cell->face(f);
      if (!face->at_boundary()) continue;
      std::array<unsigned int, 4> ring = {0, 1, 3, 2};
      const auto diagonals =
          dealii::cross_product_3d(face->vertex(3) - face->vertex(0), face->vertex(2) - face->vertex(1));
      if (diagonals * (face->center() - cell->center()) < 0) std::swap(ring[1], ring[3]);
      BoundaryFace &own = faces.emplace_back();
      own.tag = static_cast<int>(face->boundary_id());
      own.cell = static_cast<int>(cell->active_cell_index());
      for (std::size_t k = 0; k < 4; ++k) {
        own.nodes[k] = static_cast<int>(face->vertex_index(ring[k]));
        for (const unsigned int corner : cell->vertex_indices())
          if (cell->vertex_index(corner) == face->vertex_index(ring[k]))
            own.corners[k] = static_cast<int>(corner);
      }
    }
  return faces;
}

NodeSurface extract_surface(const Grid &grid, const std::vector<int> &tags) {
  SurfaceMesh all;
  for (const dealii::Point<3> &p : grid->get_vertices())
    all.vertices.push_back({p[0], p[1], p[2]});
  for (const BoundaryFace &face : boundary_faces(grid)) {
    if (!tags.empty() && std::find(tags.begin(), tags.end(), face.tag) == tags.end()) continue;
    all.faces.push_back(face.nodes);
    all.face_tags.push_back(face.tag);
  }
  return node_surface(all);
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

Grid laid_platen(const Grid &grid, bool faces_up, double plane) {
  const auto box = dealii::GridTools::compute_bounding_box(*grid).get_boundary_points();
  const double low = box.first[2], high = box.second[2];
  const double shift = plane - (faces_up ? high : low), near = in_plane * (high - low);
  const double fixed = (faces_up ? low : high) + shift;
  const Grid laid = moved_grid(grid, [&](const Vector3 &p) {
    const bool extreme = std::abs(p[2] + shift - plane) <= near; // a flat end is flat to the last bit
    return Vector3{p[0], p[1], extreme ? plane : p[2] + shift};
  });
  const int near_tag = faces_up ? high_end_tag : low_end_tag, far_tag = faces_up ? low_end_tag : high_end_tag;
  int flat = 0, clamped = 0;
  const auto tag_faces = [&](const auto &tag_of) {
    for (const auto &cell : laid->active_cell_iterators())
      for (const unsigned int f : cell->face_indices()) {
        const auto face = cell->face(f);
        if (face->at_boundary())
          face->set_boundary_id(static_cast<dealii::types::boundary_id>(tag_of(face, cell->center())));
      }
  };
  tag_faces([&](const auto &face, const dealii::Point<3> &) {
    const bool at_near = lies_at(face, plane, near), at_far = lies_at(face, fixed, near);
    flat += at_near, clamped += at_far;
    return at_near ? near_tag : at_far ? far_tag : mantle_tag;
  });
  if (clamped == 0)
    throw std::invalid_argument(std::string("has no face in the plane of its ") +
                                (faces_up ? "lowest" : "highest") +
                                " point: the machine has nothing to hold");
  if (flat > 0) return laid;
  tag_faces([&](const auto &face, const dealii::Point<3> &inside) {
    if (static_cast<int>(face->boundary_id()) == far_tag) return far_tag;
    return (faces_up ? 1 : -1) * looks_along_z(face, inside) > looking_share ? near_tag : mantle_tag;
  });
  return laid;
}

int materials_of(const Grid &grid) {
  int most = 0;
  for (const auto &cell : grid->active_cell_iterators())
    most = std::max(most, static_cast<int>(cell->material_id()));
  return most + 1;
}

} // namespace platen::fem
