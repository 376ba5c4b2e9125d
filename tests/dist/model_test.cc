// A model that is cut over ranks gives the same bytes as one that is not: a free block that cracks, with
// everything that a step may have. Every rank runs both.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "base/parallel.h"
#include "dist/ranks.h"
#include "tests/dist/cracking_block.h"
#include "tests/same_state.h"

namespace platen::dist {
namespace {

using namespace testing;

// Asked of the parts, without bringing them together.
void expect_the_same_sums(const Model &alone, Model &cut) {
  EXPECT_TRUE(cut.is_cut());
  cut.settle();
  const dem::EnergyLedger one = alone.energy(), many = cut.energy();
  const auto same = [](double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); };
  const std::pair<const char *, double dem::EnergyLedger::*> members[] = {
      {"kinetic", &dem::EnergyLedger::kinetic},   {"bonds", &dem::EnergyLedger::bonds},
      {"contacts", &dem::EnergyLedger::contacts}, {"damping", &dem::EnergyLedger::damping},
      {"friction", &dem::EnergyLedger::friction}, {"fracture", &dem::EnergyLedger::fracture},
      {"plastic", &dem::EnergyLedger::plastic},   {"boundary", &dem::EnergyLedger::boundary}};
  for (const auto &[name, member] : members)
    EXPECT_TRUE(same(one.*member, many.*member)) << name << ": " << one.*member << " and " << many.*member;
  EXPECT_EQ(alone.intact_bonds(), cut.intact_bonds());
  EXPECT_EQ(alone.touching_count(), cut.touching_count());
  EXPECT_EQ(alone.unbalanced(), cut.unbalanced());
  if (alone.bonds) {
    EXPECT_EQ(alone.bond_totals().force, cut.bond_totals().force);
  }
  if (alone.contacts && alone.bonds && !has_history(alone.bonds->law)) {
    EXPECT_GT(one.contacts, 0);
  }
}

void expect_the_same_bytes(const ModelSettings &settings) {
  constexpr int steps = 200;
  const std::unique_ptr<Model> alone = block_of(settings), cut = block_of(settings);
  const double dt = .5 * alone->stable_step({}, 0).limit;
  auto ranks = std::make_unique<Ranks>(MPI_COMM_WORLD);
  const Ranks &over = *ranks;
  cut->share(std::move(ranks));
  for (int part = 0; part < 2; ++part) { // gathered in between
    run(*alone, steps / 2, dt);
    run(*cut, steps / 2, dt);
    expect_the_same_sums(*alone, *cut);
    cut->gather();
    ASSERT_TRUE(same_state(state_of(*alone), state_of(*cut))) << "part " << part;
    if (settings.energy_ledger) {
      EXPECT_EQ(alone->energy().residual(), cut->energy().residual());
      EXPECT_EQ(alone->energy().friction, cut->energy().friction);
    }
    EXPECT_EQ(alone->last_sums().unbalanced.value(), cut->last_sums().unbalanced.value());
  }
  const long broken = alone->broken_tension + alone->broken_shear;
  EXPECT_EQ(broken >= 50, settings.bond.has_value());
  if (settings.bond && std::holds_alternative<dem::ParallelBond::Parameters>(*settings.bond)) {
    EXPECT_GE(broken, 300);
  }
  const std::vector<dem::Crack> cracks = alone->take_cracks(), others = cut->take_cracks();
  ASSERT_EQ(cracks.size(), others.size());
  for (std::size_t k = 0; k < cracks.size(); ++k) {
    EXPECT_EQ(cracks[k].record, others[k].record) << "crack " << k;
    EXPECT_EQ(cracks[k].time, others[k].time) << "crack " << k;
    EXPECT_EQ(cracks[k].energy, others[k].energy) << "crack " << k;
  }
  // Or nothing was put to the test.
  const long messages = cut->exchange()->all(over.traffic().messages),
             rows = cut->exchange()->all(static_cast<long>(over.halo_rows())),
             outer = cut->exchange()->all(static_cast<long>(over.blocks().outer.size()));
  if (over.size() == 1) return;
  EXPECT_GE(messages, 2 * steps);
  EXPECT_GE(rows, 5);
  EXPECT_GE(outer, settings.bond ? 1 : 0);
}

class ModelOnRanks : public ::testing::TestWithParam<dem::examples::SetUp> {};

TEST_P(ModelOnRanks, is_the_same_bytes) {
  expect_the_same_bytes(GetParam().settings);
}
INSTANTIATE_TEST_SUITE_P(models, ModelOnRanks, ::testing::ValuesIn(dem::examples::set_ups()),
                         [](const auto &one) { return one.param.name; });

TEST(model_on_ranks, is_the_same_bytes_on_two_threads_each) {
  const ThreadLimit limit(2);
  expect_the_same_bytes(set_up("all_effects"));
}

} // namespace
} // namespace platen::dist
