#include "fem/block_rows.h"

#include <deal.II/base/parallel.h>

#include <algorithm>

namespace platen::fem {
namespace {

// Fewer rows than this are not worth a second thread.
constexpr unsigned int rows_per_task = 512;

} // namespace

double *BlockRows::block(std::size_t row, int col) {
  const auto first = column.begin() + static_cast<std::ptrdiff_t>(begin[row]);
  const auto last = column.begin() + static_cast<std::ptrdiff_t>(begin[row + 1]);
  return &values[9 * static_cast<std::size_t>(std::lower_bound(first, last, col) - column.begin())];
}

void BlockRows::multiply(const std::vector<Vector3> &x, std::vector<Vector3> &y) const {
  y.resize(rows());
  const auto some_rows = [&](std::size_t first, std::size_t last) {
    for (std::size_t r = first; r < last; ++r) {
      double s0 = 0, s1 = 0, s2 = 0;
      for (std::size_t k = begin[r]; k < begin[r + 1]; ++k) {
        const double *a = &values[9 * k];
        const Vector3 &p = x[static_cast<std::size_t>(column[k])];
        s0 += a[0] * p[0] + a[1] * p[1] + a[2] * p[2];
        s1 += a[3] * p[0] + a[4] * p[1] + a[5] * p[2];
        s2 += a[6] * p[0] + a[7] * p[1] + a[8] * p[2];
      }
      y[r] = {s0, s1, s2};
    }
  };
  if (rows() <= 2 * rows_per_task) return some_rows(0, rows());
  dealii::parallel::apply_to_subranges(std::size_t{0}, rows(), some_rows, rows_per_task);
}

double dot(const std::vector<Vector3> &a, const std::vector<Vector3> &b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    sum += dot(a[i], b[i]);
  return sum;
}

} // namespace platen::fem
