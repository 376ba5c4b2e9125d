// The bond kernel compiled for other instruction sets computes the same, but for the last bits.
#include <gtest/gtest.h>

#include <cmath>
#include <ostream>

#include "base/random.h"
#include "tests/dem/examples.h"

namespace platen::dem {
namespace {

using namespace examples;

void disturb(Particles &p, double strain) {
  Random random(3);
  for (std::size_t i = 0; i < p.size(); ++i) {
    p.position[i] += strain * radius * random.direction();
    if (p.has_rotation()) (*p.orientation)[i] = rotation_quaternion(strain * random.direction());
  }
}

struct Turning {
  const char *name;
  bool rotation, moments;
};
void PrintTo(const Turning &turning, std::ostream *to) {
  *to << turning.name;
}

class Kernels : public testing::TestWithParam<Turning> {
protected:
  static ModelSettings with(ModelSettings settings) {
    settings.rotation = GetParam().rotation;
    parallel_bond(settings).moments = GetParam().moments;
    return settings;
  }
};

TEST_P(Kernels, agree_with_the_baseline) {
  Model model(packed_box(14, 14, 14), with(breakable()));
  disturb(model.particles, .01);
  Bonds &bonds = *model.bonds;
  Particles &particles = model.particles;
  std::vector<BondBreak> breaks;
  const Loads expected = kernel_loads(particles, bonds, InstructionSet::baseline, breaks);
  ASSERT_GT(breaks.size(), 100u);
  ASSERT_LT(breaks.size(), bonds.size());
  // The strain of .01 takes two of the sixteen digits of the positions; a particle adds up a dozen bonds.
  const double force = bond_totals(particles, bonds).force / static_cast<double>(bonds.size());
  for (const InstructionSet set : instruction_sets_here()) {
    std::vector<BondBreak> others;
    const Loads loads = kernel_loads(particles, bonds, set, others);
    ASSERT_EQ(others.size(), breaks.size()) << name(set);
    for (std::size_t k = 0; k < others.size(); ++k) {
      EXPECT_EQ(others[k].row, breaks[k].row);
      EXPECT_EQ(others[k].mode, breaks[k].mode);
    }
    for (std::size_t i = 0; i < particles.size(); ++i) {
      ASSERT_LE(norm(loads.force[i] - expected.force[i]), 1e-11 * force) << name(set) << " row " << i;
      ASSERT_LE(norm(loads.torque[i] - expected.torque[i]), 1e-11 * radius * force);
    }
  }
}

// The kernel takes rows in packs and particles in blocks: the tail of each must not be lost nor read beyond,
// and what leaves a block must arrive.
TEST_P(Kernels, compute_every_row_of_any_count) {
  for (const int bonds : {1, 2, 3, 7, 8, 9, 1022, 1023, 1024, 1025, 2047, 2050}) {
    Model model(row(bonds, {1, 1, 0}), with(bonded()));
    disturb(model.particles, 1e-3);
    const Loads expected = bond_loads(model.particles, *model.bonds);
    for (const InstructionSet set : instruction_sets_here()) {
      std::vector<BondBreak> breaks;
      for (Vector3 &f : model.particles.force)
        f = {1e300, 0, 0};
      const Loads loads = kernel_loads(model.particles, *model.bonds, set, breaks);
      EXPECT_TRUE(breaks.empty());
      for (std::size_t i = 0; i < model.particles.size(); ++i) {
        ASSERT_LE(norm(loads.force[i] - expected.force[i]), 1e-10 * norm(expected.force[i]))
            << name(set) << " of " << bonds;
        ASSERT_LE(norm(loads.torque[i] - expected.torque[i]), 1e-10 * radius * norm(expected.force[i]));
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(instruction_set, Kernels,
                         testing::Values(Turning{"without_rotation", false, false},
                                         Turning{"without_moments", true, false},
                                         Turning{"with_moments", true, true}));

} // namespace
} // namespace platen::dem
