// Example of a bond law: a spring between the centres and nothing else, for trusses. It breaks in tension.
#pragma once

#include "dem/laws/parallel_bond.h"

namespace platen::dem {

struct SpringBond {
  static constexpr const char *word = "spring";
  struct Parameters {
    double tensile_strength = 0;    // Pa; 0: never breaks
    double shear_strength = 0;      // Pa; there is no shear
    double friction_angle = 0;      // rad; the same
    double moment_contribution = 1; // 1; there are no moments
    double axial_share = 1;         // of the stiffness that a bond of this area has

    static constexpr const char *name = "SpringBond";
    template <class Visitor, class Self>
    static void describe(Visitor &&v, Self &p) {
      describe_failure(v, p);
      v("axial_share", p.axial_share, "1", above_up_to(0, 1),
        "Share of the axial stiffness of a solid bond.");
    }
  };
  static constexpr bool needs_rotation = false, centre_to_centre = false, over_distance = false,
                        has_history = false, bonds_by_range = false;

  Parameters parameters;
  ParallelBond spring; // without shear and moments

  SpringBond() : SpringBond(Parameters()) {}
  SpringBond(const Parameters &p)
      : parameters(p),
        spring(ParallelBond::Parameters{0, p.tensile_strength, p.shear_strength, p.friction_angle,
                                        p.moment_contribution, false}) {}

  template <class Real>
  BondGeometry<Real> softer(BondGeometry<Real> g) const {
    g.normal_stiffness = parameters.axial_share * g.normal_stiffness;
    return g;
  }
  BondResponse<double> operator()(const BondGeometry<double> &g, const BondMotion<double> &m) const {
    return spring(softer(g), m);
  }
  template <bool moments, class Real>
  BondResponse<Real> turning(const BondGeometry<Real> &g, const BondMotion<Real> &m) const {
    return spring.turning<false>(softer(g), m);
  }
  template <class Real>
  BondResponse<Real> without_rotation(const BondGeometry<Real> &g, const Triple<Real> &d) const {
    return spring.without_rotation(softer(g), d);
  }
  BondStiffness stiffness(const BondGeometry<double> &g) const { return spring.stiffness(softer(g)); }
  bool bends() const { return false; }
};

} // namespace platen::dem
