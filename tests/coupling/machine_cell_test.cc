// The machine's spring behind the top platen of a cell: the stress keeps up with the rising pressure through
// springs of any stiffness, on the skin and in a sleeve, whatever the platen is.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/coupling/set_ups.h"

namespace platen::coupling {
namespace {

constexpr double pressure = 4e6; // Pa

PlatenTestSettings in_cell(double machine, bool sleeve = false) {
  PlatenTestSettings s = elastic_settings(0.3);
  s.platens.damping = 0;
  for (PlatenSide *end : {&s.platens.top, &s.platens.bottom})
    end->friction_static = end->friction_dynamic = 0.5;
  s.platens.machine.stiffness = machine;
  s.loading.cell.emplace().pressure = pressure;
  if (!sleeve) return s;
  SleeveSettings &rubber = s.loading.cell->sleeve.emplace();
  rubber.thickness = 1e-3;
  rubber.poisson_ratio = 0.49;
  return s;
}

// N/m, of the specimen: some 20 GPa.
const double stiffness = 20e9 * coarse_cylinder().shape.cross_section() / coarse_cylinder().shape.height;

// Until the platens take over: how far the stress is off the pressure, as a share of the whole one.
struct Consolidation {
  double most = 0, end = 0;
};
Consolidation consolidate(PlatenTest &test) {
  Consolidation off;
  while (!test.axial_stage() && test.time() < 4 * test.cell_ramp()) {
    test.advance(1);
    off.end = (test.axial_stress() - test.confining_pressure()) / pressure;
    off.most = std::max(off.most, std::abs(off.end));
  }
  EXPECT_TRUE(test.axial_stage());
  return off;
}

void keeps_up(const PlatenTestSettings &settings, const std::string &what, double within = 0.02,
              double ramps = 1.2) {
  PlatenTest test(coarse_cylinder(), settings);
  const Consolidation off = consolidate(test);
  EXPECT_LT(off.most, within) << what;
  EXPECT_LT(std::abs(off.end), 0.01) << what;
  EXPECT_LT(test.time(), ramps * test.cell_ramp()) << what;
  EXPECT_LT(residual(test), 1e-3) << what;
}

TEST(machine_cell, the_stress_keeps_up_with_the_pressure) {
  for (const bool sleeve : {false, true})
    for (const double ratio : {0.0, 0.1, 0.3, 1.0, 10.0}) // 0: a rigid machine
      keeps_up(in_cell(ratio > 0 ? ratio * stiffness : not_given, sleeve),
               (sleeve ? "sleeve " : "skin ") + std::to_string(ratio));
}

TEST(machine_cell, so_it_does_with_slow_servos_and_heavy_platens) {
  for (const bool heavy : {false, true}) {
    PlatenTestSettings settings = in_cell(0.3 * stiffness);
    settings.loading.servo_gain = heavy ? 10 : 1;
    settings.platens.machine.mass = heavy ? 0.5 : 0.01;
    keeps_up(settings, heavy ? "heavy" : "slow");
  }
}

// On a rigid machine too; a slow one gets a longer ramp, and does as well.
TEST(machine_cell, slow_and_quick_servos_keep_up_with_the_pressure) {
  for (const double gain : {0.1, 1.0, 10.0}) {
    PlatenTestSettings settings = in_cell(not_given);
    settings.loading.servo_gain = gain;
    keeps_up(settings, "gain " + std::to_string(gain), 0.05, 1.5);
  }
}

// As quick as on a rigid machine, though the servo is told of it in half the ramp and more.
TEST(machine_cell, so_it_does_in_a_short_ramp) {
  for (const double ratio : {0.03, 0.3}) {
    PlatenTestSettings settings = in_cell(ratio * stiffness);
    settings.loading.cell->ramp = 2e-4;
    keeps_up(settings, "ramp " + std::to_string(ratio), 0.04);
  }
}

TEST(machine_cell, whatever_the_platen_is) {
  for (const PlatenKind &kind : {on_seat, yielding, followed, yielding_on_seat})
    keeps_up(with(in_cell(0.3 * stiffness, kind.quasi_static || (kind.elastic && kind.seat)), kind),
             kind.name);
}

// Where a stage asks the bottom platen, the spring behind the top one is in series all the same.
TEST(machine_cell, a_stage_asks_either_platen) {
  for (const SideGroup side : {SideGroup::top, SideGroup::bottom, SideGroup::axial}) {
    PlatenTestSettings settings = in_cell(0.3 * stiffness);
    StageSettings &stage = settings.loading.stages.emplace_back();
    stage.asks = {asked_of(SideGroup::lateral, SideAsk::Ask::pressure, pressure),
                  asked_of(side, SideAsk::Ask::stress, pressure)};
    stage.until = {{Until::Reached::settled}};
    PlatenTest test(coarse_cylinder(), settings);
    double most = 0;
    while (!test.program().finished()) {
      test.advance(1);
      most = std::max(most, std::abs(test.axial_stress() - test.confining_pressure()) / pressure);
    }
    EXPECT_LT(most, 0.05) << static_cast<int>(side);
    EXPECT_NEAR(test.axial_stress() / pressure, 1, 0.01) << static_cast<int>(side);
  }
}

} // namespace
} // namespace platen::coupling
