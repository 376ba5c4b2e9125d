// Parallel bond (Potyondy and Cundall; Tannu 2017 with its misprints mended) in total form, derived from a
// potential, so that it stores no energy under rigid motion, conserves energy exactly and has no history.
//
// Pair (i, j): d = x_j - x_i, n = d / |d|, reference vector D (d when the bond was made, both spheres
// unturned). With r_i = R_i(a D), r_j = R_j((1 - a) D) carried by the spheres' rotations, u = d - r_i - r_j
// is the relative displacement at the contact point c = x_i + a d, and v the vector part of the relative
// rotation quaternion (2 v = relative rotation for small angles, relative error angle^2 / 24). Potential:
//   U = 1/2 k_n A (|d| - |D|)^2 + 1/2 k_s A |u_s|^2 + 2 k_n I |v_s|^2 + 2 k_s J (v.n)^2
// For small motion its derivatives are dF_n = k_n A dU_n, dF_s = k_s A dU_s, dM_n = k_s J dtheta_n,
// dM_s = k_n I dtheta_s. Force and torque are the bond's action on i; tension is positive (docs/theory.md).
#pragma once

#include <cmath>
#include <limits>

namespace platen::dem {

// The kernels need laws inlined into their loops, so that results that a loop does not use cost nothing.
#if defined(__GNUC__)
#define PLATEN_INLINE [[gnu::always_inline]] inline
#else
#define PLATEN_INLINE inline
#endif

// What a law asks of its real type beyond arithmetic; packs bring their own.
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
// Vector of any real type: double, or a pack of doubles in the vectorised kernels.
template <class Real>
struct Triple {
  Real x, y, z;
};
template <class Real>
struct Rotation {
  Real w, x, y, z; // unit quaternion
};

template <class Real>
inline Triple<Real> operator+(const Triple<Real> &a, const Triple<Real> &b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class Real>
inline Triple<Real> operator-(const Triple<Real> &a, const Triple<Real> &b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class Real>
inline Triple<Real> scale(const Real &s, const Triple<Real> &a) {
  return {s * a.x, s * a.y, s * a.z};
}
template <class Real>
inline Real dot(const Triple<Real> &a, const Triple<Real> &b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class Real>
inline Triple<Real> cross(const Triple<Real> &a, const Triple<Real> &b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class Real>
inline Triple<Real> turned(const Rotation<Real> &q, const Triple<Real> &v) {
  const Triple<Real> u{q.x, q.y, q.z};
  Triple<Real> t = cross(u, v);
  t = t + t;
  return {v.x + q.w * t.x + u.y * t.z - u.z * t.y, v.y + q.w * t.y + u.z * t.x - u.x * t.z,
          v.z + q.w * t.z + u.x * t.y - u.y * t.x};
}

// q conj(p): from p to q.
template <class Real>
inline Rotation<Real> between(const Rotation<Real> &p, const Rotation<Real> &q) {
  return {q.w * p.w + q.x * p.x + q.y * p.y + q.z * p.z, q.x * p.w - q.w * p.x - q.y * p.z + q.z * p.y,
          q.y * p.w - q.w * p.y + q.x * p.z - q.z * p.x, q.z * p.w - q.w * p.z - q.x * p.y + q.y * p.x};
}

struct ParallelBond {
  struct Parameters {
    double stiffness_ratio = std::numeric_limits<double>::quiet_NaN(); // k_s / k_n
    double tensile_strength = std::numeric_limits<double>::infinity(); // Pa
    double shear_strength = std::numeric_limits<double>::infinity();   // Pa
    double friction_coefficient = 0;                                   // tan(phi_b)
    double moment_contribution = 1;                                    // beta, 0 ... 1
    bool moments = true; // bending and twisting; false: spheres turn, but bonds resist neither
  };

  template <class Real>
  struct Geometry {
    Triple<Real> reference; // D, m
    Real rest_length;       // |D|, m
    Real lever;             // a = R_i / (R_i + R_j)
    Real normal_stiffness;  // k_n = G_b / L_b, Pa/m; 0 once the bond is broken
    Real radius;            // R_b, m
  };
  template <class Real>
  struct Motion {
    Triple<Real> distance;         // d, m
    Rotation<Real> turn_i, turn_j; // from the reference
  };
  template <class Real>
  struct Response {
    Triple<Real> force, torque_i, torque_j; // N, N m; force on i (on j: minus force)
    Real tension_ratio, shear_ratio;        // sigma_max / sigma_c, tau_max / tau_c; >= 1 breaks
    Real excess;                            // below 0 only where both ratios are below 1; no unit
    Real energy;                            // J
    Real normal_force, shear_force;         // N; signed (tension positive), magnitude
    Triple<Real> shear;                     // shear force on i, N
  };

  Parameters parameters;

  // With rotation; the parameters say whether with moments.
  Response<double> operator()(const Geometry<double> &g, const Motion<double> &m) const {
    return parameters.moments ? turning<true>(g, m) : turning<false>(g, m);
  }
  template <bool moments, class Real>
  Response<Real> turning(const Geometry<Real> &g, const Motion<Real> &m) const;
  // Spheres that do not turn: axial and shear springs only.
  template <class Real>
  Response<Real> without_rotation(const Geometry<Real> &g, const Triple<Real> &distance) const;

private:
  // What the stresses at the bond's skin come from.
  template <class Real>
  struct Strain {
    Real stretch;            // m
    Real slip_square;        // m^2
    Real turn;               // m, R_b times the cosine of half the relative angle, twice; >= 0
    Real bend_square, twist; // of the relative rotation's vector part; twist signed
  };
  template <class Real>
  void add_moments(Response<Real> &r, Strain<Real> &strain, const Real &radius, const Real &bending,
                   const Motion<Real> &m, const Real &length, const Real &per_square) const;
  template <class Real>
  void add_failure(Response<Real> &r, const Real &kn, const Strain<Real> &e) const;
};

// Stresses (physics: sigma_max = F_n/A + beta |M_s| R_b/I, tau_max = |F_s|/A + beta |M_n| R_b/J) in the form
// that needs neither A nor I. The excess compares squares, so that a loop that asks only whether any bond may
// be at its strength takes no root and no quotient; its margin makes up for the round-off of both.
template <class Real>
PLATEN_INLINE void ParallelBond::add_failure(Response<Real> &r, const Real &kn, const Strain<Real> &e) const {
  constexpr double margin = 1 + 1e-12;
  const Parameters &p = parameters;
  const Real axial = kn * e.stretch; // F_n / A
  const Real capacity =
      larger(Real(p.shear_strength - p.friction_coefficient * axial), Real(p.shear_strength));
  const Real shear_modulus = p.stiffness_ratio * kn, turning = p.moment_contribution * e.turn;
  const Real bending_modulus = turning * kn;
  const Real twisting = turning * shear_modulus * magnitude(e.twist);
  r.tension_ratio = (axial + bending_modulus * root(e.bend_square)) * (1.0 / p.tensile_strength);
  r.shear_ratio = (shear_modulus * root(e.slip_square) + twisting) / capacity;

  const Real left = p.tensile_strength - axial, left_in_shear = capacity - twisting;
  const Real tension = margin * bending_modulus * bending_modulus * e.bend_square - left * magnitude(left);
  const Real shear =
      margin * shear_modulus * shear_modulus * e.slip_square - left_in_shear * magnitude(left_in_shear);
  r.excess = larger(tension, shear);
}

template <bool moments, class Real>
PLATEN_INLINE ParallelBond::Response<Real> ParallelBond::turning(const Geometry<Real> &g,
                                                                 const Motion<Real> &m) const {
  constexpr double pi = 3.14159265358979323846;
  const Real bond_square = g.radius * g.radius;
  const Real area_stiffness = pi * bond_square * g.normal_stiffness; // k_n A
  const Real shear_stiffness = parameters.stiffness_ratio * area_stiffness;

  // The direction enters by d / d^2, so that only the stretch waits for the root.
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

  Response<Real> r;
  r.force = scale(Real(normal * (length * per_square)), d) + scale(Real(1.0 - along), shear);
  r.torque_i = cross(ri, shear);
  r.torque_j = cross(rj, shear);
  r.normal_force = normal;
  r.shear_force = shear_stiffness * root(us2);
  r.shear = shear;
  r.energy = 0.5 * (normal * stretch + shear_stiffness * us2);
  const Real zero = length * 0.0;
  Strain<Real> strain{stretch, us2, zero, zero, zero};
  if constexpr (moments)
    add_moments(r, strain, g.radius, 0.25 * bond_square * area_stiffness, m, length, per_square);
  add_failure(r, g.normal_stiffness, strain);
  return r;
}

// Bending and twisting, from the relative rotation (w, v) = q_j conj(q_i). Its sign, the way round, falls out
// of all that is even in it. `bending` is k_n I = k_n A R_b^2 / 4; twisting k_s J = 2 k_s / k_n times that.
template <class Real>
PLATEN_INLINE void ParallelBond::add_moments(Response<Real> &r, Strain<Real> &strain, const Real &radius,
                                             const Real &bending, const Motion<Real> &m, const Real &length,
                                             const Real &per_square) const {
  const Rotation<Real> turn = between(m.turn_i, m.turn_j);
  const Triple<Real> v{turn.x, turn.y, turn.z};
  const double more = 2.0 * parameters.stiffness_ratio - 1.0; // of twisting over bending stiffness
  const Triple<Real> &d = m.distance;
  const Real along = dot(v, d) * per_square, vn = along * length; // v.n / |d|, v.n
  const Triple<Real> vs = v - scale(along, d);
  const Real vs2 = dot(vs, vs);
  const Real excess = more * bending * along;
  const Triple<Real> skew = scale(Real(2.0 * excess), cross(v, d));
  const Triple<Real> moment = scale(Real(2.0 * turn.w), scale(bending, v) + scale(excess, d));
  r.force = r.force + scale(Real(4.0 * excess), vs);
  r.torque_i = r.torque_i + moment - skew;
  r.torque_j = r.torque_j - moment - skew;
  r.energy = r.energy + 2.0 * bending * (vs2 + (more + 1.0) * vn * vn);
  strain.turn = 2.0 * magnitude(turn.w) * radius;
  strain.bend_square = vs2;
  strain.twist = vn;
}

template <class Real>
PLATEN_INLINE ParallelBond::Response<Real> ParallelBond::without_rotation(const Geometry<Real> &g,
                                                                          const Triple<Real> &d) const {
  constexpr double pi = 3.14159265358979323846;
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
  Response<Real> r;
  r.shear = scale(shear_stiffness, us);
  r.force = scale(normal, n) + scale(Real(1.0 - un * inverse), r.shear);
  r.torque_i = r.torque_j = {zero, zero, zero};
  const Real us2 = dot(us, us);
  r.normal_force = normal;
  r.shear_force = shear_stiffness * root(us2);
  r.energy = 0.5 * (normal * stretch + shear_stiffness * us2);
  add_failure(r, g.normal_stiffness, Strain<Real>{stretch, us2, zero, zero, zero});
  return r;
}

} // namespace platen::dem
