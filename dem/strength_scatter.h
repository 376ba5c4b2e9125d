// Bonds of unlike strength: a factor for each, of Weibull's distribution.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "base/describe.h"

namespace platen::dem {

struct Bonds;

struct StrengthScatter {
  double weibull_modulus = std::numeric_limits<double>::quiet_NaN(); // m > 0; large: hardly any scatter
  std::uint64_t seed = 1;

  static constexpr const char *name = "StrengthScatter";
  template <class Visitor, class Self>
  static void describe(Visitor &&v, Self &p) {
    v("weibull_modulus", p.weibull_modulus, "1", between(0.5, 1000),
      "Of the factors: the larger, the less scatter.");
  }
};

// `count` numbers of the distribution P(s < x) = 1 - exp(-(x/s_0)^m), s_0 = 1 / Gamma(1 + 1/m), whose mean is
// 1 (Weibull 1951): always the same ones for a seed, the first of them whatever the count. Throws
// std::invalid_argument unless m is positive and finite.
std::vector<double> weibull_factors(std::size_t count, const StrengthScatter &scatter);

// Multiplies the strength factor of each bond, in the order of records. Bonds must be as they were laid.
void scatter_strengths(Bonds &bonds, const StrengthScatter &scatter);

} // namespace platen::dem
