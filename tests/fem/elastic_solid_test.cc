// Clamp and quasi-static shapes of an elastic solid.
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "tests/elastic_nodes.h"
#include "tests/fem/elastic_plate.h"

namespace platen::fem::elastic_solid_test {
namespace {

// Momentum gained = loads less what the clamp takes, step by step; and what it takes at rest is the loads.
TEST(elastic_solid, the_clamp_bears_what_the_loads_give) {
  ElasticOptions options{1};
  options.mass_damping = 2e4;
  ElasticSolid solid(plate(), {steel}, Clamp{}, options);
  put(solid, uneven_loads(solid, 1e4));
  const double dt = 0.9 * solid.stable_step();
  for (int k = 0; k < 4000; ++k) {
    solid.kick(0.5 * dt), solid.drift(dt, 1), solid.kick(0.5 * dt);
  }
  const double size = norm(solid.total_force());
  EXPECT_LT(norm(clamp_loads(solid).force - solid.total_force()), 1e-9 * size);
  EXPECT_LT(norm(clamp_loads(solid).moment - solid.moment(solid.centre())),
            1e-6 * norm(clamp_loads(solid).moment));
  // Quasi-static: the same shape, and the strain energy is half of what the loads would do at full size.
  ElasticSolid slow(plate(), {steel}, Clamp{}, {1, ElasticMotion::quasi_static});
  const std::vector<Vector3> loads = uneven_loads(slow, 1e4);
  put(slow, loads);
  slow.solve_for(loads, 0);
  const auto a = solid.deformation(), b = slow.deformation();
  double largest = 0;
  for (const Vector3 &p : b)
    largest = std::max(largest, norm(p));
  for (std::size_t i = 0; i < a.size(); ++i)
    EXPECT_LT(norm(a[i] - b[i]), 1e-8 * largest);
  const EnergyBalance balance = slow.energy_balance();
  EXPECT_NEAR(balance.load_work, 2 * balance.strain, 1e-10 * balance.strain);
  EXPECT_NEAR(total(balance), 0, 1e-10 * balance.strain);
  EXPECT_LT(norm(clamp_loads(slow).force - slow.total_force()), 1e-12 * size);
}

TEST(elastic_solid, a_quasi_static_body_goes_evenly_to_its_shape) {
  for (const LinearSolver kind : {LinearSolver::direct, LinearSolver::multigrid}) {
    ElasticOptions options{2, ElasticMotion::quasi_static};
    options.solver = kind;
    ElasticSolid solid(plate(), {steel}, Clamp{}, options), at_once(plate(), {steel}, Clamp{}, options);
    const std::vector<Vector3> loads = uneven_loads(solid, 1e4);
    at_once.solve_for(loads, 0);
    solid.set_velocity({0, 0, -0.1});
    solid.solve_for(loads, 1e-5);
    EXPECT_EQ(solid.solver_kind(), kind);
    const double dt = 1e-6;
    for (int k = 0; k < 10; ++k) {
      const auto before = solid.surface().vertices;
      put(solid, loads);
      solid.kick(0.5 * dt), solid.drift(dt), solid.kick(0.5 * dt);
      double farthest = 0;
      for (std::size_t v = 0; v < before.size(); ++v) { // velocities are those of the way
        const Vector3 way = solid.surface().vertices[v] - before[v];
        EXPECT_LT(norm(way - dt * solid.surface().velocities[v]), 1e-16);
        farthest = std::max(farthest, norm(way));
      }
      EXPECT_EQ(solid.last_move(), farthest);
    }
    const auto a = solid.deformation(), b = at_once.deformation();
    for (std::size_t i = 0; i < a.size(); ++i)
      EXPECT_LT(norm(a[i] - b[i]), 1e-16);
    EXPECT_NEAR(solid.energy_balance().strain, at_once.energy_balance().strain,
                1e-10 * at_once.energy_balance().strain);
    EXPECT_NEAR(total(solid.energy_balance()), 0, 1e-9 * solid.energy_balance().strain);
    solid.drift(dt); // there: only the machine moves it
    for (const Vector3 &v : solid.surface().velocities)
      EXPECT_EQ(v, (Vector3{0, 0, -0.1}));
  }
}

// Loads that stand in full all along the way do twice the strain energy, loads that grow with it just that.
// What is left over is told apart, and found here from forces and ways alone.
TEST(elastic_solid, work_that_a_body_without_inertia_does_not_hold_is_told_by_itself) {
  for (const bool grows : {false, true}) {
    ElasticSolid solid(plate(), {steel}, Clamp{}, {1, ElasticMotion::quasi_static});
    const std::vector<Vector3> loads = uneven_loads(solid, 1e4);
    const auto load = [&](double share) {
      std::vector<Vector3> now(loads);
      for (Vector3 &f : now)
        f = (grows ? share : 1) * f;
      solid.clear_loads();
      put(solid, now);
      return now;
    };
    const double dt = 1e-6;
    constexpr int steps = 20;
    solid.solve_for(loads, steps * dt);
    double work = 0;
    std::vector<Vector3> before = load(0);
    for (int k = 0; k < steps; ++k) {
      const auto from = solid.surface().vertices;
      solid.kick(0.5 * dt), solid.drift(dt);
      const std::vector<Vector3> now = load((k + 1.0) / steps);
      solid.kick(0.5 * dt);
      for (std::size_t v = 0; v < from.size(); ++v)
        work += 0.5 * dot(before[v] + now[v], solid.surface().vertices[v] - from[v]);
      before = now;
    }
    const EnergyBalance b = solid.energy_balance();
    ASSERT_GT(b.strain, 0);
    EXPECT_EQ(b.dissipated, 0);
    EXPECT_NEAR(b.unbalanced, work - b.strain, 1e-9 * b.strain);
    EXPECT_NEAR(b.unbalanced, grows ? 0 : b.strain, 1e-9 * b.strain);
  }
}

// The softer a block is beside its springs, the more solves it takes to its place; counted one by one.
TEST(elastic_solid, a_supported_body_says_how_many_solves_it_is_behind) {
  ElasticSolid alone(plate(), {steel}, Clamp{}, {1, ElasticMotion::quasi_static});
  EXPECT_EQ(alone.solves_behind({1, 0, 0}), 2);
  double last = 2;
  for (const double spring : {1e6, 1e8, 1e9, 1e10}) { // N/m a vertex
    ElasticSolid solid(plate(), {steel}, Clamp{}, {1, ElasticMotion::quasi_static});
    std::vector<double> springs(solid.surface().vertices.size(), 0.0);
    for (std::size_t f = 0; f < solid.surface().faces.size(); ++f)
      if (solid.surface().face_tags[f] == low_end_tag)
        for (const int v : solid.surface().faces[f])
          springs[static_cast<std::size_t>(v)] = spring;
    solid.set_support(springs);
    const double behind = solid.solves_behind({1, 0, 0});
    EXPECT_GT(behind, last);
    last = behind;
    if (spring < 1e9) continue;
    const std::vector<Vector3> start = solid.surface().vertices;
    const auto mean = [&] {
      double sum = 0, count = 0;
      for (std::size_t v = 0; v < springs.size(); ++v)
        if (springs[v] > 0) sum += solid.surface().vertices[v].x - start[v].x, ++count;
      return sum / count;
    };
    std::vector<Vector3> loads(springs.size());
    const auto solve = [&] {
      solid.solve_for(loads, 1e-6);
      solid.drift(1e-6);
    };
    for (std::size_t v = 0; v < springs.size(); ++v)
      loads[v] = {springs[v] > 0 ? 1e3 : 0.0, 0, 0};
    std::vector<double> places;
    for (int k = 0; k < 40 * behind; ++k) {
      solve();
      places.push_back(mean());
    }
    const double end = places.back();
    std::size_t n = 0;
    while (std::abs(places[n] - end) > std::exp(-1) * std::abs(end))
      ++n;
    EXPECT_NEAR(static_cast<double>(n + 1), behind, 0.5 * behind) << spring;
  }
}

TEST(elastic_solid, grips_that_cannot_hold_are_refused) {
  const auto refused = [](Clamp clamp, ElasticOptions options = {}) {
    EXPECT_THROW(ElasticSolid(plate(), {steel}, clamp, options), std::invalid_argument);
  };
  Clamp clamp;
  clamp.tag = 77;
  refused(clamp);
  clamp = {};
  clamp.tag = no_clamp, clamp.turns = true;
  refused(clamp);
  clamp = {};
  clamp.tag = no_clamp;
  refused(clamp, {1, ElasticMotion::quasi_static});
  refused({}, {1, ElasticMotion::quasi_static, 1.0});
  refused({}, {1, ElasticMotion::explicit_steps, -1.0});
  ElasticSolid solid(plate(), {steel}, Clamp{});
  EXPECT_THROW(solid.solve_for(solid.contact_loads(), 0), std::logic_error);
}

} // namespace
} // namespace platen::fem::elastic_solid_test
