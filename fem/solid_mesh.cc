#include "fem/solid_mesh.h"
#include "base/require.h"
#include "fem/grids.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/grid/tria.h>

#include <algorithm>
#include <stdexcept>
#include <string>

namespace platen::fem {
namespace {

void read_cells(const dealii::Triangulation<3> &grid, SolidMesh &mesh) {
  const NoCellReuse same_for_any_threads;
  const dealii::FE_Q<3> element(1);
  const dealii::QGauss<3> points(2);
  dealii::FEValues<3> values(element, points,
                             dealii::update_values | dealii::update_gradients | dealii::update_JxW_values);
  for (const auto &cell : grid.active_cell_iterators()) {
    std::array<int, 8> nodes;
    for (unsigned int a = 0; a < 8; ++a)
      nodes[a] = static_cast<int>(cell->vertex_index(a));
    mesh.cell_nodes.push_back(nodes);
    ReferenceCell reference;
    const std::string name = "cell " + std::to_string(mesh.cells.size());
    reference.corner_volume = corner_volumes(mesh.gather(mesh.cells.size(), mesh.nodes));
    for (const double volume : reference.corner_volume)
      require(volume > 0, "solid: " + name + " is folded at a corner");
    values.reinit(cell);
    for (unsigned int q = 0; q < 8; ++q) {
      reference.weight[q] = values.JxW(q);
      reference.volume += values.JxW(q);
      for (unsigned int a = 0; a < 8; ++a) {
        const auto gradient = values.shape_grad(a, q);
        for (unsigned int k = 0; k < 3; ++k)
          reference.gradient[a][k][q] = gradient[k];
        reference.share[a] += values.shape_value(a, q) * values.JxW(q);
      }
    }
    for (std::size_t a = 0; a < 8; ++a)
      mesh.node_volume[static_cast<std::size_t>(nodes[a])] += reference.share[a];
    mesh.cells.push_back(reference);
  }
}

void read_faces(const dealii::Triangulation<3> &grid, SolidMesh &mesh) {
  int number = 0;
  for (const auto &cell : grid.active_cell_iterators()) {
    for (const unsigned int f : cell->face_indices()) {
      const auto face = cell->face(f);
      if (!face->at_boundary()) continue;
      BoundaryFace own{{}, static_cast<int>(face->boundary_id()), number, {}};
      const std::array<unsigned int, 4> ring = {face->vertex_index(0), face->vertex_index(1),
                                                face->vertex_index(3), face->vertex_index(2)};
      const auto out =
          dealii::cross_product_3d(face->vertex(3) - face->vertex(0), face->vertex(2) - face->vertex(1));
      const bool turned = out * (face->center() - cell->center()) < 0;
      for (std::size_t k = 0; k < 4; ++k)
        own.nodes[k] = static_cast<int>(ring[turned ? (4 - k) % 4 : k]);
      const auto &all = mesh.cell_nodes[static_cast<std::size_t>(number)];
      for (std::size_t k = 0; k < 4; ++k)
        own.corners[k] = static_cast<int>(std::find(all.begin(), all.end(), own.nodes[k]) - all.begin());
      mesh.faces.push_back(own);
    }
    ++number;
  }
}

void list_corners(SolidMesh &mesh) {
  mesh.first_corner.assign(mesh.nodes.size() + 1, 0);
  for (const auto &nodes : mesh.cell_nodes)
    for (const int n : nodes)
      ++mesh.first_corner[static_cast<std::size_t>(n) + 1];
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n)
    mesh.first_corner[n + 1] += mesh.first_corner[n];
  mesh.corner.resize(8 * mesh.cells.size());
  std::vector<std::size_t> next(mesh.first_corner.begin(), mesh.first_corner.end() - 1);
  for (std::size_t c = 0; c < mesh.cells.size(); ++c)
    for (std::size_t a = 0; a < 8; ++a)
      mesh.corner[next[static_cast<std::size_t>(mesh.cell_nodes[c][a])]++] = 8 * c + a;
}

} // namespace

SolidMesh read_mesh(const Grid &grid) {
  require(grid != nullptr, "solid: no grid");
  require(!grid->has_hanging_nodes() && grid->n_levels() == 1, "solid: the grid must not be refined locally");
  SolidMesh mesh;
  for (const dealii::Point<3> &p : grid->get_vertices())
    mesh.nodes.push_back({p[0], p[1], p[2]});
  mesh.node_volume.assign(mesh.nodes.size(), 0.0);
  read_cells(*grid, mesh);
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n)
    require(mesh.node_volume[n] > 0, "solid: node " + std::to_string(n) + " belongs to no cell");
  read_faces(*grid, mesh);
  list_corners(mesh);
  return mesh;
}

std::vector<int> SolidMesh::nodes_of(int tag) const {
  std::vector<int> found;
  for (const BoundaryFace &face : faces)
    if (face.tag == tag) found.insert(found.end(), face.nodes.begin(), face.nodes.end());
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

PartSurface part_surface(const SolidMesh &mesh, const std::vector<int> &tags) {
  PartSurface part;
  std::vector<const BoundaryFace *> chosen;
  std::vector<int> vertex(mesh.nodes.size(), -1);
  for (const BoundaryFace &face : mesh.faces) {
    if (!tags.empty() && std::find(tags.begin(), tags.end(), face.tag) == tags.end()) continue;
    chosen.push_back(&face);
    for (const int n : face.nodes)
      vertex[static_cast<std::size_t>(n)] = 0;
  }
  for (std::size_t n = 0; n < vertex.size(); ++n) {
    if (vertex[n] < 0) continue;
    vertex[n] = static_cast<int>(part.node.size());
    part.node.push_back(static_cast<int>(n));
    part.surface.vertices.push_back(mesh.nodes[n]);
  }
  for (const BoundaryFace *face : chosen) {
    std::array<int, 4> ring;
    for (std::size_t k = 0; k < 4; ++k)
      ring[k] = vertex[static_cast<std::size_t>(face->nodes[k])];
    part.surface.faces.push_back(ring);
    part.surface.face_tags.push_back(face->tag);
  }
  part.surface.velocities.assign(part.node.size(), Vector3{});
  return part;
}

} // namespace platen::fem
