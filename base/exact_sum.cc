#include "base/exact_sum.h"

#include <cmath>
#include <cstring>

namespace platen {
namespace {

constexpr unsigned limb_bits = 32;
constexpr std::int64_t limb_mask = 0xffffffff;
// Bits below the point: the last bit of the smallest double.
constexpr int unit_exponent = -1074;
// One addition adds less than 2^34 to a limb.
constexpr std::int32_t most_before_carry = 1 << 28;

constexpr unsigned fraction_bits = 52;
constexpr std::uint64_t fraction_mask = (std::uint64_t{1} << fraction_bits) - 1;
constexpr unsigned exponent_mask = 0x7ff;

__extension__ typedef unsigned __int128 Wide;

} // namespace

ExactSum &ExactSum::operator+=(double x) {
  std::uint64_t bits = 0;
  std::memcpy(&bits, &x, sizeof bits);
  const unsigned exponent = static_cast<unsigned>(bits >> fraction_bits) & exponent_mask;
  const std::uint64_t fraction = bits & fraction_mask;
  if (exponent == exponent_mask) {
    not_finite_ += x;
    return *this;
  }
  if (exponent == 0)
    add_bits(fraction, 0, bits >> 63);
  else
    add_bits(fraction | (fraction_mask + 1), exponent - 1, bits >> 63);
  return *this;
}

void ExactSum::add_bits(std::uint64_t mantissa, unsigned place, bool negative) {
  if (mantissa == 0) return;
  const unsigned first = place / limb_bits, shift = place % limb_bits;
  const std::uint64_t low = (mantissa & limb_mask) << shift, high = (mantissa >> limb_bits) << shift;
  const std::int64_t parts[] = {static_cast<std::int64_t>(low & limb_mask),
                                static_cast<std::int64_t>((low >> limb_bits) + (high & limb_mask)),
                                static_cast<std::int64_t>(high >> limb_bits)};
  for (unsigned k = 0; k < 3; ++k)
    limb_[first + k] += negative ? -parts[k] : parts[k];
  if (++since_carry_ >= most_before_carry) carry();
}

ExactSum &ExactSum::operator+=(const ExactSum &b) {
  ExactSum other = b;
  other.carry();
  carry();
  for (std::size_t k = 0; k < limbs; ++k)
    limb_[k] += other.limb_[k];
  carry();
  not_finite_ += b.not_finite_;
  return *this;
}

void ExactSum::carry() {
  for (std::size_t k = 0; k + 1 < limbs; ++k) {
    const std::int64_t over = limb_[k] >> limb_bits; // rounds down, also below zero
    limb_[k] &= limb_mask;
    limb_[k + 1] += over;
  }
  since_carry_ = 0;
}

const ExactSum::Limbs &ExactSum::carried() {
  carry();
  return limb_;
}

ExactSum ExactSum::of(const Limbs &limbs_of, double not_finite) {
  ExactSum sum;
  sum.limb_ = limbs_of;
  sum.not_finite_ = not_finite;
  sum.carry();
  return sum;
}

double ExactSum::value() const {
  if (not_finite_ != 0) return not_finite_;
  ExactSum size = *this;
  size.carry();
  const bool negative = size.limb_[limbs - 1] < 0;
  if (negative) {
    for (std::int64_t &limb : size.limb_)
      limb = -limb;
    size.carry();
  }
  std::size_t top = limbs;
  while (top > 0 && size.limb_[top - 1] == 0)
    --top;
  if (top == 0) return 0;
  // The highest three limbs hold more bits than a double; of the rest only whether it is zero matters.
  const std::size_t lowest = top > 3 ? top - 3 : 0;
  Wide leading = 0;
  for (std::size_t k = top; k-- > lowest;)
    leading = (leading << limb_bits) | static_cast<std::uint64_t>(size.limb_[k]);
  for (std::size_t k = 0; k < lowest; ++k)
    if (size.limb_[k] != 0) leading |= 1;
  const double value =
      std::ldexp(static_cast<double>(leading), static_cast<int>(limb_bits * lowest) + unit_exponent);
  return negative ? -value : value;
}

void describe(Archive &archive, const std::string &name, ExactSum &sum, const std::string &unit) {
  double value = sum.value();
  ExactSum::Limbs limbs = sum.carried();
  archive(name, value, unit);
  archive(name + "_exact", limbs, "1", ExactSum::Limbs{});
  if (!archive.reads()) return;
  sum = ExactSum::of(limbs, 0);
  if (sum.value() != value) sum = ExactSum(value); // an older state, or not finite
}

} // namespace platen
