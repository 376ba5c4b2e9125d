// A tree of boxes around the faces of a surface: finds the faces near a point without looking at all of them.
#pragma once

#include <vector>

#include "base/vector3.h"

namespace platen::coupling {

struct Box {
  Vector3 low, high; // m

  void include(const Vector3 &p);
  void include(const Box &b);
  double distance_squared(const Vector3 &p) const; // m^2, zero inside
};

class BoxTree {
public:
  // Splits by the median of the longest side. O(n log n).
  explicit BoxTree(const std::vector<Box> &boxes);
  // The same tree around boxes that have moved. O(n).
  void refit(const std::vector<Box> &boxes);

  // visit(index) for every box, nearest halves first, that is not farther from the point than `limit` (m^2)
  // allows when its turn comes; visit may lower the limit that it was given by reference.
  template <class Visit>
  void near(const Vector3 &point, double &limit_squared, const Visit &visit) const {
    if (!nodes_.empty()) descend(0, point, limit_squared, visit);
  }

private:
  struct Node {
    Box box;
    int left = -1, right = -1; // nodes; a leaf has none
    int item = -1;             // of a leaf
  };
  int build(const std::vector<Box> &boxes, std::vector<int> &items, std::size_t first, std::size_t last);
  template <class Visit>
  void descend(int index, const Vector3 &point, double &limit_squared, const Visit &visit) const {
    const Node &node = nodes_[static_cast<std::size_t>(index)];
    if (node.box.distance_squared(point) > limit_squared) return;
    if (node.item >= 0) return visit(node.item);
    int near_side = node.left, far_side = node.right;
    if (nodes_[static_cast<std::size_t>(far_side)].box.distance_squared(point) <
        nodes_[static_cast<std::size_t>(near_side)].box.distance_squared(point))
      std::swap(near_side, far_side);
    descend(near_side, point, limit_squared, visit);
    descend(far_side, point, limit_squared, visit);
  }

  std::vector<Node> nodes_; // parents before children
};

} // namespace platen::coupling
