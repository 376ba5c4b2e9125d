// Static equilibrium of a network whose bonds yield: from rest to rest by increments of what is prescribed,
// each by Newton's method on the forces of the bonds' law, with its tangent, and the linear solver of
// equilibrium.h. For yielding parallel bonds, whole ones or broken before; without contacts of other pairs.
#pragma once

#include "dem/equilibrium.h"

namespace platen::dem {

struct YieldingSettings {
  double tolerance = 1e-8; // of what is out of balance, over what acts on the network from outside
  int most_solves = 60;    // linear ones, of an increment
  StaticSettings linear;   // of each solve
};
struct YieldingStep {
  int solves = 0;
  double residual = 0; // over what acts from outside, as the tolerance
  StaticState moved;   // from the last state of rest
};

// Takes a network at rest to where it rests under the case: `prescribed` are motions from here, small in
// rotation; `force` and `torque` all that act on the particles then. Positions, orientations and what bonds
// remember are those of the new state; velocities stay. Bonds that yield do so along the way straight from
// state to state, so that increments are to be as small as their kinks ask for.
//
// Throws std::invalid_argument where bonds do not yield so, the case does not fit the particles
// (require_fitting) or has supports; NoEquilibrium where a bond would break, which sets free what inertia has
// to carry off, or the residual does not fall. Then nothing is changed. The same on any number of threads, to
// the last bit.
YieldingStep settle(Particles &particles, Bonds &bonds, const StaticCase &load,
                    const YieldingSettings &settings = {});

} // namespace platen::dem
