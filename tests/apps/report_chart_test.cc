#include "apps/report/chart.h"

#include <gtest/gtest.h>

#include <cmath>

namespace platen::apps::report {
namespace {

TEST(ReportChart, ticks_are_round_evenly_spaced_and_hold_the_range) {
  for (const auto &[low, high] :
       {std::pair{0.0, 39.7}, {-3.1, 5.0}, {0.0, 1.0}, {0.0, 7e-7}, {-12.0, 0.0}, {5.0, 5.0}}) {
    const std::vector<double> ticks = round_ticks(low, high, 5);
    ASSERT_GE(ticks.size(), 2u);
    const double step = ticks[1] - ticks[0],
                 leading = step / std::pow(10, std::floor(std::log10(step) + 1e-9));
    EXPECT_TRUE(std::abs(leading - 1) < 1e-9 || std::abs(leading - 2) < 1e-9 || std::abs(leading - 5) < 1e-9)
        << step;
    EXPECT_LE(ticks.front(), low + 1e-9 * step);
    EXPECT_GE(ticks.back(), high - 1e-9 * step);
    EXPECT_LT(ticks.back() - high, step * (1 + 1e-9) + (low == high ? std::abs(low) : 0)); // no tick too many
  }
}

Chart with_points(const std::vector<double> &x, const std::vector<double> &y) {
  Chart chart;
  chart.curves.push_back({"a", x, y});
  return chart;
}

TEST(ReportChart, the_legend_goes_where_no_curve_is) {
  const LegendPlace rising = place_legend(with_points({0, 5, 10}, {0, 5, 10}), {0, 10}, {0, 10}, 0.4, 0.3);
  EXPECT_TRUE(rising.left);
  EXPECT_EQ(rising.y_top, 10);
  const LegendPlace falling = place_legend(with_points({0, 5, 10}, {10, 5, 0}), {0, 10}, {0, 10}, 0.4, 0.3);
  EXPECT_FALSE(falling.left);
  EXPECT_EQ(falling.y_top, 10);
}

TEST(ReportChart, where_both_corners_are_taken_the_axis_grows_above_the_curve) {
  const double height = 0.3;
  const LegendPlace place =
      place_legend(with_points({0, 1, 9, 10}, {10, 10, 10, 10}), {0, 10}, {0, 10}, 0.4, height);
  EXPECT_GT(place.y_top * (1 - height), 10); // lower edge of the legend
}

TEST(ReportChart, a_gap_in_a_column_neither_counts_nor_breaks_the_range) {
  const double gap = std::nan("");
  const auto range = x_range_of(with_points({-1, gap, 4, 50}, {0, 1, 2, gap}));
  EXPECT_NEAR(range[0], -1.2, 1e-12); // 4 % of 5 beyond each end
  EXPECT_NEAR(range[1], 4.2, 1e-12);
}

} // namespace
} // namespace platen::apps::report
