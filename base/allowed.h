// Allowed numbers of a block of a state: defined once next to the column or the member, checked for every
// state before it is read.
#pragma once

#include <cmath>
#include <cstddef>
#include <string>

#include "base/range.h"

namespace platen {

// By default: finite numbers.
struct Allowed {
  // Norm of the numbers of a row: a unit vector or quaternion; one_or_none: or all 0 where there is none yet.
  enum class Length { any, one, one_or_none };
  // The length of a unit row differs from 1 by rounding, some 1e-16; a row that differs by more was damaged.
  static constexpr double length_tolerance = 1e-9;
  // Squares and cubes of larger numbers are not finite, nor are the values computed from them: no length,
  // force or energy of a test comes near this limit.
  static constexpr double largest = 1e100;

  Allowed() = default;
  Allowed(const Range &each) : range(each) {} // no explicit: column("mass", "kg", above(0))

  Range range;
  bool nan_too = false; // for values not measured, or not yet
  bool infinite_too = false;
  Length length = Length::any;

  bool holds(double value) const {
    if (std::isnan(value)) return nan_too;
    return (infinite_too || std::abs(value) <= largest) && range.holds(value);
  }
  bool holds_length(double norm) const {
    return length == Length::any || std::abs(norm - 1) <= length_tolerance ||
           (length == Length::one_or_none && norm == 0);
  }
};

inline Allowed or_nan(const Range &range = {}) {
  Allowed allowed(range);
  allowed.nan_too = true;
  return allowed;
}
inline Allowed or_infinite(const Range &range) {
  Allowed allowed(range);
  allowed.infinite_too = true;
  return allowed;
}
// For measured values that have no effect on the run.
inline Allowed any_value() {
  Allowed allowed = or_nan();
  allowed.infinite_too = true;
  return allowed;
}
inline Allowed unit_length() {
  Allowed allowed;
  allowed.length = Allowed::Length::one;
  return allowed;
}
inline Allowed unit_length_or_zero() {
  Allowed allowed;
  allowed.length = Allowed::Length::one_or_none;
  return allowed;
}
// Row number in a table of `rows` rows.
inline Allowed row_of(std::size_t rows) {
  return between(0, static_cast<double>(rows) - 1);
}
inline Allowed flag() {
  return between(0, 1);
}

} // namespace platen
