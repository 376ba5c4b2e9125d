// An approximate inverse of a network's stiffness, for conjugate gradients: neighbouring particles are joined
// to rigid clusters, clusters to larger ones, until a few are left whose equations are solved exactly
// (aggregation multigrid with rigid motions as coarse functions; Braess, Computing 55 (1995) 379-393). A
// level is smoothed by Chebyshev polynomials of the matrix scaled by its diagonal blocks (Adams et al., J.
// Comput. Phys. 188 (2003) 593-610), and calls the next one twice. Single precision, because the inverse is
// approximate anyway and limited by memory access.
#pragma once

#include <vector>

#include "base/vector3.h"
#include "dem/statics/block_product.h"

namespace platen::dem::statics {

// n = 6: displacement and rotation times a length; n = 3: displacement alone.
template <int n>
class Multigrid {
public:
  // For a symmetric matrix without negative eigenvalues. `place`: position of each row, m; `length`: factor
  // on its rotation, m. Rows that are `fixed` have no part in it: their result is 0.
  Multigrid(const BlockMatrix<n, double> &matrix, const std::vector<Vector3> &place,
            const std::vector<double> &length, const std::vector<char> &fixed);
  ~Multigrid();
  Multigrid(Multigrid &&) noexcept;

  // z = B r, with B symmetric and positive; the same for any number of threads.
  void apply(const std::vector<double> &r, std::vector<double> &z);

private:
  struct Level;
  void make_next(const BlockMatrix<n, double> &matrix, std::vector<Vector3> place, std::vector<double> length,
                 std::vector<char> fixed);
  void cycle(std::size_t level, bool rest);
  void visit_next(std::size_t level);

  std::vector<Level> levels_;
};

} // namespace platen::dem::statics
