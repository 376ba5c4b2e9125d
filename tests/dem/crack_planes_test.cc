// Planes and directions of broken bonds.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "dem/measure/cracks.h"
#include "tests/dem/broken_specimens.h"
#include "tests/dem/examples.h"

namespace platen::dem {
namespace {

using namespace examples;

constexpr double degree = pi / 180;

// Which side of a plane through the middle, at an angle (degrees) to the axis.
auto sides(double angle) {
  return [angle](const Vector3 &x) {
    const double z = x.z - Cylinder::length * radius / 2;
    return z * std::sin(angle * degree) > x.x * std::cos(angle * degree) ? 1 : 2;
  };
}

TEST(crack_planes, a_cut_through_the_specimen_is_one_plane_at_its_angle) {
  for (const double angle : {0., 30., 45., 90.}) {
    Cylinder c;
    c.cut(sides(angle));
    const auto planes = find_crack_planes(c.particles, c.bonds);
    const CrackPlanes sum = sum_up(planes, c.bonds);
    ASSERT_EQ(planes.size(), 1u) << angle;
    EXPECT_NEAR(planes[0].inclination / degree, angle, 1) << angle;
    EXPECT_NEAR(std::abs(planes[0].normal.x), std::cos(angle * degree), .02) << angle;
    EXPECT_GT(planes[0].flatness, .9) << angle;
    EXPECT_GT(sum.share, .98) << angle;
    EXPECT_EQ(sum.steep_share > .9, angle < 15) << angle;
    EXPECT_NEAR(norm(planes[0].centre - Vector3{0, 0, c.height() / 2}), 0, 2 * radius) << angle;
    // An ellipse with half-axes a and b has scatters a/2 and b/2.
    const double longer = std::max(1.0, 1 / std::max(.3, std::sin(angle * degree)));
    if (angle > 0)
      EXPECT_NEAR(planes[0].extent / radius, std::sqrt(12.) / 2 * Cylinder::width * longer, 6) << angle;
    else
      EXPECT_NEAR(planes[0].extent / radius, Cylinder::length, 6);
  }
}

TEST(crack_planes, planes_apart_are_counted_one_by_one) {
  Cylinder c;
  c.cut([&](const Vector3 &x) { return static_cast<int>(std::floor(x.z / c.height() * 4)); });
  const auto planes = find_crack_planes(c.particles, c.bonds);
  ASSERT_EQ(planes.size(), 3u);
  for (const CrackPlane &plane : planes)
    EXPECT_NEAR(plane.inclination, pi / 2, degree);
  EXPECT_GE(planes[0].bonds, planes[1].bonds);
  EXPECT_NEAR(sum_up(planes, c.bonds).mean_inclination, pi / 2, degree);
}

// In a specimen with a fifth of its bonds broken at random, a sheet in which all are broken is still found.
TEST(crack_planes, a_sheet_is_found_in_diffuse_damage) {
  Cylinder c;
  std::mt19937 random(2);
  std::vector<BondBreak> breaks;
  for (std::size_t k = 0; k < c.bonds.size(); ++k) {
    const Vector3 m = .5 * (c.particles.reference_position[c.bonds.first[k]] +
                            c.particles.reference_position[c.bonds.second[k]]);
    if (random() % 5 == 0 || std::abs(m.x) < 2 * radius)
      breaks.push_back({static_cast<int>(k), BondState::broken_in_tension});
  }
  c.bonds.break_rows(breaks, c.particles, 0);
  const auto planes = find_crack_planes(c.particles, c.bonds);
  ASSERT_GE(planes.size(), 1u);
  EXPECT_LT(planes[0].inclination, 3 * degree);
  EXPECT_GT(planes[0].flatness, .7);
  EXPECT_GT(planes[0].extent, .9 * c.height());
}

TEST(crack_planes, an_intact_specimen_and_a_crushed_one_have_none) {
  Cylinder c;
  EXPECT_TRUE(find_crack_planes(c.particles, c.bonds).empty());
  EXPECT_TRUE(std::isnan(sum_up({}, c.bonds).share));
  c.cut([](const Vector3 &) { return Cylinder::crumbs; });
  EXPECT_TRUE(find_crack_planes(c.particles, c.bonds).empty());
  EXPECT_EQ(sum_up({}, c.bonds).share, 0);
}

TEST(crack_rose, cracks_that_face_all_directions_alike_give_one_everywhere) {
  CrackRose rose;
  const int n = 200000; // points of a spiral, even on the sphere
  for (int k = 0; k < n; ++k) {
    const double z = 1 - (2 * k + 1.0) / n;
    rose.add({std::sqrt(1 - z * z), 0, z}, 1e-6);
  }
  for (const double share : rose.over_isotropic())
    EXPECT_NEAR(share, 1, 1e-3);
}

TEST(crack_rose, counts_area_by_the_angle_to_the_axis_in_either_sense) {
  CrackRose rose;
  rose.add({0, 0, -1}, 3e-6); // across the specimen
  rose.add({1, 0, 0}, 1e-6);  // along it
  rose.add({std::sin(45 * degree), 0, -std::cos(45 * degree)}, 2e-6);
  EXPECT_EQ(rose.area[0], 3e-6);
  EXPECT_EQ(rose.area[4], 2e-6);
  EXPECT_EQ(rose.area[8], 1e-6);
  const auto share = rose.over_isotropic();
  EXPECT_NEAR(share[0], .5 / (1 - std::cos(10 * degree)), 1e-9);
  EXPECT_NEAR(share[8], 1. / 6 / std::cos(80 * degree), 1e-9);
  EXPECT_TRUE(std::isnan(CrackRose{}.over_isotropic()[0]));
}

} // namespace
} // namespace platen::dem
