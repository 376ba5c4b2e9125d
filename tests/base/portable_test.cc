// The same numbers as the C library, on every processor.
#include "base/portable.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "base/random.h"

namespace platen::portable_test {
namespace {

using Function = std::function<double(double)>;
using Precise = std::function<long double(long double)>;

// Largest difference from a value of extended precision, in units in the last place of a double.
double worst(const std::function<double(Random &)> &draw, const Function &own, const Precise &precise) {
  Random random(7);
  double most = 0;
  for (int k = 0; k < 20000; ++k) {
    const double x = draw(random);
    const long double right = precise(x);
    const double near = std::abs(static_cast<double>(right));
    const double unit = std::nextafter(near, std::numeric_limits<double>::infinity()) - near;
    const double off = std::abs(static_cast<double>((own(x) - right) / unit));
    if (!(off <= most)) most = off;
  }
  return most;
}
std::function<double(Random &)> between(double low, double high) {
  return [=](Random &random) { return random.uniform(low, high); };
}
std::function<double(Random &)> orders(double low, double high) {
  return [=](Random &random) { return std::exp(random.uniform(low, high)); };
}

// Half a unit is what rounding alone leaves; the C library's own values of extended precision are off by up
// to a thousandth.
constexpr double rounded = 0.51;

TEST(Portable, exponentials_and_logarithms_are_rounded_once) {
  const auto precise_exp = [](long double x) { return std::exp(x); };
  const auto precise_log = [](long double x) { return std::log(x); };
  EXPECT_LT(worst(between(-708, 709), portable::exp, precise_exp), rounded);
  EXPECT_LT(worst(between(-1, 1), portable::exp, precise_exp), rounded);
  EXPECT_LT(worst(orders(-700, 700), portable::log, precise_log), rounded);
  EXPECT_LT(worst(between(0.5, 2), portable::log, precise_log), rounded);
}

TEST(Portable, powers_lose_less_than_a_unit_in_their_whole_range) {
  for (const double y : {0.4, 1 / 3.3, -0.27, 1.0})
    EXPECT_LT(worst(
                  orders(-40, 40), [y](double x) { return portable::pow(x, y); },
                  [y](long double x) { return std::pow(x, static_cast<long double>(y)); }),
              0.53)
        << y;
  EXPECT_LT(worst(
                orders(-35, 35), [](double x) { return portable::pow(x, 20.0); },
                [](long double x) { return std::pow(x, 20.0L); }),
            0.95);
}

TEST(Portable, angles_are_rounded_once_in_all_quadrants) {
  const auto precise_sin = [](long double x) { return std::sin(x); };
  const auto precise_cos = [](long double x) { return std::cos(x); };
  for (const double reach : {1e-3, 1.0, 10.0, 1e7}) {
    EXPECT_LT(worst(between(-reach, reach), portable::sin, precise_sin), rounded) << reach;
    EXPECT_LT(worst(between(-reach, reach), portable::cos, precise_cos), rounded) << reach;
  }
  EXPECT_LT(worst(between(-1.57, 1.57), portable::tan, [](long double x) { return std::tan(x); }), rounded);
  EXPECT_LT(worst(between(-1, 1), portable::acos, [](long double x) { return std::acos(x); }), rounded);
  for (const double side : {-1.0, 1.0})
    for (const double other : {-1.0, 1.0})
      EXPECT_LT(worst(
                    orders(-20, 20), [=](double t) { return portable::atan2(side * t, other); },
                    [=](long double t) { return std::atan2(side * t, static_cast<long double>(other)); }),
                rounded);
}

// Of whole numbers it is a factorial.
TEST(Portable, gamma_is_within_two_units_of_factorials) {
  double factorial = 1; // exact up to 22!
  for (int n = 1; n <= 22; factorial *= n, ++n)
    EXPECT_DOUBLE_EQ(portable::gamma(n), factorial) << n;
  EXPECT_LT(worst(between(1, 171), portable::gamma, [](long double x) { return std::tgamma(x); }), 2);
}

TEST(Portable, ends_of_their_ranges_are_those_of_the_c_library) {
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(portable::exp(infinity), infinity);
  EXPECT_EQ(portable::exp(710), infinity);
  EXPECT_EQ(portable::exp(-infinity), 0);
  EXPECT_EQ(portable::exp(-745), std::exp(-745.0)); // the smallest there is
  EXPECT_EQ(portable::log(0), -infinity);
  EXPECT_EQ(portable::log(infinity), infinity);
  EXPECT_TRUE(std::isnan(portable::log(-1)));
  EXPECT_EQ(portable::pow(0, 0.4), 0);
  EXPECT_EQ(portable::pow(0, -1), infinity);
  EXPECT_EQ(portable::pow(3, 0), 1);
  EXPECT_EQ(portable::pow(1e-300, 2), 0);
  EXPECT_TRUE(std::isnan(portable::pow(-1, 0.5)));
  EXPECT_EQ(portable::sin(0), 0);
  EXPECT_LE(std::abs(portable::sin(1e300)), 1);
  EXPECT_TRUE(std::isnan(portable::cos(infinity)));
  EXPECT_EQ(portable::acos(1), 0);
  EXPECT_DOUBLE_EQ(portable::acos(-1), std::acos(-1.0));
  EXPECT_TRUE(std::isnan(portable::acos(1.01)));
  EXPECT_EQ(portable::atan2(0, 0), 0);
  EXPECT_EQ(portable::gamma(172.5), infinity);
  EXPECT_TRUE(std::isnan(portable::gamma(0.5)));
  for (const auto &of : {portable::exp, portable::log, portable::sin, portable::tan, portable::acos})
    EXPECT_TRUE(std::isnan(of(std::nan(""))));
}

} // namespace
} // namespace platen::portable_test
