// A servo that moves a platen so that its reaction meets a wanted force: loading by force, confining plates,
// seating.
//
// It is the discrete form of a light piston with a dashpot, m dv/dt = F_wanted - F - c v. A piston takes
// energy out of whatever it presses on and puts none in beyond the work of the wanted force, so it stays
// stable against any specimen, cracking ones too; only the time step limits it, and c is chosen far above
// that limit.
#pragma once

#include <limits>

#include "base/archive.h"

namespace platen::coupling {

// What the platen presses on, summed over the particles that it touches or may touch soon.
struct ServoLoad {
  double stiffness = 0; // N/m, sum of k_n
  double impedance = 0; // N s/m, sum of sqrt(k_n m): force per speed of an impact
};

class Servo {
public:
  struct Parameters {
    double gain = 1; // multiplies the response; 0.1 ... 10 are safe, larger is faster
    double velocity_limit = std::numeric_limits<double>::quiet_NaN(); // m/s, > 0
  };
  // Throws std::invalid_argument where a parameter is not positive.
  explicit Servo(const Parameters &parameters);

  // Velocity (m/s) for the next step dt (s), positive towards the specimen. Forces in N, positive in
  // compression: `reaction` is that of the last step. Without anything near (zero load) it closes in at the
  // velocity limit.
  double velocity(double wanted, double reaction, const ServoLoad &load, double dt);

  void describe(Archive &archive);

private:
  Parameters parameters_;
  double velocity_ = 0;
};

} // namespace platen::coupling
