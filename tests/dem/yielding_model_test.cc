// Specimens of yielding parallel bonds: the kernels against the law, energy, momentum, threads.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/parallel.h"
#include "base/random.h"
#include "base/state.h"
#include "tests/dem/examples.h"

namespace platen::dem {
namespace {

using namespace examples;
using State = YieldingParallelBond::State<double>;

Triple<double> triple(const Vector3 &a) {
  return {a.x, a.y, a.z};
}
Rotation<double> rotation(const Quaternion &q) {
  return {q.w, q.x, q.y, q.z};
}

ModelSettings yielding() {
  ModelSettings s = bonded();
  YieldingParallelBond::Parameters law;
  law.stiffness_ratio = 0.25;
  law.tensile_strength = 9e6, law.shear_strength = 9e6; // so that some slide apart
  law.friction_angle = std::atan(0.5);
  law.moment_contribution = 0.22;
  law.compression_limits = {60e6, 110e6, 160e6}, law.compression_slopes = {3, 12, 22};
  s.bond = law;
  s.bond_layout.modulus = 48e9;
  s.contact = ContactSettings{};
  s.contact->friction = 0.35;
  s.contact->damping = 0;
  return s;
}

InterfaceGeometry<double> geometry(const Bonds &b, std::size_t k) {
  return {b.rest_length[k],
          b.lever[k],
          b.normal_stiffness[k],
          pi * b.bond_radius[k] * b.bond_radius[k],
          1.0,
          triple(b.reference[k]),
          b.bond_radius[k]};
}

InterfaceMotion<double> motion(const Particles &p, const Bonds &b, std::size_t k, double dt) {
  const auto i = static_cast<std::size_t>(b.first[k]), j = static_cast<std::size_t>(b.second[k]);
  const Vector3 d = p.position[j] - p.position[i], v = p.velocity[j] - p.velocity[i];
  InterfaceMotion<double> m{triple(d), triple(dt * v), triple(dt * v), 0, {1, 0, 0, 0}, {1, 0, 0, 0}, {}, {}};
  if (!p.has_rotation()) return m;
  const Vector3 wi = (*p.angular_velocity)[i], wj = (*p.angular_velocity)[j];
  const Vector3 arm = d - 0.5 * dt * v; // in the middle of the step
  m.moved = triple(dt * (v + cross(wj, (b.lever[k] - 1) * arm) - cross(wi, b.lever[k] * arm)));
  m.spun_along = 0.5 * dt * dot(wi + wj, d);
  m.turn_i = rotation((*p.orientation)[i]), m.turn_j = rotation((*p.orientation)[j]);
  m.turned_i = triple(dt * wi), m.turned_j = triple(dt * wj);
  return m;
}

// In every block all but a few of those that failed stand behind all that are whole, and no bond was lost.
void expect_failed_last(Model &model) {
  model.bonds->order_failed();
  const Bonds &b = *model.bonds;
  std::vector<int> seen(b.initial_count(), 0);
  for (std::size_t k = 0; k < b.size(); ++k) {
    const int record = b.record[k];
    ++seen[static_cast<std::size_t>(record)];
    ASSERT_EQ(b.first[k], b.record_first[record]) << "row " << k;
    ASSERT_EQ(b.second[k], b.record_second[record]) << "row " << k;
  }
  EXPECT_EQ(std::count(seen.begin(), seen.end(), 1), static_cast<std::ptrdiff_t>(seen.size()));
  for (std::size_t block = 0; block < b.blocks.blocks(); ++block) {
    int among_whole = 0, failed = 0;
    for (std::size_t k = b.blocks.first_pair[block]; k < b.blocks.first_pair[block + 1]; ++k)
      if (b.has_failed(k))
        ++failed;
      else
        among_whole = failed;
    EXPECT_LT(among_whole, 8) << "block " << block << ", " << failed << " have failed";
  }
}

class YieldingKernels : public testing::TestWithParam<bool> {};

TEST_P(YieldingKernels, follow_the_law_on_every_instruction_set) {
  std::vector<InstructionSet> sets{InstructionSet::baseline};
  if (best_instruction_set() != InstructionSet::baseline) sets.push_back(InstructionSet::avx2);
  if (best_instruction_set() == InstructionSet::avx512) sets.push_back(InstructionSet::avx512);
  for (const InstructionSet set : sets) {
    ModelSettings settings = yielding();
    settings.rotation = GetParam();
    settings.instruction_set = set;
    Model model(packed_box(15, 15, 15), settings);
    const Bonds &b = *model.bonds;
    const auto &law = std::get<YieldingParallelBond>(b.law);
    ASSERT_EQ(law.grain_friction, 0.35);
    shake(model.particles, 2.0, 900);
    std::vector<State> states(b.size());
    const double dt = .3 * model.stable_step({}, 0).limit;
    for (int s = 0; s < 60; ++s) {
      model.begin_step(dt);
      for (std::size_t k = 0; k < b.size(); ++k)
        law(states[static_cast<std::size_t>(b.record[k])], geometry(b, k), motion(model.particles, b, k, dt));
      model.compute_forces(dt);
      model.end_step(dt);
    }
    std::size_t yielded = 0, in_tension = 0, in_shear = 0;
    for (std::size_t k = 0; k < b.size(); ++k) {
      const State &s = states[static_cast<std::size_t>(b.record[k])], own = b.memory<State>(k);
      ASSERT_EQ(own.broken, s.broken) << name(set) << " row " << k;
      ASSERT_NEAR(own.plastic, s.plastic, 1e-8 * 60e6) << name(set) << " row " << k;
      const Triple<double> off = own.slider - s.slider;
      ASSERT_LE(root(dot(off, off)), 1e-9 * radius) << name(set) << " row " << k;
      yielded += s.plastic > 0, in_tension += s.broken == 1, in_shear += s.broken == 2;
    }
    EXPECT_EQ(b.failed_rows, in_tension + in_shear);
    expect_failed_last(model);
    EXPECT_GT(yielded, 20u);
    EXPECT_GT(in_tension, 50u);
    EXPECT_GT(in_shear, 5u);
  }
}
INSTANTIATE_TEST_SUITE_P(rotation, YieldingKernels, testing::Bool());

TEST(YieldingModel, the_energy_balance_of_a_breaking_block_closes) {
  const EnergyLedger e = expect_balance_of_breaking_block(yielding(), 2, 900, 2e-2, 1.5e-3);
  EXPECT_GT(e.plastic, .001 * e.residual());
}

TEST(YieldingModel, momentum_is_kept_through_failure) {
  expect_momentum_through_failure(yielding(), 1.5);
}

// Broken rows that stand apart are passed over, those that touch are not: the same specimen with its rows as
// they were bonded feels the same forces but for the order of sums.
TEST(YieldingModel, the_order_of_rows_changes_forces_by_round_off_alone) {
  Model model(packed_box(15, 15, 15), yielding());
  shake(model.particles, 2.0, 900);
  const double dt = .3 * model.stable_step({}, 0).limit;
  for (int s = 0; s < 60; ++s)
    step(model, dt);
  ASSERT_GT(model.bonds->failed_rows, 200u);
  const auto forces = [&](bool as_bonded) {
    Model copy(packed_box(15, 15, 15), yielding());
    set_state(copy, state_of(model));
    if (as_bonded) {
      std::vector<int> order(copy.bonds->size());
      for (std::size_t k = 0; k < order.size(); ++k)
        order[static_cast<std::size_t>(copy.bonds->record[k])] = static_cast<int>(k);
      copy.bonds->table.permute(order);
      copy.bonds->count_and_cut();
    }
    std::vector<BondBreak> breaks;
    compute_interface_forces(copy.particles, *copy.bonds, InstructionSet::baseline, {}, dt, breaks);
    return std::vector<Vector3>(copy.particles.force.begin(), copy.particles.force.end());
  };
  const std::vector<Vector3> ordered = forces(false), as_bonded = forces(true);
  double largest = 0;
  for (const Vector3 &f : as_bonded)
    largest = std::max(largest, norm(f));
  ASSERT_GT(largest, 0);
  for (std::size_t i = 0; i < ordered.size(); ++i)
    ASSERT_LE(norm(ordered[i] - as_bonded[i]), 1e-12 * largest) << "particle " << i;
}

TEST(YieldingModel, threads_do_not_change_a_bit) {
  expect_same_bits_of_threads(yielding());
}

} // namespace
} // namespace platen::dem
