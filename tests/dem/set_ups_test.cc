// What is claimed of every model, whatever it consists of.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstring>
#include <fstream>

#include "base/parallel.h"
#include "tests/dem/examples.h"
#include "tests/measured.h"
#include "tests/same_state.h"

namespace platen::dem::set_ups_test {
namespace {

using namespace examples;
using measured::expect_below;

class SetUps : public testing::TestWithParam<SetUp> {};

TEST_P(SetUps, give_the_same_bits_on_any_number_of_threads) {
  struct Run {
    std::unique_ptr<Model> model;
    double limit;
    EnergyLedger energy;
  };
  const auto run = [&](int threads) {
    const ThreadLimit limit(threads);
    Run r{flying_block(GetParam().settings, 26), 0, {}};
    r.limit = r.model->stable_step({}, 0).limit;
    step(*r.model, .5 * r.limit, 200);
    r.energy = r.model->energy();
    return r;
  };
  const Run one = run(1);
  EXPECT_GT(one.model->particles.size(), 3 * block_rows);
  if (one.model->bonds) {
    EXPECT_GT(one.model->broken_tension + one.model->broken_shear, 50);
  }
  for (const int threads : {2, 4, 8, 1}) {
    const Run other = run(threads);
    EXPECT_TRUE(same_state(*one.model, *other.model)) << threads;
    EXPECT_EQ(std::memcmp(&other.energy, &one.energy, sizeof one.energy), 0) << threads;
    EXPECT_EQ(other.limit, one.limit) << threads;
  }
}

// But for weight and for damping that knows no partner. The dissipative scheme, and spheres that do not turn,
// keep no angular momentum.
TEST_P(SetUps, keep_their_momentum_through_failure) {
  ModelSettings settings = GetParam().settings;
  settings.gravity = {}, settings.local_damping = 0;
  const auto model = flying_block(settings, 16);
  Particles &p = model->particles;
  for (std::size_t i = 0; i < p.size(); ++i)
    p.velocity[i] += cross(Vector3{.02, .01, -.03}, p.position[i] / radius) + Vector3{1, 2, -1};
  const Momentum before = momentum(p);
  step(*model, .5 * model->stable_step({}, 0).limit, 600);
  const Momentum after = momentum(p);
  if (model->bonds) {
    EXPECT_GT(model->broken_tension + model->broken_shear, 50);
  }
  if (model->contacts && !(model->bonds && has_history(model->bonds->law))) {
    EXPECT_GT(model->contacts->table.size(), 10u);
  }
  expect_below(6, "drift_of_momentum_of_" + GetParam().name,
               norm(after.linear - before.linear) / before.linear_scale, 1e-12);
  if (settings.phi() > 1 || !settings.rotation) return;
  expect_below(6, "drift_of_angular_momentum_of_" + GetParam().name,
               norm(after.angular - before.angular) / before.angular_scale, 1e-11);
}

INSTANTIATE_TEST_SUITE_P(models, SetUps, testing::ValuesIn(set_ups()),
                         [](const auto &one) { return one.param.name; });

double resident_megabytes() {
  std::ifstream statm("/proc/self/statm");
  double total = 0, resident = 0;
  statm >> total >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE)) * 1e-6;
}

// Runs are millions of loops long: nothing may be left behind by one, whatever the number of threads.
TEST(threads, loops_leave_no_memory_behind) {
  std::vector<double> rows(8 * block_rows);
  const auto loops = [&](int count) {
    for (int k = 0; k < count; ++k)
      for_each(rows.size(), [&](std::size_t i) { rows[i] += 1; });
  };
  for (const int threads : {1, 2, 3, 4}) {
    const ThreadLimit limit(threads);
    loops(1000);
    const double before = resident_megabytes();
    ASSERT_GT(before, 0);
    loops(50000);
    EXPECT_LT(resident_megabytes() - before, 2) << threads; // a forgotten task each would be 6 MB and more
  }
}

} // namespace
} // namespace platen::dem::set_ups_test
