#include "coupling/program/servo.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace platen::coupling {
namespace {

// At gain 1 the dashpot is this many times the impedance of the end particles, which is that of the specimen
// too: an impact at the speed that it allows adds 1 % to the wanted force, and waves do not ring.
constexpr double impedances = 100;
// At gain 1 a step moves the platen by at most this share of the way that closes the error; 10 times as much
// is still below the limit of stability (2) and of overshoot (1/4, with the piston's mass below).
constexpr double share_per_step = 0.02;
// Share of the new velocity in a step: the piston's mass is c dt (1 - b)/b. It keeps dashpots in the
// contacts, whose force follows the velocity at once, from making the velocity flicker.
constexpr double smoothing = 0.5;

} // namespace

Servo::Servo(const Parameters &parameters) : parameters_(parameters) {
  if (!(parameters.gain > 0)) throw std::invalid_argument("servo: the gain must be positive");
  if (!(parameters.velocity_limit > 0))
    throw std::invalid_argument("servo: the velocity limit must be positive");
}

double Servo::velocity(double wanted, double reaction, const ServoLoad &load, double dt) {
  const double error = wanted - reaction, limit = parameters_.velocity_limit;
  const double dashpot =
      std::max(impedances * load.impedance, load.stiffness * dt / share_per_step) / parameters_.gain;
  double aim = dashpot > 0 ? error / dashpot : (error > 0 ? limit : (error < 0 ? -limit : 0.0));
  aim = std::clamp(aim, -limit, limit);
  velocity_ += smoothing * (aim - velocity_);
  return velocity_;
}

void Servo::describe(Archive &archive) {
  archive.version(1);
  archive("velocity", velocity_, "m/s");
}

} // namespace platen::coupling
