// The facet bond, one bond with prescribed motion, against its closed forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "tests/dem/one_bond.h"

namespace platen::dem {
namespace {

constexpr double modulus = 28e9, length = 3e-3, radius = 1.2e-3; // Pa, m, m
constexpr double stiffness = modulus / length;                   // k_n, Pa/m

FacetBond::Parameters concrete() {
  FacetBond::Parameters p;
  p.stiffness_ratio = 0.25;
  p.tensile_strength = 4e6, p.shear_strength = 11e6;
  p.fracture_energy = 12 * 0.5 * 4e6 * 4e6 / stiffness; // l_t/L = 12
  p.friction_static = 0.2, p.transitional_stress = 600e6, p.friction_dynamic = 0.6;
  p.compression_limits = {40e6, 90e6, 300e6}, p.compression_slopes = {3, 12, 20};
  return p;
}

// Led along its axis, and across by turning both spheres, so that the axis stays where it is.
struct Bond : examples::OneBond<FacetBond> {
  double at[3] = {}; // Pa, along and across: of the elastic bond at the same place
  explicit Bond(const FacetBond::Parameters &p = concrete())
      : OneBond(FacetBond(p), modulus, length, radius) {}
  void to(double pulled, double sheared, double other = 0, int steps = 1) {
    const auto angle = [this](double stress) {
      return std::asin(stress / (law.parameters.stiffness_ratio * stiffness) / length);
    };
    const Triple<double> turn{angle(sheared) - angle(at[1]), angle(other) - angle(at[2]), 0};
    move({0, 0, (pulled - at[0]) / stiffness}, turn, turn, steps);
    at[0] = pulled, at[1] = sheared, at[2] = other;
  }
};

// N = A sigma_t exp(-h (T/sigma_t - 1)), h = 2/(l_t/L - 1), at any opening; it unloads to the origin.
TEST(FacetBond, tension_softens_exponentially_and_unloads_to_the_origin) {
  const double h = 2.0 / 11;
  Bond bond;
  bond.to(4e6 * (1 - 1e-9), 0);
  EXPECT_NEAR(bond.normal(), 4e6, 1e-8 * 4e6);
  EXPECT_EQ(bond.state.damage, 0);
  for (const double at : {5e6, 8e6, 20e6, 60e6}) {
    bond.to(at, 0);
    const double expected = 4e6 * std::exp(-h * (at / 4e6 - 1));
    EXPECT_NEAR(bond.normal(), expected, 1e-10 * expected) << at;
    EXPECT_EQ(bond.state.broken, 0);
  }
  const double there = bond.normal();
  bond.to(30e6, 0);
  EXPECT_NEAR(bond.normal(), 0.5 * there, 1e-8 * there);
  bond.to(0, 0);
  EXPECT_NEAR(bond.normal(), 0, 1e-6 * there);
  bond.to(-10e6, 0); // closed: whole
  EXPECT_NEAR(bond.normal(), -10e6, 1e-8 * 10e6);
}

// From nothing to failure, and with it what the bond stored: G for each area, less what least_left leaves.
TEST(FacetBond, tension_takes_the_fracture_energy) {
  for (const double ductility : {1.5, 3.0, 12.0, 60.0}) {
    FacetBond::Parameters p = concrete();
    p.fracture_energy = ductility * 0.5 * 4e6 * 4e6 / stiffness;
    Bond bond(p);
    EXPECT_NEAR(bond.law.ductility(bond.geometry), ductility, 1e-12 * ductility);
    for (int k = 1; k < 200000 && bond.state.broken == 0; ++k)
      bond.to(k * 4e3 * ductility, 0);
    EXPECT_EQ(bond.state.broken, 1);
    EXPECT_EQ(bond.state.damage, 1);
    EXPECT_TRUE(FacetBond::failed_in_tension(bond.state));
    const double whole = p.fracture_energy * bond.geometry.area;
    EXPECT_NEAR(bond.state.dissipated, whole, 1e-3 * whole) << ductility;
    EXPECT_LT(bond.state.dissipated, whole) << ductility; // least_left
    EXPECT_NEAR(bond.balance(), bond.work, 1e-9 * whole) << ductility;
    EXPECT_EQ(bond.now.energy, 0);
  }
}

// The published strength under tension and shear, sigma_0 (w), along straight paths.
TEST(FacetBond, fails_at_the_published_strength_of_mixed_modes) {
  const double alpha = 0.25, r = 11.0 / 4;
  for (const double degrees : {89.0, 60.0, 45.0, 20.0, 5.0, 1.0}) {
    const double w = degrees * pi / 180, s = std::sin(w), c = std::cos(w);
    const double published =
        4e6 * (-s + std::sqrt(s * s + 4 * alpha * c * c / (r * r))) / (2 * alpha * c * c / (r * r));
    const double tension = published * s, shear = std::sqrt(alpha) * published * c;
    Bond below, above, far;
    below.to((1 - 1e-8) * tension, (1 - 1e-8) * shear);
    EXPECT_EQ(below.state.damage, 0) << degrees;
    above.to((1 + 1e-8) * tension, (1 + 1e-8) * shear);
    EXPECT_GT(above.state.damage, 1e-9) << degrees;
    // Beyond, sigma = sigma_0 exp(-H_0 (e - e_0)/sigma_0), H_0 = H_t (2 w/pi)^n, sigma^2 = T^2 + t^2/alpha.
    far.to(3 * tension, 3 * shear);
    const double left = published * std::exp(-2 * 2.0 / 11 * std::pow(2 * w / pi, 0.2));
    EXPECT_NEAR(std::hypot(far.normal(), far.shear() / std::sqrt(alpha)), left, 1e-9 * left) << degrees;
    EXPECT_NEAR(far.shear() / far.normal(), shear / tension, 1e-9 * shear / tension) << degrees;
  }
}

// sigma_bs = sigma_s + mu_0 sigma_0 (1 - exp(-s/sigma_0)), and back to it after unloading; nothing is
// damaged.
TEST(FacetBond, shear_under_pressure_is_plastic_at_its_limit) {
  for (const double pressed : {1e6, 10e6, 35e6}) {
    Bond bond;
    const double limit = 11e6 + 0.2 * 600e6 * (1 - std::exp(-pressed / 600e6));
    bond.to(-pressed, 0);
    bond.to(-pressed, (1 - 1e-9) * limit);
    EXPECT_NEAR(bond.shear(), limit, 1e-8 * limit) << pressed;
    EXPECT_EQ(norm(examples::vector(bond.state.slip)), 0) << pressed;
    for (const double at : {1.5, 2.5, 0.4, -2.0}) { // -0.1 is within: 2.5 to 0.4 is 2.1 of 2
      bond.to(-pressed, at * limit, 0, 1000);
      EXPECT_NEAR(bond.shear(), limit, 1e-12 * limit) << pressed << ' ' << at;
    }
    bond.to(-pressed, -1.5 * limit);
    EXPECT_NEAR(bond.shear(), 0.5 * limit, 1e-4 * limit) << pressed;
    EXPECT_EQ(bond.state.damage, 0);
    EXPECT_NEAR(bond.balance(), bond.work, 1e-4 * bond.work) << pressed;
  }
}

// Closed paths in opening and slip. Least and largest of what they did, over energy and stress.
struct Closed {
  double least_step = 0; // dissipated in one step, over A size^2/k_n
  double least_work = 0, worst_balance = 0;
};
Closed closed_paths(int count) {
  Random random(5);
  Closed found;
  for (int path = 0; path < count; ++path) {
    Bond bond;
    const double size = std::exp(random.uniform(std::log(2e6), std::log(60e6)));
    const double unit = bond.geometry.area * size * size / stiffness; // J
    for (int point = 0; point <= 24; ++point) {
      const double from[] = {bond.at[0], bond.at[1], bond.at[2]};
      double next[3];
      for (double &stress : next)
        stress = point < 24 ? random.uniform(-size, size) : 0;
      for (int k = 1; k <= 100; ++k) {
        const double before = bond.state.dissipated + bond.plastic();
        double to[3];
        for (int i = 0; i < 3; ++i)
          to[i] = from[i] + k / 100.0 * (next[i] - from[i]);
        bond.to(to[0], to[1], to[2]);
        const double lost = bond.state.dissipated + bond.plastic() - before;
        found.least_step = std::min(found.least_step, lost / unit);
      }
    }
    found.least_work = std::min(found.least_work, bond.work / unit);
    found.worst_balance = std::max(found.worst_balance, std::abs(bond.balance() - bond.work) / unit);
  }
  return found;
}
// Of a step that reverses friction, the mean force of its ends gives work back: bounds fall with the square
// of the step (30 steps for each point: 9e-4).
void expect_no_gain(const Closed &found) {
  EXPECT_GE(found.least_step, -1e-3);
  EXPECT_GE(found.least_work, -1e-6);
  EXPECT_LT(found.worst_balance, 1e-3);
}
TEST(FacetBond, no_closed_path_gives_energy) {
  expect_no_gain(closed_paths(300));
}
TEST(FacetBond, long_no_closed_path_of_ten_thousand_gives_energy) {
  expect_no_gain(closed_paths(10000));
}

} // namespace
} // namespace platen::dem
