// Judging packings: contacts against brute force, lattices and spheres with known figures, isotropy.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <utility>
#include <vector>

#include "base/pi.h"
#include "base/random.h"
#include "dem/packing/direction_cells.h"
#include "dem/packing/quality.h"

namespace platen::dem::packing_quality_test {
namespace {

// n^3 touching spheres of radius 1/2 in a cube of edge n.
Specimen simple_cubic(int n) {
  Specimen s;
  s.shape = box(n, n, n);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      for (int k = 0; k < n; ++k)
        s.centre.push_back({i + 0.5 - 0.5 * n, j + 0.5 - 0.5 * n, k + 0.5});
  s.radius.assign(s.centre.size(), 0.5);
  return s;
}

TEST(PackingQuality, finds_the_contacts_that_brute_force_finds) {
  Random random(5);
  Specimen s;
  s.shape = cylinder(1, 2);
  for (int i = 0; i < 800; ++i) { // radii from 1 to 20, at places even outside the shape
    s.centre.push_back({random.uniform(-1.5, 1.5), random.uniform(-1.5, 1.5), random.uniform(-0.5, 2.5)});
    s.radius.push_back(0.01 * std::exp(random.uniform(0, 3)));
  }
  const double gap = 0.02;
  std::vector<std::pair<int, int>> expected, found;
  for (std::size_t i = 0; i < s.size(); ++i)
    for (std::size_t j = i + 1; j < s.size(); ++j)
      if (norm(s.centre[i] - s.centre[j]) - s.radius[i] - s.radius[j] <= gap)
        expected.emplace_back(static_cast<int>(i), static_cast<int>(j));
  for (const TouchingPair &pair : touching_pairs(s, gap))
    found.emplace_back(pair.first, pair.second);
  EXPECT_GT(expected.size(), 100u);
  EXPECT_EQ(found, expected);
}

TEST(PackingQuality, knows_the_simple_cubic_lattice) {
  const Specimen s = simple_cubic(10);
  // Core margins of 4 and 5 radii: the core's walls pass between spheres, and through their centres.
  for (const double margin : {4.0, 5.0}) {
    const PackingQuality q = judge_packing(s, {1e-6, margin});
    EXPECT_NEAR(q.packing_fraction, pi / 6, 1e-12);
    EXPECT_NEAR(q.core_packing_fraction, pi / 6, 1e-6);
    EXPECT_NEAR(q.core_coordination_number, 6.0, 1e-12);
    EXPECT_EQ(q.contacts, 3u * 10 * 10 * 9);
    EXPECT_EQ(q.rattlers, 0u);
    EXPECT_EQ(q.touching_bottom, 100u);
    EXPECT_NEAR(q.cover_top, pi / 4, 1e-12);
    EXPECT_LT(q.max_overlap, 1e-12);
    EXPECT_GT(q.isotropy_chi_squared, 100.0); // all contacts along three axes
  }
}

TEST(PackingQuality, leaves_the_core_out_where_there_is_none) {
  const PackingQuality q = judge_packing(simple_cubic(3));
  EXPECT_TRUE(std::isnan(q.core_packing_fraction));
  EXPECT_TRUE(std::isnan(q.core_coordination_number));
  EXPECT_NEAR(q.coordination_number, 2.0 * 54 / 27, 1e-12);
}

TEST(PackingQuality, measures_overlaps_and_rattlers) {
  Specimen s;
  s.shape = box(10, 10, 10);
  s.centre = {
      {-1, 0, 5}, {0.98, 0, 5}, {-3, 0, 5}, {4.3, 0, 5}}; // overlap .02; touching; .3 out of the wall x = 5
  s.radius.assign(4, 1.0);
  const PackingQuality q = judge_packing(s);
  EXPECT_NEAR(q.max_overlap, 0.02, 1e-12);
  EXPECT_NEAR(q.max_wall_overlap, 0.3, 1e-12);
  EXPECT_EQ(q.contacts, 2u);
  EXPECT_EQ(q.rattlers, 4u);
  EXPECT_THROW(judge_packing(Specimen{box(1, 1, 1), {}, {}}), std::invalid_argument);
  EXPECT_THROW(judge_packing(s, {-1, 4}), std::invalid_argument);
}

TEST(SphereClipping, knows_caps_octants_and_rings) {
  const double whole = 4.0 / 3.0 * pi, tolerance = 1e-4 * whole; // as promised
  const Shape cube = box(10, 10, 10);
  EXPECT_NEAR(clipped_volume({0, 0, 5}, 1, cube), whole, 1e-14);
  EXPECT_EQ(clipped_volume({0, 7, 5}, 1, cube), 0);
  const double h = 0.4, cap = pi * h * h * (3 - h) / 3; // what is left outside by a centre .6 inside
  EXPECT_NEAR(clipped_volume({0, 0, 0.6}, 1, cube), whole - cap, tolerance);
  EXPECT_NEAR(clipped_volume({4.4, 0, 5}, 1, cube), whole - cap, tolerance);
  EXPECT_NEAR(clipped_volume({0, -5.6, 5}, 1, cube), cap, tolerance);
  EXPECT_NEAR(clipped_volume({5, 5, 10}, 1, cube), whole / 8, tolerance);
  // A sphere on the axis of a thinner, long cylinder loses the ring outside: 4/3 pi (R^2 - a^2)^(3/2).
  const double ring = whole * std::pow(1 - 0.36, 1.5);
  EXPECT_NEAR(clipped_volume({0, 0, 5}, 1, cylinder(0.6, 10)), whole - ring, tolerance);
  // A sphere that swallows the shape is clipped to it.
  EXPECT_NEAR(clipped_volume({0, 0, 0.5}, 3, box(1, 1, 1)), 1.0, 1e-4);
  // Half a sphere at the wall of a very wide cylinder.
  EXPECT_NEAR(clipped_volume({1e4, 0, 5}, 1, cylinder(1e4, 10)), whole / 2, tolerance);
}

TEST(SphereClipping, splits_a_sphere_without_loss) {
  // What a cylinder and the rest of the space share of a sphere adds up: two cylinders stacked on each other.
  Random random(9);
  for (int k = 0; k < 50; ++k) {
    const Vector3 c{random.uniform(-1.5, 1.5), random.uniform(-1.5, 1.5), random.uniform(0, 4)};
    const double both = clipped_volume(c, 0.7, cylinder(1, 4)),
                 low = clipped_volume(c, 0.7, cylinder(1, 1.7)),
                 high = clipped_volume(c - Vector3{0, 0, 1.7}, 0.7, cylinder(1, 2.3));
    EXPECT_NEAR(low + high, both, 2e-4);
  }
}

TEST(DirectionCells, cover_the_sphere_once) {
  const DirectionCells cells;
  double sum = 0, smallest = 1, largest = 0;
  for (std::size_t c = 0; c < DirectionCells::count; ++c) {
    sum += cells.weight(c);
    smallest = std::min(smallest, cells.weight(c)), largest = std::max(largest, cells.weight(c));
    EXPECT_NE(cells.opposite(c), c);
    EXPECT_EQ(cells.opposite(cells.opposite(c)), c);
    EXPECT_NEAR(cells.weight(cells.opposite(c)), cells.weight(c), 1e-14);
    EXPECT_EQ(cells.cell_of(cells.middle(c)), c);
    EXPECT_NEAR(norm(cells.middle(c)), 1.0, 1e-14);
  }
  EXPECT_NEAR(sum, 1.0, 1e-12);
  EXPECT_NEAR(largest / smallest, 1.275, 0.001);
}

TEST(DirectionCells, are_hit_by_their_weight) {
  const DirectionCells cells;
  Random random(2);
  std::vector<double> hits(DirectionCells::count);
  const int n = 200000;
  for (int k = 0; k < n; ++k) {
    const Vector3 v = random.direction();
    ++hits[cells.cell_of(v)];
    EXPECT_EQ(cells.cell_of(-v), cells.opposite(cells.cell_of(v)));
  }
  for (std::size_t c = 0; c < DirectionCells::count; ++c) // five standard deviations of a count
    EXPECT_NEAR(hits[c] / n, cells.weight(c), 5 * std::sqrt(cells.weight(c) / n));
}

TEST(DirectionCells, count_an_axis_once_whatever_its_sign) {
  const std::vector<AxisCell> none = count_axes({});
  ASSERT_EQ(none.size(), DirectionCells::count / 2);
  double sum = 0;
  for (const AxisCell &cell : none) {
    sum += cell.weight;
    EXPECT_GE(cell.middle.z, 0.0);
    EXPECT_EQ(cell.axes, 0u);
  }
  EXPECT_NEAR(sum, 1.0, 1e-12);
  EXPECT_EQ(isotropy_chi_squared(none), 0.0);
  const Vector3 some = none[17].middle;
  const std::vector<AxisCell> counted = count_axes({2 * some, -some, none[80].middle});
  EXPECT_EQ(counted[17].axes, 2u);
  EXPECT_EQ(counted[80].axes, 1u);
}

TEST(Isotropy, is_one_for_random_axes_and_blind_to_their_sign) {
  Random random(3);
  std::vector<Vector3> axes, turned;
  for (int k = 0; k < 20000; ++k) {
    axes.push_back(random.direction());
    turned.push_back(k % 2 == 0 ? axes.back() : -axes.back());
  }
  // Chi-squared of 159 degrees of freedom over 159: standard deviation .112; four of them.
  EXPECT_NEAR(isotropy_chi_squared(count_axes(axes)), 1.0, 0.45);
  EXPECT_DOUBLE_EQ(isotropy_chi_squared(count_axes(axes)), isotropy_chi_squared(count_axes(turned)));
  for (Vector3 &axis : axes)
    axis.z *= 1.2; // a fabric stretched by a fifth must show
  EXPECT_GT(isotropy_chi_squared(count_axes(axes)), 2.0);
}

} // namespace
} // namespace platen::dem::packing_quality_test
