// The bond kernel compiled for other instruction sets computes the same, but for the last bits.
#include <gtest/gtest.h>

#include <cmath>

#include "dem/packing/random.h"
#include "tests/dem/examples.h"

namespace platen::dem {
namespace {

using namespace examples;

std::vector<InstructionSet> sets_here() {
  std::vector<InstructionSet> sets;
  const InstructionSet best = best_instruction_set();
  if (best != InstructionSet::baseline) sets.push_back(InstructionSet::avx2);
  if (best == InstructionSet::avx512) sets.push_back(InstructionSet::avx512);
  return sets;
}

void disturb(Particles &p, double strain) {
  Random random(3);
  for (std::size_t i = 0; i < p.size(); ++i) {
    p.position[i] += strain * radius * random.direction();
    if (p.has_rotation()) (*p.orientation)[i] = rotation_quaternion(strain * random.direction());
  }
}

class Kernels : public testing::TestWithParam<bool> {}; // with rotation

TEST_P(Kernels, agree_with_the_baseline) {
  if (sets_here().empty()) GTEST_SKIP() << "this processor has the baseline only";
  ModelSettings settings = breakable();
  settings.rotation = GetParam();
  Model model(packed_box(14, 14, 14), settings);
  disturb(model.particles, .01);
  Bonds &bonds = *model.bonds;
  std::vector<BondBreak> breaks;
  compute_bond_forces(model.particles, bonds, InstructionSet::baseline, breaks);
  const std::vector<Vector3> force(bonds.force.begin(), bonds.force.end());
  const std::vector<Vector3> torque =
      GetParam() ? std::vector<Vector3>(bonds.torque_second->begin(), bonds.torque_second->end())
                 : std::vector<Vector3>();
  ASSERT_GT(breaks.size(), 100u);
  ASSERT_LT(breaks.size(), bonds.size());
  for (const InstructionSet set : sets_here()) {
    std::vector<BondBreak> others;
    compute_bond_forces(model.particles, bonds, set, others);
    ASSERT_EQ(others.size(), breaks.size()) << name(set);
    for (std::size_t k = 0; k < others.size(); ++k) {
      EXPECT_EQ(others[k].row, breaks[k].row);
      EXPECT_EQ(others[k].mode, breaks[k].mode);
    }
    // The strain of .01 takes two of the sixteen digits of the positions.
    for (std::size_t k = 0; k < bonds.size(); ++k) {
      ASSERT_LE(norm(bonds.force[k] - force[k]), 1e-12 * norm(force[k])) << name(set) << " row " << k;
      if (GetParam()) {
        ASSERT_LE(norm((*bonds.torque_second)[k] - torque[k]),
                  1e-12 * (norm(torque[k]) + radius * norm(force[k])));
      }
    }
  }
}

// The kernel takes rows in packs and blocks: the tail of each must not be lost nor read beyond.
TEST_P(Kernels, compute_every_row_of_any_count) {
  for (const int bonds : {1, 2, 3, 7, 8, 9, 1023, 1024, 1025}) {
    ModelSettings settings = bonded();
    settings.rotation = GetParam();
    Model model(row(bonds, {1, 1, 0}), settings);
    disturb(model.particles, 1e-3);
    std::vector<InstructionSet> sets = sets_here();
    sets.push_back(InstructionSet::baseline);
    for (const InstructionSet set : sets) {
      std::vector<BondBreak> breaks;
      for (Vector3 &f : model.bonds->force)
        f = {1e300, 0, 0};
      compute_bond_forces(model.particles, *model.bonds, set, breaks);
      EXPECT_TRUE(breaks.empty());
      for (std::size_t k = 0; k < model.bonds->size(); ++k) {
        const ParallelBond::Response<double> r = model.bonds->response(k, model.particles);
        const Vector3 expected{r.force.x, r.force.y, r.force.z};
        ASSERT_LE(norm(model.bonds->force[k] - expected), 1e-11 * norm(expected))
            << name(set) << " of " << bonds;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(instruction_set, Kernels, testing::Bool());

} // namespace
} // namespace platen::dem
