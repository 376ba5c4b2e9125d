// Quantities from a field on the nodes of an elastic solid: surface, loads, integrals, stress.
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_q.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "fem/elastic_model.h"
#include "fem/triangulation.h"

namespace platen::fem {
namespace {

std::size_t nodes_per_cell(const ElasticModel &model) {
  const auto side = static_cast<std::size_t>(model.degree + 1);
  return side * side * side;
}

// Nodes of a face in rows along its two axes, from deal.II's order (corners, edges, inside).
std::vector<int> face_lattice(int degree, const std::vector<dealii::types::global_dof_index> &ids) {
  static const std::array<std::size_t, 9> second = {0, 6, 1, 4, 8, 5, 2, 7, 3};
  std::vector<int> lattice(ids.size());
  for (std::size_t k = 0; k < ids.size(); ++k)
    lattice[k] = static_cast<int>(ids[degree == 1 ? k : second[k]]);
  return lattice;
}

// visit(face, nodes in rows, true if the face's own axes give the outward normal), for every boundary face.
template <class Visit>
void for_boundary_faces(const ElasticModel &model, const Visit &visit) {
  std::vector<dealii::types::global_dof_index> ids(model.degree == 1 ? 4 : 9);
  for (const auto &cell : model.numbers->active_cell_iterators())
    for (const unsigned int f : cell->face_indices()) {
      const auto face = cell->face(f);
      if (!face->at_boundary()) continue;
      face->get_dof_indices(ids);
      const auto diagonals =
          dealii::cross_product_3d(face->vertex(3) - face->vertex(0), face->vertex(2) - face->vertex(1));
      visit(face, face_lattice(model.degree, ids), diagonals * (face->center() - cell->center()) > 0);
    }
}

// Stresses at the quadrature points of a cell, from displacement gradients.
void stresses(const ElasticModel &model, const dealii::FEValues<3> &values, std::size_t cell,
              const std::vector<Vector3> &displacement, std::vector<Stress> &result) {
  const std::size_t n = nodes_per_cell(model);
  const Lame c = lame(model.materials[static_cast<std::size_t>(model.cell_material[cell])]);
  result.assign(values.n_quadrature_points, Stress{});
  for (const unsigned int q : values.quadrature_point_indices()) {
    std::array<std::array<double, 3>, 3> g{};
    for (std::size_t a = 0; a < n; ++a) {
      const Vector3 &u = displacement[static_cast<std::size_t>(model.cell_nodes[n * cell + a])];
      const auto &slope = values.shape_grad(static_cast<unsigned int>(a), q);
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
          g[i][j] += u[i] * slope[j];
    }
    const double spread = c.lambda * (g[0][0] + g[1][1] + g[2][2]);
    result[q] = {spread + 2 * c.mu * g[0][0], spread + 2 * c.mu * g[1][1], spread + 2 * c.mu * g[2][2],
                 c.mu * (g[1][2] + g[2][1]),  c.mu * (g[2][0] + g[0][2]),  c.mu * (g[0][1] + g[1][0])};
  }
}

void add(Stress &sum, double weight, const Stress &s) {
  for (std::size_t k = 0; k < 6; ++k)
    sum[k] += weight * s[k];
}

} // namespace

NodeSurface node_surface(const ElasticModel &model) {
  SurfaceMesh all;
  all.vertices = model.nodes;
  const auto side = static_cast<std::size_t>(model.degree + 1);
  for_boundary_faces(model, [&](const auto &face, const std::vector<int> &lattice, bool outward) {
    for (std::size_t j = 0; j + 1 < side; ++j)
      for (std::size_t i = 0; i + 1 < side; ++i) {
        const std::size_t k = j * side + i;
        std::array<int, 4> ring = {lattice[k], lattice[k + 1], lattice[k + side + 1], lattice[k + side]};
        if (!outward) std::swap(ring[1], ring[3]);
        all.faces.push_back(ring);
        all.face_tags.push_back(static_cast<int>(face->boundary_id()));
      }
  });
  return node_surface(all);
}

std::vector<int> nodes_on(const ElasticModel &model, int tag) {
  std::vector<int> nodes;
  for_boundary_faces(model, [&](const auto &face, const std::vector<int> &lattice, bool) {
    if (static_cast<int>(face->boundary_id()) == tag)
      nodes.insert(nodes.end(), lattice.begin(), lattice.end());
  });
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

std::vector<Vector3> body_load(const ElasticModel &model,
                               const std::function<Vector3(const Vector3 &)> &density) {
  std::vector<Vector3> load(model.nodes.size(), Vector3{});
  const dealii::QGauss<3> gauss(static_cast<unsigned int>(model.degree) + 2); // for forces that vary in cells
  dealii::FEValues<3> values(
      model.numbers->get_fe(), gauss,
      dealii::update_values | dealii::update_quadrature_points | dealii::update_JxW_values);
  for (const auto &cell : model.numbers->active_cell_iterators()) {
    values.reinit(cell);
    const int *nodes = &model.cell_nodes[nodes_per_cell(model) * cell->active_cell_index()];
    for (const unsigned int q : values.quadrature_point_indices()) {
      const dealii::Point<3> &p = values.quadrature_point(q);
      const Vector3 force = values.JxW(q) * density({p[0], p[1], p[2]});
      for (const unsigned int a : values.dof_indices()) {
        Vector3 &sum = load[static_cast<std::size_t>(nodes[a])];
        sum = sum + values.shape_value(a, q) * force;
      }
    }
  }
  return load;
}

double von_mises(const Stress &s) {
  const double a = s[0] - s[1], b = s[1] - s[2], c = s[2] - s[0];
  return std::sqrt(0.5 * (a * a + b * b + c * c) + 3 * (s[3] * s[3] + s[4] * s[4] + s[5] * s[5]));
}

std::vector<Stress> cell_stress(const ElasticModel &model, const std::vector<Vector3> &displacement,
                                const std::vector<Stress> &plastic) {
  std::vector<Stress> result(model.cell_material.size()), local;
  const NoCellReuse same_for_any_threads;
  const dealii::QGauss<3> gauss(static_cast<unsigned int>(model.degree));
  const dealii::MappingQ<3> mapping(1);
  dealii::FEValues<3> values(mapping, model.numbers->get_fe(), gauss,
                             dealii::update_gradients | dealii::update_JxW_values);
  for (const auto &cell : model.numbers->active_cell_iterators()) {
    values.reinit(cell);
    const std::size_t number = cell->active_cell_index();
    stresses(model, values, number, displacement, local);
    double volume = 0;
    for (const unsigned int q : values.quadrature_point_indices()) {
      add(result[number], values.JxW(q), local[q]);
      volume += values.JxW(q);
    }
    for (double &s : result[number])
      s /= volume;
    if (!plastic.empty()) add(result[number], -1, plastic[number]);
  }
  return result;
}

std::vector<Stress> nodal_stress(const ElasticModel &model, const std::vector<Vector3> &displacement,
                                 const std::vector<Stress> &plastic) {
  const std::size_t n = nodes_per_cell(model);
  const NoCellReuse same_for_any_threads;
  const dealii::QGauss<3> gauss(static_cast<unsigned int>(model.degree));
  const dealii::MappingQ<3> mapping(1);
  dealii::FEValues<3> values(mapping, model.numbers->get_fe(), gauss, dealii::update_gradients);
  // Weights of the Gauss points for each node: one point alone, or trilinear extrapolation from eight.
  std::vector<double> factor(n * gauss.size(), 1.0);
  if (model.degree == 2)
    for (std::size_t a = 0; a < n; ++a)
      for (unsigned int q = 0; q < gauss.size(); ++q)
        for (unsigned int k = 0; k < 3; ++k) {
          const double x = 2 * model.numbers->get_fe().get_unit_support_points()[a][k] - 1;
          const double sign = gauss.point(q)[k] > 0.5 ? 1 : -1;
          factor[a * gauss.size() + q] *= 0.5 * (1 + sign * std::sqrt(3.0) * x);
        }
  std::map<std::pair<int, int>, std::pair<Stress, int>> sums; // by node and material
  std::vector<Stress> result(model.cell_nodes.size()), local, means;
  if (!plastic.empty()) means = cell_stress(model, displacement, plastic);
  for (const auto &cell : model.numbers->active_cell_iterators()) {
    values.reinit(cell);
    const std::size_t number = cell->active_cell_index();
    stresses(model, values, number, displacement, local);
    if (!plastic.empty() && model.materials[cell->material_id()].hardening)
      local.assign(gauss.size(), means[number]);
    for (std::size_t a = 0; a < n; ++a) {
      auto &[sum, count] = sums[{model.cell_nodes[n * number + a], model.cell_material[number]}];
      for (unsigned int q = 0; q < gauss.size(); ++q)
        add(sum, factor[a * gauss.size() + q], local[q]);
      ++count;
    }
  }
  for (std::size_t k = 0; k < result.size(); ++k) {
    const auto &[sum, count] = sums.at({model.cell_nodes[k], model.cell_material[k / n]});
    add(result[k], 1.0 / count, sum);
  }
  return result;
}

} // namespace platen::fem
