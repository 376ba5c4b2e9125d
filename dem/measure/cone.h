// A circular cone, with which dead zones are compared.
#pragma once

#include <cmath>

#include "base/vector3.h"

namespace platen::dem {

// A cone on the plane z = 0 with its apex above.
struct Cone {
  Vector3 apex;           // m
  Vector3 axis{0, 0, -1}; // 1, from the apex towards the base
  double half_angle = 0;  // rad, axis to flank

  // m, distance to the flank of the unbounded cone, positive outside; also valid beyond the apex.
  double distance(const Vector3 &point) const {
    const Vector3 w = point - apex;
    const double depth = dot(w, axis);
    return norm(w - depth * axis) * std::cos(half_angle) - depth * std::sin(half_angle);
  }
};

} // namespace platen::dem
