// Accuracy on order: what a target runs, what it leaves, how it goes on.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "apps/scene/errors.h"
#include "apps/study/target_figures.h"
#include "apps/study_runs.h"

namespace platen::apps::testing {
namespace {

const Words base{"Loading/Stop at residual = 0.5", "Study/Wave crossings list = 2, 4, 8"};
const std::string is_gain = "Study/Target/Figure = gain",
                  over_free_ends =
                      "Study/Target/Over = Platens/Friction static=0, Platens/Friction dynamic = 0";

StudyPlan target_plan(const Words &entries) {
  return plan_of(StudyKind::target, with(base, entries));
}

TEST(TargetCases, are_the_scene_at_each_speed_and_what_a_gain_is_over) {
  const StudyPlan plan =
      target_plan({is_gain, over_free_ends, "Study/Target/Step seeds = 2", "Study/Target/Coarser seeds = 2"});
  EXPECT_EQ(names_of(plan), (Words{"wave_crossings_2", "wave_crossings_4", "wave_crossings_8",
                                   "over_wave_crossings_2", "over_wave_crossings_4", "over_wave_crossings_8",
                                   "half_step_wave_crossings_2", "half_step_over_wave_crossings_2",
                                   "coarser_wave_crossings_2", "coarser_over_wave_crossings_2"}));
  EXPECT_EQ(plan.seeds, (std::vector<unsigned long>{3, 4, 5, 6, 7}));
  const Scene over = led_to(plan.cases[4], 9, base);
  EXPECT_EQ(over.loading.wave_transits, 4);
  EXPECT_TRUE(std::isnan(over.loading.rate));
  EXPECT_EQ(over.platens.both.friction_static, 0);
  EXPECT_EQ(over.general.seed, 9u);
  EXPECT_FALSE(over.section.has_value()); // runs do not know what they are for
  EXPECT_DOUBLE_EQ(led_to(plan.cases[8], 3, base).specimen.sphere_radius, 2.5e-3);
  for (std::size_t k = 0; k < plan.cases.size(); ++k) // what the scene expects is of itself alone
    EXPECT_EQ(plan.cases[k].is_expected, k < 3) << plan.cases[k].name;
}

// Another file with a step, spheres and a residual of its own.
class OverScene : public ScratchFolder {
protected:
  Words gain_over(const std::string &text) {
    put(folder_ / "over.prm", "include " + test_scene("study.prm") + "\n" + text);
    return {is_gain, "Study/Target/Over scene = " + (folder_ / "over.prm").string(),
            "Study/Target/Step seeds = 2", "Study/Target/Coarser seeds = 2"};
  }
};

TEST_F(OverScene, halves_its_own_step_and_coarsens_its_own_spheres) {
  const StudyPlan plan =
      target_plan(gain_over("subsection Integration\n  set Safety = 0.4\nend\n"
                            "subsection Specimen\n  set Sphere radius = 2.4 mm\nend\n"));
  const auto run_by = [&](std::size_t k) { return led_to(plan.cases[k], 3, base); };
  const TargetCases cases{3, 2, true, true};
  EXPECT_EQ(run_by(cases.at(0, 2)).specimen.sphere_radius, 2e-3);
  EXPECT_EQ(run_by(cases.at(1, 2)).specimen.sphere_radius, 2.4e-3);
  EXPECT_EQ(run_by(cases.at(1, 2)).loading.wave_transits, 8);
  const double safety = run_by(cases.at(0, 0)).time_step.safety;
  EXPECT_DOUBLE_EQ(run_by(cases.of_half_step(0)).time_step.safety, safety / 2);
  EXPECT_DOUBLE_EQ(run_by(cases.of_half_step(1)).time_step.safety, 0.2);
  EXPECT_DOUBLE_EQ(run_by(cases.of_coarser(0)).specimen.sphere_radius, 2.5e-3);
  EXPECT_DOUBLE_EQ(run_by(cases.of_coarser(1)).specimen.sphere_radius, 3e-3);
}

TEST_F(OverScene, without_a_strength_is_refused) {
  const auto says = [&](const std::string &text) {
    return message_of<InputError>([&] { target_plan(gain_over(text)); });
  };
  std::string message = says("subsection Loading\n  set Test = hydrostatic\nend\n");
  EXPECT_TRUE(contains(message, "over_wave_crossings_2, which cannot be run")) << message;
  message = says("subsection Integration\n  set Time step = 1e-8 s\nend\n");
  EXPECT_TRUE(contains(message, "a gain is over a scene that has none")) << message;
  EXPECT_TRUE(contains(message, "over.prm:3: error: Integration/Time step = 1e-8 s")) << message;
}

void add(TargetFigures &figures, std::size_t of, std::size_t packing, double strength, double steps) {
  TestRun run;
  run.of = of;
  RunOutcome outcome;
  outcome.done = true;
  outcome.summary = {{"strength_pa", strength},
                     {"peak_reached", strength > 0},
                     {"particles", 100},
                     {"steps", steps},
                     {"wall_seconds", 2}};
  figures.add(run, packing, outcome);
}

TEST(TargetFigures, a_gain_is_a_difference_on_one_packing_and_costs_both_runs) {
  TargetFigures figures(study_scene(with(base, {is_gain, over_free_ends})));
  add(figures, 0, 0, 60e6, 1000), add(figures, 3, 0, 40e6, 900);
  add(figures, 1, 0, 58e6, 1800), add(figures, 4, 0, -1, 1700); // it never peaked
  add(figures, 1, 1, 58e6, 2000), add(figures, 4, 1, 40e6, 1700);
  const TargetRuns runs = figures.runs();
  EXPECT_NEAR(runs.logs[0][0], std::log(1.5), 1e-12);
  EXPECT_TRUE(std::isnan(runs.logs[0][1]));
  EXPECT_NEAR(runs.logs[1][1], std::log(58.0 / 40), 1e-12);
  EXPECT_EQ(figures.without_figure(), 1u);
  const TargetCosts costs = figures.costs();
  EXPECT_DOUBLE_EQ(costs.runs[0], 100 * (1000 + 900));
  EXPECT_DOUBLE_EQ(costs.runs[1], 100 * (1900 + 1700));
  EXPECT_DOUBLE_EQ(costs.runs[2], 100 * (3700 + 3300)); // on the lines through 2 and 4
  EXPECT_EQ(figures.seconds(), 12);
}

TEST(TargetFigures, half_the_step_is_compared_packing_by_packing) {
  TargetFigures figures(
      study_scene(with(base, {"Study/Target/Step seeds = 3", "Study/Target/Coarser seeds = 2"})));
  for (std::size_t s = 0; s < 3; ++s) {
    const double strength = 40e6 * std::exp(0.1 * static_cast<double>(s));
    add(figures, 0, s, strength, 1000);
    add(figures, 3, s, strength * std::exp(0.01 + (s == 0 ? 0.001 : s == 1 ? -0.001 : 0)), 2000);
  }
  const auto step = figures.of_half_step();
  ASSERT_TRUE(step);
  EXPECT_NEAR(step->mean, 0.01, 1e-12);
  EXPECT_NEAR(step->error, 0.001 / std::sqrt(3), 1e-12);
  EXPECT_TRUE(step->is_certain(0.9));
  EXPECT_FALSE(figures.of_coarser());
  add(figures, 4, 0, 40e6, 500), add(figures, 4, 1, 40e6, 500);
  EXPECT_NEAR(figures.of_coarser()->mean, -0.1, 1e-12);
}

// docs/accuracy.md: strengths of 60 runs of 5 018 spheres and of 360 of 728, gains of six packings of 5 021.
TEST(TargetPrior, expects_what_concrete_was_measured_to_scatter_by) {
  const SpreadPrior large = expected_spread(TargetFigure::strength, 5018),
                    small = expected_spread(TargetFigure::strength, 728);
  EXPECT_NEAR(std::sqrt(large.about.packing), 0.0255, 0.002);
  EXPECT_NEAR(std::sqrt(large.about.chaos), 0.0099, 0.001);
  EXPECT_NEAR(std::sqrt(small.about.packing), 0.06, 0.005);
  const SpreadPrior modulus = expected_spread(TargetFigure::modulus, 5018),
                    gain = expected_spread(TargetFigure::gain, 5021);
  EXPECT_NEAR(std::sqrt(modulus.about.packing), 0.016, 0.001);
  EXPECT_NEAR(std::sqrt(modulus.about.chaos), 0.003, 0.0005);
  EXPECT_NEAR(std::sqrt(gain.about.packing), 0.0172, 0.001);
  EXPECT_NEAR(std::sqrt(gain.about.chaos), 0.0094, 0.001);
  // At one speed gains of cubes of 905 spheres scatter by 5 %, bench/results/calibration.md.
  EXPECT_NEAR(std::sqrt(expected_spread(TargetFigure::gain, 905).about.total()), 0.05, 0.005);
  for (const SpreadPrior &prior : {large, modulus, gain}) { // guesses of other scenes
    EXPECT_LE(prior.sum_freedom, 2);
    EXPECT_LE(prior.ratio_freedom, 5);
  }
  // Haste of 1.5, above the 0.5 to 1.3 that were measured: c is of the size of b^2.
  EXPECT_DOUBLE_EQ(expected_errors(TargetFigure::strength, 5018).curvature, 1.5 * 1.5);
}

const Words modulus = set(with(base, {"Study/Target/Figure = youngs modulus", "Study/Target/Accuracy = 10 %",
                                      "Study/Target/Pilot seeds = 3", "Loading/Target strain = 0.03"}));

// All but seconds.
Json lasting(Json study) {
  study.erase("costs");
  return study;
}

TEST_F(Study, of_target_ends_where_the_interval_is_as_narrow_as_was_ordered) {
  ASSERT_EQ(run("a", modulus, "target").status, 0) << content_of(folder_ / "error.txt");
  const Json study = json("a"), target = study["target"];
  EXPECT_EQ(target["verdict"], "reached");
  EXPECT_LE(target["half_interval"], 0.1);
  EXPECT_GT(target["mean"], 10e9);
  EXPECT_NEAR(std::log(target["high"].get<double>() / target["mean"].get<double>()),
              target["half_interval"].get<double>(), 1e-12);
  double squares = 0;
  for (const Json &part : target["parts"])
    squares += std::pow(part.get<double>(), 2);
  EXPECT_NEAR(std::sqrt(squares), target["half_interval"].get<double>(), 1e-12);
  EXPECT_EQ(words_in(folder_ / "a/study.csv", "case").size(), study["runs"].get<std::size_t>());
  EXPECT_EQ(target["looks"].back()["runs"], study["runs"]);
  EXPECT_GT(study["costs"]["core_seconds"], 0);
  // On two at a time, and after a run was lost, the same bytes.
  ASSERT_EQ(run("b", with(modulus, {"-t", "2"}), "target").status, 0);
  EXPECT_EQ(table("b"), table("a"));
  EXPECT_EQ(lasting(json("b")), lasting(study));
  fs::remove(folder_ / "b/runs/wave_crossings_4_seed_4/summary.json");
  fs::remove(folder_ / "b/study.csv");
  ASSERT_EQ(run("b", with(modulus, {"--resume"}), "target").status, 0);
  EXPECT_EQ(table("b"), table("a"));
  EXPECT_EQ(lasting(json("b")), lasting(study));
}

TEST_F(Study, of_target_plans_by_its_pilot_and_goes_on_when_more_is_allowed) {
  Outcome told = run("a", with(modulus, {"--dry-run"}), "target");
  EXPECT_EQ(told.status, 0);
  EXPECT_TRUE(contains(told.out, "no plan can be made yet: 0 of 6 runs of the pilot are there")) << told.out;
  EXPECT_FALSE(fs::exists(folder_ / "a"));
  expect(1, "the accuracy of 10 % was not reached", "a", with(modulus, set({"Study/Target/Most runs = 6"})),
         "target");
  told = run("a", with(modulus, {"--dry-run"}), "target");
  EXPECT_EQ(told.status, 0);
  for (const char *words : {"by 6 runs that are there", "plan, packings at so many wave crossings: 2: ",
                            "(3 there)", "s of one core more; predicted +- "})
    EXPECT_TRUE(contains(told.out, words)) << told.out;
  expect(0, "", "a", with(modulus, {"--resume"}), "target");
  expect(0, "", "straight", modulus, "target");
  EXPECT_EQ(table("a"), table("straight"));
  EXPECT_EQ(lasting(json("a")), lasting(json("straight")));
  expect(2, "Study/Target/Pilot seeds = 4 was 3", "a",
         with(modulus, {"--resume", "-s", "Study/Target/Pilot seeds = 4"}), "target");
}

TEST_F(Study, of_target_runs_both_scenes_of_a_gain) {
  const Words gain =
      set(with(base, {is_gain, over_free_ends, "Study/Target/Accuracy = 50 %", "Study/Target/Pilot seeds = 3",
                      "Study/Target/Most runs = 12", "Loading/Target strain = 0.05"}));
  const int status = run("a", gain, "target").status;
  EXPECT_TRUE(status == 0 || status == 1) << content_of(folder_ / "error.txt");
  const Words cases = words_in(folder_ / "a/study.csv", "case");
  EXPECT_EQ(cases[1], "over_wave_crossings_2");
  EXPECT_EQ(json("a")["target"]["figure"], "gain of strength");
  // Each packing at each speed in both scenes: two of them at two speeds at least, which tell an interval.
  const int runs = json("a")["runs"];
  EXPECT_LE(runs, 12);
  EXPECT_GE(runs, 8);
  const auto over = std::count_if(cases.begin(), cases.end(),
                                  [](const std::string &name) { return name.rfind("over_", 0) == 0; });
  EXPECT_EQ(static_cast<int>(cases.size()), runs);
  EXPECT_EQ(2 * over, runs);
}

} // namespace
} // namespace platen::apps::testing
