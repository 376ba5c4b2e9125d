#include "coupling/contact/surface_search.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "base/parallel.h"

namespace platen::coupling {

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

} // namespace

const Vector3 &vertex_at(const SurfaceMesh &surface, int v) {
  return surface.vertices[static_cast<std::size_t>(v)];
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

void SurfaceSearch::rebuild(const SurfaceMesh &surface, const Column<Vector3> &position,
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
  near_faces_.clear();
  for (const NearFace &near : near_)
    near_faces_.push_back(near.face);
  std::sort(near_faces_.begin(), near_faces_.end());
  near_faces_.erase(std::unique(near_faces_.begin(), near_faces_.end()), near_faces_.end());
  travelled_ = 0;
  looked_ = false;
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

void SurfaceSearch::look(const SurfaceMesh &surface) {
  if (surface.only_shifted || looked_) return;
  moving_.resize(surface.faces.size());
  constexpr std::size_t faces_per_part = 32;
  for_each(
      near_faces_.size(),
      [&](std::size_t k) {
        const int face = near_faces_[k];
        moving_[static_cast<std::size_t>(face)] = moving_face(face_corners(surface, face, {}));
      },
      faces_per_part);
  looked_ = true;
}

bool SurfaceSearch::nearest_on(const SurfaceMesh &surface, int face, const Vector3 &centre,
                               const MovingFace *moving, SurfacePoint &nearest) const {
  nearest.face = face;
  Foot foot;
  if (moving == nullptr || !find_foot(*moving, centre, foot)) {
    nearest.local = closest_point(face_corners(surface, face, centre));
    return false;
  }
  ClosestPoint &local = nearest.local;
  local.point = -foot.out;
  local.weights = bilinear_weights(foot.u, foot.v);
  local.u = foot.u;
  local.v = foot.v;
  local.distance_squared = norm_squared(foot.out);
  local.feature = Feature::face;
  local.local = 0;
  nearest.normal = foot.normal;
  nearest.distance = dot(foot.out, foot.normal);
  nearest.along_u = foot.along_u;
  nearest.along_v = foot.along_v;
  return true;
}

SurfacePoint SurfaceSearch::closest(const SurfaceMesh &surface, std::size_t k, const Vector3 &centre) const {
  SurfacePoint point;
  if (surface.only_shifted && foot_of_nearest(surface, k, centre, point)) return point;
  return closest_listed(surface, k, centre);
}

SurfacePoint SurfaceSearch::closest_listed(const SurfaceMesh &surface, std::size_t k,
                                           const Vector3 &centre) const {
  SurfacePoint best, found;
  best.local.distance_squared = std::numeric_limits<double>::infinity();
  double best_distance = best.local.distance_squared;
  bool whole = false;
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
    const bool found_whole = nearest_on(surface, face, centre, moving, found);
    if (preference(found.local) > preference(best.local)) continue;
    if (preference(found.local) == preference(best.local) && face > best.face) continue;
    best = found;
    whole = found_whole;
    best_distance = std::sqrt(found.local.distance_squared);
  }
  return whole ? best : with_normal(surface, best.face, best.local, centre);
}

SurfacePoint SurfaceSearch::closest_of_all(const SurfaceMesh &surface, const Vector3 &centre) const {
  SurfacePoint best, found;
  best.local.distance_squared = std::numeric_limits<double>::infinity();
  bool whole = false;
  for (int face = 0; face < static_cast<int>(surface.faces.size()); ++face) {
    const MovingFace moving =
        surface.only_shifted ? MovingFace{} : moving_face(face_corners(surface, face, {}));
    const bool found_whole =
        nearest_on(surface, face, centre, surface.only_shifted ? nullptr : &moving, found);
    if (!(preference(found.local) < preference(best.local))) continue;
    best = found;
    whole = found_whole;
  }
  return whole ? best : with_normal(surface, best.face, best.local, centre);
}

} // namespace platen::coupling
