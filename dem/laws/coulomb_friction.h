// Coulomb friction with a tangential spring. A law is a value: parameters, state, one call operator.
#pragma once

#include <algorithm>
#include <limits>

#include "base/vector3.h"

namespace platen::dem {

// The spring holds until its force exceeds mu_s N; then it slides at mu_d N, the stored force rescaled to
// that limit with its direction kept, until a trial force below mu_d N sticks again (Cundall and Strack 1979;
// the two coefficients as platen tests on concrete give them). A coefficient of infinity never slides. With
// mu_d > mu_s sliding starts without a rise: the force never exceeds the trial.
struct CoulombFriction {
  struct Parameters {
    double friction_static = std::numeric_limits<double>::quiet_NaN();  // 1, >= 0
    double friction_dynamic = std::numeric_limits<double>::quiet_NaN(); // 1, >= 0
  };
  struct State {
    Vector3 spring;  // N, tangential force; the caller carries it with the contact plane between calls
    int sliding = 0; // 0 sticks, 1 slides
    double slip = 0; // m, path slid since the contact closed
  };
  struct Result {
    Vector3 force;         // N, the new spring force
    double dissipated = 0; // J, lost to sliding in this step
    double slip = 0;       // m, path slid in this step
  };

  Parameters parameters;

  // stretch: relative tangential displacement over the step (m), in the plane of the contact, with the sign
  // that the force is to have: force = + tangential_stiffness stretch. normal_force: N, >= 0 when pressed; 0
  // or less lets go of the spring. tangential_stiffness: N/m, positive.
  //
  // dissipated = 1/2 (T_n + T_n+1) . (T_trial - T_n+1) / k_t: with the spring's energy T^2 / (2 k_t) it adds
  // up to the work of the mean force over the step, exactly, which is the work that the leapfrog sees.
  Result operator()(State &state, const Vector3 &stretch, double normal_force,
                    double tangential_stiffness) const {
    const Vector3 trial = state.spring + tangential_stiffness * stretch;
    if (!(normal_force > 0)) return let_go(state, trial, tangential_stiffness);
    const double size = norm(trial);
    const double slides_above = state.sliding ? parameters.friction_dynamic : parameters.friction_static;
    if (!(size > slides_above * normal_force)) return hold(state, trial);
    return slide(state, trial, size, parameters.friction_dynamic * normal_force, tangential_stiffness);
  }

  // What may become of the spring, for laws with other limits. `trial` is its force where nothing slides (N),
  // `size` the length of that.
  static Result let_go(State &state, const Vector3 &trial, double tangential_stiffness) {
    Result result;
    result.dissipated = 0.5 * dot(state.spring, trial) / tangential_stiffness;
    state = State{};
    return result;
  }
  static Result hold(State &state, const Vector3 &trial) {
    state.sliding = 0;
    state.spring = trial;
    Result result;
    result.force = trial;
    return result;
  }
  static Result slide(State &state, const Vector3 &trial, double size, double most,
                      double tangential_stiffness) {
    const Vector3 before = state.spring;
    const double limit = std::min(size, most);
    Result result;
    state.sliding = 1;
    state.spring = result.force = (limit / size) * trial;
    result.dissipated = 0.5 * dot(before + state.spring, trial - state.spring) / tangential_stiffness;
    result.slip = (size - limit) / tangential_stiffness;
    state.slip += result.slip;
    return result;
  }
};

} // namespace platen::dem
