#include "apps/report/report.h"

#include <gtest/gtest.h>

#include <sstream>

namespace platen::apps::report {
namespace {

Run run_named(const std::string &name, const nlohmann::json &summary) {
  Run run;
  run.name = name;
  run.summary = summary;
  return run;
}

std::vector<std::string> row_titled(const TableOfFigures &table, const std::string &title) {
  for (const auto &row : table.rows)
    if (row[0] == title) return row;
  return {};
}

const Run dry = run_named("dry", {{"strength_pa", 48e6},
                                  {"end_damage_top", 0.1},
                                  {"end_damage_bottom", 0.18},
                                  {"end_spread", nullptr},
                                  {"broken_tension", 1200}});
const Run lubricated = run_named("lubricated", {{"strength_pa", 40e6},
                                                {"end_damage_top", 0.6},
                                                {"end_damage_bottom", 0.3},
                                                {"end_spread", 0.5},
                                                {"broken_tension", 0}});

TEST(ReportComparison, the_gain_is_the_first_over_the_other) {
  const TableOfFigures table = table_of_figures({dry, lubricated});
  EXPECT_EQ(table.header, (std::vector<std::string>{"figure", "dry", "lubricated", "dry / lubricated"}));
  EXPECT_EQ(row_titled(table, "strength (MPa)"),
            (std::vector<std::string>{"strength (MPa)", "48.00", "40.00", "1.200"}));
}

TEST(ReportComparison, the_worse_end_counts) {
  const auto row = row_titled(table_of_figures({dry, lubricated}), "damage of the worse end");
  EXPECT_EQ(row[1], "0.180");
  EXPECT_EQ(row[2], "0.600");
}

TEST(ReportComparison, what_was_not_measured_is_a_dash_and_gives_no_gain) {
  const TableOfFigures table = table_of_figures({dry, lubricated});
  EXPECT_EQ(row_titled(table, "spread of the ends"),
            (std::vector<std::string>{"spread of the ends", "-", "0.500", "-"}));
  EXPECT_EQ(row_titled(table, "bonds broken in tension")[3], "-"); // nothing is no divisor
  EXPECT_EQ(row_titled(table_of_figures({run_named("none", nullptr)}), "strength (MPa)")[1], "-");
}

TEST(ReportComparison, tensile_strength_has_a_row_only_where_it_was_measured) {
  EXPECT_TRUE(row_titled(table_of_figures({dry}), "tensile strength (MPa)").empty());
  const auto both = run_named("both", {{"tensile_strength_pa", 4.5e6}});
  EXPECT_EQ(row_titled(table_of_figures({dry, both}), "tensile strength (MPa)")[2], "4.50");
}

TEST(ReportComparison, cones_b_values_and_patterns_have_rows_where_a_run_tells_them) {
  EXPECT_TRUE(row_titled(table_of_figures({dry}), "pattern").empty());
  EXPECT_TRUE(row_titled(table_of_figures({dry}), "b-value before the peak").empty());
  const auto told = run_named("told", {{"pattern", "cones"},
                                       {"cone_top", nullptr},
                                       {"cone_bottom", {{"half_angle_deg", 41.26}}},
                                       {"dead_zone_top", {{"base_ratio", 0.41}}},
                                       {"dead_zone_bottom", {{"base_ratio", 0.97}}},
                                       {"acoustic", {{"b_before", 1.5}, {"b_after", nullptr}}}});
  const TableOfFigures table = table_of_figures({told, dry});
  EXPECT_EQ(row_titled(table, "pattern"), (std::vector<std::string>{"pattern", "cones", "-", "-"}));
  EXPECT_EQ(row_titled(table, "half-angle of the bottom cone")[1], "41.3");
  EXPECT_TRUE(row_titled(table, "half-angle of the top cone (degrees)").empty());
  EXPECT_EQ(row_titled(table, "base of the worse end's cone, r0")[1], "0.41"); // the worse end decides
  EXPECT_EQ(row_titled(table, "b-value before the peak")[1], "1.50");
  EXPECT_TRUE(row_titled(table, "b-value after the peak").empty());
}

TEST(ReportComparison, all_lines_of_the_text_are_of_one_length) {
  std::istringstream lines(as_text(table_of_figures({dry, lubricated, dry})));
  std::size_t length = 0, count = 0;
  for (std::string line; std::getline(lines, line); ++count) {
    if (count == 0) length = line.size();
    EXPECT_EQ(line.size(), length) << line;
  }
  EXPECT_GT(count, 10u);
}

TEST(ReportComparison, titles_cannot_break_the_page) {
  EXPECT_EQ(escaped("<b> & \"x\""), "&lt;b&gt; &amp; &quot;x&quot;");
}

} // namespace
} // namespace platen::apps::report
