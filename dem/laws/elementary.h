// Elementary functions of numbers and of SIMD vectors alike, by the four operations and roots alone: for laws
// whose loops need them. Relative errors below 1e-14.
#pragma once

#include <array>

#include "base/pi.h"
#include "dem/laws/bond_form.h"

namespace platen::dem {

// c[0] + c[1] x + ...
template <class Real, std::size_t count>
PLATEN_INLINE Real polynomial(const std::array<double, count> &c, const Real &x) {
  Real sum = x * 0.0 + c[count - 1];
  for (std::size_t k = count - 1; k > 0; --k)
    sum = sum * x + c[k - 1];
  return sum;
}

// 1 - exp(-y), y >= 0; from 32 on as at 32. By the series of y/128, and g(2y) = g (2 - g).
template <class Real>
PLATEN_INLINE Real saturation(const Real &y) {
  constexpr int doublings = 7;
  constexpr double most = 32;
  static constexpr std::array<double, 12> series{
      1,          -1.0 / 2,     1.0 / 6,      -1.0 / 24,      1.0 / 120,      -1.0 / 720,
      1.0 / 5040, -1.0 / 40320, 1.0 / 362880, -1.0 / 3628800, 1.0 / 39916800, -1.0 / 479001600};
  const Real bounded = where_positive(Real(y - most), Real(y * 0.0 + most), y);
  const Real part = bounded * (1.0 / (1 << doublings));
  Real g = part * polynomial(series, part);
  for (int k = 0; k < doublings; ++k)
    g = g * (2.0 - g);
  return g;
}

// Angle of (x, y) over a right angle, x and y >= 0 and not both 0. By the series of an eighth of the angle.
template <class Real>
PLATEN_INLINE Real fraction_of_right_angle(const Real &y, const Real &x) {
  static constexpr std::array<double, 12> series{1,        -1.0 / 3,  1.0 / 5,  -1.0 / 7,
                                                 1.0 / 9,  -1.0 / 11, 1.0 / 13, -1.0 / 15,
                                                 1.0 / 17, -1.0 / 19, 1.0 / 21, -1.0 / 23};
  const Real half = y / (x + root(x * x + y * y)); // tangents
  const Real quarter = half / (1.0 + root(1.0 + half * half));
  const Real eighth = quarter / (1.0 + root(1.0 + quarter * quarter));
  return (16 / pi) * eighth * polynomial(series, Real(eighth * eighth));
}

// x^n, 0 <= x <= 1, n >= 0; below 1e-12 as there. By the series of the logarithm of the 64th root.
template <class Real>
PLATEN_INLINE Real power_of_fraction(const Real &x, double n) {
  static constexpr std::array<double, 12> series{1,        1.0 / 3,  1.0 / 5,  1.0 / 7,  1.0 / 9,  1.0 / 11,
                                                 1.0 / 13, 1.0 / 15, 1.0 / 17, 1.0 / 19, 1.0 / 21, 1.0 / 23};
  Real z = larger(x, Real(x * 0.0 + 1e-12));
  for (int k = 0; k < 6; ++k)
    z = root(z);
  const Real w = (1.0 - z) / (1.0 + z);
  return 1.0 - saturation(Real((128 * n) * w * polynomial(series, Real(w * w))));
}

} // namespace platen::dem
