// The stiffness between the nodes of a discrete solid, and its largest eigenvalue.
#pragma once

#include <array>
#include <vector>

#include "base/block_matrix.h"
#include "base/vector3.h"

namespace platen::fem {

using NodeMatrix = BlockMatrix<3, double>; // columns ascend within a row

// y = A x. Each row is summed in the order of its blocks by one thread: bitwise the same for any number of
// threads. x and y must not be the same vector.
void multiply(const NodeMatrix &a, const std::vector<Vector3> &x, std::vector<Vector3> &y);

// Sum over nodes, in their order.
double dot(const std::vector<Vector3> &a, const std::vector<Vector3> &b);

// The highest angular frequency of a discrete solid, which limits explicit steps.
//
// Nonzero where the machine prescribes a component of a node, one row per node.
using Fixed = std::vector<std::array<char, 3>>;

// Largest eigenvalue of mass^-1 stiffness on the free components (1/s^2): it limits explicit steps. To 1 %,
// never too low but for round-off, and not above `bound`. The start vector is the same each time.
double largest_eigenvalue(const NodeMatrix &stiffness, const std::vector<double> &mass, const Fixed &fixed,
                          double bound);

} // namespace platen::fem
