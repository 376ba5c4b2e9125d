#include "fem/static_equations.h"

#include <deal.II/base/index_set.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/solver_cg.h>
#include <deal.II/lac/solver_control.h>
#include <deal.II/lac/sparse_direct.h>
#include <deal.II/lac/sparse_matrix.h>
#include <deal.II/lac/sparsity_pattern.h>
#include <deal.II/lac/trilinos_precondition.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_sparsity_pattern.h>
#include <deal.II/lac/trilinos_vector.h>
#include <deal.II/lac/vector.h>

#include <ml_MultiLevelPreconditioner.h>
#include <mpi.h>
#include <Teuchos_ParameterList.hpp>

#include <stdexcept>
#include <string>
#include <utility>

namespace platen::fem {
namespace {

constexpr double residual_share = 1e-12;
// Up to here UMFPACK is faster (bench/results/platen_solve.md): number of nodes of degree 1, whose rows have
// at most 27 blocks, and of degree 2, whose fuller rows slow down the gradients more than the factors.
constexpr std::size_t direct_nodes_linear = 5000, direct_nodes_quadratic = 10000, linear_blocks = 27;

// The code that initialises MPI also finalises it; a program without solves does not initialise it.
void ensure_mpi() {
  struct Mpi {
    Mpi() {
      int running = 0;
      MPI_Initialized(&running);
      if (running) return;
      MPI_Init(nullptr, nullptr);
      ours = true;
    }
    ~Mpi() {
      if (ours) MPI_Finalize();
    }
    bool ours = false;
  };
  static const Mpi mpi;
}

using Index = dealii::types::global_dof_index;

Index equation_of(std::size_t node, std::size_t k) {
  return static_cast<Index>(3 * node + k);
}

// Entries of the matrix without fixed rows and columns, which keep only their diagonal entry.
template <class Add>
void for_entries(const NodeMatrix &a, const Fixed &fixed, const Add &add) {
  for (std::size_t i = 0; i < a.rows(); ++i)
    for (std::size_t b = a.begin[i]; b < a.begin[i + 1]; ++b) {
      const auto j = static_cast<std::size_t>(a.column[b]);
      for (std::size_t r = 0; r < 3; ++r)
        for (std::size_t c = 0; c < 3; ++c) {
          const double value = a.at(b)[r + 3 * c];
          if (fixed[i][r] || fixed[j][c]) {
            if (i == j && r == c) add(equation_of(i, r), equation_of(j, c), value);
          } else {
            add(equation_of(i, r), equation_of(j, c), value);
          }
        }
    }
}

// Mode by mode over all unknowns: three translations, then rotations about axes through the mean.
std::vector<double> rigid_motions(const std::vector<Vector3> &nodes) {
  Vector3 middle{};
  for (const Vector3 &p : nodes)
    middle = middle + (1.0 / static_cast<double>(nodes.size())) * p;
  const std::size_t n = 3 * nodes.size();
  std::vector<double> modes(6 * n, 0.0);
  for (std::size_t k = 0; k < 3; ++k) {
    Vector3 axis{};
    axis[k] = 1;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      modes[k * n + 3 * i + k] = 1;
      const Vector3 turn = cross(axis, nodes[i] - middle);
      for (std::size_t c = 0; c < 3; ++c)
        modes[(3 + k) * n + 3 * i + c] = turn[c];
    }
  }
  return modes;
}

// GCC and Clang mangle the template SparseMatrix::vmult differently, and so its reinit: code of one compiler
// does not link with a library of the other.
struct Product {
  const dealii::TrilinosWrappers::SparseMatrix &matrix;
  void vmult(dealii::TrilinosWrappers::MPI::Vector &to,
             const dealii::TrilinosWrappers::MPI::Vector &from) const {
    if (matrix.trilinos_matrix().Multiply(false, from.trilinos_vector(), to.trilinos_vector()) != 0)
      throw std::runtime_error("elastic solid: Trilinos cannot multiply its matrix");
  }
};

} // namespace

struct StaticEquations::Parts {
  LinearSolver kind;
  Fixed fixed;
  int iterations = 0;
  dealii::SparseDirectUMFPACK direct;
  dealii::TrilinosWrappers::SparseMatrix matrix;
  dealii::TrilinosWrappers::PreconditionAMG multigrid;
  std::vector<double> modes; // ML keeps pointers to them

  void factorise(const NodeMatrix &a, const dealii::DynamicSparsityPattern &rows) {
    dealii::SparsityPattern pattern;
    pattern.copy_from(rows);
    dealii::SparseMatrix<double> full(pattern);
    for_entries(a, fixed, [&](Index r, Index c, double value) { full.add(r, c, value); });
    direct.initialize(full);
  }
  void aggregate(const NodeMatrix &a, const dealii::DynamicSparsityPattern &rows,
                 const std::vector<Vector3> &nodes) {
    const dealii::IndexSet all = dealii::complete_index_set(rows.n_rows());
    dealii::TrilinosWrappers::SparsityPattern pattern(all, MPI_COMM_SELF, rows.max_entries_per_row());
    for (Index row = 0; row < rows.n_rows(); ++row)
      for (Index k = 0; k < rows.row_length(row); ++k)
        pattern.add(row, rows.column_number(row, k));
    pattern.compress();
    matrix.reinit(pattern);
    for_entries(a, fixed, [&](Index r, Index c, double value) { matrix.add(r, c, value); });
    matrix.compress(dealii::VectorOperation::add);
    modes = rigid_motions(nodes);
    Teuchos::ParameterList list;
    ML_Epetra::SetDefaults("SA", list);
    list.set("ML output", 0);
    list.set("PDE equations", 3);
    list.set("aggregation: threshold", 0.0);
    list.set("null space: type", "pre-computed");
    list.set("null space: add default vectors", false);
    list.set("null space: dimension", 6);
    list.set("null space: vectors", modes.data());
    list.set("smoother: type", "Chebyshev");
    list.set("smoother: sweeps", 2);
    list.set("coarse: type", "Amesos-KLU");
    list.set("coarse: max size", 500);
    multigrid.initialize(matrix, list);
  }
  void by_gradients(const dealii::Vector<double> &right, dealii::Vector<double> &x) {
    const dealii::IndexSet all = dealii::complete_index_set(right.size());
    dealii::TrilinosWrappers::MPI::Vector b(all, MPI_COMM_SELF), y(all, MPI_COMM_SELF);
    for (Index k = 0; k < right.size(); ++k)
      b[k] = right[k], y[k] = x[k];
    dealii::SolverControl control(5000, residual_share * right.l2_norm());
    dealii::SolverCG<dealii::TrilinosWrappers::MPI::Vector> gradients(control);
    try {
      gradients.solve(Product{matrix}, y, b, multigrid);
    } catch (const dealii::SolverControl::NoConvergence &stop) {
      throw std::runtime_error("elastic solid: conjugate gradients stopped after " +
                               std::to_string(stop.last_step) + " iterations at a residual of " +
                               std::to_string(stop.last_residual / right.l2_norm()) + " of the load");
    }
    iterations = static_cast<int>(control.last_step());
    for (Index k = 0; k < right.size(); ++k)
      x[k] = y[k];
  }
};

StaticEquations::StaticEquations(const NodeMatrix &stiffness, const std::vector<Vector3> &nodes, Fixed fixed,
                                 LinearSolver kind) {
  bool any = false;
  for (const auto &node : fixed)
    any = any || node[0] || node[1] || node[2];
  if (!any) throw std::invalid_argument("elastic solid: nothing is fixed, a static solution is not unique");
  if (kind == LinearSolver::automatic) {
    const bool linear = stiffness.column.size() <= linear_blocks * nodes.size();
    const std::size_t most = linear ? direct_nodes_linear : direct_nodes_quadratic;
    kind = nodes.size() <= most ? LinearSolver::direct : LinearSolver::multigrid;
  }
  ensure_mpi();
  parts_ = std::make_unique<Parts>();
  parts_->kind = kind;
  parts_->fixed = std::move(fixed);
  const Index n = 3 * static_cast<Index>(nodes.size());
  dealii::DynamicSparsityPattern rows(n, n);
  for_entries(stiffness, parts_->fixed, [&](Index r, Index c, double) { rows.add(r, c); });
  if (kind == LinearSolver::direct)
    parts_->factorise(stiffness, rows);
  else
    parts_->aggregate(stiffness, rows, nodes);
}

StaticEquations::~StaticEquations() = default;
StaticEquations::StaticEquations(StaticEquations &&) noexcept = default;
StaticEquations &StaticEquations::operator=(StaticEquations &&) noexcept = default;

void StaticEquations::solve(const NodeMatrix &stiffness, const std::vector<Vector3> &load,
                            std::vector<Vector3> &x) const {
  const Fixed &fixed = parts_->fixed;
  std::vector<Vector3> prescribed(x.size(), Vector3{}), brought;
  for (std::size_t i = 0; i < x.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k)
      if (fixed[i][k]) prescribed[i][k] = x[i][k];
  multiply(stiffness, prescribed, brought);
  const Index n = 3 * static_cast<Index>(x.size());
  dealii::Vector<double> right(n), solution(n);
  for (std::size_t i = 0; i < x.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k)
      if (!fixed[i][k])
        right[equation_of(i, k)] = load[i][k] - brought[i][k], solution[equation_of(i, k)] = x[i][k];
  if (right.l2_norm() == 0) {
    solution = 0;
  } else if (parts_->kind == LinearSolver::direct) {
    parts_->direct.vmult(solution, right);
  } else {
    parts_->by_gradients(right, solution);
  }
  for (std::size_t i = 0; i < x.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k)
      if (!fixed[i][k]) x[i][k] = solution[equation_of(i, k)];
}

LinearSolver StaticEquations::kind() const {
  return parts_->kind;
}

int StaticEquations::iterations() const {
  return parts_->iterations;
}

} // namespace platen::fem
