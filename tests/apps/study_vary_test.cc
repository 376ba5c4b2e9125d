// Studies of any entries.
#include <gtest/gtest.h>

#include <cmath>

#include "apps/programs.h"
#include "apps/scene/errors.h"
#include "apps/scratch_folder.h"
#include "apps/study/cases.h"
#include "apps/study/tables.h"
#include "apps/study_runs.h"

namespace platen::apps::testing {
namespace {

StudyPlan plan_with(std::vector<std::string> entries) {
  entries.insert(entries.begin(), "Study/Sphere radius list =");
  const Scene scene = read_scene(test_scene("study.prm"), entries, program("study"));
  return plan_study(StudyKind::vary, scene, entries);
}

std::string refusal(const std::vector<std::string> &entries) {
  return message_of<InputError>([&] { plan_with(entries); });
}

TEST(StudyVary, each_value_of_an_entry_runs_with_each_of_the_others) {
  const StudyPlan plan = plan_with({"Study/Vary 1 = Platens/Friction static: 0.2, 0.25",
                                    "Study/Vary 3 = Specimen/Height: 9 mm, 2 cm, 15 mm"});
  EXPECT_EQ(plan.varied, (std::vector<std::string>{"friction_static", "height_m"}));
  ASSERT_EQ(plan.cases.size(), 6u);
  EXPECT_EQ(plan.cases[4].name, "friction_static_0.25_height_2_cm");
  EXPECT_EQ(plan.cases[4].labels, (std::vector<double>{0.25, 0.02}));
  EXPECT_EQ(plan.cases[4].overrides,
            (std::vector<std::string>{"Platens/Friction static = 0.25", "Specimen/Height = 2 cm"}));
  EXPECT_EQ(plan.cases[1].labels, (std::vector<double>{0.2, 0.02}));
}

TEST(StudyVary, a_word_has_its_name_and_no_number) {
  const StudyPlan plan = plan_with({"Study/Vary 1 = Effects/Rotation: on, off"});
  ASSERT_EQ(plan.cases.size(), 2u);
  EXPECT_EQ(plan.cases[1].name, "rotation_off");
  EXPECT_TRUE(std::isnan(plan.cases[1].labels.at(0)));
  EXPECT_EQ(plan.cases[1].words, (std::vector<std::string>{"off"}));
}

class StudyVaryTables : public ScratchFolder {};
TEST_F(StudyVaryTables, hold_the_words_that_vary) {
  const StudyPlan plan = plan_with({"Study/Vary 1 = Effects/Rotation: on, off",
                                    "Study/Vary 2 = Platens/Friction static: 0.2, 0.25", "Study/Seeds = 1"});
  StudyTables tables(plan, OutputPaths(folder_));
  for (std::size_t c = 0; c < plan.cases.size(); ++c) {
    TestRun run;
    run.of = c;
    run.seed = 1;
    tables.add(run, {});
  }
  EXPECT_EQ(words_in(folder_ / "study.csv", "rotation"),
            (std::vector<std::string>{"on", "on", "off", "off"}));
  EXPECT_EQ(words_in(folder_ / "study.csv", "friction_static"),
            (std::vector<std::string>{"0.2", "0.25", "0.2", "0.25"}));
  EXPECT_EQ(tables.cases()[2]["rotation"], "off");
  EXPECT_EQ(tables.cases()[2]["friction_static"], 0.2);
}

TEST(StudyVary, an_entry_that_every_case_sets_may_be_missing_in_the_scene) {
  EXPECT_EQ(plan_with({"Specimen/Sphere radius =", "Study/Vary 1 = Specimen/Sphere radius: 2 mm, 2.2 mm"})
                .cases.size(),
            2u);
}

TEST(StudyVary, what_varies_nothing_that_can_be_run_is_refused_by_name) {
  EXPECT_NE(refusal({}).find("Study/Vary 1 is not set: nothing is varied"), std::string::npos) << refusal({});
  const std::string unknown = refusal({"Study/Vary 2 = Platens/Frction static: 1"});
  EXPECT_NE(unknown.find("Study/Vary 2 = Platens/Frction static: 1 names Platens/Frction static, which is no "
                         "entry of this scene. Did you mean \"Platens/Friction static\"?"),
            std::string::npos)
      << unknown;
  EXPECT_NE(refusal({"Study/Vary 1 = Specimen/Height"}).find("varies no entry"), std::string::npos);
  EXPECT_NE(refusal({"Study/Vary 1 = Scene/Seed: 1, 2"}).find("which is of the study itself"),
            std::string::npos);
  EXPECT_NE(refusal({"Study/Vary 1 = Specimen/Height: 9 mm, 9 mm"}).find("holds 9 mm twice"),
            std::string::npos);
  EXPECT_NE(refusal({"Study/Vary 1 = Specimen/Height: 9 mm", "Study/Vary 2 = Specimen/Height: 8 mm"})
                .find("a second time"),
            std::string::npos);
  EXPECT_NE(refusal({"Study/Vary 1 = Platens/Friction static: 0.2, -1"}).find("friction_static_-1"),
            std::string::npos);
}

} // namespace
} // namespace platen::apps::testing
