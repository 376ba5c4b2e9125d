// The fit of a cone to a piece: where it ends, and what of the piece it looks at.
#include "dem/measure/cone_fit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "dem/measure/cone.h"
#include "tests/dem/broken_specimens.h"
#include "tests/dem/examples.h"

namespace platen::dem {
namespace {

using namespace examples;

constexpr double degree = pi / 180;

// As a cone is made it stands upright: what is below its apex is within.
TEST(cone_fit, a_cone_stands_on_its_base) {
  Cone cone;
  cone.apex = {0, 0, 10};
  cone.half_angle = 30 * degree;
  EXPECT_NEAR(cone.distance({0, 0, 6}), -4 * std::sin(30 * degree), 1e-12);
  EXPECT_GT(cone.distance({0, 0, 14}), 0);
}

// Points of a lattice in and out of a leaning cone. From half the angle or half as much again, from an apex a
// quarter too low or too high, five grains beside the axis: the same cone, to the last digits of the fit; as
// near to the true one as half a point.
TEST(cone_fit, ends_in_one_cone_wherever_it_begins) {
  const Cone truth{{1, -.5, 34}, {-std::sin(5 * degree), 0, -std::cos(5 * degree)}, 30 * degree};
  std::vector<LabelledPoint> points;
  for (double z = 1; z < 40; z += 2)
    for (double y = -20; y <= 20; y += 2)
      for (double x = -20; x <= 20; x += 2)
        if (std::hypot(x, y) < 21) points.push_back({{x, y, z}, 8, truth.distance({x, y, z}) < 0});
  const ConeFit settings{2, 1, 21};
  const Cone best = fit_cone(points, truth, settings);
  EXPECT_NEAR(best.half_angle / degree, 30, 1);
  EXPECT_LT(norm(best.apex - truth.apex), 1);
  EXPECT_GT(dot(best.axis, truth.axis), std::cos(1 * degree));
  for (const double angle : {15., 30., 45.})
    for (const double apex : {25., 34., 45.})
      for (const double beside : {0., 5.}) {
        const Cone found = fit_cone(points, {{beside, -beside, apex}, {0, 0, -1}, angle * degree}, settings);
        EXPECT_NEAR(found.half_angle / degree, best.half_angle / degree, .05)
            << angle << " " << apex << " " << beside;
        EXPECT_LT(norm(found.apex - best.apex), .1) << angle << " " << apex << " " << beside;
      }
}

// A pin narrower than four radii on top of a stump is no part of it.
TEST(cone_fit, a_pin_on_a_stump_does_not_count) {
  for (const auto &[angle, depth] : {std::pair{30., 34.}, std::pair{40., 26.}})
    for (const double pin : {0., 1.5}) {
      const Cone cone{{0, 0, depth * radius}, {0, 0, -1}, angle * degree};
      Cylinder c;
      c.cut([&, depth = depth](const Vector3 &x) {
        const bool in_pin = std::hypot(x.x, x.y) < pin * radius && x.z < (depth + 10) * radius;
        return (cone.distance(x) < 0 && x.z < .5 * depth * radius) || in_pin ? 1 : Cylinder::crumbs;
      });
      const ConePiece found = measure_cones(
          c.particles, c.bonds, find_sound_pieces(c.particles, c.bonds, c.shape), c.shape)[bottom_end];
      EXPECT_TRUE(found.is_cone()) << words_of(found.verdict);
      EXPECT_NEAR(found.half_angle / degree, angle, 1) << pin;
      EXPECT_NEAR(found.apex_depth / radius, depth, 1) << pin;
      EXPECT_GT(found.overlap, .96) << angle << " " << pin;
    }
}

} // namespace
} // namespace platen::dem
