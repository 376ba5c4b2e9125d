// Conjugate gradients on block rows, from a start and with a preconditioner.
#pragma once

#include <vector>

#include "dem/statics/multigrid.h"

namespace platen::dem::statics {

struct Solution {
  int iterations = 0;
  double residual = 0; // over the right hand side, that of the fixed rows included
};

// A x = right in the rows that are not fixed; x is the start, holds what the fixed rows are at, and is the
// answer. The residual is over the larger of `right` and of what the fixed rows bring to it. Ends at the
// tolerance, after so many iterations, or where A turns out to have a negative eigenvalue.
template <int n>
Solution conjugate_gradients(const BlockMatrix<n, double> &a, Multigrid<n> &inverse,
                             const std::vector<char> &fixed, const std::vector<double> &right,
                             std::vector<double> &x, double tolerance, int most_iterations);

} // namespace platen::dem::statics
