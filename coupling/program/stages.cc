#include "coupling/program/stages.h"

#include <algorithm>
#include <cmath>

namespace platen::coupling {

namespace {

// The platens take over when the axial stress is as near to the pressure as this share of it, or after as
// much time again as pressure and hold have had.
constexpr double settled_share = 0.01, patience = 2;

double start_of_ramp(double passed, double ramp) {
  return ramp > 0 ? smooth_start(passed / ramp) : 1.0;
}

} // namespace

double Consolidation::pressure_rate(double time) const {
  const double x = time / parameters_.ramp;
  return x < 1 ? 6 * x * (1 - x) / parameters_.ramp * parameters_.pressure : 0.0;
}

void Consolidation::command(const Measures &m, Commands &asked) {
  const Sides &sides = parameters_.sides;
  const double dt = m.time_step(), middle = m.time() - 0.5 * dt - begun();
  const double wanted = (smooth_start(middle / parameters_.ramp) * parameters_.pressure +
                         parameters_.lag_of_servo * pressure_rate(middle)) *
                        parameters_.area;
  asked[sides.top].velocity =
      servo_.velocity(wanted, m.load(sides.top), m.servo_load(sides.top), dt) * m.inward(sides.top);
  if (sides.lateral)
    asked[*sides.lateral].pressure =
        smooth_start((m.time() - begun()) / parameters_.ramp) * parameters_.pressure;
}

bool Consolidation::has_ended(const Measures &m) const {
  const double passed = m.time() - begun(), least = parameters_.ramp + parameters_.hold;
  const double pressure = m.lateral_pressure();
  const bool near = std::abs(m.axial_stress() - pressure) < settled_share * pressure;
  return passed >= least && (near || passed >= patience * least);
}

void Consolidation::describe(Archive &archive) {
  Stage::describe(archive);
  archive.part("servo", servo_);
}

double LateralPressure::asked() const {
  if (parameters_.path == 0) return parameters_.pressure;
  return std::max(0.0, parameters_.pressure + parameters_.path * deviator_);
}

void LateralPressure::follow(const Measures &m) {
  if (parameters_.path == 0) return;
  const double share = std::min(1.0, m.time_step() / parameters_.lag);
  deviator_ += share * (m.axial_stress() - m.lateral_pressure() - deviator_);
}

void LateralPressure::describe(Archive &archive) {
  archive.version(1);
  archive("deviator", deviator_, "Pa");
}

AxialRate::AxialRate(const Parameters &parameters) : parameters_(parameters) {
  if (parameters.rate_control) rate_control_.emplace(*parameters.rate_control);
  if (parameters.lateral) lateral_.emplace(*parameters.lateral);
}

void AxialRate::command(const Measures &m, Commands &asked) {
  const Sides &sides = parameters_.sides;
  const double dt = m.time_step(), middle = m.time() - 0.5 * dt;
  double speed = (parameters_.tension ? -0.5 : 0.5) * parameters_.rate *
                 start_of_ramp(middle - begun(), parameters_.ramp);
  if (!parameters_.unload_at.empty()) {
    const double most = parameters_.ramp > 0 ? 2 * dt / parameters_.ramp : 2.0;
    cycle_speed_ += std::clamp(direction_ - cycle_speed_, -most, most);
    speed *= cycle_speed_;
  }
  if (rate_control_) speed *= rate_control_->factor(m.time(), dt);
  asked[sides.top].velocity = {0, 0, -speed};
  asked[sides.bottom].velocity = {0, 0, speed};
  if (lateral_ && sides.lateral) asked[*sides.lateral].pressure = lateral_->asked();
}

void AxialRate::update(const Measures &m) {
  if (lateral_ && m.time() > begun()) lateral_->follow(m);
  if (!parameters_.unload_at.empty()) turn_round(m);
  if (rate_control_) rate_control_->update(m.time(), m.axial_stress(), m.closure_strain(), m.broken_bonds());
}

double AxialRate::loaded_strain(const Measures &m) const {
  return parameters_.tension ? -closure_gained(m) : closure_gained(m);
}

void AxialRate::turn_round(const Measures &m) {
  const double pressure = lateral_ ? m.lateral_pressure() : 0.0;
  const double deviator = m.axial_stress() - pressure;
  const double stress = parameters_.tension ? -deviator : deviator;
  const double strain = loaded_strain(m);
  if (direction_ > 0 && turns_ < parameters_.unload_at.size() && strain >= parameters_.unload_at[turns_]) {
    direction_ = -1;
    ++turns_;
    strain_of_turn_ = strain;
    stress_of_turn_ = stress;
  } else if (direction_ < 0 && stress <= parameters_.unload_to * stress_of_turn_) {
    direction_ = 1;
  }
}

bool AxialRate::is_cycling(const Measures &m) const {
  return turns_ > 0 && (direction_ < 0 || loaded_strain(m) < strain_of_turn_);
}

bool AxialRate::has_ended(const Measures &m) const {
  return std::abs(closure_gained(m)) >= parameters_.target_strain;
}

double AxialRate::expected_seconds() const {
  return 0.5 * parameters_.ramp +
         (parameters_.target_strain - parameters_.start_strain) * parameters_.height / parameters_.rate;
}

double AxialRate::progress(const Measures &m) const {
  return std::abs(closure_gained(m)) / parameters_.target_strain;
}

double AxialRate::fastest() const {
  return parameters_.rate * (parameters_.rate_control ? parameters_.rate_control->multiplier : 1.0);
}

void AxialRate::describe(Archive &archive) {
  Stage::describe(archive);
  if (lateral_) archive.part("lateral_pressure", *lateral_);
  if (rate_control_) archive.part("rate_control", *rate_control_);
  if (parameters_.unload_at.empty()) return;
  archive("direction", direction_);
  archive("cycle_speed", cycle_speed_);
  archive("turns", turns_);
  archive("strain_of_turn", strain_of_turn_);
  archive("stress_of_turn", stress_of_turn_, "Pa");
}

void AxialStress::command(const Measures &m, Commands &asked) {
  const Sides &sides = parameters_.sides;
  const double dt = m.time_step(), middle = m.time() - 0.5 * dt;
  const double wanted =
      start_of_ramp(middle - begun(), parameters_.ramp) * parameters_.stress * parameters_.area;
  asked[sides.top].velocity =
      servo_.velocity(wanted, m.load(sides.top), m.servo_load(sides.top), dt) * m.inward(sides.top);
}

bool AxialStress::has_ended(const Measures &m) const {
  return m.time() - begun() >= parameters_.ramp + parameters_.hold ||
         std::abs(closure_gained(m)) >= parameters_.target_strain;
}

void AxialStress::describe(Archive &archive) {
  Stage::describe(archive);
  archive.part("servo", servo_);
}

} // namespace platen::coupling
