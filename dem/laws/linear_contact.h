// Linear unbonded contact: N = k delta (physics of LS-DYNA's discrete elements). A law is a value.
#pragma once

#include <cmath>

#include "dem/laws/bond_form.h"
#include "dem/laws/contact_settings.h"

namespace platen::dem {

struct LinearContact {
  static constexpr NormalContact kind = NormalContact::linear;
  static constexpr const char *word = "linear";
  static constexpr bool constant_stiffness = true;
  // coefficient = k_n, N/m; overlap in m.
  template <class Real>
  PLATEN_INLINE static Real force(const Real &coefficient, const Real &overlap) {
    return coefficient * overlap;
  }
  template <class Real>
  PLATEN_INLINE static Real stiffness(const Real &coefficient, const Real & /*overlap*/) {
    return coefficient;
  }
  static double energy(double coefficient, double overlap) { return 0.5 * coefficient * overlap * overlap; }
  static double overlap_of_energy(double coefficient, double energy) {
    return std::sqrt(2 * energy / coefficient);
  }
  static double coefficient(const ContactSettings &s, double ri, double rj, const BondLayout &layout) {
    switch (s.stiffness.kind) {
      case Stiffness::Kind::of_bond:
        return s.stiffness.value * layout.axial_stiffness(ri, rj);
      case Stiffness::Kind::absolute:
        return s.stiffness.value;
      case Stiffness::Kind::of_bulk:
        break;
    }
    const double kappa = s.young_modulus / (3 * (1 - 2 * s.poisson_ratio));
    return s.stiffness.value * kappa * ri * rj / (ri + rj);
  }
  static bool follows_bonds(const ContactSettings &s) { return s.stiffness.kind == Stiffness::Kind::of_bond; }
  static double tangential_ratio(const ContactSettings &s) { return s.tangential_ratio; }
  static double dashpot(const ContactSettings &s) { return s.damping; }
  static double dashpot_reserve(const ContactSettings &s) { return s.damping; }
};

} // namespace platen::dem
