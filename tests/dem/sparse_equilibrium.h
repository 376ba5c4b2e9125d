// The same equilibrium as dem/equilibrium.h by other means: one sparse matrix, Eigen's conjugate gradients
// and its incomplete Cholesky factor.
#pragma once

#include "dem/equilibrium.h"

namespace platen::dem::examples {

StaticState solve_sparse(const Particles &particles, const Bonds &bonds, const StaticCase &load,
                         const StaticSettings &settings);

} // namespace platen::dem::examples
