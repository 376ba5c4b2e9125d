// Pictures of bodies that deform, with their stresses.
#include <algorithm>

#include "fem/elastic_solid.h"
#include "fem/hyperelastic_solid.h"

namespace platen::fem {
namespace {

// From row and column of a tensor to its index among xx, yy, zz, yz, zx, xy.
constexpr std::array<std::size_t, 9> voigt = {0, 5, 4, 5, 1, 3, 4, 3, 2};

// Places of the nodes of an element in deal.II's order (corners, edges, faces, middle) by VTK's.
constexpr std::array<std::size_t, 27> vtk_order = {0,  1,  3,  2,  4,  5,  7,  6,  10, 9,  11, 8,  14, 13,
                                                   15, 12, 16, 17, 19, 18, 20, 21, 22, 23, 24, 25, 26};

} // namespace

// Each element has its own points, since stress jumps between materials.
Picture ElasticSolid::picture(const std::vector<double> &slip) const {
  const std::vector<Vector3> u = deformation();
  const std::vector<Stress> stress =
      nodal_stress(model_, u, yielding_ ? yielding_->stresses() : std::vector<Stress>{});
  std::vector<Vector3> displacement(u.size());
  for (std::size_t i = 0; i < u.size(); ++i)
    displacement[i] = carried(i) + to_space(u[i]);
  const Picture joined = picture_of("elastic solid", *this, node_of_, slip, model_.nodes, displacement, {});
  Picture picture;
  picture.nodes_per_cell = model_.degree == 1 ? 8 : 27;
  for (const PictureField &field : joined.of_points)
    picture.of_points.push_back({field.name, field.components, {}});
  PictureField tensor{"stress", 9, {}}, mises{"von_mises", 1, {}};
  const auto per_cell = static_cast<std::size_t>(picture.nodes_per_cell);
  for (std::size_t entry = 0; entry < model_.cell_nodes.size(); ++entry) {
    const std::size_t own = entry - entry % per_cell + vtk_order[entry % per_cell];
    const auto node = static_cast<std::size_t>(model_.cell_nodes[own]);
    picture.cells.push_back(static_cast<int>(entry));
    picture.points.push_back(joined.points[node]);
    for (std::size_t f = 0; f < picture.of_points.size(); ++f) {
      const auto parts = static_cast<std::ptrdiff_t>(joined.of_points[f].components);
      const auto from = joined.of_points[f].values.begin() + parts * static_cast<std::ptrdiff_t>(node);
      picture.of_points[f].values.insert(picture.of_points[f].values.end(), from, from + parts);
    }
    for (const std::size_t part : voigt)
      tensor.values.push_back(stress[own][part]);
    mises.values.push_back(von_mises(stress[own]));
  }
  picture.of_points.push_back(std::move(tensor));
  picture.of_points.push_back(std::move(mises));
  if (yielding_) picture.of_cells.push_back({"plastic_strain", 1, plastic_strains()});
  return picture;
}

std::vector<CellStress> HyperelasticSolid::cell_stresses() const {
  std::vector<CellStress> stresses(mesh_.cells.size());
  for (std::size_t c = 0; c < stresses.size(); ++c)
    stresses[c] = stress_of(c);
  return stresses;
}

CellStress HyperelasticSolid::stress_of(std::size_t cell) const {
  const Corners own = mesh_.gather(cell, displacement_);
  if (plastic_) return cell_stress(material_.law, mesh_.cells[cell], own, after_[cell]);
  CellStress stress = cell_stress(material_.law, mesh_.cells[cell], own);
  if (material_.fibres) add_fibres(*material_.fibres, fibre_cells_[cell], mesh_.cells[cell], own, stress);
  return stress;
}

std::vector<Tensor> HyperelasticSolid::node_stresses() const {
  const std::vector<CellStress> cells = cell_stresses();
  std::vector<Tensor> nodes(mesh_.nodes.size(), Tensor{});
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    double weights = 0;
    for (std::size_t k = mesh_.first_corner[n]; k < mesh_.first_corner[n + 1]; ++k) {
      const std::size_t c = mesh_.corner[k] / 8;
      const double weight = mesh_.cells[c].volume * cells[c].volume_ratio;
      weights += weight;
      for (std::size_t m = 0; m < 9; ++m)
        nodes[n][m] += weight * cells[c].cauchy[m];
    }
    for (double &s : nodes[n])
      s /= weights;
  }
  return nodes;
}

Picture HyperelasticSolid::picture(const std::vector<double> &slip) const {
  Picture picture =
      picture_of("solid", *this, surface_node_, slip, mesh_.nodes, displacement_, mesh_.cell_nodes);
  const std::vector<Tensor> stress = node_stresses();
  PictureField mises{"von_mises", 1, {}}, pressure{"pressure", 1, {}}, ratio{"J", 1, {}};
  for (const Tensor &s : stress) {
    mises.values.push_back(von_mises({s[0], s[4], s[8], s[1], s[5], s[2]}));
    pressure.values.push_back(-(s[0] + s[4] + s[8]) / 3);
  }
  for (const CellStress &cell : cell_stresses())
    ratio.values.push_back(cell.volume_ratio);
  picture.of_points.push_back(picture_field("stress", stress, 9));
  picture.of_points.push_back(std::move(mises));
  picture.of_points.push_back(std::move(pressure));
  picture.of_cells.push_back(std::move(ratio));
  if (plastic_) picture.of_cells.push_back({"plastic_strain", 1, plastic_strains()});
  if (material_.fibres) {
    picture.of_cells.push_back({"hoop_strain", 1, fibre_strain_});
    picture.of_cells.push_back({"laminate_share", 1, fibre_shares()});
  }
  return picture;
}

} // namespace platen::fem
