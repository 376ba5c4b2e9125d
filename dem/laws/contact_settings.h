// Parameters of contacts between unbonded grains.
#pragma once

#include <array>

#include "base/describe.h"
#include "dem/laws/bond_layout.h"

namespace platen::dem {

enum class NormalContact { linear, hertz };
enum class TangentialContact { none, coulomb, coulomb_with_rolling };

// A contact stiffness: a multiple of k_n A of a bond of the pair, an absolute value, or LS-DYNA's NormK, a
// multiple of kap_i R_i kap_j R_j / (kap_i R_i + kap_j R_j) with kap = E / (3 (1 - 2 nu)).
struct Stiffness {
  enum class Kind { of_bond, absolute, of_bulk };
  Kind kind = Kind::of_bond;
  double value = 1; // 1, N/m or 1
};

struct ContactSettings {
  NormalContact normal = NormalContact::linear;
  TangentialContact tangential = TangentialContact::coulomb;
  double friction = 0.5;         // mu
  Stiffness stiffness;           // linear law
  double tangential_ratio = 0.5; // k_t / k_n, linear law
  double damping = 0.2;          // fraction of critical, linear law
  double restitution = 1;        // Hertz law
  double rolling_friction = 0;   // torque <= rolling_friction R* N
  double young_modulus = 17e9;   // Pa, of the grains (Hertz, of_bulk)
  double poisson_ratio = 0.15;

  // Factors on multiples of bonds, by the number of aggregate spheres in a pair (dem/heterogeneity.h).
  std::array<double, 3> modulus_factors{1, 1, 1};

  // Linear: k_n, N/m. Hertz: 4/3 E* sqrt(R*), N/m^1.5.
  double coefficient(double ri, double rj, const BondLayout &layout) const;
  double dashpot() const; // fraction of critical
  // Fraction of critical damping that the time step assumes.
  double dashpot_reserve() const;

  static constexpr const char *name = "ContactSettings";
  template <class Visitor, class Self>
  static void describe(Visitor &&v, Self &p);
};

template <class Visitor, class Self>
void ContactSettings::describe(Visitor &&v, Self &p) {
  v("tangential", p.tangential,
    Words<TangentialContact>{{"none", TangentialContact::none},
                             {"coulomb", TangentialContact::coulomb},
                             {"coulomb with rolling resistance", TangentialContact::coulomb_with_rolling}},
    "Friction between grains that touch without a bond.");
  v("friction", p.friction, "1", between(0, 5), "Coefficient of friction between grains.");
  v("stiffness", p.stiffness,
    "Normal stiffness of linear contact; \"bulk\" is a multiple of what the bulk modulus of the grains gives "
    "(NormK of LS-DYNA).");
  v("tangential_ratio", p.tangential_ratio, "1", between(0, 5),
    "Tangential over normal stiffness of linear contact.");
  v("damping", p.damping, "1", between(0, 1), "Linear contact: fraction of critical damping.");
  v("restitution", p.restitution, "1", above_up_to(0, 1), "Hertz contact: coefficient of restitution.");
  v("rolling_friction", p.rolling_friction, "1", between(0, 5),
    "Largest rolling moment over normal force and effective radius.");
  v("young_modulus", p.young_modulus, "Pa", above(0),
    "Young modulus of the grains (hertz contact; bulk stiffness of linear contact).");
  v("poisson_ratio", p.poisson_ratio, "1", between_open(-1, 0.5), "Poisson ratio of the grains.");
}

} // namespace platen::dem
