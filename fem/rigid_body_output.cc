// The picture of a body: its grid with what the particles do to it.
#include <deal.II/base/data_out_base.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/mapping_q1_eulerian.h>
#include <deal.II/grid/tria.h>
#include <deal.II/lac/vector.h>
#include <deal.II/numerics/data_out.h>

#include <ostream>
#include <stdexcept>

#include "fem/rigid_body.h"

namespace platen::fem {
void RigidBody::write_vtu(std::ostream &stream, const std::vector<double> &slip) const {
  if (!slip.empty() && slip.size() != load_.size())
    throw std::invalid_argument("body: slip must have one value per surface vertex");
  const dealii::FE_Q<3> scalar(1);
  const dealii::FESystem<3> vector(scalar, 3);
  dealii::DoFHandler<3> scalars(*grid_), vectors(*grid_);
  scalars.distribute_dofs(scalar);
  vectors.distribute_dofs(vector);
  dealii::Vector<double> pressure(scalars.n_dofs()), slipped(scalars.n_dofs());
  dealii::Vector<double> displacement(vectors.n_dofs()), shear(vectors.n_dofs());

  std::vector<int> surface_vertex(grid_->n_vertices(), -1);
  for (std::size_t v = 0; v < grid_vertex_.size(); ++v)
    surface_vertex[static_cast<std::size_t>(grid_vertex_[v])] = static_cast<int>(v);
  const std::vector<Traction> tractions = contact_tractions();
  auto vector_cell = vectors.begin_active();
  for (const auto &cell : scalars.active_cell_iterators()) {
    for (const unsigned int corner : cell->vertex_indices()) {
      const dealii::Point<3> &p = cell->vertex(corner);
      const Point reference = {p[0], p[1], p[2]}, moved = current_position(reference) - reference;
      for (unsigned int k = 0; k < 3; ++k)
        displacement(vector_cell->vertex_dof_index(corner, k)) = moved[k];
      const int v = surface_vertex[cell->vertex_index(corner)];
      if (v < 0) continue;
      const Traction &t = tractions[static_cast<std::size_t>(v)];
      pressure(cell->vertex_dof_index(corner, 0)) = t.pressure;
      if (!slip.empty()) slipped(cell->vertex_dof_index(corner, 0)) = slip[static_cast<std::size_t>(v)];
      for (unsigned int k = 0; k < 3; ++k)
        shear(vector_cell->vertex_dof_index(corner, k)) = t.shear[k];
    }
    ++vector_cell;
  }

  dealii::DataOut<3> out;
  const std::vector<dealii::DataComponentInterpretation::DataComponentInterpretation> parts(
      3, dealii::DataComponentInterpretation::component_is_part_of_vector);
  out.add_data_vector(vectors, displacement, std::vector<std::string>(3, "displacement"), parts);
  out.add_data_vector(vectors, shear, std::vector<std::string>(3, "contact_shear"), parts);
  out.add_data_vector(scalars, pressure, "contact_pressure");
  out.add_data_vector(scalars, slipped, "slip");
  out.build_patches(dealii::MappingQ1Eulerian<3>(vectors, displacement));
  dealii::DataOutBase::VtkFlags flags;
  flags.compression_level = dealii::DataOutBase::VtkFlags::best_speed;
  flags.print_date_and_time = false; // the same state gives the same file
  out.set_flags(flags);
  out.write_vtu(stream);
}

} // namespace platen::fem
