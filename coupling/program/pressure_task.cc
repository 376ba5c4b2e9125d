#include "coupling/program/pressure_task.h"

#include <algorithm>
#include <stdexcept>

namespace platen::coupling {

PressureTask::PressureTask(const Parameters &parameters) : parameters_(parameters) {
  if ((parameters.path != 0 || parameters.followed) && !(parameters.lag > 0))
    throw std::invalid_argument("a pressure that follows a stress needs a lag");
}

namespace {

// Extrapolates from values smoothed once and twice: both lag behind a linear growth, the second twice as far.
double ahead(double once, double twice) {
  return 2 * once - twice;
}

} // namespace

void PressureTask::begin(const Measures &m, double begun, const Transfer &from) {
  begun_ = begun;
  found_ = from.commands.empty() ? 0.0 : from.commands.at(parameters_.place).pressure;
  if (parameters_.path != 0) deviator_ = (found_ - parameters_.value) / parameters_.path;
  if (parameters_.followed) followed_ = parameters_.followed->stress(m);
  deviator_again_ = deviator_;
  followed_again_ = followed_;
}

void PressureTask::command(const Measures &m, Commands &commands) {
  const double target =
      parameters_.followed ? parameters_.value * ahead(followed_, followed_again_) : parameters_.value;
  const double x = parameters_.ramp > 0 ? (m.time() - begun_) / parameters_.ramp : 1;
  const bool in_ramp = x < 1 && parameters_.path == 0;
  double pressure = in_ramp ? found_ + smooth_start(x) * (target - found_) : target;
  if (parameters_.path != 0) pressure += parameters_.path * ahead(deviator_, deviator_again_);
  commands[parameters_.place].pressure = std::max(0.0, pressure);
}

void PressureTask::update(const Measures &m) {
  if (m.time() <= begun_ || !(parameters_.lag > 0)) return;
  const double dt = m.time_step(), lag = parameters_.lag;
  if (parameters_.path != 0) {
    follow(deviator_, m.axial_stress() - m.lateral_pressure(), dt, lag);
    follow(deviator_again_, deviator_, dt, lag);
  }
  if (parameters_.followed) {
    follow(followed_, parameters_.followed->stress(m), dt, lag);
    follow(followed_again_, followed_, dt, lag);
  }
}

namespace {

Controlled pressure_around(const std::string &quantity, double target, double found, const Measures &m) {
  Controlled c{quantity, "lateral", Controlled::pascal, Controlled::around};
  c.target = target, c.reached = m.lateral_pressure();
  c.reference = target > 0 ? target : found;
  return c;
}

} // namespace

std::optional<Controlled> PressureTask::controlled(const Measures &m) const {
  double target = parameters_.value;
  if (parameters_.followed) target *= parameters_.followed->stress(m);
  if (parameters_.path != 0) target += parameters_.path * (m.axial_stress() - m.lateral_pressure());
  return pressure_around(parameters_.quantity, std::max(0.0, target), found_, m);
}

std::optional<Controlled> HoldPressureTask::controlled(const Measures &m) const {
  Controlled c = pressure_around("pressure", found_, found_, m);
  c.constant = true;
  return c;
}

void PressureTask::describe(Archive &archive) {
  const bool before = archive.version(2) < 2; // version that followed with a lag
  archive("begun", begun_, "s");
  archive("found", found_, "Pa");
  archive("deviator", deviator_, "Pa");
  archive("followed", followed_, "Pa");
  if (before && archive.reads()) {
    deviator_again_ = deviator_;
    followed_again_ = followed_;
  }
  if (before) return;
  archive("deviator_again", deviator_again_, "Pa");
  archive("followed_again", followed_again_, "Pa");
}

} // namespace platen::coupling
