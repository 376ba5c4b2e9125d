// A wall around a specimen, sphere by sphere.
#include "dem/lateral_wall.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/dem/examples.h"

namespace platen::dem::lateral_wall_test {
namespace {

using namespace examples;

constexpr double stiffness = 1e6; // N/m
constexpr double far = 1;         // m, more than anything has moved by

// A sphere that touches a wall, then a tenth of a radius deep in it: pushed back along its normal, energy and
// pressure of springs.
TEST(lateral_wall, pushes_inwards_whatever_reaches_it) {
  const double wide = 20 * radius, broad = 30 * radius, deep = .1 * radius, height = 9 * radius;
  const Shape square = box(wide, broad, 10 * radius), round = cylinder(.5 * wide, 10 * radius);
  struct Case {
    Shape shape;
    Vector3 out, beside; // beside: along the wall, m
  };
  std::vector<Case> cases{{square, {1, 0, 0}, {}},
                          {square, {-1, 0, 0}, {0, 3 * radius, 0}},
                          {square, {0, 1, 0}, {radius, 0, 0}},
                          {square, {0, -1, 0}, {}}};
  for (const double angle : {0., 1., 2.5, -2.})
    cases.push_back({round, {std::cos(angle), std::sin(angle), 0}, {}});
  for (const Case &c : cases) {
    SCOPED_TRACE(testing::Message() << c.out.x << ' ' << c.out.y);
    const double half = .5 * (c.out.x == 0 ? broad : wide);
    Model model(spheres({(half - radius) * c.out + c.beside, {0, 0, 0}}),
                bonded()); // the second touches nothing
    Particles &p = model.particles;
    const std::size_t one = row_of(p, 0), other = row_of(p, 1);
    LateralWall wall(p, c.shape, stiffness, 0);
    wall.add_forces(p, far);
    EXPECT_LT(wall.force(), 1e-9 * stiffness * deep);
    if (&c < &cases[4]) {
      EXPECT_EQ(wall.force(), 0);
    }
    p.position[one] += deep * c.out;
    p.force[one] = p.force[other] = {};
    wall.add_forces(p, far);
    EXPECT_LT(norm(p.force[one] + stiffness * deep * c.out), 1e-9 * stiffness * deep);
    EXPECT_EQ(norm(p.force[other]), 0);
    EXPECT_NEAR(wall.force(), stiffness * deep, 1e-9 * stiffness * deep);
    EXPECT_NEAR(wall.elastic_energy(), .5 * stiffness * deep * deep, 1e-9 * stiffness * deep * deep);
    const double around = &c < &cases[4] ? 2 * (wide + broad) : pi * wide;
    EXPECT_NEAR(wall.pressure(height) * around * height, wall.force(), 1e-9 * wall.force());
  }
}

// In the corner of a box both walls push. Within the layer a sphere is seated at its own gap, beyond it meets
// the wall where the wall stands.
TEST(lateral_wall, seats_what_lies_within_its_layer) {
  const double half = 10 * radius, gap = .3 * radius, step = .1 * radius;
  for (const bool seated : {true, false}) {
    const double place = half - radius - gap;
    Model model(spheres({{place, place, 0}}), bonded());
    Particles &p = model.particles;
    LateralWall wall(p, box(2 * half, 2 * half, 10 * radius), stiffness, seated ? .4 * radius : .2 * radius);
    const double rest = seated ? place : half - radius;
    for (const double beyond : {-step, 0., step, 2 * step}) {
      p.position[0] = {rest + beyond, rest + beyond, 0};
      p.force[0] = {};
      wall.add_forces(p, far);
      const double wanted = -stiffness * std::max(0., beyond);
      EXPECT_NEAR(p.force[0].x, wanted, 1e-9 * stiffness * step) << seated << beyond;
      EXPECT_NEAR(p.force[0].y, wanted, 1e-9 * stiffness * step) << seated << beyond;
    }
    EXPECT_EQ(wall.seats(), seated ? 2u : 0u);
  }
}

} // namespace
} // namespace platen::dem::lateral_wall_test
