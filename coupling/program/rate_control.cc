#include "coupling/program/rate_control.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace platen::coupling {
namespace {

// Of the steepest secant: what is less is failure.
constexpr double elastic_share = 0.8;
// Of all bonds, broken in a transit: what is more is failure.
constexpr double breaking_share = 5e-5;
// From slope to slope: in one transit stress rises by no more than platens press by inertia when they start.
constexpr double transits_of_slope = 5;
// How long the platens keep to their speed at first, and after a check that has seen failure.
constexpr double transits_of_care = 10;
constexpr double slowing = 3; // times as quick as speeding up

} // namespace

RateControl::RateControl(const Parameters &parameters) : parameters_(parameters) {
  if (!(parameters.multiplier >= 1))
    throw std::invalid_argument("rate control: the multiplier must be one or more");
  if (!(parameters.transit > 0) || !(parameters.ramp > 0))
    throw std::invalid_argument("rate control: transit and ramp must be positive");
}

double RateControl::factor(double time, double dt) {
  const double aim = careful_until_ < 0 || time < careful_until_ ? 1.0 : parameters_.multiplier;
  const double most = (parameters_.multiplier - 1) * dt / parameters_.ramp;
  factor_ += std::clamp(aim - factor_, -slowing * most, most);
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
  bool elastic = broken - broken_ <= breaking_share * parameters_.bonds;
  broken_ = broken;
  if (time >= next_slope_) {
    next_slope_ = time + transits_of_slope * parameters_.transit;
    const double secant = (stress - first_stress_) / (closure - first_closure_);
    if (std::isfinite(secant)) steepest_ = std::max(steepest_, secant);
    elastic = elastic && (stress - stress_) / (closure - closure_) >= elastic_share * steepest_;
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
