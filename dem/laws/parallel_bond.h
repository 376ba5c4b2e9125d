// Parallel bond (Potyondy and Cundall; Tannu 2017 with its misprints corrected) in the common elastic form of
// bond_form.h: K_s = k_s A, K_t = k_s J; the point of contact divides the distance as the radii do. For small
// motion dF_n = k_n A dU_n, dF_s = k_s A dU_s, dM_n = k_s J dtheta_n, dM_s = k_n I dtheta_s.
#pragma once

#include "base/pi.h"
#include "dem/laws/bond_form.h"

namespace platen::dem {

struct ParallelBond {
  static constexpr const char *word = "parallel bond";
  struct Parameters {
    double stiffness_ratio = 0.4;   // k_s / k_n
    double tensile_strength = 0;    // Pa; 0: never breaks in tension
    double shear_strength = 0;      // Pa; 0: never breaks in shear
    double friction_angle = 0;      // phi_b, rad
    double moment_contribution = 1; // beta, 0 ... 1
    bool moments = true;            // bending and twisting; false: spheres rotate, but bonds resist neither

    static constexpr const char *name = "ParallelBond";
    template <class Visitor, class Self>
    static void describe(Visitor &&v, Self &p) {
      v("stiffness_ratio", p.stiffness_ratio, "1", between(0, 5), "Shear over normal stiffness, k_s / k_n.");
      describe_failure(v, p);
      v("bond_moments", p.moments,
        "Bonds resist bending and twisting; without it they carry forces alone (needs rotation).");
    }
  };
  static constexpr bool needs_rotation = false, centre_to_centre = false, over_distance = false,
                        has_history = false, bonds_by_range = false;

  Parameters parameters; // as given
  BondStrength strength; // from the parameters

  ParallelBond() : ParallelBond(Parameters()) {}
  ParallelBond(const Parameters &p) : parameters(p), strength(p) {}

  // With rotation; the parameters choose whether with moments.
  BondResponse<double> operator()(const BondGeometry<double> &g, const BondMotion<double> &m) const {
    return parameters.moments ? turning<true>(g, m) : turning<false>(g, m);
  }
  template <bool moments, class Real>
  BondResponse<Real> turning(const BondGeometry<Real> &g, const BondMotion<Real> &m) const;
  // Spheres without rotation: axial and shear springs only.
  template <class Real>
  BondResponse<Real> without_rotation(const BondGeometry<Real> &g, const Triple<Real> &distance) const;
  BondStiffness stiffness(const BondGeometry<double> &g) const; // at rest
  bool bends() const { return parameters.moments; }

private:
  template <class Real>
  void add_failure(BondResponse<Real> &r, const BondGeometry<Real> &g, const BondStrain<Real> &e) const;
};

// sigma_max = F_n/A + beta |M_s| R_b/I, tau_max = |F_s|/A + beta |M_n| R_b/J, in the form that needs neither
// A nor I.
template <class Real>
PLATEN_INLINE void ParallelBond::add_failure(BondResponse<Real> &r, const BondGeometry<Real> &g,
                                             const BondStrain<Real> &e) const {
  const Parameters &p = parameters;
  const Real &kn = g.normal_stiffness;
  const Real shear_modulus = p.stiffness_ratio * kn;
  const Real turning = (2.0 * p.moment_contribution) * magnitude(e.half_cosine) * g.radius;
  const Real bending_modulus = turning * kn;
  compare_with_strength(r, strength, Real(kn * e.stretch),
                        Real(bending_modulus * bending_modulus * e.bend_square),
                        Real(shear_modulus * shear_modulus * e.slip_square),
                        Real(turning * shear_modulus * magnitude(e.twist)), g.strength_factor);
}

template <bool moments, class Real>
PLATEN_INLINE BondResponse<Real> ParallelBond::turning(const BondGeometry<Real> &g,
                                                       const BondMotion<Real> &m) const {
  const Real bond_square = g.radius * g.radius;
  const Real area_stiffness = pi * bond_square * g.normal_stiffness; // k_n A
  BondStrain<Real> strain;
  BondResponse<Real> r =
      stretch_and_shear(g, m, area_stiffness, Real(parameters.stiffness_ratio * area_stiffness), strain);
  if constexpr (moments)
    bend_and_twist(r, strain, Real(0.25 * bond_square * area_stiffness),
                   2.0 * parameters.stiffness_ratio - 1.0, m);
  add_failure(r, g, strain);
  return r;
}

template <class Real>
PLATEN_INLINE BondResponse<Real> ParallelBond::without_rotation(const BondGeometry<Real> &g,
                                                                const Triple<Real> &d) const {
  const Real area_stiffness = pi * g.radius * g.radius * g.normal_stiffness;
  const Real shear_stiffness = parameters.stiffness_ratio * area_stiffness;
  const Real length = root(dot(d, d));
  const Real inverse = 1.0 / length;
  const Triple<Real> n = scale(inverse, d);
  const Triple<Real> u = d - g.reference;
  const Real un = dot(u, n);
  const Triple<Real> us = u - scale(un, n);
  const Real stretch = length - g.rest_length, normal = area_stiffness * stretch;
  const Real zero = length * 0.0;
  BondResponse<Real> r;
  r.shear = scale(shear_stiffness, us);
  r.force = scale(normal, n) + scale(Real(1.0 - un * inverse), r.shear);
  r.torque_i = r.torque_j = {zero, zero, zero};
  const Real us2 = dot(us, us);
  r.normal_force = normal;
  r.shear_force = shear_stiffness * root(us2);
  r.energy = 0.5 * (normal * stretch + shear_stiffness * us2);
  add_failure(
      r, g,
      BondStrain<Real>{length, inverse * inverse, stretch, us, us2, zero, {zero, zero, zero}, zero, zero});
  return r;
}

inline BondStiffness ParallelBond::stiffness(const BondGeometry<double> &g) const {
  const double square = g.radius * g.radius, axial = pi * square * g.normal_stiffness;
  const double shear = parameters.stiffness_ratio * axial;
  if (!parameters.moments) return {axial, shear, 0, 0};
  return {axial, shear, 0.25 * square * axial, 0.5 * square * shear};
}

} // namespace platen::dem
