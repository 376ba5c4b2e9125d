// Interfaces that bend and twist: the law against closed forms, specimens against the law and the parallel
// bond.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/dem/one_bond.h"

namespace platen::dem {
namespace {

using namespace examples;

constexpr double young = 28e9, length = 0.01, bond_radius = 0.004; // Pa, m, m

ElastoDamagePlastic::Parameters concrete() {
  ElastoDamagePlastic::Parameters p = cohesive_bond_of_concrete();
  p.moments = true;
  p.moment_contribution = 0.5;
  return p;
}

struct Interface : OneBond<ElastoDamagePlastic> {
  explicit Interface(const ElastoDamagePlastic::Parameters &p) : OneBond(p, young, length, bond_radius) {}
  void bend(double angle, int steps = 1) { move({}, {-0.5 * angle, 0, 0}, {0.5 * angle, 0, 0}, steps); }
  void twist(double angle, int steps = 1) { move({}, {0, 0, -0.5 * angle}, {0, 0, 0.5 * angle}, steps); }
  // N m over rad, whole.
  double bending() const { return geometry.normal_stiffness * geometry.area * bond_radius * bond_radius / 4; }
  double twisting() const { return 2 * law.shear_ratio() * bending(); }
};

TEST(CohesiveMoments, are_those_of_the_parallel_bond_while_whole) {
  ElastoDamagePlastic::Parameters p = concrete();
  p.tensile_strength = p.shear_strength = 0;
  Interface pair(p);
  pair.bend(1e-5);
  EXPECT_NEAR(pair.now.torque_i.x, pair.bending() * 1e-5, 1e-9 * pair.bending() * 1e-5);
  EXPECT_NEAR(pair.now.torque_j.x, -pair.bending() * 1e-5, 1e-9 * pair.bending() * 1e-5);
  pair.bend(-1e-5);
  pair.twist(1e-5);
  EXPECT_NEAR(pair.now.torque_i.z, pair.twisting() * 1e-5, 1e-9 * pair.twisting() * 1e-5);
  EXPECT_NEAR(pair.now.energy, 0.5 * pair.twisting() * 1e-10, 1e-9 * pair.now.energy);
  EXPECT_NEAR(pair.work, pair.balance(), 1e-9 * pair.work);
  const BondStiffness s =
      pair.law.stiffness({pair.geometry.reference, length, 0.5, pair.geometry.normal_stiffness, bond_radius});
  EXPECT_NEAR(s.bending, pair.bending(), 1e-12 * s.bending);
  EXPECT_NEAR(s.twisting, pair.twisting(), 1e-12 * s.twisting);
}

// Sheared, bent and twisted, of spheres that differ: what is told is what acts, on each of both ends.
TEST(CohesiveMoments, told_of_both_ends_are_those_that_act) {
  Interface pair(concrete());
  pair.geometry.lever = 0.3;
  pair.move({2e-7, -3e-7, 1e-7}, {1e-5, 2e-5, -3e-5}, {-2e-5, 1e-5, 2e-5});
  const BondResponse<double> told = pair.law.bond_response(pair.state, pair.geometry, pair.pose);
  EXPECT_GT(std::abs(pair.now.torque_i.x - pair.now.torque_j.x), 0.3 * std::abs(pair.now.torque_i.x));
  const auto near = [](const Triple<double> &a, const Triple<double> &b) {
    EXPECT_LT(norm(vector(a - b)), 1e-13 * norm(vector(b)));
  };
  near(told.force, pair.now.force);
  near(told.torque_i, pair.now.torque_i);
  near(told.torque_j, pair.now.torque_j);
  EXPECT_NEAR(told.energy, pair.now.energy, 1e-13 * told.energy);
}

// beta M R/I is a stress of tension at the skin, beta M R/J one of shear: damage begins at the strength,
// falls along a line, and ends at 1 + delta times its angle with nothing left. What it took is the area under
// the curve.
TEST(CohesiveMoments, soften_by_the_stress_of_the_skin_and_take_the_area_under_their_curve) {
  for (const bool bends : {true, false}) {
    Interface pair(concrete());
    const double kn = pair.geometry.normal_stiffness, k = bends ? kn : pair.law.shear_ratio() * kn;
    const double strength = bends ? 5e6 : 16e6, delta = bends ? 0.2 : 1.0;
    const double limit = strength / (0.5 * k * bond_radius); // rad
    const double stiffness = bends ? pair.bending() : pair.twisting();
    const auto turn = [&](double angle, int steps) {
      bends ? pair.bend(angle, steps) : pair.twist(angle, steps);
    };
    const auto moment = [&] { return bends ? pair.now.torque_i.x : pair.now.torque_i.z; };
    turn(limit, 1000);
    EXPECT_NEAR(moment(), stiffness * limit, 1e-5 * stiffness * limit) << bends;
    EXPECT_LT(pair.law.damage_of(pair.state), 1e-5) << bends;
    turn(0.5 * delta * limit, 1000); // half of the softening: half of the strength
    EXPECT_NEAR(moment(), 0.5 * stiffness * limit, 1e-4 * stiffness * limit) << bends;
    const BondResponse<double> told = pair.law.bond_response(pair.state, pair.geometry, pair.pose);
    EXPECT_NEAR(bends ? told.torque_i.x : told.torque_i.z, moment(), 1e-12 * stiffness * limit) << bends;
    EXPECT_NEAR(bends ? told.tension_ratio : told.shear_ratio, 1 + 0.5 * delta, 1e-4) << bends;
    turn(0.501 * delta * limit, 1000);
    EXPECT_EQ(pair.law.damage_of(pair.state), 1) << bends;
    EXPECT_EQ(bends ? pair.state.tension_damage : pair.state.shear_damage, 1) << bends;
    EXPECT_EQ(moment(), 0) << bends;
    const double area = 0.5 * stiffness * limit * limit * (1 + delta);
    EXPECT_NEAR(pair.work, area, 1e-4 * area) << bends;
    EXPECT_NEAR(pair.state.dissipated, pair.work, 1e-4 * area) << bends;
    EXPECT_EQ(pair.now.energy, 0) << bends;
  }
}

// A pressed interface does not part by a bending that leaves its skin pressed.
TEST(CohesiveMoments, of_a_pressed_interface_damage_once_its_skin_is_pulled) {
  Interface pair(concrete());
  const double kn = pair.geometry.normal_stiffness, pressed = 10e6;
  pair.move({0, 0, -pressed / kn}, {}, {});
  pair.bend((pressed + 4.9e6) / (0.5 * kn * bond_radius), 10);
  EXPECT_EQ(pair.state.tension_damage, 0);
  pair.bend(0.3e6 / (0.5 * kn * bond_radius));
  EXPECT_GT(pair.state.tension_damage, 0);
}

TEST(CohesiveMoments, close_the_energy_balance_through_damage_failure_and_friction) {
  double worst[2] = {0, 0};
  for (const int fine : {0, 1}) {
    unsigned random = 11;
    const auto next = [&] { return (random = random * 1664525u + 1013904223u) / 4294967296.0 - 0.5; };
    int failed = 0, damaged = 0;
    for (int run = 0; run < 20; ++run) {
      Interface pair(concrete());
      double largest = 0;
      for (int k = 0; k < 40; ++k) {
        const auto turn = [&] { return Triple<double>{1e-3 * next(), 1e-3 * next(), 1e-3 * next()}; };
        const Triple<double> by{2e-6 * next(), 2e-6 * next(), 1e-6 * next() - 2e-7}, a = turn(), b = turn();
        pair.move(by, a, b, fine ? 1000 : 100);
        largest = std::fmax(largest, std::fmax(pair.now.energy, std::abs(pair.work)));
      }
      worst[fine] = std::fmax(worst[fine], std::abs(pair.work - pair.balance()) / largest);
      failed += pair.law.damage_of(pair.state) == 1, damaged += pair.law.damage_of(pair.state) > 0;
    }
    EXPECT_GT(failed, 3);
    EXPECT_GT(damaged, 5);
  }
  EXPECT_LT(worst[1], 1e-4);
  EXPECT_LT(worst[1], 0.3 * worst[0]);
}

TEST(CohesiveMoments, a_rigid_turn_stores_nothing) {
  Interface pair(concrete());
  pair.bend(1e-4), pair.twist(2e-4);
  const double energy = pair.now.energy;
  const int steps = 20000;
  for (int k = 0; k < steps; ++k) {
    const Triple<double> turn{1.5 * pi / steps, 0, 0};
    const Quaternion q = rotation_quaternion({turn.x, turn.y, turn.z});
    const Triple<double> to = turned(Rotation<double>{q.w, q.x, q.y, q.z}, pair.pose.distance);
    pair.move(to - pair.pose.distance, turn, turn);
  }
  EXPECT_NEAR(pair.now.energy, energy, 1e-6 * energy);
  EXPECT_EQ(pair.state.dissipated, 0);
}

ModelSettings bending(bool moments = true) {
  ModelSettings s = interfaces();
  auto &law = std::get<ElastoDamagePlastic::Parameters>(*s.bond);
  law.moments = moments, law.moment_contribution = 0.3;
  return s;
}

// Of touching spheres with the same k_n and k_s, the largest step is that of parallel bonds: moments are in
// it.
TEST(CohesiveMoments, are_in_the_largest_step_and_off_are_in_nothing) {
  ModelSettings parallel = bonded();
  parallel.bond_layout.modulus = 28e9;
  parallel_bond(parallel).stiffness_ratio = 0.5 / 1.2;
  ModelSettings with = bending(), without = bending(false);
  for (ModelSettings *s : {&with, &without}) {
    s->contact.reset();
    s->bond_layout.by_range = false, s->bond_layout.gap.value = 1e-6;
  }
  const Specimen line = row(6, {1, 0, 0});
  const double of_parallel = Model(line, parallel).stable_step({}, 0).limit,
               limit = Model(line, with).stable_step({}, 0).limit,
               free = Model(line, without).stable_step({}, 0).limit;
  EXPECT_NEAR(limit, of_parallel, 1e-6 * of_parallel);
  EXPECT_GT(free, 1.01 * limit);
  Model a(line, with), b(line, without);
  EXPECT_EQ(a.bonds->table.bytes_per_row(), b.bonds->table.bytes_per_row()); // nothing more is remembered
  EXPECT_FALSE(bends(b.bonds->law));
  EXPECT_EQ(b.bonds->stiffness(0).bending, 0);
}

} // namespace
} // namespace platen::dem
