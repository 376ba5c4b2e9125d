// Carries a vector that lives in a contact plane (a tangential spring, a rolling moment) along with the
// plane.
#pragma once

#include "base/vector3.h"

namespace platen::dem {

// The vector after the smallest rotation that takes unit normal `from` to unit normal `to` (Rodrigues'
// formula in the form without angle). The result lies in the plane of `to` and has the length of the vector's
// part in the old plane, both to round-off, so that history neither leaks nor grows over millions of turns.
inline Vector3 carry_with_plane(const Vector3 &vector, const Vector3 &from, const Vector3 &to) {
  const Vector3 flat = vector - dot(vector, from) * from;
  if (from.x == to.x && from.y == to.y && from.z == to.z) return flat;
  const Vector3 axis = cross(from, to);
  const double cosine = dot(from, to);
  // Normals that point against each other have no smallest rotation: the vector is kept where it is.
  constexpr double opposite = -1.0 + 1e-12;
  Vector3 turned = flat;
  if (cosine > opposite)
    turned = cosine * flat + cross(axis, flat) + (dot(axis, flat) / (1.0 + cosine)) * axis;
  turned -= dot(turned, to) * to;
  const double length = norm(turned);
  return length > 0 ? (norm(flat) / length) * turned : Vector3{};
}

// The vector after the plane has spun about its unit normal by `angle` (rad); exact for any angle. For those
// of a step the first terms of the series are the functions to the last bit.
inline Vector3 spin_in_plane(const Vector3 &vector, const Vector3 &normal, double angle) {
  if (angle == 0) return vector;
  constexpr double of_a_step = 1e-4;
  if (std::abs(angle) < of_a_step) {
    const double square = angle * angle;
    return (1 - 0.5 * square) * vector + (angle * (1 - square / 6)) * cross(normal, vector);
  }
  return std::cos(angle) * vector + std::sin(angle) * cross(normal, vector);
}

} // namespace platen::dem
