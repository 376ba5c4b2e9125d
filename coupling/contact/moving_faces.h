// The faces of a surface that turns or deforms, as they are in one step: what all particles near a face share
// is worked out once, so that the foot of each costs two steps of Newton's method.
#pragma once

#include "coupling/contact/closest_point.h"

namespace platen::coupling {

// x(u, v) = corner + u e + v f + uv t, the bilinear map of closest_point.h.
struct MovingFace {
  Vector3 corner, e, f, t; // m
  // The map inverted in the mean plane, for a start: square v^2 + (r.linear + constant) v + r.free = 0 for
  // r = x - corner, and u follows.
  Vector3 linear, free;
  double square = 0, constant = 0;
  // A box around the face, along its mean plane.
  Vector3 normal, along, across; // unit
  Vector3 middle, half;          // m, global axes; along its own: along, across, normal
  // Centres at most this far from the plane through the first corner have a single foot (m); negative: none.
  double single_foot = -1;
};

// From corners in global axes (m). Any corners are legal.
MovingFace moving_face(const Quad &corners);

// No point of the face is nearer to the centre (m, global axes) than the root of this (m^2).
double least_distance_squared(const MovingFace &face, const Vector3 &centre);

// A foot inside a face.
struct Foot {
  double u = 0, v = 0;
  Vector3 out;              // m, from the foot to the centre
  Vector3 along_u, along_v; // m, tangents
  Vector3 normal;           // unit, out of the body
};

// Foot of the centre where there is a single one and it lies inside the face, off its rim by 1e-9 of its
// size: to 1e-12 of the face along it, and so with a distance to round-off. False elsewhere, which says
// nothing.
bool find_foot(const MovingFace &face, const Vector3 &centre, Foot &foot);

} // namespace platen::coupling
