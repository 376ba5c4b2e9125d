// Many bonds that fail in one step, in a body that goes on: nothing is released that was not stored, and no
// thread more or less changes a bit of what follows.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

#include "base/parallel.h"
#include "base/random.h"
#include "tests/dem/examples.h"
#include "tests/measured.h"

namespace platen::dem::burst_test {
namespace {

using namespace examples;
using measured::expect_below;

struct Burst {
  double share = 0;          // of all bonds, broken in the first step
  double released = 0;       // over what was stored and is stored no more, less one
  double fastest = 0;        // energy of a particle over all that was stored, at any time
  std::vector<Vector3> left; // places and velocities some hundred steps later
};

// One half of a block is stretched until hardly any bond of it holds.
Burst burst(int threads) {
  const ThreadLimit limit(threads);
  constexpr double edge = 18, beyond = 1.005;
  ModelSettings settings = breakable();
  Model model(packed_box(edge, edge, edge), settings);
  Particles &p = model.particles;
  const double stretch = beyond * tensile_strength / (normal_stiffness * 2 * radius);
  const Vector3 middle{0, 0, .5 * edge * radius};
  for (Vector3 &x : p.position)
    if (x.z > middle.z) x += stretch * (x - middle);
  const double stored = bond_energy(p, *model.bonds), bonds = static_cast<double>(model.intact_bonds());
  const double dt = .2 * model.stable_step({}, 0).limit;
  Burst b;
  model.compute_forces(dt);
  const double still = bond_energy(p, *model.bonds) + model.contacts->energy();
  b.share = static_cast<double>(model.breaks) / bonds;
  b.released = std::abs(model.works.fracture / (stored - still) - 1);
  model.end_step(dt);
  for (int s = 0; s < 400; ++s) {
    step(model, dt);
    for (std::size_t i = 0; i < p.size(); ++i)
      b.fastest = std::max(b.fastest, .5 * p.mass[i] * norm_squared(p.velocity[i]) / stored);
  }
  b.left.assign(p.position.begin(), p.position.end());
  b.left.insert(b.left.end(), p.velocity.begin(), p.velocity.end());
  return b;
}

TEST(burst, releases_what_was_stored_and_is_the_same_on_any_threads) {
  const Burst one = burst(1);
  EXPECT_GT(one.share, .1);
  EXPECT_LT(one.share, .9);
  measured::note_figure(15, "share_of_bonds_broken_in_one_step", one.share, "> 0.1");
  expect_below(15, "released_by_a_burst_over_stored_less_one", one.released, 1e-10);
  expect_below(15, "energy_of_fastest_particle_over_stored", one.fastest, 1);
  for (const int threads : {2, 4}) {
    const Burst other = burst(threads);
    ASSERT_EQ(other.left.size(), one.left.size());
    EXPECT_EQ(std::memcmp(other.left.data(), one.left.data(), one.left.size() * sizeof(Vector3)), 0)
        << threads;
  }
}

// A random cloud of spheres, overlaps up to nine tenths of a radius, in a trap that pulls all to its middle:
// what overlaps from the start stores nothing, so the cloud comes to rest like any other.
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
} // namespace platen::dem::burst_test
