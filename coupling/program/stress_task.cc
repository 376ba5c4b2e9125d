#include "coupling/program/stress_task.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace platen::coupling {

namespace {

constexpr double settled_fraction = 0.01; // of the prescribed stress

bool have_common_platen(const PlatensOfAxis &one, const PlatensOfAxis &other) {
  return std::any_of(one.places.begin(), one.places.end(), [&](std::size_t place) {
    return std::count(other.places.begin(), other.places.end(), place) > 0;
  });
}

} // namespace

StressTask::StressTask(Parameters parameters)
    : parameters_(std::move(parameters)), servo_(parameters_.servo) {
  const PlatensOfAxis &platens = parameters_.platens;
  if (platens.places.empty()) throw std::invalid_argument("a stress is asked of no platen");
  if (parameters_.followed && !(parameters_.lag > 0))
    throw std::invalid_argument("a share of a stress needs a lag");
  if (parameters_.followed && have_common_platen(platens, *parameters_.followed))
    throw std::invalid_argument("a side cannot bear a share of its own stress");
  if (!parameters_.settled_by.empty()) return;
  for (const std::size_t place : platens.places) {
    parameters_.settled_by.push_back(platens);
    parameters_.settled_by.back().places = {place};
  }
}

void StressTask::begin(const Measures &m, double begun, const Transfer &from) {
  begun_ = begun;
  stress_found_ = parameters_.platens.stress(m);
  speed_found_ = parameters_.platens.speed(m, from.commands);
  if (parameters_.followed) followed_ = parameters_.followed->stress(m);
}

double StressTask::present_target(const Measures &m) const {
  const double passed = m.time() - 0.5 * m.time_step() - begun_, ramp = parameters_.ramp;
  double target = parameters_.value;
  if (parameters_.followed) {
    const double rate = (parameters_.followed->stress(m) - followed_) / parameters_.lag; // Pa/s
    target *= followed_ + (parameters_.lag + lead_) * rate;
  }
  const double x = ramp > 0 ? passed / ramp : 1, change = target - stress_found_;
  const double rate = x < 1 ? 6 * x * (1 - x) / ramp * change : 0.0; // Pa/s
  const double now = x < 1 ? stress_found_ + smooth_start(x) * change : target;
  return now + lead_ * rate;
}

double StressTask::final_target(const Measures &m) const {
  return parameters_.followed ? parameters_.value * parameters_.followed->stress(m) : parameters_.value;
}

double StressTask::farthest(const Measures &m) const {
  const double target = final_target(m);
  double farthest = target;
  for (const PlatensOfAxis &platens : parameters_.settled_by)
    if (const double now = platens.stress(m); !(std::abs(now - target) <= std::abs(farthest - target)))
      farthest = now;
  return farthest;
}

void StressTask::command(const Measures &m, Commands &commands) {
  const std::vector<std::size_t> &places = parameters_.platens.places;
  const double count = static_cast<double>(places.size());
  ServoLoad mean;
  double reaction = 0;
  for (const std::size_t place : places) {
    const ServoLoad load = m.servo_load(place);
    mean.stiffness += load.stiffness / count, mean.impedance += load.impedance / count;
    reaction += m.load(place) / count;
  }
  lead_ = parameters_.lead;
  if (parameters_.compliance > 0) lead_ += parameters_.compliance * servo_.dashpot(mean, m.time_step());
  const double stress = present_target(m) + missing_;
  double speed = servo_.velocity(stress * parameters_.platens.area, reaction, mean, m.time_step());
  const double middle = m.time() - 0.5 * m.time_step() - begun_;
  if (speed_found_ != 0) speed += speed_found_ * (1 - start_of_ramp(middle, parameters_.ramp_to_rest));
  parameters_.platens.move(m, speed, commands);
}

void StressTask::update(const Measures &m) {
  const double now = parameters_.platens.stress(m);
  if (parameters_.integral_time > 0 && now > 0 && m.time() > begun_)
    missing_ += m.time_step() / parameters_.integral_time * (present_target(m) - now);
  if (!parameters_.followed || m.time() <= begun_) return;
  follow(followed_, parameters_.followed->stress(m), m.time_step(), parameters_.lag);
}

bool StressTask::has_settled(const Measures &m) const {
  if (m.time() - begun_ < parameters_.ramp) return false;
  const double target = final_target(m);
  return target == 0 || std::abs(farthest(m) - target) < settled_fraction * std::abs(target);
}

std::optional<Controlled> StressTask::controlled(const Measures &m) const {
  Controlled c{parameters_.quantity, parameters_.side, Controlled::pascal, parameters_.platens.axis};
  c.target = final_target(m), c.reached = farthest(m);
  c.reference =
      c.target != 0 ? std::abs(c.target) : std::max(std::abs(stress_found_), std::abs(m.axial_stress()));
  return c;
}

// A stress that is prescribed again, within the tolerance of a reached one, is not a lower one.
Loads StressTask::loads(double sense) const {
  const bool increases = !parameters_.followed && sense > 0 && parameters_.value > 0;
  return increases && parameters_.value >= (1 - settled_fraction) * stress_found_ ? Loads::by_stress
                                                                                  : Loads::none;
}

void StressTask::describe(Archive &archive) {
  const int version = archive.version(2);
  archive("begun", begun_, "s");
  archive("stress_found", stress_found_, "Pa");
  archive("speed_found", speed_found_, "m/s");
  archive("followed", followed_, "Pa");
  archive("missing", missing_, "Pa");
  if (version < 2) { // now stored in the stage
    double former = 0;
    for (const char *name : {"asked_at_end", "borne_at_end"})
      archive(name, former, "Pa", 0.0, or_nan());
  }
  archive.part("servo", servo_);
}

} // namespace platen::coupling
