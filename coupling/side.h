// The six sides of a specimen that a platen may press.
#pragma once

#include <array>
#include <cstddef>

#include "base/vector3.h"
#include "dem/packing/specimen.h"

namespace platen::coupling {

// Low and high along z, x and y.
enum class Side { bottom, top, left, right, front, back };

constexpr std::size_t side_count = 6;
constexpr std::array<Side, side_count> all_sides{Side::bottom, Side::top,   Side::left,
                                                 Side::right,  Side::front, Side::back};

constexpr const char *name_of(Side side) {
  constexpr std::array<const char *, side_count> names{"bottom", "top", "left", "right", "front", "back"};
  return names[static_cast<std::size_t>(side)];
}

// Axis of its normal: 0 x, 1 y, 2 z.
constexpr int axis_of(Side side) {
  constexpr std::array<int, 3> axes{2, 0, 1};
  return axes[static_cast<std::size_t>(side) / 2];
}

constexpr bool is_high(Side side) {
  return static_cast<std::size_t>(side) % 2 == 1;
}

constexpr Side opposite(Side side) {
  return static_cast<Side>(static_cast<std::size_t>(side) ^ 1);
}

constexpr Side low_side(int axis) {
  return axis == 0 ? Side::left : axis == 1 ? Side::front : Side::bottom;
}

// Unit vector into the specimen.
inline Vector3 inward(Side side) {
  Vector3 n{};
  n[axis_of(side)] = is_high(side) ? -1 : 1;
  return n;
}

// Global components of a vector whose z is along the side's axis: x, y, z permuted in a cycle.
inline Vector3 from_upright(Side side, const Vector3 &v) {
  const int axis = axis_of(side);
  Vector3 global{};
  for (const int k : {0, 1, 2})
    global[(axis + 1 + k) % 3] = v[k];
  return global;
}
// The inverse.
inline Vector3 to_upright(Side side, const Vector3 &global) {
  const int axis = axis_of(side);
  return {global[(axis + 1) % 3], global[(axis + 2) % 3], global[axis]};
}

// m, low and high ends of a specimen along an axis.
inline std::array<double, 2> extent(const dem::Shape &shape, int axis) {
  if (axis == 2) return {0, shape.height};
  const double half = 0.5 * (axis == 0 ? shape.width_x : shape.width_y);
  return {-half, half};
}
inline double length(const dem::Shape &shape, int axis) {
  return axis == 2 ? shape.height : (axis == 0 ? shape.width_x : shape.width_y);
}

// m^2, face of a box normal to an axis.
inline double face_area(const dem::Shape &shape, int axis) {
  return length(shape, (axis + 1) % 3) * length(shape, (axis + 2) % 3);
}

} // namespace platen::coupling
