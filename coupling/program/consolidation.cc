#include "coupling/program/consolidation.h"

#include <cmath>

namespace platen::coupling {
namespace {

// The platens take over when the axial stress is as near to the pressure as this share of it, or after as
// much time again as pressure and hold have had.
constexpr double settled_share = 0.01, patience = 2;

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
  asked[sides.top].velocity = {0, 0,
                               -servo_.velocity(wanted, m.force(sides.top)[2], m.servo_load(sides.top), dt)};
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

} // namespace platen::coupling
