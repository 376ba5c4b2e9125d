// Coulomb friction with a tangential spring. A law is a value: parameters, state, one call operator.
#pragma once

#include <algorithm>
#include <limits>

#include "dem/vector3.h"

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
    const Vector3 before = state.spring, trial = before + tangential_stiffness * stretch;
    Result result;
    if (!(normal_force > 0)) {
      state = State{};
      result.dissipated = 0.5 * dot(before, trial) / tangential_stiffness;
      return result;
    }
    const double size = norm(trial);
    const double slides_above = (state.sliding ? parameters.friction_dynamic : parameters.friction_static);
    state.sliding = size > slides_above * normal_force ? 1 : 0;
    state.spring = trial;
    if (state.sliding) {
      const double limit = std::min(size, parameters.friction_dynamic * normal_force);
      state.spring = (limit / size) * trial;
      result.dissipated = 0.5 * dot(before + state.spring, trial - state.spring) / tangential_stiffness;
      result.slip = (size - limit) / tangential_stiffness;
    }
    result.force = state.spring;
    return result;
  }
};

} // namespace platen::dem
