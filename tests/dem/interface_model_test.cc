// Specimens held together by elasto-damage-plastic interfaces: the kernels against the law, energy, threads.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <vector>

#include "base/parallel.h"
#include "base/random.h"
#include "tests/dem/examples.h"

namespace platen::dem {
namespace {

using namespace examples;

Triple<double> triple(const Vector3 &a) {
  return {a.x, a.y, a.z};
}
double difference(const Triple<double> &a, const Vector3 &b) {
  return norm(Vector3{a.x, a.y, a.z} - b);
}

// Moves every interface by the law alone, in doubles, beside a model that steps.
struct ByHand {
  std::vector<InterfaceState<double>> states;

  explicit ByHand(const Bonds &b) : states(b.size(), {0, 0, 0, {0, 0, 0}, {0, 0, 0}, 0}) {}
  void follow(const Particles &p, const Bonds &b, double dt) {
    const ElastoDamagePlastic &law = std::get<ElastoDamagePlastic>(b.law);
    for (std::size_t k = 0; k < b.size(); ++k) {
      const std::size_t i = static_cast<std::size_t>(b.first[k]), j = static_cast<std::size_t>(b.second[k]);
      const Vector3 d = p.position[j] - p.position[i], v = p.velocity[j] - p.velocity[i];
      Vector3 slip = v;
      double spin = 0;
      if (p.has_rotation()) {
        const Vector3 wi = (*p.angular_velocity)[i], wj = (*p.angular_velocity)[j];
        slip += cross(wj, (b.lever[k] - 1) * d) - cross(wi, b.lever[k] * d);
        spin = 0.5 * dot(wi + wj, d);
      }
      const InterfaceGeometry<double> g{b.rest_length[k], b.lever[k], b.normal_stiffness[k],
                                        pi * b.bond_radius[k] * b.bond_radius[k]};
      law(states[static_cast<std::size_t>(b.record[k])], g,
          {triple(d), triple(dt * v), triple(dt * slip), dt * spin});
    }
  }
};

class InterfaceKernels : public testing::TestWithParam<bool> {};

TEST_P(InterfaceKernels, follow_the_law_on_every_instruction_set) {
  std::vector<InstructionSet> sets{InstructionSet::baseline};
  if (best_instruction_set() != InstructionSet::baseline) sets.push_back(InstructionSet::avx2);
  if (best_instruction_set() == InstructionSet::avx512) sets.push_back(InstructionSet::avx512);
  for (const InstructionSet set : sets) {
    ModelSettings settings = interfaces();
    settings.rotation = GetParam();
    settings.instruction_set = set;
    Model model(packed_box(15, 15, 15), settings);
    const Bonds &b = *model.bonds;
    ASSERT_GT(b.size(), 1000u);
    shake(model.particles, 2.0, 600);
    ByHand hand(b);
    const double dt = .3 * model.stable_step({}, 0).limit;
    for (int s = 0; s < 60; ++s) {
      model.begin_step(dt);
      hand.follow(model.particles, b, dt);
      model.compute_forces(dt);
      model.end_step(dt);
    }
    EXPECT_GT(b.failed_rows, 100u);
    std::size_t yielded = 0, damaged = 0, failed = 0;
    for (std::size_t k = 0; k < b.size(); ++k) {
      const InterfaceState<double> &s = hand.states[static_cast<std::size_t>(b.record[k])];
      const InterfaceState<double> own = b.memory<InterfaceState<double>>(k);
      // Round-off of positions, eps times some centimetres, over the limits of some micrometres: 1e-11.
      ASSERT_NEAR(own.plastic, s.plastic, 1e-8 * 20e6) << name(set) << " row " << k;
      ASSERT_NEAR(own.tension_damage, s.tension_damage, 1e-8);
      ASSERT_NEAR(own.shear_damage, s.shear_damage, 1e-8);
      ASSERT_LE(difference(s.shear, Vector3{own.shear.x, own.shear.y, own.shear.z}), 1e-9 * radius);
      ASSERT_LE(difference(s.slider, Vector3{own.slider.x, own.slider.y, own.slider.z}), 1e-9 * radius);
      yielded += s.plastic > 0;
      damaged += s.tension_damage > 0 && s.tension_damage < 1;
      failed += b.has_failed(k);
    }
    EXPECT_EQ(b.failed_rows, failed); // none is missed in the step in which it fails, wherever it stands
    EXPECT_GT(yielded, 20u);
    EXPECT_GT(damaged, 1u);
  }
}
INSTANTIATE_TEST_SUITE_P(rotation, InterfaceKernels, testing::Bool());

TEST(InterfaceModel, the_energy_balance_of_a_breaking_block_closes) {
  const EnergyLedger e = expect_balance_of_breaking_block(interfaces(), 2, 600, 2e-2, 1.5e-3);
  EXPECT_GT(e.plastic, .01 * e.residual());
}

TEST(InterfaceModel, momentum_is_kept_through_failure) {
  expect_momentum_through_failure(interfaces(), 1.0);
}

TEST(InterfaceModel, threads_do_not_change_a_bit) {
  expect_same_bits_of_threads(interfaces());
}

TEST(InterfaceModel, the_interaction_range_bonds_across_gaps) {
  const double reach = 2 * radius * 1.1;
  const Specimen pair = spheres({{0, 0, 0}, {0, 0, reach * (1 - 1e-9)}, {0, reach * (1 + 1e-9), 0}});
  Model model(pair, interfaces());
  ASSERT_EQ(model.bonds->size(), 1u);
  EXPECT_DOUBLE_EQ(model.bonds->normal_stiffness[0], 28e9 / model.bonds->rest_length[0]);
  EXPECT_NEAR(model.bonds->rest_length[0], reach, 1e-8 * reach);
}

// A spinning body stores nothing and loses nothing.
TEST(InterfaceModel, a_spinning_block_stores_no_energy) {
  ModelSettings settings = interfaces();
  settings.contact.reset();
  Model model(packed_box(8, 8, 8), settings);
  Particles &p = model.particles;
  const Vector3 spin{120, -80, 200};
  Vector3 centre;
  for (std::size_t i = 0; i < p.size(); ++i)
    centre += p.position[i] / static_cast<double>(p.size());
  const double dt = .05 * model.stable_step({}, 0).limit;
  for (std::size_t i = 0; i < p.size(); ++i) {
    p.velocity[i] = cross(spin, p.position[i] - centre);
    (*p.angular_velocity)[i] = spin;
  }
  for (int s = 0; s < 20000; ++s)
    step(model, dt);
  const EnergyLedger e = model.energy();
  EXPECT_LT(e.bonds, 1e-3 * e.kinetic); // the stretch of a spinning body, (w r)^2 rho / E
  double shear = 0;
  for (std::size_t k = 0; k < model.bonds->size(); ++k) {
    const Triple<double> u = model.bonds->memory<InterfaceState<double>>(k).shear;
    shear = std::max(shear, root(dot(u, u)));
  }
  EXPECT_LT(shear, 1e-5 * radius);
  EXPECT_EQ(model.bonds->failed_rows, 0u);
}

} // namespace
} // namespace platen::dem
