// Which balls of a run of members are near one: a plain loop says, and every instruction set agrees.
#include <gtest/gtest.h>

#include <cstddef>
#include <vector>

#include "base/random.h"
#include "dem/instruction_set.h"
#include "dem/kernels/near_kernel.h"

namespace platen::dem::kernels {
namespace {

std::vector<std::pair<const char *, FindNear>> kernels_here() {
  std::vector<std::pair<const char *, FindNear>> all{{"baseline", find_near_baseline}};
  const InstructionSet best = best_instruction_set();
  if (best != InstructionSet::baseline) all.push_back({"avx2", find_near_avx2});
  if (best == InstructionSet::avx512) all.push_back({"avx512", find_near_avx512});
  return all;
}

// Members with room after them that would be near if it were looked at.
struct Members {
  std::vector<float> x, y, z, reach;
  std::vector<int> ball;

  NearColumns columns() const { return {x.data(), y.data(), z.data(), reach.data(), ball.data()}; }
  void add(float at_x, float at_y, float at_z, float far, int number) {
    x.push_back(at_x), y.push_back(at_y), z.push_back(at_z), reach.push_back(far), ball.push_back(number);
  }
  void add_spare() {
    for (std::size_t k = 0; k < near_spare; ++k)
      add(0, 0, 0, 100, 777);
  }
};

std::vector<int> found_by(FindNear find, const Members &m, const NearBall &own, int first, int last) {
  std::vector<int> found(static_cast<std::size_t>(last - first) + near_spare, -1);
  found.resize(find(m.columns(), own, first, last, found.data()));
  return found;
}

TEST(NearKernel, finds_what_a_plain_loop_finds_in_runs_of_every_length) {
  constexpr int n = 40;
  Random random(4);
  const auto anywhere = [&] { return static_cast<float>(random.uniform(-2, 2)); };
  Members m;
  for (int k = 0; k < n; ++k)
    m.add(anywhere(), anywhere(), anywhere(), static_cast<float>(random.uniform(0.2, 1.5)), 1000 - 7 * k);
  m.add_spare();
  const NearBall own{0.3F, -0.2F, 0.1F, 0.9F, 1000 - 7 * 11}; // member 11 is the ball itself
  for (int first = 0; first < n; ++first)
    for (int last = first; last <= n; ++last) {
      std::vector<int> expected;
      for (int k = first; k < last; ++k) {
        const double x = m.x[k] - 0.3, y = m.y[k] + 0.2, z = m.z[k] - 0.1, far = m.reach[k] + 0.9;
        if (k != 11 && x * x + y * y + z * z < far * far) expected.push_back(m.ball[k]);
      }
      for (const auto &[name, find] : kernels_here())
        EXPECT_EQ(found_by(find, m, own, first, last), expected) << name << ' ' << first << ' ' << last;
    }
}

// Exact in single precision: 3, 4 and 12 are 13 away.
TEST(NearKernel, leaves_out_what_just_meets) {
  Members m;
  m.add(3, 4, 12, 8, 0), m.add(3, 4, 12, 8.001F, 1), m.add(-3, -4, -12, 7.999F, 2),
      m.add(3, -4, 12, 8.001F, 3);
  m.add_spare();
  for (const auto &[name, find] : kernels_here())
    EXPECT_EQ(found_by(find, m, {0, 0, 0, 5, 9}, 0, 4), (std::vector<int>{1, 3})) << name;
}

} // namespace
} // namespace platen::dem::kernels
