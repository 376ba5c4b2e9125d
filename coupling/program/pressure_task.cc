#include "coupling/program/pressure_task.h"

#include <algorithm>
#include <stdexcept>

namespace platen::coupling {

PressureTask::PressureTask(const Parameters &parameters) : parameters_(parameters) {
  if ((parameters.path != 0 || parameters.followed) && !(parameters.lag > 0))
    throw std::invalid_argument("a pressure that follows a stress needs a lag");
}

void PressureTask::begin(const Measures &m, double begun, const Handover &from) {
  begun_ = begun;
  found_ = from.asked.empty() ? 0.0 : from.asked.at(parameters_.place).pressure;
  if (parameters_.path != 0) deviator_ = (found_ - parameters_.value) / parameters_.path;
  if (parameters_.followed) followed_ = parameters_.followed->stress(m);
}

void PressureTask::command(const Measures &m, Commands &asked) {
  const double aim = parameters_.followed ? parameters_.value * followed_ : parameters_.value;
  const double x = parameters_.ramp > 0 ? (m.time() - begun_) / parameters_.ramp : 1;
  const bool on_the_way = x < 1 && parameters_.path == 0;
  double pressure = on_the_way ? found_ + smooth_start(x) * (aim - found_) : aim;
  if (parameters_.path != 0) pressure += parameters_.path * deviator_;
  asked[parameters_.place].pressure = std::max(0.0, pressure);
}

void PressureTask::update(const Measures &m) {
  if (m.time() <= begun_ || !(parameters_.lag > 0)) return;
  const double dt = m.time_step(), lag = parameters_.lag;
  if (parameters_.path != 0) follow(deviator_, m.axial_stress() - m.lateral_pressure(), dt, lag);
  if (parameters_.followed) follow(followed_, parameters_.followed->stress(m), dt, lag);
}

void PressureTask::describe(Archive &archive) {
  archive.version(1);
  archive("begun", begun_, "s");
  archive("found", found_, "Pa");
  archive("deviator", deviator_, "Pa");
  archive("followed", followed_, "Pa");
}

} // namespace platen::coupling
