// The list of particles near a surface, by a tree of boxes around its faces.
#include "coupling/contact/surface_search.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "base/parallel.h"

namespace platen::coupling {

using fem::SurfaceMesh;

const Vector3 &vertex_at(const SurfaceMesh &surface, int v) {
  return surface.vertices[static_cast<std::size_t>(v)];
}

Quad face_corners(const SurfaceMesh &surface, int face, const Vector3 &origin) {
  const std::array<int, 4> &v = surface.faces[static_cast<std::size_t>(face)];
  return {vertex_at(surface, v[0]) - origin, vertex_at(surface, v[1]) - origin,
          vertex_at(surface, v[2]) - origin, vertex_at(surface, v[3]) - origin};
}

SurfaceSearch::SurfaceSearch(const SurfaceMesh &surface, double skin, dem::InstructionSet instruction_set)
    : skin_(skin),
      find_closest_points_(kernels::find_closest_points(instruction_set)),
      find_flat_closest_points_(kernels::find_flat_closest_points(instruction_set)),
      set_faces_(kernels::set_faces(instruction_set)),
      tree_(face_boxes(surface)),
      flat_(surface),
      faces_of_vertex_(fem::faces_of_vertices(surface)) {
  if (!(skin > 0)) throw std::invalid_argument("surface search: the skin must be positive");
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

void SurfaceSearch::update(const SurfaceMesh &surface) {
  if (surface.only_shifted || looked_) return;
  moving_.resize(surface.faces.size());
  constexpr std::size_t faces_per_part = 32;
  for_each_block(
      near_faces_.size(),
      [&](std::size_t first, std::size_t last, std::size_t) {
        set_faces_(surface.vertices.data(), surface.faces[0].data(), &near_faces_[first], last - first,
                   moving_.data());
      },
      faces_per_part);
  looked_ = true;
}

void Box::include(const Vector3 &p) {
  for (int k = 0; k < 3; ++k) {
    low[k] = std::min(low[k], p[k]);
    high[k] = std::max(high[k], p[k]);
  }
}

void Box::include(const Box &b) {
  include(b.low);
  include(b.high);
}

double Box::distance_squared(const Vector3 &p) const {
  double sum = 0;
  for (int k = 0; k < 3; ++k) {
    const double outside = std::max({low[k] - p[k], 0.0, p[k] - high[k]});
    sum += outside * outside;
  }
  return sum;
}

BoxTree::BoxTree(const std::vector<Box> &boxes) {
  if (boxes.empty()) return;
  std::vector<int> items(boxes.size());
  std::iota(items.begin(), items.end(), 0);
  nodes_.reserve(2 * boxes.size());
  build(boxes, items, 0, items.size());
}

int BoxTree::build(const std::vector<Box> &boxes, std::vector<int> &items, std::size_t first,
                   std::size_t last) {
  const auto box_of = [&](std::size_t k) -> const Box & { return boxes[static_cast<std::size_t>(items[k])]; };
  Node node;
  node.box = box_of(first);
  for (std::size_t k = first; k < last; ++k)
    node.box.include(box_of(k));
  const std::size_t index = nodes_.size();
  if (last - first == 1) node.item = items[first];
  nodes_.push_back(node);
  if (node.item >= 0) return static_cast<int>(index);

  const Vector3 side = node.box.high - node.box.low;
  const int axis = side.x >= side.y && side.x >= side.z ? 0 : (side.y >= side.z ? 1 : 2);
  const std::size_t middle = (first + last) / 2;
  const auto at = [&](std::size_t k) { return items.begin() + static_cast<std::ptrdiff_t>(k); };
  std::nth_element(at(first), at(middle), at(last), [&](int a, int b) {
    const Box &p = boxes[static_cast<std::size_t>(a)], &q = boxes[static_cast<std::size_t>(b)];
    const double pa = p.low[axis] + p.high[axis], qb = q.low[axis] + q.high[axis];
    return pa != qb ? pa < qb : a < b;
  });
  const int left = build(boxes, items, first, middle), right = build(boxes, items, middle, last);
  nodes_[index].left = left;
  nodes_[index].right = right;
  return static_cast<int>(index);
}

void BoxTree::refit(const std::vector<Box> &boxes) {
  for (std::size_t k = nodes_.size(); k-- > 0;) {
    Node &node = nodes_[k];
    if (node.item >= 0) {
      node.box = boxes[static_cast<std::size_t>(node.item)];
    } else {
      node.box = nodes_[static_cast<std::size_t>(node.left)].box;
      node.box.include(nodes_[static_cast<std::size_t>(node.right)].box);
    }
  }
}

} // namespace platen::coupling
