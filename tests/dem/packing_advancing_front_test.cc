// Packing by an advancing front: the published counts, three contacts each, no overlap, repeatable.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <stdexcept>

#include "dem/packing/advancing_front.h"
#include "dem/packing/quality.h"

namespace platen::dem::packing_advancing_front_test {
namespace {

constexpr double mm = 1e-3;

double packing_fraction(const Specimen &s) {
  return volume_of_spheres(s) / s.shape.volume();
}

double gap(const Specimen &s, std::size_t i, std::size_t j) {
  return norm(s.centre[i] - s.centre[j]) - s.radius[i] - s.radius[j];
}

// Brute force over all pairs: the oracle of everything below.
void expect_no_overlap_and_three_earlier_contacts(const Specimen &s) {
  const double r = smallest_radius(s);
  for (std::size_t i = 0; i < s.size(); ++i) {
    std::size_t earlier = 0;
    for (std::size_t j = 0; j < i; ++j) {
      ASSERT_GT(gap(s, i, j), -1e-9 * r) << j << " and " << i;
      if (gap(s, i, j) < 1e-9 * r) ++earlier;
    }
    ASSERT_GE(earlier, std::min<std::size_t>(i, 3)) << "sphere " << i;
    ASSERT_GE(wall_clearance(s.shape, s.centre[i]), s.radius[i]) << "sphere " << i;
  }
}

TEST(AdvancingFront, meets_the_published_packing_densities) {
  // Tannu 2017, table 2 (cylinder 10 x 5 mm): 45.63 and 50.5 %. One point is about twice the scatter of the
  // seeds.
  EXPECT_NEAR(packing_fraction(advancing_front(cylinder(5 * mm, 10 * mm), equal_radii(0.5 * mm), 1)), 0.4563,
              0.01);
  EXPECT_NEAR(packing_fraction(advancing_front(cylinder(5 * mm, 10 * mm), equal_radii(0.25 * mm), 1)), 0.505,
              0.01);
}

TEST(AdvancingFront, meets_the_published_number_of_spheres) {
  // Tannu 2017, table 14: 9871 spheres of 1.25 mm in 80 x 25 mm, 3 %.
  const Specimen s = advancing_front(cylinder(25 * mm, 80 * mm), equal_radii(1.25 * mm), 1);
  EXPECT_NEAR(static_cast<double>(s.size()), 9871.0, 0.03 * 9871);
}

TEST(AdvancingFront, fills_a_handful_of_spheres_in_the_published_trend) {
  // Tannu 2017, table 2: 17 and 72 spheres of 1.5 and 1 mm in 10 x 5 mm; a sphere more or less in ten is
  // chance.
  EXPECT_NEAR(static_cast<double>(advancing_front(cylinder(5, 10), equal_radii(1.5), 1).size()), 17, 2);
  EXPECT_NEAR(static_cast<double>(advancing_front(cylinder(5, 10), equal_radii(1.0), 1).size()), 72, 5);
}

TEST(AdvancingFront, gives_each_sphere_three_earlier_contacts_and_no_overlap) {
  expect_no_overlap_and_three_earlier_contacts(advancing_front(cylinder(5, 10), equal_radii(0.4), 3));
  expect_no_overlap_and_three_earlier_contacts(
      advancing_front(box(8, 6, 9), uniform_radii_of_spread(0.45, 2.0 / 3), 3));
  expect_no_overlap_and_three_earlier_contacts(advancing_front(box(8, 6, 9), two_radii(0.3, 0.6, 0.5), 3));
}

TEST(AdvancingFront, has_three_n_minus_six_contacts) {
  const Specimen s = advancing_front(cylinder(5, 10), equal_radii(0.25), 2);
  const std::size_t contacts = touching_pairs(s, 1e-9).size();
  EXPECT_EQ(contacts, 3 * s.size() - 6);
  // A gap of 1e-4 R lets a few chance neighbours in.
  EXPECT_NEAR(judge_packing(s, {1e-4, 4}).coordination_number, 6.0, 0.1);
}

TEST(AdvancingFront, draws_the_wanted_radii) {
  const Specimen two = advancing_front(box(10, 10, 10), two_radii(0.3, 0.5, 0.4), 5);
  std::size_t large = 0;
  for (const double r : two.radius) {
    EXPECT_TRUE(r == 0.3 || r == 0.5) << r;
    large += r == 0.5 ? 1 : 0;
  }
  const double n = static_cast<double>(two.size());
  // Four standard deviations of a binomial count.
  EXPECT_NEAR(static_cast<double>(large), 0.4 * n, 4 * std::sqrt(0.24 * n));

  const Specimen spread = advancing_front(box(10, 10, 10), uniform_radii_of_spread(0.4, 0.5), 5);
  EXPECT_GE(smallest_radius(spread), 0.3);
  EXPECT_LE(largest_radius(spread), 0.5);
  EXPECT_NEAR(mean_radius(spread), 0.4, 4 * 0.2 / std::sqrt(12.0 * static_cast<double>(spread.size())));
}

TEST(AdvancingFront, refuses_what_cannot_be_packed) {
  EXPECT_THROW(advancing_front(cylinder(1, 10), equal_radii(1.1), 1), std::invalid_argument);
  EXPECT_THROW(advancing_front(cylinder(1, -1), equal_radii(0.1), 1), std::invalid_argument);
  EXPECT_THROW(equal_radii(0), std::invalid_argument);
  EXPECT_THROW(equal_radii(std::nan("")), std::invalid_argument);
  EXPECT_THROW(uniform_radii_of_spread(1.5, -2.0 / 3), std::invalid_argument);
  EXPECT_THROW(two_radii(1, 2, 1.5), std::invalid_argument);
  EXPECT_THROW(uniform_radii_of_spread(1, 2), std::invalid_argument);
}

} // namespace
} // namespace platen::dem::packing_advancing_front_test
