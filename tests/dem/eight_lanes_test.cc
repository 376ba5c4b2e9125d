// Kernels of eight lanes against those of four.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "base/parallel.h"
#include "base/random.h"
#include "dem/kernels/bond_kernel.h"
#include "dem/kernels/motion_kernel.h"
#include "tests/dem/examples.h"

namespace platen::dem {

namespace kernels {
extern const BondKernels bond_kernels_of_eight_lanes;
MotionKernel motion_kernel_of_eight_lanes(Halves, const MotionEffects &);
} // namespace kernels

namespace {

using namespace examples;

// With rotation; with bonds of unlike strength; with dashpots, and velocities in the rows.
class EightLanes : public testing::TestWithParam<std::tuple<bool, bool, bool>> {
protected:
  EightLanes() : model(specimen(), settings()) {
    Particles &p = model.particles;
    Random random(5);
    for (std::size_t i = 0; i < p.size(); ++i) {
      p.position[i] += 1e-3 * radius * random.direction();
      p.velocity[i] = random.direction();
      if (!p.has_rotation()) continue;
      (*p.orientation)[i] = rotation_quaternion(1e-3 * random.direction());
      (*p.angular_velocity)[i] = (1 / radius) * random.direction();
    }
  }
  static bool rotation() { return std::get<0>(GetParam()); }
  static Specimen specimen() { return packed_box(19, 19, 19); }
  static ModelSettings settings() {
    ModelSettings s = breakable();
    s.rotation = rotation();
    if (std::get<1>(GetParam())) s.strength_scatter = StrengthScatter{3, 1};
    if (std::get<2>(GetParam())) s.bond_dashpot = .1;
    return s;
  }
  kernels::BondColumns columns() {
    Particles &p = model.particles;
    Bonds &b = *model.bonds;
    kernels::BondColumns c{};
    c.first = b.first.data(), c.second = b.second.data(), c.ends = b.blocks.ends.data();
    c.reference = b.reference.data();
    c.rest_length = b.rest_length.data(), c.lever = b.lever.data();
    c.normal_stiffness = b.normal_stiffness.data(), c.bond_radius = b.bond_radius.data();
    if (b.strength_factor != nullptr) c.strength_factor = b.strength_factor->data();
    c.position = p.position.data();
    c.motion = b.rows_move();
    c.velocity = p.velocity.data();
    if (p.has_rotation())
      c.orientation = p.orientation->data(), c.angular_velocity = p.angular_velocity->data();
    if (b.dashpot == nullptr) return c;
    c.dashpot = b.dashpot->data(), c.dashpot_force = b.dashpot_force->data();
    c.dashpot_shear_ratio = b.dashpot_shear_ratio, c.dashpot_twist_ratio = b.dashpot_twist_ratio;
    if (p.has_rotation())
      c.dashpot_bending = b.dashpot_bending->data(), c.dashpot_moment = b.dashpot_moment->data();
    return c;
  }
  // Forces on the particles of each block and on its ghosts after run(columns, block, first, last).
  template <class Run>
  std::vector<double> loads_of(const Run &run) {
    Particles &p = model.particles;
    PairBlocks &blocks = model.bonds->blocks;
    const std::size_t stride =
        static_cast<std::size_t>(kernels::row_stride(rotation(), model.bonds->rows_move()));
    std::vector<double> memory((p.size() + blocks.ghost_particle.size() + kernels::spare_rows + 1) * stride);
    for (std::size_t i = 0; i < p.size(); ++i) {
      p.force[i] = {};
      if (rotation()) (*p.torque)[i] = {};
    }
    for (std::size_t k = 0; k < blocks.blocks(); ++k) {
      const std::size_t first = k * block_rows, ghost = blocks.first_ghost[k];
      kernels::BlockColumns c{};
      c.rows = memory.data();
      c.first_row = static_cast<int>(first);
      c.own = static_cast<int>(std::min(p.size(), first + block_rows) - first);
      c.ghosts = static_cast<int>(blocks.first_ghost[k + 1] - ghost);
      c.ghost_particle = blocks.ghost_particle.data() + ghost;
      c.force = p.force.data() + first, c.ghost_force = blocks.ghost_force.data() + ghost;
      if (rotation()) {
        c.torque = p.torque->data() + first, c.ghost_torque = blocks.ghost_torque.data() + ghost;
        std::fill_n(c.ghost_torque, c.ghosts, Vector3{});
      }
      std::fill_n(c.ghost_force, c.ghosts, Vector3{});
      run(columns(), c, blocks.first_pair[k], blocks.first_pair[k + 1]);
    }
    std::vector<double> all;
    const auto append = [&](const auto &column) {
      for (const Vector3 &v : column)
        all.insert(all.end(), {v.x, v.y, v.z});
    };
    append(p.force), append(blocks.ghost_force);
    if (rotation()) append(*p.torque), append(blocks.ghost_torque);
    return all;
  }
  static void expect_near(const std::vector<double> &a, const std::vector<double> &b) {
    ASSERT_EQ(a.size(), b.size());
    double largest = 0;
    for (const double x : a)
      largest = std::max(largest, std::abs(x));
    EXPECT_GT(largest, 0);
    for (std::size_t k = 0; k < a.size(); ++k)
      ASSERT_NEAR(a[k], b[k], 1e-12 * largest) << k;
  }
  Model model;
};

TEST_P(EightLanes, give_the_same_forces_and_dashpots) {
  ASSERT_GT(model.bonds->blocks.blocks(), 1u);
  ASSERT_GT(model.bonds->blocks.ghost_particle.size(), 0u);
  const Bonds &bonds = *model.bonds;
  std::size_t tails = 0;
  // Twice: forces of the first time count in the power of the second.
  const auto computed = [&](const kernels::BondKernels &of, bool &reached, std::vector<double> &powers) {
    if (bonds.dashpot != nullptr)
      std::fill(bonds.dashpot_force->begin(), bonds.dashpot_force->end(), Vector3{});
    if (bonds.dashpot_moment != nullptr)
      std::fill(bonds.dashpot_moment->begin(), bonds.dashpot_moment->end(), Vector3{});
    std::vector<double> loads;
    for (const bool first_time : {true, false}) {
      double power = 0;
      loads = loads_of([&](const auto &c, const auto &block, std::size_t first, std::size_t last) {
        if (first_time) tails += (last - first) % 8;
        const kernels::BlockFindings found = of.compute_forces(c, block, bonds.law, first, last);
        reached |= found.reached, power += found.dashpot_power;
      });
      powers.push_back(power);
    }
    return loads;
  };
  bool reached = false, reached_too = false;
  std::vector<double> power, power_too;
  expect_near(computed(kernels::bond_kernels_baseline, reached, power),
              computed(kernels::bond_kernels_of_eight_lanes, reached_too, power_too));
  EXPECT_GT(tails, 0u);
  EXPECT_TRUE(reached);
  EXPECT_TRUE(reached_too);
  EXPECT_EQ(power[0] > 0, bonds.dashpot != nullptr);
  EXPECT_NEAR(power[1], 2 * power[0], 1e-12 * power[1]);
  EXPECT_NEAR(power[0], power_too[0], 1e-12 * power[0]);
  EXPECT_NEAR(power[1], power_too[1], 1e-12 * power[1]);
}

TEST_P(EightLanes, measure_the_same) {
  const std::size_t bonds = model.bonds->size();
  std::vector<double> four(4 * bonds), eight(4 * bonds);
  const auto values = [&](std::vector<double> &v) {
    return kernels::BondRowValues{v.data(), v.data() + bonds, v.data() + 2 * bonds, v.data() + 3 * bonds};
  };
  kernels::bond_kernels_baseline.measure(columns(), model.bonds->law, values(four), 0, bonds);
  kernels::bond_kernels_of_eight_lanes.measure(columns(), model.bonds->law, values(eight), 0, bonds);
  for (std::size_t k = 0; k < four.size(); ++k)
    ASSERT_NEAR(four[k], eight[k], 1e-10 * std::abs(four[k])) << k;
}

TEST_P(EightLanes, move_to_the_same_bits) {
  kernels::MotionStep step;
  step.finished = 1e-7, step.next = 2e-7;
  step.local_damping = .4, step.excess = .3;
  step.weight_sum = true, step.gravity = {1, 2, -9.81};
  const auto moved = [&](kernels::MotionKernel kernel, bool dissipative) {
    Model copy(specimen(), settings());
    if (dissipative) copy.particles.add_excess();
    Particles &p = copy.particles;
    Random random(8);
    kernels::MotionColumns c{};
    c.position = p.position.data(), c.velocity = p.velocity.data();
    c.force = p.force.data(), c.mass = p.mass.data();
    for (std::size_t i = 0; i < p.size(); ++i) {
      p.velocity[i] = random.direction(), p.force[i] = random.direction();
      if (p.has_rotation()) (*p.torque)[i] = radius * random.direction();
    }
    if (p.has_rotation()) {
      c.orientation = p.orientation->data(), c.angular_velocity = p.angular_velocity->data();
      c.torque = p.torque->data(), c.inertia = p.inertia->data();
    }
    if (dissipative) {
      for (Vector3 &v : *p.excess_velocity)
        v = .1 * random.direction();
      c.excess_velocity = p.excess_velocity->data();
      if (p.has_rotation()) c.excess_spin = p.excess_spin->data();
    }
    const kernels::MotionSums sums = kernel(c, step, 0, p.size());
    std::vector<double> all{sums.damping_work, sums.weight_work, sums.speed_squares, sums.fastest_square};
    for (std::size_t i = 0; i < p.size(); ++i) {
      const Quaternion q = p.has_rotation() ? (*p.orientation)[i] : Quaternion{};
      all.insert(all.end(), {p.position[i].x, p.position[i].y, p.position[i].z, p.velocity[i].x, q.w, q.z});
    }
    return all;
  };
  const auto halves = kernels::Halves::end_and_begin;
  for (const auto damping : {kernels::LocalDamping::component, kernels::LocalDamping::vector})
    for (const bool dissipative : {false, true}) {
      step.damping = damping;
      const kernels::MotionEffects effects{rotation(), dissipative};
      EXPECT_EQ(moved(kernels::motion_kernel_baseline(halves, effects), dissipative),
                moved(kernels::motion_kernel_of_eight_lanes(halves, effects), dissipative));
    }
}

INSTANTIATE_TEST_SUITE_P(kernels, EightLanes,
                         testing::Combine(testing::Bool(), testing::Bool(), testing::Bool()));

} // namespace
} // namespace platen::dem
