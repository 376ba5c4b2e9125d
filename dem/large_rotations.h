// Static equilibrium of a bonded network that moves and turns far, by Newton's method on the forces of the
// bonds themselves.
#pragma once

#include "dem/equilibrium.h"

namespace platen::dem {

struct LargeSettings {
  double tolerance = 1e-9;  // of the residual, over the loads or the bonds' own forces, whichever are larger
  int most_iterations = 30; // of Newton's method in a load step
  int load_steps = 1;       // to begin with; a step that does not converge is halved
  double smallest_step = 1e-4;
};
struct LargeResult {
  int load_steps = 0, iterations = 0; // of Newton's method, those of steps that were halved too
  double residual = 0;
};

// Moves and turns the particles, from where they are, to the equilibrium of their bonds with the case, whose
// loads keep their directions and whose supports pull at points that turn with the particle. Particles come
// to rest there, with the bonds' forces and torques on them (place_at_rest). Strengths are not looked at.
// The tangent is exact but for its skew part, which vanishes without external torques. Throws NoEquilibrium
// (particles are then where the last load step that converged has left them), std::invalid_argument where
// particles do not turn or columns of loads do not fit.
LargeResult solve_static_far(Particles &particles, const Bonds &bonds, const StaticCase &load,
                             const LargeSettings &settings = {});

// Puts a linear solution into the particles: positions, orientations, no velocities, and forces and torques
// of the bonds as they are then, so that an explicit run may go on from there.
void move_to(const StaticState &state, Particles &particles, const Bonds &bonds);
// No velocities, and forces and torques of the bonds alone.
void place_at_rest(Particles &particles, const Bonds &bonds);

} // namespace platen::dem
