// Carries a vector of a contact plane (a tangential spring, a rolling moment) along with the plane. The same
// source serves one contact and SIMD vectors of contacts (lanes.h), with the same bits.
#pragma once

#include "base/portable.h"
#include "base/vector3.h"
#include "dem/laws/lanes.h"

namespace platen::dem {

// The vector after the smallest rotation that takes unit normal `from` to unit normal `to` (Rodrigues'
// formula in the form without angle). The result lies in the plane of `to` and has the length of the vector's
// part in the old plane, both to round-off, so that history neither decays nor grows over millions of turns.
template <class How, class Real>
PLATEN_INLINE Triple<Real> carried_with_plane(const Triple<Real> &vector, const Triple<Real> &from,
                                              const Triple<Real> &to) {
  // Opposite normals have no smallest rotation: the vector is kept as it is.
  constexpr double opposite = -1.0 + 1e-12;
  const Triple<Real> flat = vector - scale(dot(vector, from), from), axis = cross(from, to);
  const Real cosine = dot(from, to);
  const Triple<Real> rodrigues =
      scale(cosine, flat) + cross(axis, flat) + scale(Real(dot(axis, flat) / (Real(1.0) + cosine)), axis);
  Triple<Real> turned = choose<How>(How::above(cosine, Real(opposite)), rodrigues, flat);
  turned = turned - scale(dot(turned, to), to);
  const Real size = length<How>(turned);
  turned = choose<How>(How::above(size, Real(0.0)), scale(Real(length<How>(flat) / size), turned),
                       no_vector<Real>());
  const auto same = [](const Real &a, const Real &b) { return How::at_least(a, b) & How::at_least(b, a); };
  return choose<How>(same(from.x, to.x) & same(from.y, to.y) & same(from.z, to.z), flat, turned);
}
inline Vector3 carry_with_plane(const Vector3 &vector, const Vector3 &from, const Vector3 &to) {
  return vector_of(carried_with_plane<OfScalars>(triple_of(vector), triple_of(from), triple_of(to)));
}

// rad per step: below it the first terms of the series are sine and cosine to the last bit.
constexpr double spin_of_a_step = 1e-4;

// The vector after a spin of the plane about its unit normal by `angle` (rad), smaller than that.
template <class How, class Real>
PLATEN_INLINE Triple<Real> spun_a_little(const Triple<Real> &vector, const Triple<Real> &normal,
                                         const Real &angle) {
  const Real square = angle * angle;
  const Triple<Real> spun = scale(Real(Real(1.0) - Real(0.5) * square), vector) +
                            scale(Real(angle * (Real(1.0) - square / Real(6.0))), cross(normal, vector));
  return choose<How>(How::above(How::magnitude(angle), Real(0.0)), spun, vector);
}

// The same by any angle, exactly.
inline Vector3 spin_in_plane(const Vector3 &vector, const Vector3 &normal, double angle) {
  if (std::abs(angle) < spin_of_a_step)
    return vector_of(spun_a_little<OfScalars>(triple_of(vector), triple_of(normal), angle));
  return portable::cos(angle) * vector + portable::sin(angle) * cross(normal, vector);
}

} // namespace platen::dem
