// Stresses of a HyperelasticSolid and its picture.
#include <cmath>
#include <ostream>
#include <stdexcept>
#include <string>

#include "fem/grid_picture.h"
#include "fem/hyperelastic_solid.h"

namespace platen::fem {
namespace {

double von_mises(const Tensor &s) {
  const double a = s[0] - s[4], b = s[4] - s[8], c = s[8] - s[0];
  return std::sqrt(0.5 * (a * a + b * b + c * c) + 3 * (s[1] * s[1] + s[5] * s[5] + s[2] * s[2]));
}

} // namespace

std::vector<CellStress> HyperelasticSolid::cell_stresses() const {
  std::vector<CellStress> stresses(mesh_.cells.size());
  for (std::size_t c = 0; c < stresses.size(); ++c)
    stresses[c] = cell_stress(material_.law, mesh_.cells[c], mesh_.gather(c, displacement_));
  return stresses;
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

void HyperelasticSolid::write_vtu(std::ostream &stream, const std::vector<double> &slip) const {
  if (!slip.empty() && slip.size() != load_.size())
    throw std::invalid_argument("solid: slip must have one value per surface vertex");
  const std::vector<Tensor> stress = node_stresses();
  const std::vector<Traction> tractions = contact_tractions();
  const auto at_vertex = [&](std::size_t n, const auto &value) {
    return vertex_of_[n] < 0 ? 0.0 : value(index(vertex_of_[n]));
  };
  const std::size_t nodes = mesh_.nodes.size();
  const auto field = [&](const char *name, std::size_t parts, const auto &value) { // value(node, component)
    VertexField f{name, parts, std::vector<double>(parts * nodes)};
    for (std::size_t n = 0; n < nodes; ++n)
      for (std::size_t k = 0; k < parts; ++k)
        f.values[parts * n + k] = value(n, k);
    return f;
  };
  CellField ratio{"J", {}};
  for (const CellStress &cell : cell_stresses())
    ratio.values.push_back(cell.volume_ratio);
  write_picture(
      stream, grid_,
      {field("displacement", 3, [&](std::size_t n, std::size_t k) { return displacement_[n][k]; }),
       field("stress", 9, [&](std::size_t n, std::size_t k) { return stress[n][k]; }),
       field("contact_shear", 3,
             [&](std::size_t n, std::size_t k) {
               return at_vertex(n, [&](std::size_t v) { return tractions[v].shear[k]; });
             }),
       field("von_mises", 1, [&](std::size_t n, std::size_t) { return von_mises(stress[n]); }),
       field("pressure", 1,
             [&](std::size_t n, std::size_t) { return -(stress[n][0] + stress[n][4] + stress[n][8]) / 3; }),
       field("contact_pressure", 1,
             [&](std::size_t n, std::size_t) {
               return at_vertex(n, [&](std::size_t v) { return tractions[v].pressure; });
             }),
       field("slip", 1,
             [&](std::size_t n, std::size_t) {
               return at_vertex(n, [&](std::size_t v) { return slip.empty() ? 0.0 : slip[v]; });
             })},
      {ratio});
}

} // namespace platen::fem
