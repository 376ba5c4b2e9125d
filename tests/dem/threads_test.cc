// Results do not depend on the number of threads, to the last bit.
#include <gtest/gtest.h>

#include <unistd.h>

#include <cstring>
#include <fstream>
#include <vector>

#include "base/parallel.h"
#include "base/random.h"
#include "tests/dem/examples.h"

namespace platen::dem {
namespace {

using namespace examples;

struct Outcome {
  std::vector<unsigned char> state; // every column, byte by byte
  EnergyLedger energy;
  long broken = 0;
  std::size_t touching = 0;
  double limit = 0;
};

void append(std::vector<unsigned char> &state, const Table &table) {
  for (const auto &column : table.columns()) {
    const auto *bytes = static_cast<const unsigned char *>(column->bytes());
    state.insert(state.end(), bytes, bytes + column->size() * column->bytes_per_row());
  }
}

// A free block of some thousand spheres that cracks, with friction and dashpots.
Outcome cracking_block(int threads, double dissipation, bool scattered) {
  const ThreadLimit limit(threads);
  ModelSettings settings = breakable();
  settings.contact->damping = .2;
  settings.local_damping = .1;
  settings.bond_dashpot = .05;
  settings.scheme = Scheme::tchamwa_wielgosz;
  settings.dissipation = dissipation;
  if (scattered) settings.strength_scatter = StrengthScatter{4, 2};
  Model model(packed_box(30, 30, 30), settings);
  Particles &p = model.particles;
  Random random(9);
  for (std::size_t i = 0; i < p.size(); ++i) {
    p.velocity[i] = .1 * (p.position[i] / radius) + 2 * random.direction();
    (*p.angular_velocity)[i] = (.1 / radius) * random.direction();
  }
  Outcome o;
  o.limit = model.stable_step({}, 0).limit;
  step(model, .5 * o.limit, 250);
  append(o.state, p.table);
  append(o.state, model.bonds->table);
  append(o.state, model.bonds->records);
  append(o.state, model.contacts->table);
  o.energy = model.energy();
  o.broken = model.broken_tension + model.broken_shear;
  o.touching = model.contacts->touching_count();
  EXPECT_GT(p.size(), 2500u);
  return o;
}

void expect_the_same_bits_on_more_threads(double dissipation, bool scattered = false) {
  const Outcome one = cracking_block(1, dissipation, scattered);
  EXPECT_GT(one.broken, 500);
  EXPECT_GT(one.touching, 50u);
  for (const int threads : {2, 4, 8, 1}) {
    const Outcome other = cracking_block(threads, dissipation, scattered);
    ASSERT_EQ(other.state.size(), one.state.size()) << threads;
    EXPECT_EQ(std::memcmp(other.state.data(), one.state.data(), one.state.size()), 0) << threads;
    EXPECT_EQ(std::memcmp(&other.energy, &one.energy, sizeof one.energy), 0) << threads;
    EXPECT_EQ(other.limit, one.limit) << threads;
  }
}

TEST(threads, one_to_eight_give_the_same_bits) {
  expect_the_same_bits_on_more_threads(1);
}

TEST(threads, a_dissipative_scheme_repeats_too) {
  expect_the_same_bits_on_more_threads(1.2);
}

TEST(threads, scattered_strengths_repeat_too) {
  expect_the_same_bits_on_more_threads(1, true);
}

double resident_megabytes() {
  std::ifstream statm("/proc/self/statm");
  double total = 0, resident = 0;
  statm >> total >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE)) * 1e-6;
}

// Runs are millions of loops long: nothing may be left behind by one, whatever the number of threads.
TEST(threads, loops_leave_no_memory_behind) {
  std::vector<double> rows(8 * block_rows);
  const auto loops = [&](int count) {
    for (int k = 0; k < count; ++k)
      for_each(rows.size(), [&](std::size_t i) { rows[i] += 1; });
  };
  for (const int threads : {1, 2, 3, 4}) {
    const ThreadLimit limit(threads);
    loops(1000);
    const double before = resident_megabytes();
    ASSERT_GT(before, 0);
    loops(50000);
    EXPECT_LT(resident_megabytes() - before, 2) << threads; // a forgotten task each would be 6 MB and more
  }
}

} // namespace
} // namespace platen::dem
