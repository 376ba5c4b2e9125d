// Elementary functions of laws against those of the C library.
#include <gtest/gtest.h>

#include <cmath>

#include "dem/laws/elementary.h"

namespace platen::dem {
namespace {

TEST(Elementary, saturation_is_one_less_the_exponential) {
  EXPECT_EQ(saturation(0.0), 0);
  for (double y = 1e-12; y < 32; y *= 1.07)
    EXPECT_NEAR(saturation(y), -std::expm1(-y), 1e-14 * -std::expm1(-y)) << y;
  EXPECT_EQ(saturation(1e30), saturation(32.0));
  EXPECT_NEAR(saturation(32.0), 1, 2e-14);
}

TEST(Elementary, angles_of_the_first_quarter) {
  EXPECT_EQ(share_of_right_angle(0.0, 3.0), 0);
  EXPECT_NEAR(share_of_right_angle(3.0, 0.0), 1, 1e-15);
  for (double y = 1e-9; y < 1e9; y *= 1.3)
    EXPECT_NEAR(share_of_right_angle(y, 0.7), std::atan2(y, 0.7) / (0.5 * pi), 1e-14 * std::atan2(y, 0.7))
        << y;
}

TEST(Elementary, powers_of_shares) {
  for (const double n : {0.0, 0.2, 1.0, 3.0}) {
    EXPECT_EQ(power_of_share(1.0, n), 1);
    for (double x = 1e-4; x < 1; x *= 1.02)
      EXPECT_NEAR(power_of_share(x, n), std::pow(x, n), 2e-14) << x << ' ' << n;
  }
  EXPECT_EQ(power_of_share(0.0, 0.2), power_of_share(1e-12, 0.2));
}

} // namespace
} // namespace platen::dem
