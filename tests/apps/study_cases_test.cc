// What studies run: cases of sizes and of any entries, and of the scenes as they are given.
#include <gtest/gtest.h>

#include <cmath>
#include <regex>

#include "apps/scene/errors.h"
#include "apps/study/study_section.h"
#include "apps/study/tables.h"
#include "apps/study_runs.h"

namespace platen::apps::testing {
namespace {

TEST(StudyPlan, where_no_size_is_given_they_are_in_proportion_to_the_specimen) {
  for (const double times : {1.0, 10.0, 0.1}) {
    const Words entries{fmt::format("Specimen/Height = {:.12g} m", 0.08 * times),
                        fmt::format("Specimen/Radius = {:.12g} m", 0.025 * times),
                        fmt::format("Specimen/Sphere radius = {:.12g} m", 0.001 * times),
                        "Study/Sphere radius list ="};
    const StudyPlan plan = plan_of(StudyKind::size, entries);
    ASSERT_EQ(plan.cases.size(), 4u);
    for (const auto &[k, radius] : {std::pair{0u, 0.0005}, {1u, 0.00075}, {2u, 0.001}, {3u, 0.00125}})
      EXPECT_DOUBLE_EQ(plan.cases[k].labels[0], radius * times) << times;
  }
}

TEST(StudyPlan, sizes_of_the_thesis_are_six_cases) {
  const Words entries{"Specimen/Height = 80 mm", "Specimen/Radius = 25 mm", "Specimen/Sphere radius = 1 mm",
                      "Study/Sphere radius list = 0.5 mm, 0.75 mm, 1 mm, 1.25 mm",
                      "Study/Domain list = 80 mm x 25 mm, 72 mm x 22.5 mm, 65 mm x 20 mm"};
  const StudyPlan plan = plan_of(StudyKind::size, entries);
  ASSERT_EQ(plan.cases.size(), 6u); // 80 mm x 25 mm at 1 mm stands in both lists
  EXPECT_EQ(plan.cases[2].name, "sphere_radius_1_mm");
  EXPECT_EQ(plan.cases[4].name, "sphere_radius_1_mm_height_72_mm_radius_22.5_mm");
  EXPECT_DOUBLE_EQ(plan.cases[4].labels[0], 0.001);
  EXPECT_DOUBLE_EQ(plan.cases[4].labels[1], 0.072);
  EXPECT_DOUBLE_EQ(plan.cases[4].labels[2], 0.0225);
  const Scene last = led_to(plan.cases[5], 9, entries);
  EXPECT_DOUBLE_EQ(last.specimen.height, 0.065);
  EXPECT_DOUBLE_EQ(last.specimen.radius, 0.02);
  EXPECT_DOUBLE_EQ(last.specimen.sphere_radius, 0.001);
  EXPECT_EQ(last.general.seed, 9u);
}

TEST(StudyPlan, without_lists_the_sizes_are_those_of_the_thesis) {
  const StudyPlan plan =
      plan_of(StudyKind::size, {no_radii, "Specimen/Radius = 25 mm", "Specimen/Height = 80 mm"});
  ASSERT_EQ(plan.cases.size(), 4u);
  EXPECT_EQ(plan.cases[0].labels[0], 0.0005);
  EXPECT_EQ(plan.cases[3].labels[0], 0.00125);
}

StudyPlan vary(const Words &entries) {
  return plan_of(StudyKind::vary, with({no_radii}, entries));
}

TEST(StudyVary, each_value_of_an_entry_runs_with_each_of_the_others) {
  const StudyPlan plan = vary({"Study/Vary 1 = Platens/Friction static: 0.2, 0.25",
                               "Study/Vary 3 = Specimen/Height: 9 mm, 2 cm, 15 mm"});
  EXPECT_EQ(plan.varied, (Words{"friction_static", "height_m"}));
  ASSERT_EQ(plan.cases.size(), 6u);
  EXPECT_EQ(plan.cases[4].name, "friction_static_0.25_height_2_cm");
  EXPECT_EQ(plan.cases[4].labels, (std::vector<double>{0.25, 0.02}));
  EXPECT_EQ(plan.cases[4].overrides, (Words{"Platens/Friction static = 0.25", "Specimen/Height = 2 cm"}));
  EXPECT_EQ(plan.cases[1].labels, (std::vector<double>{0.2, 0.02}));
}

TEST(StudyVary, entries_that_go_together_are_varied_together_and_with_the_others) {
  const StudyPlan plan =
      vary({"Study/Vary 1 = Specimen/Height & Loading/Axial rate: 9 mm & 5 mm/s, 2 cm & 0.01",
            "Study/Vary 2 = Effects/Rotation: on, off"});
  EXPECT_EQ(plan.varied, (Words{"height_m", "axial_rate_m_s", "rotation"}));
  ASSERT_EQ(plan.cases.size(), 4u);
  EXPECT_EQ(plan.cases[3].name, "height_2_cm_axial_rate_0.01_rotation_off");
  EXPECT_EQ(plan.cases[3].overrides,
            (Words{"Specimen/Height = 2 cm", "Loading/Axial rate = 0.01", "Effects/Rotation = off"}));
  EXPECT_DOUBLE_EQ(plan.cases[0].labels[0], 0.009);
  EXPECT_DOUBLE_EQ(plan.cases[0].labels[1], 0.005);
  EXPECT_EQ(plan.cases[3].words, (Words{"", "", "off"}));
}

TEST(StudyVary, a_word_has_its_name_and_no_number) {
  const StudyPlan plan = vary({"Study/Vary 1 = Effects/Rotation: on, off"});
  ASSERT_EQ(plan.cases.size(), 2u);
  EXPECT_EQ(plan.cases[1].name, "rotation_off");
  EXPECT_TRUE(std::isnan(plan.cases[1].labels.at(0)));
  EXPECT_EQ(plan.cases[1].words, (Words{"off"}));
}

class StudyVaryTables : public ScratchFolder {};
TEST_F(StudyVaryTables, hold_the_words_that_vary) {
  const StudyPlan plan = vary({"Study/Vary 1 = Effects/Rotation: on, off",
                               "Study/Vary 2 = Platens/Friction static: 0.2, 0.25", "Study/Seeds = 1"});
  StudyTables tables(plan, OutputPaths(folder_));
  for (std::size_t c = 0; c < plan.cases.size(); ++c) {
    TestRun run;
    run.of = c;
    run.seed = 1;
    tables.add(run, {});
  }
  EXPECT_EQ(words_in(folder_ / "study.csv", "rotation"), (Words{"on", "on", "off", "off"}));
  EXPECT_EQ(words_in(folder_ / "study.csv", "friction_static"), (Words{"0.2", "0.25", "0.2", "0.25"}));
  EXPECT_EQ(tables.cases()[2]["rotation"], "off");
  EXPECT_EQ(tables.cases()[2]["friction_static"], 0.2);
}

TEST(StudyVary, an_entry_that_every_case_sets_may_be_missing_in_the_scene) {
  EXPECT_EQ(
      vary({"Specimen/Sphere radius =", "Study/Vary 1 = Specimen/Sphere radius: 2 mm, 2.2 mm"}).cases.size(),
      2u);
}

// Of "Run: platen-study KIND ..." in the head of a scene.
std::string kind_in(const fs::path &scene) {
  std::ifstream file(scene);
  const std::regex run("platen-study ([a-z]+) scenes/" + scene.filename().string());
  std::smatch found;
  for (std::string line; std::getline(file, line);)
    if (std::regex_search(line, found, run)) return found[1];
  ADD_FAILURE() << scene << " does not say by which platen-study it is run";
  return study_words.front();
}

TEST(StudyScenes, lead_to_cases_that_can_be_run) {
  int scenes = 0;
  for (const auto &file : fs::directory_iterator(PLATEN_SCENES)) {
    if (file.path().filename().string().rfind("study_", 0) != 0) continue;
    SCOPED_TRACE(file.path());
    ++scenes;
    try {
      const Scene scene = read_scene(file.path().string(), {}, program("study"));
      EXPECT_GT(plan_study(study_kind(kind_in(file.path())), scene, {}).cases.size(), 1u);
    } catch (const InputError &error) {
      ADD_FAILURE() << error.what();
    }
  }
  EXPECT_GT(scenes, 10);
}

} // namespace
} // namespace platen::apps::testing
