#include "fem/triangulation.h"

#include <deal.II/base/multithread_info.h>

#include <algorithm>
#include <mutex>

namespace platen::fem {
namespace {

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

NoCellReuse::NoCellReuse() {
  count(1);
}

NoCellReuse::~NoCellReuse() {
  count(-1);
}

std::shared_ptr<const dealii::Triangulation<3>> triangulation(const Hexahedra &grid) {
  std::vector<dealii::Point<3>> points;
  for (const Vector3 &v : grid.vertices)
    points.emplace_back(v.x, v.y, v.z);
  std::vector<dealii::CellData<3>> cells(grid.cells.size());
  for (std::size_t c = 0; c < cells.size(); ++c) {
    cells[c].vertices.assign(grid.cells[c].begin(), grid.cells[c].end());
    cells[c].material_id = static_cast<dealii::types::material_id>(grid.material[c]);
  }
  dealii::SubCellData tags;
  for (const BoundaryFace &face : grid.faces) {
    dealii::CellData<2> &quad = tags.boundary_quads.emplace_back();
    const auto node = [&](std::size_t k) { return static_cast<unsigned int>(face.nodes[k]); };
    quad.vertices = {node(0), node(1), node(3), node(2)};
    quad.boundary_id = static_cast<dealii::types::boundary_id>(face.tag);
  }
  auto made = std::make_shared<dealii::Triangulation<3>>();
  made->create_triangulation(points, cells, tags);
  return made;
}

Hexahedra hexahedra(const dealii::Triangulation<3> &grid) {
  Hexahedra made;
  for (const dealii::Point<3> &p : grid.get_vertices())
    made.vertices.push_back({p[0], p[1], p[2]});
  for (const auto &cell : grid.active_cell_iterators()) {
    std::array<int, 8> &corners = made.cells.emplace_back();
    for (const unsigned int v : cell->vertex_indices())
      corners[v] = static_cast<int>(cell->vertex_index(v));
    made.material.push_back(static_cast<int>(cell->material_id()));
  }
  made.faces = boundary_faces(made.cells);
  std::size_t next = 0; // faces at the boundary are in the same order
  for (const auto &cell : grid.active_cell_iterators())
    for (const unsigned int f : cell->face_indices())
      if (cell->face(f)->at_boundary())
        made.faces.at(next++).tag = static_cast<int>(cell->face(f)->boundary_id());
  return made;
}

} // namespace platen::fem
