#include "fem/rotor.h"

#include <algorithm>
#include <cmath>

#include "base/portable.h"

namespace platen::fem {

Matrix3 inverse(const Matrix3 &a) {
  const Vector3 x = {a[0], a[1], a[2]}, y = {a[3], a[4], a[5]}, z = {a[6], a[7], a[8]};
  const Vector3 yz = cross(y, z), zx = cross(z, x), xy = cross(x, y);
  const double s = 1 / dot(x, yz);
  return {s * yz[0], s * zx[0], s * xy[0], s * yz[1], s * zx[1], s * xy[1], s * yz[2], s * zx[2], s * xy[2]};
}

Matrix3 operator*(const Matrix3 &a, const Matrix3 &b) {
  Matrix3 product{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      for (std::size_t k = 0; k < 3; ++k)
        product[3 * i + j] += a[3 * i + k] * b[3 * k + j];
  return product;
}

void add_about_origin(Matrix3 &sum, double weight, const Vector3 &r) {
  for (std::size_t a = 0; a < 3; ++a)
    for (std::size_t b = 0; b < 3; ++b)
      sum[3 * a + b] += weight * ((a == b ? dot(r, r) : 0.0) - r[a] * r[b]);
}

// With x = m + y, m the mean of the roots: y^3 - 3 q y - 2 r = 0, whose largest root is
// 2 sqrt(q) cos(acos(r / q^(3/2)) / 3).
double largest_eigenvalue(const Matrix3 &a) {
  const double m = (a[0] + a[4] + a[8]) / 3;
  Matrix3 b = a;
  for (const std::size_t k : {0, 4, 8})
    b[k] -= m;
  const Matrix3 square = b * b;
  const double q = (square[0] + square[4] + square[8]) / 6;
  if (!(q > 0)) return m;
  const Vector3 x = {b[0], b[1], b[2]}, y = {b[3], b[4], b[5]}, z = {b[6], b[7], b[8]};
  const double r = 0.5 * dot(x, cross(y, z));
  return m +
         2 * std::sqrt(q) * portable::cos(portable::acos(std::clamp(r / (q * std::sqrt(q)), -1.0, 1.0)) / 3);
}

} // namespace platen::fem
