// Facet bond: tension that softens with a fracture energy, shear that stays plastic under pressure, and no
// moments: the law of the Lattice Discrete Particle Model (Cusatis, Pelessone and Mencarelli 2011) for a pair
// of spheres, with damage instead of its bound of stresses, so that no path gives energy (docs/theory.md).
//
// In stresses: k_n = E/|D| and k_s = r k_n per area, q = k_n p the plastic closing, u the elastic slip at the
// point of contact, that of the poses less the plastic slip P, x the spring of friction:
//   T = k_n (|d| - |D|) + q, t = k_s |u|               T > 0: open, else closed
//   q >= e - envelope(e), e = -k_n (|d| - |D|)         also once it has failed
//   open:    a = (T/sigma_t + sqrt((T/sigma_t)^2 + (2 t/sigma_s)^2))/2
//            D >= 1 - exp(-h (a - 1))/a                where a > 1: beyond (t/sigma_s)^2 + T/sigma_t = 1
//            h = h_t (2 w/pi)^n, tan w = sqrt(r) T/t, h_t = 2/(2 k_n G/sigma_t^2 - 1)
//   closed:  t <= sigma_s + mu_0 sigma_0 (1 - exp(T/sigma_0)): beyond, P follows
//            k_s |x| <= mu_2 |T|, and no more than the same limit
//   F_n/A = (1 - D) T open, T closed; F_s/A = k_s ((1 - D) u + D x)
// P turns with both spheres, so that cohesion is a potential of the pose wherever neither D nor P changes.
// With Moment stiffness, moments are (1 - D) times that fraction of those of the parallel bond.
#pragma once

#include <cmath>
#include <vector>

#include "base/pi.h"
#include "dem/laws/cohesive_form.h"
#include "dem/laws/compression_branches.h"
#include "dem/laws/elementary.h"

namespace platen::dem {

struct FacetBond {
  static constexpr const char *word = "facet";
  struct Parameters {
    double stiffness_ratio = 0.4;    // r, k_s / k_n
    double tensile_strength = 0;     // sigma_t, Pa; 0: never breaks in tension
    double shear_strength = 0;       // sigma_s, Pa; 0: never slips
    double fracture_energy = 0;      // G, J/m^2 of bond area; 0: brittle in tension
    double softening_exponent = 0.2; // n
    double friction_static = 0;      // mu_0, of the intact part
    double transitional_stress = 0;  // sigma_0, Pa; 0: friction grows with pressure without limit
    double friction_dynamic = 0;     // mu_2, of the damaged part
    std::vector<double> compression_limits, compression_slopes; // Pa; E_0 / E. Empty: no yield
    double moment_stiffness = 0;                                // fraction of k_n I and k_s J

    static constexpr const char *name = "FacetBond";
    template <class Visitor, class Self>
    static void describe(Visitor &&v, Self &p);
  };
  static constexpr bool needs_rotation = false, centre_to_centre = false, over_distance = true,
                        has_history = true, bonds_by_range = false, needs_orientations = true;

  FacetBond() : FacetBond(Parameters()) {}
  // Throws BadParameter if there are more than three branches, or if compression would grow stiffer again.
  FacetBond(const Parameters &p)
      : parameters(p),
        compression(Parameters::name, p.compression_limits, p.compression_slopes),
        tensile_(std::fmin(never_if_zero(p.tensile_strength), 1e100)),
        shear_(std::fmin(never_if_zero(p.shear_strength), 1e100)) {}

  Parameters parameters; // as given
  CompressionBranches compression;

  template <class Real>
  struct State {
    Real plastic;        // q, Pa, >= 0
    Real damage;         // D
    Real broken;         // 0: no; 1: failed in tension, 2: in shear
    Real dissipated;     // J: by damage and slip; by friction once it has failed
    Triple<Real> slip;   // P, m, between both spheres as they were when the bond was made
    Triple<Real> slider; // x, m

    template <class Visitor, class... States>
    static void describe(Visitor &&v, States &...s) {
      v("plastic", "Pa", s.plastic...);
      v("damage", "1", s.damage...);
      v("broken", "1", s.broken...);
      v("dissipated", "J", s.dissipated...);
      v("plastic_slip", "m", s.slip...);
      v("friction_spring", "m", s.slider...);
    }
  };
  template <class Real>
  static Real damage_of(const State<Real> &s) {
    return s.damage;
  }
  // Returns a positive value for a failed bond, otherwise 0.
  template <class Real>
  static Real failed(const State<Real> &s) {
    return s.broken;
  }
  static bool failed_in_tension(const State<double> &s) { return s.broken == 1; }

  bool bends() const { return parameters.moment_stiffness > 0; }
  BondStiffness stiffness(const BondGeometry<double> &g) const;
  // l_t/|D|: the energy that G leaves over that of the bond at its strength. At 1 and below it is brittle.
  double ductility(const CohesiveGeometry<double> &g) const;

  // Updates the state and returns the response.
  template <class Real>
  CohesiveResponse<Real> operator()(State<Real> &s, const CohesiveGeometry<Real> &g,
                                    const CohesiveMotion<Real> &m) const;
  // The quick path of bonds that are intact and do not slip (cohesive_form.h), from their pose alone.
  static constexpr bool intact_reads_motion = false, often_reads_motion = true;
  static constexpr Changes intact_members[] = {Changes::rarely, Changes::never, Changes::never,
                                               Changes::never,  Changes::never, Changes::never};
  template <class Real, class Pair>
  bool advance_intact(State<Real> &s, const CohesiveGeometry<Real> &g, const Pair &pair,
                      CohesiveResponse<Real> &r, bool &yielded) const;
  // As in yielding_parallel_bond.h.
  static constexpr bool failed_rows_last = true, damaged_rows_separate = true;
  template <class Real>
  bool stays_separated(const State<Real> &s, const CohesiveGeometry<Real> &g,
                       const Triple<Real> &distance) const {
    return are_separated(g, distance, s.plastic, s.slider);
  }
  template <class Real>
  CohesiveResponse<Real> advance_broken(State<Real> &s, const CohesiveGeometry<Real> &g,
                                        const CohesiveMotion<Real> &m) const;
  BondResponse<double> bond_response(const State<double> &s, const CohesiveGeometry<double> &g,
                                     const CohesiveMotion<double> &m) const;
  template <class Real>
  ForceAndEnergy<Real> force_and_energy(const State<Real> &s, const CohesiveGeometry<Real> &g,
                                        const BondMotion<Real> &pose) const {
    const CohesiveResponse<Real> r = response(s, g, springs(s, g, pose), pose);
    return {r.force, r.energy};
  }
  // J, dissipated by plastic closing.
  template <class Real>
  Real plastic_work(const State<Real> &s, const CohesiveGeometry<Real> &g) const {
    return g.area * compression.work(s.plastic) / g.normal_stiffness;
  }

private:
  // Bounded, so that products of squares of them are finite.
  double tensile_, shear_; // Pa

  // Residual strength over strength, below which a bond fails. This neglects 5e-4 of the fracture energy.
  static constexpr double least_left = 5e-4;
  static constexpr double brittle = 1e9; // h_t of a bond without softening
  static constexpr double tiny = 1e-100; // Pa

  // Springs of a pose. Cohesion: u, with arms that the spheres carry.
  template <class Real>
  struct Springs {
    Real length, along;         // |d|, m; u_total.n / |d|
    Triple<Real> n, slip;       // u, m
    Triple<Real> arm_i, arm_j;  // m
    Real tension, sliding;      // T, t, Pa
    BondResponse<Real> moments; // without damage; only with moments
  };
  template <class Real>
  Springs<Real> springs(const State<Real> &s, const CohesiveGeometry<Real> &g,
                        const BondMotion<Real> &pose) const;
  template <class Real>
  CohesiveResponse<Real> response(const State<Real> &s, const CohesiveGeometry<Real> &g,
                                  const Springs<Real> &e, const BondMotion<Real> &pose) const;
  // Adds the friction of the damaged part: the force on the first and its torques.
  template <class Real>
  void add_friction(CohesiveResponse<Real> &r, const State<Real> &s, const CohesiveGeometry<Real> &g,
                    const Triple<Real> &distance) const;
  template <class Real>
  Real yields(const Real &plastic, const Real &elastic) const {
    return positive_part(Real(elastic - compression.envelope(elastic) - plastic));
  }
  template <class Real>
  bool may_change(const CohesiveGeometry<Real> &g, const Springs<Real> &e) const;
  template <class Real>
  struct LeastLimit {
    Real limit, faded; // Pa; 1 + closing/sigma_0
  };
  template <class Real>
  LeastLimit<Real> least_limit(const CohesiveGeometry<Real> &g, const Real &closing) const;
  template <class Real>
  Real shear_limit(const CohesiveGeometry<Real> &g, const Real &closing, const Real &sliding) const;
  template <class Real>
  Real fraction_of_strength(const CohesiveGeometry<Real> &g, const Springs<Real> &e) const;
  template <class Real>
  void slide(State<Real> &s, const CohesiveGeometry<Real> &g, const PlaneMotion<Real> &plane,
             const Real &closing, const Real &limit, const Real &damage_before) const;
  template <class Real>
  void grow(State<Real> &s, const CohesiveGeometry<Real> &g, const Springs<Real> &e) const;
};

template <class Visitor, class Self>
void FacetBond::Parameters::describe(Visitor &&v, Self &p) {
  v("stiffness_ratio", p.stiffness_ratio, "1", between(0, 5), "Shear over normal stiffness, k_s / k_n.");
  describe_strengths(v, p);
  v("fracture_energy", p.fracture_energy, "J/m2", at_least(0),
    "Of a facet in tension, for each area of it; more than its elastic energy at the strength. 0: brittle.");
  v("softening_exponent", p.softening_exponent, "1", between(0, 10),
    "How softening fades from tension to shear: slope times (2 w/pi) to this power, w the angle of tension "
    "to "
    "shear (n_t).");
  v("friction_static", p.friction_static, "1", between(0, 5),
    "Coefficient of friction of a bond that is intact: what is added to its cohesion under small compression "
    "(mu_1).");
  v("transitional_stress", p.transitional_stress, "Pa", at_least(0),
    "Compression at which the static friction of a facet fades, exponentially; 0: never.");
  v("friction_dynamic", p.friction_dynamic, "1", between(0, 5),
    "Coefficient of friction of a bond that has failed (mu_2).");
  describe_compression(v, p);
  v("moment_stiffness", p.moment_stiffness, "1", between(0, 1),
    "Share of the stiffness of the section in bending and twisting that a facet has; 0: no moments.");
}

inline BondStiffness FacetBond::stiffness(const BondGeometry<double> &g) const {
  const double square = g.radius * g.radius, axial = pi * square * g.normal_stiffness;
  const double shear = parameters.stiffness_ratio * axial, fraction = parameters.moment_stiffness;
  return {axial, shear, 0.25 * square * fraction * axial, 0.5 * square * fraction * shear};
}

inline double FacetBond::ductility(const CohesiveGeometry<double> &g) const {
  const double strength = g.strength_factor * tensile_;
  return 2 * parameters.fracture_energy * g.normal_stiffness / strength / strength;
}

template <class Real>
PLATEN_INLINE auto FacetBond::springs(const State<Real> &s, const CohesiveGeometry<Real> &g,
                                      const BondMotion<Real> &pose) const -> Springs<Real> {
  const Real kn = g.normal_stiffness;
  const Triple<Real> &d = pose.distance, carried = g.reference + s.slip;
  const Real square = dot(d, d), per_square = 1.0 / square;
  Springs<Real> e;
  e.length = root(square);
  e.n = scale(Real(e.length * per_square), d);
  const Triple<Real> half = scale(g.lever, carried);
  e.arm_i = turned(pose.turn_i, half), e.arm_j = turned(pose.turn_j, carried - half);
  const Triple<Real> u = d - e.arm_i - e.arm_j;
  e.along = dot(u, d) * per_square;
  e.slip = u - scale(e.along, d);
  e.tension = kn * (e.length - g.rest_length) + s.plastic;
  e.sliding = parameters.stiffness_ratio * kn * root(dot(e.slip, e.slip));
  if (bends()) {
    const Real zero = square * 0.0;
    const Triple<Real> none{zero, zero, zero};
    BondStrain<Real> strain;
    strain.length = e.length, strain.per_square = per_square;
    e.moments.force = e.moments.torque_i = e.moments.torque_j = none, e.moments.energy = zero;
    bend_and_twist(e.moments, strain,
                   Real(0.25 * parameters.moment_stiffness * g.radius * g.radius * g.area * kn),
                   2.0 * parameters.stiffness_ratio - 1.0, pose);
  }
  return e;
}

template <class Real>
PLATEN_INLINE CohesiveResponse<Real> FacetBond::response(const State<Real> &s,
                                                         const CohesiveGeometry<Real> &g,
                                                         const Springs<Real> &e,
                                                         const BondMotion<Real> &pose) const {
  const Real kn = g.normal_stiffness, ks = parameters.stiffness_ratio * kn, intact = 1.0 - s.damage;
  const Real opening = positive_part(e.tension), closing = positive_part(Real(-e.tension));
  const Triple<Real> shear = scale(Real(g.area * ks * intact), e.slip);
  CohesiveResponse<Real> r;
  r.tension = e.tension;
  r.normal = g.area * (intact * opening - closing);
  r.force = scale(r.normal, e.n) + scale(Real(1.0 - e.along), shear);
  r.torque_i = cross(e.arm_i, shear), r.torque_j = cross(e.arm_j, shear);
  r.shear = shear;
  const Real normal_square = intact * opening * opening + closing * closing;
  r.energy = 0.5 * g.area * (normal_square / kn + intact * ks * dot(e.slip, e.slip));
  if (bends()) {
    r.force = r.force + scale(intact, e.moments.force);
    r.torque_i = r.torque_i + scale(intact, e.moments.torque_i);
    r.torque_j = r.torque_j + scale(intact, e.moments.torque_j);
    r.energy = r.energy + intact * e.moments.energy;
  }
  if (any_positive(s.damage)) {
    add_friction(r, s, g, pose.distance);
    r.energy = r.energy + 0.5 * g.area * ks * s.damage * dot(s.slider, s.slider);
  }
  r.failed_now = e.tension * 0.0;
  return r;
}

template <class Real>
PLATEN_INLINE void FacetBond::add_friction(CohesiveResponse<Real> &r, const State<Real> &s,
                                           const CohesiveGeometry<Real> &g,
                                           const Triple<Real> &distance) const {
  const Real ks = parameters.stiffness_ratio * g.normal_stiffness;
  const Triple<Real> friction = scale(Real(g.area * ks * s.damage), s.slider);
  const Triple<Real> moment = cross(distance, friction);
  r.force = r.force + friction;
  r.shear = r.shear + friction;
  r.torque_i = r.torque_i + scale(g.lever, moment);
  r.torque_j = r.torque_j + scale(Real(1.0 - g.lever), moment);
}

// A lower bound of the limit of shear, times 1 + closing/sigma_0, without an exponential, because 1 - exp(-x)
// is at least x/(1 + x). A stress below this bound is below the limit.
template <class Real>
PLATEN_INLINE auto FacetBond::least_limit(const CohesiveGeometry<Real> &g, const Real &closing) const
    -> LeastLimit<Real> {
  const double transition = parameters.transitional_stress;
  const Real faded = 1.0 + closing * (transition > 0 ? 1 / transition : 0.0);
  return {g.strength_factor * shear_ * faded + parameters.friction_static * closing, faded};
}

// Decides without roots and quotients; the margin covers round-off.
template <class Real>
PLATEN_INLINE bool FacetBond::may_change(const CohesiveGeometry<Real> &g, const Springs<Real> &e) const {
  constexpr double margin = 1 + 1e-12;
  const Real tensile = g.strength_factor * tensile_, cohesion = g.strength_factor * shear_;
  const LeastLimit<Real> least = least_limit(g, positive_part(Real(-e.tension)));
  const Real left =
      cohesion * cohesion * (tensile - margin * e.tension) - margin * tensile * e.sliding * e.sliding;
  const Real within = where_positive(e.tension, left, Real(least.limit - margin * e.sliding * least.faded));
  return !all_positive(within);
}

// Limit of shear in compression, Pa. If neither `sliding` nor the friction of the damaged part comes near the
// limit in any lane, the result is only a stress above both.
template <class Real>
PLATEN_INLINE Real FacetBond::shear_limit(const CohesiveGeometry<Real> &g, const Real &closing,
                                          const Real &sliding) const {
  const double transition = parameters.transitional_stress;
  const Real cohesion = g.strength_factor * shear_;
  if (!(transition > 0)) return cohesion + parameters.friction_static * closing;
  const LeastLimit<Real> least = least_limit(g, closing);
  const Real required = larger(sliding, Real(parameters.friction_dynamic * closing));
  if (!any_positive(Real(required * least.faded - least.limit))) return least.limit;
  return cohesion + (parameters.friction_static * transition) * saturation(Real(closing * (1 / transition)));
}

// The a of the criterion: it is 1 at the strength, and in proportion to both stresses.
template <class Real>
PLATEN_INLINE Real FacetBond::fraction_of_strength(const CohesiveGeometry<Real> &g,
                                                   const Springs<Real> &e) const {
  const Real in_tension = positive_part(e.tension) / (g.strength_factor * tensile_);
  const Real in_shear = 2.0 * e.sliding / (g.strength_factor * shear_);
  return 0.5 * (in_tension + root(in_tension * in_tension + in_shear * in_shear));
}

// Damage of open bonds.
template <class Real>
PLATEN_INLINE void FacetBond::grow(State<Real> &s, const CohesiveGeometry<Real> &g,
                                   const Springs<Real> &e) const {
  const Real zero = e.tension * 0.0, one = zero + 1.0;
  const Real opening = positive_part(e.tension), used = fraction_of_strength(g, e), beyond = used - 1.0;
  const Real open = where_positive(s.broken, zero, opening); // and not failed
  if (!any_positive(where_positive(open, beyond, zero))) return;
  const Real strength = g.strength_factor * tensile_;
  const Real more = (2.0 * parameters.fracture_energy) * g.normal_stiffness / strength / strength - 1.0;
  const Real steepest = where_positive(more, Real(2.0 / more), Real(zero + brittle)); // h_t
  // No more damage than by the softening in tension, and exp(-y) >= (1 - y/16)^16: most bonds unload.
  Real bound = positive_part(Real(1.0 - steepest * beyond * (1.0 / 16)));
  for (int k = 0; k < 4; ++k)
    bound = bound * bound;
  const Real most = larger(used, one) * (1.0 - s.damage) - bound;
  if (!any_positive(where_positive(open, most, zero))) return;
  const double leaning = std::sqrt(parameters.stiffness_ratio);
  const Real angle = fraction_of_right_angle(Real(leaning * opening + tiny), e.sliding);
  const Real slope = steepest * power_of_fraction(angle, parameters.softening_exponent);
  const Real residual = 1.0 - saturation(Real(slope * positive_part(beyond)));
  const Real grows = where_positive(open, beyond, zero);
  const Real fails = where_positive(grows, positive_part(Real(least_left - residual)), zero);
  const Real damage = where_positive(fails, one, larger(s.damage, Real(1.0 - residual / larger(used, one))));
  s.damage = where_positive(grows, damage, s.damage);
  const Real mode = where_positive(Real(e.sliding - leaning * opening), Real(one + 1.0), one);
  s.broken = s.broken + where_positive(fails, mode, zero);
}

template <class Real>
PLATEN_INLINE void FacetBond::slide(State<Real> &s, const CohesiveGeometry<Real> &g,
                                    const PlaneMotion<Real> &plane, const Real &closing, const Real &limit,
                                    const Real &damage_before) const {
  const Real ks = parameters.stiffness_ratio * g.normal_stiffness, zero = closing * 0.0;
  const Triple<Real> carried = plane.carried(s.slider), before = carried - plane.moved;
  const Real pressed = parameters.friction_dynamic * closing;
  const Real cap = pressed - positive_part(Real(pressed - limit)); // Pa
  const Real let_slip = slipping_fraction(carried, ks, cap);
  const Triple<Real> slip = scale(let_slip, carried), rest = carried - slip;
  // The lost energy: the work of the mean of the forces at both ends, less the gain of stored energy.
  const Real rubbed = (damage_before - s.damage) * dot(before, rest) +
                      dot(scale(damage_before, before) + scale(s.damage, rest), slip);
  const auto where_damaged = [&](const Real &a) { return where_positive(damage_before, a, zero); };
  s.dissipated = s.dissipated + 0.5 * g.area * ks * where_damaged(rubbed);
  s.slider = {where_damaged(rest.x), where_damaged(rest.y), where_damaged(rest.z)};
}

template <class Real, class Pair>
PLATEN_INLINE bool FacetBond::advance_intact(State<Real> &s, const CohesiveGeometry<Real> &g,
                                             const Pair &pair, CohesiveResponse<Real> &r,
                                             bool &yielded) const {
  if (any_positive(s.damage)) return false;
  const Real length = root(dot(pair.distance, pair.distance));
  const Real yield = yields(s.plastic, Real(g.normal_stiffness * (g.rest_length - length)));
  s.plastic = s.plastic + yield;
  const BondMotion<Real> pose = pair.pose();
  const Springs<Real> e = springs(s, g, pose);
  if (may_change(g, e)) return false;
  yielded = any_positive(yield);
  r = response(s, g, e, pose);
  return true;
}

template <class Real>
PLATEN_INLINE CohesiveResponse<Real> FacetBond::operator()(State<Real> &s, const CohesiveGeometry<Real> &g,
                                                           const CohesiveMotion<Real> &m) const {
  const Real kn = g.normal_stiffness, ks = parameters.stiffness_ratio * kn;
  const Real length = root(dot(m.distance, m.distance)), zero = length * 0.0;
  const BondMotion<Real> pose{m.distance, m.turn_i, m.turn_j};
  const Real damage_before = s.damage, broken_before = s.broken;
  s.plastic = s.plastic + yields(s.plastic, Real(kn * (g.rest_length - length)));
  PlaneMotion<Real> plane(m, length);
  plane.take_from_the_middle(m.moved);
  Springs<Real> e = springs(s, g, pose);
  const Real closing = positive_part(Real(-e.tension));

  // Plastic slip of the intact part, by radial return; bonds that have failed have none.
  const Real limit = shear_limit(g, closing, where_positive(s.broken, zero, e.sliding));
  const Real over =
      where_positive(e.tension, zero, positive_part(Real(e.sliding - limit))); // closed at 0 too
  const Real fraction =
      where_positive(s.broken, zero, Real(over / where_positive(e.sliding, e.sliding, Real(zero + 1.0))));
  if (any_positive(fraction)) {
    const Triple<Real> by = scale(fraction, e.slip);
    const auto back = [&](const Rotation<Real> &q) {
      return turned(Rotation<Real>{q.w, Real(-q.x), Real(-q.y), Real(-q.z)}, by);
    };
    s.slip = s.slip + scale(g.lever, back(m.turn_i)) + scale(Real(1.0 - g.lever), back(m.turn_j));
    const Triple<Real> before = e.slip;
    e = springs(s, g, pose);
    const Triple<Real> both_ends = before - plane.moved + e.slip;
    s.dissipated = s.dissipated + 0.5 * g.area * ks * (1.0 - s.damage) * dot(both_ends, before - e.slip);
  }
  grow(s, g, e);
  slide(s, g, plane, closing, limit, damage_before);
  CohesiveResponse<Real> r = response(s, g, e, pose);

  // Springs that lose a fraction: the product of both ends; the first end is the second less the step.
  const Real lost = s.damage - damage_before;
  if (any_positive(lost)) {
    State<Real> undamaged = s;
    undamaged.damage = zero;
    const CohesiveResponse<Real> response_undamaged = response(undamaged, g, e, pose);
    const Real taken = dot(response_undamaged.force, m.travelled) -
                       dot(response_undamaged.torque_i, m.turned_i) -
                       dot(response_undamaged.torque_j, m.turned_j); // J
    s.dissipated = s.dissipated + 0.5 * lost * positive_part(Real(2.0 * response_undamaged.energy - taken));
  }
  r.failed_now = s.broken - broken_before;
  return r;
}

template <class Real>
PLATEN_INLINE CohesiveResponse<Real> FacetBond::advance_broken(State<Real> &s,
                                                               const CohesiveGeometry<Real> &g,
                                                               const CohesiveMotion<Real> &m) const {
  const Real kn = g.normal_stiffness, ks = parameters.stiffness_ratio * kn;
  const Real length = root(dot(m.distance, m.distance)), elastic = kn * (g.rest_length - length);
  const Real zero = length * 0.0, damage = s.damage;
  s.plastic = s.plastic + yields(s.plastic, elastic);
  const Real closing = positive_part(Real(elastic - s.plastic));
  PlaneMotion<Real> plane(m, length);
  plane.take_from_the_middle(m.moved);
  slide(s, g, plane, closing, shear_limit(g, closing, zero), damage);
  CohesiveResponse<Real> r;
  r.tension = s.plastic - elastic;
  r.normal = -g.area * closing;
  r.force = scale(r.normal, plane.n);
  r.shear = r.torque_i = r.torque_j = {zero, zero, zero};
  add_friction(r, s, g, m.distance);
  r.energy = 0.5 * g.area * (closing * closing / kn + ks * dot(s.slider, s.slider));
  r.failed_now = zero;
  return r;
}

inline BondResponse<double> FacetBond::bond_response(const State<double> &s,
                                                     const CohesiveGeometry<double> &g,
                                                     const CohesiveMotion<double> &m) const {
  const BondMotion<double> pose{m.distance, m.turn_i, m.turn_j};
  const Springs<double> e = springs(s, g, pose);
  const CohesiveResponse<double> from = response(s, g, e, pose);
  BondResponse<double> r;
  r.force = from.force, r.torque_i = from.torque_i, r.torque_j = from.torque_j;
  r.tension_ratio =
      positive_part(e.tension) / (g.strength_factor * never_if_zero(parameters.tensile_strength));
  r.shear_ratio = e.sliding / shear_limit(g, positive_part(-e.tension), 1e300);
  r.excess = (e.tension > 0 ? fraction_of_strength(g, e) : r.shear_ratio) - 1;
  r.energy = from.energy, r.normal_force = from.normal;
  r.shear = from.shear, r.shear_force = root(dot(from.shear, from.shear));
  return r;
}

} // namespace platen::dem
