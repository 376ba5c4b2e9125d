// The lists that last several steps miss no contact.
#include "dem/contact_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "base/random.h"
#include "base/state.h"
#include "tests/dem/examples.h"
#include "tests/same_state.h"

namespace platen::dem::contact_search_test {
namespace {

using namespace examples;

std::set<std::pair<int, int>> touching_by_all_pairs(const Particles &p) {
  std::set<std::pair<int, int>> pairs;
  for (std::size_t i = 0; i < p.size(); ++i)
    for (std::size_t j = i + 1; j < p.size(); ++j)
      if (norm(p.position[j] - p.position[i]) < p.radius[i] + p.radius[j])
        pairs.insert({static_cast<int>(i), static_cast<int>(j)});
  return pairs;
}

// A gas of unbonded spheres of all speeds, from slow to several radii in the run.
TEST(contact_search, a_gas_misses_no_collision) {
  Random random(1);
  ModelSettings settings = breakable();
  settings.bond.reset();
  Model model(cubic(7, 7, 7, 2.05), settings);
  Particles &p = model.particles;
  for (std::size_t i = 0; i < p.size(); ++i)
    p.velocity[i] = std::pow(10, random.uniform(-.5, 1.5)) * random.direction();
  std::size_t seen = 0;
  for (int s = 0; s < 2000; ++s) {
    step(model, 5e-7);
    if (s % 10 != 0) continue;
    std::set<std::pair<int, int>> found;
    for (std::size_t k = 0; k < model.contacts->table.size(); ++k)
      if (model.contacts->touching[k]) found.insert({model.contacts->first[k], model.contacts->second[k]});
    const auto expected = touching_by_all_pairs(p);
    seen += expected.size();
    ASSERT_EQ(found, expected) << "step " << s;
  }
  EXPECT_GT(seen, 150u);
}

TEST(contact_search, bonded_pairs_do_not_touch_until_their_bond_breaks) {
  Model model(row(1, {1, 0, 0}), breakable());
  Particles &p = model.particles;
  p.velocity[1].x = -1;
  step(model, 1e-8, 5);
  EXPECT_EQ(model.contacts->touching_count(), 0u);
  p.position[1] += {-.05 * radius, .1 * radius, 0}; // far beyond the shear strength
  step(model, 1e-8);
  EXPECT_EQ(model.intact_bonds(), 0u);
  step(model, 1e-8);
  EXPECT_EQ(model.contacts->touching_count(), 1u);
}

// Rows that broken bonds leave wait behind the others. Where they come to their places, as for a state,
// nothing that follows changes, whatever blocks they are of.
TEST(contact_search, rows_of_broken_bonds_are_the_same_wherever_they_stand) {
  Model waiting(packed_box(24, 24, 24), breakable()), sorted(packed_box(24, 24, 24), breakable());
  const std::size_t spheres = waiting.particles.size();
  ASSERT_GT(spheres, 3 * block_rows);
  Random random(2);
  for (Model *model : {&waiting, &sorted})
    step(*model, 1e-8, 2);
  for (int round = 0; round < 60; ++round) {
    std::vector<BondBreak> breaks;
    for (int k = 0; k < 3; ++k) {
      const int row = static_cast<int>(random.uniform(0, static_cast<double>(waiting.bonds->size())));
      const bool again =
          std::any_of(breaks.begin(), breaks.end(), [&](const BondBreak &b) { return b.row == row; });
      if (!again && waiting.bonds->normal_stiffness[row] != 0)
        breaks.push_back({row, k == 0 ? BondState::broken_in_shear : BondState::broken_in_tension});
    }
    for (Model *model : {&waiting, &sorted}) {
      Particles &p = model->particles;
      for (std::size_t i = 0; i < spheres; ++i) // towards the middle
        p.position[i] *= 1 - 1e-5;
      std::fill(p.force.begin(), p.force.end(), Vector3{});
      std::vector<BrokenBond> broken = model->bonds->break_rows(breaks, p, 0);
      model->contacts->take_over(p, *model->bonds, broken, 1e-8);
      if (model == &sorted && round % 3 != 2) (void)state_of(*model->contacts);
      model->contacts->compute(p, 1e-8);
      for (std::size_t block = 0; block < number_of_blocks(spheres); ++block)
        return_ghosts(p, model->contacts->blocks(), block);
    }
    for (std::size_t i = 0; i < spheres; ++i)
      ASSERT_EQ(norm_squared(waiting.particles.force[i] - sorted.particles.force[i]), 0) << round << " " << i;
    ASSERT_EQ(waiting.contacts->energy(), sorted.contacts->energy());
    ASSERT_EQ(waiting.contacts->touching_count(), sorted.contacts->touching_count());
  }
  EXPECT_GT(waiting.contacts->touching_count(), 100u);
  EXPECT_TRUE(same_state(*waiting.contacts, *sorted.contacts));
}

// The block of a bond that breaks is computed again without it, whichever it is.
TEST(contact_search, a_bond_that_breaks_leaves_no_force_in_any_block) {
  ModelSettings settings = breakable();
  settings.contact.reset();
  Model model(packed_box(24, 24, 24), settings);
  Particles &p = model.particles;
  const std::size_t last = p.size() - 1;
  ASSERT_GT(last / block_rows, 2u);
  p.position[last] += Vector3{2 * radius, 2 * radius, 2 * radius}; // all its bonds are beyond their strength
  step(model, 1e-9);
  EXPECT_GT(model.broken(BondState::broken_in_tension) + model.broken(BondState::broken_in_shear), 2u);
  EXPECT_LT(norm(p.force[last]), 1e-9);
}

// An intact packing has next to no pairs to check: what makes steps cheap.
TEST(contact_search, an_intact_packing_lists_almost_no_pairs) {
  Model model(packed_box(20, 20, 20), breakable());
  step(model, 1e-8);
  EXPECT_LT(model.contacts->table.size(), model.bonds->size() / 4);
}

} // namespace
} // namespace platen::dem::contact_search_test
