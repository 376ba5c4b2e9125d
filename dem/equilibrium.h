// Static equilibrium of a bonded network under loads and moving supports, from the tangent stiffness of its
// bonds, by conjugate gradients with a multigrid: for problems without inertia. Linear: bonds neither yield
// nor break, and rotations are small; dem/yielding_equilibrium.h is for bonds that yield.
#pragma once

#include <memory>
#include <stdexcept>
#include <vector>

#include "dem/bonds.h"
#include "dem/particles.h"
#include "dem/stable_step.h"

namespace platen::dem {

// A spring from the particle to a body that has moved.
struct Support {
  GroundSpring spring;
  Vector3 moved; // m, of the body where the spring acts
};
// A particle whose motion is prescribed.
struct PrescribedMotion {
  int particle = 0;
  Vector3 displacement, turn; // m, rad
};
struct StaticCase {
  std::vector<Support> supports;
  std::vector<PrescribedMotion> prescribed; // each particle at most once; overrides its supports
  std::vector<Vector3> force, torque;       // N, N m, on every particle; empty: none
};
struct StaticSettings {
  double tolerance = 1e-8; // of the residual over the loads, in N, torques divided by the radius
  int most_iterations = 20000;
};
struct StaticState {
  std::vector<Vector3> displacement, turn; // m, rad; of every particle
  int iterations = 0;
  double residual = 0; // over the loads
};

struct NoEquilibrium : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Throws std::invalid_argument if columns of loads do not fit the particles, a particle row does not exist or
// a particle is prescribed twice.
void require_fitting(const Particles &particles, const StaticCase &load);

// Response of bonds in their present directions, without forces in them, to the case. Spheres and pieces
// without support and load stay where they are. A network that its supports leave free to move as a rigid
// body comes to rest at one of its equilibria, if the loads have any. Throws NoEquilibrium if the loads of an
// unsupported piece do not balance or the residual does not fall to the tolerance, and std::invalid_argument
// as require_fitting. The result is the same on any number of threads, to the last bit.
StaticState solve_static(const Particles &particles, const Bonds &bonds, const StaticCase &load,
                         const StaticSettings &settings = {});

// The same for several cases of one network, which must not change: its stiffness is assembled once, and the
// multigrid is kept while the prescribed particles are the same.
class EquilibriumSolver {
public:
  EquilibriumSolver(const Particles &particles, const Bonds &bonds);
  // With these stiffnesses of the bonds' rows (N/m, N m) instead of those at rest. Throws
  // std::invalid_argument if there is not one per row.
  EquilibriumSolver(const Particles &particles, const Bonds &bonds,
                    const std::vector<BondStiffness> &of_rows);
  ~EquilibriumSolver();

  // `start`, if given: initial guess, the solution of a similar case.
  StaticState solve(const StaticCase &load, const StaticSettings &settings = {},
                    const StaticState *start = nullptr);

  struct Implementation;

private:
  std::unique_ptr<Implementation> implementation_;
};

} // namespace platen::dem
