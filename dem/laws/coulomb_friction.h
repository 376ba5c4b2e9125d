// Coulomb friction with a tangential spring. A law is a value: parameters, state, one call operator. The same
// source serves one contact and SIMD vectors of contacts (lanes.h), with the same bits.
#pragma once

#include <algorithm>
#include <limits>
#include <type_traits>

#include "base/vector3.h"
#include "dem/laws/lanes.h"

namespace platen::dem {

// Result of friction for a spring in one step.
template <class Real, class Truth>
struct Friction {
  Triple<Real> spring; // N, new
  Truth slides, pressed;
  Real dissipated, slip; // J, m
};

// stretch: m. normal_force: N. tangential_stiffness: N/m. slides_above, slides_at: coefficients. Without a
// stiffness there is no spring and no loss.
template <class How, class Real>
PLATEN_INLINE auto spring_with_friction(const Triple<Real> &before, const Triple<Real> &stretch,
                                        const Real &normal_force, const Real &tangential_stiffness,
                                        const Real &slides_above, const Real &slides_at) {
  const Triple<Real> trial = before + scale(tangential_stiffness, stretch);
  const Real size = length<How>(trial), most = slides_at * normal_force;
  const auto pressed = How::above(normal_force, Real(0.0));
  const auto slides = pressed & How::above(size, Real(slides_above * normal_force));
  const Real limit = How::choose(How::above(size, most), most, size);
  const Triple<Real> slid = scale(Real(limit / size), trial);
  Friction<Real, std::decay_t<decltype(pressed)>> f;
  f.spring = choose<How>(slides, slid, choose<How>(pressed, trial, no_vector<Real>()));
  f.slides = slides;
  f.pressed = pressed;
  // 1/2 (T_n + T_n+1) . (T_trial - T_n+1) / k_t, which is 0 if the contact sticks.
  const Triple<Real> both = choose<How>(slides, before + slid, before),
                     rest = choose<How>(slides, trial - slid, trial);
  const auto stiff = How::above(tangential_stiffness, Real(0.0)); // otherwise 0 / 0
  f.dissipated = How::choose((slides | How::negated(pressed)) & stiff,
                             Real(0.5) * dot(both, rest) / tangential_stiffness, Real(0.0));
  f.slip = How::choose(slides & stiff, (size - limit) / tangential_stiffness, Real(0.0));
  return f;
}

// The spring sticks until its force exceeds mu_s N; then it slides at mu_d N: the stored force is rescaled to
// that limit in its direction, until a trial force below mu_d N sticks again (Cundall and Strack 1979; two
// coefficients as in platen tests on concrete). A contact with an infinite coefficient never slides. With
// mu_d > mu_s sliding starts without a rise: the force never exceeds the trial force.
struct CoulombFriction {
  struct Parameters {
    double friction_static = std::numeric_limits<double>::quiet_NaN();  // 1, >= 0
    double friction_dynamic = std::numeric_limits<double>::quiet_NaN(); // 1, >= 0
  };
  struct State {
    Vector3 spring;  // N, tangential force; the caller carries it with the contact plane between calls
    int sliding = 0; // 0 sticks, 1 slides
    double slip = 0; // m, slip path since the contact closed
  };
  struct Result {
    Vector3 force;         // N, the new spring force
    double dissipated = 0; // J, lost to sliding in this step
    double slip = 0;       // m, slip path in this step
  };

  Parameters parameters;

  // stretch: relative tangential displacement over the step (m), in the contact plane, with the sign of the
  // force: force = + tangential_stiffness stretch. normal_force: N, >= 0 in compression; 0 or less releases
  // the spring. tangential_stiffness: N/m, at least 0.
  //
  // dissipated = 1/2 (T_n + T_n+1) . (T_trial - T_n+1) / k_t: with the spring energy T^2 / (2 k_t) it adds up
  // exactly to the work of the mean force over the step, which is the work in the leapfrog scheme.
  Result operator()(State &state, const Vector3 &stretch, double normal_force,
                    double tangential_stiffness) const {
    const auto f = spring_with_friction<OfScalars, double>(
        triple_of(state.spring), triple_of(stretch), normal_force, tangential_stiffness,
        state.sliding ? parameters.friction_dynamic : parameters.friction_static,
        parameters.friction_dynamic);
    state.spring = vector_of(f.spring);
    state.sliding = f.slides;
    state.slip = f.pressed ? state.slip + f.slip : 0;
    return {state.spring, f.dissipated, f.slip};
  }

  // The three outcomes for the spring, for laws with other limits. `trial` is its force without sliding (N),
  // `size` the length of `trial`.
  static Result let_go(State &state, const Vector3 &trial, double tangential_stiffness) {
    Result result;
    if (tangential_stiffness > 0) result.dissipated = 0.5 * dot(state.spring, trial) / tangential_stiffness;
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
    if (!(tangential_stiffness > 0)) return result;
    result.dissipated = 0.5 * dot(before + state.spring, trial - state.spring) / tangential_stiffness;
    result.slip = (size - limit) / tangential_stiffness;
    state.slip += result.slip;
    return result;
  }
};

} // namespace platen::dem
