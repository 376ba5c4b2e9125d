// Data of a moving face from its corners, for one face or for a SIMD vector of them: one source, so that both
// give the same bits.
#pragma once

#include "dem/laws/lanes.h"

namespace platen::coupling {

// The members of MovingFace (faces.h), which describes them.
template <class Real>
struct FaceOfCorners {
  dem::Triple<Real> e, f, t, linear, free, corner, normal, along, across, middle, half;
  Real square, constant, single_closest;
};

namespace face_setup {
constexpr double round_off = 1e-12; // of a face: added to a box so that it contains the face

template <class How, class Real>
PLATEN_INLINE Real smaller(const Real &a, const Real &b) {
  return How::choose(How::above(a, b), b, a);
}
template <class How, class Real>
PLATEN_INLINE Real larger(const Real &a, const Real &b) {
  return How::choose(How::above(b, a), b, a);
}
template <class Real>
PLATEN_INLINE dem::Triple<Real> over(const dem::Triple<Real> &a, const Real &by) {
  return {a.x / by, a.y / by, a.z / by};
}

// single_closest_within() (closest_point.h).
//
// Over the mean plane, |x|^2 / 2 = |p|^2 / 2 + z(p)^2 / 2 curves by 1 + z'^2 + z z'', and so upwards
// everywhere where |z z''| < 1. With w the twist's part out of the plane, J the plane's part of (x_u, x_v)
// and |z_u|, |z_v| <= |w| / 2: |z''| <= |w| (1 + |twist| |J^-1| / sqrt(2)) |J^-1|^2, |J^-1| <= |J| / det J.
// det J is linear in u and v, least at a corner.
template <class How, class Real>
PLATEN_INLINE Real single_closest(const dem::Triple<Real> (&q)[4], const dem::Triple<Real> &twist,
                                  const dem::Triple<Real> &normal) {
  using dem::cross, dem::dot;
  const Real zero = Real(0.0), one = Real(1.0);
  const dem::Triple<Real> side[4] = {q[1] - q[0], q[2] - q[1], q[3] - q[2], q[0] - q[3]};
  const dem::Triple<Real> back[4] = {q[3] - q[0], q[0] - q[1], q[1] - q[2], q[2] - q[3]};
  Real least = Real(__builtin_inf()), edge = zero;
  for (int k = 0; k < 4; ++k) {
    least = smaller<How>(least, dot(cross(side[k], back[k]), normal));
    edge = larger<How>(edge, dot(side[k], side[k]));
  }
  const Real inverse = How::root(Real(2.0) * edge) / least, out_of_plane = How::magnitude(dot(twist, normal));
  const Real curved = out_of_plane * (one + dem::length<How>(twist) * inverse) * inverse * inverse;
  const Real within = How::choose(How::above(curved, zero), Real(0.5) / curved, Real(__builtin_inf()));
  return How::choose(How::above(least, zero), within, Real(-1.0));
}

// Along one axis of the box: adds its part to the middle, returns half the length.
template <class How, class Real>
PLATEN_INLINE Real half_box(const dem::Triple<Real> (&q)[4], const dem::Triple<Real> &axis, const Real &noise,
                            dem::Triple<Real> &middle) {
  Real low = Real(0.0), high = Real(0.0); // of the first corner
  for (int k = 1; k < 4; ++k) {
    const Real at = dem::dot(q[k] - q[0], axis);
    low = smaller<How>(low, at), high = larger<How>(high, at);
  }
  middle = middle + dem::scale(Real(Real(0.5) * (low + high)), axis);
  return Real(0.5) * (high - low) + noise;
}
} // namespace face_setup

// From corners in global axes (m). Where the result is false (lane by lane of a SIMD vector) the face has no
// area, and its data are undefined.
template <class How, class Real>
PLATEN_INLINE auto set_face(const dem::Triple<Real> (&q)[4], FaceOfCorners<Real> &face) {
  using dem::cross, dem::dot, dem::scale;
  using namespace face_setup;
  const Real zero = Real(0.0);
  face.corner = q[0];
  face.e = q[1] - q[0], face.f = q[3] - q[0];
  face.t = (q[0] - q[1]) + (q[2] - q[3]);
  const dem::Triple<Real> twice = cross(q[2] - q[0], q[3] - q[1]);
  const Real area = dem::length<How>(twice);
  face.normal = over(twice, area);
  const dem::Triple<Real> along = face.e + scale(Real(0.5), face.t);
  const dem::Triple<Real> flat = along - scale(dot(along, face.normal), face.normal);
  const Real length = dem::length<How>(flat);
  face.along = over(flat, length);
  face.across = cross(face.normal, face.along);
  const Real noise = Real(round_off) * (dem::length<How>(face.e) + dem::length<How>(face.f));
  face.middle = face.corner;
  face.half.x = half_box<How>(q, face.along, noise, face.middle);
  face.half.y = half_box<How>(q, face.across, noise, face.middle);
  face.half.z = half_box<How>(q, face.normal, noise, face.middle);
  face.single_closest = single_closest<How>(q, face.t, face.normal) - Real(2.0) * face.half.z;
  const auto plane = [&](const dem::Triple<Real> &a, const dem::Triple<Real> &b) {
    return dot(cross(a, b), face.normal);
  };
  face.linear = cross(face.t, face.normal), face.free = cross(face.e, face.normal);
  face.square = -plane(face.f, face.t), face.constant = -plane(face.f, face.e);
  return How::above(area, zero) & How::above(length, zero);
}

} // namespace platen::coupling
