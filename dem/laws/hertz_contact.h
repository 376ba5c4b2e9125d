// Unbonded Hertz contact, with Mindlin's tangential stiffness (no slip): Tannu 2017 (8)-(10), where (9)
// misprints the tangential for the normal overlap and (10) 1 - nu^2 for 2 - nu.
#pragma once

#include <cmath>

#include "base/pi.h"
#include "base/portable.h"
#include "dem/laws/bond_form.h"
#include "dem/laws/contact_settings.h"

namespace platen::dem {

struct HertzContact {
  static constexpr NormalContact kind = NormalContact::hertz;
  static constexpr const char *word = "hertz";
  static constexpr bool constant_stiffness = false;
  // coefficient = 4/3 E* sqrt(R*), N/m^1.5; overlap in m.
  template <class Real>
  PLATEN_INLINE static Real force(const Real &coefficient, const Real &overlap) {
    return coefficient * overlap * root(overlap);
  }
  template <class Real>
  PLATEN_INLINE static Real stiffness(const Real &coefficient, const Real &overlap) {
    return Real(1.5) * coefficient * root(overlap);
  }
  static double energy(double coefficient, double overlap) {
    return 0.4 * coefficient * overlap * overlap * std::sqrt(overlap);
  }
  static double overlap_of_energy(double coefficient, double energy) {
    return portable::pow(2.5 * energy / coefficient, 0.4);
  }
  // Equal materials: 1/E* = 2 (1 - nu^2)/E, 1/R* = 1/R_i + 1/R_j.
  static double coefficient(const ContactSettings &s, double ri, double rj, const BondLayout & /*bonds*/) {
    const double effective_modulus = s.young_modulus / (2 * (1 - s.poisson_ratio * s.poisson_ratio));
    return 4.0 / 3.0 * effective_modulus * std::sqrt(ri * rj / (ri + rj));
  }
  static bool follows_bonds(const ContactSettings & /*s*/) { return false; }
  // k_t / k_n for equal materials, independent of the overlap.
  static double tangential_ratio(const ContactSettings &s) {
    return 2 * (1 - s.poisson_ratio) / (2 - s.poisson_ratio);
  }
  // F = 2 sqrt(5/6) xi sqrt(k m*) v, which gives the restitution when it is not clamped.
  static double dashpot(const ContactSettings &s) {
    const double logarithm = portable::log(s.restitution);
    return -std::sqrt(5.0 / 6.0) * logarithm / std::sqrt(logarithm * logarithm + pi * pi);
  }
  // For the time step: stiffness grows with the overlap; a fixed reserve instead of a law.
  static double dashpot_reserve(const ContactSettings & /*s*/) { return 0.5; }
};

} // namespace platen::dem
