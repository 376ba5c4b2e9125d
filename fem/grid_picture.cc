#include "fem/grid_picture.h"

#include <deal.II/base/data_out_base.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/mapping_q1_eulerian.h>
#include <deal.II/grid/tria.h>
#include <deal.II/lac/vector.h>
#include <deal.II/numerics/data_out.h>

#include <list>
#include <ostream>

namespace platen::fem {
namespace {

using dealii::DataComponentInterpretation::DataComponentInterpretation;

DataComponentInterpretation kind_of(std::size_t parts) {
  return parts == 9   ? dealii::DataComponentInterpretation::component_is_part_of_tensor
         : parts == 3 ? dealii::DataComponentInterpretation::component_is_part_of_vector
                      : dealii::DataComponentInterpretation::component_is_scalar;
}

// A field as deal.II has it.
struct Numbered {
  dealii::FESystem<3> element;
  dealii::DoFHandler<3> handler;
  dealii::Vector<double> values;

  Numbered(const dealii::Triangulation<3> &grid, const VertexField &field)
      : element(dealii::FE_Q<3>(1), static_cast<unsigned int>(field.parts)), handler(grid) {
    handler.distribute_dofs(element);
    values.reinit(handler.n_dofs());
    for (const auto &cell : handler.active_cell_iterators())
      for (const unsigned int corner : cell->vertex_indices())
        for (unsigned int k = 0; k < field.parts; ++k)
          values(cell->vertex_dof_index(corner, k)) =
              field.values[field.parts * cell->vertex_index(corner) + k];
  }
};

} // namespace

void write_picture(std::ostream &stream, const Grid &grid, const std::vector<VertexField> &fields,
                   const std::vector<CellField> &cells) {
  dealii::DataOut<3> out;
  out.attach_triangulation(*grid);
  std::list<Numbered> numbered; // stay where they are
  for (const VertexField &field : fields) {
    const Numbered &n = numbered.emplace_back(*grid, field);
    out.add_data_vector(n.handler, n.values, std::vector<std::string>(field.parts, field.name),
                        std::vector<DataComponentInterpretation>(field.parts, kind_of(field.parts)));
  }
  std::list<dealii::Vector<double>> of_cells;
  for (const CellField &field : cells)
    out.add_data_vector(of_cells.emplace_back(field.values.begin(), field.values.end()), field.name,
                        dealii::DataOut<3>::type_cell_data);
  out.build_patches(dealii::MappingQ1Eulerian<3>(numbered.front().handler, numbered.front().values));
  dealii::DataOutBase::VtkFlags flags;
  flags.compression_level = dealii::DataOutBase::VtkFlags::best_speed;
  flags.print_date_and_time = false;
  out.set_flags(flags);
  out.write_vtu(stream);
}

} // namespace platen::fem
