// An accuracy that was ordered: that it is reached, and that its interval holds the truth as often as it
// says, though the study ends where the interval is narrow.
#include "apps/study/target_decision.h"

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

Ended study(MadeUpRuns &drawn, const Aim &aim, std::size_t runs_at_most = most_runs) {
  Ended ended;
  drawn.begin(ended.state, speeds);
  drawn.make(ended.state, {5, 5, 0, 0});
  do {
    ended.last = decide(ended.state, costs_of_cylinder(speeds), aim, runs_at_most);
    drawn.make(ended.state, ended.last.next);
  } while (ended.last.verdict == Verdict::more);
  return ended;
}

// Binomial deviation of 300 studies: 1.7 %.
TEST(TargetDecision, ordered_accuracies_hold_the_truth_as_often_as_they_say) {
  const MadeUpFigure figures[] = {{}, {3.0, 0.7, 1, 0.01, 0.02}, {3.0, 1.5, 1, 0.03, 0.005}};
  for (const MadeUpFigure &figure : figures) {
    constexpr int studies = 300;
    const Aim aim{0.02, 0.9, 0, 200};
    MadeUpRuns drawn(figure, 7);
    int held = 0;
    for (int k = 0; k < studies; ++k) {
      const Ended ended = study(drawn, aim);
      ASSERT_EQ(ended.last.verdict, Verdict::reached);
      ASSERT_LE(ended.last.half, aim.accuracy);
      held += std::abs(ended.last.estimate->mean - figure.mean) <= ended.last.half;
    }
    EXPECT_GT(held, 0.86 * studies) << figure.packing;
  }
}

TEST(TargetDecision, runs_end_where_no_more_are_allowed) {
  MadeUpRuns drawn({}, 3);
  const Ended ended = study(drawn, {0.005, 0.9, 0, 400}, 23);
  EXPECT_EQ(ended.last.verdict, Verdict::out_of_runs);
  EXPECT_EQ(std::accumulate(ended.state.made.begin(), ended.state.made.end(), std::size_t{0}), 23u);
  EXPECT_GT(ended.last.half, 0.005);
  ASSERT_TRUE(ended.last.plan); // what it would still take
  EXPECT_GT(ended.last.plan->cost, 0);
}

TEST(TargetDecision, without_figures_nothing_is_known) {
  TargetState state;
  MadeUpRuns({}, 1).begin(state, speeds);
  EXPECT_EQ(decide(state, costs_of_cylinder(speeds), {0.02, 0.9, 0, 10}, 10).verdict, Verdict::unknown);
}

} // namespace
} // namespace platen::apps::testing
