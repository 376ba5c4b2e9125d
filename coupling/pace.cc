#include "coupling/pace.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace platen::coupling {
namespace {

// Of the steepest secant: what is less is failure.
constexpr double elastic_share = 0.8;
// Of all bonds, broken in a crossing: what is more is failure.
constexpr double breaking_share = 5e-5;
// From slope to slope: in one crossing stress rises by no more than platens press by inertia when they start.
constexpr double crossings_of_slope = 5;
// How long the platens keep to their speed at first, and after a look that has seen failure.
constexpr double crossings_of_care = 10;
constexpr double slowing = 3; // times as quick as speeding up

} // namespace

Pace::Pace(const Parameters &parameters) : parameters_(parameters) {
  if (!(parameters.hurry >= 1)) throw std::invalid_argument("pace: hurry must be one or more");
  if (!(parameters.crossing > 0) || !(parameters.ramp > 0))
    throw std::invalid_argument("pace: crossing and ramp must be positive");
}

double Pace::factor(double time, double dt) {
  const double aim = careful_until_ < 0 || time < careful_until_ ? 1.0 : parameters_.hurry;
  const double most = (parameters_.hurry - 1) * dt / parameters_.ramp;
  factor_ += std::clamp(aim - factor_, -slowing * most, most);
  return factor_;
}

void Pace::look(double time, double stress, double closure, double broken) {
  const double care = crossings_of_care * parameters_.crossing;
  if (careful_until_ < 0) {
    careful_until_ = next_look_ = next_slope_ = time + care;
    first_stress_ = stress_ = stress;
    first_closure_ = closure_ = closure;
  }
  if (time < next_look_) return;
  next_look_ = time + parameters_.crossing;
  bool elastic = broken - broken_ <= breaking_share * parameters_.bonds;
  broken_ = broken;
  if (time >= next_slope_) {
    next_slope_ = time + crossings_of_slope * parameters_.crossing;
    const double secant = (stress - first_stress_) / (closure - first_closure_);
    if (std::isfinite(secant)) steepest_ = std::max(steepest_, secant);
    elastic = elastic && (stress - stress_) / (closure - closure_) >= elastic_share * steepest_;
    stress_ = stress;
    closure_ = closure;
  }
  if (!elastic) careful_until_ = time + care;
}

void Pace::describe(Archive &archive) {
  archive.version(1);
  archive("factor", factor_);
  archive("careful_until", careful_until_, "s");
  archive("next_look", next_look_, "s");
  archive("next_slope", next_slope_, "s");
  archive("first_stress", first_stress_, "Pa");
  archive("first_closure", first_closure_);
  archive("stress", stress_, "Pa");
  archive("closure", closure_);
  archive("broken_bonds", broken_);
  archive("steepest", steepest_, "Pa");
}

} // namespace platen::coupling
