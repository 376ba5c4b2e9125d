// Cases far from the usual: light beside heavy, deep overlaps, far from the origin, other units.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "tests/dem/examples.h"
#include "tests/measured.h"

namespace platen::dem {
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

// What the bonds of a free block in motion store, J, with the origin moved by `shift` and computed in units
// of which a metre has `length` and a kilogram `mass`: mm-t-s has 1e3 and 1e-3.
double energy_of_block(const Vector3 &shift, double length, double mass) {
  Specimen specimen = packed_box(8, 8, 8);
  for (std::size_t i = 0; i < specimen.size(); ++i) {
    specimen.centre[i] = length * specimen.centre[i] + shift;
    specimen.radius[i] *= length;
  }
  ModelSettings settings = bonded();
  settings.density *= mass / (length * length * length);
  settings.bond_layout.modulus *= mass / length; // per s^2
  Model model(specimen, settings);
  Particles &p = model.particles;
  for (std::size_t i = 0; i < p.size(); ++i) {
    Random random(static_cast<std::uint64_t>(p.id[i]));
    p.velocity[i] = length * .05 * random.direction();
  }
  step(model, 1e-7, 500);
  return model.energy().bonds / (mass * length * length); // J
}

TEST(extremes, units_and_the_place_of_the_origin_do_not_matter) {
  const double here = energy_of_block({}, 1, 1);
  ASSERT_GT(here, 0);
  const double away = 1e3 * 8 * radius; // a thousand times the block
  const auto differs = [&](const Vector3 &shift, double length, double mass) {
    return std::abs(energy_of_block(shift, length, mass) / here - 1);
  };
  expect_below(9, "energy_in_mm_t_s", differs({}, 1e3, 1e-3), 1e-9);
  expect_below(9, "energy_a_thousand_sizes_away", differs({away, -away, away}, 1, 1), 1e-6);
}

} // namespace
} // namespace platen::dem
