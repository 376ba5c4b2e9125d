// Common form of bonds with a history: their input from the pair, their response, and how a vector in the
// contact plane is carried from step to step.
#pragma once

#include "dem/laws/bond_form.h"

namespace platen::dem {

// A law may have a quick path for bonds that are intact and stay so, which most are at most times:
//   intact_members        how often it changes each member of the State, in the order of describe();
//   intact_reads_motion   whether it gets a CohesiveMotion; otherwise a pair with `distance` and pose();
//   advance_intact(state, geometry, motion or pair, response, yielded)
// Returns false where one bond of a SIMD vector is damaged or may become so: then the state is discarded, and
// operator() computes all of them. Members that change rarely are stored only where `yielded`.
enum class Changes { never, rarely, always };

template <class Real>
struct CohesiveGeometry {
  Real rest_length;                 // |D|, m
  Real lever;                       // a
  Real normal_stiffness;            // k_n, Pa/m
  Real area;                        // A, m^2
  Real strength_factor = Real(1.0); // of both strengths
  // Only where the law needs orientations:
  Triple<Real> reference = {}; // D, m
  Real radius = {};            // R_b, m
};
// From the last step to this one.
template <class Real>
struct CohesiveMotion {
  Triple<Real> distance;  // d, m, now
  Triple<Real> travelled; // of the second centre against the first, m
  // The same at their point of contact, with rotations, m; where the law needs orientations, with the arms at
  // the middle of the step.
  Triple<Real> moved;
  Real spun_along; // rad m: mean rotation of both along d; |d| times the spin
  // Only where the law needs orientations: rotation from the reference, and rotation in the step, rad.
  Rotation<Real> turn_i = {}, turn_j = {};
  Triple<Real> turned_i = {}, turned_j = {};
};
template <class Real>
struct CohesiveResponse {
  Triple<Real> force;   // N, on the first
  Real normal, tension; // F_n, N; T, Pa
  Triple<Real> shear;   // N, on the first
  Real energy;          // J, stored
  Real failed_now;      // positive if it has failed in this step
  // N m, where the law needs orientations; otherwise the force at its arms gives the torques.
  Triple<Real> torque_i = {}, torque_j = {};
};

// Force and energy of a given state: for sums over all bonds.
template <class Real>
struct ForceAndEnergy {
  Triple<Real> force; // N, on the first
  Real energy;        // J, stored
};

// The contact plane, from the last step to this one. A vector in the plane turns with it by the least
// rotation and spins with the pair (Cayley's form), without change of length: v in the plane of the old
// normal m becomes v - (v . n) (m + n)/(1 + m . n), and lies in the plane of the new normal n.
template <class Real>
struct PlaneMotion {
  Triple<Real> n;               // towards the second, now
  Triple<Real> between_normals; // (m + n)/(1 + m . n)
  Triple<Real> moved;           // in the plane, m
  Real half, cosine, sine;      // rad, half of the spin; cosine and sine of the spin

  // `length` is |d|. One quotient serves both lengths and the spin: a SIMD vector of eight waits for each.
  PLATEN_INLINE PlaneMotion(const CohesiveMotion<Real> &m, const Real &length) {
    const Triple<Real> &d = m.distance, before = d - m.travelled;
    const Real square = length * length, length_before = root(dot(before, before));
    const Real both = length * length_before + dot(before, d); // m^2
    const Real spun = 0.5 * m.spun_along, turning = square + spun * spun;
    const Real quotient = 1.0 / (length * both * turning); // 1/m^5
    const Real per_length = quotient * (both * turning), per_turning = quotient * (length * both);
    n = scale(per_length, d);
    between_normals =
        scale(Real(quotient * (length * turning)), scale(length_before, d) + scale(length, before));
    moved = m.moved - scale(dot(m.moved, n), n);
    half = spun * per_length;
    cosine = (square - spun * spun) * per_turning;
    sine = 2.0 * spun * length * per_turning;
  }

  // The motion `by` in the plane at the middle of the step, turned and spun by the other half of the step: an
  // opening while the plane turns is no slip, and the mean of the forces at both ends does the work of the
  // path except for third powers of the step.
  PLATEN_INLINE void take_from_the_middle(const Triple<Real> &by) {
    const Real along = dot(by, between_normals) / dot(between_normals, between_normals);
    const Triple<Real> leant = by - scale(along, between_normals);
    const Triple<Real> flat = leant - scale(dot(leant, n), n);
    moved = flat + scale(half, cross(n, flat));
  }
  // A displacement at the point of contact: turned, plus the slip of the step.
  PLATEN_INLINE Triple<Real> carried(const Triple<Real> &v) const {
    const Triple<Real> flat = v - scale(dot(v, n), between_normals);
    return scale(cosine, flat) + scale(sine, cross(n, flat)) + moved;
  }
};

// For failed bonds with a plastic closing of `plastic` (Pa): whether none is compressed, nor was when its
// friction spring last slid, so that no force acts and no state changes.
template <class Real>
PLATEN_INLINE bool are_separated(const CohesiveGeometry<Real> &g, const Triple<Real> &distance,
                                 const Real &plastic, const Triple<Real> &spring) {
  const Real length = root(dot(distance, distance));
  const Real pressed = g.normal_stiffness * (g.rest_length - length) - plastic; // Pa
  return !any_positive(pressed) && !any_positive(dot(spring, spring));
}

// Friction spring, k x with |k x| <= cap (Pa): the fraction of x (m) that slips and is lost.
template <class Real>
PLATEN_INLINE Real slipping_fraction(const Triple<Real> &spring, const Real &stiffness, const Real &cap) {
  const Real pull = stiffness * root(dot(spring, spring));
  const Real over = positive_part(Real(pull - cap)); // Pa
  return over / where_positive(pull, pull, Real(pull * 0.0 + 1.0));
}

} // namespace platen::dem
