#include "coupling/contact/box_tree.h"

#include <algorithm>
#include <numeric>

namespace platen::coupling {

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
