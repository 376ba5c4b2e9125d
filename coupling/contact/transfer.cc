#include "coupling/contact/transfer.h"

#include <array>

namespace platen::coupling {

namespace {

Quad corner_velocities(const fem::SurfaceMesh &surface, int face) {
  const std::array<int, 4> &v = surface.faces[static_cast<std::size_t>(face)];
  const auto at = [&](std::size_t k) { return surface.velocities[static_cast<std::size_t>(v[k])]; };
  return {at(0), at(1), at(2), at(3)};
}

// Corners relative to their mean.
Quad arms(const fem::SurfaceMesh &surface, int face) {
  Quad q = face_corners(surface, face, vertex_at(surface, surface.faces[static_cast<std::size_t>(face)][0]));
  const Vector3 mean = 0.25 * ((q[0] + q[1]) + (q[2] + q[3]));
  for (Vector3 &corner : q)
    corner -= mean;
  return q;
}

// Solves J x = b with J = sum (r.r 1 - r r^T) over the arms; zero where J is singular (arms on a line).
Vector3 turn_by_arms(const Quad &r, const Vector3 &b) {
  Vector3 row[3] = {};
  double trace = 0;
  for (const Vector3 &a : r) {
    trace += norm_squared(a);
    for (int k = 0; k < 3; ++k)
      row[k] -= a[k] * a;
  }
  for (int k = 0; k < 3; ++k)
    row[k][k] += trace;
  const double determinant = dot(row[0], cross(row[1], row[2]));
  constexpr double on_a_line = 1e-24; // relative: a needle of aspect 1e-12
  if (!(determinant > on_a_line * trace * trace * trace)) return {};
  return (b.x * cross(row[1], row[2]) + b.y * cross(row[2], row[0]) + b.z * cross(row[0], row[1])) /
         determinant;
}

} // namespace

SurfaceMotion surface_motion(const fem::SurfaceMesh &surface, const SurfacePoint &point) {
  if (surface.only_shifted) return {surface.velocities[0]};
  // Written so that equal velocities give that velocity without rounding.
  const Quad v = corner_velocities(surface, point.face);
  const Vector3 by_u = derivative_u(v, point.local.v), by_v = derivative_v(v, point.local.u);
  SurfaceMotion motion;
  motion.velocity = v[0] + (point.local.u * (v[1] - v[0]) + point.local.v * by_v);
  // For tangents a, b that move with w: (va . b - vb . a) / 2 = w . (a x b), the antisymmetric part of the
  // gradient.
  const double turning = dot(by_u, point.along_v) - dot(by_v, point.along_u);
  if (turning == 0) return motion;
  const double area = norm(cross(point.along_u, point.along_v));
  if (area > 0) motion.spin = 0.5 * turning / area;
  return motion;
}

Vector3 face_rotation(const fem::SurfaceMesh &surface, int face) {
  const Quad r = arms(surface, face), v = corner_velocities(surface, face);
  Vector3 circulation;
  for (std::size_t k = 0; k < 4; ++k)
    circulation += cross(r[k], v[k] - v[0]);
  return turn_by_arms(r, circulation);
}

void apply_moment(fem::LoadedSurface &body, int face, const Vector3 &moment) {
  const Quad r = arms(body.surface(), face);
  const Vector3 turn = turn_by_arms(r, moment);
  const std::array<int, 4> corners = body.surface().faces[static_cast<std::size_t>(face)];
  for (std::size_t k = 0; k < 4; ++k)
    body.add_surface_force(corners[k], cross(turn, r[k]));
}

} // namespace platen::coupling
