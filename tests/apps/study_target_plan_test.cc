// The cheapest runs for an accuracy: against all plans there are, and closed forms.
#include "apps/study/target_plan.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "apps/target_studies.h"

namespace platen::apps::testing {
namespace {

TargetState nothing_made(const std::vector<double> &transits, const Spread &spread) {
  TargetState state;
  state.runs.transits = transits;
  state.made = Counts(transits.size(), 0);
  state.errors = {spread, {}, 1.5};
  return state;
}

double half_of(const TargetState &state, const Counts &counts, const Aim &aim) {
  const Design design = design_with(state, counts);
  const auto precision = precision_of(design, state.runs.transits, state.errors);
  return precision && tells_spread(design) ? half_interval(*precision, aim.confidence, aim.others) : 1;
}

// Of all plans of up to 14 packings at each speed.
double cheapest_of_all(const TargetState &state, const TargetCosts &costs, const Aim &aim) {
  double cheapest = 1e300;
  Counts counts(3);
  for (counts[0] = state.made[0]; counts[0] <= 14; ++counts[0])
    for (counts[1] = state.made[1]; counts[1] <= 14; ++counts[1])
      for (counts[2] = state.made[2]; counts[2] <= 14; ++counts[2]) {
        const double cost = costs.between(state.made, counts);
        if (cost < cheapest && half_of(state, counts, aim) <= aim.accuracy) cheapest = cost;
      }
  return cheapest;
}

TEST(TargetPlan, is_as_cheap_as_the_cheapest_of_all_plans) {
  const std::vector<double> transits{15, 30, 90};
  const TargetCosts costs = costs_of_cylinder(transits);
  for (const Spread &spread : {Spread{4e-4, 1e-4}, Spread{1e-4, 2e-4}, Spread{9e-4, 0.2e-4}})
    for (const double accuracy : {0.03, 0.02}) {
      const Aim aim{accuracy, 0.9, 4e-6, 100};
      TargetState state = nothing_made(transits, spread);
      for (const bool begun : {false, true}) {
        if (begun) MadeUpRuns({}, 3).make(state, {4, 4, 0});
        const auto plan = cheapest_plan(state, costs, aim);
        ASSERT_TRUE(plan);
        EXPECT_LE(plan->half, accuracy);
        EXPECT_NEAR(plan->half, half_of(state, plan->counts, aim), 1e-12);
        EXPECT_NEAR(plan->cost, costs.between(state.made, plan->counts), 1e-6);
        EXPECT_LE(plan->cost, 1.05 * cheapest_of_all(state, costs, aim))
            << spread.packing << ", " << accuracy;
      }
    }
}

TEST(TargetPlan, more_packings_are_run_fast_than_slow) {
  const std::vector<double> transits{15, 30, 60, 120};
  TargetState state = nothing_made(transits, {4e-4, 0.5e-4});
  const auto plan = cheapest_plan(state, costs_of_cylinder(transits), {0.01, 0.9, 0, 200});
  ASSERT_TRUE(plan);
  EXPECT_GT(plan->counts[0], 12u);
  std::size_t slow = 0;
  for (std::size_t k = 1; k < 4; ++k)
    slow += plan->counts[k];
  EXPECT_LT(slow, plan->counts[0]);
  EXPECT_GT(slow, 0u);
}

TEST(TargetPlan, what_no_plan_can_give_is_not_planned) {
  TargetState state = nothing_made({15, 30}, {4e-4, 1e-4});
  const TargetCosts costs = costs_of_cylinder({15, 30});
  EXPECT_FALSE(cheapest_plan(state, costs, {0.01, 0.9, 0, 10}));
  EXPECT_FALSE(cheapest_plan(state, costs, {0.002, 0.9, 4e-6, 500})); // the step's part alone is more
  EXPECT_TRUE(cheapest_plan(state, costs, {0.03, 0.9, 4e-6, 500}));
}

TEST(TargetPlan, a_half_is_run_before_it_is_planned_again) {
  EXPECT_EQ(next_batch({4, 4, 0}, {14, 4, 5}), (Counts{9, 4, 3}));
  EXPECT_EQ(next_batch({4, 4, 0}, {6, 4, 2}), (Counts{6, 4, 2})); // few are run at once
  EXPECT_EQ(next_batch({4, 4, 0}, {7, 4, 2}), (Counts{6, 4, 1}));
}

// However much is known beforehand, runs have to tell the spread.
TEST(TargetPlan, of_a_coarse_accuracy_tells_the_spread) {
  TargetState state = nothing_made({15, 30, 60}, {1e-4, 1e-4});
  state.errors.prior = {state.errors.spread, 50, 50};
  const auto plan = cheapest_plan(state, costs_of_cylinder({15, 30, 60}), {0.3, 0.9, 0, 10});
  ASSERT_TRUE(plan);
  EXPECT_TRUE(tells_spread(design_with(state, plan->counts)));
}

TEST(TargetPlan, a_packing_is_paid_for_once) {
  const TargetCosts costs{{10, 20}, 5};
  EXPECT_DOUBLE_EQ(costs.of({3, 2}), 30 + 40 + 15);
  EXPECT_DOUBLE_EQ(costs.between({3, 0}, {3, 2}), 40);
}

// By the prior 2 % take eight packings at 15 crossings or so; half of them are run at first.
TEST(TargetPlan, the_first_batch_is_half_of_what_is_expected_at_two_speeds) {
  const std::vector<double> transits{15, 30, 60, 120};
  const TargetCosts costs = costs_of_cylinder(transits);
  TargetState state = nothing_made(transits, {5.8e-4, 1e-4});
  state.errors.prior = {state.errors.spread, 1, 4};
  Aim aim{0.05, 0.9, 4e-6, 100, 5};
  const auto of = [](const Counts &counts) {
    Counts sorted = counts;
    std::sort(sorted.rbegin(), sorted.rend());
    return sorted;
  };
  EXPECT_EQ(of(pilot_of(state, costs, aim)), (Counts{2, 2, 0, 0})); // fewer tell no variances
  aim.accuracy = 0.02;
  const Counts fine = pilot_of(state, costs, aim);
  EXPECT_GT(of(fine)[0], 2u);
  EXPECT_EQ(of(fine)[2], 0u);
  aim.accuracy = 0.01;
  EXPECT_EQ(of(pilot_of(state, costs, aim)), (Counts{5, 5, 0, 0})); // no more, lest the prior be wrong
  aim.accuracy = 0.001;                                             // less than the step alone errs by
  EXPECT_EQ(pilot_of(state, costs, aim), (Counts{5, 5, 0, 0}));
}

TEST(TargetPlan, one_slow_speed_keeps_its_haste_within_the_accuracy) {
  const LinearCost cost{1400, 285, 6000};
  const Aim aim{0.02, 0.9, 0, 500};
  const OneSpeed none = one_slow_speed({0, {4e-4, 0}}, cost, 15, aim);
  EXPECT_EQ(none.transits, 15); // without haste the fastest is the best
  EXPECT_EQ(none.packings, 3u); // 1.645 * 2 % / sqrt(3) is within 2 %
  EXPECT_DOUBLE_EQ(none.cost, 3 * (1400 + 285 * 15 + 6000));
  const OneSpeed hasty = one_slow_speed({1.2, {4e-4, 2e-4}}, cost, 15, aim);
  EXPECT_GT(hasty.transits, 60); // where haste alone is 2 %
  EXPECT_GT(hasty.packings, 4u); // what they need without haste
  EXPECT_LT(one_slow_speed({1.2, {4e-4, 2e-4}}, cost, 15, {0.03, 0.9, 0, 500}).cost, hasty.cost);
}

// A pilot of two packings with two degrees of freedom: five, as 2 % are t_5 2.015 / sqrt(5) of 2.2 %.
TEST(TargetPlan, one_slow_speed_pays_for_what_a_pilot_has_to_tell) {
  const LinearCost cost{1400, 285, 6000};
  const Aim aim{0.02, 0.9, 0, 500};
  OneSpeedKnown known{0, {4.84e-4, 0}, 2, 2, 1e5};
  const OneSpeed slow = one_slow_speed(known, cost, 15, aim);
  EXPECT_EQ(slow.packings, 5u);
  EXPECT_DOUBLE_EQ(slow.cost, 1e5 + 5 * (1400 + 285 * 15) + 3 * 6000);
  TargetEstimate pilot;
  pilot.slope = -1.2, pilot.precision.slope = 0.25, pilot.precision.freedom = 4;
  EXPECT_NEAR(known_by_pilot(pilot, 2, 1e5, 0.9).haste, 1.2 + 1.533 * 0.5, 1e-3); // t_4 of 90 %
}

} // namespace
} // namespace platen::apps::testing
