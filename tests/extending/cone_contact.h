// Example of a normal contact law: a blunt cone on a flat (Sneddon 1965), N = (2 / pi) E* tan(alpha) d^2,
// with tan(alpha) = 1 and equal materials.
#pragma once

#include <cmath>

#include "base/pi.h"
#include "dem/laws/contact_settings.h"

namespace platen::dem {

struct ConeContact {
  static constexpr NormalContact kind = NormalContact::cone;
  static constexpr const char *word = "cone";
  static constexpr bool constant_stiffness = false;
  template <class Real>
  static Real force(const Real &coefficient, const Real &overlap) {
    return coefficient * overlap * overlap;
  }
  template <class Real>
  static Real stiffness(const Real &coefficient, const Real &overlap) {
    return Real(2.0) * coefficient * overlap;
  }
  static double energy(double coefficient, double overlap) {
    return coefficient * overlap * overlap * overlap / 3;
  }
  static double overlap_of_energy(double coefficient, double energy) {
    return std::cbrt(3 * energy / coefficient);
  }
  static double coefficient(const ContactSettings &s, double, double, const BondLayout &) {
    return 2 / pi * s.young_modulus / (2 * (1 - s.poisson_ratio * s.poisson_ratio));
  }
  static bool follows_bonds(const ContactSettings &) { return false; }
  static double tangential_ratio(const ContactSettings &s) { return s.tangential_ratio; }
  static double dashpot(const ContactSettings &) { return 0; }
  static double dashpot_reserve(const ContactSettings &) { return 0.5; }
};

} // namespace platen::dem
