// Grids made from others (layered, moved, placed against a specimen), and measures of a grid.
#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>

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
Grid stretched(const Grid &even, const std::vector<Layer> &layers, double low, double high) {
  std::vector<double> heights = {low};
  std::vector<int> material;
  double below = low;
  for (std::size_t k = 0; k < layers.size(); ++k) {
    for (int j = 1; j <= layers[k].elements; ++j) {
      heights.push_back(below + layers[k].thickness * j / layers[k].elements);
      material.push_back(static_cast<int>(k));
    }
    below = heights.back();
  }
  heights.back() = high;
  const double count = static_cast<double>(material.size());
  const auto level = [&](double z) {
    return static_cast<std::size_t>(std::lround((z - low) / (high - low) * count));
  };
  Hexahedra grid = *even;
  for (std::size_t c = 0; c < grid.cells.size(); ++c)
    grid.material[c] = material[level(grid.vertices[static_cast<std::size_t>(grid.cells[c][0])].z)];
  for (Vector3 &v : grid.vertices)
    v.z = heights[level(v.z)];
  return std::make_shared<const Hexahedra>(std::move(grid));
}

constexpr double in_plane = 1e-6;     // of the height, for rounded coordinates
constexpr double looking_share = 0.5; // axial component of a unit normal: 60 degrees

const Vector3 &vertex(const Hexahedra &grid, int number) {
  return grid.vertices[static_cast<std::size_t>(number)];
}

// The z component of the outward unit normal.
double looks_along_z(const Hexahedra &grid, const BoundaryFace &face) {
  const Vector3 normal = cross(vertex(grid, face.nodes[2]) - vertex(grid, face.nodes[0]),
                               vertex(grid, face.nodes[3]) - vertex(grid, face.nodes[1]));
  const double size = norm(normal);
  return size > 0 ? normal.z / size : 0.0;
}

// Calls add(position, volume) at the points of a rule of three by three by three Gauss points of each cell:
// r_i r_j times the Jacobian of a trilinear map is of degree 4 along each axis, for which three are exact.
template <class Add>
void integrate(const Hexahedra &grid, const Add &add) {
  const std::array<double, 3> at{0.5 - std::sqrt(0.15), 0.5, 0.5 + std::sqrt(0.15)},
      weight{5.0 / 18, 8.0 / 18, 5.0 / 18};
  for (const std::array<int, 8> &cell : grid.cells)
    for (std::size_t q = 0; q < 27; ++q) {
      const std::array<std::size_t, 3> own{q % 3, q / 3 % 3, q / 9};
      Vector3 place{};
      std::array<Vector3, 3> slope{};
      for (std::size_t v = 0; v < 8; ++v) {
        std::array<double, 3> factor, sign;
        for (std::size_t k = 0; k < 3; ++k) {
          sign[k] = v >> k & 1U ? 1 : -1;
          factor[k] = sign[k] > 0 ? at[own[k]] : 1 - at[own[k]];
        }
        const Vector3 &corner = vertex(grid, cell[v]);
        place += factor[0] * factor[1] * factor[2] * corner;
        for (std::size_t k = 0; k < 3; ++k)
          slope[k] += sign[k] * factor[(k + 1) % 3] * factor[(k + 2) % 3] * corner;
      }
      add(place, weight[own[0]] * weight[own[1]] * weight[own[2]] * dot(cross(slope[0], slope[1]), slope[2]));
    }
}

} // namespace

Grid make_grid(const CylinderPlate &plate, const std::vector<Layer> &layers) {
  check(layers, plate.thickness);
  CylinderPlate even = plate;
  even.elements_thick = elements_of(layers);
  return stretched(make_grid(even), layers, plate.z_low, plate.z_low + plate.thickness);
}

Grid make_grid(const BoxPlate &plate, const std::vector<Layer> &layers) {
  check(layers, plate.high[2] - plate.low[2]);
  BoxPlate even = plate;
  even.elements[2] = elements_of(layers);
  return stretched(make_grid(even), layers, plate.low[2], plate.high[2]);
}

Grid moved_grid(const Grid &grid, const std::function<Vector3(const Vector3 &)> &place) {
  Hexahedra moved = *grid;
  for (Vector3 &v : moved.vertices)
    v = place(v);
  return std::make_shared<const Hexahedra>(std::move(moved));
}

std::string inverted_cell(const Grid &grid) {
  for (std::size_t c = 0; c < grid->cells.size(); ++c) {
    const std::array<int, 8> &cell = grid->cells[c];
    for (std::size_t v = 0; v < 8; ++v) {
      // Edges along the cell's three axes; the bits of v give the direction.
      std::array<Vector3, 3> edge;
      for (std::size_t k = 0; k < 3; ++k)
        edge[k] = (v >> k & 1U ? -1.0 : 1.0) * (vertex(*grid, cell[v ^ (1U << k)]) - vertex(*grid, cell[v]));
      if (dot(cross(edge[0], edge[1]), edge[2]) > 0) continue;
      Vector3 middle{};
      for (const int corner : cell)
        middle += 0.125 * vertex(*grid, corner);
      std::ostringstream name;
      name << "cell " << c << " at (" << middle.x << ", " << middle.y << ", " << middle.z << ") m";
      return name.str();
    }
  }
  return "";
}

NodeSurface extract_surface(const Grid &grid, const std::vector<int> &tags) {
  SurfaceMesh all;
  all.vertices = grid->vertices;
  for (const BoundaryFace &face : grid->faces) {
    if (!tags.empty() && std::find(tags.begin(), tags.end(), face.tag) == tags.end()) continue;
    all.faces.push_back(face.nodes);
    all.face_tags.push_back(face.tag);
  }
  return node_surface(all);
}

VolumeMoments volume_moments(const Grid &grid) {
  VolumeMoments m;
  integrate(*grid, [&](const Vector3 &p, double volume) {
    m.volume += volume;
    m.centroid += volume * p;
  });
  m.centroid = (1.0 / m.volume) * m.centroid;
  integrate(*grid, [&](const Vector3 &p, double volume) {
    const Vector3 r = p - m.centroid;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j)
        m.second[3 * i + j] += volume * r[i] * r[j];
  });
  return m;
}

Grid laid_platen(const Grid &grid, bool faces_up, double plane) {
  const auto [lowest, highest] =
      std::minmax_element(grid->vertices.begin(), grid->vertices.end(),
                          [](const Vector3 &a, const Vector3 &b) { return a.z < b.z; });
  const double low = lowest->z, high = highest->z;
  const double shift = plane - (faces_up ? high : low), near = in_plane * (high - low);
  const double fixed = (faces_up ? low : high) + shift;
  Hexahedra laid = *grid;
  for (Vector3 &v : laid.vertices) // a flat end is flat to the last bit
    v.z = std::abs(v.z + shift - plane) <= near ? plane : v.z + shift;
  const auto lies_at = [&](const BoundaryFace &face, double z) {
    return std::all_of(face.nodes.begin(), face.nodes.end(),
                       [&](int v) { return std::abs(vertex(laid, v).z - z) <= near; });
  };
  const int near_tag = faces_up ? high_end_tag : low_end_tag, far_tag = faces_up ? low_end_tag : high_end_tag;
  int flat = 0, clamped = 0;
  for (BoundaryFace &face : laid.faces) {
    const bool at_near = lies_at(face, plane), at_far = lies_at(face, fixed);
    flat += at_near, clamped += at_far;
    face.tag = at_near ? near_tag : at_far ? far_tag : mantle_tag;
  }
  if (clamped == 0)
    throw std::invalid_argument(std::string("has no face in the plane of its ") +
                                (faces_up ? "lowest" : "highest") +
                                " point: the machine has nothing to hold");
  for (BoundaryFace &face : laid.faces)
    if (flat == 0 && face.tag != far_tag && (faces_up ? 1 : -1) * looks_along_z(laid, face) > looking_share)
      face.tag = near_tag;
  return std::make_shared<const Hexahedra>(std::move(laid));
}

int materials_of(const Grid &grid) {
  return 1 + std::max(0, *std::max_element(grid->material.begin(), grid->material.end()));
}

} // namespace platen::fem
