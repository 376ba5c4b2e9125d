// The yielding parallel bond, one bond with prescribed motion, against its closed forms, and where its energy
// goes, to round-off.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/dem/one_yielding_bond.h"

namespace platen::dem::yielding_parallel_bond_test {
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

// A factor scales both strengths and leaves friction alone.
TEST(YieldingParallelBond, a_strength_factor_scales_both_strengths) {
  Bond pair(concrete());
  pair.geometry.strength_factor = 2;
  pair.move({0, 0, pair.closing(17.99e6)});
  EXPECT_EQ(pair.state.broken, 0);
  pair.move({0, 0, pair.closing(0.02e6)});
  EXPECT_EQ(pair.state.broken, 1);
}

class Dice {
public:
  explicit Dice(unsigned seed) : random_(seed) {}
  double next() { // -.5 ... .5
    return (random_ = random_ * 1664525u + 1013904223u) / 4294967296.0 - 0.5;
  }

private:
  unsigned random_;
};

// Closes and opens by steps of any size, over all kinks, whole and broken, and slides between them by steps
// of any size too: what goes in is stored, taken by yield, by the break or by friction, to round-off.
TEST(YieldingEnergy, is_exact_over_steps_of_any_size) {
  int in_tension = 0, in_shear = 0, apart = 0, slid = 0;
  for (int run = 0; run < 60; ++run) {
    Dice dice(static_cast<unsigned>(run + 1));
    Bond pair(concrete());
    double largest = 0;
    for (int k = 0; k < 400; ++k) {
      const double size = std::pow(10, -4 + 4 * (dice.next() + 0.5)); // of what ends the last branch
      const double before = pair.state.dissipated;
      const bool broken = pair.state.broken > 0;
      if (k % 2 == 0) {
        const double deep = 0.03 * length * size * dice.next();
        const double back = k % 4 == 0 ? 0.05 * (length * (1 - 0.006) - pair.pose.distance.z) : 0;
        pair.move({0, 0, deep + back});
      } else { // at the same distance; while whole the potential is that of finite turns
        const double turn = (broken ? 0.02 * size : 5e-3) * dice.next();
        pair.move({}, {0, turn, 0}, {0, turn, 0}, broken ? 1 : 200);
        if (broken) slid += pair.state.dissipated > before;
      }
      apart += pair.state.broken > 0 && pair.stress() == 0;
      // Friction only ever takes. A step through all of the tension has no such sign for its break.
      if (broken) {
        EXPECT_GE(pair.state.dissipated, before - 1e-8 * largest) << run << ", " << k;
      }
      largest = std::fmax(largest, std::abs(pair.work + pair.kinks_work));
      ASSERT_NEAR(pair.work + pair.kinks_work, pair.balance(), 1e-9 * largest) << run << ", " << k;
    }
    in_tension += pair.state.broken == 1, in_shear += pair.state.broken == 2;
  }
  EXPECT_GT(in_tension, 5);
  EXPECT_GT(in_shear, 5);
  EXPECT_GT(apart, 100);
  EXPECT_GT(slid, 100);
}

// Random motion of both spheres through yield, break, sliding and separation, turns of some 1e-6 rad a step:
// the same but for third powers of a step, so that ten times finer steps are a hundred times nearer.
TEST(YieldingEnergy, closes_over_random_paths_as_the_square_of_the_step) {
  double worst[2] = {0, 0};
  for (const int fine : {0, 1}) {
    Dice dice(7);
    int in_tension = 0, in_shear = 0;
    for (int run = 0; run < 40; ++run) {
      Bond pair(concrete());
      pair.move({0, 0, -60e-8});
      const double along = run % 2 ? 12e-7 : 2e-7, across = run % 2 ? 4e-7 : 3e-6;
      double largest = 0;
      for (int k = 0; k < 120; ++k) {
        const auto turn = [&] {
          return Triple<double>{4e-4 * dice.next(), 4e-4 * dice.next(), 4e-4 * dice.next()};
        };
        const Triple<double> by{across * dice.next(), across * dice.next(), along * dice.next()}, a = turn(),
                                                                                                  b = turn();
        const double kept = pair.state.dissipated, yielded = pair.plastic();
        pair.move(by, a, b, fine ? 100 : 10);
        EXPECT_GE(pair.state.dissipated, kept - 1e-4 * largest) << run << ", " << k;
        EXPECT_GE(pair.plastic(), yielded) << run << ", " << k;
        largest = std::fmax(largest, std::fmax(pair.now.energy, std::abs(pair.work)));
      }
      worst[fine] = std::fmax(worst[fine], std::abs(pair.work + pair.kinks_work - pair.balance()) / largest);
      in_tension += pair.state.broken == 1, in_shear += pair.state.broken == 2;
    }
    EXPECT_GT(in_tension, 3);
    EXPECT_GT(in_shear, 3);
  }
  EXPECT_LT(worst[0], 4e-7);
  EXPECT_LT(worst[1], 4e-9);
}

// Pressed past the second limit, broken in shear, slid on, unloaded, loaded again and yielded further: every
// stress, and what each part took, by hand.
TEST(YieldingEnergy, of_a_contact_that_takes_over_and_goes_on_yielding_is_that_by_hand) {
  Bond pair(concrete());
  const double kn = pair.geometry.normal_stiffness, ks = 0.25 * kn, area = pair.geometry.area,
               friction = 0.35;
  const auto close = [&](double elastic) { pair.move({0, 0, -elastic / kn}); }; // Pa of an elastic bond
  const auto slide = [&](double turn) { pair.move({}, {0, turn, 0}, {0, turn, 0}, 200); };
  // Elastic closing from 60 MPa on: three times the stress to 110, then twelve times, then 22 times.
  const auto elastic_at = [](double stress) {
    if (stress <= 110e6) return 60e6 + 3 * (stress - 60e6);
    return stress <= 160e6 ? 210e6 + 12 * (stress - 110e6) : 810e6 + 22 * (stress - 160e6);
  };
  close(elastic_at(135e6));
  ASSERT_NEAR(pair.stress(), -135e6, 1);
  const double plastic_135 =
      area / kn * (85e6 * 100e6 + 122.5e6 * 275e6); // mean stress times closing that stays
  EXPECT_NEAR(pair.plastic(), plastic_135, 1e-12 * plastic_135);

  // Breaks at tau_c + mu_1 135 MPa, just past it; friction of .35 of 135 MPa is what is left.
  const double now = pair.pose.distance.z, strength = 36e6 + 0.5 * 135e6, cap = friction * 135e6;
  slide(std::asin(strength / ks / length) * (1 - 1e-9));
  ASSERT_EQ(pair.state.broken, 0);
  slide(2e-9 * strength / ks / length);
  ASSERT_EQ(pair.state.broken, 2);
  EXPECT_NEAR(pair.shear(), cap, 1e-9 * cap);
  EXPECT_NEAR(pair.stress(), -135e6, 1);
  const double released = 0.5 * area / ks * (strength * strength - cap * cap);
  EXPECT_NEAR(pair.state.dissipated, released, 1e-8 * released);

  // Slides on by 20 micrometres, against a constant force.
  const double slip = 20e-6;
  slide(slip / now);
  const double friction_work = area * cap * slip;
  EXPECT_NEAR(pair.state.dissipated, released + friction_work, 1e-8 * released);

  // Unloads with the modulus, and the friction spring with it; loads again, elastic, at what shear is left.
  close(-75e6);
  EXPECT_NEAR(pair.stress(), -60e6, 1);
  EXPECT_NEAR(pair.shear(), friction * 60e6, 1);
  const double eased = 0.5 * area / ks * friction * friction * (135e6 * 135e6 - 60e6 * 60e6);
  EXPECT_NEAR(pair.state.dissipated, released + friction_work + eased, 1e-8 * released);
  close(75e6);
  EXPECT_NEAR(pair.stress(), -135e6, 1);
  EXPECT_NEAR(pair.shear(), friction * 60e6, 1);
  EXPECT_NEAR(pair.plastic(), plastic_135, 1e-10 * plastic_135);

  // Yields on along the second branch, and beyond the third limit in one step.
  close(elastic_at(170e6) - elastic_at(135e6));
  EXPECT_NEAR(pair.stress(), -170e6, 10);
  const double plastic_170 = area / kn * (85e6 * 100e6 + 135e6 * 550e6 + 165e6 * 210e6);
  EXPECT_NEAR(pair.plastic(), plastic_170, 1e-10 * plastic_170);
  EXPECT_NEAR(pair.state.dissipated, released + friction_work + eased, 1e-8 * released);

  // Opens: parts where yield has put its zero, with nothing left, and does not pull.
  close(-170e6 * (1 + 1e-9));
  EXPECT_EQ(pair.stress(), 0);
  EXPECT_EQ(pair.shear(), 0);
  EXPECT_NEAR(length - pair.pose.distance.z, (100e6 + 550e6 + 210e6) / kn, 1e-8 * length);
  const double last = 0.5 * area / ks * friction * friction * 60e6 * 60e6;
  EXPECT_NEAR(pair.state.dissipated, released + friction_work + eased + last, 1e-8 * released);
  EXPECT_EQ(pair.now.energy, 0);
  const double work = pair.work + pair.kinks_work;
  EXPECT_NEAR(work, plastic_170 + released + friction_work + eased + last, 1e-8 * work);
}

} // namespace
} // namespace platen::dem::yielding_parallel_bond_test
