#include "apps/report/bars.h"

#include <gtest/gtest.h>

#include "apps/report_folder.h"

namespace platen::apps::report {
namespace {

TEST(ReportCosts, the_largest_comes_first_the_rest_last_and_all_make_the_wall_clock) {
  report::Run run;
  run.summary = {{"wall_seconds", 20.0},
                 {"setup_seconds", 4.0},
                 {"stage_seconds", {{"motion", 2.0}, {"bonds", 9.0}, {"stable_step", 1.5}, {"bodies", 0.0}}}};
  const std::vector<Cost> costs = costs_of(run);
  ASSERT_EQ(costs.size(), 5u); // nothing spent is not shown
  EXPECT_EQ(costs[0].name, "bonds");
  EXPECT_EQ(costs[1].name, "setting up");
  EXPECT_FALSE(costs[1].is_stage);
  EXPECT_EQ(costs[3].name, "stable step");
  EXPECT_EQ(costs[4].name, "the rest");
  double sum = 0;
  for (const Cost &cost : costs)
    sum += cost.seconds;
  EXPECT_NEAR(sum, 20, 1e-12);
}

TEST(ReportCosts, an_unfinished_run_has_none) {
  EXPECT_TRUE(costs_of(report::Run{}).empty());
  EXPECT_EQ(machine_words(report::Run{}), "");
}

TEST(ReportCosts, the_machine_is_that_of_the_log) {
  const TestFolder folder;
  folder.write("run.log", "Platen\nmachine Difference Engine, 2 cores\nthreads 2\n");
  report::Run run;
  run.folder = folder / "";
  run.summary = {{"threads", 2}, {"peak_memory_bytes", 190e6}};
  EXPECT_EQ(machine_words(run), "2 threads; Difference Engine, 2 cores; 190 MB at most");
}

} // namespace
} // namespace platen::apps::report
