// Platens that bear a stress, or a share of what other platens bear, by a servo.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "coupling/program/platen_speed.h"
#include "coupling/program/task.h"

namespace platen::coupling {

// Its aim goes from the stress that the stage finds to what is asked, smoothly within the ramp; the servo is
// told what will be asked in `lead`, so that the stress keeps up. A share `a` of another stress `s` follows a
// smoothed `f`, df/dt = (s - f) / lag, by the aim a (f + (lag + lead) df/dt).
class StressTask : public Task {
public:
  struct Parameters {
    PlatensOfAxis platens;
    std::string quantity = "stress";       // in words; "share of axial"
    std::string side;                      // "lateral x"
    double value = 0;                      // Pa; 1 of `followed`
    std::optional<PlatensOfAxis> followed; // none: a stress
    double ramp = 0, lead = 0, lag = 0;    // s; lag > 0 where there is a followed one
    // m/N, of what stands in series with the specimen: the lead grows by the servo's dashpot times this.
    double compliance = 0;
    // s, in which what is missing of the stress is asked again: a specimen that widens at a steady speed
    // pushes a servo off by that speed times its dashpot; 0: never.
    double integral_time = 0;
    double ramp_to_rest = 0; // s, of the speed that it is found at
    Servo::Parameters servo;
    // Whose stress has to be within 1 % of what is asked to have settled; empty: each of `platens`.
    std::vector<PlatensOfAxis> settled_by;
  };
  // Throws std::invalid_argument where the parameters are none.
  explicit StressTask(Parameters parameters);

  void begin(const Measures &m, double begun, const Transfer &from) override;
  void command(const Measures &m, Commands &asked) override;
  void update(const Measures &m) override;
  bool has_settled(const Measures &m) const override;
  // Of several platens that have to bear it, the one that is farthest from it. None of a stress is a
  // hundredth of what the stage found, or of the axial one.
  std::optional<Controlled> controlled(const Measures &m) const override;
  double fastest() const override { return parameters_.servo.velocity_limit; }
  Loads loads(double sense) const override;
  void describe(Archive &archive) override;

private:
  double wanted(const Measures &m) const;   // Pa, now
  double asked(const Measures &m) const;    // Pa, beyond the ramp
  double farthest(const Measures &m) const; // Pa, of those that have to bear what is asked

  Parameters parameters_;
  Servo servo_;
  double lead_ = 0;                                       // s, in this step
  double begun_ = 0, stress_found_ = 0, speed_found_ = 0; // s, Pa, m/s
  double followed_ = 0, missing_ = 0;                     // Pa: smoothed; over time, what was missing
};

} // namespace platen::coupling
