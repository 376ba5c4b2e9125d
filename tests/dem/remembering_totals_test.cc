// Sums over bonds that remember, as the ledger takes them: the kernels against the law, row by row.
#include <gtest/gtest.h>

#include <cmath>
#include <tuple>

#include "base/parallel.h"
#include "tests/dem/examples.h"

namespace platen::dem {
namespace {

using namespace examples;

ModelSettings yielding() {
  ModelSettings s = breakable();
  YieldingParallelBond::Parameters law;
  law.stiffness_ratio = 0.25;
  law.tensile_strength = 9e6, law.shear_strength = 9e6; // so that some slide apart
  law.friction_angle = std::atan(0.5);
  law.moment_contribution = 0.22;
  law.compression_limits = {60e6, 110e6, 160e6}, law.compression_slopes = {3, 12, 22};
  s.bond = law;
  return s;
}

// Row by row, from what each remembers.
BondTotals by_rows(const Particles &p, const Bonds &b) {
  BondTotals sum;
  for (std::size_t k = 0; k < b.size(); ++k) {
    const BondResponse<double> r = b.response(k, p);
    sum.energy += r.energy;
    sum.force += root(dot(r.force, r.force));
    of_remembering(b.law, [&](const auto &law) {
      const auto s = b.memory<typename std::decay_t<decltype(law)>::template State<double>>(k);
      InterfaceGeometry<double> g{b.rest_length[k], b.lever[k], b.normal_stiffness[k],
                                  pi * b.bond_radius[k] * b.bond_radius[k]};
      (law.damage_of(s) >= 1 ? sum.friction : sum.damage) += s.dissipated;
      sum.plastic += law.plastic_work(s, g);
    });
  }
  return sum;
}

// With interfaces; with rotation; with strengths of their own.
class RememberingTotals : public testing::TestWithParam<std::tuple<bool, bool, bool>> {};

TEST_P(RememberingTotals, are_those_of_the_law_row_by_row_on_every_instruction_set_and_any_threads) {
  const auto [of_interfaces, rotation, factors] = GetParam();
  ModelSettings settings = of_interfaces ? interfaces() : yielding();
  settings.rotation = rotation;
  if (factors) settings.strength_scatter = StrengthScatter{3, 1};
  Model model(packed_box(15, 15, 15), settings);
  const Particles &p = model.particles;
  const Bonds &b = *model.bonds;
  ASSERT_NE(b.size() % 8, 0u); // a last pack that is not full
  shake(model.particles, 2.0, 900);
  const double dt = .3 * model.stable_step({}, 0).limit;
  for (int s = 0; s < 60; ++s)
    step(model, dt);
  ASSERT_GT(b.failed_rows, 20u);
  const BondTotals rows = by_rows(p, b);
  EXPECT_GT(rows.friction, 0);
  EXPECT_GT(rows.plastic, 0);
  std::vector<InstructionSet> sets{InstructionSet::baseline};
  if (best_instruction_set() != InstructionSet::baseline) sets.push_back(InstructionSet::avx2);
  if (best_instruction_set() == InstructionSet::avx512) sets.push_back(InstructionSet::avx512);
  for (const InstructionSet set : sets) {
    const BondTotals totals = bond_totals(p, b, set);
    EXPECT_NEAR(totals.energy, rows.energy, 1e-12 * rows.energy) << name(set);
    EXPECT_NEAR(totals.force, rows.force, 1e-12 * rows.force) << name(set);
    EXPECT_NEAR(totals.damage, rows.damage, 1e-12 * rows.damage) << name(set);
    EXPECT_NEAR(totals.friction, rows.friction, 1e-12 * rows.friction) << name(set);
    EXPECT_NEAR(totals.plastic, rows.plastic, 1e-12 * rows.plastic) << name(set);
    for (const int threads : {1, 2, 4}) {
      const ThreadLimit limit(threads);
      const BondTotals same = bond_totals(p, b, set);
      EXPECT_EQ(same.energy, totals.energy) << threads;
      EXPECT_EQ(same.force, totals.force) << threads;
      EXPECT_EQ(same.friction, totals.friction) << threads;
      EXPECT_EQ(same.plastic, totals.plastic) << threads;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(laws, RememberingTotals,
                         testing::Combine(testing::Bool(), testing::Bool(), testing::Bool()));

} // namespace
} // namespace platen::dem
