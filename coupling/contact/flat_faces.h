// The flat faces of a surface that moves without turning: what does not change from step to step is worked
// out once, so that the foot of a particle on a platen costs a few products.
#pragma once

#include <array>
#include <vector>

#include "coupling/contact/closest_point.h"
#include "fem/surface_mesh.h"

namespace platen::coupling {

class FlatFaces {
public:
  // From the faces where they are now; a later shift of all of them changes nothing.
  explicit FlatFaces(const fem::SurfaceMesh &surface);

  // Foot of a centre, given relative to the face's first corner (m), where the face is flat and convex and
  // the foot lies inside it, off its rim by 1e-9 of its size; false elsewhere, which says nothing. Unit
  // normal out of the body; distance of the centre along it (m), negative inside the body.
  bool foot(int face, const Vector3 &centre, ClosestPoint &local, Vector3 &normal, double &distance) const;

  // Faces with the same number make up one flat piece of the surface: outside the face that holds its foot,
  // no face of the piece is nearer to a centre.
  int piece(int face) const { return piece_[static_cast<std::size_t>(face)]; }

private:
  // The bilinear map x = q0 + u e + v (f + u t), inverted in the plane: v solves
  // square v^2 + (r.linear + constant) v + r.free = 0 for r = x - q0, and u follows.
  struct Face {
    Vector3 normal, e, f, t;
    Vector3 linear, free;
    double square = 0, constant = 0;
    bool flat = false;
  };
  static Face face_of(const Quad &corners);
  void join_pieces(const fem::SurfaceMesh &surface);

  std::vector<Face> faces_;
  std::vector<int> piece_;
};

} // namespace platen::coupling
