#include "coupling/program/task.h"

namespace platen::coupling {

double PlatensOfAxis::stress(const Measures &m) const {
  if (axis == 2 && places.size() == 2) return m.axial_stress();
  double sum = 0;
  for (const std::size_t place : places)
    sum += m.load(place);
  return sum / (static_cast<double>(places.size()) * area);
}

double PlatensOfAxis::closure(const Measures &m) const {
  double sum = 0;
  for (const std::size_t place : places)
    sum += m.moved_inward(place);
  return sum;
}

double PlatensOfAxis::speed(const Measures &m, const Commands &commands) const {
  double sum = 0;
  for (const std::size_t place : places)
    if (place < commands.size()) sum += dot(commands[place].velocity, m.inward(place));
  return sum / static_cast<double>(places.size());
}

void PlatensOfAxis::move(const Measures &m, double inward, Commands &commands) const {
  for (const std::size_t place : places)
    commands[place].velocity = inward * m.inward(place);
}

void HoldTask::begin(const Measures &m, double begun, const Transfer &from) {
  begun_ = begun;
  speed_found_ = platens_.speed(m, from.commands);
}

void HoldTask::command(const Measures &m, Commands &commands) {
  const double middle = m.time() - 0.5 * m.time_step() - begun_;
  if (speed_found_ != 0) platens_.move(m, speed_found_ * (1 - start_of_ramp(middle, ramp_)), commands);
}

void HoldTask::describe(Archive &archive) {
  archive.version(1);
  archive("begun", begun_, "s");
  archive("speed_found", speed_found_, "m/s");
}

} // namespace platen::coupling
