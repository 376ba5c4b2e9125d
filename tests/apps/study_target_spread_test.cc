// What is known of the spread beforehand: closed forms, and that runs outweigh it.
#include "apps/study/target_model.h"

#include <gtest/gtest.h>

#include "apps/target_studies.h"

namespace platen::apps::testing {
namespace {

const std::vector<double> two_speeds{15, 60};

TargetRuns runs_of_figure(const MadeUpFigure &figure, std::size_t packings) {
  return drawn_state(figure, two_speeds, {packings, packings}, 5).runs;
}

Spread by_analysis(const TargetRuns &runs) {
  return Analysis(runs, 0, 1).spread;
}

// A prior of the very spread that runs have, whatever its weight, changes nothing.
TEST(TargetSpread, a_prior_that_runs_confirm_leaves_the_spread) {
  const TargetRuns runs = runs_of_figure({3.5, 1.2, 1, 0.03, 0.01}, 6);
  const Spread found = by_analysis(runs);
  ASSERT_GT(found.packing, 0);
  for (const double freedom : {0.0, 1.0, 4.0, 100.0}) {
    const auto with = spread_of(runs, {found, freedom, freedom});
    ASSERT_TRUE(with);
    EXPECT_NEAR(with->packing, found.packing, 1e-4 * found.packing) << freedom;
    EXPECT_NEAR(with->chaos, found.chaos, 1e-4 * found.chaos) << freedom;
  }
}

// Minus twice the logarithm of restricted likelihood and prior, by the sums of squares of an analysis of
// variance.
double minus_twice_log(const Spread &at, const Spread &analysed, double freedom, const SpreadPrior &prior) {
  const double sum = at.chaos + 2 * at.packing, found = analysed.chaos + 2 * analysed.packing,
               all = at.total(),
               off = std::log(at.packing / prior.about.packing * prior.about.chaos / at.chaos);
  return freedom * (std::log(sum) + found / sum + std::log(at.chaos) + analysed.chaos / at.chaos) +
         prior.sum_freedom * (std::log(all) + prior.about.total() / all) +
         2 * prior.ratio_freedom * std::log(std::cosh(off / 2));
}

TEST(TargetSpread, is_the_most_likely_of_runs_and_prior) {
  const TargetRuns runs = runs_of_figure({3.5, 1.2, 1, 0.03, 0.01}, 5);
  const SpreadPrior prior{{2e-4, 4e-4}, 3, 5};
  const Spread found = *spread_of(runs, prior), analysed = by_analysis(runs);
  const double lowest = minus_twice_log(found, analysed, 4, prior);
  for (const double packing : {0.99, 1.0, 1.01})
    for (const double chaos : {0.99, 1.0, 1.01})
      EXPECT_LE(lowest,
                minus_twice_log({packing * found.packing, chaos * found.chaos}, analysed, 4, prior) + 1e-9)
          << packing << ", " << chaos;
}

// Without a word of the ratio, and packings that never differ: sums of squares over degrees of freedom.
TEST(TargetSpread, degrees_known_beforehand_add_to_those_of_runs) {
  const Design ten{{3U, 10}};
  const Spread still{4e-4, 1e-10};
  EXPECT_NEAR(freedom_of(ten, 2, still, {still, 5, 0}, {1, 1}), 14, 0.01); // nine of the runs, five
  EXPECT_NEAR(freedom_of(ten, 2, still, {}, {1, 1}), 9, 0.01);
}

// Two packings at two speeds: a degree of chaos, one of chaos + 2 packing. Information of both, and of F
// with four degrees each, inverted by hand.
TEST(TargetSpread, a_ratio_known_beforehand_lends_chaos_what_packings_tell) {
  const Design two{{3U, 2}};
  const Spread spread{4e-4, 1e-4};
  const double blind = freedom_of(two, 2, spread, {}, {0, 1}),
               told = freedom_of(two, 2, spread, {spread, 0, 4}, {0, 1}),
               off = freedom_of(two, 2, spread, {{1e-4, 4e-4}, 0, 4}, {0, 1});
  EXPECT_NEAR(blind, 1, 1e-6);
  EXPECT_NEAR(told, 1.717, 1e-3);
  EXPECT_LT(off, told); // a ratio that runs contradict weighs less
}

TEST(TargetSpread, runs_outweigh_a_prior_that_is_wrong) {
  const MadeUpFigure figure{3.5, 1.2, 1, 0.03, 0.01};
  for (const double wrong : {1.0 / 9, 9.0}) { // of the variances
    const SpreadPrior prior{{wrong * 9e-4, wrong * 1e-4}, 1, 4};
    const auto few = spread_of(runs_of_figure(figure, 3), prior),
               many = spread_of(runs_of_figure(figure, 40), prior);
    EXPECT_NEAR(std::log(many->packing / 9e-4), 0, 0.5) << wrong;
    EXPECT_NEAR(std::log(many->chaos / 1e-4), 0, 0.5) << wrong;
    ASSERT_TRUE(few);
  }
}

TEST(TargetSpread, is_told_by_two_packings_run_twice_and_a_run_beyond_means) {
  EXPECT_FALSE(tells_spread({{3U, 1}, {1U, 9}}));  // one packing alone tells no chaos
  EXPECT_FALSE(tells_spread({{3U, 1}, {12U, 1}})); // as many means as runs
  EXPECT_TRUE(tells_spread({{3U, 2}}));
  EXPECT_TRUE(tells_spread({{3U, 1}, {7U, 1}}));
}

TEST(TargetSpread, a_prior_alone_tells_nothing) {
  const SpreadPrior prior{{4e-4, 1e-4}, 50, 50};
  EXPECT_FALSE(spread_of(runs_of_figure({}, 1), prior));
  EXPECT_TRUE(spread_of(runs_of_figure({}, 2), prior));
}

} // namespace
} // namespace platen::apps::testing
