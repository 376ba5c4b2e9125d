// Unbonded contact after Hertz, with Mindlin's tangential stiffness (no slip): Tannu 2017 (8)-(10), where (9)
// prints the tangential for the normal overlap and (10) 1 - nu^2 for 2 - nu.
#pragma once

#include <cmath>

namespace platen::dem {

struct HertzContact {
  static constexpr bool constant_stiffness = false;
  // coefficient = 4/3 E* sqrt(R*), N/m^1.5; overlap in m.
  static double force(double coefficient, double overlap) {
    return coefficient * overlap * std::sqrt(overlap);
  }
  static double stiffness(double coefficient, double overlap) {
    return 1.5 * coefficient * std::sqrt(overlap);
  }
  static double energy(double coefficient, double overlap) {
    return 0.4 * coefficient * overlap * overlap * std::sqrt(overlap);
  }
  // Equal materials: 1/E* = 2 (1 - nu^2)/E, 1/R* = 1/R_i + 1/R_j.
  static double coefficient(double young_modulus, double poisson_ratio, double ri, double rj) {
    const double effective_modulus = young_modulus / (2 * (1 - poisson_ratio * poisson_ratio));
    return 4.0 / 3.0 * effective_modulus * std::sqrt(ri * rj / (ri + rj));
  }
  // k_t / k_n of equal materials, independent of the overlap.
  static double tangential_ratio(double poisson_ratio) {
    return 2 * (1 - poisson_ratio) / (2 - poisson_ratio);
  }
  // Dashpot F = 2 sqrt(5/6) xi sqrt(k m*) v that gives restitution e when it is not clamped.
  static double damping_fraction(double restitution) {
    const double logarithm = std::log(restitution), pi = 3.14159265358979323846;
    return -std::sqrt(5.0 / 6.0) * logarithm / std::sqrt(logarithm * logarithm + pi * pi);
  }
};

} // namespace platen::dem
