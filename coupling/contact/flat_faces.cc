#include "coupling/contact/flat_faces.h"

#include <algorithm>
#include <cmath>

#include "coupling/contact/surface_search.h"

namespace platen::coupling {

namespace {

// Farther from a plane than this share of the face is not flat.
constexpr double flatness = 1e-14;
// Share of the rim, in u and v, that is left to the general search.
constexpr double rim = 1e-9;

double size_of(const Quad &q) {
  return std::max(norm(q[2] - q[0]), norm(q[3] - q[1]));
}

} // namespace

FlatFaces::FlatFaces(const fem::SurfaceMesh &surface) {
  for (int face = 0; face < static_cast<int>(surface.faces.size()); ++face) {
    const Vector3 first = vertex_at(surface, surface.faces[static_cast<std::size_t>(face)][0]);
    faces_.push_back(face_of(face_corners(surface, face, first)));
  }
  join_pieces(surface);
}

FlatFaces::Face FlatFaces::face_of(const Quad &q) {
  Face face;
  face.normal = bilinear_normal(q, 0.5, 0.5);
  const double size = size_of(q);
  face.flat = norm_squared(face.normal) > 0;
  for (std::size_t k = 0; k < 4; ++k) {
    const Vector3 edge = q[(k + 1) % 4] - q[k], next = q[(k + 2) % 4] - q[(k + 1) % 4];
    if (std::abs(dot(q[k] - q[0], face.normal)) > flatness * size) face.flat = false;
    if (!(dot(cross(edge, next), face.normal) > 0)) face.flat = false; // convex
  }
  face.e = q[1] - q[0];
  face.f = q[3] - q[0];
  face.t = (q[0] - q[1]) + (q[2] - q[3]);
  if (norm(face.t) <= flatness * size) face.t = {};
  const auto plane = [&](const Vector3 &a, const Vector3 &b) { return dot(cross(a, b), face.normal); };
  // (r - v f) and (e + v t) are parallel.
  face.linear = cross(face.t, face.normal);
  face.free = cross(face.e, face.normal);
  face.square = -plane(face.f, face.t);
  face.constant = -plane(face.f, face.e);
  return face;
}

bool FlatFaces::foot(int index, const Vector3 &centre, ClosestPoint &local, Vector3 &normal,
                     double &distance) const {
  const Face &face = faces_[static_cast<std::size_t>(index)];
  if (!face.flat) return false;
  const double linear = dot(centre, face.linear) + face.constant, free = dot(centre, face.free);
  const double discriminant = linear * linear - 4 * face.square * free;
  if (!(discriminant >= 0)) return false;
  const double v = -2 * free / (linear + std::copysign(std::sqrt(discriminant), linear));
  if (!(v > rim && v < 1 - rim)) return false;
  const Vector3 along = face.e + v * face.t;
  const double u = dot(centre - v * face.f, along) / norm_squared(along);
  if (!(u > rim && u < 1 - rim)) return false;
  normal = face.normal;
  distance = dot(centre, face.normal);
  local = ClosestPoint{};
  local.point = -distance * face.normal;
  local.weights = bilinear_weights(u, v);
  local.u = u;
  local.v = v;
  local.distance_squared = distance * distance;
  return true;
}

// Flat faces that share a corner and lie in the plane of the piece's first face.
void FlatFaces::join_pieces(const fem::SurfaceMesh &surface) {
  std::vector<std::vector<int>> around(surface.vertices.size());
  for (std::size_t face = 0; face < faces_.size(); ++face)
    for (const int v : surface.faces[face])
      around[static_cast<std::size_t>(v)].push_back(static_cast<int>(face));
  piece_.assign(faces_.size(), -1);
  for (int first = 0; first < static_cast<int>(faces_.size()); ++first) {
    if (piece(first) >= 0) continue;
    piece_[static_cast<std::size_t>(first)] = first;
    const Face &seed = faces_[static_cast<std::size_t>(first)];
    if (!seed.flat) continue;
    const Vector3 origin = vertex_at(surface, surface.faces[static_cast<std::size_t>(first)][0]);
    const auto in_plane = [&](int face) {
      const Quad q = face_corners(surface, face, origin);
      return faces_[static_cast<std::size_t>(face)].flat &&
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

} // namespace platen::coupling
