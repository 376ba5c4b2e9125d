// Friction of a contact that is bonded until it has slid too far or is pulled off: cohesion that falls with
// slip in a straight line, beside Coulomb's friction, as between steel and the concrete in a tube. A law is a
// value; signs, spring and dissipated work are those of coulomb_friction.h.
#pragma once

#include <algorithm>
#include <limits>

#include "dem/laws/coulomb_friction.h"

namespace platen::dem {

// |T| <= mu N + w c where pressed (N >= 0), |T| / c + |N| / s <= w where pulled: one line, with the corner at
// N = 0. The part w of the bond that is left begins at 1, loses d / s_0 in a slip d, and never grows. In
// tension it is elastic to s, then falls in a straight line to 0 at the opening s_0, and unloads to the
// origin: damage, with w = (s_0 - g) / (s_0 - s / k_n) at the largest opening g. Where a line falls more
// steeply than its spring, c / s_0 >= k_t or s / s_0 >= k_n, the bond breaks at once, as with s_0 = 0: then
// Coulomb's friction alone is left. The work to lose all of it is c s_0 / 2 in shear and s s_0 / 2 in
// tension.
//
// The limits hold at the end of a step: size - k_t d = limit - d c / s_0. These are straight lines, so that
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

  // N/m, of the part w that is left, while it is pulled: k_n as long as it is whole.
  double stiffness(double left, double k_n) const {
    const auto &p = parameters;
    return left > 0 ? left * p.tension / ((1 - left) * p.slip + left * p.tension / k_n) : 0;
  }
  // w after an opening of the spring k_n (m).
  double left_at(double opening, double left, double k_n) const {
    const double s_0 = parameters.slip, elastic = parameters.tension / k_n; // m
    if (!(opening > (1 - left) * s_0 + left * elastic)) return left;
    return s_0 > elastic ? std::max(0.0, (s_0 - opening) / (s_0 - elastic)) : 0;
  }

  // `left`: w, after the opening of this step. normal_force: N, negative where pulled.
  Result operator()(State &state, double &left, const Vector3 &stretch, double normal_force,
                    double tangential_stiffness) const {
    const auto [mu, c, s, s_0] = parameters;
    const Vector3 trial = state.spring + tangential_stiffness * stretch;
    const double size = norm(trial), rubs = mu * std::max(0.0, normal_force),
                 whole = std::max(0.0, left - std::max(0.0, -normal_force) / s),
                 over = size - rubs - c * whole;
    if (left > 0 && !(over > 0)) return CoulombFriction::hold(state, trial);
    const double softer = tangential_stiffness * s_0 - c; // N: above 0 unless it breaks at once
    if (left > 0 && softer > 0) {
      const double slip = over * s_0 / softer;
      const bool ends = slip >= whole * s_0; // where it is pulled: of the cohesion that the pull has left
      left = std::max(0.0, left - (ends ? size / tangential_stiffness : slip) / s_0);
      if (left > 0)
        return CoulombFriction::slide(state, trial, size, ends ? 0 : size - tangential_stiffness * slip,
                                      tangential_stiffness);
    }
    left = 0;
    return CoulombFriction{{mu, mu}}(state, stretch, normal_force, tangential_stiffness);
  }
};

} // namespace platen::dem
