#include "fem/solid_mesh.h"
#include "base/require.h"
#include "fem/triangulation.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_values.h>

#include <algorithm>
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
    const std::array<int, 8> &nodes = mesh.cell_nodes[mesh.cells.size()];
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
        reference.node_volume[a] += values.shape_value(a, q) * values.JxW(q);
      }
    }
    for (std::size_t a = 0; a < 8; ++a)
      mesh.node_volume[static_cast<std::size_t>(nodes[a])] += reference.node_volume[a];
    mesh.cells.push_back(reference);
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
  SolidMesh mesh;
  mesh.nodes = grid->vertices;
  mesh.cell_nodes = grid->cells;
  mesh.node_volume.assign(mesh.nodes.size(), 0.0);
  read_cells(*triangulation(*grid), mesh);
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n)
    require(mesh.node_volume[n] > 0, "solid: node " + std::to_string(n) + " belongs to no cell");
  mesh.faces = grid->faces;
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

} // namespace platen::fem
