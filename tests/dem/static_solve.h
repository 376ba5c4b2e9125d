// Static equilibrium of a few bonded spheres, for tests: Newton's method on the forces of the bond kernel
// itself, with a tangent from finite differences of those forces.
#pragma once

#include <vector>

#include "dem/model.h"

namespace platen::dem::examples {

struct PointLoad {
  std::size_t particle = 0; // row
  Vector3 force, torque;    // N, N m
};

// Moves all but the clamped rows until bonds balance the loads to round-off, at least to `tolerance` of the
// largest load. Lengths of the finite differences are scaled by `length` (m). Throws std::runtime_error if it
// does not converge.
void solve_statics(Model &model, const std::vector<std::size_t> &clamped, const std::vector<PointLoad> &loads,
                   double length, double tolerance = 1e-7);

} // namespace platen::dem::examples
