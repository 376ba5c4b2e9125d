// Points and small vectors of the finite-element side: plain arrays, so that no header of a body needs
// deal.II.
#pragma once

#include <array>
#include <cmath>

namespace platen::fem {

using Point = std::array<double, 3>;

inline Point operator+(const Point &a, const Point &b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
inline Point operator-(const Point &a, const Point &b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline Point operator*(double s, const Point &a) {
  return {s * a[0], s * a[1], s * a[2]};
}
inline double dot(const Point &a, const Point &b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline Point cross(const Point &a, const Point &b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline double norm(const Point &a) {
  return std::sqrt(dot(a, a));
}

} // namespace platen::fem
