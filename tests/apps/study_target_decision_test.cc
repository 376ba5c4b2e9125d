// An accuracy that was ordered: that it is reached, and that its interval holds the truth as often as it
// says, though the study ends where the interval is narrow.
#include "apps/study/target_plan.h"

#include <gtest/gtest.h>

#include <numeric>

#include "apps/target_studies.h"

namespace platen::apps::testing {
namespace {

const std::vector<double> speeds{15, 30, 60, 120};
constexpr std::size_t most_runs = 400;

struct Ended {
  Decision last;
  TargetState state;
};

// With what is known of the spread beforehand, and no more packings in the first batch than these.
Ended study(MadeUpRuns &drawn, const Aim &aim, const SpreadPrior &prior,
            std::size_t runs_at_most = most_runs) {
  Ended ended;
  drawn.begin(ended.state, speeds);
  ended.state.errors = {prior.about, prior, 2.25};
  const TargetCosts costs = costs_of_cylinder(speeds);
  drawn.make(ended.state, pilot_of(ended.state, costs, aim));
  do {
    ended.last = decide(ended.state, costs, aim, runs_at_most);
    drawn.make(ended.state, ended.last.next);
  } while (ended.last.verdict == Verdict::more);
  return ended;
}

// As apps/study/target_prior.cc has it.
SpreadPrior prior_of(double packing, double chaos) {
  return {{packing * packing, chaos * chaos}, 1, 4};
}

// Of so many studies of which the scatter is so many times what is expected.
double share_that_holds(double accuracy, double times, int studies, const SpreadPrior &prior) {
  const MadeUpFigure figure{3.7, 1.3, 1, 0.024 * times, 0.01 * times};
  MadeUpRuns drawn(figure, 7);
  int held = 0;
  for (int k = 0; k < studies; ++k) {
    const Ended ended = study(drawn, {accuracy, 0.9, 0, 300, 5}, prior);
    EXPECT_EQ(ended.last.verdict, Verdict::reached);
    EXPECT_LE(ended.last.half, accuracy);
    held += std::abs(ended.last.estimate->mean - figure.mean) <= ended.last.half;
  }
  return static_cast<double>(held) / studies;
}

// Binomial deviation of 400 studies: 1.5 %.
TEST(TargetDecision, ordered_accuracies_hold_the_truth_as_often_as_they_say) {
  EXPECT_GT(share_that_holds(0.05, 1, 400, prior_of(0.024, 0.01)), 0.88);
  EXPECT_GT(share_that_holds(0.02, 1, 400, prior_of(0.024, 0.01)), 0.88);
}

TEST(TargetDecision, scatter_of_another_size_than_expected_is_found_out) {
  for (const double times : {1.0 / 3, 0.5, 2.0, 3.0})
    EXPECT_GT(share_that_holds(0.05, times, 400, prior_of(0.024, 0.01)), 0.83) << times;
}

// Were the prior's weight ten times as large, data of some packings would not outweigh it.
TEST(TargetDecision, a_prior_that_data_do_not_outweigh_misses_the_truth) {
  SpreadPrior sure = prior_of(0.024, 0.01);
  sure.sum_freedom *= 10, sure.ratio_freedom *= 10;
  EXPECT_LT(share_that_holds(0.05, 3, 200, sure), 0.75);
}

TEST(TargetDecision, runs_end_where_no_more_are_allowed) {
  MadeUpRuns drawn({}, 3);
  const Ended ended = study(drawn, {0.005, 0.9, 0, 400, 5}, prior_of(0.02, 0.015), 23);
  EXPECT_EQ(ended.last.verdict, Verdict::out_of_runs);
  EXPECT_EQ(std::accumulate(ended.state.made.begin(), ended.state.made.end(), std::size_t{0}), 23u);
  EXPECT_GT(ended.last.half, 0.005);
  ASSERT_TRUE(ended.last.plan); // what it would still take
  EXPECT_GT(ended.last.plan->cost, 0);
}

TEST(TargetDecision, what_errs_beside_the_runs_and_the_haste_of_scenes_widen_the_interval) {
  TargetState state;
  MadeUpRuns drawn({}, 1);
  drawn.begin(state, speeds);
  drawn.make(state, {4, 0, 4, 0});
  state.errors.prior = prior_of(0.02, 0.015);
  const TargetCosts costs = costs_of_cylinder(speeds);
  constexpr double others = 1e-4, haste_of_scenes = 9;
  const Decision decision = decide(state, costs, {0.2, 0.9, others, 10, 5}, 10, haste_of_scenes);
  ASSERT_TRUE(decision.estimate);
  EXPECT_EQ(decision.estimate->errors.curvature, haste_of_scenes);
  EXPECT_EQ(state.errors.curvature, haste_of_scenes);
  EXPECT_DOUBLE_EQ(decision.half, half_interval(decision.estimate->precision, 0.93, others));
}

TEST(TargetDecision, runs_beyond_those_allowed_are_taken_off_where_most_are_asked_for) {
  EXPECT_EQ(within({9, 4, 0}, {4, 4, 0}, 20), (Counts{9, 4, 0}));
  EXPECT_EQ(within({9, 6, 0}, {4, 4, 0}, 11), (Counts{5, 6, 0}));
  EXPECT_EQ(within({5, 0, 5}, {0, 0, 0}, 4), (Counts{2, 0, 2})); // of a pilot
  EXPECT_EQ(within({9, 6, 0}, {4, 4, 0}, 3), (Counts{4, 4, 0})); // what is there stays
}

TEST(TargetDecision, without_figures_nothing_is_known) {
  TargetState state;
  MadeUpRuns({}, 1).begin(state, speeds);
  const TargetCosts costs = costs_of_cylinder(speeds);
  EXPECT_EQ(decide(state, costs, {0.02, 0.9, 0, 10}, 10).verdict, Verdict::unknown);
  MadeUpRuns({}, 1).make(state, {2, 0, 2, 0});
  state.runs.logs[1][2] = std::nan(""); // never peaked: another packing is run
  const Decision more = decide(state, costs, {0.02, 0.9, 0, 10, 5}, 10);
  EXPECT_EQ(more.verdict, Verdict::more);
  EXPECT_EQ(more.next, (Counts{3, 0, 3, 0}));
  EXPECT_EQ(decide(state, costs, {0.02, 0.9, 0, 10, 2}, 10).verdict, Verdict::unknown);
}

} // namespace
} // namespace platen::apps::testing
