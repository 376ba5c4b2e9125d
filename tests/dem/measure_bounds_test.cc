// Where measures look and where they do not: cores, ends, levers, and the gates of cones.
#include <gtest/gtest.h>

#include <cmath>

#include "dem/measure/circumference.h"
#include "dem/measure/cone.h"
#include "dem/measure/failure_pattern.h"
#include "dem/measure/stress.h"
#include "tests/dem/broken_specimens.h"

namespace platen::dem::measure_bounds_test {
namespace {

using namespace examples;

// Within half of the radius about the axis; of a box within half of its half-width, as a square.
TEST(measure_bounds, damage_by_region_does_not_see_the_rim) {
  for (const bool square : {false, true}) {
    Cylinder rim, core;
    const double rc = Cylinder::width * radius;
    const auto off = [&](const Vector3 &m) {
      return square ? std::max(std::abs(m.x), std::abs(m.y)) : std::hypot(m.x, m.y);
    };
    break_where(rim.bonds, rim.particles, [&](const Vector3 &m) { return off(m) >= .5 * rc; });
    break_where(core.bonds, core.particles, [&](const Vector3 &m) { return off(m) < .5 * rc; });
    const Shape shape = square ? box(2 * rc, 2 * rc, rim.height()) : rim.shape;
    const DamageByRegion none = damage_by_region(rim.particles, rim.bonds, shape, bond_losses(rim.bonds));
    for (const double share : {none.end_top, none.end_bottom, none.middle})
      EXPECT_EQ(share, 0) << square;
    const DamageByRegion all = damage_by_region(core.particles, core.bonds, shape, bond_losses(core.bonds));
    for (const double share : {all.end_top, all.end_bottom, all.middle})
      EXPECT_EQ(share, 1) << square;
  }
}

TEST(measure_bounds, the_end_that_spread_more_counts) {
  std::vector<double> opening{.8, .9, 1, 1, 1, 1, 1, .7, .5, .2};
  EXPECT_DOUBLE_EQ(end_spread(opening), .8);
  std::swap(opening.front(), opening.back());
  EXPECT_DOUBLE_EQ(end_spread(opening), .8);
}

// Force times the way from centre to contact: unlike spheres share it as their radii, which a volume-weighted
// sum cannot tell.
TEST(measure_bounds, a_bond_stresses_each_sphere_by_its_own_radius) {
  Specimen s = spheres({{0, 0, 0}, {4 * radius, 0, 0}});
  s.radius = {radius, 3 * radius};
  Model model(s, bonded());
  Particles &p = model.particles;
  const double strain = 1e-6, fraction = .6;
  p.position[1].x *= 1 + strain;
  const double force = model.bonds->response(0, p).normal_force;
  ASSERT_GT(force, 0);
  const auto stress = particle_stress(p, model.bonds.get(), nullptr, fraction);
  for (std::size_t i = 0; i < 2; ++i) {
    const double volume = 4.0 / 3.0 * pi * std::pow(p.radius[i], 3) / fraction;
    EXPECT_NEAR(stress[i][0] * volume, force * p.radius[i], 1e-5 * force * radius) << i;
  }
}

// The same cone under stricter rules, one at a time: each gate names what it refuses.
TEST(measure_bounds, every_rule_refuses_a_dead_zone_that_does_not_keep_it) {
  const Cylinder c;
  const Specimen before = specimen_before(c.particles, c.shape);
  const Cone cone{{1, 0, 34}, {-std::sin(5 * degree), 0, -std::cos(5 * degree)}, 30 * degree};
  const MotionAfterPeak motion = motion_of(
      before, [&](const Vector3 &x) { return cone.distance(x) < 0 ? of_bottom : outwards(x) + half_way; });
  const DeadZone found = find_dead_zones(before, motion).at_end[bottom_end];
  ASSERT_TRUE(found.is_cone()) << words_of(found.verdict);
  using R = DeadZoneRules;
  using V = DeadZoneVerdict;
  const double offset = std::hypot(found.apex.x, found.apex.y) / (Cylinder::width * radius);
  for (const auto &[member, value, more, refusal] :
       {std::tuple{&R::least_roundness, found.roundness, 1., V::wedge},
        std::tuple{&R::least_overlap, found.overlap, 1., V::ragged},
        std::tuple{&R::least_straightness, found.straightness, 1., V::dome},
        std::tuple{&R::sure_base, found.base_ratio, 1., V::doubtful},
        std::tuple{&R::least_angle, found.half_angle, 1., V::does_not_narrow},
        std::tuple{&R::largest_angle, found.half_angle, -1., V::does_not_narrow},
        std::tuple{&R::largest_tilt, found.tilt, -1., V::leans},
        std::tuple{&R::largest_offset, offset, -1., V::leans},
        std::tuple{&R::largest_volume, found.volume_fraction, -1., V::large}})
    for (const double side : {1., -1.}) {
      DeadZoneRules rules;
      rules.*member = value * (1 + .01 * more * side);
      EXPECT_EQ(find_dead_zones(before, motion, rules).at_end[bottom_end].verdict,
                side > 0 ? refusal : V::cone)
          << words_of(refusal);
    }
}

// A third of the skin stays where it is: the chain reads two thirds of what the others do, opening and
// closing.
TEST(measure_bounds, a_chain_counts_what_stays_behind) {
  Cylinder c;
  const Circumference chain(c.particles, c.shape, nullptr);
  Particles &moved = c.particles;
  for (const double strain : {2e-3, -2e-3}) {
    double all = 0, still = 0;
    for (std::size_t i = 0; i < moved.size(); ++i) {
      const Vector3 &x = moved.reference_position[i];
      const bool stays = std::fmod(std::atan2(x.y, x.x) + pi, 2 * pi / 12) < pi / 18;
      const bool middle = std::abs(x.z - .5 * c.height()) < .25 * c.height();
      if (middle && std::hypot(x.x, x.y) > (Cylinder::width - 2) * radius) all += 1, still += stays;
      const double by = !middle ? 2 * strain : stays ? 0 : strain;
      moved.position[i] = {x.x * (1 + by), x.y * (1 + by), x.z};
    }
    EXPECT_NEAR(chain.strain(moved) / strain, 1 - still / all, .05) << strain;
    EXPECT_NEAR(still / all, .33, .03);
  }
}

// Lengths and shares that verdicts compare with.
TEST(measure_bounds, failure_is_measured_in_widths_and_shares_of_the_specimen) {
  Cylinder c;
  c.cut([&](const Vector3 &x) { return x.z < 16 * radius ? Cylinder::crumbs : 1; });
  double broken = 0;
  for (std::size_t k = 0; k < c.bonds.initial_count(); ++k)
    broken += is_broken(c.bonds.state[k]);
  const FailureMeasures m = measure_failure(c.particles, c.bonds, c.shape, {}, {});
  EXPECT_NEAR(m.width, 2 * Cylinder::width * radius, 1e-12);
  EXPECT_EQ(m.height, c.height());
  EXPECT_NEAR(m.broken_fraction, broken / static_cast<double>(c.bonds.initial_count()), 1e-12);
}

// Box and cylinder hold what is nearer to the axis than their walls, along each of their own widths.
TEST(measure_bounds, a_region_holds_what_is_within_its_walls) {
  const Region slab{box(2, 4, 1), 3};
  for (const auto &[x, inside] :
       {std::pair{Vector3{.9, 1.9, 3.5}, true}, std::pair{Vector3{-.9, -1.9, 3.1}, true},
        std::pair{Vector3{1.1, 0, 3.5}, false}, std::pair{Vector3{-1.1, .5, 3.5}, false},
        std::pair{Vector3{0, 2.1, 3.5}, false}, std::pair{Vector3{0, -2.1, 3.5}, false},
        std::pair{Vector3{0, 0, 2.9}, false}, std::pair{Vector3{0, 0, 4.1}, false}})
    EXPECT_EQ(slab.holds(x), inside) << x.x << " " << x.y << " " << x.z;
  const Region round{cylinder(2, 1), 0};
  EXPECT_TRUE(round.holds({1.4, -1.4, .5}));
  EXPECT_FALSE(round.holds({1.5, 1.5, .5}));
  EXPECT_FALSE(round.holds({0, 0, 1.1}));
}

} // namespace
} // namespace platen::dem::measure_bounds_test
