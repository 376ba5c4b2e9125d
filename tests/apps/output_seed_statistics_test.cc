// Mean and scatter over seeds.
#include "apps/output/seed_statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace platen::apps {
namespace {

TEST(SeedStatistics, are_those_of_a_sample_that_is_known) {
  SeedStatistics s;
  for (const double v : {2.0, 4.0, 4.0, 4.0, 5.0, 5.0, 7.0, 9.0})
    s.add(v);
  EXPECT_EQ(s.count(), 8u);
  EXPECT_DOUBLE_EQ(s.mean(), 5);
  EXPECT_DOUBLE_EQ(s.deviation(), std::sqrt(32.0 / 7));    // of the sample: over n - 1
  EXPECT_DOUBLE_EQ(s.root_mean_square(), std::sqrt(29.0)); // 25 + 32/8: square of the mean and variance
  EXPECT_EQ(text_of(s, 1), "5 +- 2.1");
  EXPECT_EQ(text_of(s, 10), "0.5 +- 0.21");
}

TEST(SeedStatistics, leave_out_what_was_not_measured) {
  SeedStatistics s;
  EXPECT_TRUE(std::isnan(s.mean()));
  EXPECT_TRUE(std::isnan(s.root_mean_square()));
  EXPECT_EQ(text_of(s, 1), "-");
  s.add(std::numeric_limits<double>::quiet_NaN());
  s.add(3);
  EXPECT_EQ(s.count(), 1u);
  EXPECT_EQ(s.mean(), 3);
  EXPECT_TRUE(std::isnan(s.deviation()));
  EXPECT_EQ(text_of(s, 1), "3, 1 packing");
}

// A deviation of few is a guess that looks like knowledge: two that agree by chance would tell "+- 0.0".
TEST(SeedStatistics, of_fewer_than_five_the_range_is_told_and_how_many) {
  SeedStatistics s;
  EXPECT_TRUE(std::isnan(s.least()));
  EXPECT_TRUE(std::isnan(s.largest()));
  s.add(41.5e6), s.add(41.4e6);
  EXPECT_EQ(text_of(s, 1e6), "41.4 ... 41.5, 2 packings");
  EXPECT_EQ(short_text_of(s, 1e6), "41.4 ... 41.5");
  s.add(43e6), s.add(40e6);
  EXPECT_EQ(s.least(), 40e6);
  EXPECT_EQ(s.largest(), 43e6);
  EXPECT_EQ(text_of(s, 1e6), "40 ... 43, 4 packings");
  s.add(41.5e6);
  EXPECT_EQ(text_of(s, 1e6), "41.48 +- 1.1");
  EXPECT_EQ(short_text_of(s, 1e6), text_of(s, 1e6));
}

} // namespace
} // namespace platen::apps
