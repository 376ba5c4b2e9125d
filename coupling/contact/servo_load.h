#pragma once

namespace platen::coupling {

// The resistance to the platen, summed over the particles that it touches or may touch soon.
struct ServoLoad {
  double stiffness = 0; // N/m, sum of k_n
  double impedance = 0; // N s/m, sum of sqrt(k_n m): force per speed of an impact
};

} // namespace platen::coupling
