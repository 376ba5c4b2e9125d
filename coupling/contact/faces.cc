#include "coupling/contact/faces.h"

#include <algorithm>
#include <cmath>

#include "coupling/contact/foot_of_face.h"
#include "coupling/contact/surface_search.h"

namespace platen::coupling {

namespace {

// Farther from a plane than this share of the face is not flat.
constexpr double flatness = 1e-14;

double size_of(const Quad &q) {
  return std::max(norm(q[2] - q[0]), norm(q[3] - q[1]));
}

using foot_search::rim;
constexpr double round_off = 1e-12; // of a face: a box holds it for certain

// Axes of the mean plane, the box and where a foot is single. False: no area.
bool set_mean_plane(const Quad &q, MovingFace &face) {
  const Vector3 across = cross(q[2] - q[0], q[3] - q[1]);
  const double area = norm(across);
  const Vector3 along = face.e + 0.5 * face.t;
  if (!(area > 0)) return false;
  face.normal = across / area;
  const Vector3 flat = along - dot(along, face.normal) * face.normal;
  const double length = norm(flat);
  if (!(length > 0)) return false;
  face.along = flat / length;
  face.across = cross(face.normal, face.along);
  return true;
}

void set_box(const Quad &q, MovingFace &face) {
  const Vector3 axes[3] = {face.along, face.across, face.normal};
  const double noise = round_off * (norm(face.e) + norm(face.f));
  face.middle = face.corner;
  for (int axis = 0; axis < 3; ++axis) {
    double low = 0, high = 0; // of the first corner
    for (std::size_t k = 1; k < 4; ++k) {
      const double at = dot(q[k] - q[0], axes[axis]);
      low = std::min(low, at);
      high = std::max(high, at);
    }
    face.middle += 0.5 * (low + high) * axes[axis];
    face.half[axis] = 0.5 * (high - low) + noise;
  }
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
  MovingFace face;
  face.corner = q[0];
  face.set_corners(q);
  if (!set_mean_plane(q, face)) {
    // Any axes hold for the box of a face without area.
    face.along = {1, 0, 0}, face.across = {0, 1, 0}, face.normal = {0, 0, 1};
    set_box(q, face);
    return face;
  }
  set_box(q, face);
  face.single_foot = single_foot_within(q, face.normal) - 2 * face.half.z;
  face.set_plane(face.normal);
  return face;
}

double least_distance_squared(const MovingFace &face, const Vector3 &centre) {
  const Vector3 r = centre - face.middle;
  const double a = std::max(0.0, std::abs(dot(r, face.along)) - face.half.x),
               b = std::max(0.0, std::abs(dot(r, face.across)) - face.half.y),
               c = std::max(0.0, std::abs(dot(r, face.normal)) - face.half.z);
  return a * a + b * b + c * c;
}

bool find_foot(const FlatFace &face, const Vector3 &centre, FlatFoot &foot) {
  const auto triple = dem::triple_of;
  const FlatMap<double> map{triple(face.e),      triple(face.f),    triple(face.t),
                            triple(face.linear), triple(face.free), triple(face.normal),
                            face.square,         face.constant,     face.flat};
  FootOnFlat<double> found;
  if (!search_flat_foot<dem::OfScalars>(map, dem::triple_of(centre), found)) return false;
  foot = {found.u, found.v, found.distance};
  return true;
}

bool find_foot(const MovingFace &face, const Vector3 &centre, Foot &foot) {
  const auto triple = dem::triple_of;
  const auto vector = dem::vector_of;
  const FaceMap<double> map{triple(face.e),    triple(face.f),      triple(face.t),      triple(face.linear),
                            triple(face.free), triple(face.corner), triple(face.normal), face.square,
                            face.constant,     face.single_foot};
  FootOnFace<double> found;
  if (!search_foot<dem::OfScalars>(map, triple(centre), found)) return false;
  foot = {found.u,
          found.v,
          vector(found.out),
          vector(found.along_u),
          vector(found.along_v),
          vector(found.normal)};
  return true;
}

} // namespace platen::coupling
