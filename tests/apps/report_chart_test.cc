#include "apps/report/chart.h"

#include "apps/report/chart_svg.h"

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

TEST(ReportChart, what_is_not_finite_leaves_a_gap) {
  const double none = std::nan("");
  const std::vector<Curve> pieces =
      pieces_of({"a", {0, 1, 2, 3, 4, 5}, {5, 6, none, 7, none, 8}, colours::blue});
  ASSERT_EQ(pieces.size(), 1u); // single points are no line
  EXPECT_EQ(pieces[0].x, (std::vector<double>{0, 1}));
  const std::vector<Curve> two = pieces_of({"a", {0, 1, 2, 3, 4}, {5, 6, none, 7, 8}, colours::blue});
  ASSERT_EQ(two.size(), 2u);
  EXPECT_EQ(two[1].y, (std::vector<double>{7, 8}));
  EXPECT_EQ(two[0].label + "|" + two[1].label, "a|"); // one entry in the legend
}

TEST(ReportChart, sizes_and_slendernesses_have_axes_around_their_values) {
  Chart chart;
  chart.marks = {{1, 5, "", colours::blue}, {2, 4, "", colours::blue}};
  const std::array<double, 2> range = snug_x_range(chart);
  EXPECT_GT(range[0], 0.8);
  EXPECT_LT(range[0], 1);
  EXPECT_GT(range[1], 2);
  EXPECT_LT(range[1], 2.2);
  EXPECT_EQ(snug_range(4, 4), (std::array<double, 2>{3.6, 4.4}));
  EXPECT_EQ(snug_range(0, 0), (std::array<double, 2>{-1, 1}));
}

TEST(ReportChart, x_alone_may_be_in_decades) {
  Chart chart;
  chart.scale = Scale::logarithmic_x;
  chart.marks = {{10, 5, "", colours::blue}, {1000, -4, "", colours::blue}};
  const Chart decades = in_decades(chart);
  EXPECT_DOUBLE_EQ(decades.marks[1].x, 3);
  EXPECT_EQ(decades.marks[1].y, -4);
  EXPECT_EQ(decades.y_range, (std::array<double, 2>{0, 0})); // from the marks
}

// Points of the curve stand where the axes say, in pixels from above; a gap parts the line.
TEST(ReportChart, svg_has_its_lines_where_the_axes_say) {
  Chart chart = chart_with_axes("x <m>", "y");
  const double none = std::nan("");
  chart.curves = {{"a & b", {0, 5, 10, 11, 20, 30}, {0, 10, 20, none, 0, 40}, colours::blue, Stroke::dashed}};
  chart.marks = {{10, 20, "", colours::black}};
  chart.x_range = {0, 40}, chart.y_range = {0, 40};
  ChartSvg svg(1000, 800);
  svg.add(layout_of(chart, 400, 400), {100, 200, 400, 400});
  const std::string text = svg.text("Title <b>", "below");
  EXPECT_NE(text.find("points=\"100.00,600.00 150.00,500.00 200.00,400.00\""), std::string::npos) << text;
  EXPECT_NE(text.find("points=\"300.00,600.00 400.00,200.00\""), std::string::npos) << text;
  EXPECT_NE(text.find("<circle cx=\"200.00\" cy=\"400.00\""), std::string::npos);
  for (const char *words :
       {"Title &lt;b&gt;", "x &lt;m&gt;", "a &amp; b", "stroke=\"#0072b2\"", "stroke-dasharray"})
    EXPECT_NE(text.find(words), std::string::npos) << words;
  EXPECT_EQ(text.find("nan"), std::string::npos);
  EXPECT_EQ(text, svg.text("Title <b>", "below"));
}

} // namespace
} // namespace platen::apps::report
