// The facet bond, one bond with prescribed motion, against its closed forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "dem/laws/elementary.h"
#include "tests/dem/one_bond.h"

namespace platen::dem::facet_bond_test {
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
    const double w = degrees * degree, s = std::sin(w), c = std::cos(w);
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

// Where there is neither tension nor pressure, to the last bit, too.
TEST(FacetBond, shear_without_pressure_ends_at_the_cohesion) {
  for (const double pulled : {-1e3, 0.0}) {
    Bond bond;
    bond.to(pulled, 8e6);
    EXPECT_NEAR(bond.shear(), 8e6, 1e-5 * 8e6) << pulled;
    bond.to(pulled, 25e6, 0, 100);
    EXPECT_NEAR(bond.shear(), 11e6, 1e-4 * 11e6) << pulled;
    const double slip = (25e6 - 11e6) / (0.25 * stiffness);
    EXPECT_NEAR(bond.state.dissipated, 11e6 * slip * bond.geometry.area, 1e-3 * bond.state.dissipated)
        << pulled;
    EXPECT_NEAR(bond.balance(), bond.work, 1e-4 * bond.work) << pulled;
  }
}

// (1 - D) of what is sound and D of friction share the slip of a bond that is pressed after it was damaged.
TEST(FacetBond, what_is_damaged_rubs_once_it_is_closed) {
  Bond bond;
  bond.to(12e6, 0);
  const double damage = bond.state.damage, pressed = 5e6;
  EXPECT_NEAR(damage, 1 - std::exp(-2 * 2.0 / 11) / 3, 1e-12);
  bond.to(-pressed, 0, 0, 100);
  EXPECT_EQ(bond.state.damage, damage);
  for (const double slip : {1e6, 2.9e6, 3.1e6, 8e6}) { // friction slides from 0.6 times 5 MPa on
    bond.to(-pressed, slip, 0, 100);
    const double shear = (1 - damage) * slip + damage * std::min(slip, 0.6 * pressed);
    EXPECT_NEAR(bond.shear(), shear, 3e-4 * shear) << slip; // arms of friction are of the present length
  }
  EXPECT_NEAR(bond.balance(), bond.work, 1e-2 * bond.work);
}

// Friction of what is damaged is no more than what the sound share would hold.
TEST(FacetBond, friction_under_high_pressure_is_that_of_sound_facets) {
  Bond bond;
  bond.to(12e6, 0);
  bond.to(-80e6, 0, 0, 100);
  const double pressed = -bond.normal(), limit = 11e6 + 0.2 * 600e6 * -std::expm1(-pressed / 600e6);
  EXPECT_GT(0.6 * pressed, 1.2 * limit);
  bond.to(-80e6, 60e6, 0, 400);
  EXPECT_NEAR(bond.shear(), limit, 1e-6 * limit);
}

TEST(FacetBond, one_that_has_failed_is_a_contact_with_friction) {
  Bond bond;
  for (int k = 1; bond.state.broken == 0; ++k)
    bond.to(k * 1e6, 0);
  EXPECT_EQ(bond.state.broken, 1);
  bond.to(200e6, 3e6);
  EXPECT_EQ(norm(examples::vector(bond.now.force)), 0);
  bond.to(-10e6, 3e6, 0, 1000);
  EXPECT_NEAR(bond.normal(), -10e6, 1e-8 * 10e6);
  const double before = bond.state.dissipated;
  bond.to(-10e6, 60e6, 0, 1000);
  EXPECT_NEAR(bond.shear(), 0.6 * 10e6, 1e-9 * 6e6);
  EXPECT_GT(bond.state.dissipated, before);
  bond.to(10e6, 60e6, 0, 10);
  EXPECT_EQ(norm(examples::vector(bond.now.force)), 0);
}

TEST(FacetBond, fails_in_shear_where_shear_is_more) {
  for (const double lean : {0.8, 1.2}) { // of t over sqrt(r) T
    Bond bond;
    for (int k = 1; k < 10000 && bond.state.broken == 0; ++k)
      bond.to(k * 1e6, lean * 0.5 * k * 1e6);
    EXPECT_EQ(bond.state.broken, lean < 1 ? 1 : 2);
    EXPECT_EQ(FacetBond::failed_in_tension(bond.state), lean < 1);
  }
}

TEST(FacetBond, a_strength_factor_is_of_both_strengths_and_not_of_the_energy) {
  Bond bond;
  bond.geometry.strength_factor = 2;
  EXPECT_NEAR(bond.law.ductility(bond.geometry), 3, 1e-12);
  bond.to(8e6 * (1 - 1e-9), 0);
  EXPECT_EQ(bond.state.damage, 0);
  bond.to(16e6, 0);
  EXPECT_NEAR(bond.normal(), 8e6 * std::exp(-1.0), 1e-8 * 8e6); // h = 2/(3 - 1)
  Bond sheared;
  sheared.geometry.strength_factor = 2;
  sheared.to(-1e6, 30e6, 0, 100);
  const double limit = 22e6 + 0.2 * 600e6 * -std::expm1(-1e6 / 600e6);
  EXPECT_NEAR(sheared.shear(), limit, 1e-9 * limit);
}

// Turned as a whole, by much: what it holds turns with it, and it neither takes nor gives energy.
TEST(FacetBond, rigid_turns_change_nothing) {
  for (const double tension : {-30e6, 6e6}) {
    Bond bond;
    bond.to(tension, 15e6, 4e6, 100);
    const double energy = bond.now.energy, lost = bond.state.dissipated, normal = bond.normal(),
                 shear = bond.shear();
    const Vector3 turn{0.3e-3, -0.7e-3, 0.5e-3}; // 2000 steps: 1.8 rad
    for (int k = 0; k < 2000; ++k) {
      const Vector3 d = examples::vector(bond.pose.distance);
      const Triple<double> by = triple(rotate(rotation_quaternion(turn), d) - d);
      bond.move(by, triple(turn), triple(turn));
    }
    EXPECT_NEAR(bond.normal(), normal, 1e-8 * std::abs(normal));
    EXPECT_NEAR(bond.shear(), shear, 1e-8 * shear);
    EXPECT_NEAR(bond.now.energy, energy, 1e-8 * energy);
    EXPECT_NEAR(bond.state.dissipated, lost, 1e-8 * lost);
  }
}

// Slip by much while the spheres turn against each other: what is dissipated is what the work leaves.
TEST(FacetBond, slip_of_spheres_that_turn_against_each_other_dissipates_its_work) {
  for (const double opened : {0.0, 12e6}) {
    Bond bond;
    bond.to(opened, 0);
    bond.to(-80e6, 0, 0, 200);
    const double before = bond.balance() - bond.work;
    bond.move({0, 0, -50e6 / stiffness}, {0.5, 0.03, 0.1}, {0.4, -0.03, -0.05}, 10000);
    bond.move({0, 0, 20e6 / stiffness}, {-0.2, 0.1, 0}, {-0.2, 0.15, 0.05}, 10000);
    EXPECT_NEAR(bond.balance() - bond.work, before, 2e-5 * bond.work);
  }
}

// With a share of moments: that of the parallel bond, less what damage took; without, none.
TEST(FacetBond, moments_are_a_share_of_those_of_the_section) {
  FacetBond::Parameters p = concrete();
  ParallelBond::Parameters section;
  section.stiffness_ratio = p.stiffness_ratio;
  const Triple<double> bend{1e-4, 0, 5e-5};
  p.moment_stiffness = 0.1;
  Bond bond(p), without;
  EXPECT_TRUE(bond.law.bends());
  EXPECT_FALSE(without.law.bends());
  const CohesiveGeometry<double> &g = bond.geometry;
  const BondGeometry<double> of{g.reference, g.rest_length, g.lever, g.normal_stiffness, g.radius};
  const auto expect_share = [&](double share) {
    const BondMotion<double> pose{bond.pose.distance, bond.pose.turn_i, bond.pose.turn_j};
    const BondResponse<double> whole = ParallelBond(section).turning<true>(of, pose),
                               forces = ParallelBond(section).turning<false>(of, pose);
    const Triple<double> torque = whole.torque_i - forces.torque_i;
    const double size = root(dot(torque, torque));
    EXPECT_GT(size, 1e-3);
    EXPECT_LT(norm(examples::vector(bond.now.torque_i - without.now.torque_i - scale(share, torque))),
              1e-6 * size);
    EXPECT_NEAR(bond.now.energy - without.now.energy, share * (whole.energy - forces.energy),
                1e-6 * whole.energy);
  };
  for (Bond *one : {&bond, &without})
    one->move({}, scale(-1.0, bend), bend);
  expect_share(0.1);
  for (Bond *one : {&bond, &without})
    one->to(8e6, 0);
  EXPECT_GT(bond.state.damage, 0.5);
  expect_share(0.1 * (1 - bond.state.damage));
  EXPECT_NEAR(bond.balance(), bond.work, 1e-9 * bond.work);
  const BondStiffness k = bond.law.stiffness(of), parallel = ParallelBond(section).stiffness(of);
  EXPECT_EQ(k.axial, parallel.axial);
  EXPECT_EQ(k.shear, parallel.shear);
  EXPECT_NEAR(k.bending, 0.1 * parallel.bending, 1e-12 * parallel.bending);
  EXPECT_NEAR(k.twisting, 0.1 * parallel.twisting, 1e-12 * parallel.twisting);
  EXPECT_EQ(without.law.stiffness(of).bending, 0);
}

// Force and torques are the derivatives of the energy by place and rotations, whatever the plastic slip.
TEST(FacetBond, cohesion_is_a_potential_of_the_pose) {
  FacetBond::Parameters p = concrete();
  p.tensile_strength = p.shear_strength = 0, p.moment_stiffness = 0.2;
  Bond bond(p);
  bond.state.slip = {2e-4, -1e-4, 1e-4};
  bond.state.damage = 0.3;
  bond.move({3e-4, -2e-4, 4e-4}, {0.1, 0.05, -0.2}, {-0.1, 0.2, 0.1});
  const auto energy = [&](const Triple<double> &by, const Triple<double> &turn_i,
                          const Triple<double> &turn_j) {
    return bond.law
        .force_and_energy(bond.state, bond.geometry,
                          {bond.pose.distance + by, Bond::turned_by(bond.pose.turn_i, turn_i),
                           Bond::turned_by(bond.pose.turn_j, turn_j)})
        .energy;
  };
  const Triple<double> none{0, 0, 0};
  const double force = root(dot(bond.now.force, bond.now.force)), torque = force * length, h = 1e-5;
  for (int k = 0; k < 3; ++k) {
    const Triple<double> unit{k == 0 ? 1.0 : 0, k == 1 ? 1.0 : 0, k == 2 ? 1.0 : 0};
    const Triple<double> there = scale(h * length, unit), angle = scale(h, unit);
    const Triple<double> back = scale(-1.0, there), other = scale(-1.0, angle);
    EXPECT_NEAR(dot(bond.now.force, unit),
                (energy(there, none, none) - energy(back, none, none)) / (2 * h * length), 1e-7 * force);
    EXPECT_NEAR(dot(bond.now.torque_i, unit),
                -(energy(none, angle, none) - energy(none, other, none)) / (2 * h), 1e-7 * torque);
    EXPECT_NEAR(dot(bond.now.torque_j, unit),
                -(energy(none, none, angle) - energy(none, none, other)) / (2 * h), 1e-7 * torque);
  }
}

// The quick path does what the whole law does, and leaves to that whatever changes more than the yield.
TEST(FacetBond, the_quick_path_is_the_law_where_nothing_is_damaged_or_slips) {
  struct Pair {
    Triple<double> distance;
    Rotation<double> turn_i, turn_j;
    BondMotion<double> pose() const { return {distance, turn_i, turn_j}; }
  };
  Random random(3);
  int quick = 0, slow = 0;
  for (const double transition : {600e6, 10e6, 0.0})
    for (int k = 0; k < 2000; ++k) {
      FacetBond::Parameters p = concrete();
      p.transitional_stress = transition;
      Bond bond(p);
      bond.to(random.uniform(-60e6, 5e6), 0);
      if (bond.state.damage > 0) continue;
      FacetBond::State<double> state = bond.state;
      CohesiveResponse<double> r{};
      bool yielded = false;
      bond.to(bond.at[0] + random.uniform(-2e6, 2e6), random.uniform(0, 25e6));
      const bool done = bond.law.advance_intact(
          state, bond.geometry, Pair{bond.pose.distance, bond.pose.turn_i, bond.pose.turn_j}, r, yielded);
      const bool changed = bond.state.damage > 0 || norm(examples::vector(bond.state.slip)) > 0;
      ++(done ? quick : slow);
      if (changed) {
        EXPECT_FALSE(done) << bond.at[0] << ' ' << bond.at[1];
      }
      if (!done) {
        const double margin = bond.now.tension > 0 ? 1 : 0.93; // of the limit without exponential
        const double limit =
            11e6 + 0.2 * (transition > 0 ? -transition * std::expm1(bond.now.tension / transition)
                                         : -bond.now.tension);
        EXPECT_TRUE(changed || bond.at[1] > margin * limit) << bond.at[0] << ' ' << bond.at[1];
        continue;
      }
      EXPECT_EQ(state.plastic, bond.state.plastic);
      EXPECT_EQ(norm(examples::vector(r.force - bond.now.force)), 0);
      EXPECT_EQ(norm(examples::vector(r.torque_i - bond.now.torque_i)), 0);
      EXPECT_EQ(r.energy, bond.now.energy);
    }
  EXPECT_GT(quick, 1000);
  EXPECT_GT(slow, 1000);
}

// Sums over bonds ask for what a state holds.
TEST(FacetBond, held_and_the_response_are_those_of_the_step) {
  Bond bond;
  for (const double tension : {3e6, 9e6, -20e6}) {
    bond.to(tension, 8e6, -3e6, 100);
    const ForceAndEnergy<double> held = bond.law.force_and_energy(
        bond.state, bond.geometry, {bond.pose.distance, bond.pose.turn_i, bond.pose.turn_j});
    const BondResponse<double> r = bond.law.bond_response(bond.state, bond.geometry, bond.pose);
    EXPECT_EQ(norm(examples::vector(held.force - bond.now.force)), 0);
    EXPECT_EQ(norm(examples::vector(r.force - bond.now.force)), 0);
    EXPECT_EQ(norm(examples::vector(r.torque_j - bond.now.torque_j)), 0);
    EXPECT_EQ(held.energy, bond.now.energy);
    EXPECT_EQ(r.energy, bond.now.energy);
    EXPECT_EQ(r.normal_force, bond.now.normal);
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

TEST(Elementary, saturation_is_one_less_the_exponential) {
  EXPECT_EQ(saturation(0.0), 0);
  for (double y = 1e-12; y < 32; y *= 1.07)
    EXPECT_NEAR(saturation(y), -std::expm1(-y), 1e-14 * -std::expm1(-y)) << y;
  EXPECT_EQ(saturation(1e30), saturation(32.0));
  EXPECT_NEAR(saturation(32.0), 1, 2e-14);
}

TEST(Elementary, angles_of_the_first_quarter) {
  EXPECT_EQ(fraction_of_right_angle(0.0, 3.0), 0);
  EXPECT_NEAR(fraction_of_right_angle(3.0, 0.0), 1, 1e-15);
  for (double y = 1e-9; y < 1e9; y *= 1.3)
    EXPECT_NEAR(fraction_of_right_angle(y, 0.7), std::atan2(y, 0.7) / (0.5 * pi), 1e-14 * std::atan2(y, 0.7))
        << y;
}

TEST(Elementary, powers_of_shares) {
  for (const double n : {0.0, 0.2, 1.0, 3.0}) {
    EXPECT_EQ(power_of_fraction(1.0, n), 1);
    for (double x = 1e-4; x < 1; x *= 1.02)
      EXPECT_NEAR(power_of_fraction(x, n), std::pow(x, n), 2e-14) << x << ' ' << n;
  }
  EXPECT_EQ(power_of_fraction(0.0, 0.2), power_of_fraction(1e-12, 0.2));
}

} // namespace
} // namespace platen::dem::facet_bond_test
