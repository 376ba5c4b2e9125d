// An elastic solid whose clamp slides by itself, as on the spring of a machine: its momentum is what was
// given to it, and its energy balance closes. That it swings with all of its mass is in
// coupling/machine_spring_test.cc.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/elastic_nodes.h"
#include "tests/fem/elastic_plate.h"

namespace platen::fem::sliding_clamp_test {
namespace {

const Vector3 down{0, 0, -1};

ElasticSolid sliding(ElasticMotion motion, double attached, double damping = 0, bool turns = false) {
  Clamp clamp;
  clamp.slides = down;
  clamp.turns = turns;
  clamp.seat = {0.01, 0, 0};
  ElasticOptions options{1, motion};
  if (motion == ElasticMotion::explicit_steps) options.fastest_damping = damping;
  ElasticSolid solid(plate(), {steel}, clamp, options);
  solid.attach(attached);
  return solid;
}

// Pushed at the clamp and loaded on its face, in steps of two of its own.
template <class Check>
void swing(ElasticSolid &solid, double dt, int steps, const Check &check, double load_size = 3e3) {
  const std::vector<Vector3> loads = uneven_loads(solid, load_size);
  double given = 0; // N s
  for (int n = 0; n < steps; ++n) {
    const double push = 2e4 * std::cos(0.05 * n), load = std::sin(0.03 * n);
    std::vector<Vector3> now = loads;
    for (Vector3 &f : now)
      f = load * f;
    solid.push(0.5 * dt * push);
    put(solid, now);
    solid.kick(0.5 * dt), solid.drift(dt), solid.kick(0.5 * dt);
    solid.push(0.5 * dt * push);
    given += dt * (push + dot(solid.total_force(), down));
    check(n, given);
  }
}

TEST(sliding_clamp, its_momentum_is_what_was_given_to_it) {
  constexpr double attached = 0.7; // kg
  for (const double damping : {0.0, 0.2}) {
    ElasticSolid solid = sliding(ElasticMotion::explicit_steps, attached, damping);
    swing(solid, 1.7 * solid.stable_step(), 300, [&](int n, double given) {
      const double momentum = dot(momenta(solid).linear, down) + attached * solid.sliding_velocity();
      ASSERT_NEAR(momentum, given, 1e-12 * 2e4 * 300 * solid.stable_step()) << n;
    });
    EXPECT_EQ(solid.velocity().x, 0);
    EXPECT_EQ(solid.velocity().y, 0);
  }
  ElasticSolid still = sliding(ElasticMotion::quasi_static, attached);
  EXPECT_NEAR(still.sliding_mass(), still.mass() + attached, 1e-12);
  swing(still, 1e-6, 300, [&](int n, double given) {
    ASSERT_NEAR(still.sliding_mass() * still.sliding_velocity(), given, 1e-12 * 2e4 * 300e-6) << n;
  });
}

TEST(sliding_clamp, the_energy_balance_closes) {
  for (const ElasticMotion motion : {ElasticMotion::explicit_steps, ElasticMotion::quasi_static})
    for (const bool turns : {false, true}) {
      ElasticSolid solid = sliding(motion, 0.7, turns ? 0 : 0.2, turns);
      const bool is_static = motion == ElasticMotion::quasi_static;
      double most = 0, worst = 0;
      swing(
          solid, is_static ? 1e-6 : 1.7 * solid.stable_step(), 300,
          [&](int n, double) {
            const EnergyBalance now = solid.energy_balance();
            most = std::max(most, now.kinetic + now.strain);
            worst = std::max(worst, std::abs(total(now)));
            if (is_static && n % 10 == 9) solid.solve_for(solid.contact_loads(), 1e-5);
          },
          turns ? 100 : 3e3);
      EXPECT_GT(most, 1e-3);
      // Where it turns, to the second order of the step.
      if (turns) {
        EXPECT_GT(norm(solid.angular_velocity()), 1);
      }
      EXPECT_LT(worst, (turns ? 1e-3 : 1e-12) * most) << static_cast<int>(motion) << turns;
    }
}

TEST(sliding_clamp, the_largest_step_counts_the_spring_that_pushes_it) {
  const ElasticSolid solid = sliding(ElasticMotion::explicit_steps, 0.7);
  VertexSprings springs;
  springs.stiffness.assign(solid.surface().vertices.size(), 0.0);
  springs.dashpot = springs.stiffness;
  const double without = solid.stable_step(springs);
  springs.clamp = 1e8;
  EXPECT_NEAR(solid.stable_step(springs) / without, 1, 1e-3);
  springs.clamp = 1e15;
  EXPECT_NEAR(solid.stable_step(springs) / (2 * std::sqrt(solid.sliding_mass() / 1e15)), 1, 0.02);
}

TEST(sliding_clamp, without_a_clamp_there_is_nothing_to_slide) {
  Clamp clamp;
  clamp.tag = no_clamp;
  clamp.slides = down;
  EXPECT_THROW(ElasticSolid(plate(), {steel}, clamp), std::invalid_argument);
}

} // namespace
} // namespace platen::fem::sliding_clamp_test
