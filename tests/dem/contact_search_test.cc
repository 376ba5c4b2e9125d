// The lists that last several steps miss no contact.
#include "dem/contact_search.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "base/random.h"
#include "tests/dem/examples.h"

namespace platen::dem {
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
  std::vector<Vector3> centres;
  for (int x = 0; x < 7; ++x)
    for (int y = 0; y < 7; ++y)
      for (int z = 0; z < 7; ++z)
        centres.push_back(2.05 * radius * Vector3{1.0 * x, 1.0 * y, 1.0 * z});
  ModelSettings settings = breakable();
  settings.bond.reset();
  Model model(spheres(centres), settings);
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

// An intact packing has next to no pairs to check: what makes steps cheap.
TEST(contact_search, an_intact_packing_lists_almost_no_pairs) {
  Model model(packed_box(20, 20, 20), breakable());
  step(model, 1e-8);
  EXPECT_LT(model.contacts->table.size(), model.bonds->size() / 4);
}

} // namespace
} // namespace platen::dem
