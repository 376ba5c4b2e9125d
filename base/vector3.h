// Vectors in space and rotations, for particles and bodies: plain values without a library, because the force
// kernels are compiled for several instruction sets (bench/results/vectors.md).
#pragma once

#include <array>
#include <cmath>

#include "base/block_type.h"
#include "base/portable.h"

namespace platen {

struct Vector3 {
  double x = 0, y = 0, z = 0;

  double &operator[](int k) { return k == 0 ? x : (k == 1 ? y : z); }
  double operator[](int k) const { return k == 0 ? x : (k == 1 ? y : z); }
  Vector3 &operator+=(const Vector3 &b) {
    x += b.x, y += b.y, z += b.z;
    return *this;
  }
  Vector3 &operator-=(const Vector3 &b) {
    x -= b.x, y -= b.y, z -= b.z;
    return *this;
  }
  Vector3 &operator*=(double s) {
    x *= s, y *= s, z *= s;
    return *this;
  }
};

inline Vector3 operator+(const Vector3 &a, const Vector3 &b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline Vector3 operator-(const Vector3 &a, const Vector3 &b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline Vector3 operator-(const Vector3 &a) {
  return {-a.x, -a.y, -a.z};
}
inline Vector3 operator*(double s, const Vector3 &a) {
  return {s * a.x, s * a.y, s * a.z};
}
inline Vector3 operator*(const Vector3 &a, double s) {
  return s * a;
}
inline Vector3 operator/(const Vector3 &a, double s) {
  return {a.x / s, a.y / s, a.z / s};
}
inline bool operator==(const Vector3 &a, const Vector3 &b) {
  return a.x == b.x && a.y == b.y && a.z == b.z;
}
inline bool operator!=(const Vector3 &a, const Vector3 &b) {
  return !(a == b);
}
inline double dot(const Vector3 &a, const Vector3 &b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline Vector3 cross(const Vector3 &a, const Vector3 &b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double norm_squared(const Vector3 &a) {
  return dot(a, a);
}
inline double norm(const Vector3 &a) {
  return std::sqrt(dot(a, a));
}

// Row by row.
using Matrix3 = std::array<double, 9>;

inline Vector3 operator*(const Matrix3 &a, const Vector3 &v) {
  return {a[0] * v.x + a[1] * v.y + a[2] * v.z, a[3] * v.x + a[4] * v.y + a[5] * v.z,
          a[6] * v.x + a[7] * v.y + a[8] * v.z};
}

// Unit quaternion w + x i + y j + z k; turns reference axes into current ones: v = rotate(q, v_reference).
struct Quaternion {
  double w = 1, x = 0, y = 0, z = 0;
};

inline Quaternion operator*(const Quaternion &a, const Quaternion &b) {
  return {a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z, a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
          a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x, a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w};
}
inline Quaternion conjugate(const Quaternion &q) {
  return {q.w, -q.x, -q.y, -q.z};
}
inline Vector3 vector_part(const Quaternion &q) {
  return {q.x, q.y, q.z};
}
inline Quaternion normalised(const Quaternion &q) {
  const double s = 1.0 / std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
  return {s * q.w, s * q.x, s * q.y, s * q.z};
}
inline Vector3 rotate(const Quaternion &q, const Vector3 &v) {
  const Vector3 u = vector_part(q), t = 2.0 * cross(u, v);
  return v + q.w * t + cross(u, t);
}
inline bool is_identity(const Quaternion &q) {
  return q.x == 0 && q.y == 0 && q.z == 0;
}
// Rotation by the vector phi (axis times angle, rad).
inline Quaternion rotation_quaternion(const Vector3 &phi) {
  const double angle = norm(phi);
  if (angle < 1e-12) return normalised({1.0, 0.5 * phi.x, 0.5 * phi.y, 0.5 * phi.z});
  const double s = portable::sin(0.5 * angle) / angle;
  return {portable::cos(0.5 * angle), s * phi.x, s * phi.y, s * phi.z};
}

template <>
struct NumbersOf<Vector3> {
  using Number = double;
};
template <>
struct NumbersOf<Quaternion> {
  using Number = double;
};

} // namespace platen
