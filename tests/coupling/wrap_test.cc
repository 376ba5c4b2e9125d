// A wrap of fibres around a bonded cylinder, whose hoops confine it until they tear.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "base/pi.h"
#include "coupling/faults.h"
#include "tests/coupling/set_ups.h"

namespace platen::coupling::wrap_test {
namespace {

PlatenTestSettings wrapped(double thickness, double rupture_strain) {
  PlatenTestSettings s = elastic_settings(0.5);
  s.ends = Ends::ground;
  s.model.local_damping = 0.3;
  s.platens.top = s.platens.bottom = {0.0, 0.0};
  s.loading.rate = 0.1;
  SleeveSettings &wall = s.loading.tube.emplace();
  wall.thickness = thickness;
  wall.young_modulus = 230e9, wall.poisson_ratio = 0.35, wall.density = 1600;
  wall.wrap.emplace().rupture_strain = rupture_strain;
  wall.bonded_rims = false;
  wall.clearance = 1e-3;
  wall.elements_around = 16;
  wall.mass_scaling = 1; // these tests are fast: inertia would confine
  wall.contact.friction_static = 0;
  wall.mass_damping = 100;
  return s;
}

void press_to(PlatenTest &test, double closure) {
  while (test.closure_strain() < closure)
    test.step();
}

// p R = E t e, and no stress along the axis but that of the resin between free ends.
TEST(wrap, its_hoops_bear_the_pressure) {
  PlatenTest test(packed_cylinder(), wrapped(0.3e-3, 0.1));
  press_to(test, 1.5e-3);
  const Sleeve::WallState wall = test.tube()->wall_state();
  const double radius = test.shape().radius;
  EXPECT_GT(wall.hoop_strain, 2e-5);
  EXPECT_NEAR(wall.hoop / (230e9 * wall.hoop_strain), 1, 0.03);
  EXPECT_NEAR(test.tube()->specimen_pressure() * radius / (230e9 * wall.hoop_strain * 0.3e-3), 1, 0.05);
  EXPECT_LT(std::abs(wall.axial), 0.01 * wall.hoop);
  EXPECT_GE(wall.most_hoop, wall.hoop_strain);
  EXPECT_EQ(wall.torn, 0);
  EXPECT_EQ(wall.yielded, 0);
  EXPECT_EQ(test.tube_load(), 0);
  EXPECT_LT(std::abs(test.energy().residual()), 1e-3 * test.energy().boundary);
}

TEST(wrap, it_tears_at_its_rupture_strain_and_lets_go) {
  const double rupture = 1.5e-4;
  PlatenTest test(packed_cylinder(), wrapped(0.2e-3, rupture));
  Sleeve::WallState last;
  double pressure = 0; // Pa, before the first tear
  while (test.tube()->torn_elements() == 0 && test.closure_strain() < 8e-3) {
    last = test.tube()->wall_state(), pressure = test.tube()->specimen_pressure();
    test.step();
  }
  ASSERT_GT(test.tube()->torn_elements(), 0);
  EXPECT_NEAR(last.most_hoop / rupture, 1, 0.01);
  const double torn_at = test.closure_strain();
  press_to(test, torn_at + 2e-3);
  const Sleeve::WallState now = test.tube()->wall_state();
  const std::vector<double> shares = test.tube()->solid().fibre_shares();
  EXPECT_GT(now.torn, 0.02);
  EXPECT_LT(now.torn, 1);
  EXPECT_EQ(now.torn, static_cast<double>(test.tube()->torn_elements()) / static_cast<double>(shares.size()));
  EXPECT_LT(test.tube()->specimen_pressure(), 0.5 * pressure);
  EXPECT_LT(now.most_hoop, rupture);
  EXPECT_LT(now.hoop_strain, now.most_hoop);
  EXPECT_GT(test.energy().fracture, 0);
  EXPECT_LT(std::abs(test.energy().residual()), 1e-3 * test.energy().boundary);
}

TEST(wrap, one_of_vanishing_thickness_is_none) {
  PlatenTestSettings thin = wrapped(2e-5, 0.1), bare = thin;
  thin.loading.tube->young_modulus = 3.1e9; // 2e-4 of the specimen's stiffness
  bare.loading.tube.reset();
  PlatenTest none(packed_cylinder(), bare), with(packed_cylinder(), thin);
  press_to(none, 2e-4), press_to(with, 2e-4);
  EXPECT_NEAR(mean_stress(with) / mean_stress(none), 1, 2e-3);
}

// Its own limit is far below that of the particles, whose step it leaves alone.
TEST(wrap, its_mass_is_fitted_to_about_one_step_in_four) {
  PlatenTestSettings fitted = wrapped(0.3e-3, 0.1), bare = fitted;
  fitted.loading.tube->mass_scaling = 0;
  bare.loading.tube.reset();
  PlatenTest test(packed_cylinder(), fitted), none(packed_cylinder(), bare);
  test.step(), none.step();
  EXPECT_NEAR(test.tube()->steps_of_interval(), 4, 1);
  EXPECT_GT(test.tube()->mass_scaling(), 4);
  EXPECT_NEAR(test.time_step() / none.time_step(), 1, 0.15);
}

// Along the hoop the shares beyond one add up to the overlap, from y = 0 on in the direction of the hoop.
TEST(wrap, an_overlap_is_one_layer_more) {
  WrapSettings wrap;
  wrap.layers = 3, wrap.overlap = 0.1, wrap.axial_modulus = 10e9, wrap.rupture_strain = 0.01;
  const double radius = 0.05, width = 2 * pi * radius / 40;
  const fem::Fibres fibres = wrap.fibres(200e9, radius, width);
  EXPECT_EQ(fibres.modulus[0], 200e9 - 3e9);
  EXPECT_EQ(fibres.modulus[1], 10e9 - 3e9);
  EXPECT_EQ(fibres.rupture_strain, 0.01);
  double sum = 0; // m
  for (int k = 0; k < 40; ++k) {
    const double turn = 2 * pi * (k + 0.5) / 40;
    const fem::FibreCell cell = fibres.layout({0.051 * std::cos(turn), 0.051 * std::sin(turn), 0.02});
    EXPECT_NEAR(cell.direction[0].x, -std::sin(turn), 1e-14);
    EXPECT_NEAR(cell.direction[0].y, std::cos(turn), 1e-14);
    EXPECT_EQ(cell.direction[1].z, 1);
    EXPECT_NEAR(cell.share, k < 12 ? 4.0 / 3 : k > 12 ? 1 : 1 + (0.1 / width - 12) / 3, 1e-12) << k;
    sum += 3 * (cell.share - 1) * width;
  }
  EXPECT_NEAR(sum, 0.1, 1e-12);
  wrap.axial_modulus = 0;
  EXPECT_EQ(wrap.fibres(200e9, radius, width).modulus[1], 0);
}

TEST(wrap, its_boundary_lays_the_overlap_on_its_own_elements) {
  PlatenTestSettings s = wrapped(0.3e-3, 0.1);
  WrapSettings &wrap = *s.loading.tube->wrap;
  wrap.layers = 2, wrap.overlap = 0.3 * 2 * pi * packed_cylinder().shape.radius;
  const PlatenTest test(packed_cylinder(), s);
  const fem::HyperelasticSolid &solid = test.tube()->solid();
  double lapped = 0;
  for (const double share : solid.fibre_shares())
    lapped += 2 * (share - 1);
  EXPECT_NEAR(lapped / static_cast<double>(solid.fibre_shares().size()), 0.3, 1e-9);
  EXPECT_EQ(solid.material().fibres->modulus[0], 227e9);
  EXPECT_NEAR(solid.material().law.shear_modulus, 3e9 / 2.7, 1);
}

TEST(wrap, what_cannot_be_one_is_refused) {
  const auto refused = [](const char *member, const auto &change) {
    PlatenTestSettings s = wrapped(0.3e-3, 0.01);
    change(*s.loading.tube);
    try {
      PlatenTest test(coarse_cylinder(), s);
      FAIL() << member;
    } catch (const BadSetup &bad) {
      EXPECT_EQ(bad.member(), member) << bad.what();
    }
  };
  using T = SleeveSettings;
  refused("sleeve.wrap.rupture_strain", [](T &t) { t.wrap->rupture_strain = not_given; });
  refused("sleeve.metal", [](T &t) { t.metal.emplace().yield_strength = 250e6; });
  refused("sleeve.young_modulus", [](T &t) { t.young_modulus = 2.99e9; });
  refused("sleeve.wrap.axial_modulus", [](T &t) { t.wrap->axial_modulus = 2.99e9; });
  refused("sleeve.wrap.overlap", [](T &t) { t.wrap->overlap = 1.001 * 2 * pi * 6e-3; });
  PlatenTestSettings most = wrapped(0.3e-3, 0.1);
  most.loading.tube->young_modulus = 3e9;
  most.loading.tube->wrap->axial_modulus = 3e9;
  most.loading.tube->wrap->overlap = 0.999 * 2 * pi * 6e-3;
  EXPECT_EQ(faults(most, &coarse_cylinder().shape).size(), 0u);
}

} // namespace
} // namespace platen::coupling::wrap_test
