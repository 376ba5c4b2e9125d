// What runs at several speeds on several packings tell of a figure: closed forms, and how often the interval
// holds the truth.
#include <gtest/gtest.h>

#include <boost/math/distributions/students_t.hpp>

#include "apps/study/target_model.h"
#include "apps/target_studies.h"

namespace platen::apps::testing {
namespace {

const std::vector<double> four_speeds{15, 30, 60, 120};

TargetRuns runs_of(const Counts &counts) {
  return drawn_state({}, four_speeds, counts).runs;
}

TEST(TargetModel, a_law_without_scatter_is_found_exactly) {
  TargetRuns runs{four_speeds, {}};
  for (const double packing : {-0.02, 0.01, 0.01}) {
    runs.logs.emplace_back();
    for (const double n : four_speeds)
      runs.logs.back().push_back(3.5 + 1.25 / n + packing);
  }
  runs.logs.push_back({3.5 + 1.25 / 15, std::nan(""), std::nan(""), std::nan("")});
  const auto found = estimate(runs, {});
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->mean, 3.5, 1e-6);
  EXPECT_NEAR(found->slope, 1.25, 1e-6);
  EXPECT_NEAR(found->errors.curvature, 1.25 * 1.25, 1e-6); // more than the least
  EXPECT_LT(found->errors.spread.chaos, 1e-10);
}

// Every packing at 15 and 60: differences of both have twice the variance of chaos, means have the rest.
TEST(TargetModel, two_speeds_on_all_packings_are_an_analysis_of_variance) {
  const TargetRuns runs = runs_of({6, 0, 6, 0});
  const Analysis of(runs, 0, 2);
  const double n = 6, chaos = of.spread.chaos, packing = of.spread.packing;
  ASSERT_GT(packing, 0);
  const auto found = estimate(runs, {});
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->errors.spread.chaos, chaos, 1e-6 * chaos);
  EXPECT_NEAR(found->errors.spread.packing, packing, 1e-6 * packing);
  EXPECT_NEAR(found->mean, (60 * of.slow - 15 * of.fast) / 45, 1e-9); // the line through both, at 1 / N = 0
  EXPECT_NEAR(found->slope, (of.fast - of.slow) / (1 / 15.0 - 1 / 60.0), 1e-6);
  EXPECT_NEAR(found->precision.packing, packing / n, 1e-6 * packing);
  EXPECT_NEAR(found->precision.chaos, chaos * (60 * 60 + 15 * 15) / (45.0 * 45) / n, 1e-6 * chaos);
  EXPECT_NEAR(std::sqrt(found->precision.speed), found->errors.curvature / (15 * 60), 1e-9);
}

TEST(TargetModel, freedom_is_that_of_the_packings_where_they_alone_scatter) {
  const auto precision = precision_of({{1U, 4}, {5U, 6}}, four_speeds, {{4e-4, 1e-10}, {}, 1});
  ASSERT_TRUE(precision);
  EXPECT_NEAR(precision->freedom, 9, 1e-3); // ten packings, one mean
  EXPECT_NEAR(precision->packing, 4e-4 / 10, 1e-9);
  const boost::math::students_t student(9);
  EXPECT_NEAR(half_interval({4e-4, 0, 0, 9, 0}, 0.9, 5e-4), boost::math::quantile(student, 0.95) * 0.03,
              1e-9);
}

TEST(TargetModel, what_cannot_be_told_is_not_told) {
  EXPECT_FALSE(precision_of({{1U, 20}}, four_speeds, {{1e-4, 1e-4}, {}, 1})); // one speed has no slope
  EXPECT_FALSE(estimate(runs_of({20, 0, 0, 0}), {}));                         // nor tells chaos from packings
  EXPECT_FALSE(estimate(runs_of({1, 1, 0, 0}), {}));
  EXPECT_TRUE(estimate(runs_of({2, 2, 0, 0}), {}));
}

struct Coverage {
  double whole = 0;            // of the interval
  double without_packings = 0; // of one that takes packings for chaos of no account
};

Coverage coverage_of(const MadeUpFigure &figure, const Counts &counts, int studies) {
  Coverage held;
  MadeUpRuns drawn(figure, 20);
  for (int k = 0; k < studies; ++k) {
    TargetState state;
    drawn.begin(state, four_speeds);
    drawn.make(state, counts);
    const auto found = estimate(state.runs, {});
    const double error = std::abs(found->mean - figure.mean);
    if (error <= half_interval(found->precision, 0.9, 0)) held.whole += 1.0 / studies;
    Precision blind = found->precision;
    blind.packing = 0;
    if (error <= half_interval(blind, 0.9, 0)) held.without_packings += 1.0 / studies;
  }
  return held;
}

// Binomial deviations of 3 000 studies: 0.55 %. That variances are estimated costs up to three points, for
// which a study asks each look for more (confidence_of_each_look).
TEST(TargetModel, intervals_of_fixed_plans_hold_the_truth_as_often_as_they_say) {
  for (const Counts &counts : {Counts{4, 4, 0, 0}, Counts{12, 0, 5, 0}, Counts{9, 4, 3, 3}})
    for (const MadeUpFigure &figure :
         {MadeUpFigure{}, MadeUpFigure{3.0, 0.7, 1, 0.03, 0.005}, MadeUpFigure{3.0, -1.5, 1, 0.01, 0.02}}) {
      const Coverage held = coverage_of(figure, counts, 3000);
      EXPECT_GT(held.whole, 0.865) << counts[0] << ", " << figure.packing;
      EXPECT_LT(held.whole, 0.96) << counts[0] << ", " << figure.packing;
    }
}

TEST(TargetModel, intervals_without_the_packings_or_with_another_law_of_speed_are_too_narrow) {
  EXPECT_LT(coverage_of({}, {12, 0, 8, 0}, 1000).without_packings, 0.85);
  EXPECT_LT(coverage_of({3.0, 1.2, 1, 0.03, 0.005}, {12, 0, 8, 0}, 1000).without_packings, 0.5);
  EXPECT_GT(coverage_of({3.0, 1.2, 1, 0.01, 0.01}, {60, 60, 0, 0}, 1000).whole, 0.88);
  EXPECT_LT(coverage_of({3.0, 1.2, 2, 0.01, 0.01}, {60, 60, 0, 0}, 1000).whole, 0.1); // 1 / N^2
}

} // namespace
} // namespace platen::apps::testing
