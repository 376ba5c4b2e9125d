// Motion from a surface to a point of it, and force from the point back: the same weights in both directions.
// Motion is consistent (a rigid motion of the corners gives the same rigid motion of the point), force is
// conservative (the corner forces have the same sum, the same moment about any point and the same power). One
// follows from the other, because one map is the transpose of the other.
#pragma once

#include <array>

#include "coupling/contact/surface_search.h"
#include "fem/surface.h"

namespace platen::coupling {

// The motion of the surface at a closest point.
struct SurfaceMotion {
  Vector3 velocity; // m/s, sum w_i v_i
  double spin = 0;  // rad/s about the normal, of the face's plane
};
SurfaceMotion surface_motion(const fem::SurfaceMesh &surface, const SurfacePoint &point);

// Rotation of a face: that of its four corners in the least-squares sense (rad/s, global axes): exact where
// they move rigidly; zero for corners on a line.
Vector3 face_rotation(const fem::SurfaceMesh &surface, int face);

// Adds a moment (N m) to the corners as forces with zero sum: the transpose of face_rotation.
void apply_moment(fem::LoadedSurface &body, int face, const Vector3 &moment);

} // namespace platen::coupling
