#include "fem/yielding_cells.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_q.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/parallel.h"
#include "fem/points.h"
#include "fem/triangulation.h"
#include "fem/widths.h"

namespace platen::fem {
namespace {

constexpr std::size_t most_nodes = 27;             // of a cell
constexpr std::size_t yielding_cells_at_once = 16; // per part of a loop: some tens of microseconds

std::size_t cube(int side) {
  return static_cast<std::size_t>(side * side * side);
}

// Strain of eight points less what has yielded before, and its flow in this step.
PLATEN_WIDTHS void flow(const J2Plasticity &law, const double *gradient, const Vector3 *u, std::size_t nodes,
                        std::array<AtPoints, 6> &plastic, AtPoints &equivalent) {
  Points d[9]{}; // of displacement, row by row
  for (std::size_t a = 0; a < nodes; ++a) {
    Points g[3];
    for (std::size_t c = 0; c < 3; ++c)
      read(gradient + 8 * (3 * a + c), g[c]);
    for (std::size_t k = 0; k < 9; ++k)
      d[k] += u[a][k / 3] * g[k % 3];
  }
  const Points third = (d[0] + d[4] + d[8]) / 3;
  Points e[6] = {d[0] - third,        d[4] - third,        d[8] - third,
                 0.5 * (d[5] + d[7]), 0.5 * (d[6] + d[2]), 0.5 * (d[1] + d[3])};
  for (std::size_t k = 0; k < 6; ++k) {
    Points before;
    read(plastic[k].data(), before);
    e[k] -= before;
  }
  const Points norm2 =
      e[0] * e[0] + e[1] * e[1] + e[2] * e[2] + 2 * (e[3] * e[3] + e[4] * e[4] + e[5] * e[5]);
  for (std::size_t q = 0; q < 8; ++q) {
    const J2Plasticity::Return after = law(std::sqrt(2.0 / 3.0 * norm2[q]), equivalent[q]);
    if (!(after.plastic_strain > equivalent[q])) continue;
    equivalent[q] = after.plastic_strain;
    for (std::size_t k = 0; k < 6; ++k)
      plastic[k][q] += (1 - after.share) * e[k][q];
  }
}

// Adds the forces of eight points' plastic strain to those of the cell's nodes.
PLATEN_WIDTHS void add_forces_of_plastic(double twice_shear_modulus, const double *gradient,
                                         const AtPoints &weight, const std::array<AtPoints, 6> &plastic,
                                         std::size_t nodes, Vector3 *force) {
  Points w, s[6];
  read(weight.data(), w);
  for (std::size_t k = 0; k < 6; ++k) {
    read(plastic[k].data(), s[k]);
    s[k] *= twice_shear_modulus * w;
  }
  for (std::size_t a = 0; a < nodes; ++a) {
    Points g[3];
    for (std::size_t c = 0; c < 3; ++c)
      read(gradient + 8 * (3 * a + c), g[c]);
    for (int i = 0; i < 3; ++i) {
      const Points at =
          s[symmetric_index[i][0]] * g[0] + s[symmetric_index[i][1]] * g[1] + s[symmetric_index[i][2]] * g[2];
      double sum = 0;
      for (std::size_t q = 0; q < 8; ++q)
        sum += at[q];
      force[a][i] += sum;
    }
  }
}

} // namespace

YieldingCells::YieldingCells(const ElasticModel &model)
    : per_cell_(cube(model.degree + 1)),
      eights_per_cell_((per_cell_ + 7) / 8),
      cells_of_solid_(model.cell_material.size()) {
  for (const Material &material : model.materials)
    laws_.push_back({lame(material).mu, material.hardening.value_or(Hardening{})});
  const NoCellReuse same_for_any_threads;
  const dealii::QGauss<3> gauss(static_cast<unsigned int>(model.degree) + 1);
  const dealii::MappingQ<3> mapping(1);
  dealii::FEValues<3> values(mapping, model.numbers->get_fe(), gauss,
                             dealii::update_gradients | dealii::update_JxW_values);
  for (const auto &cell : model.numbers->active_cell_iterators()) {
    const std::size_t number = cell->active_cell_index();
    if (!model.materials[cell->material_id()].hardening) continue;
    values.reinit(cell);
    cells_.push_back(number);
    material_.push_back(cell->material_id());
    for (std::size_t a = 0; a < per_cell_; ++a)
      cell_nodes_.push_back(model.cell_nodes[per_cell_ * number + a]);
    const std::size_t first = points_.size();
    points_.resize(first + eights_per_cell_);
    gradient_.resize(points_.size() * per_cell_ * 24, 0.0);
    for (const unsigned int q : values.quadrature_point_indices()) {
      const std::size_t eight = first + q / 8;
      points_[eight].weight[q % 8] = values.JxW(q);
      for (unsigned int a = 0; a < per_cell_; ++a)
        for (unsigned int c = 0; c < 3; ++c)
          gradient_[((eight * per_cell_ + a) * 3 + c) * 8 + q % 8] = values.shape_grad(a, q)[c];
    }
  }
  cell_force_.assign(cell_nodes_.size(), Vector3{});
  forces_.assign(model.nodes.size(), Vector3{});
  first_.assign(model.nodes.size() + 1, 0);
  for (const int node : cell_nodes_)
    ++first_[static_cast<std::size_t>(node) + 1];
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  entry_.resize(cell_nodes_.size());
  std::vector<std::size_t> next(first_);
  for (std::size_t entry = 0; entry < entry_.size(); ++entry)
    entry_[next[static_cast<std::size_t>(cell_nodes_[entry])]++] = entry;
}

// Weighted sum of value(law, eight points, index) over the points of all cells, in their order.
template <class Value>
double YieldingCells::sum_over_points(const Value &value) const {
  double sum = 0;
  for (std::size_t k = 0; k < points_.size(); ++k)
    for (std::size_t q = 0; q < 8; ++q)
      if (points_[k].equivalent[q] > 0)
        sum += points_[k].weight[q] * value(law_of(k / eights_per_cell_), points_[k], q);
  return sum;
}

void YieldingCells::yield(const std::vector<Vector3> &displacement) {
  for_each(
      cells_.size(),
      [&](std::size_t c) {
        std::array<Vector3, most_nodes> u;
        for (std::size_t a = 0; a < per_cell_; ++a)
          u[a] = displacement[static_cast<std::size_t>(cell_nodes_[per_cell_ * c + a])];
        for (std::size_t k = eights_per_cell_ * c; k < eights_per_cell_ * (c + 1); ++k) {
          EightPoints &p = points_[k];
          flow(law_of(c), &gradient_[24 * per_cell_ * k], u.data(), per_cell_, p.strain, p.equivalent);
        }
      },
      yielding_cells_at_once);
  find_forces();
}

// Each cell's forces are stored separately; each node then adds those of its cells, in order.
void YieldingCells::find_forces() {
  for_each(
      cells_.size(),
      [&](std::size_t c) {
        Vector3 *own = &cell_force_[per_cell_ * c];
        std::fill(own, own + per_cell_, Vector3{});
        for (std::size_t k = eights_per_cell_ * c; k < eights_per_cell_ * (c + 1); ++k) {
          const EightPoints &p = points_[k];
          if (p.equivalent == AtPoints{}) continue;
          add_forces_of_plastic(2 * law_of(c).shear_modulus, &gradient_[24 * per_cell_ * k], p.weight,
                                p.strain, per_cell_, own);
        }
      },
      yielding_cells_at_once);
  for_each(forces_.size(), [&](std::size_t node) {
    Vector3 sum{};
    for (std::size_t k = first_[node]; k < first_[node + 1]; ++k)
      sum = sum + cell_force_[entry_[k]];
    forces_[node] = sum;
  });
}

double YieldingCells::energy_of_plastic_strain() const {
  return sum_over_points([](const J2Plasticity &law, const EightPoints &p, std::size_t q) {
    double square = 0;
    for (std::size_t k = 0; k < 6; ++k)
      square += (k < 3 ? 1 : 2) * p.strain[k][q] * p.strain[k][q];
    return law.shear_modulus * square;
  });
}

double YieldingCells::plastic_work() const {
  return sum_over_points([](const J2Plasticity &law, const EightPoints &p, std::size_t q) {
    return law.hardening.at(p.equivalent[q]).work;
  });
}

// Weighted mean of a number of the points of a cell that yields.
template <class Value>
double YieldingCells::mean(std::size_t cell, const Value &value) const {
  double volume = 0, sum = 0;
  for (std::size_t k = eights_per_cell_ * cell; k < eights_per_cell_ * (cell + 1); ++k)
    for (std::size_t q = 0; q < 8; ++q)
      volume += points_[k].weight[q], sum += points_[k].weight[q] * value(points_[k])[q];
  return sum / volume;
}

std::vector<double> YieldingCells::strains() const {
  std::vector<double> means(cells_of_solid_, 0.0);
  for (std::size_t c = 0; c < cells_.size(); ++c)
    means[cells_[c]] = mean(c, [](const EightPoints &p) { return p.equivalent; });
  return means;
}

std::vector<Stress> YieldingCells::stresses() const {
  std::vector<Stress> means(cells_of_solid_, Stress{});
  for (std::size_t c = 0; c < cells_.size(); ++c)
    for (std::size_t k = 0; k < 6; ++k)
      means[cells_[c]][k] =
          2 * law_of(c).shear_modulus * mean(c, [k](const EightPoints &p) { return p.strain[k]; });
  return means;
}

void YieldingCells::describe(Archive &archive) {
  static const std::array<const char *, 7> names = {
      "plastic_strain_xx", "plastic_strain_yy", "plastic_strain_zz", "plastic_strain_yz",
      "plastic_strain_zx", "plastic_strain_xy", "plastic_strain"};
  for (std::size_t k = 0; k < 7; ++k) {
    const auto number = [&](std::size_t row) -> double & {
      EightPoints &p = points_[eights_per_cell_ * (row / per_cell_) + row % per_cell_ / 8];
      return (k < 6 ? p.strain[k] : p.equivalent)[row % per_cell_ % 8];
    };
    std::vector<double> values(per_cell_ * cells_.size());
    for (std::size_t row = 0; row < values.size(); ++row)
      values[row] = number(row);
    archive.same_rows(names[k], values, "1", k < 6 ? any_number() : at_least(0));
    if (archive.reads())
      for (std::size_t row = 0; row < values.size(); ++row)
        number(row) = values[row];
  }
  if (archive.reads()) find_forces();
}

} // namespace platen::fem
