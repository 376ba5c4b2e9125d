// Friction that decreases from a static to a dynamic coefficient as a contact slides. Laws are values:
// parameters, state, one call operator. Signs, spring and dissipated work are those of coulomb_friction.h.
#pragma once

#include <cmath>

#include "base/portable.h"
#include "dem/laws/coulomb_friction.h"

namespace platen::dem {

// mu(s) = mu_d + (mu_s - mu_d) s_0 / (s_0 + s), s the slip path since the contact closed: no recovery at rest
// (the form of Cusatis et al. 2011 for platens of concrete specimens). s_0: slip at half of the difference.
// The limit holds at the end of the step, from a quadratic equation, so that the dissipated work is that of
// mu(s) N over s to second order in the step. Where the limit falls more steeply than the spring, (mu_s -
// mu_d) N s_0 > k_t (s_0 + s)^2, the contact jumps to the point where both agree again.
struct SlipWeakeningFriction {
  struct Parameters {
    double friction_static = std::numeric_limits<double>::quiet_NaN();  // 1, >= friction_dynamic
    double friction_dynamic = std::numeric_limits<double>::quiet_NaN(); // 1, >= 0
    double slip_length = std::numeric_limits<double>::quiet_NaN();      // m, s_0 > 0
  };
  using State = CoulombFriction::State;
  using Result = CoulombFriction::Result;

  Parameters parameters;

  double coefficient(double slip) const {
    const double s_0 = parameters.slip_length;
    return parameters.friction_dynamic +
           (parameters.friction_static - parameters.friction_dynamic) * s_0 / (s_0 + slip);
  }

  Result operator()(State &state, const Vector3 &stretch, double normal_force,
                    double tangential_stiffness) const {
    const Vector3 trial = state.spring + tangential_stiffness * stretch;
    if (!(normal_force > 0)) return CoulombFriction::let_go(state, trial, tangential_stiffness);
    const double size = norm(trial);
    if (!(size > coefficient(state.slip) * normal_force)) return CoulombFriction::hold(state, trial);
    const double slip = slip_of_step(state.slip, size, normal_force, tangential_stiffness);
    return CoulombFriction::slide(state, trial, size, coefficient(state.slip + slip) * normal_force,
                                  tangential_stiffness);
  }

private:
  // The d of  size - k d = mu(s + d) N, that is  k d^2 - b d - c = 0  with c > 0: one positive root.
  double slip_of_step(double s, double size, double normal_force, double k) const {
    const double s_0 = parameters.slip_length, over = size - parameters.friction_dynamic * normal_force,
                 fall = (parameters.friction_static - parameters.friction_dynamic) * normal_force;
    const double b = over - k * (s_0 + s), c = over * (s_0 + s) - fall * s_0;
    const double root = std::sqrt(b * b + 4 * k * c);
    return b > 0 ? (b + root) / (2 * k) : 2 * c / (root - b);
  }
};

// mu(v) = mu_d + (mu_s - mu_d) exp(-v / v_0), v the relative speed of the two sides over the step (Stribeck's
// decrease in the exponential form of Andersson et al. 2007 with exponent 1, without the viscous rise). At
// rest the static coefficient returns at once.
struct VelocityWeakeningFriction {
  struct Parameters {
    double friction_static = std::numeric_limits<double>::quiet_NaN();  // 1, >= friction_dynamic
    double friction_dynamic = std::numeric_limits<double>::quiet_NaN(); // 1, >= 0
    double slip_velocity = std::numeric_limits<double>::quiet_NaN();    // m/s, v_0 > 0
  };
  using State = CoulombFriction::State;
  using Result = CoulombFriction::Result;

  Parameters parameters;

  double coefficient(double speed) const {
    return parameters.friction_dynamic + (parameters.friction_static - parameters.friction_dynamic) *
                                             portable::exp(-speed / parameters.slip_velocity);
  }

  // dt: s, duration of the stretch.
  Result operator()(State &state, const Vector3 &stretch, double normal_force, double tangential_stiffness,
                    double dt) const {
    const Vector3 trial = state.spring + tangential_stiffness * stretch;
    if (!(normal_force > 0)) return CoulombFriction::let_go(state, trial, tangential_stiffness);
    const double size = norm(trial), most = coefficient(norm(stretch) / dt) * normal_force;
    if (!(size > most)) return CoulombFriction::hold(state, trial);
    return CoulombFriction::slide(state, trial, size, most, tangential_stiffness);
  }
};

} // namespace platen::dem
