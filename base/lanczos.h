// The largest eigenvalue of a symmetric matrix that is only available by its products: Lanczos' method.
#pragma once

#include <cmath>
#include <utility>
#include <vector>

namespace platen {

// The largest eigenvalue of a symmetric tridiagonal matrix, and the absolute last component of its unit
// eigenvector. `off_diagonal`: the off-diagonal entries, one fewer, above 0; further ones are not read.
struct LargestRitzValue {
  double value = 0, last_component = 0;
};
using FindRitzValue = LargestRitzValue (*)(const std::vector<double> &diagonal,
                                           const std::vector<double> &off_diagonal);
// Computes all eigenvectors by Eigen: n^3 operations.
LargestRitzValue largest_ritz_value(const std::vector<double> &diagonal,
                                    const std::vector<double> &off_diagonal);
// By bisection: 60 n operations, for calls in every iteration. The value is an upper bound.
LargestRitzValue bisected_ritz_value(const std::vector<double> &diagonal,
                                     const std::vector<double> &off_diagonal);

struct LanczosLimits {
  int least = 4; // iterations before it may end: an early Ritz value may sit on a lower eigenvalue
  int every = 5; // iterations from one Ritz value to the next
  int most = 300;
  double residual = 0.01; // over the Ritz value, at the end
  double enough = 0;      // ends when the value is certainly below this, after `least_for_enough`
  int least_for_enough = 15;
};

template <class Vector>
struct LargestEigenvalue {
  double value = 0; // upper bound but for round-off: the Ritz value plus its residual (Zhou and Li 2011)
  int iterations = 0;
  Vector mode; // approximate
};

// apply(x): the product of the matrix with x. `x`: start vector, not zero. Vector needs the functions
// inner(a, b), add(a, s, b), which is a += s b, and multiply(a, s).
template <class Vector, class Apply>
LargestEigenvalue<Vector> largest_eigenvalue(const Apply &apply, Vector x, const LanczosLimits &limits = {},
                                             FindRitzValue find_ritz_value = largest_ritz_value) {
  multiply(x, 1 / std::sqrt(inner(x, x)));
  Vector before;
  std::vector<double> diagonal, off_diagonal;
  LargestRitzValue ritz;
  double residual = 0;
  int done = 0;
  while (done < limits.most) {
    Vector y = apply(x);
    diagonal.push_back(inner(x, y));
    add(y, -diagonal.back(), x);
    if (done > 0) add(y, -off_diagonal.back(), before);
    const double length = std::sqrt(inner(y, y));
    ++done;
    const bool look = done <= limits.least || done % limits.every == 0 || done == limits.most;
    if (look) {
      ritz = find_ritz_value(diagonal, off_diagonal);
      residual = length * ritz.last_component;
    }
    if (look && done > limits.least && residual <= limits.residual * ritz.value) break;
    if (look && done >= limits.least_for_enough && ritz.value + residual < limits.enough) break;
    if (length <= 1e-14 * ritz.value) break; // the Krylov space is exhausted
    off_diagonal.push_back(length);
    before = std::exchange(x, std::move(y));
    multiply(x, 1 / length);
  }
  return {ritz.value + residual, done, std::move(x)};
}

} // namespace platen
