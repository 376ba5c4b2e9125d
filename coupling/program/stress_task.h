// Platens that carry a prescribed stress, or a fraction of the stress of other platens, by a servo.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "coupling/program/platen_speed.h"
#include "coupling/program/task.h"

namespace platen::coupling {

// The target goes from the stress at the start of the stage to the prescribed one, smoothly within the ramp;
// the servo gets the target of the time `lead` later, so that the stress has no delay. A fraction `a` of
// another stress `s` follows a smoothed `f`, df/dt = (s - f) / lag, by the target a (f + (lag + lead) df/dt).
class StressTask : public Task {
public:
  struct Parameters {
    PlatensOfAxis platens;
    std::string quantity = "stress";       // in words; "share of axial"
    std::string side;                      // "lateral x"
    double value = 0;                      // Pa; or fraction of the stress of `followed`
    std::optional<PlatensOfAxis> followed; // none: a stress
    double ramp = 0, lead = 0, lag = 0;    // s; lag > 0 with `followed`
    // m/N, compliance in series with the specimen: the lead grows by the servo's dashpot times this.
    double compliance = 0;
    // s, integral action on the stress error: a specimen that expands at a constant speed causes an error of
    // that speed times the servo's dashpot; 0: none.
    double integral_time = 0;
    double ramp_to_rest = 0; // s, for the speed at the start of the stage
    Servo::Parameters servo;
    // Platens whose stress has to be within 1 % of the prescribed one to settle; empty: each of `platens`.
    std::vector<PlatensOfAxis> settled_by;
  };
  // Throws std::invalid_argument where the parameters are not valid.
  explicit StressTask(Parameters parameters);

  void begin(const Measures &m, double begun, const Transfer &from) override;
  void command(const Measures &m, Commands &commands) override;
  void update(const Measures &m) override;
  bool has_settled(const Measures &m) const override;
  // Of several platens that have to carry it, the one with the largest error. A zero stress is reached within
  // 1 % of the stress at the start of the stage, or of the axial one.
  std::optional<Controlled> controlled(const Measures &m) const override;
  double fastest() const override { return parameters_.servo.velocity_limit; }
  Loads loads(double sense) const override;
  void describe(Archive &archive) override;

private:
  double present_target(const Measures &m) const; // Pa, of the servo in this step
  double final_target(const Measures &m) const;   // Pa, after the ramp
  double farthest(const Measures &m) const;       // Pa, stress with the largest error, of `settled_by`

  Parameters parameters_;
  Servo servo_;
  double lead_ = 0;                                       // s, in this step
  double begun_ = 0, stress_found_ = 0, speed_found_ = 0; // s, Pa, m/s
  double followed_ = 0, missing_ = 0;                     // Pa: smoothed; integral of the error
};

} // namespace platen::coupling
