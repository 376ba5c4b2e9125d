// Strength of materials as platen-bar uses it, against tables and limits; and chains of spheres, whose own
// closed forms are known.
#include <gtest/gtest.h>

#include <cmath>

#include "apps/bar/bar_at_rest.h"
#include "apps/bar/bar_oscillations.h"
#include "apps/bar/strength_of_materials.h"
#include "base/pi.h"

namespace platen::apps {
namespace {

// Torsion of rectangles: Timoshenko and Goodier, Theory of Elasticity, table of art. 109.
TEST(bar_theory, rectangles_twist_as_tabulated) {
  const double table[][2] = {{1, .1406}, {1.5, .196}, {2, .229}, {3, .263}, {5, .291}, {10, .312}};
  for (const auto &row : table) {
    EXPECT_NEAR((CrossSection{false, 0, row[0], 1}.torsion_constant()) / row[0], row[1], 6e-4) << row[0];
    EXPECT_DOUBLE_EQ((CrossSection{false, 0, row[0], 1}.torsion_constant()),
                     (CrossSection{false, 0, 1, row[0]}.torsion_constant()));
  }
}

TEST(bar_theory, a_section_comes_back_from_its_gyration) {
  const CrossSection round = section_of_gyration(true, .25 * 9, .25 * 9),
                     flat = section_of_gyration(false, 3, 12);
  EXPECT_DOUBLE_EQ(round.radius, 3);
  EXPECT_DOUBLE_EQ(round.polar_moment(), pi * 81 / 2);
  EXPECT_DOUBLE_EQ(flat.width_x, 6);
  EXPECT_DOUBLE_EQ(flat.width_y, 12);
  EXPECT_DOUBLE_EQ(flat.second_moment(true), 12 * 216 / 12.);
  EXPECT_DOUBLE_EQ(flat.skin(false), 6);
}

Rod steel(double slenderness) { // length over radius
  const CrossSection s{true, .01, 0, 0};
  return {slenderness * .01, 210e9 * s.area(), .3, 7800 * s.area(), s, s, true};
}

// Euler and Bernoulli: bending without shear.
double slender_deflection(const Rod &rod, double force) {
  return force * std::pow(rod.length, 3) / (3 * rod.bending_rigidity());
}
double slender_frequency(const Rod &rod) {
  const double root = 1.875104068711961; // of cos x cosh x = -1
  return root * root / (2 * pi * rod.length * rod.length) *
         std::sqrt(rod.bending_rigidity() / rod.mass_per_length);
}

TEST(bar_theory, slender_beams_know_no_shear) {
  const Rod slender = steel(2000), thick = steel(10);
  EXPECT_NEAR(slender.response(BarLoad::bending, 1) / slender_deflection(slender, 1), 1, 1e-6);
  EXPECT_NEAR(slender.frequency(BarLoad::bending) / slender_frequency(slender), 1, 1e-5);
  // 3 E I / (kappa G A l^2) = 3/4 (R/l)^2 2 (1 + nu) / kappa
  EXPECT_NEAR(thick.response(BarLoad::bending, 1) / slender_deflection(thick, 1) - 1,
              .0075 * 2.6 / (7.8 / 8.8), 1e-12);
  EXPECT_LT(thick.frequency(BarLoad::bending), slender_frequency(thick));
}

// The lowest frequency of a row of rigid pieces, by inverse iteration, comes down to Timoshenko's.
TEST(bar_theory, timoshenko_lies_where_a_discrete_beam_does) {
  // Rigid pieces of length h with mass and inertia of rotation, joined by springs of bending and shear.
  const Rod rod = steel(8);
  const int n = 200;
  const double h = rod.length / n, mass = rod.mass_per_length * h,
               inertia = mass * (.25 * rod.section.radius * rod.section.radius + h * h / 12);
  // Inverse iteration: loads m w^2 u and J w^2 theta, integrated twice along the beam.
  std::vector<double> u(n, 1.0), theta(n, 0.0);
  double omega2 = 0;
  for (int sweep = 0; sweep < 30; ++sweep) {
    std::vector<double> new_u(n), new_theta(n);
    double turn = 0, way = 0;
    for (int k = 0; k < n; ++k) { // joint below piece k, at height k h
      double shear = 0, moment = 0;
      for (int j = k; j < n; ++j) {
        shear += mass * u[static_cast<std::size_t>(j)];
        moment += mass * u[static_cast<std::size_t>(j)] * (j - k + .5) * h +
                  inertia * theta[static_cast<std::size_t>(j)];
      }
      // Half a compliance at the clamp: the first joint is half a piece long.
      turn += moment * h * (k == 0 ? .5 : 1) / rod.bending_rigidity();
      way += shear * h * (k == 0 ? .5 : 1) / rod.shear_rigidity();
      new_theta[static_cast<std::size_t>(k)] = turn;
      new_u[static_cast<std::size_t>(k)] = way + .5 * turn * h;
      way += turn * h;
    }
    double above = 0, below = 0;
    for (std::size_t k = 0; k < static_cast<std::size_t>(n); ++k) {
      above += mass * u[k] * new_u[k] + inertia * theta[k] * new_theta[k];
      below += mass * new_u[k] * new_u[k] + inertia * new_theta[k] * new_theta[k];
    }
    omega2 = above / below;
    const double size = new_u.back();
    for (std::size_t k = 0; k < static_cast<std::size_t>(n); ++k)
      u[k] = new_u[k] / size, theta[k] = new_theta[k] / size;
  }
  EXPECT_NEAR(rod.frequency(BarLoad::bending), std::sqrt(omega2) / (2 * pi),
              2e-3 * rod.frequency(BarLoad::bending));
  EXPECT_GT(1 - rod.frequency(BarLoad::bending) / slender_frequency(rod), .02); // it matters here
}

// n touching spheres joined by beams along z.
class Chain : public ::testing::Test {
protected:
  static constexpr double radius = 1e-3, young = 40e9, poisson = .2, slender = .7, density = 2500;
  static dem::Specimen spheres(int n) {
    dem::Specimen s;
    s.shape = dem::cylinder(radius, 2 * radius * n);
    for (int k = 0; k < n; ++k) {
      s.centre.push_back({0, 0, (2 * k + 1) * radius});
      s.radius.push_back(radius);
    }
    return s;
  }
  static dem::ModelSettings beams() {
    dem::ModelSettings s;
    s.density = density;
    s.local_damping = 0;
    s.bond_layout.modulus = young;
    s.bond_layout.radius_multiplier = slender;
    s.bond_layout.radius_rule = dem::RadiusRule::mean;
    s.bond_layout.gap.value = 1e-6;
    dem::CohesiveBeam::Parameters beam;
    beam.poisson_ratio = poisson;
    s.bond = beam;
    return s;
  }
  explicit Chain(int n = 31) : joints(n - 1), model(spheres(n), beams()) {
    bar = measure_bar(model.particles, *model.bonds, spheres(n).shape, .5, true);
    const CrossSection s{true, slender * radius, 0, 0};
    rod = rod_at_rest(bar, young * s.area(), poisson, s);
  }
  double limit() const { return stable_step(model.particles, model.bonds.get(), nullptr, {}, {}).limit; }
  double oscillate(BarLoad load, double expected) {
    const StaticTest test = load_bar(model, bar, load, rod.load_of_strain(load, 1e-6));
    const double step = .1 * limit();
    const Clocking clocking{step, static_cast<long>(12 / (expected * step)), 20};
    const Oscillation o =
        release(model, bar, load, test.state, expected, clocking, [](const BarSample &) { return true; });
    EXPECT_LT(o.energy_residual.value(), 1e-2);
    return o.frequency;
  }
  int joints;
  dem::Model model;
  BarGeometry bar;
  Rod rod;
};

TEST_F(Chain, is_measured_from_end_to_end) {
  EXPECT_EQ(bar.low.rows.size(), 1u);
  EXPECT_EQ(bar.high.rows.size(), 1u);
  EXPECT_NEAR(bar.length(), 62 * radius, 1e-12);
  EXPECT_NEAR(bar.bounding.radius, radius, 1e-15); // centres on the axis, a radius outside
  EXPECT_NEAR(bar.mass_per_length, 4. / 3 * pi * radius * radius * radius * density / (2 * radius), 1e-9);
  EXPECT_THROW(measure_bar(model.particles, *model.bonds, dem::cylinder(radius, 1), .5, true),
               std::invalid_argument);
}

// Beams in a row are one beam, exactly so at the nodes, however many there are; a chain bends without shear.
TEST_F(Chain, at_rest_is_a_beam_of_euler_and_bernoulli) {
  EXPECT_NEAR(rod.length, 2 * radius * joints, 1e-12);
  for (const BarLoad load : {BarLoad::tension, BarLoad::bending, BarLoad::torsion}) {
    const double size = rod.load_of_strain(load, 1e-4);
    const double by_hand =
        load == BarLoad::bending ? slender_deflection(rod, size) : rod.response(load, size);
    dem::StaticSettings exact;
    exact.tolerance = 1e-15;
    EXPECT_NEAR(load_bar(model, bar, load, size, exact).measured, by_hand, 1e-9 * by_hand)
        << static_cast<int>(load);
  }
}

TEST_F(Chain, the_skin_of_the_clamp_has_the_strain_that_was_asked_for) {
  const double r = slender * radius, i = pi * r * r * r * r / 4;
  EXPECT_NEAR(rod.load_of_strain(BarLoad::tension, 1e-4) / (young * pi * r * r), 1e-4, 1e-16);
  EXPECT_NEAR(rod.load_of_strain(BarLoad::bending, 1e-4) * rod.length * r / (young * i), 1e-4, 1e-16);
  EXPECT_NEAR(rod.load_of_strain(BarLoad::torsion, 1e-4) * r / (young / 2.4 * 2 * i), 1e-4, 1e-16);
}

// n masses on n springs, one end held: omega = 2 sqrt(k/m) sin(pi / (2 (2 n + 1))).
TEST_F(Chain, oscillates_as_masses_on_springs) {
  const double r = slender * radius, k = young * pi * r * r / (2 * radius),
               m = 4. / 3 * pi * radius * radius * radius * density,
               expected = std::sqrt(k / m) * std::sin(pi / (2 * (2 * joints + 1))) / pi;
  EXPECT_NEAR(oscillate(BarLoad::tension, 1.1 * expected), expected, 2e-4 * expected);
}

TEST_F(Chain, twists_as_flywheels_on_shafts) {
  const double r = slender * radius, k = young / 2.4 * pi * r * r * r * r / 2 / (2 * radius),
               m = 4. / 3 * pi * radius * radius * radius * density,
               expected =
                   std::sqrt(k / (.4 * m * radius * radius)) * std::sin(pi / (2 * (2 * joints + 1))) / pi;
  EXPECT_NEAR(oscillate(BarLoad::torsion, .9 * expected), expected, 2e-4 * expected);
}

// A half piece of mass is missing at the clamp: what oscillates ends half a spacing beyond the last centre.
TEST_F(Chain, bends_as_a_beam_with_its_mass_in_points) {
  Rod swinging = rod;
  swinging.length = bar.top - bar.low.z;
  const double by_hand = slender_frequency(swinging);
  EXPECT_NEAR(oscillate(BarLoad::bending, by_hand), by_hand, .03 * by_hand); // rotation of spheres, 1/n
}

class LongChain : public Chain {
protected:
  LongChain() : Chain(160) {}
};

// Short waves of the chain lag behind; the middle of the pulse does not.
TEST_F(LongChain, carries_a_pulse_at_the_speed_of_long_waves) {
  const double c = rod.wave_speed();
  const double step = .2 * limit();
  const Clocking clocking{step, static_cast<long>(followed_passages * bar.length() / (c * step)) + 1, 50};
  int samples = 0;
  const Impact impact = strike(model, bar, 1e-4 * c, 1.03 * c, clocking, [&](const BarSample &) {
    ++samples;
    return true;
  });
  EXPECT_NEAR(impact.speed_end_to_end, c, 1e-3 * c);
  EXPECT_NEAR(impact.speed_quarter_to_half, c, 3e-3 * c);
  EXPECT_NEAR(impact.half_time, 2 * impact.quarter_time, .02 * impact.half_time);
  EXPECT_EQ(samples, 1 + clocking.steps / 50);
}

// A sphere that touches nothing, at the loaded end: neither clamped, loaded nor counted.
TEST_F(Chain, does_not_notice_a_loose_sphere) {
  dem::Specimen with = spheres(joints + 1);
  with.centre.push_back({5 * radius, 0, (2 * joints + 1) * radius});
  with.radius.push_back(radius);
  const dem::Model loose(with, beams());
  const BarGeometry same = measure_bar(loose.particles, *loose.bonds, with.shape, .5, true);
  EXPECT_EQ(same.loose, 1u);
  EXPECT_EQ(same.high.rows.size(), 1u);
  EXPECT_DOUBLE_EQ(same.mass_per_length, bar.mass_per_length);
  const double size = rod.load_of_strain(BarLoad::tension, 1e-4);
  EXPECT_NEAR(load_bar(loose, same, BarLoad::tension, size).measured, rod.response(BarLoad::tension, size),
              1e-6 * rod.response(BarLoad::tension, size));
}

TEST_F(Chain, stops_when_it_is_told_to) {
  const StaticTest test = load_bar(model, bar, BarLoad::tension, 1);
  int samples = 0;
  const Oscillation o = release(model, bar, BarLoad::tension, test.state, 1e3, {limit(), 1000, 5},
                                [&](const BarSample &) { return ++samples < 3; });
  EXPECT_TRUE(o.stopped);
  EXPECT_EQ(o.steps, 10);
}

} // namespace
} // namespace platen::apps
