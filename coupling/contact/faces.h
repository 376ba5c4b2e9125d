// The flat faces of a surface that moves without turning: what does not change from step to step is worked
// out once, so that the closest point of a particle on a platen costs a few products.
#pragma once

#include <vector>

#include "coupling/contact/closest_point.h"
#include "fem/surface.h"

namespace platen::coupling {

// The bilinear map of a face, x = q0 + u e + v (f + u t), m, and its inverse in a plane: v solves
// square v^2 + (r.linear + constant) v + r.free = 0 for r = x - q0, and u follows.
struct BilinearMap {
  Vector3 e, f, t;
  Vector3 linear, free;
  double square = 0, constant = 0;

  void set_corners(const Quad &corners);
  void set_plane(const Vector3 &normal); // along which points come down
};

// A face as it was when the search was set up, in doubles alone and three cache lines.
struct alignas(64) FlatFace : BilinearMap {
  Vector3 normal;  // unit, out of the body
  double flat = 0; // 1: flat and convex
  double spare[3]{};
};

// A closest point on a flat face: its place, and the distance of the centre along the normal (m), negative
// inside the body.
struct FlatPoint {
  double u = 0, v = 0, distance = 0;
};

// Closest point of a centre, given relative to the face's first corner (m), where the face is flat and convex
// and the closest point lies inside it, off its rim by 1e-9 of its size; false elsewhere, which says nothing.
bool find_closest(const FlatFace &face, const Vector3 &centre, FlatPoint &closest);

class FlatFaces {
public:
  // From the faces where they are now; a later shift of all of them changes nothing.
  explicit FlatFaces(const fem::SurfaceMesh &surface);

  const FlatFace &face(int index) const { return faces_[static_cast<std::size_t>(index)]; }
  // Faces with the same number make up one flat piece of the surface: outside the face that holds its closest
  // point, no face of the piece is nearer to a centre.
  int piece(int face) const { return piece_[static_cast<std::size_t>(face)]; }

private:
  static FlatFace face_of(const Quad &corners);
  void join_pieces(const fem::SurfaceMesh &surface);

  std::vector<FlatFace> faces_;
  std::vector<int> piece_;
};

// The faces of a surface that turns or deforms, as they are in one step: what all particles near a face share
// is worked out once, so that the closest point of each costs two steps of Newton's method. The map is
// inverted in the mean plane, for a start.
struct alignas(64) MovingFace : BilinearMap {
  Vector3 corner; // m
  Vector3 normal; // unit, of the mean plane
  // Centres at most this far from the plane through the first corner have a single closest point (m);
  // negative: none.
  double single_closest = -1;
  // A box around the face, along its mean plane.
  Vector3 along, across; // unit
  Vector3 middle, half;  // m, global axes; along its own: along, across, normal
};

// From corners in global axes (m). Any corners are legal.
MovingFace moving_face(const Quad &corners);

// No point of the face is nearer to the centre (m, global axes) than the root of this (m^2).
double least_distance_squared(const MovingFace &face, const Vector3 &centre);

// A closest point inside a face.
struct FacePoint {
  double u = 0, v = 0;
  Vector3 out;              // m, from the closest point to the centre
  Vector3 along_u, along_v; // m, tangents
  Vector3 normal;           // unit, out of the body
};

// Closest point of the centre where there is a single one and it lies inside the face, off its rim by 1e-9 of
// its size: to 1e-12 of the face along it, and so with a distance to round-off. False elsewhere, which says
// nothing.
bool find_closest(const MovingFace &face, const Vector3 &centre, FacePoint &closest);

} // namespace platen::coupling
