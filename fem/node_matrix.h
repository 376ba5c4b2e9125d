// A square matrix of 3 x 3 blocks in rows, one row and one column per node.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "base/vector3.h"

namespace platen::fem {

struct NodeMatrix {
  std::vector<std::size_t> begin; // of each row in `column`; one more than there are rows
  std::vector<int> column;        // ascending within a row
  std::vector<double> values;     // nine per block, row by row

  std::size_t rows() const { return begin.empty() ? 0 : begin.size() - 1; }
  // The block at (row, col), which must be there.
  double *block(std::size_t row, int col);
  // y = A x. Each row is summed in the order of its blocks by one thread: bitwise the same for any number of
  // threads. x and y must not be the same vector.
  void multiply(const std::vector<Vector3> &x, std::vector<Vector3> &y) const;
};

// Sums over nodes, in their order.
double dot(const std::vector<Vector3> &a, const std::vector<Vector3> &b);

// The highest angular frequency of a discrete solid, which limits explicit steps.
//
// Which components of a node are prescribed by the machine, one row per node.
using Fixed = std::vector<std::array<char, 3>>;

// Largest eigenvalue of mass^-1 stiffness on the components that are not fixed (1/s^2), never below it but
// for round-off: the largest Ritz value of Lanczos' method plus its residual (Zhou and Li 2011), iterated
// until the two agree to 1 %, and not above `bound`. The start is the same each time.
double largest_eigenvalue(const NodeMatrix &stiffness, const std::vector<double> &mass, const Fixed &fixed,
                          double bound);

} // namespace platen::fem
