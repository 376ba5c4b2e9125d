#include "coupling/program/platen_speed.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace platen::coupling {

namespace {

// At gain 1 a step moves the platen by at most this fraction of the displacement that closes the error, at
// gain 10 and above by ten times as much: still below the limit of stability (2) and of overshoot (1/4, with
// the piston's mass below).
constexpr double fraction_per_step = 0.02, largest_fraction = 10 * fraction_per_step;
// Fraction of the new velocity in a step: the piston's mass is c dt (1 - b)/b. It prevents fast oscillations
// of the velocity by dashpots in the contacts, whose force follows the velocity at once.
constexpr double smoothing = 0.5;

// Fraction of the steepest secant; a smaller slope counts as failure.
constexpr double elastic_fraction = 0.8;
// Fraction of all bonds; if a larger one breaks within a transit, this counts as failure.
constexpr double breaking_fraction = 5e-5;
// Transits between two slopes; in one alone, stress rises by no more than the inertia of starting platens.
constexpr double transits_of_slope = 5;
// Time for which the platens keep to their speed at first, and after a check that has found failure.
constexpr double transits_of_care = 10;
constexpr double slowing = 3; // times as fast as speeding up

} // namespace

Servo::Servo(const Parameters &parameters) : parameters_(parameters) {
  if (!(parameters.gain > 0)) throw std::invalid_argument("servo: the gain must be positive");
  if (!(parameters.velocity_limit > 0))
    throw std::invalid_argument("servo: the velocity limit must be positive");
}

double Servo::dashpot(const ServoLoad &load, double dt) const {
  const double gain = parameters_.gain;
  const double least = load.stiffness * dt / std::min(fraction_per_step, largest_fraction / gain);
  return std::max(impedances * load.impedance, least) / gain;
}

double Servo::velocity(double wanted, double reaction, const ServoLoad &load, double dt) {
  const double error = wanted - reaction, limit = parameters_.velocity_limit,
               dashpot = this->dashpot(load, dt);
  double target = dashpot > 0 ? error / dashpot : (error > 0 ? limit : (error < 0 ? -limit : 0.0));
  target = std::clamp(target, -limit, limit);
  velocity_ += smoothing * (target - velocity_);
  return velocity_;
}

void Servo::describe(Archive &archive) {
  archive.version(1);
  archive("velocity", velocity_, "m/s");
}

RateControl::RateControl(const Parameters &parameters) : parameters_(parameters) {
  if (!(parameters.multiplier >= 1))
    throw std::invalid_argument("rate control: the multiplier must be one or more");
  if (!(parameters.transit > 0) || !(parameters.ramp > 0))
    throw std::invalid_argument("rate control: transit and ramp must be positive");
}

double RateControl::factor(double time, double dt) {
  const double target = careful_until_ < 0 || time < careful_until_ ? 1.0 : parameters_.multiplier;
  const double most = (parameters_.multiplier - 1) * dt / parameters_.ramp;
  factor_ += std::clamp(target - factor_, -slowing * most, most);
  return factor_;
}

void RateControl::update(double time, double stress, double closure, double broken) {
  const double care = transits_of_care * parameters_.transit;
  if (careful_until_ < 0) {
    careful_until_ = next_check_ = next_slope_ = time + care;
    first_stress_ = stress_ = stress;
    first_closure_ = closure_ = closure;
  }
  if (time < next_check_) return;
  next_check_ = time + parameters_.transit;
  bool elastic = broken - broken_ <= breaking_fraction * parameters_.bonds;
  broken_ = broken;
  if (time >= next_slope_) {
    next_slope_ = time + transits_of_slope * parameters_.transit;
    const double secant = (stress - first_stress_) / (closure - first_closure_);
    if (std::isfinite(secant)) steepest_ = std::max(steepest_, secant);
    elastic = elastic && (stress - stress_) / (closure - closure_) >= elastic_fraction * steepest_;
    stress_ = stress;
    closure_ = closure;
  }
  if (!elastic) careful_until_ = time + care;
}

void RateControl::describe(Archive &archive) {
  archive.version(1);
  archive("factor", factor_);
  archive("careful_until", careful_until_, "s");
  archive("next_check", next_check_, "s");
  archive("next_slope", next_slope_, "s");
  archive("first_stress", first_stress_, "Pa");
  archive("first_closure", first_closure_);
  archive("stress", stress_, "Pa");
  archive("closure", closure_);
  archive("broken_bonds", broken_);
  archive("steepest", steepest_, "Pa");
}

} // namespace platen::coupling
