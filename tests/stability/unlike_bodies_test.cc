// Bodies that hardly belong together: masses, then moduli, a million and a hundred million times apart.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "coupling/platen_test.h"
#include "tests/coupling/elastic_problem.h"
#include "tests/dem/examples.h"
#include "tests/measured.h"

namespace platen::unlike_bodies_test {
namespace {

using measured::expect_below;

std::string power(double ratio) {
  return "_at_1e" + std::to_string(std::lround(std::log10(ratio)));
}

// A light sphere that touches two heavy ones, which are pressed together: each overlap is the force over the
// stiffness of that contact, and the energy balance closes.
void squeeze(double mass_ratio) {
  using dem::examples::radius;
  const double large = std::cbrt(mass_ratio) * radius;
  dem::Specimen specimen =
      dem::examples::spheres({{-(large + radius), 0, 0}, {0, 0, 0}, {large + radius, 0, 0}});
  specimen.radius = {large, radius, large};
  dem::ModelSettings settings = dem::examples::breakable();
  settings.bond.reset();
  settings.local_damping = .6;
  dem::Model model(specimen, settings);
  model.contacts->search(model.particles, nullptr, 0);
  dem::Particles &p = model.particles;
  const std::size_t left = dem::examples::row_of(p, 0), middle = dem::examples::row_of(p, 1),
                    right = dem::examples::row_of(p, 2);
  ASSERT_NEAR(p.mass[left] / p.mass[middle] / mass_ratio, 1, 1e-6);
  const double stiffness = settings.bond_layout.axial_stiffness(large, radius), push = 10; // N/m, N
  const double dt = .8 * model.stable_step({}, 0).limit;
  double work = 0, before = 0;
  const int steps = 400000;
  for (int s = 0; s < steps; ++s) {
    const double load = push * std::min(1.0, 2.0 * s / steps);
    dem::examples::step(model, dt,
                        [&](dem::Particles &q) { q.force[left].x += load, q.force[right].x -= load; });
    const double closed = 2 * (large + radius) - (p.position[right].x - p.position[left].x);
    work += load * (closed - before), before = closed;
  }
  double off = 0;
  for (const auto &[one, other] : {std::pair{left, middle}, std::pair{middle, right}}) {
    const double overlap = p.radius[one] + p.radius[other] - (p.position[other].x - p.position[one].x);
    off = std::max(off, std::abs(overlap * stiffness / push - 1));
  }
  const dem::EnergyLedger e = model.energy();
  expect_below(11, "overlap_of_light_and_heavy_against_springs" + power(mass_ratio), off, 1e-2);
  expect_below(11, "energy_residual_of_light_and_heavy_over_work" + power(mass_ratio),
               std::abs(e.stored() + e.lost() - work) / work, 1e-2);
}

TEST(unlike_bodies, a_light_sphere_between_heavy_ones) {
  squeeze(1e6);
  squeeze(1e8);
}

// Three soft grains, bonded in a column, between platens of steel: contact, bond, bond and contact in series.
// The column closes over the same time whatever the platens' own steps are.
void press_column(double modulus_ratio, fem::ElasticMotion motion) {
  constexpr double r = 1e-3, steel = 200e9;
  dem::Specimen column;
  column.centre = {{0, 0, r}, {0, 0, 3 * r}, {0, 0, 5 * r}};
  column.radius = {r, r, r};
  column.shape = dem::box(2 * r, 2 * r, 6 * r);
  coupling::PlatenTestSettings s = coupling::elastic_settings(0.5);
  s.ends = coupling::Ends::as_packed;
  s.model.bond_layout.modulus = steel / modulus_ratio;
  s.platens.material.young_modulus = steel;
  s.platens.elements_across = 3;
  s.platens.damping = 0;
  s.platens.elastic = coupling::ElasticPlatens{};
  s.platens.elastic->motion = fem::ElasticMotion::quasi_static;
  s.loading.rate = 1; // to be replaced
  constexpr double strain = 1e-4;
  const double time = 3000 * coupling::PlatenTest(column, s).time_step();
  s.loading.rate = strain * 6 * r / time;
  s.platens.elastic->motion = motion;
  coupling::PlatenTest problem(column, s);
  problem.advance(std::lround(time / problem.time_step()));
  const double force = .5 * (problem.stress_top() + problem.stress_bottom()) * problem.nominal_area();
  ASSERT_TRUE(std::isfinite(force));
  ASSERT_GT(force, 0);
  const double spring = s.model.bond_layout.axial_stiffness(r, r); // of bonds, and of contacts as of bonds
  const dem::Particles &p = problem.model.particles;
  const std::size_t low = dem::examples::row_of(p, 0);
  const double overlap = problem.end_planes().low - (p.position[low].z - r);
  const std::string which =
      (motion == fem::ElasticMotion::quasi_static ? "" : "_explicit") + power(modulus_ratio);
  expect_below(11, "overlap_on_steel_against_springs" + which, std::abs(overlap * spring / force - 1), 1e-2);
  expect_below(11, "closure_of_column_against_springs" + which,
               std::abs(clamp_closure(problem) * spring / 4 / force - 1), 1e-2);
  const dem::EnergyLedger e = problem.energy();
  expect_below(11, "energy_residual_on_steel_over_work" + which, std::abs(e.residual()) / e.boundary, 1e-2);
}

TEST(unlike_bodies, soft_grains_between_platens_of_steel) {
  press_column(1e6, fem::ElasticMotion::quasi_static);
  press_column(1e8, fem::ElasticMotion::quasi_static);
}

// Steel that made all its steps between two of the grains' would meet their force as blows, some in time with
// its own oscillations.
TEST(unlike_bodies, soft_grains_between_platens_of_steel_that_oscillate) {
  press_column(1e2, fem::ElasticMotion::explicit_steps);
  press_column(1e3, fem::ElasticMotion::explicit_steps);
}

TEST(unlike_bodies, long_soft_grains_between_platens_of_steel_that_oscillate) {
  press_column(1e6, fem::ElasticMotion::explicit_steps);
}

} // namespace
} // namespace platen::unlike_bodies_test
