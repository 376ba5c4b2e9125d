#include "fem/node_matrix.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "base/lanczos.h"
#include "base/parallel.h"

namespace platen::fem {

namespace {

struct Mode {
  std::vector<Vector3> u;
};

double inner(const Mode &a, const Mode &b) {
  return dot(a.u, b.u);
}
void add(Mode &a, double s, const Mode &b) {
  for (std::size_t i = 0; i < a.u.size(); ++i)
    a.u[i] += s * b.u[i];
}
void multiply(Mode &a, double s) {
  for (Vector3 &u : a.u)
    u *= s;
}

} // namespace

void multiply(const NodeMatrix &a, const std::vector<Vector3> &x, std::vector<Vector3> &y) {
  constexpr std::size_t rows_at_once = 64; // of a thread: more than a thousand blocks
  y.resize(a.rows());
  const auto row = [&](std::size_t r) {
    Vector3 sum;
    for (std::size_t k = a.begin[r]; k < a.begin[r + 1]; ++k) {
      const double *m = a.at(k);
      const Vector3 &p = x[static_cast<std::size_t>(a.column[k])];
      sum += {m[0] * p[0] + m[3] * p[1] + m[6] * p[2], m[1] * p[0] + m[4] * p[1] + m[7] * p[2],
              m[2] * p[0] + m[5] * p[1] + m[8] * p[2]};
    }
    y[r] = sum;
  };
  for_each(a.rows(), row, rows_at_once);
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
  Mode start{std::vector<Vector3>(n)}, scaled = start;
  std::uint64_t random = 88172645463325252ull;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      random ^= random << 13, random ^= random >> 7, random ^= random << 17; // Marsaglia 2003
      start.u[i][k] = fixed[i][k] ? 0.0 : static_cast<double>(random >> 11) / 9007199254740992.0 - 0.5;
    }
  if (inner(start, start) == 0) return 0;
  const auto apply = [&](const Mode &x) {
    for (std::size_t i = 0; i < n; ++i)
      scaled.u[i] = (1 / std::sqrt(mass[i])) * x.u[i];
    Mode y;
    multiply(stiffness, scaled.u, y.u);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t c = 0; c < 3; ++c)
        y.u[i][c] = fixed[i][c] ? 0.0 : y.u[i][c] / std::sqrt(mass[i]);
    return y;
  };
  return std::min(platen::largest_eigenvalue(apply, start, {20, 1}, bisected_ritz_value).value, bound);
}

} // namespace platen::fem
