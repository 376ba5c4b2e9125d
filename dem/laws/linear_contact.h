// Unbonded contact, linear: N = k delta (physics of LS-DYNA's discrete elements). A law is a value.
#pragma once

namespace platen::dem {

struct LinearContact {
  static constexpr bool constant_stiffness = true;
  // coefficient = k_n, N/m; overlap in m.
  static double force(double coefficient, double overlap) { return coefficient * overlap; }
  static double stiffness(double coefficient, double) { return coefficient; }
  static double energy(double coefficient, double overlap) { return 0.5 * coefficient * overlap * overlap; }
};

} // namespace platen::dem
