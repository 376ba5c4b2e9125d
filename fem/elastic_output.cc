// The picture of an elastic solid.
#include <deal.II/base/data_out_base.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_dgq.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/mapping_q_eulerian.h>
#include <deal.II/grid/tria.h>
#include <deal.II/lac/vector.h>
#include <deal.II/numerics/data_out.h>

#include <ostream>
#include <stdexcept>

#include "fem/elastic_solid.h"

namespace platen::fem {
namespace {

using Parts = std::vector<dealii::DataComponentInterpretation::DataComponentInterpretation>;

// Fills a finite-element vector: value(entry of cell_nodes, component).
template <class Value>
void fill(const dealii::DoFHandler<3> &numbers, dealii::Vector<double> &field, const Value &value) {
  const dealii::FiniteElement<3> &element = numbers.get_fe();
  const std::size_t nodes = element.n_dofs_per_cell() / element.n_components();
  std::vector<dealii::types::global_dof_index> ids(element.n_dofs_per_cell());
  field.reinit(numbers.n_dofs());
  for (const auto &cell : numbers.active_cell_iterators()) {
    cell->get_dof_indices(ids);
    for (unsigned int k = 0; k < ids.size(); ++k) {
      const auto [component, node] = element.system_to_component_index(k);
      field(ids[k]) = value(nodes * cell->active_cell_index() + node, component);
    }
  }
}

// Row and column of a tensor to its place among xx, yy, zz, yz, zx, xy.
constexpr std::array<std::size_t, 9> voigt = {0, 5, 4, 5, 1, 3, 4, 3, 2};

} // namespace

void ElasticSolid::write_vtu(std::ostream &stream, const std::vector<double> &slip) const {
  if (!slip.empty() && slip.size() != load_.size())
    throw std::invalid_argument("elastic solid: slip must have one value per surface vertex");
  const std::vector<Vector3> u = deformation();
  const std::vector<Stress> stress = nodal_stress(model_, u);
  std::vector<Vector3> displacement(u.size()), shear(u.size(), Vector3{});
  std::vector<double> pressure(u.size(), 0.0), slipped(u.size(), 0.0);
  for (std::size_t i = 0; i < u.size(); ++i)
    displacement[i] = carried(i) + to_space(u[i]);
  const std::vector<Traction> tractions = contact_tractions();
  for (std::size_t v = 0; v < node_of_.size(); ++v) {
    const auto node = static_cast<std::size_t>(node_of_[v]);
    pressure[node] = tractions[v].pressure, shear[node] = tractions[v].shear;
    if (!slip.empty()) slipped[node] = slip[v];
  }
  const auto node = [&](std::size_t entry) { return static_cast<std::size_t>(model_.cell_nodes[entry]); };

  const auto degree = static_cast<unsigned int>(model_.degree);
  const dealii::FE_Q<3> smooth(degree);
  // Nodes in the same order as the smooth element's, but each cell's own: stress jumps between materials.
  const dealii::FESystem<3> vector(smooth, 3);
  dealii::DoFHandler<3> scalars(*model_.grid), vectors(*model_.grid), tensors(*model_.grid),
      jumps(*model_.grid);
  scalars.distribute_dofs(smooth), vectors.distribute_dofs(vector);
  const dealii::FE_DGQ<3> own(degree);
  const dealii::FESystem<3> own_tensor(own, 9);
  jumps.distribute_dofs(own), tensors.distribute_dofs(own_tensor);
  // deal.II numbers the nodes of FE_DGQ in rows and those of FE_Q by corners, edges, faces, inside.
  std::vector<unsigned int> by_rows(own.n_dofs_per_cell());
  for (unsigned int a = 0; a < by_rows.size(); ++a)
    for (unsigned int b = 0; b < by_rows.size(); ++b)
      if (own.unit_support_point(a).distance(smooth.unit_support_point(b)) < 0.1) by_rows[a] = b;
  const auto stress_at = [&](std::size_t entry) -> const Stress & {
    return stress[entry - entry % by_rows.size() + by_rows[entry % by_rows.size()]];
  };

  dealii::Vector<double> moves, shears, pressures, slips, tensor, mises;
  fill(vectors, moves, [&](std::size_t k, unsigned int c) { return displacement[node(k)][c]; });
  fill(vectors, shears, [&](std::size_t k, unsigned int c) { return shear[node(k)][c]; });
  fill(scalars, pressures, [&](std::size_t k, unsigned int) { return pressure[node(k)]; });
  fill(scalars, slips, [&](std::size_t k, unsigned int) { return slipped[node(k)]; });
  fill(tensors, tensor, [&](std::size_t k, unsigned int c) { return stress_at(k)[voigt[c]]; });
  fill(jumps, mises, [&](std::size_t k, unsigned int) { return von_mises(stress_at(k)); });

  dealii::DataOut<3> out;
  const Parts arrow(3, dealii::DataComponentInterpretation::component_is_part_of_vector);
  const Parts square(9, dealii::DataComponentInterpretation::component_is_part_of_tensor);
  out.add_data_vector(vectors, moves, std::vector<std::string>(3, "displacement"), arrow);
  out.add_data_vector(vectors, shears, std::vector<std::string>(3, "contact_shear"), arrow);
  out.add_data_vector(scalars, pressures, "contact_pressure");
  out.add_data_vector(scalars, slips, "slip");
  out.add_data_vector(tensors, tensor, std::vector<std::string>(9, "stress"), square);
  out.add_data_vector(jumps, mises, "von_mises");
  const dealii::MappingQEulerian<3, dealii::Vector<double>> mapping(degree, vectors, moves);
  out.build_patches(mapping, degree, dealii::DataOut<3>::curved_inner_cells);
  dealii::DataOutBase::VtkFlags flags;
  flags.compression_level = dealii::DataOutBase::VtkFlags::best_speed;
  flags.print_date_and_time = false; // the same state gives the same file
  flags.write_higher_order_cells = degree > 1;
  out.set_flags(flags);
  out.write_vtu(stream);
}

} // namespace platen::fem
