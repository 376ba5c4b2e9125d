// Rotations as unit quaternions (w, x, y, z) from reference axes to current ones.
#pragma once

#include <array>
#include <cmath>

#include "fem/point.h"

namespace platen::fem {

using Quaternion = std::array<double, 4>;

inline Quaternion product(const Quaternion &a, const Quaternion &b) {
  return {a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3],
          a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
          a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1],
          a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0]};
}

inline Quaternion normalised(const Quaternion &q) {
  const double s = 1.0 / std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  return {s * q[0], s * q[1], s * q[2], s * q[3]};
}

inline Quaternion inverse(const Quaternion &q) {
  return {q[0], -q[1], -q[2], -q[3]};
}

// Rotation by the vector phi (axis times angle, rad).
inline Quaternion exponential(const Point &phi) {
  const double angle = norm(phi);
  const double s = angle < 1e-12 ? 0.5 : std::sin(0.5 * angle) / angle;
  return normalised({std::cos(0.5 * angle), s * phi[0], s * phi[1], s * phi[2]});
}

inline Point rotated(const Quaternion &q, const Point &v) {
  const Point u = {q[1], q[2], q[3]}, t = 2.0 * cross(u, v);
  return v + q[0] * t + cross(u, t);
}

inline bool is_identity(const Quaternion &q) {
  return q[1] == 0 && q[2] == 0 && q[3] == 0;
}

} // namespace platen::fem
