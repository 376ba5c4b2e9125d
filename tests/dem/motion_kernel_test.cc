// The passes over particles and the loops over contacts: the same bits for every instruction set, and for two
// passes or one.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <ostream>
#include <random>
#include <set>
#include <vector>

#include "base/random.h"
#include "dem/instruction_set.h"
#include "dem/integrator.h"
#include "dem/kernels/motion_kernel.h"
#include "dem/laws/normal_contact.h"
#include "dem/model.h"
#include "dem/packing/specimen.h"
#include "tests/dem/examples.h"

namespace platen::dem::motion_kernel_test {
namespace {

using namespace examples;

struct Effects {
  const char *name;
  bool rotation;
  double local_damping;
  Vector3 gravity;
  bool ledger;
  double dissipation = 1;
  DampingForm form = DampingForm::component;
};

void PrintTo(const Effects &effects, std::ostream *to) {
  *to << effects.name;
}

class Passes : public testing::TestWithParam<Effects> {
protected:
  Integrator how(InstructionSet set) const {
    const Effects &e = GetParam();
    return {e.rotation, e.local_damping, e.gravity, e.ledger, set, e.dissipation, e.form};
  }
  // A cloud in motion under random loads; 1029 rows leave a block of five.
  void set_in_motion(Particles &p) const {
    Random random(7);
    for (std::size_t i = 0; i < p.size(); ++i) {
      p.velocity[i] = .3 * random.direction();
      p.force[i] = 1e-2 * random.direction();
      if (!p.has_rotation()) continue;
      (*p.orientation)[i] = rotation_quaternion(2 * random.direction());
      (*p.angular_velocity)[i] = 40 * random.direction();
      (*p.torque)[i] = 1e-5 * random.direction();
    }
  }
  void prepare(Particles &p) const {
    if (GetParam().dissipation > 1) p.add_excess();
    set_in_motion(p);
  }
  Specimen cloud() const { return cubic(7, 7, 21, 2.1); }
};

void expect_same_bits(const Particles &a, const Particles &b, const std::string &what) {
  for (std::size_t c = 0; c < a.table.columns().size(); ++c) {
    const ColumnBase &one = *a.table.columns()[c], &other = *b.table.columns()[c];
    EXPECT_EQ(std::memcmp(one.bytes(), other.bytes(), one.size() * one.bytes_per_row()), 0)
        << what << " " << one.name();
  }
}

void expect_same_bits(const KickSums &a, const KickSums &b) {
  EXPECT_EQ(a.damping_work, b.damping_work);
  EXPECT_EQ(a.weight_work, b.weight_work);
  EXPECT_EQ(a.kinetic_energy, b.kinetic_energy);
  EXPECT_EQ(a.unbalanced, b.unbalanced);
}

TEST_P(Passes, do_not_depend_on_the_instruction_set) {
  Particles expected(cloud(), 2400, GetParam().rotation);
  prepare(expected);
  const Motion motion = how(InstructionSet::baseline).begin(expected, 1e-7);
  const KickSums sums = how(InstructionSet::baseline).end(expected, {}, 1e-7);
  EXPECT_GT(motion.fastest, 0);
  EXPECT_EQ(sums.kinetic_energy > 0, GetParam().ledger);
  EXPECT_EQ(sums.damping_work > 0,
            GetParam().ledger && (GetParam().local_damping > 0 || GetParam().dissipation > 1));
  EXPECT_EQ(sums.weight_work != 0, GetParam().ledger && norm(GetParam().gravity) > 0);
  for (const InstructionSet set : instruction_sets_here()) {
    Particles p(cloud(), 2400, GetParam().rotation);
    prepare(p);
    EXPECT_EQ(how(set).begin(p, 1e-7).fastest, motion.fastest);
    expect_same_bits(how(set).end(p, {}, 1e-7), sums);
    expect_same_bits(p, expected, name(set));
  }
}

TEST_P(Passes, may_be_one_or_two) {
  const Integrator integrator = how(best_instruction_set());
  Particles two(cloud(), 2400, GetParam().rotation), one(cloud(), 2400, GetParam().rotation);
  prepare(two);
  prepare(one);
  const KickSums ended = integrator.end(two, {}, 1.5e-7);
  const Motion begun = integrator.begin(two, 1e-7);
  KickSums sums;
  const Motion motion = integrator.end_and_begin(one, {}, 1.5e-7, 1e-7, sums);
  EXPECT_EQ(motion.fastest, begun.fastest);
  EXPECT_EQ(sums.damping_work, ended.damping_work);
  EXPECT_EQ(sums.weight_work, ended.weight_work);
  // The one pass leaves forces as they were before damping: nobody reads them again.
  for (std::size_t i = 0; i < one.size(); ++i) {
    one.force[i] = two.force[i];
    if (one.has_rotation()) (*one.torque)[i] = (*two.torque)[i];
  }
  expect_same_bits(one, two, "in one pass");
}

// The sum of squared speeds tells, in any row of a pack or behind the last one.
TEST_P(Passes, tell_a_velocity_that_is_not_finite) {
  for (const double wrong :
       {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()})
    for (const std::size_t row : {0u, 5u, 700u, 1028u}) {
      Particles p(cloud(), 2400, GetParam().rotation);
      prepare(p);
      KickSums sums;
      EXPECT_TRUE(
          std::isfinite(how(best_instruction_set()).end_and_begin(p, {}, 1e-7, 1e-7, sums).speed_squares));
      p.force[row].y = wrong;
      EXPECT_FALSE(
          std::isfinite(how(best_instruction_set()).end_and_begin(p, {}, 1e-7, 1e-7, sums).speed_squares))
          << "force " << wrong << " in row " << row;
    }
}

// What has no columns is a coefficient, not a loop.
TEST(motion_kernel, has_twelve_loops) {
  for (const auto &kernel :
       {kernels::motion_kernel_baseline, kernels::motion_kernel_avx2, kernels::motion_kernel_avx512}) {
    std::set<kernels::MotionKernel> loops;
    for (const auto halves : {kernels::Halves::end, kernels::Halves::begin, kernels::Halves::end_and_begin})
      for (const bool rotation : {false, true})
        for (const bool dissipative : {false, true})
          loops.insert(kernel(halves, {rotation, dissipative}));
    EXPECT_EQ(loops.size(), 12u);
  }
}

INSTANTIATE_TEST_SUITE_P(
    motion_kernel, Passes,
    testing::Values(Effects{"all", true, .5, {1, -2, -9.81}, true},
                    Effects{"without_rotation", false, .5, {1, -2, -9.81}, true},
                    Effects{"without_damping", true, 0, {0, 0, -9.81}, true},
                    Effects{"without_gravity", true, .5, {}, true},
                    Effects{"without_ledger", true, .5, {0, 0, -9.81}, false},
                    Effects{"translation_alone", false, 0, {}, false},
                    Effects{"all_and_dissipation", true, .5, {1, -2, -9.81}, true, 1.3},
                    Effects{"along_the_velocity", true, .5, {1, -2, -9.81}, true, 1, DampingForm::vector},
                    Effects{
                        "along_the_velocity_and_dissipation", true, .5, {}, true, 1.3, DampingForm::vector},
                    Effects{"dissipation_alone", true, 0, {}, true, 1.3},
                    Effects{"dissipation_without_ledger", false, 0, {}, false, 1.3}),
    [](const auto &effects) { return std::string(effects.param.name); });

// A cloud of spheres that fall into each other, with every choice of effects.
std::vector<char> collisions(const ModelSettings &settings) {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> draw(-1, 1);
  Specimen cloud;
  while (cloud.centre.size() < 150) {
    const Vector3 x{5e-3 * draw(random), 5e-3 * draw(random), 5e-3 * draw(random)};
    bool apart = true;
    for (const Vector3 &other : cloud.centre)
      apart = apart && norm(x - other) > 1.9e-3;
    if (!apart && random() % 400 != 0) continue; // a few that overlap
    cloud.centre.push_back(x);
    cloud.radius.push_back(0.7e-3 + 0.2e-3 * draw(random));
  }
  Model model(cloud, settings);
  for (std::size_t i = 0; i < model.particles.size(); ++i) {
    model.particles.velocity[i] = -2e3 * model.particles.position[i];
    if (settings.rotation)
      (*model.particles.angular_velocity)[i] = 2e4 * Vector3{draw(random), draw(random), draw(random)};
  }
  std::vector<char> bytes;
  const auto put = [&](const auto &value) {
    const char *from = reinterpret_cast<const char *>(&value);
    bytes.insert(bytes.end(), from, from + sizeof value);
  };
  std::size_t most = 0;
  const double dt = 2e-8;
  for (int step = 0; step < 1500; ++step) {
    model.begin_step(dt);
    model.compute_forces(dt);
    model.end_step(dt);
    most = std::max(most, model.touching_count());
    if (step % 100 != 0) continue;
    for (std::size_t i = 0; i < model.particles.size(); ++i)
      put(model.particles.position[i]), put(model.particles.force[i]);
    const EnergyLedger energy = model.energy();
    put(energy.contacts), put(energy.friction), put(energy.damping);
  }
  EXPECT_GT(most, 30u) << "touch at once";
  return bytes;
}

TEST(ContactKernel, gives_the_same_bits_with_every_instruction_set) {
  for (const NormalContact normal : {NormalContact::linear, NormalContact::hertz})
    for (const TangentialContact tangential :
         {TangentialContact::none, TangentialContact::coulomb, TangentialContact::coulomb_with_rolling})
      for (const double damping : {0.0, 0.1})
        for (const bool rotation : {true, false})
          for (const bool ledger : {true, false}) {
            if (!rotation && tangential == TangentialContact::coulomb_with_rolling) continue;
            ModelSettings settings = unbonded(normal, tangential, 1e6);
            settings.rotation = rotation;
            settings.energy_ledger = ledger;
            settings.local_damping = ModelSettings{}.local_damping;
            settings.contact->friction = 0.3;
            settings.contact->rolling_friction = 0.1;
            settings.contact->damping = damping;
            settings.contact->restitution = damping > 0 ? 0.7 : 1;
            settings.instruction_set = InstructionSet::baseline;
            const std::vector<char> expected = collisions(settings);
            for (const InstructionSet set : instruction_sets_here()) {
              settings.instruction_set = set;
              EXPECT_TRUE(collisions(settings) == expected)
                  << name(set) << ": the bits differ; " << word(normal) << ", tangential "
                  << static_cast<int>(tangential) << ", damping " << damping << ", rotation " << rotation
                  << ", ledger " << ledger;
            }
          }
}

} // namespace
} // namespace platen::dem::motion_kernel_test
