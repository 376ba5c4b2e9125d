// The static equations of a network by Trilinos: conjugate gradients of AztecOO with smoothed aggregation of
// ML, which is told the rigid motions.
#pragma once

#include <vector>

#include "base/block_matrix.h"
#include "base/vector3.h"

namespace platen::bench {

struct MlSolution {
  double setup_seconds = 0, solve_seconds = 0; // matrix and multigrid, gradients
  int iterations = 0;
  std::vector<double> x;
};
// Displacements and rotations times `length` (m), as in dem/statics/network.h.
MlSolution solve_by_ml(const BlockMatrix<6, double> &a, const std::vector<Vector3> &place,
                       const std::vector<double> &length, const std::vector<double> &right, double tolerance);

} // namespace platen::bench
