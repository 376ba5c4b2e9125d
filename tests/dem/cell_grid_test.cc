// Near pairs against the sum over all pairs.
#include "dem/cell_grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "base/random.h"
#include "base/rows.h"
#include "dem/instruction_set.h"
#include "dem/kernels/near_kernel.h"
#include "dem/particles.h"

namespace platen::dem::cell_grid_test {
namespace {

// Refused before any is looked at.
TEST(CellGrid, more_spheres_than_an_int_counts_are_refused) {
  EXPECT_THROW(near_pairs(nullptr, nullptr, std::size_t{1} << 31, 0), std::length_error);
  EXPECT_THROW(require_rows(2147483648u), std::length_error);
  EXPECT_NO_THROW(require_rows(2147483647u));
}

struct Cloud {
  std::vector<Vector3> centre;
  std::vector<double> radius;
};

std::vector<IndexPair> all_near_pairs(const Cloud &c, double margin) {
  std::vector<IndexPair> pairs;
  for (std::size_t i = 0; i < c.centre.size(); ++i)
    for (std::size_t j = i + 1; j < c.centre.size(); ++j) {
      const double reach = c.radius[i] + c.radius[j] + margin;
      if (norm_squared(c.centre[j] - c.centre[i]) < reach * reach)
        pairs.push_back({static_cast<int>(i), static_cast<int>(j)});
    }
  return pairs;
}

Cloud cloud(std::size_t n, const Vector3 &extent, double smallest, double largest, std::uint64_t seed) {
  Random random(seed);
  Cloud c;
  for (std::size_t k = 0; k < n; ++k) {
    c.centre.push_back(
        {random.uniform(0, extent.x), random.uniform(0, extent.y), random.uniform(0, extent.z)});
    c.radius.push_back(smallest * std::pow(largest / smallest, random.uniform()));
  }
  return c;
}

void expect_same(const Cloud &c, double margin) {
  const std::vector<IndexPair> found = near_pairs(c.centre.data(), c.radius.data(), c.centre.size(), margin),
                               expected = all_near_pairs(c, margin);
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t k = 0; k < found.size(); ++k)
    ASSERT_TRUE(found[k] == expected[k]) << k;
}

TEST(cell_grid, finds_exactly_the_near_pairs) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed)
    for (const double margin : {0.0, 1e-3, .3})
      expect_same(cloud(1500, {1, 1, 1}, .03, .05, seed), margin);
}

TEST(cell_grid, sizes_may_differ_a_hundredfold) {
  expect_same(cloud(2500, {1, 1, 1}, 1e-3, .1, 4), 0);
  expect_same(cloud(2500, {1, 1, 1}, 1e-3, .1, 5), .01);
}

TEST(cell_grid, flat_long_and_distant_clouds_are_searched_too) {
  expect_same(cloud(1500, {1, 1, 0}, .01, .02, 6), .005);
  expect_same(cloud(1500, {50, .01, .01}, .01, .02, 7), .005);
  Cloud two = cloud(800, {1, 1, 1}, .03, .05, 8);
  for (std::size_t k = 0; k < 400; ++k)
    two.centre[k] += {1e6, -1e6, 1e6};
  expect_same(two, .01);
}

TEST(cell_grid, spheres_on_a_lattice_of_the_cell_size_are_not_lost) {
  Cloud lattice;
  for (int x = 0; x < 9; ++x)
    for (int y = 0; y < 9; ++y)
      for (int z = 0; z < 9; ++z) {
        lattice.centre.push_back({.1 * x, .1 * y, .1 * z});
        lattice.radius.push_back(.05);
      }
  expect_same(lattice, 1e-6);
  expect_same(lattice, .05);
}

std::size_t distances_examined(const Cloud &c, double margin) {
  std::size_t examined = 0;
  near_pairs(c.centre.data(), c.radius.data(), c.centre.size(), margin, &examined);
  return examined;
}

// Wherever it flies, and wherever the specimen stands.
TEST(cell_grid, lost_spheres_do_not_make_the_search_dearer) {
  const Cloud whole = cloud(3000, {1, 1, 1}, .03, .03, 10);
  const std::size_t usual = distances_examined(whole, .03);
  EXPECT_LT(usual, 40u * 3000u);
  for (const double away : {.1, .5, 5., 1e3, 1e9, 1e18, 1e150}) {
    Cloud lost = whole;
    lost.centre.push_back({1.1 + away, .5, .5});
    lost.radius.push_back(.03);
    EXPECT_EQ(distances_examined(lost, .03), usual) << away;
    for (std::size_t k = 0; k < 100; ++k) { // the first hundred, each in a direction of its own
      const double turn = static_cast<double>(k);
      lost.centre[k] += (1.5 + away) * Vector3{std::sin(turn), std::cos(turn), std::sin(2 * turn)};
    }
    EXPECT_LE(distances_examined(lost, .03), usual) << away;
  }
}

// Cells are as long as the largest reach, so that a pair at it lies next to the edge of what is searched.
TEST(cell_grid, pairs_at_their_reach_are_not_lost_by_rounding) {
  constexpr double margin = .01;
  const double radius[2] = {.05, .05}, reach = radius[0] + radius[1] + margin;
  Random random(13);
  int near = 0;
  for (const double away : {0., 1., 1e3, 1e6})
    for (int k = 0; k < 20000; ++k) {
      const int axis = k % 3;
      Vector3 centre[2];
      for (int c = 0; c < 3; ++c)
        centre[0][c] = centre[1][c] = away * random.uniform(-1, 1) + random.uniform(0, 1);
      if (k % 2 == 0) centre[0][axis] = std::floor(centre[0][axis] / reach) * reach; // at an edge of a cell
      centre[1][axis] = centre[0][axis] + (k % 4 < 2 ? reach : -reach);
      for (int ulp = k % 5; ulp > 0; --ulp)
        centre[1][axis] = std::nextafter(centre[1][axis], centre[0][axis]);
      const bool expected = norm_squared(centre[1] - centre[0]) < reach * reach;
      near += expected;
      ASSERT_EQ(near_pairs(centre, radius, 2, margin).size(), expected ? 1u : 0u) << away << " " << k;
    }
  EXPECT_GT(near, 20000);
}

TEST(cell_grid, far_places_lose_no_pair) {
  for (const double away : {1e3, 1e6, -1e9, 1e12}) {
    Cloud c = cloud(300, {1, 1, 1}, .04, .05, 11);
    for (Vector3 &x : c.centre)
      x += {away, -away, .3 * away};
    expect_same(c, .01);
  }
}

// A large one reaches more cells of small ones than there are small ones, or numbers of cells.
TEST(cell_grid, spheres_of_any_ratio_of_size_are_found) {
  for (const double small : {1e-2, 1e-4, 1e-7, 1e-12}) {
    Cloud c = cloud(200, {3, 3, 3}, small, small, 12);
    c.centre.push_back({1.5, 1.5, 1.5});
    c.radius.push_back(1);
    expect_same(c, 0);
    EXPECT_LT(distances_examined(c, 0), 2u * 200u) << small;
  }
}

TEST(cell_grid, a_centre_that_is_no_place_is_refused) {
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()})
    for (const std::size_t row : {0u, 7u}) {
      Cloud c = cloud(20, {1, 1, 1}, .03, .05, 9);
      c.centre[row].y = bad;
      EXPECT_THROW(near_pairs(c.centre.data(), c.radius.data(), c.centre.size(), 0), NotFinite) << row;
    }
}

TEST(cell_grid, nothing_and_one_have_no_pairs) {
  EXPECT_TRUE(near_pairs(nullptr, nullptr, 0, 1.0).empty());
  const Vector3 centre{1, 2, 3};
  const double radius = 1;
  EXPECT_TRUE(near_pairs(&centre, &radius, 1, 1.0).empty());
}

// Which balls of a run of members are near one: a plain loop says, and every instruction set agrees.
std::vector<std::pair<const char *, kernels::FindNear>> kernels_here() {
  std::vector<std::pair<const char *, kernels::FindNear>> all{{"baseline", kernels::find_near_baseline}};
  const InstructionSet best = best_instruction_set();
  if (best != InstructionSet::baseline) all.push_back({"avx2", kernels::find_near_avx2});
  if (best == InstructionSet::avx512) all.push_back({"avx512", kernels::find_near_avx512});
  return all;
}

// Members with room after them that would be near if it were looked at.
struct Members {
  std::vector<float> x, y, z, reach;
  std::vector<int> ball;

  kernels::NearColumns columns() const { return {x.data(), y.data(), z.data(), reach.data(), ball.data()}; }
  void add(float at_x, float at_y, float at_z, float far, int number) {
    x.push_back(at_x), y.push_back(at_y), z.push_back(at_z), reach.push_back(far), ball.push_back(number);
  }
  void add_spare() {
    for (std::size_t k = 0; k < kernels::near_spare; ++k)
      add(0, 0, 0, 100, 777);
  }
};

std::vector<int> found_by(kernels::FindNear find, const Members &m, const kernels::NearBall &own, int first,
                          int last) {
  std::vector<int> found(static_cast<std::size_t>(last - first) + kernels::near_spare, -1);
  found.resize(find(m.columns(), own, first, last, found.data()));
  return found;
}

TEST(NearKernel, finds_what_a_plain_loop_finds_in_runs_of_every_length) {
  constexpr int n = 40;
  Random random(4);
  const auto anywhere = [&] { return static_cast<float>(random.uniform(-2, 2)); };
  Members m;
  for (int k = 0; k < n; ++k)
    m.add(anywhere(), anywhere(), anywhere(), static_cast<float>(random.uniform(0.2, 1.5)), 1000 - 7 * k);
  m.add_spare();
  const kernels::NearBall own{0.3F, -0.2F, 0.1F, 0.9F, 1000 - 7 * 11}; // member 11 is the ball itself
  for (int first = 0; first < n; ++first)
    for (int last = first; last <= n; ++last) {
      std::vector<int> expected;
      for (int k = first; k < last; ++k) {
        const double x = m.x[k] - 0.3, y = m.y[k] + 0.2, z = m.z[k] - 0.1, far = m.reach[k] + 0.9;
        if (k != 11 && x * x + y * y + z * z < far * far) expected.push_back(m.ball[k]);
      }
      for (const auto &[name, find] : kernels_here())
        EXPECT_EQ(found_by(find, m, own, first, last), expected) << name << ' ' << first << ' ' << last;
    }
}

// Exact in single precision: 3, 4 and 12 are 13 away.
TEST(NearKernel, leaves_out_what_just_meets) {
  Members m;
  m.add(3, 4, 12, 8, 0), m.add(3, 4, 12, 8.001F, 1), m.add(-3, -4, -12, 7.999F, 2),
      m.add(3, -4, 12, 8.001F, 3);
  m.add_spare();
  for (const auto &[name, find] : kernels_here())
    EXPECT_EQ(found_by(find, m, {0, 0, 0, 5, 9}, 0, 4), (std::vector<int>{1, 3})) << name;
}

} // namespace
} // namespace platen::dem::cell_grid_test
