// Aggregates in a matrix: who is what, springs in series, and where cracks begin.
#include "dem/heterogeneity.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>
#include <utility>
#include <vector>

#include "dem/measure/bond_network.h"
#include "tests/dem/examples.h"

namespace platen::dem {
namespace {

using namespace examples;

// Four spheres in a row: two of the aggregate, two of the matrix.
ModelSettings two_phases() {
  ModelSettings settings = breakable();
  Phases phases;
  phases.aggregate_ids = {1, 0};
  phases.aggregate = {3, 2};
  phases.interface = {.5, .25};
  settings.phases = phases;
  return settings;
}

std::size_t bond_between(const Model &model, int a, int b) {
  const Bonds &bonds = *model.bonds;
  for (std::size_t k = 0; k < bonds.size(); ++k) {
    const int i = model.particles.id[static_cast<std::size_t>(bonds.first[k])],
              j = model.particles.id[static_cast<std::size_t>(bonds.second[k])];
    if (std::pair(std::min(i, j), std::max(i, j)) == std::pair(a, b)) return k;
  }
  throw std::out_of_range("no such bond");
}

TEST(phases, are_told_by_radius_or_by_list) {
  Specimen s = row(3, {1, 0, 0});
  s.radius[2] *= 1.2, s.radius[3] *= .9;
  ModelSettings settings = bonded();
  settings.bond_layout.gap.value = .3;
  settings.phases = Phases{};
  settings.phases->radius_above = 1.1 * radius;
  const Model by_radius(s, settings);
  settings.phases->radius_above = radius; // those of just this radius are of the matrix
  const Model at_the_radius(s, settings);
  settings.phases = Phases{};
  settings.phases->aggregate_ids = {3, 0};
  const Model by_list(s, settings);
  for (int id = 0; id < 4; ++id) {
    const auto phase = [&](const Model &m) { return (*m.particles.phase)[row_of(m.particles, id)]; };
    EXPECT_EQ(phase(by_radius), id == 2) << id;
    EXPECT_EQ(phase(at_the_radius), id == 2) << id;
    EXPECT_EQ(phase(by_list), id == 3 || id == 0) << id;
  }
  EXPECT_EQ(Model(s, bonded()).particles.phase, nullptr);
  EXPECT_EQ(by_list.bonds->strength_factor, nullptr); // all factors are 1
}

TEST(phases, know_every_particle_that_a_list_names) {
  ModelSettings settings = bonded();
  for (const int id : {-1, 4}) {
    settings.phases = Phases{};
    settings.phases->aggregate_ids = {0, id};
    EXPECT_THROW(Model(row(3, {1, 0, 0}), settings), std::invalid_argument) << id;
  }
}

TEST(phases, give_each_kind_of_bond_its_factors) {
  const Model model(row(3, {1, 0, 0}), two_phases());
  const Bonds &b = *model.bonds;
  const struct {
    int i, j;
    double modulus, strength;
  } wanted[] = {{0, 1, 3, 2}, {1, 2, .5, .25}, {2, 3, 1, 1}};
  for (const auto &w : wanted) {
    const std::size_t k = bond_between(model, w.i, w.j);
    EXPECT_DOUBLE_EQ(b.normal_stiffness[k], w.modulus * normal_stiffness);
    EXPECT_DOUBLE_EQ((*b.strength_factor)[k], w.strength);
  }
}

// Pulled to one force, the three springs stretch by F/K each: inner spheres are at rest there, and the row is
// as stiff as 1 / (1/K_1 + 1/K_2 + 1/K_3).
TEST(phases, in_series_share_the_force_and_not_the_stretch) {
  Model model(row(3, {1, 0, 0}), two_phases());
  Particles &p = model.particles;
  const double K = normal_stiffness * area, force = .1 * tensile_strength * area;
  const double stretch[] = {force / (3 * K), force / (.5 * K), force / K};
  double moved = 0;
  for (int id = 1; id < 4; ++id) {
    moved += stretch[id - 1];
    p.position[row_of(p, id)].x += moved;
  }
  std::vector<BondBreak> breaks;
  const Loads loads = kernel_loads(p, *model.bonds, best_instruction_set(), breaks);
  EXPECT_TRUE(breaks.empty());
  EXPECT_NEAR(loads.force[row_of(p, 0)].x, force, 1e-9 * force);
  EXPECT_NEAR(loads.force[row_of(p, 3)].x, -force, 1e-9 * force);
  for (const int id : {1, 2})
    EXPECT_NEAR(loads.force[row_of(p, id)].x, 0, 1e-9 * force);
  EXPECT_NEAR(force / moved, K / (1 / 3.0 + 1 / .5 + 1), 1e-12 * K);
}

// A force of a quarter of the matrix' strength: the interface alone is at its strength.
TEST(phases, break_first_at_a_weak_interface) {
  for (const double share : {.25 - 1e-6, .25 + 1e-6}) {
    Model model(row(3, {1, 0, 0}), two_phases());
    Particles &p = model.particles;
    const double strain = share * tensile_strength / modulus;
    const double stretch[] = {strain / 3, strain / .5, strain};
    double moved = 0;
    for (int id = 1; id < 4; ++id) {
      moved += 2 * radius * stretch[id - 1];
      p.position[row_of(p, id)].x += moved;
    }
    std::vector<BondBreak> breaks;
    kernel_loads(p, *model.bonds, best_instruction_set(), breaks);
    ASSERT_EQ(breaks.size(), share > .25 ? 1u : 0u);
    for (const BondBreak &b : breaks)
      EXPECT_EQ(b.row, static_cast<int>(bond_between(model, 1, 2)));
  }
}

// A block torn apart with large spheres in it: the first cracks are all around them.
TEST(phases, of_a_block_crack_at_the_interface) {
  Specimen specimen = packed_box(14, 14, 14);
  ModelSettings settings = breakable();
  Phases phases;
  for (int id = 0; id < static_cast<int>(specimen.size()); id += 4)
    phases.aggregate_ids.push_back(id);
  phases.aggregate = {2, 3};
  phases.interface = {1, .3};
  settings.phases = phases;
  Model model(specimen, settings);
  Particles &p = model.particles;
  for (std::size_t i = 0; i < p.size(); ++i)
    p.velocity[i] = .05 * p.position[i] / radius;
  const double dt = .8 * model.stable_step({}, 0).limit;
  for (int s = 0; s < 5000 && model.cracks.size() < 20; ++s)
    step(model, dt);
  ASSERT_GE(model.cracks.size(), 20u);
  for (const Crack &c : model.cracks)
    EXPECT_EQ(aggregates_of_pair(p, static_cast<int>(row_of(p, c.particle_a)),
                                 static_cast<int>(row_of(p, c.particle_b))),
              1);
}

// All of one phase: the specimen is as if its bonds had that modulus and those strengths.
TEST(phases, of_one_kind_alone_are_one_material) {
  Specimen specimen = packed_box(8, 8, 8);
  ModelSettings one = breakable(), other = breakable();
  one.phases = Phases{};
  one.phases->radius_above = 1e-9; // all of them
  one.phases->aggregate = {2, 4};
  other.bond_layout.modulus *= 2;
  parallel_bond(other).tensile_strength *= 4, parallel_bond(other).shear_strength *= 4;
  Model a(specimen, one), b(specimen, other);
  EXPECT_EQ(a.stable_step({}, 0).limit, b.stable_step({}, 0).limit);
  EXPECT_DOUBLE_EQ(network_moduli(*a.bonds, 1).young_voigt, network_moduli(*b.bonds, 1).young_voigt);
  for (Model *m : {&a, &b})
    for (std::size_t i = 0; i < m->particles.size(); ++i)
      m->particles.velocity[i] = 2 * m->particles.position[i] / radius;
  const double dt = .5 * b.stable_step({}, 0).limit;
  for (int s = 0; s < 300; ++s)
    step(a, dt), step(b, dt);
  EXPECT_GT(b.broken_tension, 20);
  EXPECT_EQ(a.broken_tension, b.broken_tension);
  EXPECT_EQ(a.broken_shear, b.broken_shear);
  double most = 0, apart = 0;
  for (std::size_t i = 0; i < a.particles.size(); ++i) {
    most = std::max(most, norm(a.particles.position[i] - a.particles.reference_position[i]));
    apart = std::max(apart, norm(a.particles.position[i] - b.particles.position[i]));
  }
  EXPECT_LT(apart, 1e-9 * most); // powers of two: products round alike
}

// A broken pair touches with the stiffness of the bond that it had.
TEST(phases, have_contacts_as_stiff_as_their_bonds) {
  Model model(row(3, {1, 0, 0}), two_phases());
  Particles &p = model.particles;
  const double K = normal_stiffness * area;
  const auto bound = [&](int a, int b) {
    return model.contacts
        ->stiffness_bound(p, static_cast<int>(row_of(p, a)), static_cast<int>(row_of(p, b)), 0)
        .normal;
  };
  EXPECT_DOUBLE_EQ(bound(0, 1), 3 * K);
  EXPECT_DOUBLE_EQ(bound(1, 2), .5 * K);
  EXPECT_DOUBLE_EQ(bound(2, 3), K);
  const std::size_t k = bond_between(model, 0, 1);
  const BrokenBond broken =
      model.bonds->break_rows({{static_cast<int>(k), BondState::broken_in_tension}}, p, 0).front();
  std::vector<BrokenBond> all{broken};
  model.contacts->take_over(p, *model.bonds, all, 1e-9);
  ASSERT_EQ(model.contacts->table.size(), 1u);
  EXPECT_DOUBLE_EQ(model.contacts->coefficient[0], 3 * K);
}

} // namespace
} // namespace platen::dem
