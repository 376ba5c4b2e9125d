// The yielding parallel bond, one bond with prescribed motion, against its closed forms.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/dem/one_yielding_bond.h"

namespace platen::dem {
namespace {

using namespace one_yielding_bond;

// What the parallel bond does where nothing yields or breaks: same force, torques, energy and ratios.
TEST(YieldingParallelBond, is_the_parallel_bond_until_it_yields) {
  YieldingParallelBond::Parameters p = concrete();
  Bond pair(p);
  pair.move({2e-7, -3e-7, -1e-6}, {1e-4, 2e-4, -3e-4}, {-2e-4, 1e-4, 2e-4});
  const auto &g = pair.geometry;
  const ParallelBond elastic(p);
  const BondResponse<double> r = elastic({g.reference, g.rest_length, g.lever, g.normal_stiffness, g.radius},
                                         {pair.pose.distance, pair.pose.turn_i, pair.pose.turn_j});
  const BondResponse<double> told = pair.law.bond_response(pair.state, g, pair.pose);
  const auto near = [](const Triple<double> &a, const Triple<double> &b, double of) {
    EXPECT_LT(norm(examples::vector(a - b)), 1e-13 * of);
  };
  const double force = root(dot(r.force, r.force)), torque = force * length;
  near(pair.now.force, r.force, force);
  near(pair.now.torque_i, r.torque_i, torque);
  near(pair.now.torque_j, r.torque_j, torque);
  near(told.force, r.force, force);
  near(told.torque_j, r.torque_j, torque);
  EXPECT_NEAR(pair.now.energy, r.energy, 1e-13 * r.energy);
  EXPECT_NEAR(told.tension_ratio, r.tension_ratio, 1e-13);
  EXPECT_NEAR(told.shear_ratio, r.shear_ratio, 1e-13);
  EXPECT_NEAR(told.shear_force, r.shear_force, 1e-13 * force);
  EXPECT_EQ(pair.state.plastic, 0);
  EXPECT_EQ(pair.state.broken, 0);
}

// Stresses at given strains by the straight branches, by hand: 60 MPa at e_1 = 60/48000, slopes G/3, G/12,
// G/22.
TEST(YieldingParallelBond, closing_yields_along_three_branches) {
  YieldingParallelBond::Parameters p = concrete();
  p.shear_strength = 0;
  const double e1 = 60e6 / modulus, e2 = e1 + 3 * 50e6 / modulus, e3 = e2 + 12 * 50e6 / modulus,
               e4 = e3 + 22 * 40e6 / modulus;
  const double strains[] = {0.5 * e1, e1, 0.5 * (e1 + e2), e2, e3, e4};
  const double stresses[] = {30e6, 60e6, 85e6, 110e6, 160e6, 200e6};
  Bond pair(p);
  double at = 0;
  for (int k = 0; k < 6; ++k) {
    pair.move({0, 0, -(strains[k] - at) * length});
    at = strains[k];
    EXPECT_NEAR(pair.stress(), -stresses[k], 1e-9 * stresses[k]) << "strain " << at;
  }
  pair.move({0, 0, 100e6 / modulus * length}); // unloads with the modulus
  EXPECT_NEAR(pair.stress(), -100e6, 1e-9 * 100e6);
  pair.move({0, 0, -50e6 / modulus * length}); // and loads again with it
  EXPECT_NEAR(pair.stress(), -150e6, 1e-9 * 150e6);
  pair.move({0, 0, -100e6 / modulus * length}); // 50 MPa of it elastic, the rest along the last branch
  EXPECT_NEAR(pair.stress(), -(200e6 + 50e6 / 22), 1e-9 * 200e6);
}

// A closed path within what has yielded gives back all of its work; steps that end where branches do, so that
// the trapezoid is exact.
TEST(YieldingParallelBond, work_is_what_is_stored_and_what_yield_took) {
  Bond pair(concrete());
  const double e1 = 60e6 / modulus * length, e2 = 3 * 50e6 / modulus * length,
               e3 = 12 * 50e6 / modulus * length;
  for (const double by : {e1, e2, e3})
    pair.move({0, 0, -by});
  const double area = pair.geometry.area;
  const double whole = area * (0.5 * 60e6 * e1 + 85e6 * e2 + 135e6 * e3);
  EXPECT_NEAR(pair.work, whole, 1e-12 * whole);
  EXPECT_NEAR(pair.now.energy, 0.5 * area * 160e6 * 160e6 / pair.geometry.normal_stiffness, 1e-12 * whole);
  EXPECT_NEAR(pair.balance(), pair.work, 1e-12 * whole);
  const double before = pair.work;
  for (const double by : {0.2e-6, -0.1e-6, 0.3e-6, -0.4e-6}) // never deeper than it was
    pair.move({0, 0, by});
  EXPECT_NEAR(pair.work, before, 1e-12 * whole);
  EXPECT_NEAR(pair.balance(), pair.work, 1e-12 * whole);
}

// Tension from the zero that yield has shifted: it breaks at the strength, not before, at once.
TEST(YieldingParallelBond, breaks_in_tension_at_its_strength_from_the_shifted_zero) {
  Bond pair(concrete());
  pair.move({0, 0, -60e6 / modulus * length});
  pair.move({0, 0, -40e6 / modulus * length});
  const double plastic = pair.state.plastic;
  EXPECT_NEAR(plastic, 100e6 - (60e6 + 40e6 / 3), 1);
  const double back = -pair.stress() / pair.geometry.normal_stiffness;
  pair.move({0, 0, back + pair.closing(9e6 * (1 - 1e-9))});
  EXPECT_EQ(pair.state.broken, 0);
  EXPECT_NEAR(pair.stress(), 9e6, 1);
  const double stored = pair.now.energy;
  pair.move({0, 0, pair.closing(9e6 * 1e-6)});
  EXPECT_EQ(pair.state.broken, 1);
  EXPECT_GT(pair.now.failed_now, 0);
  EXPECT_EQ(dot(pair.now.force, pair.now.force), 0);
  EXPECT_NEAR(pair.state.dissipated, stored, 1e-5 * stored);
  EXPECT_NEAR(pair.balance(), pair.work, 1e-12 * pair.work);
}

// tau_c + mu_1 N / A, by half of N; bending and twisting count by beta.
TEST(YieldingParallelBond, shear_strength_grows_with_compression_and_is_shared_with_twisting) {
  for (const double pressing : {0.0, 20e6, 50e6}) {
    Bond pair(concrete());
    pair.move({0, 0, -pair.closing(pressing)});
    const double strength = 36e6 + 0.5 * pressing, ks = 0.25 * pair.geometry.normal_stiffness;
    const auto slide = [&](double stress) { // along x, at constant distance: both turn about y by as much
      const double turn = stress / ks / length;
      pair.move({}, {0, turn, 0}, {0, turn, 0});
    };
    slide(0.9999 * strength);
    EXPECT_EQ(pair.state.broken, 0) << pressing;
    EXPECT_NEAR(pair.shear(), 0.9999 * strength, 1e-3 * strength) << pressing;
    slide(0.002 * strength);
    EXPECT_EQ(pair.state.broken, 2) << pressing;
    // What is left is friction at its limit.
    EXPECT_NEAR(pair.shear(), 0.35 * pressing, 1e-9 * strength) << pressing;
    EXPECT_NEAR(pair.stress(), -pressing, 1e-6 * strength) << pressing;
  }
  // Twisting alone: |M_t| R/J = k_s theta R, by beta.
  Bond twisted(concrete());
  const double ks = 0.25 * twisted.geometry.normal_stiffness, at = 36e6 / (0.22 * ks * radius);
  twisted.move({}, {}, {0, 0, 0.99 * at});
  EXPECT_EQ(twisted.state.broken, 0);
  twisted.move({}, {}, {0, 0, 0.02 * at});
  EXPECT_EQ(twisted.state.broken, 2);
  EXPECT_EQ(dot(twisted.now.torque_j, twisted.now.torque_j), 0);
}

// The contact of what has broken has the same zero, goes on yielding where the bond was, and neither pulls
// nor bends.
TEST(YieldingParallelBond, what_has_broken_goes_on_yielding_from_the_same_zero) {
  YieldingParallelBond::Parameters p = concrete();
  Bond pair(p), whole(p);
  pair.move({0, 0, -70e6 / modulus * length});
  whole.move({0, 0, -70e6 / modulus * length});
  const double turn = 80e6 / (0.25 * pair.geometry.normal_stiffness) / length;
  pair.move({}, {0, turn, 0}, {0, turn, 0});
  ASSERT_EQ(pair.state.broken, 2);
  for (const double strain : {80e6, 200e6, 900e6}) { // of an elastic bond
    for (Bond *one : {&pair, &whole})
      one->move({0, 0, length * (1 - strain / modulus) - one->pose.distance.z});
    EXPECT_NEAR(pair.stress(), whole.stress(), 1e-9 * std::abs(whole.stress())) << strain;
  }
  EXPECT_EQ(pair.state.plastic, whole.state.plastic);
  pair.move({0, 0, 0.1 * length});
  EXPECT_EQ(dot(pair.now.force, pair.now.force), 0);
  pair.move({}, {}, {0.1, 0.1, 0.1});
  EXPECT_EQ(dot(pair.now.torque_i, pair.now.torque_i) + dot(pair.now.torque_j, pair.now.torque_j), 0);
}

// Turned as a whole by any angle, whole or broken: nothing is stored, force turns along.
TEST(YieldingParallelBond, a_rigid_turn_stores_nothing_and_forces_go_along) {
  for (const bool broken : {false, true}) {
    Bond pair(concrete());
    pair.move({1e-7, 2e-7, -6e-6}, {1e-4, 0, 2e-4}, {0, -1e-4, 1e-4});
    if (broken) {
      pair.move({}, {0, 0.01, 0}, {0, 0.01, 0});
      ASSERT_EQ(pair.state.broken, 2);
      pair.move({}, {0, -2e-4, 0}, {0, -2e-4, 0}); // sticks
    } else {
      ASSERT_EQ(pair.state.broken, 0);
    }
    const double energy = pair.now.energy, dissipated = pair.state.dissipated;
    const double normal = pair.stress(), shear = pair.shear();
    const int steps = 40000;
    for (const bool about_itself : {false, true}) {
      const Triple<double> axis =
          about_itself ? scale(1 / root(dot(pair.pose.distance, pair.pose.distance)), pair.pose.distance)
                       : Triple<double>{1, 0, 0};
      const Triple<double> turn = scale(2.25 * pi / steps, axis);
      for (int k = 0; k < steps; ++k) {
        const Triple<double> to = turned(Bond::turned_by({1, 0, 0, 0}, turn), pair.pose.distance);
        pair.move(to - pair.pose.distance, turn, turn);
      }
    }
    EXPECT_NEAR(pair.now.energy, energy, 1e-5 * energy) << broken;
    EXPECT_NEAR(pair.state.dissipated, dissipated, 1e-5 * energy) << broken;
    EXPECT_NEAR(pair.stress(), normal, 1e-9 * std::abs(normal)) << broken;
    EXPECT_NEAR(pair.shear(), shear, 1e-5 * std::abs(normal)) << broken;
  }
}

// Force and torques that balance on both: T_i + T_j + d x F_j = 0.
TEST(YieldingParallelBond, moments_balance_whole_and_broken) {
  Bond pair(concrete());
  for (int k = 0; k < 60; ++k) {
    pair.move({2e-7, 1e-7, -4e-7}, {4e-4, -3e-4, 1e-4}, {2e-4, 3e-4, -2e-4});
    const Triple<double> sum =
        pair.now.torque_i + pair.now.torque_j - cross(pair.pose.distance, pair.now.force);
    EXPECT_LT(root(dot(sum, sum)), 1e-14 * length * root(dot(pair.now.force, pair.now.force))) << k;
  }
  EXPECT_GT(pair.state.broken, 0);
}

// What has broken acts at the point that divides the distance as the radii do.
TEST(YieldingParallelBond, friction_of_unequal_spheres_acts_at_their_point_of_contact) {
  Bond pair(concrete());
  pair.geometry.lever = 0.3;
  pair.move({0, 0, -pair.closing(30e6)});
  pair.move({}, {0, 0.01, 0}, {0, 0.01, 0});
  ASSERT_EQ(pair.state.broken, 2);
  const Triple<double> moment = cross(pair.pose.distance, pair.now.force);
  ASSERT_GT(std::abs(moment.y), 0);
  EXPECT_NEAR(pair.now.torque_i.y, 0.3 * moment.y, 1e-12 * std::abs(moment.y));
  EXPECT_NEAR(pair.now.torque_j.y, 0.7 * moment.y, 1e-12 * std::abs(moment.y));
}

// A factor scales both strengths and leaves friction alone.
TEST(YieldingParallelBond, a_strength_factor_scales_both_strengths) {
  Bond pair(concrete());
  pair.geometry.strength_factor = 2;
  pair.move({0, 0, pair.closing(17.99e6)});
  EXPECT_EQ(pair.state.broken, 0);
  pair.move({0, 0, pair.closing(0.02e6)});
  EXPECT_EQ(pair.state.broken, 1);
}

} // namespace
} // namespace platen::dem
