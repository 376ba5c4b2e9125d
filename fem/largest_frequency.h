// The highest angular frequency of a discrete solid, which limits explicit steps.
#pragma once

#include <array>
#include <vector>

#include "fem/block_rows.h"

namespace platen::fem {

// Which components of a node are prescribed by the machine, one row per node.
using Fixed = std::vector<std::array<char, 3>>;

// Largest eigenvalue of mass^-1 stiffness on the components that are not fixed (1/s^2), never below it but
// for round-off: the largest Ritz value of Lanczos' method plus its residual (Zhou and Li 2011), iterated
// until the two agree to 1 %, and not above `bound`. The start is the same each time.
double largest_eigenvalue(const BlockRows &stiffness, const std::vector<double> &mass, const Fixed &fixed,
                          double bound);

} // namespace platen::fem
