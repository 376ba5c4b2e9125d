// The closest point of a face that moves or is flat to a centre, for one centre or for a SIMD vector of them:
// one source, so that both give the same bits.
#pragma once

#include "dem/laws/lanes.h"

namespace platen::coupling {

// The part of MovingFace (faces.h) that the search for a closest point reads.
template <class Real>
struct FaceMap {
  dem::Triple<Real> e, f, t, linear, free, corner, normal;
  Real square, constant, single_closest;
};

template <class Real>
struct ClosestOnFace {
  Real u, v;
  dem::Triple<Real> out, along_u, along_v, normal;
};

namespace closest_search {
constexpr double rim =
    1e-9; // width of the rim, in u and v, that is left to the general search, which handles edges
// A start this far outside the face does not return onto it: the warp moves a closest point by less.
constexpr double far_off = 0.05;
// A full step of Newton's method leaves an error of the order of its square: less than 1e-12 of the face.
constexpr double last_move = 1e-6;
constexpr int most_steps = 8;
} // namespace closest_search

namespace closest_search {
template <class How, class Real>
PLATEN_INLINE auto inside(const Real &a, double by) {
  return How::above(a, Real(by)) & How::above(Real(1 - by), a);
}
} // namespace closest_search

// The part of FlatFace (faces.h) that its search reads.
template <class Real>
struct FlatMap {
  dem::Triple<Real> e, f, t, linear, free, normal;
  Real square, constant, flat; // flat: 1, or 0
};
template <class Real>
struct ClosestOnFlat {
  Real u, v, distance; // m, along the normal
};

// Where the result is true: the closest point of a flat face, inside it and off its rim, to a centre that is
// given relative to the first corner.
template <class How, class Real>
PLATEN_INLINE auto search_flat_closest(const FlatMap<Real> &face, const dem::Triple<Real> &centre,
                                       ClosestOnFlat<Real> &closest) {
  using namespace closest_search;
  using dem::dot, dem::scale;
  const Real first = dot(centre, face.linear) + face.constant, zeroth = dot(centre, face.free);
  const Real discriminant = first * first - Real(4.0) * face.square * zeroth;
  closest.v = Real(-2.0) * zeroth / (first + How::with_sign(How::root(discriminant), first));
  const dem::Triple<Real> along = face.e + scale(closest.v, face.t);
  closest.u = dot(centre - scale(closest.v, face.f), along) / dot(along, along);
  closest.distance = dot(centre, face.normal);
  return How::above(face.flat, Real(0.5)) & How::at_least(discriminant, Real(0.0)) &
         inside<How>(closest.v, rim) & inside<How>(closest.u, rim);
}

// Where the result is true (lane by lane of a SIMD vector): the closest point inside the face, single and off
// its rim.
template <class How, class Real>
PLATEN_INLINE auto search_closest(const FaceMap<Real> &face, const dem::Triple<Real> &centre,
                                  ClosestOnFace<Real> &closest) {
  using namespace closest_search;
  using dem::cross, dem::dot, dem::scale;
  const dem::Triple<Real> r = centre - face.corner;
  auto found = How::at_least(face.single_closest, How::magnitude(dot(r, face.normal)));
  const Real first = dot(r, face.linear) + face.constant, zeroth = dot(r, face.free);
  const Real discriminant = first * first - Real(4.0) * face.square * zeroth;
  found = found & How::at_least(discriminant, Real(0.0));
  if (!How::any(found)) return found;
  Real v = Real(-2.0) * zeroth / (first + How::with_sign(How::root(discriminant), first));
  found = found & inside<How>(v, -far_off);
  const dem::Triple<Real> along = face.e + scale(v, face.t);
  Real u = dot(r - scale(v, face.f), along) / dot(along, along);
  found = found & inside<How>(u, -far_off);
  Real moved = Real(1.0);
  auto moves = found;
  for (int step = 0; step < most_steps && How::any(moves); ++step) {
    const dem::Triple<Real> a = face.e + scale(v, face.t), b = face.f + scale(u, face.t);
    const dem::Triple<Real> out = r - scale(u, face.e) - scale(v, b); // from the face to the centre
    const Real gu = dot(out, a), gv = dot(out, b);
    const Real aa = dot(a, a), bb = dot(b, b), off = dot(a, b) - dot(out, face.t);
    const Real by = Real(1.0) / (aa * bb - off * off);
    const Real du = (gu * bb - gv * off) * by, dv = (gv * aa - gu * off) * by;
    u = How::choose(moves, u + du, u);
    v = How::choose(moves, v + dv, v);
    const Real along_u = How::magnitude(du), along_v = How::magnitude(dv);
    moved = How::choose(moves, How::choose(How::above(along_v, along_u), along_v, along_u), moved);
    moves = moves & How::above(moved, Real(last_move));
  }
  found = found & How::at_least(Real(last_move), moved) & inside<How>(u, rim) & inside<How>(v, rim);
  closest.u = u;
  closest.v = v;
  closest.along_u = face.e + scale(v, face.t);
  closest.along_v = face.f + scale(u, face.t);
  closest.out = r - scale(u, face.e) - scale(v, closest.along_v);
  const dem::Triple<Real> n = cross(closest.along_u, closest.along_v);
  const Real size = How::root(dot(n, n));
  closest.normal = {n.x / size, n.y / size, n.z / size};
  return found;
}

} // namespace platen::coupling
