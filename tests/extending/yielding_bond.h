// Example of a bond law that remembers: a spring along the line of the centres that yields at a stress, in
// both directions, and never breaks.
#pragma once

#include "dem/laws/elasto_damage_plastic.h"

namespace platen::dem {

struct YieldingBond {
  static constexpr const char *word = "yielding";
  struct Parameters {
    double tensile_strength = 0; // Pa; never breaks, in tension nor in shear
    double shear_strength = 0;   // Pa
    double yield_stress = 1e6;   // Pa

    static constexpr const char *name = "YieldingBond";
    template <class Visitor, class Self>
    static void describe(Visitor &&v, Self &p) {
      describe_strengths(v, p);
      v("yield_stress", p.yield_stress, "Pa", above(0), "Largest stress of a bond, pulled or pressed.");
    }
  };
  template <class Real>
  struct State {
    Real stretch;    // m, that stays
    Real work;       // J, of yield
    Real dissipated; // J, by damage: none

    template <class Visitor, class... States>
    static void describe(Visitor &&v, States &...s) {
      v("stretch", "m", s.stretch...);
      v("work", "J", s.work...);
      v("dissipated", "J", s.dissipated...);
    }
  };
  static constexpr bool needs_rotation = false, centre_to_centre = false, over_distance = true,
                        has_history = true, bonds_by_range = false, needs_orientations = false;

  Parameters parameters;
  YieldingBond() = default;
  YieldingBond(const Parameters &p) : parameters(p) {}

  template <class Real>
  CohesiveResponse<Real> operator()(State<Real> &s, const CohesiveGeometry<Real> &g,
                                    const CohesiveMotion<Real> &m) const {
    const double limit = parameters.yield_stress;
    const Real length = root(dot(m.distance, m.distance));
    const Real trial = g.normal_stiffness * (length - g.rest_length - s.stretch);
    const Real pulled = positive_part(Real(trial - limit)), pressed = positive_part(Real(-trial - limit));
    s.stretch = s.stretch + (pulled - pressed) / g.normal_stiffness;
    s.work = s.work + (limit * g.area) * (pulled + pressed) / g.normal_stiffness;
    return response(s, g, m.distance);
  }
  template <class Real>
  CohesiveResponse<Real> response(const State<Real> &s, const CohesiveGeometry<Real> &g,
                                  const Triple<Real> &d) const {
    const Real length = root(dot(d, d)), nothing = length * 0.0;
    CohesiveResponse<Real> r;
    r.tension = g.normal_stiffness * (length - g.rest_length - s.stretch);
    r.normal = g.area * r.tension;
    r.force = scale(Real(r.normal / length), d);
    r.shear = scale(nothing, d);
    r.energy = 0.5 * r.normal * r.tension / g.normal_stiffness;
    r.failed_now = nothing;
    return r;
  }
  BondResponse<double> bond_response(const State<double> &s, const CohesiveGeometry<double> &g,
                                     const CohesiveMotion<double> &m) const {
    const CohesiveResponse<double> from = response(s, g, m.distance);
    BondResponse<double> r{};
    r.force = from.force;
    r.excess = -1;
    r.energy = from.energy;
    r.normal_force = from.normal;
    return r;
  }
  template <class Real>
  ForceAndEnergy<Real> force_and_energy(const State<Real> &s, const CohesiveGeometry<Real> &g,
                                        const BondMotion<Real> &pose) const {
    const CohesiveResponse<Real> r = response(s, g, pose.distance);
    return {r.force, r.energy};
  }
  template <class Real>
  Real plastic_work(const State<Real> &s, const CohesiveGeometry<Real> &) const {
    return s.work;
  }
  template <class Real>
  static Real damage_of(const State<Real> &s) {
    return s.stretch * 0.0;
  }
  static bool failed_in_tension(const State<double> &) { return false; }
  BondStiffness stiffness(const BondGeometry<double> &g) const {
    return {pi * g.radius * g.radius * g.normal_stiffness, 0, 0, 0};
  }
  bool bends() const { return false; }
};

} // namespace platen::dem
