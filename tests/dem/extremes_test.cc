// Cases far from the usual: light beside heavy, deep overlaps.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "tests/dem/examples.h"
#include "tests/measured.h"

namespace platen::dem::extremes_test {
namespace {

using namespace examples;
using measured::expect_below;

// A light sphere bonded between two heavy ones, masses 1e6 apart by their radii, and pulled: the bonds are
// springs in series, the balance closes.
TEST(extremes, a_mass_ratio_of_a_million_leaves_springs_in_series) {
  const double large = 100 * radius;
  Specimen specimen = spheres({{-(large + radius), 0, 0}, {0, 0, 0}, {large + radius, 0, 0}});
  specimen.radius = {large, radius, large};
  ModelSettings settings = bonded();
  settings.local_damping = .3;
  Model model(specimen, settings);
  Particles &p = model.particles;
  const std::size_t left = row_of(p, 0), right = row_of(p, 2);
  ASSERT_NEAR(p.mass[left] / p.mass[row_of(p, 1)], 1e6, 1);
  const double stiffness = .5 * settings.bond_layout.axial_stiffness(large, radius), pull = 10; // N/m, N
  const double dt = .8 * model.stable_step({}, 0).limit;
  double stretch = 0, work = 0, before = 0;
  const int steps = 400000;
  for (int s = 0; s < steps; ++s) {
    const double load = pull * std::min(1.0, 4.0 * s / steps);
    step(model, dt, [&](Particles &q) { q.force[left].x -= load, q.force[right].x += load; });
    stretch = p.position[right].x - p.position[left].x - 2 * (large + radius);
    work += load * (stretch - before), before = stretch;
  }
  ASSERT_TRUE(std::isfinite(stretch));
  const EnergyLedger e = model.energy();
  expect_below(11, "stretch_against_springs_in_series", std::abs(stretch * stiffness / pull - 1), 1e-2);
  expect_below(11, "energy_residual_over_work", std::abs(e.stored() + e.lost() - work) / work, 1e-2);
}

// Random spheres, overlaps up to nine tenths of a radius, thrown about: what overlaps from the start is no
// store of energy, so that none ever moves with more than all were given, and dashpots bring them to rest.
TEST(extremes, deep_overlaps_at_the_start_hold_no_energy) {
  Random random(11);
  std::vector<Vector3> centres;
  while (centres.size() < 150) {
    const Vector3 x{random.uniform(0, 8 * radius), random.uniform(0, 8 * radius),
                    random.uniform(0, 8 * radius)};
    const bool apart = std::all_of(centres.begin(), centres.end(), [&](const Vector3 &c) {
      return norm(c - x) > 1.1 * radius; // of two radii: overlaps of nine tenths of one
    });
    if (apart) centres.push_back(x);
  }
  ModelSettings settings = breakable();
  settings.bond.reset();
  settings.contact->damping = .3;
  Model model(spheres(centres), settings);
  for (Vector3 &v : model.particles.velocity)
    v = .5 * random.direction();
  const double start = kinetic_energy(model.particles);
  double most = 0;
  std::size_t touching = 0;
  for (int s = 0; s < 2000; ++s) {
    step(model, 5e-8);
    most = std::max(most, kinetic_energy(model.particles) + model.contacts->energy());
    touching = std::max(touching, model.contacts->touching_count());
  }
  EXPECT_GT(touching, 50u);
  expect_below(13, "most_energy_over_that_of_the_start", most / start, 1.001);
  expect_below(13, "kinetic_energy_left", kinetic_energy(model.particles) / start, 1);
}

} // namespace
} // namespace platen::dem::extremes_test
