// All sides alike: the pressure of a cell rises on the lateral surface, the top platen follows by its servo,
// the bottom one stands.
#pragma once

#include "coupling/program/stage.h"

namespace platen::coupling {

class Consolidation : public Stage {
public:
  struct Parameters {
    Sides sides;
    double pressure = 0; // Pa
    double ramp = 0;     // s, from none to all of it, > 0
    double hold = 0;     // s, how long it stands alone at least
    double area = 0;     // m^2, of the platens' face that bears it
    // s: what the servo is told runs ahead of the pressure by this, so that the stress on the platens keeps
    // up with it.
    double lag_of_servo = 0;
    Servo::Parameters servo;
  };
  explicit Consolidation(const Parameters &parameters) : parameters_(parameters), servo_(parameters.servo) {}

  std::string name() const override { return "consolidation"; }
  void command(const Measures &m, Commands &asked) override;
  // The pressure has risen and stood for its time, and the axial stress is within 1 % of it; or as much time
  // again has passed.
  bool has_ended(const Measures &m) const override;
  double expected_seconds() const override { return parameters_.ramp + parameters_.hold; }
  double progress(const Measures &m) const override { return (m.time() - begun()) / expected_seconds(); }
  bool is_consolidation() const override { return true; }
  void describe(Archive &archive) override;

private:
  double pressure_rate(double time) const; // Pa/s

  Parameters parameters_;
  Servo servo_;
};

} // namespace platen::coupling
