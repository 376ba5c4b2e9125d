// Platens that close at a rate. The drive continues from one stage to the next: a change of the rate is not a
// jump, and unloading and reloading is one motion.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "coupling/program/platen_speed.h"
#include "coupling/program/task.h"

namespace platen::coupling {

// From rest the speed starts smoothly within the ramp; from one rate to another it changes linearly, from a
// rate to its opposite within the ramp. Compression positive.
class Drive {
public:
  struct Parameters {
    PlatensOfAxis platens;
    std::optional<RateControl::Parameters> rate_control; // of the axial platens; none: one rate
    double sense = 1;                                    // of the test: 1 compression, -1 tension
  };
  explicit Drive(const Parameters &parameters);

  // Sets the closure rate (m/s, of all platens together, not 0) for a stage that begins at `begun` (s);
  // reached within `ramp` (s; 0: at once).
  void set_rate(double rate, double ramp, const Measures &m, double begun);
  // Between two steps: sets another magnitude of the rate (m/s, positive) from the next step on, in the
  // present direction, reached linearly within the ramp. Throws std::invalid_argument where no rate was set.
  void change_rate(double rate, const Measures &m);
  bool is_driven() const { return rate_ != 0; }
  // Of the current step: m/s, of each platen, inward.
  double speed(const Measures &m);
  void update(const Measures &m); // after forces
  const PlatensOfAxis &platens() const { return parameters_.platens; }
  double multiplier() const { return parameters_.rate_control ? parameters_.rate_control->multiplier : 1.0; }
  // From a reversal against the sense of the test until its strain has been reached again.
  bool is_cycling(const Measures &m) const;
  void describe(Archive &archive);

private:
  double loaded_strain(const Measures &m) const; // positive in the sense of the test

  Parameters parameters_;
  std::optional<RateControl> rate_control_;
  double rate_ = 0;               // m/s, prescribed now; 0: never set
  double ramp_ = 0;               // s
  double begun_ = 0, until_ = -1; // s: of the start from rest; until which it has been computed
  double factor_ = 0;             // on |rate|, changes towards the sign of the rate
  bool turned_ = false;
  double strain_of_turn_ = 0;
};

// The machine moves at the rate. The faces of the platens follow it where everything between them is rigid: a
// machine's spring, or elastic platens, take up a part.
class RateTask : public Task {
public:
  RateTask(std::shared_ptr<Drive> drive, double rate, double ramp, std::string side = "axial")
      : drive_(std::move(drive)), rate_(rate), ramp_(ramp), side_(std::move(side)) {}
  void begin(const Measures &m, double begun, const Transfer &) override;
  void command(const Measures &m, Commands &commands) override;
  void update(const Measures &m) override { drive_->update(m); }
  // The mean rates of the stage: of the machine, and of the faces.
  std::optional<Controlled> controlled(const Measures &m) const override;
  double fastest() const override;
  Loads loads(double sense) const override { return rate_ * sense > 0 ? Loads::by_closure : Loads::none; }
  void describe(Archive &archive) override; // the drive is the program's

private:
  std::shared_ptr<Drive> drive_;
  double rate_, ramp_; // m/s, s
  std::string side_;
  double begun_ = 0, path_ = 0, closure_found_ = 0; // s; m, of the machine since then; m, of the faces then
};

} // namespace platen::coupling
