#include "coupling/contact/faces.h"

#include <algorithm>
#include <cmath>

#include "coupling/contact/closest_on_face.h"
#include "coupling/contact/face_of_corners.h"
#include "coupling/contact/surface_search.h"

namespace platen::coupling {

namespace {

// Distance from a plane, as a fraction of the face's size, above which a face is not flat.
constexpr double flatness = 1e-14;

double size_of(const Quad &q) {
  return std::max(norm(q[2] - q[0]), norm(q[3] - q[1]));
}

using closest_search::rim;

// Any axes are valid for the box; the face has no closest point.
void set_without_area(const Quad &q, MovingFace &face) {
  Vector3 low, high; // from the first corner
  for (std::size_t k = 1; k < 4; ++k)
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], (q[k] - q[0])[axis]);
      high[axis] = std::max(high[axis], (q[k] - q[0])[axis]);
    }
  const double noise = face_setup::round_off * (norm(face.e) + norm(face.f));
  face.along = {1, 0, 0}, face.across = {0, 1, 0}, face.normal = {0, 0, 1};
  face.middle = q[0] + 0.5 * (low + high);
  face.half = 0.5 * (high - low) + Vector3{noise, noise, noise};
}

} // namespace

void BilinearMap::set_corners(const Quad &q) {
  e = q[1] - q[0];
  f = q[3] - q[0];
  t = (q[0] - q[1]) + (q[2] - q[3]);
}

// (r - v f) and (e + v t) are parallel in the plane.
void BilinearMap::set_plane(const Vector3 &normal) {
  const auto plane = [&](const Vector3 &a, const Vector3 &b) { return dot(cross(a, b), normal); };
  linear = cross(t, normal);
  free = cross(e, normal);
  square = -plane(f, t);
  constant = -plane(f, e);
}

FlatFaces::FlatFaces(const fem::SurfaceMesh &surface) {
  for (int face = 0; face < static_cast<int>(surface.faces.size()); ++face) {
    const Vector3 first = vertex_at(surface, surface.faces[static_cast<std::size_t>(face)][0]);
    faces_.push_back(face_of(face_corners(surface, face, first)));
  }
  join_pieces(surface);
}

FlatFace FlatFaces::face_of(const Quad &q) {
  FlatFace face;
  face.normal = bilinear_normal(q, 0.5, 0.5);
  const double size = size_of(q);
  bool flat = norm_squared(face.normal) > 0;
  for (std::size_t k = 0; k < 4; ++k) {
    const Vector3 edge = q[(k + 1) % 4] - q[k], next = q[(k + 2) % 4] - q[(k + 1) % 4];
    if (std::abs(dot(q[k] - q[0], face.normal)) > flatness * size) flat = false;
    if (!(dot(cross(edge, next), face.normal) > 0)) flat = false; // convex
  }
  face.set_corners(q);
  if (norm(face.t) <= flatness * size) face.t = {};
  face.set_plane(face.normal);
  face.flat = flat ? 1 : 0;
  return face;
}

// Flat faces that share a corner and lie in the plane of the piece's first face.
void FlatFaces::join_pieces(const fem::SurfaceMesh &surface) {
  const std::vector<std::vector<int>> around = fem::faces_of_vertices(surface);
  piece_.assign(faces_.size(), -1);
  for (int first = 0; first < static_cast<int>(faces_.size()); ++first) {
    if (piece(first) >= 0) continue;
    piece_[static_cast<std::size_t>(first)] = first;
    const FlatFace &seed = faces_[static_cast<std::size_t>(first)];
    if (seed.flat == 0) continue;
    const Vector3 origin = vertex_at(surface, surface.faces[static_cast<std::size_t>(first)][0]);
    const auto in_plane = [&](int face) {
      const Quad q = face_corners(surface, face, origin);
      return faces_[static_cast<std::size_t>(face)].flat != 0 &&
             std::all_of(q.begin(), q.end(), [&](const Vector3 &corner) {
               return std::abs(dot(corner, seed.normal)) <= flatness * (size_of(q) + norm(corner));
             });
    };
    std::vector<int> open{first};
    while (!open.empty()) {
      const int face = open.back();
      open.pop_back();
      for (const int v : surface.faces[static_cast<std::size_t>(face)])
        for (const int next : around[static_cast<std::size_t>(v)]) {
          if (piece(next) >= 0 || !in_plane(next)) continue;
          piece_[static_cast<std::size_t>(next)] = first;
          open.push_back(next);
        }
    }
  }
}

MovingFace moving_face(const Quad &q) {
  const dem::Triple<double> corners[4] = {dem::triple_of(q[0]), dem::triple_of(q[1]), dem::triple_of(q[2]),
                                          dem::triple_of(q[3])};
  FaceOfCorners<double> of;
  const bool has_area = set_face<dem::OfScalars>(corners, of);
  MovingFace face;
  face.set_corners(q);
  face.corner = q[0];
  if (!has_area) {
    set_without_area(q, face);
    return face;
  }
  const auto vector = dem::vector_of;
  face.linear = vector(of.linear), face.free = vector(of.free);
  face.square = of.square, face.constant = of.constant;
  face.normal = vector(of.normal), face.single_closest = of.single_closest;
  face.along = vector(of.along), face.across = vector(of.across);
  face.middle = vector(of.middle), face.half = vector(of.half);
  return face;
}

double least_distance_squared(const MovingFace &face, const Vector3 &centre) {
  const Vector3 r = centre - face.middle;
  const double a = std::max(0.0, std::abs(dot(r, face.along)) - face.half.x),
               b = std::max(0.0, std::abs(dot(r, face.across)) - face.half.y),
               c = std::max(0.0, std::abs(dot(r, face.normal)) - face.half.z);
  return a * a + b * b + c * c;
}

bool find_closest(const FlatFace &face, const Vector3 &centre, FlatPoint &closest) {
  const auto triple = dem::triple_of;
  const FlatMap<double> map{triple(face.e),      triple(face.f),    triple(face.t),
                            triple(face.linear), triple(face.free), triple(face.normal),
                            face.square,         face.constant,     face.flat};
  ClosestOnFlat<double> found;
  if (!search_flat_closest<dem::OfScalars>(map, dem::triple_of(centre), found)) return false;
  closest = {found.u, found.v, found.distance};
  return true;
}

bool find_closest(const MovingFace &face, const Vector3 &centre, FacePoint &closest) {
  const auto triple = dem::triple_of;
  const auto vector = dem::vector_of;
  const FaceMap<double> map{triple(face.e),    triple(face.f),      triple(face.t),      triple(face.linear),
                            triple(face.free), triple(face.corner), triple(face.normal), face.square,
                            face.constant,     face.single_closest};
  ClosestOnFace<double> found;
  if (!search_closest<dem::OfScalars>(map, triple(centre), found)) return false;
  closest = {found.u,
             found.v,
             vector(found.out),
             vector(found.along_u),
             vector(found.along_v),
             vector(found.normal)};
  return true;
}

} // namespace platen::coupling
