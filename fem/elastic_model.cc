#include "fem/elastic_model.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/dofs/dof_renumbering.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_q.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "base/require.h"
#include "fem/triangulation.h"

namespace platen::fem {
namespace {

template <class Cell>
std::string name_of(const Cell &cell) {
  const dealii::Point<3> p = cell->center();
  return "cell " + std::to_string(cell->active_cell_index()) + " at (" + std::to_string(p[0]) + ", " +
         std::to_string(p[1]) + ", " + std::to_string(p[2]) + ") m";
}

void number_nodes(ElasticModel &model, const Grid &grid, const dealii::FE_Q<3> &element) {
  const auto known = triangulation(*grid);
  const std::shared_ptr<dealii::DoFHandler<3>> numbers(new dealii::DoFHandler<3>(*known),
                                                       [known](auto *last) { delete last; });
  numbers->distribute_dofs(element);
  dealii::DoFRenumbering::Cuthill_McKee(*numbers); // neighbours are near in memory
  model.nodes.resize(numbers->n_dofs());
  std::vector<dealii::Point<3>> points(numbers->n_dofs());
  dealii::DoFTools::map_dofs_to_support_points(dealii::MappingQ<3>(1), *numbers, points);
  for (std::size_t i = 0; i < points.size(); ++i)
    model.nodes[i] = {points[i][0], points[i][1], points[i][2]};
  std::vector<dealii::types::global_dof_index> ids(element.n_dofs_per_cell());
  for (const auto &cell : numbers->active_cell_iterators()) {
    require(cell->material_id() < model.materials.size(),
            "elastic solid: " + name_of(cell) + " is of material " + std::to_string(cell->material_id()) +
                ", but there are " + std::to_string(model.materials.size()));
    model.cell_material.push_back(static_cast<int>(cell->material_id()));
    cell->get_dof_indices(ids);
    for (const auto id : ids)
      model.cell_nodes.push_back(static_cast<int>(id));
  }
  model.numbers = numbers;
}

void lay_out(ElasticModel &model) {
  const auto n = static_cast<dealii::DynamicSparsityPattern::size_type>(model.nodes.size());
  dealii::DynamicSparsityPattern pattern(n, n);
  dealii::DoFTools::make_sparsity_pattern(*model.numbers, pattern);
  NodeMatrix &k = model.stiffness;
  for (dealii::DynamicSparsityPattern::size_type row = 0; row < n; ++row) {
    for (auto entry = pattern.begin(row); entry != pattern.end(row); ++entry)
      k.column.push_back(static_cast<int>(entry->column()));
    k.begin.push_back(k.column.size());
  }
  k.clear_blocks();
}

// One cell's blocks, row by row of nodes: lambda g_a g_b^T + mu (g_a . g_b I + g_b g_a^T), integrated. Blocks
// (b, a) are the transposed of (a, b), so that the sum is exactly symmetric.
void integrate_cell(const dealii::FEValues<3> &values, const Lame &c, std::vector<double> &blocks) {
  const std::size_t n = values.dofs_per_cell;
  std::fill(blocks.begin(), blocks.end(), 0.0);
  for (const unsigned int q : values.quadrature_point_indices())
    for (std::size_t a = 0; a < n; ++a) {
      const auto &ga = values.shape_grad(static_cast<unsigned int>(a), q);
      for (std::size_t b = a; b < n; ++b) {
        const auto &gb = values.shape_grad(static_cast<unsigned int>(b), q);
        const double w = values.JxW(q), both = w * c.mu * (ga * gb);
        double *block = &blocks[9 * (a * n + b)];
        for (unsigned int i = 0; i < 3; ++i) {
          for (unsigned int j = 0; j < 3; ++j)
            block[3 * i + j] += w * (c.lambda * ga[i] * gb[j] + c.mu * gb[i] * ga[j]);
          block[4 * i] += both;
        }
      }
    }
  for (std::size_t a = 0; a < n; ++a) {
    double *own = &blocks[9 * (a * n + a)]; // the two halves may differ by round-off
    for (const auto &[i, j] : {std::pair{1, 3}, {2, 6}, {5, 7}})
      own[j] = own[i];
    for (std::size_t b = 0; b < a; ++b)
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
          blocks[9 * (a * n + b) + 3 * i + j] = blocks[9 * (b * n + a) + 3 * j + i];
  }
}

// Adds the stiffness of a cell's volume whose change is projected onto the polynomials of one degree less, in
// the cell's own coordinates: its mean (Nagtegaal, Parks, Rice 1974), or a linear change.
void add_projected_volume(const dealii::FEValues<3> &values, int degree, double bulk_modulus,
                          std::vector<double> &blocks) {
  const std::size_t n = values.dofs_per_cell, points = values.n_quadrature_points;
  std::vector<std::vector<double>> modes; // orthonormal over the cell
  std::vector<dealii::Tensor<1, 3>> of_nodes(n);
  for (unsigned int m = 0; m < (degree == 1 ? 1u : 4u); ++m) {
    std::vector<double> mode(points, 1.0);
    if (m > 0)
      for (unsigned int q = 0; q < points; ++q)
        mode[q] = values.get_quadrature().point(q)[m - 1];
    const auto integral = [&](const std::vector<double> &other) {
      double sum = 0;
      for (unsigned int q = 0; q < points; ++q)
        sum += values.JxW(q) * mode[q] * other[q];
      return sum;
    };
    for (const std::vector<double> &other : modes) {
      const double share = integral(other);
      for (std::size_t q = 0; q < points; ++q)
        mode[q] -= share * other[q];
    }
    const double length = std::sqrt(integral(mode));
    for (double &value : mode)
      value /= length;
    modes.push_back(mode);
    for (unsigned int a = 0; a < n; ++a) {
      of_nodes[a] = {};
      for (unsigned int q = 0; q < points; ++q)
        of_nodes[a] += values.JxW(q) * mode[q] * values.shape_grad(a, q);
    }
    for (std::size_t a = 0; a < n; ++a)
      for (std::size_t b = 0; b < n; ++b)
        for (unsigned int i = 0; i < 3; ++i)
          for (unsigned int j = 0; j < 3; ++j)
            blocks[9 * (a * n + b) + 3 * i + j] += bulk_modulus * (of_nodes[a][i] * of_nodes[b][j]);
  }
}

// Of a material that yields: the flow leaves the volume as it is, and cells whose volume is held at all
// points would lock.
void integrate_cell(const dealii::FEValues<3> &values, int degree, const Material &material,
                    std::vector<double> &blocks) {
  const Lame c = lame(material);
  if (!material.hardening) return integrate_cell(values, c, blocks);
  integrate_cell(values, {-2.0 / 3 * c.mu, c.mu}, blocks);
  add_projected_volume(values, degree, c.lambda + 2.0 / 3 * c.mu, blocks);
}

// Largest row sum of absolute values of mass^-1 stiffness: no eigenvalue is larger.
double norm_of(const std::vector<double> &blocks, const std::vector<double> &mass) {
  const std::size_t n = mass.size();
  double largest = 0;
  for (std::size_t a = 0; a < n; ++a)
    for (std::size_t i = 0; i < 3; ++i) {
      double sum = 0;
      for (std::size_t b = 0; b < n; ++b)
        for (std::size_t j = 0; j < 3; ++j)
          sum += std::abs(blocks[9 * (a * n + b) + 3 * i + j]) / std::sqrt(mass[a] * mass[b]);
      largest = std::max(largest, sum);
    }
  return largest;
}

// Mass at the nodes. Degree 2: quadrature at the nodes (Gauss-Lobatto), exact for the volume of a trilinear
// cell and its first moments. Degree 1: the integral of each shape function, since two points are not exact.
void lump(const dealii::FEValues<3> &values, int degree, std::vector<double> &lumped) {
  std::fill(lumped.begin(), lumped.end(), 0.0);
  for (const unsigned int q : values.quadrature_point_indices())
    for (std::size_t a = 0; a < lumped.size(); ++a)
      if (const double shape = values.shape_value(static_cast<unsigned int>(a), q);
          degree == 1 || shape > 0.5)
        lumped[a] += shape * values.JxW(q);
}

} // namespace

ElasticModel make_elastic_model(const Grid &grid, int degree, std::vector<Material> materials) {
  require(grid != nullptr, "elastic solid: no grid");
  require(degree == 1 || degree == 2,
          "elastic solid: degree " + std::to_string(degree) + " is neither 1 nor 2");
  require(!materials.empty(), "elastic solid: no material");
  for (std::size_t m = 0; m < materials.size(); ++m)
    check(materials[m], "elastic solid: material " + std::to_string(m));
  const std::string inverted = inverted_cell(grid);
  require(inverted.empty(), "elastic solid: " + inverted + " is inverted or warped through itself");
  ElasticModel model;
  model.degree = degree;
  model.materials = std::move(materials);
  const dealii::FE_Q<3> element(static_cast<unsigned int>(degree));
  number_nodes(model, grid, element);
  lay_out(model);

  const NoCellReuse same_for_any_threads;
  const dealii::QGauss<3> gauss(static_cast<unsigned int>(degree) + 1);
  const dealii::Quadrature<3> lobatto = dealii::QGaussLobatto<3>(3);
  const dealii::MappingQ<3> mapping(1);
  dealii::FEValues<3> values(mapping, element, gauss, dealii::update_gradients | dealii::update_JxW_values);
  dealii::FEValues<3> masses(mapping, element, degree == 1 ? dealii::Quadrature<3>(gauss) : lobatto,
                             dealii::update_values | dealii::update_JxW_values);
  const std::size_t n = element.n_dofs_per_cell();
  std::vector<double> blocks(9 * n * n), lumped(n);
  model.mass.assign(model.nodes.size(), 0.0);
  for (const auto &cell : model.numbers->active_cell_iterators()) {
    const std::size_t number = cell->active_cell_index();
    values.reinit(cell), masses.reinit(cell);
    const Material &material = model.materials[cell->material_id()];
    lump(masses, degree, lumped);
    double cell_volume = 0;
    for (std::size_t a = 0; a < n; ++a) {
      require(lumped[a] > 0, "elastic solid: " + name_of(cell) + " is warped through itself");
      cell_volume += lumped[a];
      lumped[a] *= material.density;
      model.mass[static_cast<std::size_t>(model.cell_nodes[n * number + a])] += lumped[a];
    }
    model.volume += cell_volume;
    integrate_cell(values, degree, material, blocks);
    model.cell_bound = std::max(model.cell_bound, norm_of(blocks, lumped));
    for (std::size_t a = 0; a < n; ++a)
      for (std::size_t b = 0; b < n; ++b) {
        double *sum = model.stiffness.find(static_cast<std::size_t>(model.cell_nodes[n * number + a]),
                                           model.cell_nodes[n * number + b]);
        for (std::size_t k = 0; k < 9; ++k)
          sum[k] += blocks[9 * (a * n + b) + 3 * (k % 3) + k / 3];
      }
  }
  return model;
}

} // namespace platen::fem
