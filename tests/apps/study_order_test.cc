// In which order the runs of a study start, so that those at a time end together.
#include <gtest/gtest.h>

#include <cstddef>
#include <vector>

#include "apps/many/runs.h"
#include "apps/programs.h"
#include "apps/scene/parameters.h"
#include "apps/study/cases.h"

namespace {

using namespace platen::apps;

TestRun run(std::size_t specimen_of, double seconds) {
  TestRun run;
  run.specimen_of = specimen_of, run.seconds = seconds;
  return run;
}

std::vector<std::size_t> order(const std::vector<TestRun> &runs) {
  return order_of_start(runs, 2);
}

TEST(StudyOrder, starts_the_longest_first) {
  EXPECT_EQ(order({run(0, 2), run(1, 5), run(2, 3), run(3, 5)}), (std::vector<std::size_t>{1, 3, 2, 0}));
}

TEST(StudyOrder, starts_one_of_each_packing_before_the_others_of_it) {
  // Three surfaces on a short and on a slender specimen: the other slender ones would wait for the first.
  EXPECT_EQ(order({run(0, 1), run(0, 1), run(0, 1), run(3, 2), run(3, 2), run(3, 2)}),
            (std::vector<std::size_t>{3, 0, 4, 5, 1, 2}));
}

TEST(StudyOrder, is_that_of_the_cases_where_nothing_is_known) {
  EXPECT_EQ(order({run(0, 0), run(1, 0), run(2, 0)}), (std::vector<std::size_t>{0, 1, 2}));
  EXPECT_TRUE(order({}).empty());
}

TEST(StudyOrder, is_that_of_the_cases_one_at_a_time) {
  EXPECT_EQ(order_of_start({run(0, 2), run(1, 5), run(1, 3)}, 1), (std::vector<std::size_t>{0, 1, 2}));
}

TEST(StudyOrder, counts_seconds_by_spheres_and_way) {
  const std::string file = std::string(PLATEN_SCENES) + "/study_friction_quick.prm";
  const Scene scene = read_scene(file, {}, program("study"));
  const StudyPlan plan = plan_study(StudyKind::friction, scene, {});
  ASSERT_EQ(plan.cases.size(), 6u);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_GT(plan.cases[k].costs.seconds, 0) << plan.cases[k].name;
    // Twice the height: twice the spheres and, at the same speed, twice the steps; platens cost the same.
    EXPECT_NEAR(plan.cases[k + 3].costs.seconds / plan.cases[k].costs.seconds, 4, 0.1) << plan.cases[k].name;
  }
}

} // namespace
