#include "coupling/surface_search.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace platen::coupling {

using dem::cross;
using dem::dot;
using dem::norm;
using dem::norm_squared;
using dem::Vector3;
using fem::SurfaceMesh;

namespace {

// Distances are compared with this relative margin, so that round-off never drops the face that is closest.
constexpr double margin = 1e-9;

const std::array<int, 4> &corners_of(const SurfaceMesh &surface, int face) {
  return surface.faces[static_cast<std::size_t>(face)];
}

// Of the origin from the box around the corners: no point of the face is nearer.
double box_distance_squared(const Quad &q) {
  Box box{q[0], q[0]};
  for (std::size_t k = 1; k < 4; ++k)
    box.include(q[k]);
  return box.distance_squared({});
}

double largest_corner(const Quad &q) {
  return std::sqrt(
      std::max({norm_squared(q[0]), norm_squared(q[1]), norm_squared(q[2]), norm_squared(q[3])}));
}

} // namespace

Vector3 vertex_at(const SurfaceMesh &surface, int v) {
  const fem::Point &p = surface.vertices[static_cast<std::size_t>(v)];
  return {p[0], p[1], p[2]};
}

Quad face_corners(const SurfaceMesh &surface, int face, const Vector3 &origin) {
  const std::array<int, 4> &v = corners_of(surface, face);
  return {vertex_at(surface, v[0]) - origin, vertex_at(surface, v[1]) - origin,
          vertex_at(surface, v[2]) - origin, vertex_at(surface, v[3]) - origin};
}

SurfaceSearch::SurfaceSearch(const SurfaceMesh &surface, double skin)
    : skin_(skin), tree_(face_boxes(surface)), flat_(surface) {
  if (!(skin > 0)) throw std::invalid_argument("surface search: the skin must be positive");
  first_face_of_vertex_.assign(surface.vertices.size() + 1, 0);
  const auto count = [&](int v) -> int & { return first_face_of_vertex_[static_cast<std::size_t>(v) + 1]; };
  for (const auto &face : surface.faces)
    for (const int v : face)
      ++count(v);
  for (std::size_t v = 1; v < first_face_of_vertex_.size(); ++v)
    first_face_of_vertex_[v] += first_face_of_vertex_[v - 1];
  faces_of_vertex_.resize(static_cast<std::size_t>(first_face_of_vertex_.back()));
  std::vector<int> next(first_face_of_vertex_.begin(), first_face_of_vertex_.end() - 1);
  for (std::size_t f = 0; f < surface.faces.size(); ++f)
    for (const int v : surface.faces[f])
      faces_of_vertex_[static_cast<std::size_t>(next[static_cast<std::size_t>(v)]++)] = static_cast<int>(f);
}

std::vector<Box> SurfaceSearch::face_boxes(const SurfaceMesh &surface) const {
  std::vector<Box> boxes(surface.faces.size());
  for (std::size_t f = 0; f < boxes.size(); ++f) {
    boxes[f].low = boxes[f].high = vertex_at(surface, surface.faces[f][0]);
    for (const int v : surface.faces[f])
      boxes[f].include(vertex_at(surface, v));
  }
  return boxes;
}

void SurfaceSearch::rebuild(const SurfaceMesh &surface, const dem::Column<Vector3> &position,
                            const std::vector<double> &reach, const std::vector<int> &always) {
  ++lists_made_;
  tree_.refit(face_boxes(surface));
  particles_.clear();
  near_.clear();
  first_near_.assign(1, 0);
  auto next_always = always.begin();
  for (std::size_t row = 0; row < position.size(); ++row) {
    const bool listed = next_always != always.end() && *next_always == static_cast<int>(row);
    if (listed) ++next_always;
    collect(surface, position[row],
            listed ? std::numeric_limits<double>::infinity() : (reach[row] + skin_) * (1 + margin));
    if (near_.size() == first_near_.back()) continue;
    particles_.push_back(static_cast<int>(row));
    first_near_.push_back(near_.size());
  }
  travelled_ = 0;
}

// Appends the faces that may be closest to the centre until the next list, if the surface is within `limit`.
// While centre and surface move by no more than the skin relative to each other, the closest face stays
// within distance + skin, and a face farther than distance + 2 skin now cannot come closer than that.
void SurfaceSearch::collect(const SurfaceMesh &surface, const Vector3 &centre, double limit) {
  double best_squared = limit * limit;
  bool found = false;
  tree_.near(centre, best_squared, [&](int face) {
    const double d = closest_point(face_corners(surface, face, centre)).distance_squared;
    if (d > best_squared) return;
    best_squared = d;
    found = true;
  });
  if (!found) return;
  const double reach = (std::sqrt(best_squared) + 2 * skin_) * (1 + margin);
  double reach_squared = reach * reach;
  const std::size_t first = near_.size();
  tree_.near(centre, reach_squared, [&](int face) {
    const double d = closest_point(face_corners(surface, face, centre)).distance_squared;
    if (d <= reach_squared) near_.push_back({std::sqrt(d), face});
  });
  std::sort(near_.begin() + static_cast<std::ptrdiff_t>(first), near_.end(),
            [](const NearFace &a, const NearFace &b) {
              return a.distance != b.distance ? a.distance < b.distance : a.face < b.face;
            });
}

// The foot on a flat face of a surface that has not turned since the search was set up.
bool SurfaceSearch::foot(const SurfaceMesh &surface, int face, const Vector3 &centre,
                         SurfacePoint &result) const {
  if (!surface.only_shifted) return false;
  if (!flat_.foot(face, centre - vertex_at(surface, corners_of(surface, face)[0]), result.local,
                  result.normal, result.distance))
    return false;
  result.face = face;
  return true;
}

// The same, where it is sure to be the closest point of all: every other face listed lies in the same plane
// or farther away. False says nothing.
bool SurfaceSearch::foot_of_nearest(const SurfaceMesh &surface, std::size_t k, const Vector3 &centre,
                                    SurfacePoint &result) const {
  const std::size_t last = first_near_[k + 1];
  std::size_t n = first_near_[k];
  while (n < last && !foot(surface, near_[n].face, centre, result))
    ++n;
  if (n == last) return false;
  const double distance = std::abs(result.distance) * (1 + margin);
  const int piece = flat_.piece(result.face);
  for (std::size_t other = first_near_[k]; other < last; ++other) {
    if (near_[other].distance - travelled_ > distance) break;
    if (flat_.piece(near_[other].face) != piece) return false;
  }
  return true;
}

SurfacePoint SurfaceSearch::closest(const SurfaceMesh &surface, std::size_t k, const Vector3 &centre) const {
  SurfacePoint point;
  if (foot_of_nearest(surface, k, centre, point)) return point;
  ClosestPoint best;
  best.distance_squared = std::numeric_limits<double>::infinity();
  double best_distance = best.distance_squared;
  int best_face = -1;
  for (std::size_t n = first_near_[k]; n < first_near_[k + 1]; ++n) {
    const NearFace &candidate = near_[n];
    if (candidate.distance - travelled_ > best_distance * (1 + margin)) break;
    const Quad corners = face_corners(surface, candidate.face, centre);
    if (box_distance_squared(corners) > best.distance_squared * (1 + margin)) continue;
    const ClosestPoint c = closest_point(corners);
    if (preference(c) > preference(best)) continue;
    if (preference(c) == preference(best) && candidate.face > best_face) continue;
    best = c;
    best_distance = std::sqrt(c.distance_squared);
    best_face = candidate.face;
  }
  point = with_normal(surface, best_face, best, centre);
  return point;
}

SurfacePoint SurfaceSearch::closest_of_all(const SurfaceMesh &surface, const Vector3 &centre) const {
  ClosestPoint best;
  best.distance_squared = std::numeric_limits<double>::infinity();
  int best_face = -1;
  for (int face = 0; face < static_cast<int>(surface.faces.size()); ++face) {
    const ClosestPoint c = closest_point(face_corners(surface, face, centre));
    if (preference(c) >= preference(best)) continue;
    best = c;
    best_face = face;
  }
  return with_normal(surface, best_face, best, centre);
}

// Inside or outside: on a face its normal tells; on an edge or vertex the sum of the normals around it,
// weighted by angle, does for any closed surface (Baerentzen and Aanaes 2005).
SurfacePoint SurfaceSearch::with_normal(const SurfaceMesh &surface, int face, const ClosestPoint &local,
                                        const Vector3 &centre) const {
  SurfacePoint s;
  // The same formula as the short way of closest(), so that the way does not show in a single bit.
  if (local.feature == Feature::face && foot(surface, face, centre, s)) return s;
  s.face = face;
  s.local = local;
  const Vector3 out = -local.point;
  const Quad corners = face_corners(surface, face, centre);
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
  // round-off of the corners; there, and where the centre lies on the surface, the normal itself is taken.
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
  const double along = local.weights[(k + 1) % 4]; // share of b
  const double corner_u[4] = {0, 1, 1, 0}, corner_v[4] = {0, 0, 1, 1};
  Vector3 sum;
  for (int n = first_face_of_vertex_[static_cast<std::size_t>(a)];
       n < first_face_of_vertex_[static_cast<std::size_t>(a) + 1]; ++n) {
    const int other = faces_of_vertex_[static_cast<std::size_t>(n)];
    if (n > first_face_of_vertex_[static_cast<std::size_t>(a)] &&
        other == faces_of_vertex_[static_cast<std::size_t>(n - 1)])
      continue; // a triangle, written as a quad with one corner twice
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
  for (int n = first_face_of_vertex_[v]; n < first_face_of_vertex_[v + 1]; ++n) {
    const int other = faces_of_vertex_[static_cast<std::size_t>(n)];
    if (n > first_face_of_vertex_[v] && other == faces_of_vertex_[static_cast<std::size_t>(n - 1)]) continue;
    const std::array<int, 4> &ring = corners_of(surface, other);
    const Quad q = face_corners(surface, other, centre);
    for (std::size_t i = 0; i < 4; ++i) {
      if (static_cast<std::size_t>(ring[i]) != v) continue;
      const Vector3 next = q[(i + 1) % 4] - q[i], last = q[(i + 3) % 4] - q[i], normal = cross(next, last);
      const double size = norm(normal);
      if (size > 0) sum += (std::atan2(size, dot(next, last)) / size) * normal;
    }
  }
  const double size = norm(sum);
  return size > 0 ? sum / size : Vector3{};
}

} // namespace platen::coupling
