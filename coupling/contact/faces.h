// The flat faces of a surface that moves without turning: data that do not change from step to step are
// computed once, so that the closest point of a platen to a particle costs a few products.
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
  void set_plane(const Vector3 &normal); // the direction of the projection of points
};

// A face at the setup of the search, in doubles only and three cache lines.
struct alignas(64) FlatFace : BilinearMap {
  Vector3 normal;  // unit, out of the body
  double flat = 0; // 1: flat and convex
  double spare[3]{};
};

// A closest point on a flat face: its position, and the distance of the centre along the normal (m), negative
// inside the body.
struct FlatPoint {
  double u = 0, v = 0, distance = 0;
};

// Closest point of a centre, given relative to the face's first corner (m), where the face is flat and convex
// and the closest point lies inside it, off its rim by 1e-9 of its size; elsewhere false, without a point.
bool find_closest(const FlatFace &face, const Vector3 &centre, FlatPoint &closest);

class FlatFaces {
public:
  // From the present positions of the faces; a later shift of all of them changes nothing.
  explicit FlatFaces(const fem::SurfaceMesh &surface);

  const FlatFace &face(int index) const { return faces_[static_cast<std::size_t>(index)]; }
  // Faces with the same number form one flat piece of the surface: outside the face with the closest point,
  // no face of the piece is nearer to a centre.
  int piece(int face) const { return piece_[static_cast<std::size_t>(face)]; }

private:
  static FlatFace face_of(const Quad &corners);
  void join_pieces(const fem::SurfaceMesh &surface);

  std::vector<FlatFace> faces_;
  std::vector<int> piece_;
};

// The faces of a surface that turns or deforms, in one step: data that all particles near a face use are
// computed once, so that the closest point of each costs two steps of Newton's method. The start is the
// inverse of the map in the mean plane.
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

// No point of the face is nearer to the centre (m, global axes) than the root of the result (m^2).
double least_distance_squared(const MovingFace &face, const Vector3 &centre);

// A closest point inside a face.
struct FacePoint {
  double u = 0, v = 0;
  Vector3 out;              // m, from the closest point to the centre
  Vector3 along_u, along_v; // m, tangents
  Vector3 normal;           // unit, out of the body
};

// Closest point of the centre where there is a single one and it lies inside the face, off its rim by 1e-9 of
// its size: to 1e-12 of the face along it, and so with a distance to round-off. Elsewhere false, and the
// point is undefined.
bool find_closest(const MovingFace &face, const Vector3 &centre, FacePoint &closest);

} // namespace platen::coupling
