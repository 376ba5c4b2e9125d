// Local elasto-damage-plastic law (Onate et al. 2015 with its gaps filled, docs/theory.md): a cohesive bond
// of area A between two spheres that may have a gap. It is elastic; tension and shear soften by damage;
// compression yields along straight branches and unloads elastically; after failure Coulomb friction remains.
// Without the option of cohesive_moments.h it neither bends nor twists: the only moments are those of the
// shear force at its arms.
//
// Everything in stresses: k_n = E/|D| per area, u_n = |d| - |D|, plastic closing p stored as q = k_n p:
//   T = k_n u_n + q             > 0: tension, < 0: compression
//   q >= e - envelope(e)        with e = -k_n u_n, the stress of closing without yield
//   F_n/A = g(D_n) T in tension, T in compression
//   F_s/A = k_s (g(D_s) u_s + D_s x)   with |k_s x| <= mu_2 sigma_c, x the spring of friction
//   D_n >= (T/sigma_ft - 1)/delta_n, D_s >= (k_s |u_s|/(tau_f + mu_1 sigma_c) - 1)/delta_s
//   g(D) = (1 - D)/(1 + delta D)       linear softening, unloading through the origin
// so that the shear strength changes from tau_f + mu_1 sigma_c to mu_2 sigma_c as damage grows. A cohesive
// bond that is fully damaged in tension or shear has failed in both.
#pragma once

#include <vector>

#include "base/pi.h"
#include "dem/laws/cohesive_form.h"
#include "dem/laws/compression_branches.h"

namespace platen::dem {

// Coupled: tension reduces the shear strength, and shear the tensile strength.
enum class FailureLine { uncoupled, coupled };

template <class Real>
struct CohesiveState {
  Real plastic;                      // q, Pa, >= 0
  Real tension_damage, shear_damage; // D_n, D_s; 1: failed in this mode
  Triple<Real> shear;                // u_s, m
  Triple<Real> slider;               // x, m
  Real dissipated;                   // J: by damage until failure, by friction afterwards

  // Calls v(column, unit, this member of each state) for all members.
  template <class Visitor, class... States>
  static void describe(Visitor &&v, States &...s) {
    v("plastic", "Pa", s.plastic...);
    v("tension_damage", "1", s.tension_damage...);
    v("shear_damage", "1", s.shear_damage...);
    v("dissipated", "J", s.dissipated...);
    v("shear_displacement", "m", s.shear...);
    v("friction_spring", "m", s.slider...);
  }
};
// Stresses by moments at the skin of a cohesive bond, computed without damage.
template <class Real>
struct SkinStress {
  Real bending, twisting; // Pa
};
struct ElastoDamagePlastic {
  static constexpr const char *word = "elasto damage plastic";
  struct Parameters {
    double poisson_ratio = 0.3;                            // k_s = k_n / (2 (1 + nu))
    double tensile_strength = 0;                           // sigma_ft, Pa; 0: never breaks in tension
    double shear_strength = 0;                             // tau_f, Pa; 0: never breaks in shear
    double friction_static = 0;                            // mu_1, of intact cohesive bonds
    double friction_dynamic = 0;                           // mu_2, of failed ones
    double softening_tension = 0.2, softening_shear = 1.0; // delta, > 0
    // N/m (J/m^2), area under the softening branch; above 0 it replaces delta: delta = 2 G_f k / strength^2.
    double fracture_energy_tension = 0, fracture_energy_shear = 0;
    // LCS, Pa, and YRC = E_0 / E of the branch that begins there. Up to three; empty: no yield.
    std::vector<double> compression_limits, compression_slopes;
    FailureLine failure_line = FailureLine::uncoupled;
    double moment_contribution = 1; // beta, contribution of moments to damage
    bool moments = false;           // bending and twisting

    static constexpr const char *name = "ElastoDamagePlastic";
    template <class Visitor, class Self>
    static void describe(Visitor &&v, Self &p);
  };
  static constexpr bool needs_rotation = false, centre_to_centre = false, over_distance = true,
                        has_history = true, bonds_by_range = true, needs_orientations = false;

  // Throws BadParameter if there are more than three branches, or if compression would grow stiffer again.
  ElastoDamagePlastic(const Parameters &p);
  ElastoDamagePlastic() : ElastoDamagePlastic(Parameters()) {}

  Parameters parameters; // as given
  CompressionBranches compression;

  template <class Real>
  using State = CohesiveState<Real>;
  // 1: the bond has failed, in tension or in shear.
  template <class Real>
  static Real damage_of(const State<Real> &s) {
    return larger(s.tension_damage, s.shear_damage);
  }
  static bool failed_in_tension(const State<double> &s) { return s.tension_damage >= 1.0; }

  bool bends() const { return parameters.moments; }
  BondStiffness stiffness(const BondGeometry<double> &g) const;
  double shear_ratio() const { return shear_ratio_; } // k_s / k_n

  // Updates the state and returns the response.
  template <class Real>
  CohesiveResponse<Real> operator()(CohesiveState<Real> &s, const CohesiveGeometry<Real> &g,
                                    const CohesiveMotion<Real> &m) const;
  // The same with the skin stress of moments added; `skin` is used only with moments.
  template <bool moments, class Real>
  CohesiveResponse<Real> advance_under(const SkinStress<Real> &skin, CohesiveState<Real> &s,
                                       const CohesiveGeometry<Real> &g, const CohesiveMotion<Real> &m) const;
  // The quick path of bonds without damage (cohesive_form.h).
  static constexpr bool intact_reads_motion = true;
  static constexpr Changes intact_members[] = {Changes::rarely, Changes::never,  Changes::never,
                                               Changes::never,  Changes::always, Changes::always};
  template <bool moments, class Real>
  bool advance_intact(const SkinStress<Real> &skin, CohesiveState<Real> &s, const CohesiveGeometry<Real> &g,
                      const CohesiveMotion<Real> &m, CohesiveResponse<Real> &r, bool &yielded) const;
  template <class Real>
  PLATEN_INLINE bool advance_intact(CohesiveState<Real> &s, const CohesiveGeometry<Real> &g,
                                    const CohesiveMotion<Real> &m, CohesiveResponse<Real> &r,
                                    bool &yielded) const {
    return advance_intact<false>(SkinStress<Real>{}, s, g, m, r, yielded);
  }
  // Failed bonds are stored behind the others, so that all bonds of a SIMD vector are of one kind.
  static constexpr bool failed_rows_last = true;
  // Returns a positive value for a failed bond, otherwise 0.
  template <class Real>
  static Real failed(const CohesiveState<Real> &s) {
    const Real zero = s.tension_damage * 0.0;
    return where_positive(Real(1.0 - damage_of(s)), zero, Real(zero + 1.0));
  }
  // For a SIMD vector of failed bonds: whether all are separated now and were before, so that no force acts
  // and no state changes.
  template <class Real>
  bool stays_separated(const CohesiveState<Real> &s, const CohesiveGeometry<Real> &g,
                       const Triple<Real> &distance) const;
  // The step (call operator) for such a SIMD vector, with torques.
  template <class Real>
  CohesiveResponse<Real> advance_broken(CohesiveState<Real> &s, const CohesiveGeometry<Real> &g,
                                        const CohesiveMotion<Real> &m) const;
  // Fraction of the moments that remains: the smaller one of the fractions of tension and shear.
  template <class Real>
  Real fraction_of_moments(const CohesiveState<Real> &s, const CohesiveGeometry<Real> &g) const {
    const Fractions<Real> of = fractions(s, softening(g));
    return of.tension - positive_part(Real(of.tension - of.shear));
  }
  // The response of the given state, at the distance d of its last update.
  template <class Real>
  CohesiveResponse<Real> response(const CohesiveState<Real> &s, const CohesiveGeometry<Real> &g,
                                  const Triple<Real> &d) const;
  // The same in the form of the other bonds. Ratios are elastic stress over strength: 1 where damage begins,
  // 1 + delta where it ends.
  BondResponse<double> bond_response(const CohesiveState<double> &s, const CohesiveGeometry<double> &g,
                                     const CohesiveMotion<double> &m) const;
  template <class Real>
  ForceAndEnergy<Real> force_and_energy(const CohesiveState<Real> &s, const CohesiveGeometry<Real> &g,
                                        const BondMotion<Real> &pose) const {
    const CohesiveResponse<Real> r = response(s, g, pose.distance);
    return {r.force, r.energy};
  }
  // Forces without moments; the ratios include the stress of moments at the skin.
  BondResponse<double> response_under(const SkinStress<double> &skin, const CohesiveState<double> &s,
                                      const CohesiveGeometry<double> &g,
                                      const CohesiveMotion<double> &m) const;
  // J, dissipated by plastic closing.
  template <class Real>
  Real plastic_work(const CohesiveState<Real> &s, const CohesiveGeometry<Real> &g) const {
    return g.area * compression.work(s.plastic) / g.normal_stiffness;
  }

private:
  // Fraction of the tensile strength above which the coupled line holds. The line begins with a jump, because
  // shear then softens tension too; a bond that is only sheared or twisted has no normal stress except
  // round-off of either sign.
  static constexpr double least_tension = 1e-9;
  double shear_ratio_;
  // Pa; a strength that is never reached is a number whose square is finite.
  double tensile_strength_, shear_strength_;
  // Avoids a division by the zero stiffness of a broken bond.
  template <class Real>
  static Real divisor(const Real &stiffness) {
    return where_positive(stiffness, stiffness, Real(stiffness * 0.0 + 1.0));
  }
  template <class Real>
  struct Softening {
    Real tension, shear; // delta
  };
  template <class Real>
  Softening<Real> softening(const CohesiveGeometry<Real> &g) const;
  template <class Real>
  struct Fractions {
    Real tension, shear, friction; // of T in tension, of u_s and of x
  };
  template <class Real>
  Fractions<Real> fractions(const CohesiveState<Real> &s, const Softening<Real> &delta) const;
  template <class Real>
  static Real left(const Real &damage, const Real &delta) { // g(D)
    return (1.0 - damage) / (1.0 + delta * damage);
  }
  // The part of a step before damage: updates the state except damage and dissipated energy. (It works in
  // place, because the compiler would keep a copy in memory.)
  template <class Real>
  struct Step {
    Real length, tension; // m; Pa
    PlaneMotion<Real> plane;
    Triple<Real> shear_before, slider_before, slip; // m: after turning alone; lost by the slider
    Real yield;                                     // Pa

    Step(const ElastoDamagePlastic &law, CohesiveState<Real> &s, const CohesiveGeometry<Real> &g,
         const CohesiveMotion<Real> &m);
  };
  template <bool moments, class Real>
  bool may_be_damaged(const CohesiveState<Real> &s, const CohesiveGeometry<Real> &g, const Real &tension,
                      const SkinStress<Real> &skin) const;
  template <bool moments, class Real>
  void damage(CohesiveState<Real> &s, const CohesiveGeometry<Real> &g, const Softening<Real> &delta,
              const Real &tension, const SkinStress<Real> &skin) const;
};

template <class Visitor, class Self>
void ElastoDamagePlastic::Parameters::describe(Visitor &&v, Self &p) {
  describe_poisson_ratio(v, p);
  describe_strengths(v, p);
  v("friction_static", p.friction_static, "1", between(0, 5),
    "Shear strength grows by this times the compression, while the bond holds (mu_1).");
  v("friction_dynamic", p.friction_dynamic, "1", between(0, 5),
    "Coefficient of friction of a bond that has failed (mu_2).");
  v("softening_tension", p.softening_tension, "1", between(1e-3, 1000),
    "Opening from the strength to nothing, over that at the strength (delta_n).");
  v("softening_shear", p.softening_shear, "1", between(1e-3, 1000), "The same in shear (delta_s).");
  v("fracture_energy_tension", p.fracture_energy_tension, "J/m2", at_least(0),
    "Area under the softening branch, for any size of spheres; 0: by the softening in tension.");
  v("fracture_energy_shear", p.fracture_energy_shear, "J/m2", at_least(0), "The same in shear.");
  describe_compression(v, p);
  v("failure_line", p.failure_line,
    Words<FailureLine>{{"uncoupled", FailureLine::uncoupled}, {"coupled", FailureLine::coupled}},
    "Coupled: tension takes from the shear strength, and shear from the tensile strength.");
  describe_moment_contribution(v, p);
  v("interface_moments", p.moments,
    "Interfaces resist bending and twisting until they have failed (needs rotation).");
}

inline ElastoDamagePlastic::ElastoDamagePlastic(const Parameters &p)
    : parameters(p),
      compression(Parameters::name, p.compression_limits, p.compression_slopes),
      shear_ratio_(0.5 / (1 + p.poisson_ratio)),
      tensile_strength_(std::fmin(never_if_zero(p.tensile_strength), 1e100)),
      shear_strength_(std::fmin(never_if_zero(p.shear_strength), 1e100)) {}

template <class Real>
PLATEN_INLINE auto ElastoDamagePlastic::softening(const CohesiveGeometry<Real> &g) const -> Softening<Real> {
  const Parameters &p = parameters;
  const Real kn = g.normal_stiffness / (g.strength_factor * g.strength_factor);
  const auto of = [&](double given, double energy, double strength, const Real &k) {
    return energy > 0 ? Real((2.0 * energy / (strength * strength)) * k) : Real(given + 0.0 * k);
  };
  return {of(p.softening_tension, p.fracture_energy_tension, tensile_strength_, kn),
          of(p.softening_shear, p.fracture_energy_shear, shear_strength_, Real(shear_ratio() * kn))};
}

// Damage from the stresses that would act without damage.
template <bool moments, class Real>
PLATEN_INLINE void ElastoDamagePlastic::damage(CohesiveState<Real> &s, const CohesiveGeometry<Real> &g,
                                               const Softening<Real> &delta, const Real &tension,
                                               const SkinStress<Real> &skin) const {
  const Parameters &p = parameters;
  const Real zero = tension * 0.0, one = zero + 1.0;
  const Real kn = g.normal_stiffness, ks = shear_ratio() * kn;
  Real opening = positive_part(tension);
  const Real closing = positive_part(Real(-tension));
  Real sliding = ks * root(dot(s.shear, s.shear));
  if constexpr (moments) {
    opening = positive_part(Real(tension + skin.bending));
    sliding = sliding + skin.twisting;
  }
  const Real cohesion = g.strength_factor * shear_strength_;
  const Real tensile = g.strength_factor * tensile_strength_;
  const Real strength = cohesion + p.friction_static * closing;
  Real used_n = opening / tensile, used_s = sliding / strength;
  if (p.failure_line == FailureLine::coupled) { // in tension both add up; round-off is no tension
    const Real both = used_n + used_s, pulled = opening - least_tension * tensile;
    used_n = where_positive(pulled, both, used_n);
    used_s = where_positive(pulled, both, used_s);
  }
  const Real intact = 1.0 - larger(s.tension_damage, s.shear_damage);
  const Real least = zero + 1e-150; // brittle, or broken earlier: full damage at once, no division by zero
  const auto grown = [&](const Real &old, const Real &used, const Real &d) {
    const Real wanted = larger(old, Real((used - 1.0) / larger(d, least)));
    return where_positive(intact, Real(one - positive_part(Real(1.0 - wanted))), old);
  };
  const Real dn = grown(s.tension_damage, used_n, delta.tension);
  s.shear_damage = grown(s.shear_damage, used_s, delta.shear);
  s.tension_damage = dn;
}

// Fractions of the stresses without damage that still act.
template <class Real>
PLATEN_INLINE auto ElastoDamagePlastic::fractions(const CohesiveState<Real> &s,
                                                  const Softening<Real> &delta) const -> Fractions<Real> {
  const Real one = s.tension_damage * 0.0 + 1.0;
  const Real intact = 1.0 - larger(s.tension_damage, s.shear_damage); // 0 once it has failed
  const Real dn = where_positive(intact, s.tension_damage, one);
  const Real ds = where_positive(intact, s.shear_damage, one);
  return {left(dn, delta.tension), left(ds, delta.shear), ds};
}

template <class Real>
PLATEN_INLINE CohesiveResponse<Real> ElastoDamagePlastic::response(const CohesiveState<Real> &s,
                                                                   const CohesiveGeometry<Real> &g,
                                                                   const Triple<Real> &d) const {
  const Real kn = g.normal_stiffness, ks = shear_ratio() * kn;
  const Softening<Real> delta = softening(g);
  const Real length = root(dot(d, d));
  const Real tension = kn * (length - g.rest_length) + s.plastic;
  const Fractions<Real> fraction = fractions(s, delta);
  const Real opening = positive_part(tension), closing = positive_part(Real(-tension));
  CohesiveResponse<Real> r;
  r.tension = tension;
  r.normal = g.area * (fraction.tension * opening - closing);
  r.shear = scale(Real(g.area * ks), scale(fraction.shear, s.shear) + scale(fraction.friction, s.slider));
  r.force = scale(Real(r.normal / length), d) + r.shear;
  r.energy = 0.5 * g.area *
             ((fraction.tension * opening * opening + closing * closing) / divisor(kn) +
              ks * (fraction.shear * dot(s.shear, s.shear) + fraction.friction * dot(s.slider, s.slider)));
  r.failed_now = tension * 0.0;
  return r;
}

template <class Real>
PLATEN_INLINE ElastoDamagePlastic::Step<Real>::Step(const ElastoDamagePlastic &law, CohesiveState<Real> &s,
                                                    const CohesiveGeometry<Real> &g,
                                                    const CohesiveMotion<Real> &m)
    : length(root(dot(m.distance, m.distance))), plane(m, length) {
  const Real kn = g.normal_stiffness, ks = law.shear_ratio() * kn;
  const Real elastic = kn * (g.rest_length - length);
  yield = positive_part(Real(elastic - law.compression.envelope(elastic) - s.plastic));
  s.plastic = s.plastic + yield;
  tension = s.plastic - elastic;
  s.shear = plane.carried(s.shear);
  s.slider = plane.carried(s.slider);
  shear_before = s.shear - plane.moved, slider_before = s.slider - plane.moved;
  const Real cap = law.parameters.friction_dynamic * positive_part(Real(-tension)); // Pa
  const Real let_slip = slipping_fraction(s.slider, ks, cap);
  slip = scale(let_slip, s.slider);
  s.slider = scale(Real(1.0 - let_slip), s.slider);
}

template <bool moments, class Real>
PLATEN_INLINE CohesiveResponse<Real> ElastoDamagePlastic::advance_under(const SkinStress<Real> &skin,
                                                                        CohesiveState<Real> &s,
                                                                        const CohesiveGeometry<Real> &g,
                                                                        const CohesiveMotion<Real> &m) const {
  const Real kn = g.normal_stiffness, ks = shear_ratio() * kn;
  const Softening<Real> delta = softening(g);
  const CohesiveState<Real> last = s;
  const Step<Real> step(*this, s, g, m);
  const PlaneMotion<Real> &plane = step.plane;
  const Real &length = step.length, &tension = step.tension;
  const Triple<Real> &shear_before = step.shear_before, &slider_before = step.slider_before;
  const Real zero = tension * 0.0, one = zero + 1.0;
  const Real failed_before = larger(s.tension_damage, s.shear_damage);
  damage<moments>(s, g, delta, tension, skin);

  // Dissipated energy of the step: (F before + F now)/2 times the path, less the gain of stored energy. For
  // springs that lose a fraction only the product of both ends remains. Where tension changes to compression
  // the mean force has an error from the kink, as in any contact: that is no loss.
  const Real drawn = dot(m.travelled, plane.n);
  const Triple<Real> across = m.travelled - scale(drawn, plane.n);
  const Real tension_before =
      tension + (last.plastic - s.plastic) - kn * (drawn - 0.5 * dot(across, across) / length);
  const Fractions<Real> was = fractions(last, delta), is = fractions(s, delta);
  const Real normal_work = (was.tension - is.tension) * tension_before * positive_part(tension) / divisor(kn);
  const Real shear_work = (was.shear - is.shear) * dot(shear_before, s.shear) +
                          (was.friction - is.friction) * dot(slider_before, s.slider) +
                          dot(scale(was.friction, slider_before) + scale(is.friction, s.slider), step.slip);
  s.dissipated = s.dissipated + 0.5 * g.area * (normal_work + ks * shear_work);
  CohesiveResponse<Real> r = response(s, g, m.distance);
  const Real intact = 1.0 - larger(s.tension_damage, s.shear_damage);
  r.failed_now = where_positive(Real(1.0 - failed_before), where_positive(intact, zero, one), zero);
  // A failed bond has no such spring.
  s.shear = {where_positive(intact, s.shear.x, zero), where_positive(intact, s.shear.y, zero),
             where_positive(intact, s.shear.z, zero)};
  return r;
}

// Whether any bond may have damage after this step, computed without a quotient; the margin covers the
// round-off of the quotient.
template <bool moments, class Real>
PLATEN_INLINE bool ElastoDamagePlastic::may_be_damaged(const CohesiveState<Real> &s,
                                                       const CohesiveGeometry<Real> &g, const Real &tension,
                                                       const SkinStress<Real> &skin) const {
  constexpr double margin = 1 + 1e-12;
  const Real ks = shear_ratio() * g.normal_stiffness;
  const Real closing = positive_part(Real(-tension));
  const Real tensile = g.strength_factor * tensile_strength_;
  const Real strength = g.strength_factor * shear_strength_ + parameters.friction_static * closing;
  Real opening = positive_part(tension), left = strength, slip = ks * ks * dot(s.shear, s.shear);
  if constexpr (moments) opening = positive_part(Real(tension + skin.bending));
  if (parameters.failure_line == FailureLine::coupled) {
    left = strength * (tensile - opening);
    slip = slip * tensile * tensile;
    if constexpr (moments) left = left - skin.twisting * tensile;
  } else if constexpr (moments) {
    left = left - skin.twisting;
  }
  return !all_positive(Real(tensile - margin * opening)) ||
         !all_positive(Real(left * magnitude(left) - margin * slip));
}

template <bool moments, class Real>
PLATEN_INLINE bool ElastoDamagePlastic::advance_intact(const SkinStress<Real> &skin, CohesiveState<Real> &s,
                                                       const CohesiveGeometry<Real> &g,
                                                       const CohesiveMotion<Real> &m,
                                                       CohesiveResponse<Real> &r, bool &yielded) const {
  if (any_positive(larger(s.tension_damage, s.shear_damage))) return false;
  const Real ks = shear_ratio() * g.normal_stiffness;
  const Step<Real> step(*this, s, g, m);
  if (may_be_damaged<moments>(s, g, step.tension, skin)) return false;
  yielded = any_positive(step.yield);
  r.tension = step.tension;
  r.normal = g.area * step.tension;
  r.shear = scale(Real(g.area * ks), s.shear);
  r.force = scale(r.normal, step.plane.n) + r.shear;
  r.failed_now = step.tension * 0.0;
  return true;
}

template <class Real>
PLATEN_INLINE bool ElastoDamagePlastic::stays_separated(const CohesiveState<Real> &s,
                                                        const CohesiveGeometry<Real> &g,
                                                        const Triple<Real> &distance) const {
  return are_separated(g, distance, s.plastic, s.slider);
}

template <class Real>
PLATEN_INLINE CohesiveResponse<Real> ElastoDamagePlastic::advance_broken(
    CohesiveState<Real> &s, const CohesiveGeometry<Real> &g, const CohesiveMotion<Real> &m) const {
  const Real ks = shear_ratio() * g.normal_stiffness;
  const Step<Real> step(*this, s, g, m);
  const Real closing = positive_part(Real(-step.tension)), zero = closing * 0.0;
  s.shear = {zero, zero, zero};
  s.dissipated = s.dissipated + 0.5 * g.area * ks * dot(step.slider_before + s.slider, step.slip);
  CohesiveResponse<Real> r;
  r.tension = step.tension;
  r.normal = -g.area * closing;
  r.shear = scale(Real(g.area * ks), s.slider);
  r.force = scale(r.normal, step.plane.n) + r.shear;
  r.failed_now = zero;
  const Triple<Real> moment = cross(m.distance, r.force);
  r.torque_i = scale(g.lever, moment);
  r.torque_j = scale(Real(1.0 - g.lever), moment);
  return r;
}

template <class Real>
PLATEN_INLINE CohesiveResponse<Real> ElastoDamagePlastic::operator()(CohesiveState<Real> &s,
                                                                     const CohesiveGeometry<Real> &g,
                                                                     const CohesiveMotion<Real> &m) const {
  return advance_under<false>(SkinStress<Real>{}, s, g, m);
}

inline BondStiffness ElastoDamagePlastic::stiffness(const BondGeometry<double> &g) const {
  const double axial = pi * g.radius * g.radius * g.normal_stiffness, shear = shear_ratio() * axial;
  if (!parameters.moments) return {axial, shear, 0, 0};
  const double square = g.radius * g.radius;
  return {axial, shear, 0.25 * square * axial, 0.5 * square * shear};
}

inline BondResponse<double> ElastoDamagePlastic::response_under(const SkinStress<double> &skin,
                                                                const CohesiveState<double> &s,
                                                                const CohesiveGeometry<double> &g,
                                                                const CohesiveMotion<double> &m) const {
  const CohesiveResponse<double> from = response(s, g, m.distance);
  const Triple<double> moment = cross(m.distance, from.force);
  BondResponse<double> r;
  r.force = from.force;
  r.torque_i = scale(g.lever, moment);
  r.torque_j = scale(1 - g.lever, moment);
  const double sliding = shear_ratio() * g.normal_stiffness * root(dot(s.shear, s.shear)) + skin.twisting;
  r.tension_ratio = positive_part(from.tension + skin.bending) /
                    (g.strength_factor * never_if_zero(parameters.tensile_strength));
  r.shear_ratio = sliding / (g.strength_factor * never_if_zero(parameters.shear_strength) +
                             parameters.friction_static * positive_part(-from.tension));
  r.excess = larger(r.tension_ratio, r.shear_ratio) - 1;
  r.energy = from.energy;
  r.normal_force = from.normal;
  r.shear = from.shear;
  r.shear_force = root(dot(from.shear, from.shear));
  return r;
}

} // namespace platen::dem
