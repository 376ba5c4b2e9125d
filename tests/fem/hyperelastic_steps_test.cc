// Explicit steps of a solid at finite strain.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

#include "tests/fem/newton.h"
#include "tests/fem/rubber_sleeve.h"
#include "tests/fem/tangent.h"
#include "tests/same_state.h"

namespace platen::fem::hyperelastic_steps_test {
namespace {

// s, 2 / omega of the fastest oscillation of all.
double limit_of(const HyperelasticSolid &solid) {
  Eigen::VectorXd root(static_cast<Eigen::Index>(3 * solid.nodal_mass().size()));
  for (Eigen::Index m = 0; m < root.size(); ++m)
    root[m] = 1 / std::sqrt(solid.nodal_mass()[static_cast<std::size_t>(m / 3)]);
  const Eigen::MatrixXd scaled = root.asDiagonal() * Eigen::MatrixXd(tangent_of(solid)) * root.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(scaled, Eigen::EigenvaluesOnly);
  return 2 / std::sqrt(solver.eigenvalues().maxCoeff());
}

TEST(hyperelastic_solid, the_stable_step_is_just_below_that_of_the_fastest_oscillation) {
  for (const double poisson : {0.3, 0.49, 0.4995}) {
    HyperelasticSolid solid = sleeve({1100, NeoHookean::from_young(3e6, poisson)});
    for (const double size : {0.0, 0.003}) {
      solid.set_displacement(bent(solid, size));
      const double limit = limit_of(solid);
      EXPECT_LT(solid.stable_step(), limit * (1 + 1e-6));
      EXPECT_GT(solid.stable_step(), 0.99 * limit);
    }
  }
}

// Energy of motion and strain = works. Velocity Verlet keeps a neighbour of the energy: the difference
// oscillates with dt^2 and does not grow. The upper end is moved up and down, so all works are counted.
TEST(hyperelastic_solid, an_explicit_vibration_closes_its_energy_balance) {
  double worst[2] = {0, 0}, balance = 0;
  for (const int fine : {0, 1}) {
    HyperelasticSolid solid = held_sleeve(2e4);
    solid.set_damping(50);
    const double dt = 0.4 * solid.stable_step() / (1 + fine);
    for (int k = 0; k < 300 * (1 + fine); ++k) {
      solid.set_prescribed_velocity(1, {0, 0, -0.5 * std::sin(2e3 * k * dt)});
      step(solid, dt, 1);
      worst[fine] = std::max(worst[fine], std::abs(imbalance(solid)));
    }
    balance = std::abs(solid.pressure_work()) + std::abs(solid.prescribed_work());
    EXPECT_GT(std::abs(solid.prescribed_work()), 0.01 * balance);
    EXPECT_GT(solid.damping_work(), 0.001 * balance);
  }
  EXPECT_LT(worst[0], 0.01 * balance);
  EXPECT_NEAR(worst[0] / worst[1], 4, 1.5); // second order
}

// Pressure and end change slowly: what they do is stored, but for the little that damping takes, to the
// second order in the step. (Works by the pressure at one end of a step alone would be of the first.)
TEST(hyperelastic_solid, works_of_a_slow_path_are_stored) {
  double error[2];
  for (const int fine : {0, 1}) {
    HyperelasticSolid solid = held_sleeve(0);
    solid.set_damping(800);
    const double dt = 0.4 * solid.stable_step() / (1 + fine), duration = 0.03; // s
    const int steps = static_cast<int>(std::lround(duration / dt));
    solid.set_prescribed_velocity(1, {0, 0, 0.012 / duration});
    for (int k = 0; k < steps; ++k) {
      solid.set_pressure(inner_tag, 4e4 * (k + 1) / steps);
      step(solid, dt, 1);
    }
    const double stored = solid.internal_energy();
    EXPECT_GT(solid.pressure_work(), 0.05 * stored);
    EXPECT_GT(solid.prescribed_work(), 0.05 * stored);
    EXPECT_LT(solid.kinetic_energy() + solid.damping_work(), 0.05 * stored);
    error[fine] = imbalance(solid);
    EXPECT_LT(std::abs(error[fine]), 1e-6 * stored);
  }
  EXPECT_NEAR(error[0] / error[1], 4, 1);
}

TEST(hyperelastic_solid, steps_below_the_limit_stay_bounded_and_above_it_do_not) {
  const double limit = limit_of(held_sleeve(0));
  HyperelasticSolid calm = held_sleeve(2e3), wild = held_sleeve(2e3);
  const double dt = 0.95 * calm.stable_step(); // it stiffens a little on its way
  double energy = 0, work = 0;
  for (int k = 0; k < 2000; ++k) {
    step(calm, dt, 1);
    energy = std::max(energy, calm.kinetic_energy() + calm.internal_energy());
    work = std::max(work, calm.pressure_work());
  }
  EXPECT_LT(energy, 2 * work);
  EXPECT_THROW(step(wild, 1.2 * limit, 2000), InvertedElement);
}

TEST(hyperelastic_solid, damped_steps_come_to_rest_where_newton_does) {
  HyperelasticSolid explicit_one = held_sleeve(2e4),
                    implicit = sleeve({1100, NeoHookean::from_young(3e6, 0.45)});
  explicit_one.set_damping(800);
  step(explicit_one, 0.9 * explicit_one.stable_step(), 6000);
  Newton newton(implicit);
  newton.prescribe(implicit.nodes_of(low_end_tag), {true, true, true});
  newton.prescribe(implicit.nodes_of(high_end_tag), {true, true, true});
  implicit.set_pressure(inner_tag, 2e4);
  newton.solve();
  const double size = largest(implicit.displacement());
  EXPECT_GT(size, 1e-4);
  for (std::size_t n = 0; n < implicit.displacement().size(); ++n)
    EXPECT_LT(norm(explicit_one.displacement()[n] - implicit.displacement()[n]), 1e-6 * size);
}

TEST(hyperelastic_solid, an_inverted_element_is_found_before_it_is_used) {
  HyperelasticSolid solid = held_sleeve(2e4);
  step(solid, 0.9 * solid.stable_step(), 20);
  const State before = state_of(solid);
  std::vector<Vector3> v = solid.velocity();
  const int node = solid.mesh().cell_nodes[37][6];
  v[static_cast<std::size_t>(node)] = {0, 0, -100};
  set_velocity(solid, v);
  const State state = state_of(solid);
  try {
    solid.drift(1e-3); // 10 cm through cells of 1 cm
    FAIL() << "an inverted element was used";
  } catch (const InvertedElement &error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("cell " + std::to_string(error.cell) + " at ("), std::string::npos) << text;
    EXPECT_NE(text.find("pressure 20000 Pa on side 6"), std::string::npos) << text;
    EXPECT_LE(error.volume_ratio, inverted_share);
    const auto &nodes = solid.mesh().cell_nodes[static_cast<std::size_t>(error.cell)];
    EXPECT_NE(std::find(nodes.begin(), nodes.end(), node), nodes.end());
  }
  EXPECT_TRUE(same_state(state, solid)); // nothing has moved
  set_state(solid, before);
  step(solid, 0.5 * solid.stable_step(), 5); // and it goes on from there
}

} // namespace
} // namespace platen::fem::hyperelastic_steps_test
