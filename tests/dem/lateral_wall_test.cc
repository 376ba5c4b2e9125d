// A wall around a specimen, sphere by sphere.
#include "dem/lateral_wall.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/dem/examples.h"

namespace platen::dem {
namespace {

using namespace examples;

constexpr double stiffness = 1e6; // N/m
constexpr double far = 1;         // m, more than anything has moved by

// Each sphere of a row a tenth of a radius deep in one wall: pushed back along its normal, energy and
// pressure of springs.
TEST(lateral_wall, pushes_inwards_whatever_reaches_it) {
  const double wide = 20 * radius, broad = 30 * radius, deep = .1 * radius;
  const auto at = [](double half) { return half - radius; };
  struct Case {
    Vector3 place, inward;
  };
  const Case box_cases[] = {{{at(.5 * wide), 0, 0}, {-1, 0, 0}},
                            {{-at(.5 * wide), 3 * radius, 0}, {1, 0, 0}},
                            {{radius, at(.5 * broad), 0}, {0, -1, 0}},
                            {{0, -at(.5 * broad), 0}, {0, 1, 0}}};
  for (const Case &c : box_cases) {
    Model model(spheres({c.place, {0, 0, 0}}), bonded()); // the second touches nothing
    Particles &p = model.particles;
    const std::size_t one = row_of(p, 0), other = row_of(p, 1);
    LateralWall wall(p, box(wide, broad, 10 * radius), stiffness, 0);
    wall.add_forces(p, far);
    EXPECT_EQ(wall.force(), 0) << c.inward.x << c.inward.y;
    p.position[one] -= deep * c.inward;
    p.force[one] = p.force[other] = {};
    wall.add_forces(p, far);
    EXPECT_LT(norm(p.force[one] - stiffness * deep * c.inward), 1e-9 * stiffness * deep)
        << c.inward.x << c.inward.y;
    EXPECT_EQ(norm(p.force[other]), 0);
    EXPECT_NEAR(wall.force(), stiffness * deep, 1e-9 * stiffness * deep);
    EXPECT_NEAR(wall.elastic_energy(), .5 * stiffness * deep * deep, 1e-9 * stiffness * deep * deep);
    const double height = 9 * radius;
    EXPECT_NEAR(wall.pressure(height) * 2 * (wide + broad) * height, wall.force(), 1e-9 * wall.force());
  }
  for (const double angle : {0., 1., 2.5, -2.}) {
    const Vector3 out{std::cos(angle), std::sin(angle), 0};
    Model model(spheres({at(.5 * wide) * out, {0, 0, 0}}), bonded());
    Particles &p = model.particles;
    const std::size_t one = row_of(p, 0);
    LateralWall wall(p, cylinder(.5 * wide, 10 * radius), stiffness, 0);
    p.position[one] += deep * out;
    p.force[one] = {};
    wall.add_forces(p, far);
    EXPECT_LT(norm(p.force[one] + stiffness * deep * out), 1e-9 * stiffness * deep) << angle;
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
} // namespace platen::dem
