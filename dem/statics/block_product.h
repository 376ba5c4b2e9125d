// Products of sparse matrices of dense blocks with vectors, on any number of threads.
#pragma once

#include <cstddef>

#include "base/block_matrix.h"
#include "base/parallel.h"

namespace platen::dem::statics {

// Rows that a thread takes at a time; each costs some hundred multiplications.
constexpr std::size_t rows_per_part = 128;

// Adds a block times x to y.
template <int n, class Real>
inline void add_product(const Real *block, const Real *x, Real *y) {
  for (int c = 0; c < n; ++c)
    for (int r = 0; r < n; ++r)
      y[r] += block[n * c + r] * x[c];
}

// done(row, A x of that row) for every row, on any number of threads; each row is summed in its own order.
template <int n, class Real, class Done>
void for_each_product(const BlockMatrix<n, Real> &a, const Real *x, const Done &done) {
  for_each(
      a.rows(),
      [&](std::size_t row) {
        Real sum[n] = {};
        for (std::size_t k = a.begin[row]; k < a.begin[row + 1]; ++k)
          add_product<n>(a.at(k), x + n * static_cast<std::size_t>(a.column[k]), sum);
        done(row, static_cast<const Real *>(sum));
      },
      rows_per_part);
}

} // namespace platen::dem::statics
