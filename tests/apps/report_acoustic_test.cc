#include "apps/report/curves.h"

#include <gtest/gtest.h>

#include <cmath>

#include "apps/report_folder.h"

namespace platen::apps::report {
namespace {

report::Run heard(const TestFolder &folder) {
  report::Run run;
  run.moments.peak_time = 1;
  run.events = read_csv(
      folder.write("events.csv", "time_s,magnitude\n0.5,-5\n0.2,-6\n0.9,-4\n0.9,\n1,-3\n1.5,-5.5\n"));
  run.summary["acoustic"] = {{"b_before", 1.5},      {"b_before_error", 0.1},   {"b_before_events", 100},
                             {"b_before_limit", -6}, {"b_after", nullptr},      {"b_after_error", nullptr},
                             {"b_after_events", 3},  {"b_after_limit", nullptr}};
  return run;
}

TEST(ReportAcoustic, events_are_counted_from_the_great_ones_down_on_their_side_of_the_peak) {
  const TestFolder folder;
  const report::Run run = heard(folder);
  const MagnitudeCount before = count_of(run, Stage::before_peak), after = count_of(run, Stage::after_peak);
  EXPECT_EQ(before.magnitude, (std::vector<double>{-6, -5, -4})); // one without energy has no magnitude
  EXPECT_EQ(before.log_count, (std::vector<double>{std::log10(3), std::log10(2), 0}));
  EXPECT_EQ(after.magnitude, (std::vector<double>{-5.5, -3}));
}

TEST(ReportAcoustic, the_line_has_all_counted_events_at_its_limit_and_falls_by_b) {
  const TestFolder folder;
  const report::Run run = heard(folder);
  const FittedLine line = line_of(run, Stage::before_peak);
  ASSERT_TRUE(line.is_there);
  EXPECT_NEAR(line.log_count(-6), 2, 1e-14);
  EXPECT_NEAR(line.log_count(-5), 0.5, 1e-14);
  EXPECT_FALSE(line_of(run, Stage::after_peak).is_there);
  EXPECT_FALSE(line_of(report::Run{}, Stage::before_peak).is_there);
}

} // namespace
} // namespace platen::apps::report
