#include "coupling/program/widening_task.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace platen::coupling {

namespace {

// Wave transits within which an error is closed: the first number while the specimen lags behind the target,
// the second while it fails. An action of the platens reaches the middle within half a transit.
constexpr double transits_of_approach = 20, transits_of_retreat = 1;
// Fraction of its length by which a specimen is unloaded in a transit at most.
constexpr double most_released = 1e-4;
// Circumferential over axial strain, of concrete and rock in the elastic range.
constexpr double poisson_ratio = 0.2;
// The speed follows its target within a fraction of a transit: platens cause no waves.
constexpr double transits_of_speed = 0.5;

// Names of the controlled quantity in reports, and of its value at the start in a state.
struct Named {
  const char *quantity, *unit_of_rate, *found, *unit;
};
constexpr Named named(Widening of) {
  return of == Widening::mouth ? Named{"cmod rate", "m/s", "opening_found", "m"}
                               : Named{"circumferential rate", "1/s", "strain_found", "1"};
}

} // namespace

WideningTask::WideningTask(const Parameters &parameters) : parameters_(parameters) {
  const bool closes = parameters.of == Widening::circumference || parameters.closure > 0;
  if (!(parameters.rate > 0) || !(parameters.transit > 0) || !(parameters.fastest > 0) || !closes)
    throw std::invalid_argument(
        "control by a widening needs a rate, a wave transit, a speed limit and a closure for it");
}

void WideningTask::begin(const Measures &m, double begun, const Transfer &from) {
  begun_ = begun;
  found_ = now(m);
  speed_ =
      parameters_.platens.speed(m, from.commands) * static_cast<double>(parameters_.platens.places.size());
}

// The integral of the rate, which rises smoothly over the ramp.
double WideningTask::target_at(double passed) const {
  const double ramp = parameters_.ramp, x = ramp > 0 ? std::min(1.0, passed / ramp) : 1.0;
  const double in_ramp = ramp * x * x * x * (1 - 0.5 * x);
  return found_ + parameters_.rate * (in_ramp + std::max(0.0, passed - ramp));
}

void WideningTask::command(const Measures &m, Commands &commands) {
  const double dt = m.time_step(), passed = m.time() - 0.5 * dt - begun_, length = parameters_.platens.length;
  const double error = target_at(passed) - now(m);
  const double tau = (error < 0 ? transits_of_retreat : transits_of_approach) * parameters_.transit;
  const double rate = parameters_.rate * start_of_ramp(passed, parameters_.ramp) + error / tau; // 1/s or m/s
  const double fastest_back = std::max(parameters_.fastest, most_released * length / parameters_.transit);
  const double closing =
      parameters_.of == Widening::mouth ? parameters_.closure * rate : length * rate / poisson_ratio;
  const double target = std::clamp(closing, -fastest_back, parameters_.fastest);
  speed_ += std::min(1.0, dt / (transits_of_speed * parameters_.transit)) * (target - speed_);
  parameters_.platens.move(m, speed_ / static_cast<double>(parameters_.platens.places.size()), commands);
}

std::optional<Controlled> WideningTask::controlled(const Measures &m) const {
  const double passed = m.time() - begun_;
  if (!(passed > 0)) return std::nullopt;
  const Named words = named(parameters_.of);
  Controlled c{words.quantity, "axial", words.unit_of_rate, parameters_.platens.axis};
  c.target = (target_at(passed) - found_) / passed;
  c.reached = (now(m) - found_) / passed;
  c.reference = std::abs(c.target);
  return c;
}

void WideningTask::describe(Archive &archive) {
  archive.version(1);
  archive("begun", begun_, "s");
  const Named words = named(parameters_.of);
  archive(words.found, found_, words.unit, or_nan());
  archive("speed", speed_, "m/s");
}

} // namespace platen::coupling
