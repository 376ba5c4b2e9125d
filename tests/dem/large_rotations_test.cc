// Chains of beams bent far, against the elastica and the circle; and explicit runs that go on from there.
#include "dem/large_rotations.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/dem/examples.h"

namespace platen::dem {
namespace {

using namespace examples;

constexpr double young = 40e9, slender = .3;
// Bending stiffness of the beams, N m^2.
const double ei = young * pi * std::pow(slender * radius, 4) / 4;

StaticCase clamped(const Model &model) {
  StaticCase load;
  load.led.push_back({static_cast<int>(row_of(model.particles, 0)), {}, {}});
  load.force.resize(model.particles.size());
  load.torque.resize(model.particles.size());
  return load;
}

// Tip of an inextensible cantilever along x of length l under a load across, along z: EI theta'' =
// -p cos(theta), theta(0) = 0, theta'(l) = 0, by shooting with the root curvature and Runge-Kutta steps.
Vector3 elastica(double l, double p) {
  constexpr int steps = 4000;
  const double h = l / steps;
  struct State {
    double theta, curvature, x, z;
  };
  const auto slope = [&](const State &s) {
    return State{s.curvature, -p * std::cos(s.theta) / ei, std::cos(s.theta), std::sin(s.theta)};
  };
  const auto at = [](const State &s, const State &d, double by) {
    return State{s.theta + by * d.theta, s.curvature + by * d.curvature, s.x + by * d.x, s.z + by * d.z};
  };
  const auto end = [&](double curvature) {
    State s{0, curvature, 0, 0};
    for (int k = 0; k < steps; ++k) {
      const State a = slope(s), b = slope(at(s, a, .5 * h)), c = slope(at(s, b, .5 * h)),
                  d = slope(at(s, c, h));
      s = at(at(at(at(s, a, h / 6), b, h / 3), c, h / 3), d, h / 6);
    }
    return s;
  };
  double low = 0, high = p * l / ei;
  for (int k = 0; k < 60; ++k) {
    const double middle = .5 * (low + high);
    (end(middle).curvature > 0 ? high : low) = middle;
  }
  const State tip = end(.5 * (low + high));
  return {tip.x, 0, tip.z};
}

double error_of_the_tip(int beams, double load) {
  const double l = 2 * radius * beams, p = load * ei / (l * l);
  Model model(row(beams, {1, 0, 0}), bonded_by_beams(young, .2, slender));
  const std::size_t tip = row_of(model.particles, beams);
  StaticCase c = clamped(model);
  c.force[tip] = {0, 0, p};
  const LargeResult r = solve_static_far(model.particles, *model.bonds, c);
  EXPECT_LE(r.residual, 1e-9);
  EXPECT_LT(r.iterations, 60);
  return norm(model.particles.position[tip] - elastica(l, p)) / l;
}

// At P l^2/EI = 3 the tip has gone .60 of the length across (Bisshopp and Drucker 1945). Beams that turn
// against each other by some hundredths of a radian are 1e-4 too soft, the square of the angle over 6.
TEST(large_rotations, a_cantilever_bends_as_the_elastica) {
  const double l = 80 * radius;
  EXPECT_NEAR(elastica(l, 3 * ei / (l * l)).z / l, .6033, 1e-3);
  for (const double load : {1.0, 3.0, 10.0}) {
    const double coarse = error_of_the_tip(10, load), fine = error_of_the_tip(40, load);
    EXPECT_LT(fine, 1e-3) << load;
    EXPECT_LT(fine, .1 * coarse) << load; // second order: a sixteenth
  }
}

// Every bond turns by the angle whose sine is M l/EI: its potential is that of the half angle.
TEST(large_rotations, an_end_moment_bends_to_a_circle) {
  const int beams = 40;
  const double l = 2 * radius, moment = pi * ei / (beams * l); // half a circle
  Model model(row(beams, {1, 0, 0}), bonded_by_beams(young, .2, slender));
  StaticCase c = clamped(model);
  c.torque[row_of(model.particles, beams)] = {0, -moment, 0};
  LargeSettings settings;
  settings.load_steps = 4;
  solve_static_far(model.particles, *model.bonds, c, settings);
  const double turn = std::asin(moment * l / ei), exact = l / (2 * std::sin(turn / 2));
  EXPECT_NEAR(exact / (ei / moment), 1, 2e-3);
  const auto place = [&](int k) { return model.particles.position[row_of(model.particles, k)]; };
  // Radius of the circle through three nodes.
  for (const int k : {0, 10, 20}) {
    const Vector3 a = place(k), b = place(k + 10), d = place(k + 20);
    const double area = .5 * norm(cross(b - a, d - a));
    EXPECT_NEAR(norm(b - a) * norm(d - b) * norm(a - d) / (4 * area) / exact, 1, 1e-6) << k;
  }
}

// Loads that bend far do what small ones do where they are small.
TEST(large_rotations, small_loads_give_the_linear_answer) {
  Model far(packed_box(9, 9, 9), bonded()), near(packed_box(9, 9, 9), bonded());
  StaticCase load;
  load.led.push_back({0, {}, {}});
  load.force.resize(far.particles.size());
  load.force[far.particles.size() - 1] = {.2, .3, -.4};
  for (std::size_t i = 0; i < far.particles.size(); i += 7)
    load.supports.push_back({{static_cast<int>(i), {0, 0, 1}, {0, 0, -radius}, 1e6, 4e5, 2.}, {1e-8, 0, 0}});
  const LargeResult r = solve_static_far(far.particles, *far.bonds, load);
  EXPECT_LE(r.iterations, 4);
  move_to(solve_static(near.particles, *near.bonds, load), near.particles, *near.bonds);
  double difference = 0, largest = 0;
  for (std::size_t i = 0; i < far.particles.size(); ++i) {
    difference = std::max(difference, norm(far.particles.position[i] - near.particles.position[i]));
    largest = std::max(largest, norm(near.particles.position[i] - near.particles.reference_position[i]));
  }
  EXPECT_GT(largest, 0);
  EXPECT_LT(difference, 1e-3 * largest);
}

// The explicit scheme finds nothing to do at the equilibrium: under the same load the chain stays.
TEST(large_rotations, an_explicit_run_goes_on_from_there) {
  const int beams = 12;
  const double l = 2 * radius * beams, p = 3 * ei / (l * l);
  Model model(row(beams, {1, 0, 0}), bonded_by_beams(young, .2, slender));
  const std::size_t tip = row_of(model.particles, beams), root = row_of(model.particles, 0);
  StaticCase c = clamped(model);
  c.force[tip] = {0, 0, p};
  LargeSettings settings;
  settings.tolerance = 1e-11;
  solve_static_far(model.particles, *model.bonds, c, settings);
  const Vector3 there = model.particles.position[tip];
  EXPECT_GT(there.z, .5 * l);
  // What is on the particles is what the step would compute.
  const std::vector<Vector3> force(model.particles.force.begin(), model.particles.force.end());
  std::vector<BondBreak> breaks;
  const Loads step_forces =
      kernel_loads(model.particles, *model.bonds, model.settings().instruction_set, breaks);
  for (std::size_t i = 0; i < force.size(); ++i)
    ASSERT_LT(norm(force[i] - step_forces.force[i]), 1e-9 * p) << i;
  const auto load = [&](Particles &q) {
    q.force[tip] += Vector3{0, 0, p};
    q.force[root] = {};
    (*q.torque)[root] = {};
  };
  load(model.particles);
  const double dt = .5 * model.stable_step({}, 0).limit;
  for (int k = 0; k < 2000; ++k)
    step(model, dt, load);
  EXPECT_LT(norm(model.particles.position[tip] - there), 1e-8 * l);
}

TEST(large_rotations, spheres_that_do_not_turn_are_refused) {
  ModelSettings still = bonded();
  still.rotation = false;
  Model model(row(2, {1, 0, 0}), still);
  EXPECT_THROW(solve_static_far(model.particles, *model.bonds, {}), std::invalid_argument);
}

} // namespace
} // namespace platen::dem
