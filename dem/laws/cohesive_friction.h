// Friction of a contact that is bonded until it has slid too far or is pulled off: cohesion that falls with
// slip in a straight line, beside Coulomb's friction, as between steel and the concrete in a tube. A law is a
// value; signs, spring and dissipated work are those of coulomb_friction.h.
#pragma once

#include <algorithm>
#include <limits>

#include "dem/laws/coulomb_friction.h"

namespace platen::dem {

// |T| <= mu N + w c where pressed (N >= 0), |T| / c + |N| / s <= w where pulled: one line, with the corner at
// N = 0. The part w of the bond that is left begins at 1, loses d / s_0 in a slip d, and never grows. Pulled
// to the end of its line, or with s_0 = 0 where it first slides, the bond breaks at once: w = 0, and
// Coulomb's friction alone is left. So does one whose cohesion falls more steeply than the spring, c / s_0 >=
// k_t.
//
// The limit holds at the end of the step: size - k_t d = limit - d c / s_0. It is a straight line, so that
// force and lost work are those of the law over any step, up to the slip at which the bond ends.
struct CohesiveFriction {
  struct Parameters {
    double friction = std::numeric_limits<double>::quiet_NaN(); // 1, >= 0: mu
    double cohesion = std::numeric_limits<double>::quiet_NaN(); // N, > 0: c
    double tension = std::numeric_limits<double>::quiet_NaN();  // N, > 0: s
    double slip = 0;                                            // m, >= 0: s_0
  };
  using State = CoulombFriction::State;
  using Result = CoulombFriction::Result;

  Parameters parameters;

  // `left`: w. normal_force: N, negative where pulled; what the bond does not hold the caller lets go.
  Result operator()(State &state, double &left, const Vector3 &stretch, double normal_force,
                    double tangential_stiffness) const {
    const auto [mu, c, s, s_0] = parameters;
    const Vector3 trial = state.spring + tangential_stiffness * stretch;
    const double size = norm(trial), whole = left - std::max(0.0, -normal_force) / s, // w at the limit
        limit = mu * std::max(0.0, normal_force) + c * whole, over = size - limit;
    if (left > 0 && whole > 0) {
      if (!(over > 0)) return CoulombFriction::hold(state, trial);
      const double slip = over * s_0 / (tangential_stiffness * s_0 - c); // negative, or none: too steep
      if (slip > 0 && slip < whole * s_0) {
        left -= slip / s_0;
        return CoulombFriction::slide(state, trial, size, size - tangential_stiffness * slip,
                                      tangential_stiffness);
      }
    }
    left = 0;
    return CoulombFriction{{mu, mu}}(state, stretch, normal_force, tangential_stiffness);
  }
};

} // namespace platen::dem
