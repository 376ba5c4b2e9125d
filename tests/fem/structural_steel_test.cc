// Hardening of three steels: numbers computed by hand from the formulas of structural_steel.h.
#include "fem/materials/structural_steel.h"

#include <gtest/gtest.h>

#include <array>

namespace platen::fem::structural_steel_test {
namespace {

struct Steel {
  double yield, ultimate; // Pa
  std::array<Hardening::Point, 3> points;
};

// S355: e_sh at its lower bound, f_C1 = 451.9 MPa at C1 e_u = .0568, e_u = .1824. The second: e_sh = .025,
// e_u = .12. The third: e_sh = .03 and e_u = .06 at their bounds.
const Steel steels[] = {
    {355e6, 510e6, {{{0.0131728, 360.3250e6}, {0.0530076, 477.5588e6}, {0.1646350, 603e6}}}},
    {400e6, 500e6, {{{0.0227402, 410e6}, {0.0452892, 485.0469e6}, {0.1106620, 560e6}}}},
    {475e6, 500e6, {{{0.0272290, 489.25e6}, {0.0343901, 509.0234e6}, {0.0557451, 530e6}}}}};

TEST(structural_steel, has_the_lines_of_yun_and_gardner_in_true_stress) {
  for (const Steel &steel : steels) {
    const Hardening hardening = structural_steel(steel.yield, steel.ultimate, 210e9);
    ASSERT_EQ(hardening.count, 4u);
    EXPECT_NO_THROW(hardening.require_valid());
    EXPECT_EQ(hardening.points[0].strain, 0);
    EXPECT_EQ(hardening.yield_strength(), steel.yield);
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_NEAR(hardening.points[k + 1].strain, steel.points[k].strain, 1e-7) << steel.yield << ' ' << k;
      EXPECT_NEAR(hardening.points[k + 1].stress, steel.points[k].stress, 100) << steel.yield << ' ' << k;
    }
    EXPECT_EQ(hardening.at(0.5).stress, hardening.points[3].stress);
  }
}

} // namespace
} // namespace platen::fem::structural_steel_test
