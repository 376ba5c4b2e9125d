// A number and its derivative, for exact tangents of the laws.
#pragma once

#include <cmath>

namespace platen::dem::examples {

struct Dual {
  double value = 0, slope = 0;
  Dual() = default;
  Dual(double v, double s = 0) : value(v), slope(s) {} // numbers are constants
};
inline Dual operator+(const Dual &a, const Dual &b) {
  return {a.value + b.value, a.slope + b.slope};
}
inline Dual operator-(const Dual &a, const Dual &b) {
  return {a.value - b.value, a.slope - b.slope};
}
inline Dual operator*(const Dual &a, const Dual &b) {
  return {a.value * b.value, a.slope * b.value + a.value * b.slope};
}
inline Dual operator/(const Dual &a, const Dual &b) {
  return {a.value / b.value, (a.slope * b.value - a.value * b.slope) / (b.value * b.value)};
}
// At zero only where nothing depends on the slope there.
inline Dual root(const Dual &a) {
  const double r = std::sqrt(a.value);
  return {r, r > 0 ? 0.5 * a.slope / r : 0};
}
inline Dual magnitude(const Dual &a) {
  return a.value < 0 ? Dual(0) - a : a;
}
inline Dual larger(const Dual &a, const Dual &b) {
  return a.value > b.value ? a : b;
}

} // namespace platen::dem::examples
