// Values of a scene that a number alone does not state.
#pragma once

#include <limits>

namespace platen::apps {

constexpr double not_given = std::numeric_limits<double>::quiet_NaN();

// How often: a count of steps, a time (simulated seconds; wall clock for checkpoints), or none of both.
struct Interval {
  enum class Kind { none, steps, time }; // none: the app chooses, or the thing is off (see the member)
  Kind kind = Kind::none;
  double value = 0; // steps or s
};

// A length, absolute or as a multiple of the smaller radius of a pair.
struct Gap {
  bool relative = true;
  double value = 0.05; // of the smaller radius, or m
  double length(double smaller_radius) const { return relative ? value * smaller_radius : value; } // m
};

// A contact stiffness: a multiple of the bond's stiffness, an absolute one, or a multiple of the one that the
// bulk modulus K of the grains gives, k = value K_i R_i K_j R_j / (K_i R_i + K_j R_j).
struct Stiffness {
  enum class Kind { of_bond, absolute, of_bulk };
  Kind kind = Kind::of_bond;
  double value = 1; // 1, N/m or 1
};

} // namespace platen::apps
