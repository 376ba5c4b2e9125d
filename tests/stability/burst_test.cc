// Many bonds that fail in one step, in a body that goes on: nothing is released that was not stored, and no
// thread more or less changes a bit of what follows.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

#include "base/parallel.h"
#include "tests/dem/examples.h"
#include "tests/measured.h"

namespace platen::dem {
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

} // namespace
} // namespace platen::dem
