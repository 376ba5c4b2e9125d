// Static equilibrium of a network whose bonds yield, by increments of prescribed motion between states of
// rest, each by Newton's method on the forces of the bond law, with its tangent, and the linear solver of
// equilibrium.h. For yielding parallel bonds, intact or broken before; without contacts of other pairs.
#pragma once

#include "dem/equilibrium.h"

namespace platen::dem {

struct YieldingSettings {
  double tolerance = 1e-8; // of the unbalanced forces over the external forces
  int most_solves = 60;    // linear solves per increment
  StaticSettings linear;   // of each solve
};
struct YieldingStep {
  int solves = 0;
  double residual = 0; // over the external forces, as for the tolerance
  StaticState moved;   // from the last state of rest
};

// Moves a network at rest to its equilibrium under the case: `prescribed` are motions from here with small
// rotations; `force` and `torque` are the total loads on the particles. Positions, orientations and bond
// histories become those of the new state; velocities stay. Bonds yield along the straight path between
// states, so that increments must be small where the path bends.
//
// Throws std::invalid_argument if bonds follow another law, or the case does not fit the particles
// (require_fitting) or has supports; NoEquilibrium if a bond would break, because the released energy needs
// inertia, or if the residual does not fall. Then nothing is changed. The result is the same on any number of
// threads, to the last bit.
YieldingStep settle(Particles &particles, Bonds &bonds, const StaticCase &load,
                    const YieldingSettings &settings = {});

} // namespace platen::dem
