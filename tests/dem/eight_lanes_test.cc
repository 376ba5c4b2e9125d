// Kernels of eight lanes against those of four.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "dem/kernels/bond_kernel.h"
#include "dem/kernels/motion_kernel.h"
#include "dem/packing/random.h"
#include "tests/dem/examples.h"

namespace platen::dem {

namespace kernels {
extern const BondKernels bond_kernels_of_eight_lanes;
MotionKernel motion_kernel_of_eight_lanes(Halves, const MotionEffects &);
} // namespace kernels

namespace {

using namespace examples;

class EightLanes : public testing::TestWithParam<bool> { // with rotation
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
  static Specimen specimen() { return packed_box(11, 11, 11); }
  static ModelSettings settings() {
    ModelSettings s = breakable();
    s.rotation = GetParam();
    s.bond_dashpot = .1;
    return s;
  }
  kernels::BondColumns columns() {
    Particles &p = model.particles;
    Bonds &b = *model.bonds;
    kernels::BondColumns c{};
    c.first = b.first.data(), c.second = b.second.data(), c.local = b.blocks.local.data();
    c.reference = b.reference.data();
    c.rest_length = b.rest_length.data(), c.lever = b.lever.data();
    c.normal_stiffness = b.normal_stiffness.data(), c.bond_radius = b.bond_radius.data();
    c.position = p.position.data();
    c.velocity = p.velocity.data();
    c.dashpot = b.dashpot->data(), c.dashpot_force = b.dashpot_force->data();
    c.dashpot_shear_ratio = b.dashpot_shear_ratio, c.dashpot_twist_ratio = b.dashpot_twist_ratio;
    if (p.has_rotation()) {
      c.orientation = p.orientation->data();
      c.angular_velocity = p.angular_velocity->data();
      c.dashpot_bending = b.dashpot_bending->data(), c.dashpot_moment = b.dashpot_moment->data();
    }
    c.spare_row = static_cast<int>(p.size());
    return c;
  }
  // Sums of the one block, without the spare row; padding at fourth places is nobody's.
  std::vector<double> sums_of(const std::function<void(const kernels::BondColumns &)> &add) {
    const std::size_t stride = static_cast<std::size_t>(kernels::sums_stride(GetParam()));
    std::vector<double> sums((model.particles.size() + 1) * stride, 0.0);
    kernels::BondColumns c = columns();
    c.sums = sums.data();
    add(c);
    sums.resize(model.particles.size() * stride);
    for (std::size_t k = 3; k < sums.size(); k += 4)
      sums[k] = 0;
    return sums;
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

TEST_P(EightLanes, add_the_same_forces_and_dashpots) {
  ASSERT_LE(model.particles.size(), 1024u);
  const std::size_t bonds = model.bonds->size();
  ASSERT_NE(bonds % 8, 0u);
  const auto &four = kernels::bond_kernels_baseline, &eight = kernels::bond_kernels_of_eight_lanes;
  const ParallelBond &law = model.bonds->law;
  bool reached = false, reached_too = false;
  expect_near(sums_of([&](const auto &c) { reached = four.add_forces(c, law, 0, bonds); }),
              sums_of([&](const auto &c) { reached_too = eight.add_forces(c, law, 0, bonds); }));
  EXPECT_TRUE(reached);
  EXPECT_TRUE(reached_too);
  double power = 0, power_too = 0;
  const std::vector<double> by_four = sums_of([&](const auto &c) { power = four.add_dashpots(c, 0, bonds); });
  for (Vector3 &f : *model.bonds->dashpot_force)
    f = {};
  if (GetParam())
    for (Vector3 &m : *model.bonds->dashpot_moment)
      m = {};
  expect_near(by_four, sums_of([&](const auto &c) { power_too = eight.add_dashpots(c, 0, bonds); }));
  EXPECT_NEAR(power, power_too, 1e-12 * power);
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
  const kernels::MotionEffects effects{GetParam(), true, true, true};
  const kernels::MotionStep step{1e-7, 2e-7, .4, {1, 2, -9.81}};
  const auto moved = [&](kernels::MotionKernel kernel) {
    Model copy(specimen(), settings());
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
    const kernels::MotionSums sums = kernel(c, step, 0, p.size());
    std::vector<double> all{sums.damping_work, sums.weight_work, sums.speed_squares, sums.fastest_square};
    for (std::size_t i = 0; i < p.size(); ++i) {
      const Quaternion q = p.has_rotation() ? (*p.orientation)[i] : Quaternion{};
      all.insert(all.end(), {p.position[i].x, p.position[i].y, p.position[i].z, p.velocity[i].x, q.w, q.z});
    }
    return all;
  };
  const auto halves = kernels::Halves::end_and_begin;
  EXPECT_EQ(moved(kernels::motion_kernel_baseline(halves, effects)),
            moved(kernels::motion_kernel_of_eight_lanes(halves, effects)));
}

INSTANTIATE_TEST_SUITE_P(kernels, EightLanes, testing::Bool());

} // namespace
} // namespace platen::dem
