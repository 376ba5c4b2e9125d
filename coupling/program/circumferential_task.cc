#include "coupling/program/circumferential_task.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace platen::coupling {

namespace {

// The error is closed within this many wave transits where the specimen lags; where it fails, within this
// many: an action of the platens reaches the middle within half a transit.
constexpr double transits_of_approach = 20, transits_of_retreat = 1;
// Fraction of its length by which a specimen is unloaded in a transit at most.
constexpr double most_released = 1e-4;
// Circumferential over axial strain, of concrete and rock in the elastic range.
constexpr double poisson_ratio = 0.2;
// The speed follows its target within a fraction of a transit: platens cause no waves.
constexpr double transits_of_speed = 0.5;

} // namespace

CircumferentialTask::CircumferentialTask(const Parameters &parameters) : parameters_(parameters) {
  if (!(parameters.rate > 0) || !(parameters.transit > 0) || !(parameters.fastest > 0))
    throw std::invalid_argument("circumferential control needs a rate, a wave transit and a speed limit");
}

void CircumferentialTask::begin(const Measures &m, double begun, const Transfer &from) {
  begun_ = begun;
  strain_found_ = m.circumferential_strain();
  speed_ = parameters_.platens.speed(m, from.asked) * static_cast<double>(parameters_.platens.places.size());
}

// The rate rises smoothly over the ramp: its integral.
double CircumferentialTask::strain_asked(double passed) const {
  const double ramp = parameters_.ramp, x = ramp > 0 ? std::min(1.0, passed / ramp) : 1.0;
  const double in_ramp = ramp * x * x * x * (1 - 0.5 * x);
  return strain_found_ + parameters_.rate * (in_ramp + std::max(0.0, passed - ramp));
}

void CircumferentialTask::command(const Measures &m, Commands &asked) {
  const double dt = m.time_step(), passed = m.time() - 0.5 * dt - begun_, length = parameters_.platens.length;
  const double error = strain_asked(passed) - m.circumferential_strain();
  const double tau = (error < 0 ? transits_of_retreat : transits_of_approach) * parameters_.transit;
  const double rate = parameters_.rate * start_of_ramp(passed, parameters_.ramp) + error / tau; // 1/s
  const double fastest_back = std::max(parameters_.fastest, most_released * length / parameters_.transit);
  const double aim = std::clamp(length * rate / poisson_ratio, -fastest_back, parameters_.fastest);
  speed_ += std::min(1.0, dt / (transits_of_speed * parameters_.transit)) * (aim - speed_);
  parameters_.platens.move(m, speed_ / static_cast<double>(parameters_.platens.places.size()), asked);
}

std::optional<Controlled> CircumferentialTask::controlled(const Measures &m) const {
  const double passed = m.time() - begun_;
  if (!(passed > 0)) return std::nullopt;
  Controlled c{"circumferential rate", "axial", "1/s", parameters_.platens.axis};
  c.asked = (strain_asked(passed) - strain_found_) / passed;
  c.reached = (m.circumferential_strain() - strain_found_) / passed;
  c.whole = std::abs(c.asked);
  return c;
}

void CircumferentialTask::describe(Archive &archive) {
  archive.version(1);
  archive("begun", begun_, "s");
  archive("strain_found", strain_found_, "1", or_nan());
  archive("speed", speed_, "m/s");
}

} // namespace platen::coupling
