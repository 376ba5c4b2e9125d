#include "fem/node_matrix.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "base/parallel.h"

namespace platen::fem {

namespace {

constexpr int most_iterations = 300;
constexpr double agreed = 0.01; // residual over Ritz value

// Eigenvalues of a symmetric tridiagonal matrix above x, by the signs of its pivots (Sturm).
int count_above(const std::vector<double> &diagonal, const std::vector<double> &beside, double x) {
  int count = 0;
  double pivot = 1;
  for (std::size_t k = 0; k < diagonal.size(); ++k) {
    pivot = diagonal[k] - x - (k == 0 ? 0 : beside[k - 1] * beside[k - 1] / pivot);
    if (pivot == 0) pivot = -1e-300;
    count += pivot > 0;
  }
  return count;
}

double largest_of(const std::vector<double> &diagonal, const std::vector<double> &beside) {
  double low = *std::max_element(diagonal.begin(), diagonal.end()), high = low;
  for (std::size_t k = 0; k < diagonal.size(); ++k)
    high = std::max(high, diagonal[k] + (k > 0 ? beside[k - 1] : 0) + (k < beside.size() ? beside[k] : 0));
  for (int halvings = 0; halvings < 60; ++halvings) {
    const double middle = 0.5 * (low + high);
    (count_above(diagonal, beside, middle) > 0 ? low : high) = middle;
  }
  return high;
}

// Last component of the unit eigenvector of the largest eigenvalue: the residual is it times the next entry.
double last_component(const std::vector<double> &diagonal, const std::vector<double> &beside, double value) {
  double before = 0, now = 1, sum = 1;
  for (std::size_t k = 0; k + 1 < diagonal.size(); ++k) {
    const double next = ((value - diagonal[k]) * now - (k == 0 ? 0 : beside[k - 1] * before)) / beside[k];
    before = now, now = next, sum += now * now;
  }
  return std::abs(now) / std::sqrt(sum);
}

} // namespace

double *NodeMatrix::block(std::size_t row, int col) {
  const auto first = column.begin() + static_cast<std::ptrdiff_t>(begin[row]);
  const auto last = column.begin() + static_cast<std::ptrdiff_t>(begin[row + 1]);
  return &values[9 * static_cast<std::size_t>(std::lower_bound(first, last, col) - column.begin())];
}

void NodeMatrix::multiply(const std::vector<Vector3> &x, std::vector<Vector3> &y) const {
  y.resize(rows());
  for_each(rows(), [&](std::size_t r) {
    double s0 = 0, s1 = 0, s2 = 0;
    for (std::size_t k = begin[r]; k < begin[r + 1]; ++k) {
      const double *a = &values[9 * k];
      const Vector3 &p = x[static_cast<std::size_t>(column[k])];
      s0 += a[0] * p[0] + a[1] * p[1] + a[2] * p[2];
      s1 += a[3] * p[0] + a[4] * p[1] + a[5] * p[2];
      s2 += a[6] * p[0] + a[7] * p[1] + a[8] * p[2];
    }
    y[r] = {s0, s1, s2};
  });
}

double dot(const std::vector<Vector3> &a, const std::vector<Vector3> &b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    sum += dot(a[i], b[i]);
  return sum;
}

double largest_eigenvalue(const NodeMatrix &stiffness, const std::vector<double> &mass, const Fixed &fixed,
                          double bound) {
  const std::size_t n = mass.size();
  std::vector<Vector3> now(n), before(n, Vector3{}), scaled(n), next(n);
  std::uint64_t random = 88172645463325252ull;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      random ^= random << 13, random ^= random >> 7, random ^= random << 17; // Marsaglia 2003
      now[i][k] = fixed[i][k] ? 0.0 : static_cast<double>(random >> 11) / 9007199254740992.0 - 0.5;
    }
  double length = std::sqrt(dot(now, now)), value = 0, residual = 0;
  if (length == 0) return 0;
  for (Vector3 &p : now)
    p = (1 / length) * p;
  std::vector<double> diagonal, beside;
  for (int k = 0; k < most_iterations; ++k) {
    for (std::size_t i = 0; i < n; ++i)
      scaled[i] = (1 / std::sqrt(mass[i])) * now[i];
    stiffness.multiply(scaled, next);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t c = 0; c < 3; ++c)
        next[i][c] = fixed[i][c] ? 0.0 : next[i][c] / std::sqrt(mass[i]);
    diagonal.push_back(dot(next, now));
    for (std::size_t i = 0; i < n; ++i)
      next[i] = next[i] - diagonal.back() * now[i] - (k == 0 ? 0 : beside.back()) * before[i];
    const double size = std::sqrt(dot(next, next));
    value = largest_of(diagonal, beside);
    residual = size * last_component(diagonal, beside, value);
    // A few rounds first: an early Ritz value may sit on a lower eigenvalue.
    if (size <= 1e-12 * value || (k >= 20 && residual <= agreed * value)) break;
    beside.push_back(size);
    before.swap(now);
    for (std::size_t i = 0; i < n; ++i)
      now[i] = (1 / size) * next[i];
  }
  return std::min(value + residual, bound);
}

} // namespace platen::fem
