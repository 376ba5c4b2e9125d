#include "fem/node_matrix.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "base/lanczos.h"
#include "base/parallel.h"
#include "fem/widths.h"

namespace platen::fem {

namespace {

struct Mode {
  std::vector<Vector3> u;
};

typedef double Four __attribute__((vector_size(32)));

// Reads three entries of a column and one that is not used.
inline __attribute__((always_inline)) void read(const double *from, Four &to) {
  std::memcpy(&to, from, sizeof to);
}

// Processes a column of a block at once: four numbers, of which the last belongs to the next column; the last
// column of all has no next one. The same sums as one by one.
PLATEN_WIDTHS void multiply_rows(const NodeMatrix &a, const Vector3 *x, std::size_t first, std::size_t last,
                                 Vector3 *y) {
  const std::size_t end = a.column.size();
  const double *block = a.block.data();
  for (std::size_t r = first; r < last; ++r) {
    Four sum{};
    for (std::size_t k = a.begin[r]; k < a.begin[r + 1]; ++k) {
      const double *m = block + 9 * k;
      const Vector3 &p = x[a.column[k]];
      Four columns[3]{};
      read(m, columns[0]), read(m + 3, columns[1]);
      if (k + 1 < end)
        read(m + 6, columns[2]);
      else
        columns[2] = Four{m[6], m[7], m[8], 0};
      sum += (p.x * columns[0] + p.y * columns[1]) + p.z * columns[2];
    }
    y[r] = {sum[0], sum[1], sum[2]};
  }
}

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
  constexpr std::size_t rows_at_once = 64; // per task: more than a thousand blocks
  y.resize(a.rows());
  for_each_block(
      a.rows(),
      [&](std::size_t first, std::size_t last, std::size_t) {
        multiply_rows(a, x.data(), first, last, y.data());
      },
      rows_at_once);
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
