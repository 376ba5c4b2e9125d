// Option of the elasto-damage-plastic cohesive bonds: bending and twisting. The moments are those of the
// parallel bond (bond_form.h), k_n I and k_s J times the relative rotation, in total form, without further
// history. Without damage they load the skin, T + beta |M_b| R_b/I and k_s |u_s| + beta |M_t| R_b/J, and they
// soften with the more damaged one of tension and shear: M = min(g(D_n), g(D_s)) M_undamaged. A failed bond
// has no moments. Yield does not change them.
#pragma once

#include "dem/laws/elasto_damage_plastic.h"

namespace platen::dem {

// The law with bending: for loops, which choose one of the two once per block.
struct BendingCohesive {
  static constexpr bool needs_orientations = true;
  template <class Real>
  using State = CohesiveState<Real>;

  const ElastoDamagePlastic &law;

  // Moments of a bond in this pose without damage, and the stresses that they cause at the skin.
  template <class Real>
  struct Undamaged {
    BondResponse<Real> moments; // N, N m, J: by moments alone
    SkinStress<Real> skin;
  };
  template <class Real>
  Undamaged<Real> undamaged(const CohesiveGeometry<Real> &g, const BondMotion<Real> &pose) const;

  template <class Real>
  CohesiveResponse<Real> operator()(CohesiveState<Real> &s, const CohesiveGeometry<Real> &g,
                                    const CohesiveMotion<Real> &m) const;
  // As in the law without moments.
  static constexpr bool intact_reads_motion = true, failed_rows_last = true;
  static constexpr const auto &intact_members = ElastoDamagePlastic::intact_members;
  template <class Real>
  bool advance_intact(CohesiveState<Real> &s, const CohesiveGeometry<Real> &g, const CohesiveMotion<Real> &m,
                      CohesiveResponse<Real> &r, bool &yielded) const;
  template <class Real>
  static Real failed(const CohesiveState<Real> &s) {
    return ElastoDamagePlastic::failed(s);
  }
  template <class Real>
  bool stays_separated(const CohesiveState<Real> &s, const CohesiveGeometry<Real> &g,
                       const Triple<Real> &distance) const {
    return law.stays_separated(s, g, distance);
  }
  template <class Real>
  CohesiveResponse<Real> advance_broken(CohesiveState<Real> &s, const CohesiveGeometry<Real> &g,
                                        const CohesiveMotion<Real> &m) const {
    return law.advance_broken(s, g, m); // a broken bond has no moments
  }
  template <class Real>
  ForceAndEnergy<Real> force_and_energy(const CohesiveState<Real> &s, const CohesiveGeometry<Real> &g,
                                        const BondMotion<Real> &pose) const {
    const ForceAndEnergy<Real> forces = law.force_and_energy(s, g, pose);
    const BondResponse<Real> moments = undamaged(g, pose).moments;
    const Real left = law.fraction_of_moments(s, g);
    return {forces.force + scale(left, moments.force), forces.energy + left * moments.energy};
  }
  template <class Real>
  Real plastic_work(const CohesiveState<Real> &s, const CohesiveGeometry<Real> &g) const {
    return law.plastic_work(s, g);
  }
  template <class Real>
  static Real damage_of(const CohesiveState<Real> &s) {
    return ElastoDamagePlastic::damage_of(s);
  }
};

template <class Real>
PLATEN_INLINE auto BendingCohesive::undamaged(const CohesiveGeometry<Real> &g,
                                              const BondMotion<Real> &pose) const -> Undamaged<Real> {
  const Real kn = g.normal_stiffness, ks = law.shear_ratio() * kn, square = dot(pose.distance, pose.distance);
  BondStrain<Real> e;
  e.length = root(square), e.per_square = 1.0 / square;
  Undamaged<Real> w{};
  bend_and_twist(w.moments, e, Real(0.25 * g.radius * g.radius * g.area * kn), 2.0 * law.shear_ratio() - 1.0,
                 pose);
  const Real turning = (2.0 * law.parameters.moment_contribution) * magnitude(e.half_cosine) * g.radius;
  w.skin.bending = turning * kn * root(e.bend_square);
  w.skin.twisting = turning * ks * magnitude(e.twist);
  return w;
}

template <class Real>
PLATEN_INLINE CohesiveResponse<Real> BendingCohesive::operator()(CohesiveState<Real> &s,
                                                                 const CohesiveGeometry<Real> &g,
                                                                 const CohesiveMotion<Real> &m) const {
  const Real was = law.fraction_of_moments(s, g);
  const Undamaged<Real> w = undamaged(g, BondMotion<Real>{m.distance, m.turn_i, m.turn_j});
  CohesiveResponse<Real> r = law.template advance_under<true>(w.skin, s, g, m);
  const Real is = law.fraction_of_moments(s, g);
  // As for every spring that loses a fraction: the product of both ends; the first end is the second less the
  // step.
  const BondResponse<Real> &moments = w.moments;
  const Real step = dot(moments.force, m.travelled) - dot(moments.torque_i, m.turned_i) -
                    dot(moments.torque_j, m.turned_j); // J
  s.dissipated = s.dissipated + 0.5 * (was - is) * (2.0 * moments.energy - step);
  const Triple<Real> moment = cross(m.distance, r.force); // by the forces at their arms
  r.torque_i = scale(g.lever, moment) + scale(is, moments.torque_i);
  r.torque_j = scale(Real(1.0 - g.lever), moment) + scale(is, moments.torque_j);
  r.force = r.force + scale(is, moments.force);
  r.energy = r.energy + is * moments.energy;
  return r;
}

template <class Real>
PLATEN_INLINE bool BendingCohesive::advance_intact(CohesiveState<Real> &s, const CohesiveGeometry<Real> &g,
                                                   const CohesiveMotion<Real> &m, CohesiveResponse<Real> &r,
                                                   bool &yielded) const {
  const Undamaged<Real> w = undamaged(g, BondMotion<Real>{m.distance, m.turn_i, m.turn_j});
  if (!law.template advance_intact<true>(w.skin, s, g, m, r, yielded)) return false;
  const Triple<Real> moment = cross(m.distance, r.force);
  r.torque_i = scale(g.lever, moment) + w.moments.torque_i;
  r.torque_j = scale(Real(1.0 - g.lever), moment) + w.moments.torque_j;
  r.force = r.force + w.moments.force;
  return true;
}

inline BondResponse<double> ElastoDamagePlastic::bond_response(const CohesiveState<double> &s,
                                                               const CohesiveGeometry<double> &g,
                                                               const CohesiveMotion<double> &m) const {
  if (!parameters.moments) return response_under({0, 0}, s, g, m);
  const BendingCohesive::Undamaged<double> undamaged =
      BendingCohesive{*this}.undamaged(g, BondMotion<double>{m.distance, m.turn_i, m.turn_j});
  BondResponse<double> r = response_under(undamaged.skin, s, g, m);
  const double left = fraction_of_moments(s, g);
  r.force = r.force + scale(left, undamaged.moments.force);
  r.torque_i = r.torque_i + scale(left, undamaged.moments.torque_i);
  r.torque_j = r.torque_j + scale(left, undamaged.moments.torque_j);
  r.energy += left * undamaged.moments.energy;
  return r;
}

} // namespace platen::dem
