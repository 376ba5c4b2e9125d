// A sparse matrix of dense blocks, row by row: one row and one column of blocks per particle, cluster of
// particles or node.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace platen {

// Square; blocks are n x n, stored by columns.
template <int n, class Real>
struct BlockMatrix {
  std::vector<std::size_t> begin{0}; // first block of each row, one entry more than rows
  std::vector<int> column;           // of each block
  std::vector<Real> block;

  std::size_t rows() const { return begin.size() - 1; }
  Real *at(std::size_t k) { return block.data() + k * n * n; }
  const Real *at(std::size_t k) const { return block.data() + k * n * n; }
  // The block (row, col), which must exist; the columns of the row must ascend.
  Real *find(std::size_t row, int col) {
    const auto first = column.begin() + static_cast<std::ptrdiff_t>(begin[row]);
    const auto last = column.begin() + static_cast<std::ptrdiff_t>(begin[row + 1]);
    return at(static_cast<std::size_t>(std::lower_bound(first, last, col) - column.begin()));
  }
  // Sets all blocks to zero.
  void clear_blocks() { block.assign(column.size() * n * n, Real{}); }
};

} // namespace platen
