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
  run.summary["acoustic"] = {
      {"b_before", 1.5},      {"b_before_error", 0.1},    {"b_before_events", 100},
      {"b_before_limit", -6}, {"b_after", nullptr},       {"b_after_error", nullptr},
      {"b_after_events", 3},  {"b_after_limit", nullptr}, {"b_after_reason", "3 events"}};
  return run;
}

TEST(ReportAcoustic, events_are_counted_from_the_great_ones_down_on_their_side_of_the_peak) {
  const TestFolder folder;
  const report::Run run = heard(folder);
  const MagnitudeCount before = count_of(run, Stage::before_peak), after = count_of(run, Stage::after_peak);
  EXPECT_EQ(before.magnitude, (std::vector<double>{-6, -5, -4, -3})); // one without energy has no magnitude
  EXPECT_EQ(before.log_count, (std::vector<double>{std::log10(4), std::log10(3), std::log10(2), 0}));
  EXPECT_EQ(after.magnitude, (std::vector<double>{-5.5}));
}

TEST(ReportAcoustic, the_line_has_all_counted_events_at_its_limit_and_falls_by_b) {
  const TestFolder folder;
  const report::Run run = heard(folder);
  const FittedLine line = line_of(run, Stage::before_peak);
  ASSERT_TRUE(line.is_there);
  EXPECT_NEAR(line.log_count(-6), 2, 1e-14);
  EXPECT_NEAR(line.log_count(-5), 0.5, 1e-14);
  EXPECT_FALSE(line_of(run, Stage::after_peak).is_there);
  EXPECT_EQ(line_of(run, Stage::after_peak).reason, "3 events");
  EXPECT_FALSE(line_of(report::Run{}, Stage::before_peak).is_there);
}

// A law with an upper end falls to the events beyond it there, and is drawn no further.
TEST(ReportAcoustic, a_line_is_drawn_over_its_range_alone) {
  const TestFolder folder;
  report::Run run = heard(folder);
  run.summary["acoustic"].update({{"b_before_upper", -5}, {"b_before_above", 7}});
  const FittedLine line = line_of(run, Stage::before_peak);
  EXPECT_NEAR(line.log_count(-6), std::log10(107), 1e-12);
  EXPECT_NEAR(line.log_count(-5), std::log10(7), 1e-12);
  const Curve curve = line.curve("before", Stroke::solid);
  EXPECT_EQ(curve.x.front(), -6);
  EXPECT_EQ(curve.x.back(), -5);
  EXPECT_NE(curve.label.find("M from -6.0 to -5.0: 100 events"), std::string::npos) << curve.label;
  run.summary["acoustic"].update({{"b_before_upper", nullptr}, {"b_before_above", 0}});
  const Curve open = line_of(run, Stage::before_peak).curve("before", Stroke::solid);
  EXPECT_NEAR(open.x.back(), -6 + 2 / 1.5, 1e-12); // where one event is left
}

// The more events the larger they are, with the b-value that an older summary gives them all the same.
TEST(ReportAcoustic, b_values_of_older_summaries_are_fitted_anew) {
  const TestFolder folder;
  std::string events = "time_s,magnitude\n";
  for (int k = 1; k < 400; ++k)
    events += "0.5," + std::to_string(-6 + std::log10(k / 400.0)) + "\n";
  folder.write("events.csv", events);
  folder.write(
      "history.csv",
      "time_s,axial_strain_platen,axial_stress_top_pa,axial_stress_bottom_pa\n0,0,0,0\n1,1e-3,5,5\n");
  folder.write("summary.json", R"({"acoustic": {"b_before": 1.26, "b_before_error": 0.02}})");
  const report::Run old = read_run(folder.path());
  EXPECT_FALSE(line_of(old, Stage::before_peak).is_there);
  EXPECT_NE(line_of(old, Stage::before_peak).reason.find("a b-value needs 50"), std::string::npos);
  EXPECT_NE(acoustic_caption(old).find("No b-value before the peak: "), std::string::npos);
  EXPECT_TRUE(old.summary["acoustic"]["b_before"].is_null() ||
              std::isnan(old.summary["acoustic"]["b_before"].get<double>()));
  folder.write("summary.json",
               R"({"acoustic": {"b_before": 1.26, "b_before_error": 0.02, "b_before_reason": null,
                   "b_before_events": 60, "b_before_limit": -7}})");
  EXPECT_EQ(line_of(read_run(folder.path()), Stage::before_peak).law.b, 1.26); // a newer one is taken
}

} // namespace
} // namespace platen::apps::report
