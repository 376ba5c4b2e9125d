// Common form of elastic bonds between two spheres: a potential of their present distance and orientations,
// with its exact derivatives, so that rigid motion of any size stores no energy, energy is conserved and
// there is no history.
//
// Pair (i, j): d = x_j - x_i, n = d / |d|, reference vector D (d when the bond was made, both spheres
// unturned). With r_i = R_i(a D), r_j = R_j((1 - a) D) carried by the spheres' rotations, u = d - r_i - r_j
// is the relative displacement at the point c = x_i + a d, and v the vector part of the relative rotation
// quaternion (2 v = relative rotation for small angles, relative error angle^2 / 24). Potential:
//   U = 1/2 k_n A (|d| - |D|)^2 + 1/2 K_s |u_s|^2 + 2 k_n I |v_s|^2 + 2 K_t (v.n)^2
// Each law defines K_s, K_t, a and the criterion of failure. Force and torque are the action of the bond on
// i; tension is positive (docs/theory.md).
#pragma once

#include <cmath>
#include <limits>

#include "base/describe.h"
#include "base/portable.h"

namespace platen::dem {

// The kernels need laws inlined into their loops, so that results that a loop does not use cost nothing.
#if defined(__GNUC__)
#define PLATEN_INLINE [[gnu::always_inline]] inline
#else
#define PLATEN_INLINE inline
#endif

// Functions that a law needs for its real type beyond arithmetic; SIMD vectors define their own.
inline double root(double a) {
  return std::sqrt(a);
}
inline double magnitude(double a) {
  return std::abs(a);
}
inline double positive_part(double a) {
  return a > 0.0 ? a : 0.0;
}
inline double larger(double a, double b) {
  return a > b ? a : b;
}
// a where x > 0, otherwise b.
inline double where_positive(double x, double a, double b) {
  return x > 0.0 ? a : b;
}
// For a SIMD vector: whether any lane is positive.
inline bool any_positive(double a) {
  return a > 0.0;
}
// For a SIMD vector: whether every lane is positive.
inline bool all_positive(double a) {
  return a > 0.0;
}
// Vector of any real type: double, or a SIMD vector of doubles in the vectorised kernels.
template <class Real>
struct Triple {
  Real x, y, z;
};
template <class Real>
struct Rotation {
  Real w, x, y, z; // unit quaternion
};

template <class Real>
PLATEN_INLINE Triple<Real> operator+(const Triple<Real> &a, const Triple<Real> &b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class Real>
PLATEN_INLINE Triple<Real> operator-(const Triple<Real> &a, const Triple<Real> &b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class Real>
PLATEN_INLINE Triple<Real> scale(const Real &s, const Triple<Real> &a) {
  return {s * a.x, s * a.y, s * a.z};
}
template <class Real>
PLATEN_INLINE Real dot(const Triple<Real> &a, const Triple<Real> &b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class Real>
PLATEN_INLINE Triple<Real> cross(const Triple<Real> &a, const Triple<Real> &b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class Real>
PLATEN_INLINE Triple<Real> turned(const Rotation<Real> &q, const Triple<Real> &v) {
  const Triple<Real> u{q.x, q.y, q.z};
  Triple<Real> t = cross(u, v);
  t = t + t;
  return {v.x + q.w * t.x + u.y * t.z - u.z * t.y, v.y + q.w * t.y + u.z * t.x - u.x * t.z,
          v.z + q.w * t.z + u.x * t.y - u.y * t.x};
}

// q conj(p): the rotation from p to q.
template <class Real>
PLATEN_INLINE Rotation<Real> relative_turn(const Rotation<Real> &p, const Rotation<Real> &q) {
  return {q.w * p.w + q.x * p.x + q.y * p.y + q.z * p.z, q.x * p.w - q.w * p.x - q.y * p.z + q.z * p.y,
          q.y * p.w - q.w * p.y + q.x * p.z - q.z * p.x, q.z * p.w - q.w * p.z - q.x * p.y + q.y * p.x};
}

template <class Real>
struct BondGeometry {
  Triple<Real> reference;           // D, m
  Real rest_length;                 // |D|, m
  Real lever;                       // a
  Real normal_stiffness;            // k_n, Pa/m; 0 once the bond is broken
  Real radius;                      // R_b, m
  Real strength_factor = Real(1.0); // s, factor on both strengths
};
template <class Real>
struct BondMotion {
  Triple<Real> distance;         // d, m
  Rotation<Real> turn_i, turn_j; // from the reference
};
template <class Real>
struct BondResponse {
  Triple<Real> force, torque_i, torque_j; // N, N m; force on i (on j: minus force)
  Real tension_ratio, shear_ratio;        // sigma_max / sigma_c, tau_max / tau_c; >= 1 breaks
  Real excess;                            // below 0 only where both ratios are below 1; dimensionless
  Real energy;                            // J
  Real normal_force, shear_force;         // N; signed (tension positive), magnitude
  Triple<Real> shear;                     // shear force on i, N
};
// Stiffness of one bond, for the time step, dashpots and estimates.
struct BondStiffness {
  double axial = 0, shear = 0;      // N/m: k_n A, K_s
  double bending = 0, twisting = 0; // N m: k_n I, K_t
};

// Strain of a bond, from which a law computes how near it is to its strength.
template <class Real>
struct BondStrain {
  Real length, per_square; // |d|, m; 1 / |d|^2
  Real stretch;            // m
  Triple<Real> slip;       // u_s, m
  Real slip_square;        // m^2
  Real half_cosine;        // w of the relative rotation, of either sign
  Triple<Real> bend;       // v_s, with the sign of w
  Real bend_square;        // |v_s|^2
  Real twist;              // v.n
};

// Axial and shear springs. `area_stiffness` is k_n A, `shear_stiffness` K_s, N/m.
template <class Real>
PLATEN_INLINE BondResponse<Real> stretch_and_shear(const BondGeometry<Real> &g, const BondMotion<Real> &m,
                                                   const Real &area_stiffness, const Real &shear_stiffness,
                                                   BondStrain<Real> &strain) {
  // The direction enters as d / d^2, so that only the stretch waits for the root.
  const Triple<Real> &d = m.distance;
  const Real square = dot(d, d);
  const Real per_square = 1.0 / square, length = root(square);
  const Triple<Real> half = scale(g.lever, g.reference);
  const Triple<Real> ri = turned(m.turn_i, half), rj = turned(m.turn_j, g.reference - half);
  const Triple<Real> u = d - ri - rj;
  const Real along = dot(u, d) * per_square; // u.n / |d|
  const Triple<Real> us = u - scale(along, d);
  const Triple<Real> shear = scale(shear_stiffness, us);
  const Real stretch = length - g.rest_length;
  const Real normal = area_stiffness * stretch, us2 = dot(us, us);

  BondResponse<Real> r;
  r.force = scale(Real(normal * (length * per_square)), d) + scale(Real(1.0 - along), shear);
  r.torque_i = cross(ri, shear);
  r.torque_j = cross(rj, shear);
  r.normal_force = normal;
  r.shear_force = shear_stiffness * root(us2);
  r.shear = shear;
  r.energy = 0.5 * (normal * stretch + shear_stiffness * us2);
  const Real zero = length * 0.0;
  strain = {length, per_square, stretch, us, us2, zero, {zero, zero, zero}, zero, zero};
  return r;
}

// Bending and twisting, from the relative rotation (w, v) = q_j conj(q_i). Force, torques and energy are even
// in it: its sign has no effect. `bending` is k_n I; twisting is 1 + `more` times that.
template <class Real>
PLATEN_INLINE void bend_and_twist(BondResponse<Real> &r, BondStrain<Real> &strain, const Real &bending,
                                  double more, const BondMotion<Real> &m) {
  const Rotation<Real> turn = relative_turn(m.turn_i, m.turn_j);
  const Triple<Real> v{turn.x, turn.y, turn.z};
  const Triple<Real> &d = m.distance;
  const Real along = dot(v, d) * strain.per_square, vn = along * strain.length; // v.n / |d|, v.n
  const Triple<Real> vs = v - scale(along, d);
  const Real vs2 = dot(vs, vs);
  const Real excess = more * bending * along;
  const Triple<Real> skew = scale(Real(2.0 * excess), cross(v, d));
  const Triple<Real> moment = scale(Real(2.0 * turn.w), scale(bending, v) + scale(excess, d));
  r.force = r.force + scale(Real(4.0 * excess), vs);
  r.torque_i = r.torque_i + moment - skew;
  r.torque_j = r.torque_j - moment - skew;
  r.energy = r.energy + 2.0 * bending * (vs2 + (more + 1.0) * vn * vn);
  strain.half_cosine = turn.w;
  strain.bend = vs;
  strain.bend_square = vs2;
  strain.twist = vn;
}

constexpr double right_angle = 1.5707963267948966; // rad

inline double never_if_zero(double strength) {
  return strength > 0 ? strength : std::numeric_limits<double>::infinity();
}

// Strengths in the form that the loops compare with, computed once from the parameters.
struct BondStrength {
  double tensile_strength, shear_strength; // Pa, infinite where never reached
  double friction_coefficient;             // of shear strength in compression, tan(phi_b)

  template <class Parameters>
  explicit BondStrength(const Parameters &p)
      : tensile_strength(never_if_zero(p.tensile_strength)),
        shear_strength(never_if_zero(p.shear_strength)),
        friction_coefficient(portable::tan(p.friction_angle)) {}
};

// Descriptions of parameters that several laws have.
template <class Visitor, class Parameters>
void describe_strengths(Visitor &&v, Parameters &p) {
  v("tensile_strength", p.tensile_strength, "Pa", at_least(0), "0: never breaks in tension.");
  v("shear_strength", p.shear_strength, "Pa", at_least(0), "Cohesion of the bond; 0: never breaks in shear.");
}
template <class Visitor, class Parameters>
void describe_poisson_ratio(Visitor &&v, Parameters &p) {
  v("poisson_ratio", p.poisson_ratio, "1", between_open(-1, 0.5),
    "Of the bond: its shear modulus is E / (2 (1 + nu)).");
}
template <class Visitor, class Parameters>
void describe_moment_contribution(Visitor &&v, Parameters &p) {
  v("moment_contribution", p.moment_contribution, "1", between(0, 1),
    "Share of bending and twisting moment that counts towards failure.");
}
template <class Visitor, class Parameters>
void describe_failure(Visitor &&v, Parameters &p) {
  describe_strengths(v, p);
  v("friction_angle", p.friction_angle, "rad", from_to_below(0, right_angle),
    "Shear strength grows by its tangent times the compression of the bond.");
  describe_moment_contribution(v, p);
}

// Compares the stresses at the skin (Pa) with the strengths p: sigma = axial + bending, tau = shear +
// twisting; the shear strength grows with compression by tan(phi_b), without the strength factor of the bond.
// The excess compares squares, so that a loop that only checks whether any bond may be at its strength needs
// no root and no quotient; its margin covers the round-off of both.
template <class Strength, class Real>
PLATEN_INLINE void compare_with_strength(BondResponse<Real> &r, const Strength &p, const Real &axial,
                                         const Real &bending_square, const Real &shear_square,
                                         const Real &twisting, const Real &factor = Real(1.0)) {
  constexpr double margin = 1 + 1e-12;
  const Real tensile_strength = factor * p.tensile_strength, cohesion = factor * p.shear_strength;
  const Real capacity = larger(Real(cohesion - p.friction_coefficient * axial), cohesion);
  r.tension_ratio = (axial + root(bending_square)) * (1.0 / p.tensile_strength) / factor;
  r.shear_ratio = (root(shear_square) + twisting) / capacity;
  const Real left = tensile_strength - axial, left_in_shear = capacity - twisting;
  r.excess = larger(Real(margin * bending_square - left * magnitude(left)),
                    Real(margin * shear_square - left_in_shear * magnitude(left_in_shear)));
}

} // namespace platen::dem
