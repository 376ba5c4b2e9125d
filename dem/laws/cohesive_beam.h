// Cohesive beam (Andre et al. 2012 with its misprints corrected): an Euler-Bernoulli beam of round section
// from centre to centre, in the common elastic form of bond_form.h. A beam is a bond at the middle of its
// length l = |D| with
//   k_n = E/l, K_s = 12 E I/l^3, k_n I = E I/l, K_t = G I_o/l,
// exactly so for small rotations: the tangent at rest is the 12 x 12 matrix of the beam. The sections of the
// beam in the paper turn by finite angles; its end forces differ by a relative error of angle^2 / 6, with the
// angle of the sections against the chord (docs/theory.md): a millionth at strengths of a thousandth.
#pragma once

#include "base/pi.h"
#include "dem/laws/bond_form.h"

namespace platen::dem {

struct CohesiveBeam {
  static constexpr const char *word = "cohesive beam";
  struct Parameters {
    double poisson_ratio = 0.3;     // of the beam: G = E / (2 (1 + nu))
    double tensile_strength = 0;    // Pa; 0: never breaks in tension
    double shear_strength = 0;      // Pa; 0: never breaks in shear
    double friction_angle = 0;      // phi_b, rad
    double moment_contribution = 1; // fraction of bending and twisting in the stress at the skin, 0 ... 1

    static constexpr const char *name = "CohesiveBeam";
    template <class Visitor, class Self>
    static void describe(Visitor &&v, Self &p) {
      describe_poisson_ratio(v, p);
      describe_failure(v, p);
    }
  };
  static constexpr bool needs_rotation = true, centre_to_centre = true, over_distance = true,
                        has_history = false, bonds_by_range = false;

  Parameters parameters; // as given
  BondStrength strength; // from the parameters

  CohesiveBeam() : CohesiveBeam(Parameters()) {}
  CohesiveBeam(const Parameters &p) : parameters(p), strength(p) {}

  BondResponse<double> operator()(const BondGeometry<double> &g, const BondMotion<double> &m) const {
    return turning<true>(g, m);
  }
  // Requires that the lever of g is 1/2.
  template <bool moments, class Real>
  BondResponse<Real> turning(const BondGeometry<Real> &g, const BondMotion<Real> &m) const;
  BondStiffness stiffness(const BondGeometry<double> &g) const; // at rest
  bool bends() const { return true; }

private:
  // K_s / (k_n A) = 12 I / (A l^2) = 3 (r/l)^2
  template <class Real>
  Real shear_ratio(const BondGeometry<Real> &g) const {
    const Real slender = g.radius / g.rest_length;
    return 3.0 * slender * slender;
  }
  double more_twisting() const { return 1.0 / (1.0 + parameters.poisson_ratio) - 1.0; } // G I_o / (E I) - 1
  template <class Real>
  void add_failure(BondResponse<Real> &r, const BondGeometry<Real> &g, const Triple<Real> &d,
                   const BondStrain<Real> &e) const;
};

// At the skin of the end that bends more: sections turn against the chord by s -+ m/2, so that the end
// moments are E I/l |6 s -+ m|, with m = 2 w v_s and s = d x u_s / d^2. tau = |F_s|/A + beta |T| r/I_o.
template <class Real>
PLATEN_INLINE void CohesiveBeam::add_failure(BondResponse<Real> &r, const BondGeometry<Real> &g,
                                             const Triple<Real> &d, const BondStrain<Real> &e) const {
  const Parameters &p = parameters;
  const Real &kn = g.normal_stiffness;
  const Real skin = p.moment_contribution * g.radius * kn; // E r/l
  const Real bend = 2.0 * e.half_cosine;                   // factor from v_s to m
  const Real both = magnitude(Real(12.0 * bend * e.per_square * dot(cross(d, e.slip), e.bend)));
  const Real ends = bend * bend * e.bend_square + 36.0 * e.per_square * e.slip_square + both;
  const Real ratio = shear_ratio(g) * kn;
  compare_with_strength(
      r, strength, Real(kn * e.stretch), Real(skin * skin * ends), Real(ratio * ratio * e.slip_square),
      Real((0.5 * (1.0 + more_twisting())) * skin * magnitude(Real(bend * e.twist))), g.strength_factor);
}

template <bool moments, class Real>
PLATEN_INLINE BondResponse<Real> CohesiveBeam::turning(const BondGeometry<Real> &g,
                                                       const BondMotion<Real> &m) const {
  static_assert(moments, "a beam bends");
  const Real square = g.radius * g.radius;
  const Real area_stiffness = pi * square * g.normal_stiffness; // E S/l
  BondStrain<Real> strain;
  BondResponse<Real> r =
      stretch_and_shear(g, m, area_stiffness, Real(shear_ratio(g) * area_stiffness), strain);
  bend_and_twist(r, strain, Real(0.25 * square * area_stiffness), more_twisting(), m);
  add_failure(r, g, m.distance, strain);
  return r;
}

inline BondStiffness CohesiveBeam::stiffness(const BondGeometry<double> &g) const {
  const double square = g.radius * g.radius, axial = pi * square * g.normal_stiffness;
  const double bending = 0.25 * square * axial;
  return {axial, shear_ratio(g) * axial, bending, bending / (1 + parameters.poisson_ratio)};
}

} // namespace platen::dem
