// A sum of doubles that loses no bit, so that it does not depend on the order of its parts: parts of threads,
// of blocks and of ranks may be added as they come.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "base/archive.h"

namespace platen {

// Kept as one long integer in units of the smallest double, cut into limbs of 32 bits; a limb may hold more
// for a while, and the carries are done now and then. Any doubles may be added, 2^40 of the largest and more.
class ExactSum {
public:
  // 2098 bits hold every double; the rest is room for sums.
  static constexpr std::size_t limbs = 68;
  using Limbs = std::array<std::int64_t, limbs>;

  ExactSum() = default;
  ExactSum(double value) { *this += value; }
  ExactSum &operator+=(double x);
  ExactSum &operator+=(const ExactSum &b);
  // The double nearest to the sum. Where something that is not finite was added, that is what comes out.
  double value() const;
  operator double() const { return value(); }

  // For sums over processes: with the carries done, limbs but for the last are 0 ... 2^32 - 1, the same for
  // the same sum. Limb by limb such sums may be added, up to 2^20 of them.
  const Limbs &carried();
  double not_finite() const { return not_finite_; } // sum of what was not; else 0
  static ExactSum of(const Limbs &limbs, double not_finite);

private:
  void carry();
  void add_bits(std::uint64_t mantissa, unsigned place, bool negative);

  Limbs limb_{};
  std::int32_t since_carry_ = 0; // additions
  double not_finite_ = 0;
};

// The sum under `name`, as a number that a reader understands, and its limbs beside it, by which a run goes
// on to the same bits. A state that lacks these has the number alone.
void describe(Archive &archive, const std::string &name, ExactSum &sum, const std::string &unit);

} // namespace platen
