#include "fem/block_rows.h"

#include <algorithm>

#include "base/parallel.h"

namespace platen::fem {

double *BlockRows::block(std::size_t row, int col) {
  const auto first = column.begin() + static_cast<std::ptrdiff_t>(begin[row]);
  const auto last = column.begin() + static_cast<std::ptrdiff_t>(begin[row + 1]);
  return &values[9 * static_cast<std::size_t>(std::lower_bound(first, last, col) - column.begin())];
}

void BlockRows::multiply(const std::vector<Vector3> &x, std::vector<Vector3> &y) const {
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

} // namespace platen::fem
