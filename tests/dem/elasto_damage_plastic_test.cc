// The elasto-damage-plastic law, one interface with prescribed motion, with and without moments, against its
// closed forms.
#include <gtest/gtest.h>

#include <cmath>

#include "base/pi.h"
#include "tests/dem/one_bond.h"

namespace platen::dem::elasto_damage_plastic_test {
namespace {

using namespace examples;

constexpr double young = 28e9, length = 0.01, bond_radius = 0.004; // Pa, m, m

struct Interface : OneBond<ElastoDamagePlastic> {
  explicit Interface(const ElastoDamagePlastic::Parameters &p) : OneBond(p, young, length, bond_radius) {}
  void move(const Triple<double> &by, int steps = 1) { OneBond::move(by, {}, {}, steps); }
  double opening_limit() const { return law.parameters.tensile_strength / geometry.normal_stiffness; } // m
  double shear_stiffness() const { return law.shear_ratio() * geometry.normal_stiffness; }             // Pa/m
  void bend(double angle, int steps = 1) {
    OneBond::move({}, {-0.5 * angle, 0, 0}, {0.5 * angle, 0, 0}, steps);
  }
  void twist(double angle, int steps = 1) {
    OneBond::move({}, {0, 0, -0.5 * angle}, {0, 0, 0.5 * angle}, steps);
  }
  // N m over rad, whole.
  double bending() const { return geometry.normal_stiffness * geometry.area * bond_radius * bond_radius / 4; }
  double twisting() const { return 2 * law.shear_ratio() * bending(); }
};

TEST(ElastoDamagePlastic, tension_softens_along_a_line_and_takes_the_area_under_it) {
  Interface pair(cohesive_bond_of_concrete());
  const double limit = pair.opening_limit(), whole = 0.5 * 5e6 * 1.2 * limit * pair.geometry.area;
  const auto expect = [&](double opening, double stress, double damage) { // opening over the limit
    pair.move({0, 0, length + opening * limit - pair.pose.distance.z}, 7);
    EXPECT_NEAR(pair.normal(), stress, 2.5e-4) << opening;
    EXPECT_NEAR(pair.state.tension_damage, damage, 1e-10) << opening;
    EXPECT_NEAR(pair.state.dissipated, damage * whole, 1e-10 * whole) << opening;
  };
  expect(0.5, 2.5e6, 0);
  expect(1, 5e6, 0);
  expect(1.05, 3.75e6, 0.25);
  expect(1.1, 2.5e6, 0.5);
  expect(1.2 + 1e-9, 0, 1);
  EXPECT_EQ(pair.state.tension_damage, 1);
  EXPECT_EQ(pair.normal(), 0);
  EXPECT_NEAR(pair.work, whole, 1e-8 * whole);
  EXPECT_EQ(pair.now.energy, 0);
}

// The softening triangle is the energy given, whatever the length of the pair.
TEST(ElastoDamagePlastic, a_given_fracture_energy_does_not_depend_on_the_size_of_spheres) {
  ElastoDamagePlastic::Parameters p = cohesive_bond_of_concrete();
  p.fracture_energy_tension = 2; // J/m^2
  p.fracture_energy_shear = 20;
  for (const double size : {0.5, 1.0, 2.0}) {
    Interface pair(p);
    pair.geometry.rest_length *= size;
    pair.geometry.normal_stiffness /= size;
    pair.pose.distance = {0, 0, size * length};
    const double limit = pair.opening_limit();
    pair.move({0, 0, limit});
    const double end = 2 * 2 / 5e6;
    pair.move({0, 0, end * (1 + 1e-9)}, 4);
    EXPECT_EQ(pair.state.tension_damage, 1);
    const double elastic = 0.5 * 5e6 * limit;
    EXPECT_NEAR(pair.state.dissipated / pair.geometry.area - elastic, 2, 1e-8 * 2) << size;
  }
}

TEST(ElastoDamagePlastic, damaged_tension_unloads_through_the_origin_and_comes_back) {
  Interface pair(cohesive_bond_of_concrete());
  const double limit = pair.opening_limit();
  pair.move({0, 0, 1.1 * limit}, 11); // D = 1/2
  const double top = pair.normal(), lost = pair.state.dissipated;
  pair.move({0, 0, -0.55 * limit}, 3);
  EXPECT_NEAR(pair.normal(), 0.5 * top, 1e-10 * top);
  pair.move({0, 0, -0.55 * limit - 1e-6}, 3);
  EXPECT_NEAR(pair.normal(), -1e-6 * pair.geometry.normal_stiffness, 1); // closed: as stiff as ever
  pair.move({0, 0, 1e-6 + 1.1 * limit}, 5);
  EXPECT_NEAR(pair.normal(), top, 1e-10 * top);
  EXPECT_NEAR(pair.state.dissipated, lost, 1e-10 * lost);
}

// Breakpoints of the paper's concrete: strains 7.14286e-4, 3.39286e-3, 1.410714e-2 at 20, 45, 70 MPa.
TEST(ElastoDamagePlastic, closing_yields_along_three_branches) {
  Interface pair(cohesive_bond_of_concrete());
  const double strains[] = {7.142857142857143e-4, 3.392857142857143e-3, 1.4107142857142857e-2};
  const double stresses[] = {20e6, 45e6, 70e6};
  double before = 0;
  for (int k = 0; k < 3; ++k) {
    pair.move({0, 0, -(strains[k] - before) * length}, 9);
    EXPECT_NEAR(pair.normal(), -stresses[k], 1e-10 * stresses[k]) << k;
    before = strains[k];
  }
  pair.move({0, 0, -1e-3 * length}, 3);
  EXPECT_NEAR(pair.normal(), -(70e6 + 28e9 / 22 * 1e-3), 1e-2);
}

TEST(ElastoDamagePlastic, closing_unloads_elastically_and_keeps_its_plastic_strain) {
  Interface pair(cohesive_bond_of_concrete());
  const double kink = 20e6 / 28e9; // strain at which yield begins; steps end there, so that work is exact
  pair.move({0, 0, -kink * length}, 10);
  pair.move({0, 0, -(2e-3 - kink) * length}, 10);
  const double top = pair.normal(), expected = -(20e6 + (2e-3 * 28e9 - 20e6) / 3);
  EXPECT_NEAR(top, expected, 1e-10 * 20e6);
  pair.move({0, 0, 0.5e-3 * length}, 4);
  EXPECT_NEAR(pair.normal(), top + 0.5e-3 * 28e9, 1e-2);
  const double plastic = 2e-3 + top / 28e9; // strain that stays
  pair.move({0, 0, (2e-3 - 0.5e-3 - plastic) * length}, 5);
  EXPECT_NEAR(pair.normal(), 0, 1e-2);
  // Work done is what yield took, to the closed form of the law.
  const double taken = pair.law.plastic_work(pair.state, pair.geometry);
  EXPECT_NEAR(pair.work, taken, 1e-9 * taken);
  EXPECT_GT(taken, 0.5 * plastic * length * 20e6 * pair.geometry.area);
  // Tension begins at the shifted origin.
  pair.move({0, 0, 0.5 * pair.opening_limit()});
  EXPECT_NEAR(pair.normal(), 2.5e6, 1e-2);
}

// Steps that end at the branches' ends, so that the trapezoid is exact.
TEST(ElastoDamagePlastic, plastic_work_is_the_area_between_curve_and_unloading) {
  Interface pair(cohesive_bond_of_concrete());
  double at = 0;
  for (const double strain : {7.142857142857143e-4, 3.392857142857143e-3, 1.4107142857142857e-2, 0.02}) {
    pair.move({0, 0, -(strain - at) * length});
    at = strain;
    const double taken = pair.law.plastic_work(pair.state, pair.geometry);
    EXPECT_NEAR(pair.work, taken + pair.now.energy, 1e-10 * pair.work) << strain;
  }
}

TEST(ElastoDamagePlastic, shear_strength_grows_with_compression_and_softens_to_friction) {
  Interface pair(cohesive_bond_of_concrete());
  const double pressing = 10e6, strength = 16e6 + 0.9 * pressing, residual = 0.25 * pressing;
  pair.move({0, 0, -pressing / pair.geometry.normal_stiffness});
  // Across, at a distance that stays: by rotations.
  const auto slide = [&](double by, int steps) {
    for (int k = 0; k < steps; ++k)
      pair.impose({0, 0, 0}, {by / steps, 0, 0}, 0);
  };
  const double limit = strength / pair.shear_stiffness();
  slide(0.5 * limit, 3);
  EXPECT_NEAR(pair.shear(), 0.5 * strength, 1e-10 * strength);
  slide(0.5 * limit, 3);
  EXPECT_NEAR(pair.shear(), strength, 1e-10 * strength);
  slide(0.25 * limit, 5);
  EXPECT_NEAR(pair.state.shear_damage, 0.25, 1e-10);
  EXPECT_NEAR(pair.shear(), 0.75 * strength + 0.25 * residual, 1e-9 * strength);
  slide(0.75 * limit * (1 + 1e-12), 5);
  EXPECT_EQ(pair.state.shear_damage, 1);
  EXPECT_NEAR(pair.shear(), residual, 1e-9 * strength);
  // It sticks in the other sense, then slides.
  slide(-residual / pair.shear_stiffness(), 4);
  EXPECT_NEAR(pair.shear(), 0, 1e-9 * strength);
  slide(-3 * residual / pair.shear_stiffness(), 4);
  EXPECT_NEAR(pair.shear(), residual, 1e-9 * strength);
  // Failed in shear is failed in tension.
  pair.pose.distance = {0, 0, 1.0001 * length};
  pair.impose({0, 0, 0}, {0, 0, 0}, 0);
  EXPECT_EQ(pair.normal(), 0);
  EXPECT_EQ(pair.shear(), 0);
}

// Work, stored and dissipated energy of a sliding interface under constant pressure, by fine steps: the
// trapezoid misses the kinks by steps^-2.
TEST(ElastoDamagePlastic, the_energy_of_sliding_under_pressure_is_accounted_for) {
  Interface pair(cohesive_bond_of_concrete());
  const double pressing = 10e6, strength = 16e6 + 0.9 * pressing;
  pair.move({0, 0, -pressing / pair.geometry.normal_stiffness});
  const double limit = strength / pair.shear_stiffness(), start = pair.now.energy;
  double work = 0;
  constexpr int steps = 40000;
  for (int k = 0; k < steps; ++k) {
    const Triple<double> part{2.5 * limit / steps, 0, 0};
    work += pair.impose({0, 0, 0}, part, 0);
  }
  EXPECT_NEAR(work, pair.state.dissipated + pair.now.energy - start, 1e-6 * work);
}

// Velocity Verlet does the work of the mean of the forces at both ends of a step: the balance closes to
// round-off at steps of any size, through damage, slip under a pressure that changes, and failure.
TEST(ElastoDamagePlastic, what_a_step_takes_is_its_work_less_what_it_stores) {
  for (const FailureLine line : {FailureLine::uncoupled, FailureLine::coupled})
    for (const double normal : {5.5e6, -20e6}) { // Pa, up to here, without change of sign
      ElastoDamagePlastic::Parameters p = cohesive_bond_of_concrete();
      p.failure_line = line;
      p.softening_tension = 1;
      p.compression_limits = p.compression_slopes = {}; // yield adds its own closed form
      Interface pair(p);
      const double reach = normal / pair.geometry.normal_stiffness, limit = 16e6 / pair.shear_stiffness();
      double work = 0, at = 0, largest = 0;
      unsigned random = 1;
      const auto next = [&] { return (random = random * 1664525u + 1013904223u) / 4294967296.0; };
      for (int k = 0; k < 400; ++k) {
        const double to = reach * next();
        const Triple<double> part{.2 * limit * (next() - .4), .2 * limit * (next() - .4), to - at};
        at = to;
        pair.pose.distance.z = length + at;
        work += pair.impose({0, 0, part.z}, part, 0);
        largest = std::fmax(largest, std::fmax(std::abs(work), pair.now.energy));
        ASSERT_NEAR(work, pair.state.dissipated + pair.now.energy, 1e-9 * largest) << normal << ", " << k;
      }
      EXPECT_EQ(std::fmax(pair.state.tension_damage, pair.state.shear_damage), 1);
      EXPECT_GT(pair.state.dissipated, 0);
    }
}

// Without pressure the energy is the law's alone: 1/2 tau_f u^l (1 + delta).
TEST(ElastoDamagePlastic, pure_shear_dissipates_the_area_under_its_curve) {
  ElastoDamagePlastic::Parameters p = cohesive_bond_of_concrete();
  Interface pair(p);
  const double limit = 16e6 / pair.shear_stiffness(), whole = 0.5 * 16e6 * 2 * limit * pair.geometry.area;
  double work = 0;
  for (int k = 0; k < 20; ++k) {
    const Triple<double> part{0, 0.1 * limit, 0};
    work += pair.impose({0, 0, 0}, part, 0);
  }
  EXPECT_NEAR(pair.state.dissipated, whole, 1e-8 * whole);
  EXPECT_NEAR(work, whole, 1e-8 * whole);
}

// Tension and shear at once: with the uncoupled line each has its own strength, with the coupled one their
// shares add up to one; the energy of a straight path is its area.
TEST(ElastoDamagePlastic, the_coupled_line_adds_up_tension_and_shear) {
  for (const FailureLine line : {FailureLine::uncoupled, FailureLine::coupled}) {
    ElastoDamagePlastic::Parameters p = cohesive_bond_of_concrete();
    p.failure_line = line;
    p.softening_shear = p.softening_tension;
    Interface pair(p);
    const double un = pair.opening_limit(), us = 16e6 / pair.shear_stiffness();
    double work = 0;
    const auto go = [&](double share, int steps) { // along the line of equal shares
      for (int k = 0; k < steps; ++k) {
        const Triple<double> part{share * us / steps, 0, share * un / steps};
        pair.pose.distance.z += part.z;
        work += pair.impose({0, 0, part.z}, part, 0);
      }
    };
    const double begins = line == FailureLine::coupled ? 0.5 : 1.0;
    go(begins * (1 - 1e-12), 5);
    EXPECT_LT(pair.state.tension_damage + pair.state.shear_damage, 1e-10);
    EXPECT_NEAR(pair.normal(), begins * 5e6, 1e-3);
    EXPECT_NEAR(pair.shear(), begins * 16e6, 1e-3);
    go(0.1 * begins, 10);
    EXPECT_NEAR(pair.state.tension_damage, 0.5, 1e-9);
    EXPECT_NEAR(pair.state.shear_damage, 0.5, 1e-9);
    go(0.1 * begins + 1e-9, 10);
    EXPECT_EQ(pair.state.tension_damage, 1);
    EXPECT_EQ(pair.now.energy, 0);
    EXPECT_NEAR(work, pair.state.dissipated, 1e-8 * work);
  }
}

// With pressure the strength in shear is the same for both lines.
TEST(ElastoDamagePlastic, the_coupled_line_is_the_uncoupled_one_in_compression) {
  double damage[2];
  for (int k = 0; k < 2; ++k) {
    ElastoDamagePlastic::Parameters p = cohesive_bond_of_concrete();
    p.failure_line = k == 0 ? FailureLine::uncoupled : FailureLine::coupled;
    Interface pair(p);
    pair.move({0, 0, -1e-6});
    pair.impose({0, 0, 0}, {2e-5, 0, 0}, 0);
    damage[k] = pair.state.shear_damage;
  }
  EXPECT_GT(damage[0], 0.1);
  EXPECT_EQ(damage[0], damage[1]);
}

// Sheared a tenth beyond its strength it is damaged in tension too from a ten-millionth of that strength on,
// not with what is round-off, nor with a pressure.
TEST(ElastoDamagePlastic, the_coupled_line_begins_with_the_first_tension_that_is_no_round_off) {
  const auto tension_damage = [](double share) { // of the tensile strength, positive in tension
    ElastoDamagePlastic::Parameters p = cohesive_bond_of_concrete();
    p.failure_line = FailureLine::coupled;
    Interface pair(p);
    const Triple<double> opened{0, 0, share * pair.opening_limit()};
    pair.pose.distance = pair.pose.distance + opened;
    const double slip = 1.1 * 16e6 / pair.shear_stiffness();
    pair.impose(opened, {slip, 0, 0}, 0);
    EXPECT_GT(pair.state.shear_damage, 0.05) << share;
    return pair.state.tension_damage;
  };
  EXPECT_GT(tension_damage(1e-7), 0.05);
  EXPECT_EQ(tension_damage(1e-11), 0);
  EXPECT_EQ(tension_damage(-1e-11), 0);
  EXPECT_EQ(tension_damage(-1e-3), 0);
}

TEST(ElastoDamagePlastic, history_turns_with_the_pair) {
  Interface pair(cohesive_bond_of_concrete());
  pair.impose({0, 0, 0}, {3e-6, 1e-6, 0}, 0);
  const double before = pair.shear(), stored = pair.now.energy;
  // Two turns about x, then two about the pair's own axis: nothing slides.
  constexpr int steps = 4000;
  for (int k = 1; k <= steps; ++k) {
    const double angle = 4 * pi * k / steps;
    const Triple<double> before_this = pair.pose.distance;
    pair.pose.distance = {0, length * std::sin(angle), length * std::cos(angle)};
    pair.impose(pair.pose.distance - before_this, {0, 0, 0}, 0);
  }
  EXPECT_NEAR(pair.shear(), before, 1e-10 * before);
  EXPECT_NEAR(pair.now.energy, stored, 1e-10 * stored);
  EXPECT_NEAR(pair.state.shear.x, 3e-6, 1e-6 * 3e-6); // angle^3 a step
  for (int k = 1; k <= steps; ++k)
    pair.impose({0, 0, 0}, {0, 0, 0}, 4 * pi / steps * length);
  EXPECT_NEAR(pair.shear(), before, 1e-10 * before);
  EXPECT_NEAR(pair.state.shear.x, 3e-6, 1e-5 * 3e-6); // angle^3/12 a step
}

TEST(ElastoDamagePlastic, strengths_that_are_never_reached_do_no_work) {
  ElastoDamagePlastic::Parameters p;
  Interface pair(p);
  pair.move({0, 0, 1e-4}, 3);
  pair.impose({0, 0, 0}, {1e-4, 0, 0}, 0);
  pair.move({0, 0, -3e-4}, 3);
  EXPECT_EQ(pair.state.dissipated, 0);
  EXPECT_EQ(pair.state.plastic, 0);
  EXPECT_NEAR(pair.normal(), -2e-4 * pair.geometry.normal_stiffness, 1);
  EXPECT_TRUE(std::isfinite(pair.now.energy));
}

TEST(ElastoDamagePlastic, a_strength_factor_scales_both_strengths_and_keeps_fracture_energies) {
  ElastoDamagePlastic::Parameters p = cohesive_bond_of_concrete();
  p.fracture_energy_tension = 2;
  Interface pair(p);
  pair.geometry.strength_factor = 1.5;
  pair.move({0, 0, 1.5 * pair.opening_limit()});
  EXPECT_NEAR(pair.normal(), 7.5e6, 1);
  EXPECT_NEAR(pair.state.tension_damage, 0, 1e-9);
  pair.move({0, 0, 2 * 2 / 7.5e6 * (1 + 1e-9)}, 3);
  EXPECT_EQ(pair.state.tension_damage, 1);
  const double elastic = 0.5 * 7.5e6 * 1.5 * pair.opening_limit();
  EXPECT_NEAR(pair.state.dissipated / pair.geometry.area, elastic + 2, 1e-7);
  Interface other(p);
  other.geometry.strength_factor = 1.5;
  const double limit = 24e6 / other.shear_stiffness();
  other.impose({0, 0, 0}, {1.25 * limit, 0, 0}, 0);
  EXPECT_NEAR(other.state.shear_damage, 0.25, 1e-9);
}

ElastoDamagePlastic::Parameters bending_concrete() {
  ElastoDamagePlastic::Parameters p = cohesive_bond_of_concrete();
  p.moments = true;
  p.moment_contribution = 0.5;
  return p;
}

TEST(CohesiveMoments, are_those_of_the_parallel_bond_while_whole) {
  ElastoDamagePlastic::Parameters p = bending_concrete();
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
  Interface pair(bending_concrete());
  pair.geometry.lever = 0.3;
  pair.OneBond::move({2e-7, -3e-7, 1e-7}, {1e-5, 2e-5, -3e-5}, {-2e-5, 1e-5, 2e-5});
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
    Interface pair(bending_concrete());
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
  Interface pair(bending_concrete());
  const double kn = pair.geometry.normal_stiffness, pressed = 10e6;
  pair.move({0, 0, -pressed / kn});
  pair.bend((pressed + 4.9e6) / (0.5 * kn * bond_radius), 10);
  EXPECT_EQ(pair.state.tension_damage, 0);
  pair.bend(0.3e6 / (0.5 * kn * bond_radius));
  EXPECT_GT(pair.state.tension_damage, 0);
}

TEST(CohesiveMoments, a_rigid_turn_stores_nothing) {
  Interface pair(bending_concrete());
  pair.bend(1e-4), pair.twist(2e-4);
  const double energy = pair.now.energy;
  const int steps = 20000;
  for (int k = 0; k < steps; ++k) {
    const Triple<double> turn{1.5 * pi / steps, 0, 0};
    const Quaternion q = rotation_quaternion({turn.x, turn.y, turn.z});
    const Triple<double> to = turned(Rotation<double>{q.w, q.x, q.y, q.z}, pair.pose.distance);
    pair.OneBond::move(to - pair.pose.distance, turn, turn);
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
} // namespace platen::dem::elasto_damage_plastic_test
