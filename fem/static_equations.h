// Static equations of a solid: stiffness times displacement = load, with some components prescribed.
#pragma once

#include <memory>
#include <vector>

#include "fem/node_matrix.h"

namespace platen::fem {

// automatic: by size, the faster one over the solves of a run by bench/results/platen_solve.md.
enum class LinearSolver {
  automatic,
  direct,   // UMFPACK, factorised once
  multigrid // conjugate gradients with smoothed aggregation (Trilinos ML) that uses the rigid motions
};

class StaticEquations {
public:
  // Fixed components keep the values that solve() receives. Throws std::invalid_argument where nothing is
  // fixed. Initialises MPI where nobody has, since Trilinos requires it.
  StaticEquations(const NodeMatrix &stiffness, const std::vector<Vector3> &nodes, Fixed fixed,
                  LinearSolver kind = LinearSolver::automatic);
  ~StaticEquations();
  StaticEquations(StaticEquations &&) noexcept;
  StaticEquations &operator=(StaticEquations &&) noexcept;

  // Displacements (m) under nodal loads (N). On entry `x` holds the fixed components and, for multigrid, a
  // guess of the others. Residual of the free components at most 1e-12 of the loads (including those of
  // prescribed motions). Throws std::runtime_error where the gradients do not reach that.
  void solve(const NodeMatrix &stiffness, const std::vector<Vector3> &load, std::vector<Vector3> &x) const;

  LinearSolver kind() const; // direct or multigrid
  int iterations() const;    // of the last solve; 0 for a direct one

private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

} // namespace platen::fem
