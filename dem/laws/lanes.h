// Functions, beyond arithmetic, for source that serves both one number and SIMD vectors: `How` of such
// templates. Truth is a bool here, and a mask of lanes for SIMD vectors (dem/kernels/lane_mask.inc.h).
#pragma once

#include <cmath>

#include "base/vector3.h"
#include "dem/laws/bond_form.h"

namespace platen::dem {

struct OfScalars {
  static bool above(double a, double b) { return a > b; }
  static bool at_least(double a, double b) { return a >= b; }
  static bool any(bool a) { return a; }
  static bool negated(bool a) { return !a; }
  static double choose(bool where, double a, double b) { return where ? a : b; }
  static double root(double a) { return std::sqrt(a); }
  static double magnitude(double a) { return std::abs(a); }
  static double with_sign(double size, double of) { return std::copysign(size, of); }
};

template <class How, class Truth, class Real>
PLATEN_INLINE Triple<Real> choose(const Truth &where, const Triple<Real> &a, const Triple<Real> &b) {
  return {How::choose(where, a.x, b.x), How::choose(where, a.y, b.y), How::choose(where, a.z, b.z)};
}
template <class How, class Real>
PLATEN_INLINE Real length(const Triple<Real> &a) {
  return How::root(dot(a, a));
}
template <class Real>
PLATEN_INLINE Triple<Real> no_vector() {
  return {Real(0.0), Real(0.0), Real(0.0)};
}

inline Triple<double> triple_of(const Vector3 &a) {
  return {a.x, a.y, a.z};
}
inline Vector3 vector_of(const Triple<double> &a) {
  return {a.x, a.y, a.z};
}

} // namespace platen::dem
