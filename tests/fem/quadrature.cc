#include "tests/fem/quadrature.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_q.h>

#include "fem/triangulation.h"

namespace platen::fem {
namespace {

Vector3 point(const dealii::Point<3> &p) {
  return {p[0], p[1], p[2]};
}

const int *nodes_of(const ElasticModel &model, std::size_t cell) {
  return &model.cell_nodes[model.cell_nodes.size() / model.cell_material.size() * cell];
}

} // namespace

std::vector<Vector3> face_load(const ElasticModel &model, int tag,
                               const std::function<Vector3(const Vector3 &, const Vector3 &)> &traction) {
  std::vector<Vector3> load(model.nodes.size(), Vector3{});
  const dealii::QGauss<2> gauss(static_cast<unsigned int>(model.degree) + 2);
  const NoCellReuse same_for_any_threads;
  const dealii::MappingQ<3> mapping(1);
  dealii::FEFaceValues<3> values(mapping, model.numbers->get_fe(), gauss,
                                 dealii::update_values | dealii::update_quadrature_points |
                                     dealii::update_normal_vectors | dealii::update_JxW_values);
  for (const auto &cell : model.numbers->active_cell_iterators())
    for (const unsigned int f : cell->face_indices()) {
      if (!cell->face(f)->at_boundary() || static_cast<int>(cell->face(f)->boundary_id()) != tag) continue;
      values.reinit(cell, f);
      const int *nodes = nodes_of(model, cell->active_cell_index());
      for (const unsigned int q : values.quadrature_point_indices()) {
        const auto &normal = values.normal_vector(q);
        const Vector3 force =
            values.JxW(q) * traction(point(values.quadrature_point(q)), {normal[0], normal[1], normal[2]});
        for (const unsigned int a : values.dof_indices())
          load[static_cast<std::size_t>(nodes[a])] += values.shape_value(a, q) * force;
      }
    }
  return load;
}

double integral(const ElasticModel &model, const std::vector<Vector3> &field,
                const std::function<double(const Vector3 &, const Vector3 &)> &f) {
  double sum = 0;
  const dealii::QGauss<3> gauss(static_cast<unsigned int>(model.degree) + 2);
  dealii::FEValues<3> values(
      model.numbers->get_fe(), gauss,
      dealii::update_values | dealii::update_quadrature_points | dealii::update_JxW_values);
  for (const auto &cell : model.numbers->active_cell_iterators()) {
    values.reinit(cell);
    const int *nodes = nodes_of(model, cell->active_cell_index());
    for (const unsigned int q : values.quadrature_point_indices()) {
      Vector3 here{};
      for (const unsigned int a : values.dof_indices())
        here += values.shape_value(a, q) * field[static_cast<std::size_t>(nodes[a])];
      sum += values.JxW(q) * f(point(values.quadrature_point(q)), here);
    }
  }
  return sum;
}

} // namespace platen::fem
