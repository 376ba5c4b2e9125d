#include "coupling/program/drive.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace platen::coupling {

Drive::Drive(const Parameters &parameters) : parameters_(parameters) {
  if (parameters.platens.places.empty()) throw std::invalid_argument("drive: it moves no platen");
  if (parameters.rate_control) rate_control_.emplace(*parameters.rate_control);
}

void Drive::set_rate(double rate, double ramp, const Measures &m, double begun) {
  if (!(rate != 0)) throw std::invalid_argument("drive: a rate of nothing");
  const double sign = rate > 0 ? 1 : -1;
  if (until_ == m.time()) {
    factor_ *= std::abs(rate_ / rate);
  } else {
    begun_ = begun;
    factor_ = sign;
  }
  const double sense = parameters_.sense;
  if (sign != sense && rate_ * sense > 0) turned_ = true, strain_of_turn_ = loaded_strain(m);
  rate_ = rate, ramp_ = ramp;
}

void Drive::change_rate(double rate, const Measures &m) {
  if (!(rate > 0) || !is_driven()) throw std::invalid_argument("drive: a rate of nothing");
  set_rate(std::copysign(rate, rate_), ramp_, m, begun_); // continues from its present speed
}

double Drive::speed(const Measures &m) {
  const double dt = m.time_step(), middle = m.time() - 0.5 * dt;
  const double most = ramp_ > 0 ? 2 * dt / ramp_ : std::abs(factor_) + 1;
  factor_ += std::clamp((rate_ > 0 ? 1 : -1) - factor_, -most, most);
  double speed = std::abs(rate_) / static_cast<double>(parameters_.platens.places.size()) *
                 start_of_ramp(middle - begun_, ramp_) * factor_;
  if (rate_control_) speed *= rate_control_->factor(m.time(), dt);
  return speed;
}

void Drive::update(const Measures &m) {
  until_ = m.time();
  if (rate_control_) rate_control_->update(m.time(), m.axial_stress(), m.closure_strain(), m.broken_bonds());
}

double Drive::loaded_strain(const Measures &m) const {
  return parameters_.sense * m.closure_strain(parameters_.platens.axis);
}

bool Drive::is_cycling(const Measures &m) const {
  return turned_ && (rate_ * parameters_.sense < 0 || loaded_strain(m) < strain_of_turn_);
}

void Drive::describe(Archive &archive) {
  archive.version(1);
  archive("rate", rate_, "m/s");
  archive("ramp", ramp_, "s", at_least(0));
  double sense = rate_ == 0 ? 0 : parameters_.sense; // older states took it from the first rate
  archive("first_direction", sense, "1", between(-1, 1));
  archive("begun", begun_, "s");
  archive("driven_until", until_, "s");
  archive("factor", factor_);
  archive("turned", turned_);
  archive("strain_of_turn", strain_of_turn_, "1", or_nan());
  if (rate_control_) archive.part("rate_control", *rate_control_);
}

void RateTask::begin(const Measures &m, double begun, const Transfer &) {
  drive_->set_rate(rate_, ramp_, m, begun);
  begun_ = begun, path_ = 0;
  closure_found_ = drive_->platens().closure(m);
}

void RateTask::command(const Measures &m, Commands &commands) {
  const double speed = drive_->speed(m);
  path_ += static_cast<double>(drive_->platens().places.size()) * speed * m.time_step();
  drive_->platens().move(m, speed, commands);
}

std::optional<Controlled> RateTask::controlled(const Measures &m) const {
  const double passed = m.time() - begun_;
  if (!(passed > 0) || std::isnan(path_)) return std::nullopt; // a state from a version without the path
  Controlled c{"rate", side_, "m/s", drive_->platens().axis};
  c.target = path_ / passed;
  c.reached = (drive_->platens().closure(m) - closure_found_) / passed;
  c.reference = std::abs(c.target);
  return c;
}

void RateTask::describe(Archive &archive) {
  archive.version(1);
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  archive("begun", begun_, "s", 0.0);
  archive("path", path_, "m", unknown, or_nan());
  archive("closure_found", closure_found_, "m", 0.0);
}

double RateTask::fastest() const {
  return std::abs(rate_) * drive_->multiplier();
}

} // namespace platen::coupling
