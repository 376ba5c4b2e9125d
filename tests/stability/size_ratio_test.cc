// Spheres of very unlike sizes: every pair is found, and none costs much more than among equal ones.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "base/random.h"
#include "dem/cell_grid.h"
#include "tests/measured.h"

namespace platen::dem::size_ratio_test {
namespace {

using measured::expect_below;

struct Cloud {
  std::vector<Vector3> centre;
  std::vector<double> radius;

  void add(std::size_t count, double r, double edge, Random &random) {
    for (std::size_t k = 0; k < count; ++k) {
      centre.push_back({random.uniform(0, edge), random.uniform(0, edge), random.uniform(0, edge)});
      radius.push_back(r);
    }
  }
};

bool near(const Cloud &c, std::size_t i, std::size_t j, double margin) {
  const double reach = c.radius[i] + c.radius[j] + margin;
  return norm_squared(c.centre[j] - c.centre[i]) < reach * reach;
}

std::vector<IndexPair> pairs_of(const Cloud &c, double margin, std::size_t &measured) {
  return near_pairs(c.centre.data(), c.radius.data(), c.centre.size(), margin, &measured);
}

double distances_per_pair(const Cloud &c, double margin) {
  std::size_t measured = 0;
  const std::size_t found = pairs_of(c, margin, measured).size();
  return static_cast<double>(measured) / static_cast<double>(found);
}

// Ten of radius 100 among many of radius 1, which fill `share` of the space between; against as many equal
// ones, packed so that each has a few neighbours.
void expect_all_pairs_at_little_cost(std::size_t small, const std::string &which) {
  constexpr double margin = 0.5;
  Random random(7);
  Cloud mixed, equal;
  mixed.add(small / 2, 1, 600, random);
  mixed.add(10, 100, 600, random);
  mixed.add(small / 2, 1, 600, random);
  equal.add(small, 1, std::cbrt(8.0 * static_cast<double>(small)), random);
  std::size_t measured = 0;
  const std::vector<IndexPair> found = pairs_of(mixed, margin, measured);
  std::size_t k = 0, wrong = 0;
  for (std::size_t i = 0; i < mixed.centre.size(); ++i)
    for (std::size_t j = i + 1; j < mixed.centre.size(); ++j)
      if (near(mixed, i, j, margin)) {
        wrong += k >= found.size() || !(found[k] == IndexPair{static_cast<int>(i), static_cast<int>(j)});
        ++k;
      }
  EXPECT_EQ(k, found.size());
  EXPECT_EQ(wrong, 0u);
  EXPECT_GT(found.size(), small / 10);
  measured::note_figure(12, "pairs_that_differ" + which, static_cast<double>(wrong), "none");
  const double cost = static_cast<double>(measured) / static_cast<double>(found.size()),
               usual = distances_per_pair(equal, margin);
  measured::note_figure(12, "distances_per_pair_of_equal_spheres" + which, usual, "any");
  expect_below(12, "cost_of_a_pair_over_that_of_equal_spheres" + which, cost / usual, 3);
}

TEST(size_ratio, of_a_hundred_loses_no_pair_and_costs_little) {
  expect_all_pairs_at_little_cost(10000, "");
}

TEST(size_ratio, long_of_a_hundred_among_a_hundred_thousand) {
  expect_all_pairs_at_little_cost(100000, "_among_100000");
}

// Every size between, as many in each octave.
TEST(size_ratio, a_whole_range_of_sizes_costs_little_too) {
  Random random(8);
  Cloud c, equal;
  for (int octave = 0; octave < 7; ++octave)
    for (int k = 0; k < 2000; ++k)
      c.add(1, std::exp2(octave + random.uniform()), 400, random);
  equal.add(14000, 1, 48, random);
  expect_below(12, "cost_of_a_pair_in_a_range_of_sizes_over_that_of_equal_spheres",
               distances_per_pair(c, 0.5) / distances_per_pair(equal, 0.5), 3);
}

} // namespace
} // namespace platen::dem::size_ratio_test
