// Conjugate gradients on block rows, with a start vector and a preconditioner.
#pragma once

#include <vector>

#include "dem/statics/multigrid.h"

namespace platen::dem::statics {

struct Solution {
  int iterations = 0;
  double residual = 0; // over the right hand side, with the contribution of the fixed rows
};

// Solves A x = right in the rows that are not fixed; x is the start vector, contains the values of the fixed
// rows, and returns the solution. The residual is relative to `right` less the contribution of the fixed
// rows. Ends at the tolerance, after most_iterations, or if A proves to have a negative eigenvalue.
template <int n>
Solution conjugate_gradients(const BlockMatrix<n, double> &a, Multigrid<n> &inverse,
                             const std::vector<char> &fixed, const std::vector<double> &right,
                             std::vector<double> &x, double tolerance, int most_iterations);

} // namespace platen::dem::statics
