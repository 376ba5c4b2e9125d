// The stages of a test: all sides alike, then axial loading.
#pragma once

#include <limits>
#include <optional>

#include "coupling/program/platen_speed.h"
#include "coupling/program/program.h"

namespace platen::coupling {

// All sides alike: the pressure of a cell rises on the lateral surface, the top platen follows by its servo,
// the bottom one stands.
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

// The axial loading of a test, beside a lateral pressure where there is a cell: at a rate, with unloading in
// between, or by a stress on the top platen.

// The pressure of a cell while the platens load: held, or led along a stress path.
class LateralPressure {
public:
  struct Parameters {
    double pressure = 0; // Pa, at the start
    double path = 0;     // 1, what it gains per deviator of the axial stage; -1/3: constant mean stress
    double lag = 0;      // s, with which it follows the deviator, > 0 where there is a path
  };
  explicit LateralPressure(const Parameters &parameters) : parameters_(parameters) {}
  double asked() const;
  void follow(const Measures &m);
  void describe(Archive &archive);

private:
  Parameters parameters_;
  double deviator_ = 0; // Pa, that the path follows
};

// The platens approach or part, each at half of the rate.
class AxialRate : public Stage {
public:
  struct Parameters {
    Sides sides;
    bool tension = false;
    double rate = 0;                                                // m/s, closure (opening) speed
    double ramp = 0;                                                // s, of the smooth start; 0: at once
    double target_strain = std::numeric_limits<double>::infinity(); // closure over the height
    double start_strain = 0;                                        // that a run begins with
    double height = 0;                                              // m
    // Closure strains, ascending, at which the platens turn round until the axial stress (less the cell's
    // pressure) has fallen to this share of what it was.
    std::vector<double> unload_at;
    double unload_to = 0.1;
    std::optional<RateControl::Parameters> rate_control; // none: one rate
    std::optional<LateralPressure::Parameters> lateral;  // none: no cell
  };
  explicit AxialRate(const Parameters &parameters);

  std::string name() const override { return parameters_.tension ? "tension" : "compression"; }
  void command(const Measures &m, Commands &asked) override;
  void update(const Measures &m) override;
  bool has_ended(const Measures &m) const override;
  double expected_seconds() const override;
  double progress(const Measures &m) const override;
  double fastest() const override;
  bool is_cycling(const Measures &m) const override;
  void describe(Archive &archive) override;

private:
  double loaded_strain(const Measures &m) const;
  void turn_round(const Measures &m);

  Parameters parameters_;
  std::optional<RateControl> rate_control_;
  std::optional<LateralPressure> lateral_;
  double direction_ = 1, cycle_speed_ = 1; // of loading; what the speed is now, which follows within the ramp
  std::size_t turns_ = 0;
  double strain_of_turn_ = 0, stress_of_turn_ = 0; // 1, Pa; of the last turn
};

// The top platen holds a stress against a bottom platen at rest.
class AxialStress : public Stage {
public:
  struct Parameters {
    Sides sides;
    double stress = 0;                                     // Pa, pressing; reached smoothly over the ramp
    double ramp = 0;                                       // s
    double hold = std::numeric_limits<double>::infinity(); // s, how long it is held after the ramp
    double target_strain = std::numeric_limits<double>::infinity(); // closure at which it is over too
    double area = 0;                                                // m^2
    Servo::Parameters servo;
  };
  explicit AxialStress(const Parameters &parameters) : parameters_(parameters), servo_(parameters.servo) {}

  std::string name() const override { return "stress"; }
  void command(const Measures &m, Commands &asked) override;
  bool has_ended(const Measures &m) const override;
  double expected_seconds() const override { return parameters_.ramp + parameters_.hold; }
  double progress(const Measures &m) const override { return (m.time() - begun()) / expected_seconds(); }
  double fastest() const override { return parameters_.servo.velocity_limit; }
  void describe(Archive &archive) override;

private:
  Parameters parameters_;
  Servo servo_;
};

} // namespace platen::coupling
