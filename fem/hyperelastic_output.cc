// Stresses of a HyperelasticSolid and its picture.
#include <deal.II/base/data_out_base.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/mapping_q1_eulerian.h>
#include <deal.II/grid/tria.h>
#include <deal.II/lac/vector.h>
#include <deal.II/numerics/data_out.h>

#include <cmath>
#include <ostream>
#include <stdexcept>
#include <string>

#include "fem/hyperelastic_solid.h"

namespace platen::fem {
namespace {

using dealii::DataComponentInterpretation::DataComponentInterpretation;

double von_mises(const Tensor &s) {
  const double a = s[0] - s[4], b = s[4] - s[8], c = s[8] - s[0];
  return std::sqrt(0.5 * (a * a + b * b + c * c) + 3 * (s[1] * s[1] + s[5] * s[5] + s[2] * s[2]));
}

// Values at nodes as a deal.II vector, one field of `parts` components.
class Field {
public:
  Field(const dealii::Triangulation<3> &grid, unsigned int parts)
      : element_(dealii::FE_Q<3>(1), parts), handler_(grid), parts_(parts) {
    handler_.distribute_dofs(element_);
    values_.reinit(handler_.n_dofs());
  }
  template <class Value>
  void fill(const Value &value) { // value(node, component)
    for (const auto &cell : handler_.active_cell_iterators())
      for (const unsigned int corner : cell->vertex_indices())
        for (unsigned int k = 0; k < parts_; ++k)
          values_(cell->vertex_dof_index(corner, k)) =
              value(static_cast<std::size_t>(cell->vertex_index(corner)), k);
  }
  void add_to(dealii::DataOut<3> &out, const std::string &name, DataComponentInterpretation kind) const {
    out.add_data_vector(handler_, values_, std::vector<std::string>(parts_, name),
                        std::vector<DataComponentInterpretation>(parts_, kind));
  }
  const dealii::DoFHandler<3> &handler() const { return handler_; }
  const dealii::Vector<double> &values() const { return values_; }

private:
  dealii::FESystem<3> element_;
  dealii::DoFHandler<3> handler_;
  unsigned int parts_;
  dealii::Vector<double> values_;
};

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
  Field displacement(*grid_, 3), shear(*grid_, 3), tensor(*grid_, 9);
  displacement.fill([&](std::size_t n, unsigned int k) { return displacement_[n][k]; });
  shear.fill([&](std::size_t n, unsigned int k) {
    return at_vertex(n, [&](std::size_t v) { return tractions[v].shear[k]; });
  });
  tensor.fill([&](std::size_t n, unsigned int k) { return stress[n][k]; });
  Field mises(*grid_, 1), pressure(*grid_, 1), contact(*grid_, 1), slipped(*grid_, 1);
  mises.fill([&](std::size_t n, unsigned int) { return von_mises(stress[n]); });
  pressure.fill(
      [&](std::size_t n, unsigned int) { return -(stress[n][0] + stress[n][4] + stress[n][8]) / 3; });
  contact.fill([&](std::size_t n, unsigned int) {
    return at_vertex(n, [&](std::size_t v) { return tractions[v].pressure; });
  });
  slipped.fill([&](std::size_t n, unsigned int) {
    return at_vertex(n, [&](std::size_t v) { return slip.empty() ? 0.0 : slip[v]; });
  });

  dealii::DataOut<3> out;
  out.attach_triangulation(*grid_);
  displacement.add_to(out, "displacement", dealii::DataComponentInterpretation::component_is_part_of_vector);
  tensor.add_to(out, "stress", dealii::DataComponentInterpretation::component_is_part_of_tensor);
  shear.add_to(out, "contact_shear", dealii::DataComponentInterpretation::component_is_part_of_vector);
  mises.add_to(out, "von_mises", dealii::DataComponentInterpretation::component_is_scalar);
  pressure.add_to(out, "pressure", dealii::DataComponentInterpretation::component_is_scalar);
  contact.add_to(out, "contact_pressure", dealii::DataComponentInterpretation::component_is_scalar);
  slipped.add_to(out, "slip", dealii::DataComponentInterpretation::component_is_scalar);
  dealii::Vector<double> ratio(mesh_.cells.size());
  const std::vector<CellStress> cells = cell_stresses();
  for (unsigned int c = 0; c < cells.size(); ++c)
    ratio(c) = cells[c].volume_ratio;
  out.add_data_vector(ratio, "J", dealii::DataOut<3>::type_cell_data);
  out.build_patches(dealii::MappingQ1Eulerian<3>(displacement.handler(), displacement.values()));
  dealii::DataOutBase::VtkFlags flags;
  flags.compression_level = dealii::DataOutBase::VtkFlags::best_speed;
  flags.print_date_and_time = false; // the same state gives the same file
  out.set_flags(flags);
  out.write_vtu(stream);
}

} // namespace platen::fem
