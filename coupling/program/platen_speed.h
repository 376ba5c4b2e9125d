// A servo that moves a platen so that its reaction meets a prescribed force: loading by force, confining
// plates, seating.
//
// It is the discrete form of a light piston with a dashpot, m dv/dt = F_wanted - F - c v. A piston takes
// energy from the body that it presses and adds none beyond the work of the prescribed force, so it stays
// stable against any specimen, also one that cracks; only the time step limits it, and c is chosen far above
// that limit.
#pragma once

#include <limits>

#include "base/archive.h"
#include "coupling/contact/servo_load.h"

namespace platen::coupling {

class Servo {
public:
  // At gain 1 the dashpot is this multiple of the impedance of the end particles, which is that of the
  // specimen too: an impact at the speed that it allows adds 1 % to the force, and waves do not oscillate.
  static constexpr double impedances = 100;

  struct Parameters {
    double gain = 1; // multiplies the response; 0.1 ... 40 are safe, larger is faster
    double velocity_limit = std::numeric_limits<double>::quiet_NaN(); // m/s, > 0
  };
  // Throws std::invalid_argument where a parameter is not positive.
  explicit Servo(const Parameters &parameters);

  // Velocity (m/s) for the next step dt (s), positive towards the specimen. Forces in N, positive in
  // compression: `reaction` is that of the last step. Without any particle near (zero load) the platen
  // approaches at the velocity limit.
  double velocity(double wanted, double reaction, const ServoLoad &load, double dt);

  double dashpot(const ServoLoad &load, double dt) const; // N s/m, error over velocity

  void describe(Archive &archive);

private:
  Parameters parameters_;
  double velocity_ = 0;
};

// Speed of the platens: a multiple of the rate of the test while the specimen is elastic, that rate while it
// fails.
//
// Elastic: stress follows closure, up or down, nearly as steeply as the steepest secant from the start, and
// hardly a bond breaks. Bonds are checked every wave transit and the slope every few; nothing is decided
// before the first ten, because platens that start press against the specimen's inertia. Speed rises within
// `ramp` and falls in a third of it.
class RateControl {
public:
  struct Parameters {
    double multiplier = 1; // speed while elastic, over that while failing; >= 1
    double transit = 0;    // s, of a wave over the specimen
    double ramp = 0;       // s, for a change between the two speeds
    double bonds = 0;      // number at the start
  };
  // Throws std::invalid_argument where the multiplier is below one or a time is not positive.
  explicit RateControl(const Parameters &parameters);

  // Factor on the platens' speed for a step dt (s) that begins at `time`.
  double factor(double time, double dt);
  // After a step. `stress` (Pa) and `closure` (1) of one sign; `broken`: number of bonds so far.
  void update(double time, double stress, double closure, double broken);

  void describe(Archive &archive);

private:
  Parameters parameters_;
  double factor_ = 1;
  double careful_until_ = -1, next_check_ = 0, next_slope_ = 0; // s; below zero: not begun
  double first_stress_ = 0, first_closure_ = 0;                 // at the beginning
  double stress_ = 0, closure_ = 0, broken_ = 0;                // at the last check
  double steepest_ = 0;                                         // Pa
};

} // namespace platen::coupling
