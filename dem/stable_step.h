// The largest time step of the explicit scheme, from the assembled stiffness of bonds, contacts and platen
// springs.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "dem/bonds.h"
#include "dem/contacts.h"
#include "dem/particles.h"

namespace platen::dem {

// A particle on a surface spring: force -kn n (n.u) - kt (u - n (n.u)) for the displacement u of its contact
// point.
struct GroundSpring {
  int particle = 0;
  Vector3 normal, arm;                                   // arm: from the centre to the contact point, m
  double normal_stiffness = 0, tangential_stiffness = 0; // N/m
  double rotational_stiffness = 0;                       // N m/rad, about the centre
  double gap = 0; // m, positive: open; the time step treats it as closed
};

struct StableStep {
  double limit = 0;     // s, 2 / omega_max, less with dashpots; infinite where nothing is stiff
  double omega = 0;     // rad/s, upper estimate of the highest frequency
  int iterations = 0;   // of the Lanczos process
  int particle_id = -1; // id of the particle that moves most in the highest mode; -1 if not searched
  std::string reason;   // one sentence
};

// Fractions of critical damping of what acts in parallel to the springs, and of the scheme.
struct DashpotFractions {
  double bonds = 0, contacts = 0, surfaces = 0;
  double local = 0;  // alpha, 0 ... 1
  double scheme = 1; // phi of Tchamwa and Wielgosz: divides the limit by sqrt(2 phi - 1)
};

// Lanczos on M^-1/2 K M^-1/2; the residual of the largest Ritz value is added, so that the estimate is from
// above. `dashpots`: fractions of critical damping, which reduce the limit, by the factor sqrt(1 + xi^2) - xi
// for a single mode of damping ratio xi. `bonds`, `contacts` may be null. Local damping alpha divides the
// limit by sqrt(1 + alpha): if each step reverses the velocity, it acts as a stiffness.
// `sought_below` (s): the particle that sets the limit is searched only below this value, which costs half as
// much again as the limit. Above it, the returned limit may be too small, but not below this value.
StableStep stable_step(const Particles &particles, const Bonds *bonds, const Contacts *contacts,
                       const std::vector<GroundSpring> &ground, const DashpotFractions &dashpots,
                       double sought_below = std::numeric_limits<double>::infinity());

} // namespace platen::dem
