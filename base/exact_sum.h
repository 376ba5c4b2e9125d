// A sum of doubles without rounding, so that it does not depend on the order of its parts: parts of threads,
// of blocks and of ranks may be added in any order.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "base/archive.h"

namespace platen {

// Stored as one long integer in units of the smallest double, in limbs of 32 bits; a limb may temporarily
// hold more, and carries are done now and then. Any doubles may be added, 2^40 of the largest and more.
class ExactSum {
public:
  // 2098 bits hold every double; the rest is reserve for sums.
  static constexpr std::size_t limbs = 68;
  using Limbs = std::array<std::int64_t, limbs>;

  ExactSum() = default;
  ExactSum(double value) { *this += value; }
  ExactSum &operator+=(double x);
  ExactSum &operator+=(const ExactSum &b);
  // The double nearest to the sum. After non-finite addends the result is their sum.
  double value() const;
  operator double() const { return value(); }

  // For sums over processes: after the carries all limbs but the last are 0 ... 2^32 - 1, equal for equal
  // sums. Up to 2^20 such sums may be added limb by limb.
  const Limbs &carried();
  double not_finite() const { return not_finite_; } // sum of non-finite addends, otherwise 0
  static ExactSum of(const Limbs &limbs, double not_finite);

private:
  void carry();
  void add_bits(std::uint64_t mantissa, unsigned place, bool negative);

  Limbs limb_{};
  std::int32_t since_carry_ = 0; // additions since the last carry
  double not_finite_ = 0;
};

// The sum under `name` as a plain number, and in a second block its limbs, so that a restarted run gives the
// same bits. An older state has the number alone.
void describe(Archive &archive, const std::string &name, ExactSum &sum, const std::string &unit);

} // namespace platen
