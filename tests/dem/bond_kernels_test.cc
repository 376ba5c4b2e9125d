// The loops over bonds compute what the law says of each, on every instruction set.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "base/random.h"
#include "tests/dem/examples.h"

namespace platen::dem::bond_kernels_test {
namespace {

using namespace examples;

struct Case {
  const char *name;
  bool beams, rotation, moments;
  double strain; // at which some bonds of a block break and most do not
};
void PrintTo(const Case &one, std::ostream *to) {
  *to << one.name;
}

// With strengths of their own or not.
class BondKernels : public testing::TestWithParam<std::tuple<Case, bool>> {
protected:
  static ModelSettings settings(double strength = 1) { // of a strength of 0 none breaks
    const auto &[of, scattered] = GetParam();
    ModelSettings s = breakable();
    if (of.beams) {
      CohesiveBeam::Parameters beam;
      beam.tensile_strength = strength * tensile_strength, beam.shear_strength = strength * shear_strength;
      s.bond = beam;
    } else {
      s.rotation = of.rotation;
      ParallelBond::Parameters &bond = parallel_bond(s);
      bond.moments = of.moments, bond.tensile_strength *= strength, bond.shear_strength *= strength;
    }
    if (scattered) s.strength_scatter = StrengthScatter{3, 1};
    return s;
  }
  static void disturb(Particles &p, double strain) {
    Random random(3);
    for (std::size_t i = 0; i < p.size(); ++i) {
      p.position[i] += strain * radius * random.direction();
      if (p.has_rotation()) (*p.orientation)[i] = rotation_quaternion(strain * random.direction());
    }
  }
  // Off by `share` of the force on a particle, and by `least` (N) where forces cancel.
  static void expect_near(const Loads &loads, const Loads &expected, double share, double least,
                          const std::string &of) {
    for (std::size_t i = 0; i < loads.force.size(); ++i) {
      const double within = share * norm(expected.force[i]) + least;
      ASSERT_LE(norm(loads.force[i] - expected.force[i]), within) << of << ", row " << i;
      ASSERT_LE(norm(loads.torque[i] - expected.torque[i]), within * radius) << of << ", row " << i;
    }
  }
};

// Forces, sums, and who breaks how; forces know nothing of strengths.
TEST_P(BondKernels, do_what_the_law_says) {
  Model model(packed_box(14, 14, 14), settings());
  Particles &p = model.particles;
  Bonds &b = *model.bonds;
  const auto &[of, scattered] = GetParam();
  disturb(p, of.beams && !scattered ? 1.4 * of.strain : of.strain);
  const Loads expected = bond_loads(p, b);
  std::set<std::pair<int, BondState>> broken;
  double energy = 0, force = 0;
  for (std::size_t k = 0; k < b.size(); ++k) {
    const BondResponse<double> r = b.response(k, p);
    energy += r.energy, force += root(dot(r.force, r.force));
    if (std::max(r.tension_ratio, r.shear_ratio) >= 1)
      broken.insert({static_cast<int>(k), r.shear_ratio > r.tension_ratio ? BondState::broken_in_shear
                                                                          : BondState::broken_in_tension});
  }
  EXPECT_GT(broken.size(), 20u);
  EXPECT_LT(broken.size(), b.size() / 2);
  for (const InstructionSet set : instruction_sets_here()) {
    std::vector<BondBreak> breaks;
    const Loads loads = kernel_loads(p, b, set, breaks);
    // A strain of 1e-4 takes four of the sixteen digits of the positions; a particle adds up a dozen bonds.
    expect_near(loads, expected, 0, 1e-10 * force / static_cast<double>(b.size()), name(set));
    std::set<std::pair<int, BondState>> found;
    for (const BondBreak &one : breaks)
      found.insert({one.row, one.mode});
    EXPECT_EQ(found, broken) << name(set);
    EXPECT_NEAR(bond_totals(p, b, set).energy, energy, 1e-10 * energy) << name(set);
    EXPECT_NEAR(bond_totals(p, b, set).force, force, 1e-10 * force) << name(set);
  }
}

// The kernel takes rows in packs and particles in blocks: the tail of each must not be lost nor read beyond,
// and what leaves a block must arrive.
TEST_P(BondKernels, compute_every_row_of_any_count) {
  for (const int bonds : {1, 2, 3, 7, 8, 9, 1022, 1023, 1024, 1025, 2047, 2050}) {
    Model model(row(bonds, {1, 1, 0}), settings(0));
    disturb(model.particles, 1e-3);
    const Loads expected = bond_loads(model.particles, *model.bonds);
    for (const InstructionSet set : instruction_sets_here()) {
      std::vector<BondBreak> breaks;
      for (Vector3 &f : model.particles.force)
        f = {1e300, 0, 0};
      const Loads loads = kernel_loads(model.particles, *model.bonds, set, breaks);
      EXPECT_TRUE(breaks.empty());
      expect_near(loads, expected, std::get<0>(GetParam()).beams ? 1e-9 : 1e-10, 0,
                  std::string(name(set)) + " of " + std::to_string(bonds));
    }
  }
}

// Strained by a hundredth, so that many break: the same ones in the same order, and the same forces but for
// the last bits.
class ParallelKernels : public BondKernels {};
TEST_P(ParallelKernels, agree_with_the_baseline) {
  Model model(packed_box(14, 14, 14), settings());
  disturb(model.particles, .01);
  Bonds &bonds = *model.bonds;
  Particles &particles = model.particles;
  std::vector<BondBreak> breaks;
  const Loads expected = kernel_loads(particles, bonds, InstructionSet::baseline, breaks);
  ASSERT_GT(breaks.size(), 100u);
  ASSERT_LT(breaks.size(), bonds.size());
  // The strain of .01 takes two of the sixteen digits of the positions; a particle adds up a dozen bonds.
  const double force = bond_totals(particles, bonds).force / static_cast<double>(bonds.size());
  for (const InstructionSet set : instruction_sets_here()) {
    std::vector<BondBreak> others;
    const Loads loads = kernel_loads(particles, bonds, set, others);
    ASSERT_EQ(others.size(), breaks.size()) << name(set);
    for (std::size_t k = 0; k < others.size(); ++k) {
      EXPECT_EQ(others[k].row, breaks[k].row);
      EXPECT_EQ(others[k].mode, breaks[k].mode);
    }
    expect_near(loads, expected, 0, 1e-11 * force, name(set));
  }
}

const Case turning_or_not[] = {{"parallel_bonds", false, true, true, 2e-4},
                               {"without_moments", false, true, false, 4e-4},
                               {"without_rotation", false, false, false, 6e-4}};
const auto name_of = [](const auto &one) {
  return std::get<0>(one.param).name + std::string(std::get<1>(one.param) ? "_scattered" : "");
};
INSTANTIATE_TEST_SUITE_P(laws, ParallelKernels,
                         testing::Combine(testing::ValuesIn(turning_or_not), testing::Values(false)),
                         name_of);
INSTANTIATE_TEST_SUITE_P(laws, BondKernels,
                         testing::Combine(testing::ValuesIn(turning_or_not), testing::Bool()), name_of);
INSTANTIATE_TEST_SUITE_P(beams, BondKernels,
                         testing::Combine(testing::Values(Case{"beams", true, true, true, .5e-4}),
                                          testing::Bool()),
                         name_of);

} // namespace
} // namespace platen::dem::bond_kernels_test
