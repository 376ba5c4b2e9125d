// The closest point of a surface to a listed particle, and the normal there: on faces, and at edges and
// vertices.
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/portable.h"
#include "coupling/contact/surface_search.h"

namespace platen::coupling {

using fem::SurfaceMesh;

namespace {

const std::array<int, 4> &corners_of(const SurfaceMesh &surface, int face) {
  return surface.faces[static_cast<std::size_t>(face)];
}

double largest_corner(const Quad &q) {
  return std::sqrt(
      std::max({norm_squared(q[0]), norm_squared(q[1]), norm_squared(q[2]), norm_squared(q[3])}));
}

// Distance of the origin from the box around the corners: no point of the face is nearer.
double box_distance_squared(const Quad &q) {
  Box box{q[0], q[0]};
  for (std::size_t k = 1; k < 4; ++k)
    box.include(q[k]);
  return box.distance_squared({});
}

void set_point(const FacePoint &closest, SurfacePoint &point) {
  ClosestPoint &local = point.local;
  local.point = -closest.out;
  local.weights = bilinear_weights(closest.u, closest.v);
  local.u = closest.u;
  local.v = closest.v;
  local.distance_squared = norm_squared(closest.out);
  local.feature = Feature::face;
  local.local = 0;
  point.normal = closest.normal;
  point.distance = dot(closest.out, closest.normal);
  point.along_u = closest.along_u;
  point.along_v = closest.along_v;
}

} // namespace

Vector3 SurfaceSearch::from_corner(const SurfaceMesh &surface, int face, const Vector3 &centre) const {
  return centre - vertex_at(surface, corners_of(surface, face)[0]);
}

void SurfaceSearch::set_flat_point(int face, const FlatPoint &closest, SurfacePoint &result) const {
  result.face = face;
  result.normal = flat_.face(face).normal;
  result.distance = closest.distance;
  result.local = ClosestPoint{};
  result.local.point = -closest.distance * result.normal;
  result.local.weights = bilinear_weights(closest.u, closest.v);
  result.local.u = closest.u;
  result.local.v = closest.v;
  result.local.distance_squared = closest.distance * closest.distance;
}

// The closest point on a flat face of a surface that has not turned since the search was set up.
bool SurfaceSearch::closest(const SurfaceMesh &surface, int face, const Vector3 &centre,
                            SurfacePoint &result) const {
  FlatPoint closest;
  if (!surface.only_shifted || !find_closest(flat_.face(face), from_corner(surface, face, centre), closest))
    return false;
  set_flat_point(face, closest, result);
  return true;
}

// For a closest point on a listed face: every other face lies in the same plane or farther away.
bool SurfaceSearch::others_are_farther(std::size_t k, int face, double distance) const {
  const double limit = std::abs(distance) * (1 + margin);
  const int piece = flat_.piece(face);
  for (std::size_t other = first_near_[k]; other < first_near_[k + 1]; ++other) {
    if (near_[other].distance - travelled_ > limit) break;
    if (flat_.piece(near_[other].face) != piece) return false;
  }
  return true;
}

// The same, where it is certain to be the closest point of all. If false, the result is undefined.
bool SurfaceSearch::closest_on_nearest(const SurfaceMesh &surface, std::size_t k, const Vector3 &centre,
                                       SurfacePoint &result) const {
  for (std::size_t n = first_near_[k]; n < first_near_[k + 1]; ++n)
    if (closest(surface, near_[n].face, centre, result))
      return others_are_farther(k, result.face, result.distance);
  return false;
}

bool SurfaceSearch::nearest_on(const SurfaceMesh &surface, int face, const Vector3 &centre,
                               const MovingFace *moving, SurfacePoint &nearest) const {
  nearest.face = face;
  FacePoint closest;
  if (moving == nullptr || !find_closest(*moving, centre, closest)) {
    nearest.local = closest_point(face_corners(surface, face, centre));
    return false;
  }
  set_point(closest, nearest);
  return true;
}

SurfacePoint SurfaceSearch::closest(const SurfaceMesh &surface, std::size_t k, const Vector3 &centre) const {
  SurfacePoint point;
  if (surface.only_shifted && closest_on_nearest(surface, k, centre, point)) return point;
  return closest_listed(surface, k, centre);
}

// As closest_on_nearest: most centres have their closest point on the first listed face.
void SurfaceSearch::closest_on_flat(const SurfaceMesh &surface, const std::size_t *entry,
                                    const Vector3 *centre, const int *at, std::size_t count,
                                    SurfacePoints &points) const {
  const FlatFace *face[SurfacePoints::most] = {};
  const Vector3 *corner[SurfacePoints::most] = {};
  for (std::size_t n = 0; n < count; ++n) {
    const int first = points.face[n] = first_face(entry[n]);
    face[n] = &flat_.face(first);
    corner[n] = &vertex_at(surface, corners_of(surface, first)[0]);
  }
  const std::uint32_t found = find_flat_closest_points_(face, corner, centre, at, count, points);
  for (std::size_t n = 0; n < count; ++n)
    if (!(found >> n & 1u) || !others_are_farther(entry[n], points.face[n], points.distance[n]))
      points.set(n, closest(surface, entry[n], centre[at[n]]), centre[at[n]]);
}

// A closest point on the first face of the list is the result where every other listed face is certain to be
// farther.
void SurfaceSearch::closest(const SurfaceMesh &surface, const std::size_t *entry, const Vector3 *centre,
                            const int *at, std::size_t count, SurfacePoints &points) const {
  if (surface.only_shifted) return closest_on_flat(surface, entry, centre, at, count, points);
  if (!looked_) {
    for (std::size_t n = 0; n < count; ++n)
      points.set(n, closest(surface, entry[n], centre[at[n]]), centre[at[n]]);
    return;
  }
  const MovingFace *face[SurfacePoints::most] = {};
  for (std::size_t n = 0; n < count; ++n) {
    points.face[n] = first_face(entry[n]);
    face[n] = &moving_[static_cast<std::size_t>(points.face[n])];
  }
  const std::uint32_t found = find_closest_points_(face, centre, at, count, points);
  for (std::size_t n = 0; n < count; ++n)
    if (!(found >> n & 1u) || !is_nearest(entry[n], centre[at[n]], points.distance_squared[n]))
      points.set(n, closest_listed(surface, entry[n], centre[at[n]]), centre[at[n]]);
}

// Whether no face after the first can be as near as that.
bool SurfaceSearch::is_nearest(std::size_t k, const Vector3 &centre, double distance_squared) const {
  const double limit = distance_squared * (1 + margin), distance = std::sqrt(distance_squared);
  for (std::size_t n = first_near_[k] + 1; n < first_near_[k + 1]; ++n) {
    if (near_[n].distance - travelled_ > distance * (1 + margin)) return true;
    if (!(least_distance_squared(moving_[static_cast<std::size_t>(near_[n].face)], centre) > limit))
      return false;
  }
  return true;
}

SurfacePoint SurfaceSearch::closest_listed(const SurfaceMesh &surface, std::size_t k,
                                           const Vector3 &centre) const {
  SurfacePoint best, found;
  best.local.distance_squared = std::numeric_limits<double>::infinity();
  double best_distance = best.local.distance_squared;
  bool complete = false; // the normal is computed too
  MovingFace made;
  for (std::size_t n = first_near_[k]; n < first_near_[k + 1]; ++n) {
    const int face = near_[n].face;
    if (near_[n].distance - travelled_ > best_distance * (1 + margin)) break;
    const MovingFace *moving = nullptr;
    if (!surface.only_shifted) {
      if (!looked_) made = moving_face(face_corners(surface, face, {}));
      moving = looked_ ? &moving_[static_cast<std::size_t>(face)] : &made;
    }
    if (best.face >= 0) {
      const double least = moving != nullptr ? least_distance_squared(*moving, centre)
                                             : box_distance_squared(face_corners(surface, face, centre));
      if (least > best.local.distance_squared * (1 + margin)) continue;
    }
    const bool found_complete = nearest_on(surface, face, centre, moving, found);
    if (preference(found.local) > preference(best.local)) continue;
    if (preference(found.local) == preference(best.local) && face > best.face) continue;
    best = found;
    complete = found_complete;
    best_distance = std::sqrt(found.local.distance_squared);
  }
  return complete ? best : with_normal(surface, best.face, best.local, centre);
}

SurfacePoint SurfaceSearch::closest_of_all(const SurfaceMesh &surface, const Vector3 &centre) const {
  SurfacePoint best, found;
  best.local.distance_squared = std::numeric_limits<double>::infinity();
  bool complete = false; // the normal is computed too
  for (int face = 0; face < static_cast<int>(surface.faces.size()); ++face) {
    const MovingFace moving =
        surface.only_shifted ? MovingFace{} : moving_face(face_corners(surface, face, {}));
    const bool found_complete =
        nearest_on(surface, face, centre, surface.only_shifted ? nullptr : &moving, found);
    if (!(preference(found.local) < preference(best.local))) continue;
    best = found;
    complete = found_complete;
  }
  return complete ? best : with_normal(surface, best.face, best.local, centre);
}

// Inside or outside: on a face its normal decides; on an edge or vertex the sum of the normals around it,
// weighted by angle, decides for any closed surface (Baerentzen and Aanaes 2005).
SurfacePoint SurfaceSearch::with_normal(const SurfaceMesh &surface, int face, const ClosestPoint &local,
                                        const Vector3 &centre) const {
  SurfacePoint s;
  // The same formula as in closest(), so that both give the same bits.
  if (local.feature == Feature::face && closest(surface, face, centre, s)) return s;
  s.face = face;
  s.local = local;
  const Vector3 out = -local.point;
  const Quad corners = face_corners(surface, face, centre);
  s.along_u = derivative_u(corners, local.v);
  s.along_v = derivative_v(corners, local.u);
  Vector3 mean;
  if (local.feature == Feature::face) {
    mean = bilinear_normal(corners, local.u, local.v);
    if (norm_squared(mean) > 0) {
      s.normal = mean;
      s.distance = dot(out, mean);
      return s;
    }
  } else {
    mean = local.feature == Feature::edge ? edge_normal(surface, face, local, centre)
                                          : vertex_normal(surface, face, local.local, centre);
  }
  // Across an edge inside a flat face the direction from surface to centre is that of the normal up to
  // round-off of the corners; there, and where the centre lies on the surface, the normal itself is used.
  const double noise = 32 * std::numeric_limits<double>::epsilon() * largest_corner(corners);
  const double size = norm(out);
  if (norm_squared(mean) > 0 && norm(cross(out, mean)) <= noise) {
    s.normal = mean;
    s.distance = dot(out, mean);
  } else {
    const double side = dot(out, mean) < 0 ? -1.0 : 1.0;
    s.normal = size > 0 ? (side / size) * out : Vector3{0, 0, 1}; // a surface without area: any direction
    s.distance = side * size;
  }
  return s;
}

Vector3 SurfaceSearch::edge_normal(const SurfaceMesh &surface, int face, const ClosestPoint &local,
                                   const Vector3 &centre) const {
  const std::array<int, 4> &own = corners_of(surface, face);
  const std::size_t k = static_cast<std::size_t>(local.local);
  const int a = own[k], b = own[(k + 1) % 4];
  const double along = local.weights[(k + 1) % 4]; // fraction of b
  const double corner_u[4] = {0, 1, 1, 0}, corner_v[4] = {0, 0, 1, 1};
  Vector3 sum;
  for (const int other : faces_of_vertex_[static_cast<std::size_t>(a)]) {
    const std::array<int, 4> &ring = corners_of(surface, other);
    for (std::size_t i = 0; i < 4; ++i) {
      const std::size_t j = (i + 1) % 4;
      const bool same = ring[i] == a && ring[j] == b, turned = ring[i] == b && ring[j] == a;
      if (!same && !turned) continue;
      const double s = same ? along : 1 - along;
      sum +=
          bilinear_normal(face_corners(surface, other, centre), corner_u[i] + s * (corner_u[j] - corner_u[i]),
                          corner_v[i] + s * (corner_v[j] - corner_v[i]));
    }
  }
  const double size = norm(sum);
  return size > 0 ? sum / size : Vector3{};
}

Vector3 SurfaceSearch::vertex_normal(const SurfaceMesh &surface, int face, int corner,
                                     const Vector3 &centre) const {
  const std::size_t v = static_cast<std::size_t>(corners_of(surface, face)[static_cast<std::size_t>(corner)]);
  Vector3 sum;
  for (const int other : faces_of_vertex_[v]) {
    const std::array<int, 4> &ring = corners_of(surface, other);
    const Quad q = face_corners(surface, other, centre);
    for (std::size_t i = 0; i < 4; ++i) {
      if (static_cast<std::size_t>(ring[i]) != v) continue;
      const Vector3 next = q[(i + 1) % 4] - q[i], last = q[(i + 3) % 4] - q[i], normal = cross(next, last);
      const double size = norm(normal);
      if (size > 0) sum += (portable::atan2(size, dot(next, last)) / size) * normal;
    }
  }
  const double size = norm(sum);
  return size > 0 ? sum / size : Vector3{};
}

} // namespace platen::coupling
