// A random cloud of spheres, overlaps up to nine tenths of a radius, in a trap that pulls all to its middle:
// what overlaps from the start stores nothing, so the cloud comes to rest like any other.
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

constexpr double spring_of_trap = 1e4; // 1/s^2, per mass

Specimen overlapping_cloud(std::size_t count, double edge) {
  Random random(11);
  std::vector<Vector3> centres;
  while (centres.size() < count) {
    const Vector3 x{random.uniform(0, edge), random.uniform(0, edge), random.uniform(0, edge)};
    const bool apart = std::all_of(centres.begin(), centres.end(), [&](const Vector3 &c) {
      return norm(c - x) > 1.1 * radius; // of two radii: overlaps of nine tenths of one
    });
    if (apart) centres.push_back(x);
  }
  return spheres(centres);
}

TEST(deep_overlaps, come_to_rest) {
  constexpr double edge = 6 * radius;
  ModelSettings settings = breakable();
  settings.bond.reset();
  settings.bond_layout.modulus = 4e7; // soft, so that a collision is not much shorter than an oscillation
  settings.contact->damping = .3;
  settings.local_damping = .5;
  settings.rotation = false; // nothing stops a sphere that spins on one contact
  Model model(overlapping_cloud(60, edge), settings);
  Particles &p = model.particles;
  Random random(5);
  for (Vector3 &v : p.velocity)
    v = .5 * random.direction();
  model.contacts->search(p, nullptr, 0);
  ASSERT_GT(model.contacts->table.size(), 80u);
  const double dt = .5 * model.stable_step({}, .3).limit;
  const Vector3 middle = Vector3{.5, .5, .5} * edge;
  const auto energy = [&] {
    double sum = kinetic_energy(p) + model.contacts->energy();
    for (std::size_t i = 0; i < p.size(); ++i)
      sum += .5 * p.mass[i] * spring_of_trap * norm_squared(p.position[i] - middle);
    return sum;
  };
  const double moving = kinetic_energy(p), start = energy();
  double most = 0;
  for (int s = 0; s < 110000; ++s) {
    step(model, dt, [&](Particles &q) {
      for (std::size_t i = 0; i < q.size(); ++i)
        q.force[i] -= q.mass[i] * spring_of_trap * (q.position[i] - middle);
    });
    if (s % 50 != 0) continue;
    most = std::max(most, energy());
    ASSERT_TRUE(std::isfinite(most)) << s;
  }
  expect_below(13, "most_energy_in_a_trap_over_that_of_the_start", most / start, 1.001);
  expect_below(13, "kinetic_energy_left_in_a_trap", kinetic_energy(p) / moving, 1e-6);
}

} // namespace
} // namespace platen::dem
