// The study of accuracy: what it plans, how it counts errors, what it leaves.
#include <gtest/gtest.h>

#include <cmath>

#include "apps/study/accuracy.h"
#include "apps/study_runs.h"

namespace platen::apps::testing {
namespace {

StudyPlan accuracy_plan(const Words &entries) {
  return plan_of(StudyKind::accuracy, with(entries, {"Loading/Stop at residual = 0.5"}));
}

Words without_radii(const Words &entries) {
  return with(entries, {no_radii});
}

TEST(AccuracyPlan, each_list_is_run_alone_and_what_the_scene_has_is_run_once) {
  const StudyPlan plan =
      accuracy_plan({"Study/Safety list = 0.9, 0.8, 0.2", "Study/Axial rate list = 0.6 m/s, 0.3",
                     "Study/Effects list = Effects/Rotation=off, Bond/Damping = 0.1"});
  EXPECT_EQ(names_of(plan), (Words{"safety_0.9", "base", "safety_0.2", "axial_rate_0.6",
                                   "sphere_radius_1.4_mm", "effects_rotation_off", "bond_damping_0.1"}));
  ASSERT_EQ(plan.parameters.size(), 4u);
  const auto cases_of = [&](std::size_t k) {
    std::vector<std::size_t> cases;
    for (const StudiedParameter::Value &value : plan.parameters[k].values)
      cases.push_back(value.of_case);
    return cases;
  };
  EXPECT_EQ(cases_of(0), (std::vector<std::size_t>{0, 1, 2}));
  EXPECT_EQ(cases_of(1), (std::vector<std::size_t>{3, 1}));
  EXPECT_EQ(cases_of(2), (std::vector<std::size_t>{1, 4})); // 2 mm is the scene's
  EXPECT_EQ(cases_of(3), (std::vector<std::size_t>{5, 6, 1}));
  EXPECT_EQ(plan.cases[3].overrides, (Words{"Loading/Axial rate = 0.6 m/s"}));
  EXPECT_EQ(plan.cases[5].overrides, (Words{"Effects/Rotation = off"}));
  EXPECT_EQ(plan.varied,
            (Words{"safety", "axial_rate_m_s", "wave_crossings", "hurry", "mass_scaling", "sphere_radius_m",
                   "elements_across", "steps_per_solve", "sleeve_elements_around", "sleeve_mass_scaling"}));
  EXPECT_EQ(plan.cases[3].labels[0], 0.8);
  EXPECT_EQ(plan.cases[3].labels[1], 0.6);
  EXPECT_EQ(plan.cases[3].labels[5], 0.002);
  for (const std::size_t k : {2u, 6u, 9u})
    EXPECT_TRUE(std::isnan(plan.cases[3].labels[k])); // not what decides in this scene
  EXPECT_TRUE(plan.parameters[0].ordered);
  EXPECT_FALSE(plan.parameters[3].ordered);
}

TEST(AccuracyPlan, meshes_and_solves_of_bodies_are_varied_where_there_are_bodies) {
  const StudyPlan plan = accuracy_plan(without_radii(
      {"Platens/Kind = deformable", "Platens/Motion = quasi-static", "Study/Platen mesh list = 4, 8",
       "Study/Steps per solve list = 20, 1", "Study/Mass scaling list = 10, 1"}));
  EXPECT_EQ(names_of(plan), (Words{"mass_scaling_10", "base", "platen_mesh_4", "steps_per_solve_1"}));
  const StudyPlan sleeve = accuracy_plan(
      without_radii({"Loading/Confinement = sleeve", "Loading/Confining pressure = 1 MPa",
                     "Study/Sleeve mesh list = 12, 24", "Study/Sleeve mass scaling list = 100, 10"}));
  EXPECT_EQ(names_of(sleeve),
            (Words{"sleeve_mesh_12", "sleeve_mesh_24", "sleeve_mass_scaling_100", "sleeve_mass_scaling_10"}));
}

TEST(AccuracyPlan, words_of_quality_are_cases_where_the_scene_leaves_their_entries_open) {
  const Words open{"Loading/Axial rate =", "Scene/Quality = standard",
                   "Study/Quality list = fast, standard, reference", "Study/Wave crossings list = 60, 240"};
  const StudyPlan plan = accuracy_plan(without_radii(open));
  EXPECT_EQ(names_of(plan), (Words{"base", "wave_crossings_240", "quality_fast", "quality_reference"}));
  const Scene fast = led_to(plan.cases[2], 3, open);
  EXPECT_EQ(fast.time_step.safety, 0.95);
  EXPECT_EQ(fast.loading.wave_transits, 30);
}

// A plan of one parameter with five values and two seeds, and runs made up for it.
class MadeUp : public ::testing::Test {
protected:
  StudyPlan plan_ = accuracy_plan(without_radii({"Study/Safety list = 0.9, 0.8, 0.4, 0.2, 0.1"}));
  Outcomes outcomes_ = Outcomes(plan_.cases.size());

  void add(std::size_t of, double strength, double seconds, double broken = 100) {
    RunOutcome outcome;
    outcome.done = true;
    outcome.summary = {{"strength_pa", strength},        {"strain_at_peak_platen", 2e-3},
                       {"peak_reached", true},           {"youngs_modulus_gauge_pa", 20e9},
                       {"broken_tension", broken},       {"broken_shear", 0},
                       {"wall_seconds", seconds},        {"steps", 1000},
                       {"kinetic_to_internal_max", 1e-3}};
    if (std::isnan(strength)) outcome.summary["peak_reached"] = false;
    outcomes_[of].push_back(outcome);
  }
};

TEST_F(MadeUp, errors_are_taken_seed_by_seed_and_the_scatter_is_that_of_the_reference) {
  add(0, 44e6, 1), add(0, 60e6, 1, 90);
  for (std::size_t k = 1; k < 4; ++k)
    add(k, 40e6, 2), add(k, std::nan(""), 2);
  add(4, 40e6, 8), add(4, 50e6, 8);
  const ParameterErrors of = errors_of(plan_, outcomes_).at(0);
  EXPECT_NEAR(of.values[0].of(Measure::strength).mean(), 0.15, 1e-12); // +10 % and +20 %
  EXPECT_NEAR(of.values[0].of(Measure::strength).root_mean_square(), std::sqrt(0.025), 1e-12);
  EXPECT_NEAR(of.values[0].of(Measure::broken_bonds).mean(), -0.05, 1e-12);
  EXPECT_EQ(of.values[1].of(Measure::strength).count(), 1u); // a run without a peak has no strength
  EXPECT_EQ(of.values[1].of(Measure::strain_at_peak).count(), 1u);
  EXPECT_EQ(of.values[1].of(Measure::broken_bonds).count(), 2u);
  EXPECT_EQ(of.values[4].of(Measure::strength).root_mean_square(), 0); // the reference against itself
  EXPECT_NEAR(of.scatter_of(Measure::strength), std::sqrt(50.0) / 45, 1e-12);
  EXPECT_EQ(of.scatter_of(Measure::modulus), 0);
}

TEST_F(MadeUp, what_a_coarse_value_hits_by_chance_is_no_accuracy) {
  const double strengths[] = {40.1e6, 41.9e6, 40.3e6, 40.08e6, 40e6}, seconds[] = {1, 2, 3, 5, 8};
  for (std::size_t k = 0; k < 5; ++k)
    for (int seed = 0; seed < 2; ++seed)
      add(k, strengths[k], seconds[k]);
  const ParameterErrors of = errors_of(plan_, outcomes_).at(0);
  EXPECT_EQ(cheapest_within(of, Measure::strength, 0.05), 0u);
  EXPECT_EQ(cheapest_within(of, Measure::strength, 0.01), 2u); // not 0.9, which is within 0.25 %
  EXPECT_EQ(cheapest_within(of, Measure::strength, 0.003), 3u);
  EXPECT_FALSE(cheapest_within(of, Measure::strength, 0.001));
  const std::string text = text_of(plan_, {of});
  EXPECT_TRUE(contains(text,
                       "strength: 5 % costs 1 s (0.9), 2 % costs 3 s (0.4), 1 % costs 3 s (0.4); 0.1 % "
                       "not reached: 0.2 % at 0.2, 5 s"))
      << text;
  const Json costs = costs_of(plan_, {of});
  EXPECT_EQ(costs["prices"][2]["value"], "0.4");
  EXPECT_EQ(costs["prices"][2]["seconds"], 3);
  EXPECT_TRUE(costs["prices"][3]["value"].is_null());
}

TEST_F(MadeUp, a_value_that_failed_on_a_seed_is_not_known_to_be_accurate) {
  for (std::size_t k = 0; k < 5; ++k) {
    add(k, 40e6, 8 - static_cast<double>(k));
    add(k, k == 2 ? std::nan("") : 41e6, 8 - static_cast<double>(k));
  }
  const ParameterErrors of = errors_of(plan_, outcomes_).at(0);
  EXPECT_EQ(cheapest_within(of, Measure::strength, 0.01), 3u);
  EXPECT_EQ(cheapest_within(of, Measure::broken_bonds, 0.01), 3u); // all are; that one is the cheapest
}

const Words small_accuracy =
    set({no_radii, "Study/Safety list = 0.8, 0.4", "Study/Effects list = Effects/Energy ledger = off",
         "Loading/Target strain = 0.03"});

TEST_F(Study, of_accuracy_tells_errors_of_each_knob_and_what_they_cost) {
  ASSERT_EQ(run("one", small_accuracy, "accuracy").status, 0) << content_of(folder_ / "error.txt");
  const fs::path csv = folder_ / "one/accuracy.csv";
  EXPECT_EQ(words_in(csv, "knob"),
            (Words{"safety", "safety", "safety", "safety", "effects", "effects", "effects", "effects"}));
  EXPECT_EQ(column_of(csv, "seed"), (std::vector<double>{3, 4, 3, 4, 3, 4, 3, 4}));
  const std::vector<double> strength = column_of(csv, "strength_error"), steps = column_of(csv, "steps");
  EXPECT_NE(strength[0], 0);
  for (const std::size_t row : {2u, 3u, 6u, 7u})
    EXPECT_EQ(strength[row], 0); // references
  for (const std::size_t row : {4u, 5u})
    EXPECT_EQ(strength[row], 0);       // the ledger looks on and changes nothing
  EXPECT_GT(steps[2], 1.3 * steps[0]); // half the step, though where it ends is not the same
  const std::vector<double> csv_of_runs = column_of(folder_ / "one/study.csv", "strength_pa");
  EXPECT_DOUBLE_EQ(strength[0], csv_of_runs[0] / csv_of_runs[2] - 1);
  const auto study = json("one");
  EXPECT_EQ(study["accuracy"][0]["reference"], "0.4");
  EXPECT_NEAR(study["accuracy"][0]["values"][0]["errors"]["strength"]["mean"].get<double>(),
              (strength[0] + strength[1]) / 2, 1e-12);
  EXPECT_EQ(study["accuracy"][1]["reference"], "the scene as it is");
  EXPECT_GT(study["costs"]["wall_seconds"][0]["mean"], 0);

  ASSERT_EQ(run("two", with(small_accuracy, {"-t", "2"}), "accuracy").status, 0);
  EXPECT_EQ(content_of(folder_ / "two/accuracy.csv"), content_of(csv));
  EXPECT_EQ(json("two")["accuracy"], study["accuracy"]);
  fs::remove(folder_ / "two/runs/safety_0.4_seed_3/summary.json");
  fs::remove(folder_ / "two/accuracy.csv");
  ASSERT_EQ(run("two", with(small_accuracy, {"--resume"}), "accuracy").status, 0);
  EXPECT_EQ(content_of(folder_ / "two/accuracy.csv"), content_of(csv));
}

TEST_F(Study, of_accuracy_crosses_the_specimen_as_often_as_was_asked_for) {
  expect(0, "", "a",
         set({no_radii, "Study/Seeds = 1", "Loading/Axial rate =", "Loading/Wave crossings = 6",
              "Study/Wave crossings list = 3, 6", "Loading/Target strain = 0.03"}),
         "accuracy");
  const fs::path csv = folder_ / "a/study.csv";
  const std::vector<double> crossings = column_of(csv, "wave_crossings_to_peak"),
                            asked = column_of(csv, "wave_crossings"),
                            strain = column_of(csv, "strain_at_peak_platen");
  ASSERT_EQ(asked, (std::vector<double>{3, 6}));
  for (std::size_t k = 0; k < 2; ++k) // the ramp takes ten crossings for the way of five
    EXPECT_NEAR(crossings[k], asked[k] * strain[k] / 1e-3 + 5, 0.1);
}

} // namespace
} // namespace platen::apps::testing
