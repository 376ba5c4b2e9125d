// Parallel bond that yields in compression: brittle in tension and shear as parallel_bond.h, with the same
// shear, bending and twisting in total form, and with a plastic closing along straight branches
// (compression_branches.h). A broken bond remains as the contact of its pair: with the same zero of overlap,
// so that its compression continues to yield, with the rest of its shear force up to Coulomb's limit, and
// without moments or tension.
//
// In stresses: k_n = G_b/|D| per area, q = k_n p the plastic closing, u_s the slip at the point of contact:
//   T = k_n (|d| - |D|) + q                          > 0: tension
//   q >= e - envelope(e), e = -k_n (|d| - |D|)       also once it has broken
//   breaks: T + beta |M_b| R_b/I >= sigma_c or |F_s|/A + beta |M_t| R_b/J >= tau_c + tan(phi_b) max(-T, 0)
//   intact: F_n = A T, F_s = r k_n A u_s, moments k_n I and r k_n J times the relative rotation
//   broken: F_n = A min(T, 0), F_s = r k_n A x with |r k_n x| <= mu max(-T, 0), x at first u_s
#pragma once

#include <vector>

#include "dem/laws/cohesive_form.h"
#include "dem/laws/compression_branches.h"
#include "dem/laws/parallel_bond.h"

namespace platen::dem {

struct YieldingParallelBond {
  static constexpr const char *word = "yielding parallel bond";
  struct Parameters : ParallelBond::Parameters {
    // Pa, and E_0 / E of the branch that begins there. Up to three; empty: no yield.
    std::vector<double> compression_limits, compression_slopes;

    static constexpr const char *name = "YieldingParallelBond";
    template <class Visitor, class Self>
    static void describe(Visitor &&v, Self &p) {
      ParallelBond::Parameters::describe(v, p);
      describe_compression(v, p);
    }
  };
  static constexpr bool needs_rotation = false, centre_to_centre = false, over_distance = true,
                        has_history = true, bonds_by_range = false, needs_orientations = true;

  YieldingParallelBond() : YieldingParallelBond(Parameters()) {}
  // Throws BadParameter if there are more than three branches, or if compression would grow stiffer again.
  YieldingParallelBond(const Parameters &p)
      : parameters(p),
        strength(p),
        compression(Parameters::name, p.compression_limits, p.compression_slopes) {}

  Parameters parameters; // as given
  BondStrength strength; // from the parameters
  CompressionBranches compression;
  double grain_friction = 0; // mu of broken bonds: that of contacts between grains

  template <class Real>
  struct State {
    Real plastic;        // q, Pa, >= 0
    Real broken;         // 0: intact; 1: broken in tension, 2: in shear
    Real dissipated;     // J: at the break until it is reported, by friction afterwards
    Triple<Real> slider; // x, m; of a broken bond

    template <class Visitor, class... States>
    static void describe(Visitor &&v, States &...s) {
      v("plastic", "Pa", s.plastic...);
      v("broken", "1", s.broken...);
      v("dissipated", "J", s.dissipated...);
      v("friction_spring", "m", s.slider...);
    }
  };
  template <class Real>
  static Real damage_of(const State<Real> &s) {
    const Real zero = s.broken * 0.0;
    return where_positive(s.broken, Real(zero + 1.0), zero);
  }
  // Returns a positive value for a failed bond, otherwise 0.
  template <class Real>
  static Real failed(const State<Real> &s) {
    return s.broken;
  }
  static bool failed_in_tension(const State<double> &s) { return s.broken == 1; }

  bool bends() const { return parameters.moments; }
  BondStiffness stiffness(const BondGeometry<double> &g) const {
    return ParallelBond(parameters).stiffness(g);
  }

  // Updates the state and returns the response.
  template <class Real>
  CohesiveResponse<Real> operator()(State<Real> &s, const CohesiveGeometry<Real> &g,
                                    const CohesiveMotion<Real> &m) const;
  // The quick path of intact bonds (cohesive_form.h), from their pose alone. It calls pair.pose() once the
  // yield is known, because not all of it fits the registers.
  static constexpr bool intact_reads_motion = false;
  static constexpr Changes intact_members[] = {Changes::rarely, Changes::never, Changes::never,
                                               Changes::never};
  template <class Real, class Pair>
  bool advance_intact(State<Real> &s, const CohesiveGeometry<Real> &g, const Pair &pair,
                      CohesiveResponse<Real> &r, bool &yielded) const;
  // Broken bonds are stored behind intact ones, so that all bonds of a SIMD vector are of one kind.
  static constexpr bool failed_rows_last = true;
  // For a SIMD vector of broken bonds: whether all are separated now and were before, so that no force acts
  // and no state changes.
  template <class Real>
  bool stays_separated(const State<Real> &s, const CohesiveGeometry<Real> &g,
                       const Triple<Real> &distance) const;
  // The step (call operator) for such a SIMD vector; it needs no orientations.
  template <class Real>
  CohesiveResponse<Real> advance_broken(State<Real> &s, const CohesiveGeometry<Real> &g,
                                        const CohesiveMotion<Real> &m) const;
  // Tangent stiffness (N/m, N m) if the motion from a state to the present continues: that of the branch
  // where the bond yields, 0 for a separated pair, 0 in shear for a sliding one. The friction across the slip
  // direction and its unsymmetric growth with the pressure are left out.
  BondStiffness tangent(State<double> from, const CohesiveGeometry<double> &g,
                        const CohesiveMotion<double> &m) const;
  // The response of the given state.
  BondResponse<double> bond_response(const State<double> &s, const CohesiveGeometry<double> &g,
                                     const CohesiveMotion<double> &m) const;
  // The same, force and stored energy alone.
  template <class Real>
  ForceAndEnergy<Real> force_and_energy(const State<Real> &s, const CohesiveGeometry<Real> &g,
                                        const BondMotion<Real> &pose) const;
  // J, dissipated by plastic closing.
  template <class Real>
  Real plastic_work(const State<Real> &s, const CohesiveGeometry<Real> &g) const {
    return g.area * compression.work(s.plastic) / g.normal_stiffness;
  }

private:
  template <class Real>
  BondResponse<Real> intact(const Real &plastic, const CohesiveGeometry<Real> &g,
                            const BondMotion<Real> &pose, Triple<Real> &slip) const;
  template <class Real>
  BondResponse<Real> broken(const State<Real> &s, const CohesiveGeometry<Real> &g,
                            const Triple<Real> &distance) const;
  template <class Real>
  Real yields(const Real &plastic, const Real &elastic) const;
  template <class Real>
  static Real reached(const BondResponse<Real> &bond);
  template <class Real>
  static void write_response(const BondResponse<Real> &bond, const Real &tension, CohesiveResponse<Real> &r);
};

// As ParallelBond::turning, with the force of the plastic closing added.
template <class Real>
PLATEN_INLINE BondResponse<Real> YieldingParallelBond::intact(const Real &plastic,
                                                              const CohesiveGeometry<Real> &g,
                                                              const BondMotion<Real> &pose,
                                                              Triple<Real> &slip) const {
  const Parameters &p = parameters;
  const Real area_stiffness = g.area * g.normal_stiffness, kn = g.normal_stiffness;
  const BondGeometry<Real> bond{g.reference, g.rest_length, g.lever, kn, g.radius, g.strength_factor};
  BondStrain<Real> e;
  BondResponse<Real> r =
      stretch_and_shear(bond, pose, area_stiffness, Real(p.stiffness_ratio * area_stiffness), e);
  if (p.moments)
    bend_and_twist(r, e, Real(0.25 * g.radius * g.radius * area_stiffness), 2.0 * p.stiffness_ratio - 1.0,
                   pose);
  const Real yielded = g.area * plastic; // N, added to the force of the stretch
  r.force = r.force + scale(Real(yielded * e.length * e.per_square), pose.distance);
  r.energy = r.energy + yielded * (e.stretch + 0.5 * plastic / kn);
  r.normal_force = r.normal_force + yielded;
  slip = e.slip;

  const Real shear_modulus = p.stiffness_ratio * kn;
  const Real turning = (2.0 * p.moment_contribution) * magnitude(e.half_cosine) * g.radius;
  const Real bending_modulus = turning * kn;
  compare_with_strength(r, strength, Real(kn * e.stretch + plastic),
                        Real(bending_modulus * bending_modulus * e.bend_square),
                        Real(shear_modulus * shear_modulus * e.slip_square),
                        Real(turning * shear_modulus * magnitude(e.twist)), g.strength_factor);
  return r;
}

template <class Real>
PLATEN_INLINE BondResponse<Real> YieldingParallelBond::broken(const State<Real> &s,
                                                              const CohesiveGeometry<Real> &g,
                                                              const Triple<Real> &distance) const {
  const Real kn = g.normal_stiffness, ks = parameters.stiffness_ratio * kn;
  const Real length = root(dot(distance, distance));
  const Real closing = positive_part(Real(kn * (g.rest_length - length) - s.plastic));
  BondResponse<Real> r;
  r.normal_force = -g.area * closing;
  r.shear = scale(Real(g.area * ks), s.slider);
  r.force = scale(Real(r.normal_force / length), distance) + r.shear;
  const Triple<Real> moment = cross(distance, r.shear);
  r.torque_i = scale(g.lever, moment);
  r.torque_j = scale(Real(1.0 - g.lever), moment);
  r.energy = 0.5 * g.area * (closing * closing / kn + ks * dot(s.slider, s.slider));
  return r;
}

template <class Real>
PLATEN_INLINE void YieldingParallelBond::write_response(const BondResponse<Real> &bond, const Real &tension,
                                                        CohesiveResponse<Real> &r) {
  r.force = bond.force, r.torque_i = bond.torque_i, r.torque_j = bond.torque_j, r.shear = bond.shear;
  r.normal = bond.normal_force, r.energy = bond.energy, r.tension = tension;
  r.failed_now = tension * 0.0;
}

// 1 where the strength is reached, otherwise 0.
template <class Real>
PLATEN_INLINE Real YieldingParallelBond::reached(const BondResponse<Real> &bond) {
  const Real zero = bond.excess * 0.0;
  return where_positive(Real(-bond.excess), zero, Real(zero + 1.0));
}

template <class Real>
PLATEN_INLINE Real YieldingParallelBond::yields(const Real &plastic, const Real &elastic) const {
  return positive_part(Real(elastic - compression.envelope(elastic) - plastic));
}

template <class Real, class Pair>
PLATEN_INLINE bool YieldingParallelBond::advance_intact(State<Real> &s, const CohesiveGeometry<Real> &g,
                                                        const Pair &pair, CohesiveResponse<Real> &r,
                                                        bool &yielded) const {
  if (any_positive(s.broken)) return false;
  const Real length = root(dot(pair.distance, pair.distance));
  const Real elastic = g.normal_stiffness * (g.rest_length - length);
  const Real yield = yields(s.plastic, elastic), plastic = s.plastic + yield;
  Triple<Real> slip;
  const BondResponse<Real> bond = intact(plastic, g, pair.pose(), slip);
  if (!all_positive(Real(-bond.excess))) return false;
  yielded = any_positive(yield);
  s.plastic = plastic;
  write_response(bond, Real(plastic - elastic), r);
  return true;
}

template <class Real>
PLATEN_INLINE CohesiveResponse<Real> YieldingParallelBond::operator()(State<Real> &s,
                                                                      const CohesiveGeometry<Real> &g,
                                                                      const CohesiveMotion<Real> &m) const {
  const Real kn = g.normal_stiffness, ks = parameters.stiffness_ratio * kn;
  const Real length = root(dot(m.distance, m.distance)), elastic = kn * (g.rest_length - length);
  const Real zero = elastic * 0.0, one = zero + 1.0;
  s.plastic = s.plastic + yields(s.plastic, elastic);
  Triple<Real> slip;
  const BondResponse<Real> bond = intact(s.plastic, g, {m.distance, m.turn_i, m.turn_j}, slip);
  CohesiveResponse<Real> r;
  write_response(bond, Real(s.plastic - elastic), r);
  const Real was_broken = s.broken;
  const Real breaking = where_positive(was_broken, zero, reached(bond));
  if (!any_positive(Real(was_broken + breaking))) return r;

  // Bonds that break in this step, and their mode.
  const Real mode = where_positive(Real(bond.shear_ratio - bond.tension_ratio), Real(one + 1.0), one);
  const Real breaks = breaking * mode;
  s.broken = s.broken + breaks;

  // A broken bond slides from its last spring, or from its slip at the break.
  PlaneMotion<Real> plane(m, length);
  plane.take_from_the_middle(m.moved);
  const auto choose = [](const Real &x, const Triple<Real> &a, const Triple<Real> &b) {
    return Triple<Real>{where_positive(x, a.x, b.x), where_positive(x, a.y, b.y),
                        where_positive(x, a.z, b.z)};
  };
  const Triple<Real> nothing{zero, zero, zero};
  const Triple<Real> carried = plane.carried(s.slider);
  const Triple<Real> spring = choose(was_broken, carried, choose(breaks, slip, nothing));
  const Real cap = grain_friction * positive_part(Real(elastic - s.plastic)); // Pa
  const Real let_slip = slipping_fraction(spring, ks, cap);
  s.slider = scale(Real(1.0 - let_slip), spring);
  const BondResponse<Real> contact = broken(s, g, m.distance);

  // Friction: (F before + F now)/2 times the slip. A break: the loss of stored energy, less half of the work
  // of the lost force in the step, by the trapezoidal rule over the drift.
  const Triple<Real> before = carried - plane.moved;
  const Real rubbed = 0.5 * g.area * ks * dot(before + s.slider, scale(let_slip, spring));
  const auto taken = [&](const BondResponse<Real> &by) { // J
    return dot(by.force, m.travelled) - dot(by.torque_i, m.turned_i) - dot(by.torque_j, m.turned_j);
  };
  const Real released = bond.energy - contact.energy - 0.5 * (taken(bond) - taken(contact));
  s.dissipated = s.dissipated + where_positive(was_broken, rubbed, where_positive(breaks, released, zero));

  r.force = choose(s.broken, contact.force, bond.force);
  r.torque_i = choose(s.broken, contact.torque_i, bond.torque_i);
  r.torque_j = choose(s.broken, contact.torque_j, bond.torque_j);
  r.shear = choose(s.broken, contact.shear, bond.shear);
  r.normal = where_positive(s.broken, contact.normal_force, bond.normal_force);
  r.energy = where_positive(s.broken, contact.energy, bond.energy);
  r.failed_now = breaks;
  return r;
}

template <class Real>
PLATEN_INLINE bool YieldingParallelBond::stays_separated(const State<Real> &s,
                                                         const CohesiveGeometry<Real> &g,
                                                         const Triple<Real> &distance) const {
  return are_separated(g, distance, s.plastic, s.slider);
}

template <class Real>
PLATEN_INLINE CohesiveResponse<Real> YieldingParallelBond::advance_broken(
    State<Real> &s, const CohesiveGeometry<Real> &g, const CohesiveMotion<Real> &m) const {
  const Real kn = g.normal_stiffness, ks = parameters.stiffness_ratio * kn;
  const Real length = root(dot(m.distance, m.distance)), elastic = kn * (g.rest_length - length);
  s.plastic = s.plastic + yields(s.plastic, elastic);
  PlaneMotion<Real> plane(m, length);
  plane.take_from_the_middle(m.moved);
  const Triple<Real> carried = plane.carried(s.slider), before = carried - plane.moved;
  const Real cap = grain_friction * positive_part(Real(elastic - s.plastic)); // Pa
  const Real let_slip = slipping_fraction(carried, ks, cap);
  s.slider = scale(Real(1.0 - let_slip), carried);
  s.dissipated = s.dissipated + 0.5 * g.area * ks * dot(before + s.slider, scale(let_slip, carried));
  CohesiveResponse<Real> r;
  write_response(broken(s, g, m.distance), Real(s.plastic - elastic), r);
  return r;
}

template <class Real>
PLATEN_INLINE ForceAndEnergy<Real> YieldingParallelBond::force_and_energy(
    const State<Real> &s, const CohesiveGeometry<Real> &g, const BondMotion<Real> &pose) const {
  Triple<Real> slip;
  const BondResponse<Real> bond = intact(s.plastic, g, pose, slip);
  if (!any_positive(s.broken)) return {bond.force, bond.energy};
  const BondResponse<Real> contact = broken(s, g, pose.distance);
  return {{where_positive(s.broken, contact.force.x, bond.force.x),
           where_positive(s.broken, contact.force.y, bond.force.y),
           where_positive(s.broken, contact.force.z, bond.force.z)},
          where_positive(s.broken, contact.energy, bond.energy)};
}

inline BondResponse<double> YieldingParallelBond::bond_response(const State<double> &s,
                                                                const CohesiveGeometry<double> &g,
                                                                const CohesiveMotion<double> &m) const {
  Triple<double> slip;
  BondResponse<double> r = intact(s.plastic, g, {m.distance, m.turn_i, m.turn_j}, slip);
  if (s.broken > 0) {
    const BondResponse<double> contact = broken(s, g, m.distance);
    r.force = contact.force, r.torque_i = contact.torque_i, r.torque_j = contact.torque_j;
    r.energy = contact.energy, r.normal_force = contact.normal_force, r.shear = contact.shear;
  }
  r.shear_force = root(dot(r.shear, r.shear));
  return r;
}

inline BondStiffness YieldingParallelBond::tangent(State<double> s, const CohesiveGeometry<double> &g,
                                                   const CohesiveMotion<double> &m) const {
  const State<double> from = s;
  const CohesiveResponse<double> now = (*this)(s, g, m);
  BondStiffness k = stiffness({g.reference, g.rest_length, g.lever, g.normal_stiffness, g.radius});
  const double closing = g.normal_stiffness * (g.rest_length - root(dot(m.distance, m.distance)));
  if (s.plastic > from.plastic) k.axial *= compression.slope(closing);
  if (s.broken == 0) return k;
  k.bending = k.twisting = 0;
  if (!(now.normal < 0)) k.axial = k.shear = 0;
  if (s.dissipated > from.dissipated) k.shear = 0;
  return k;
}

} // namespace platen::dem
