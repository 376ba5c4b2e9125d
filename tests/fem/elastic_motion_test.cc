// Explicit motion of an elastic solid: oscillations, steps and energy balances.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "base/pi.h"
#include "tests/elastic_nodes.h"
#include "tests/fem/elastic_plate.h"

namespace platen::fem::elastic_motion_test {
namespace {

// s, between the zeros of an oscillation, on the mean over so many halves of it; each step is one of the
// solid.
double half_period(ElasticSolid &solid, double dt, int halves, const std::function<double()> &value) {
  double first = 0, last = 0, before = value();
  for (int n = 1, crossings = 0; crossings <= halves; ++n) {
    solid.drift(dt, 1);
    const double now = value();
    if (before * now < 0) {
      last = (n - now / (now - before)) * dt;
      if (crossings++ == 0) first = last;
    }
    before = now;
  }
  return (last - first) / halves;
}

// Rod of unit length fixed at its high end, without sideways strain: u = cos(k z), k = pi / 2, oscillates
// with the period 4 L / c. Linear elements with lumped mass are too slow by (k h)^2 / 24 = 0.16 %, the step's
// own error takes part of it back.
TEST(elastic_solid, a_rod_oscillates_with_the_speed_of_sound) {
  for (const int degree : {1, 2}) {
    ElasticSolid rod(make_grid(BoxPlate{{0, 0, 0}, {0.1, 0.1, 1}, {1, 1, 8}}), {{2000, 8e9, 0}}, Clamp{},
                     {degree});
    std::vector<Vector3> u(rod.model().nodes.size(), Vector3{});
    for (std::size_t i = 0; i < u.size(); ++i)
      u[i][2] = 1e-6 * std::cos(0.5 * pi * rod.model().nodes[i][2]);
    set_deformation(rod, u, {});
    std::size_t tip = 0;
    while (rod.model().nodes[tip][2] != 0)
      ++tip;
    const double c = 2000, half = half_period(rod, 0.5 * rod.stable_step(), 4,
                                              [&] { return rod.deformation()[tip][2]; });
    EXPECT_NEAR(2 * half, 4 / c, degree == 1 ? 0.002 * 4 / c : 5e-4 * 4 / c) << degree;
  }
}

// Slender cantilever (Euler-Bernoulli): w = 1.8751^2 sqrt(E I / (rho A L^4)). Shear and the turning of
// sections take 0.4 % off at L / h = 20. Degree 2, since linear elements lock in bending.
TEST(elastic_solid, a_cantilever_oscillates_as_a_beam_does) {
  const double h = 0.05, e = 8e9, rho = 2000;
  ElasticSolid beam(make_grid(BoxPlate{{0, 0, 0}, {h, h, 1}, {1, 1, 10}}), {{rho, e, 0}}, Clamp{}, {2});
  std::vector<Vector3> u(beam.model().nodes.size(), Vector3{});
  for (std::size_t i = 0; i < u.size(); ++i) { // the shape under a force at the tip
    const double s = 1 - beam.model().nodes[i][2];
    u[i][0] = 1e-4 * s * s * (3 - s) / 2;
    u[i][2] = 1e-4 * (beam.model().nodes[i][0] - h / 2) * (6 * s - 3 * s * s) / 2;
  }
  set_deformation(beam, u, {});
  const std::vector<Vector3> shape = beam.deformation();
  const double w = 1.8751041 * 1.8751041 * std::sqrt(e * h * h / 12 / rho);
  const double half = half_period(beam, 0.9 * beam.stable_step(), 2, [&] {
    double sum = 0; // how much of the shape is left: other modes have little share in it
    const std::vector<Vector3> now = beam.deformation();
    for (std::size_t i = 0; i < u.size(); ++i)
      sum += beam.model().mass[i] * dot(shape[i], now[i]);
    return sum;
  });
  EXPECT_NEAR(2 * half, 2 * pi / w, 0.008 * 2 * pi / w);
}

// Central differences keep their energy exactly: what is left is round-off of a thousand steps, on any step.
TEST(elastic_solid, the_energy_balance_of_an_oscillation_closes) {
  for (const int degree : {1, 2})
    for (const bool damped : {false, true}) {
      ElasticOptions options{degree};
      options.mass_damping = damped ? 500 : 0;
      options.stiffness_damping = damped ? 1e-8 : 0;
      ElasticSolid solid(plate(), {steel}, Clamp{}, options);
      const std::vector<Vector3> loads = uneven_loads(solid, 1e4);
      solid.set_velocity({0, 0, -0.5});
      const double dt = 0.8 * solid.stable_step();
      solid.drift(dt, 1);
      const double start = total(solid.energy_balance());
      double largest = 0;
      for (int k = 0; k < 1000; ++k) {
        if (k == 300) solid.set_velocity({0, 0, 0.3});
        std::vector<Vector3> now = loads;
        for (Vector3 &f : now)
          f = (1 + std::sin(0.1 * k)) * f;
        solid.kick(0.5 * dt);
        solid.drift(dt, 1);
        put(solid, now);
        solid.kick(0.5 * dt);
        largest = std::max(largest, solid.energy_balance().strain);
        ASSERT_NEAR(total(solid.energy_balance()), start, 1e-8 * largest) << k;
      }
      const EnergyBalance b = solid.energy_balance();
      EXPECT_NE(b.load_work, 0);
      EXPECT_NE(b.clamp_work, 0);
      EXPECT_EQ(b.dissipated != 0, damped);
    }
}

// Loads and the machine's velocity fixed over a time in steps of dt and dt / 2 against far finer ones; drifts
// of one and of three steps of their own.
TEST(elastic_solid, explicit_motion_is_of_second_order) {
  for (const int inner : {1, 3}) {
    const auto run = [&](int steps) {
      ElasticSolid solid(plate(), {pad}, Clamp{}, {1});
      const double end = 24 * solid.stable_step() * (inner == 1 ? 1 : 2), dt = end / steps;
      const std::vector<Vector3> loads = uneven_loads(solid, 10);
      solid.set_velocity({0, 0, -0.01});
      for (int k = 0; k <= steps; ++k) {
        std::vector<Vector3> now = loads;
        for (Vector3 &f : now)
          f = std::pow(std::sin(2 * pi * k / steps), 2) * f;
        put(solid, now);
        if (k > 0) solid.kick(0.5 * dt);
        if (k == steps) break;
        solid.kick(0.5 * dt);
        solid.drift(dt, inner);
      }
      return solid.deformation();
    };
    const auto fine = run(2048), middle = run(256), coarse = run(128);
    double near = 0, far = 0;
    for (std::size_t i = 0; i < fine.size(); ++i)
      near += dot(middle[i] - fine[i], middle[i] - fine[i]),
          far += dot(coarse[i] - fine[i], coarse[i] - fine[i]);
    EXPECT_NEAR(0.5 * std::log2(far / near), 2.0, 0.1) << inner;
  }
}

// Shaken at random, energy stays for thousands of steps below the limit and explodes above it.
TEST(elastic_solid, the_stable_step_is_the_limit) {
  const Grid skew = moved_grid(plate(), [](const Vector3 &p) {
    return Vector3{p[0] + 0.3 * p[1] * std::sin(40 * p[2]), p[1] + 5 * p[0] * p[2],
                   p[2] + 400 * p[0] * p[2] * (0.02 - p[2])};
  });
  for (const int degree : {1, 2}) {
    const auto growth = [&](double share) {
      ElasticSolid solid(skew, {steel}, Clamp{}, {degree});
      const std::vector<Vector3> none(solid.model().nodes.size(), Vector3{});
      set_deformation(solid, none, shaken(solid, 1e-3));
      const double start = solid.kinetic_energy(), dt = share * solid.stable_step();
      for (int k = 0; k < 3000; ++k)
        solid.drift(dt, 1);
      return solid.kinetic_energy() / start;
    };
    EXPECT_LT(growth(0.95), 3) << degree;
    EXPECT_FALSE(growth(1.05) < 1e6) << degree;
    const ElasticSolid solid(skew, {steel}, Clamp{}, {degree});
    const double by_cells = 2 / std::sqrt(solid.model().cell_bound);
    EXPECT_LE(by_cells, solid.stable_step());
    EXPECT_GT(by_cells, 0.5 * solid.stable_step());
    EXPECT_EQ(solid.substeps(10 * solid.stable_step()), 12);
  }
}

// One vertex on a spring much stiffer than the body: an oscillator of its mass with the spring, which a
// dashpot of xi of critical lets step by sqrt(1 + xi^2) - xi of what it could without.
TEST(elastic_solid, a_dashpot_at_one_vertex_shortens_the_step) {
  const ElasticSolid solid(plate(), {steel}, Clamp{}, {1});
  const std::size_t n = solid.surface().vertices.size();
  VertexSprings springs{std::vector<double>(n, 0.0), std::vector<double>(n, 0.0)};
  const double stiffness = springs.stiffness[n / 2] = 1e18;
  const double without = solid.stable_step(springs),
               omega = 2 / without; // own motion counts by 1e-4 beside it
  EXPECT_LT(without, 1e-2 * solid.stable_step());
  for (const double xi : {0.1, 0.5, 2.0}) {
    springs.dashpot[n / 2] = 2 * xi * stiffness / omega;
    EXPECT_NEAR(solid.stable_step(springs) / without, std::sqrt(1 + xi * xi) - xi, 1e-3) << xi;
  }
}

TEST(elastic_solid, a_free_body_keeps_its_momentum) {
  Clamp none;
  none.tag = no_clamp;
  ElasticSolid solid(plate(), {steel}, none, {2});
  const std::vector<Vector3> u = shaken(solid, 1e-7);
  set_deformation(solid, u, shaken(solid, 1e-2));
  const Vector3 start = momenta(solid).linear;
  const double size = std::sqrt(2 * solid.mass() * solid.kinetic_energy()), dt = 0.9 * solid.stable_step();
  for (int k = 0; k < 1000; ++k)
    solid.drift(dt, 1);
  EXPECT_LT(norm(momenta(solid).linear - start), 1e-11 * size); // round-off of a thousand steps
  EXPECT_THROW(solid.set_velocity({1, 0, 0}), std::logic_error);
}

} // namespace
} // namespace platen::fem::elastic_motion_test
