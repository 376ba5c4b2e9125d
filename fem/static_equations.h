// Static equations of a solid: stiffness times displacement = load, some components given.
#pragma once

#include <memory>
#include <vector>

#include "fem/node_matrix.h"

namespace platen::fem {

// automatic: by size, as bench/results/platen_solve.md found the faster over the solves of a run.
enum class LinearSolver {
  automatic,
  direct,   // UMFPACK, factorised once
  multigrid // conjugate gradients with smoothed aggregation (Trilinos ML) that is told the rigid motions
};

class StaticEquations {
public:
  // Fixed components keep the values they are given in solve(). Throws std::invalid_argument where nothing is
  // fixed. Sets MPI up where nobody has: Trilinos does not go without.
  StaticEquations(const NodeMatrix &stiffness, const std::vector<Vector3> &nodes, Fixed fixed,
                  LinearSolver kind = LinearSolver::automatic);
  ~StaticEquations();
  StaticEquations(StaticEquations &&) noexcept;
  StaticEquations &operator=(StaticEquations &&) noexcept;

  // Displacements (m) under nodal loads (N). Comes with the fixed components and, for multigrid, a guess of
  // the others. Residual of the free components at most 1e-12 of the loads' (of what fixed motions bring,
  // too). Throws std::runtime_error where the gradients do not get there.
  void solve(const NodeMatrix &stiffness, const std::vector<Vector3> &load, std::vector<Vector3> &x) const;

  LinearSolver kind() const; // direct or multigrid
  int iterations() const;    // of the last solve; 0 for a direct one

private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

} // namespace platen::fem
