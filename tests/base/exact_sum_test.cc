#include "base/exact_sum.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace {

using platen::ExactSum;

// Of all sizes and both signs.
std::vector<double> numbers(std::size_t count, unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> mantissa(-1, 1);
  std::uniform_int_distribution<int> exponent(-1050, 900);
  std::vector<double> values;
  for (std::size_t k = 0; k < count; ++k)
    values.push_back(std::ldexp(mantissa(random), exponent(random)));
  return values;
}

ExactSum sum_of(const std::vector<double> &values) {
  ExactSum sum;
  for (const double v : values)
    sum += v;
  return sum;
}

TEST(exact_sum, one_number_comes_back_to_the_bit) {
  for (const double v : {1.0, -1.0, 0.1, -1e300, 1e-300, 4.9e-324, -4.9e-324, 2.2e-308,
                         std::numeric_limits<double>::max(), std::numeric_limits<double>::min()})
    EXPECT_EQ(ExactSum(v).value(), v);
  for (const double v : numbers(2000, 1))
    EXPECT_EQ(ExactSum(v).value(), v);
  EXPECT_EQ(ExactSum().value(), 0);
}

TEST(exact_sum, does_not_depend_on_the_order_nor_on_how_it_is_cut) {
  std::vector<double> values = numbers(3000, 2);
  const ExactSum whole = sum_of(values);
  std::mt19937 random(3);
  for (int k = 0; k < 20; ++k) {
    std::shuffle(values.begin(), values.end(), random);
    ExactSum parts[3];
    for (std::size_t i = 0; i < values.size(); ++i)
      parts[i % 3] += values[i];
    ExactSum sum;
    for (const ExactSum &part : parts)
      sum += part;
    EXPECT_EQ(sum.value(), whole.value());
    EXPECT_EQ(sum.carried(), ExactSum(whole).carried());
  }
}

TEST(exact_sum, what_cancels_leaves_nothing) {
  std::vector<double> values = numbers(1000, 4);
  const std::size_t n = values.size();
  for (std::size_t k = 0; k < n; ++k)
    values.push_back(-values[k]);
  values.push_back(3e-200);
  std::shuffle(values.begin(), values.end(), std::mt19937(5));
  EXPECT_EQ(sum_of(values).value(), 3e-200);
  EXPECT_EQ(sum_of({1e300, 1, -1e300}).value(), 1);
  EXPECT_EQ(sum_of({-1e300, -1e-300, 1e300}).value(), -1e-300);
}

TEST(exact_sum, is_rounded_to_the_nearest_double) {
  const double ulp = std::numeric_limits<double>::epsilon();
  EXPECT_EQ(sum_of({1, 0.5 * ulp}).value(), 1); // a tie goes to the even one
  EXPECT_EQ(sum_of({1 + ulp, 0.5 * ulp}).value(), 1 + 2 * ulp);
  EXPECT_EQ(sum_of({1, 0.5 * ulp, 1e-300}).value(), 1 + ulp); // and no tie is one
  EXPECT_EQ(sum_of({-1, -0.5 * ulp, -1e-300}).value(), -1 - ulp);
  EXPECT_EQ(sum_of({1, 0.25 * ulp}).value(), 1);
  // Integers up to 2^62: what a double rounds by itself.
  std::mt19937_64 random(6);
  for (int k = 0; k < 1000; ++k) {
    const std::int64_t a = static_cast<std::int64_t>(random() >> 2), high = a >> 31 << 31, low = a - high;
    EXPECT_EQ(sum_of({static_cast<double>(high), static_cast<double>(low)}).value(), static_cast<double>(a));
    EXPECT_EQ(sum_of({-static_cast<double>(high), -static_cast<double>(low)}).value(),
              -static_cast<double>(a));
  }
}

TEST(exact_sum, tells_what_is_not_finite) {
  const double infinite = std::numeric_limits<double>::infinity(), none = std::nan("");
  EXPECT_EQ(sum_of({1, infinite, 2}).value(), infinite);
  EXPECT_TRUE(std::isnan(sum_of({1, infinite, -infinite}).value()));
  EXPECT_TRUE(std::isnan(sum_of({none, 1}).value()));
  ExactSum parts = sum_of({1});
  parts += sum_of({-infinite});
  EXPECT_EQ(parts.value(), -infinite);
}

TEST(exact_sum, limbs_of_several_add_up_as_integers) {
  const std::vector<double> values = numbers(400, 7);
  ExactSum::Limbs limbs{};
  for (std::size_t rank = 0; rank < 7; ++rank) {
    ExactSum part;
    for (std::size_t k = rank; k < values.size(); k += 7)
      part += values[k];
    const ExactSum::Limbs own = part.carried();
    for (std::size_t k = 0; k < limbs.size(); ++k)
      limbs[k] += own[k];
  }
  EXPECT_EQ(ExactSum::of(limbs, 0).value(), sum_of(values).value());
}

TEST(exact_sum, many_additions_overflow_no_limb) {
  ExactSum sum;
  const double part = 1 + std::numeric_limits<double>::epsilon();
  for (int k = 0; k < 1 << 24; ++k)
    sum += part;
  EXPECT_EQ(sum.value(), std::ldexp(part, 24));
}

} // namespace
