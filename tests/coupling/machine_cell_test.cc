// The machine's spring behind the top platen of a cell: the stress keeps up with the rising pressure through
// springs of any stiffness, on the skin and in a sleeve, whatever the platen is.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/coupling/set_ups.h"

namespace platen::coupling::machine_cell_test {
namespace {

constexpr double pressure = 4e6; // Pa

PlatenTestSettings in_cell(double machine, bool sleeve = false) {
  PlatenTestSettings s = elastic_settings(0.3);
  s.platens.damping = 0;
  for (PlatenSide *end : {&s.platens.top, &s.platens.bottom})
    end->friction_static = end->friction_dynamic = 0.5;
  s.platens.machine.stiffness = machine;
  press(s, pressure);
  if (sleeve) wrap(s, 1e-3, 0.49);
  return s;
}

// N/m, of the specimen: some 20 GPa.
const double stiffness = 20e9 * coarse_cylinder().shape.cross_section() / coarse_cylinder().shape.height;

// The largest difference of stress and pressure until the platens take over, as a share of the whole
// pressure.
struct Way {
  std::string what;
  PlatenTestSettings settings;
  double within = 0.02, ramps = 1.2;
};
void expect_to_keep_up(const Way &way) {
  PlatenTest test(coarse_cylinder(), way.settings);
  double most = 0, end = 0;
  while (!test.axial_stage() && test.time() < 4 * test.cell_ramp()) {
    test.advance(1);
    end = (test.axial_stress() - test.confining_pressure()) / pressure;
    most = std::max(most, std::abs(end));
  }
  EXPECT_TRUE(test.axial_stage()) << way.what;
  EXPECT_LT(most, way.within) << way.what;
  EXPECT_LT(std::abs(end), 0.01) << way.what;
  EXPECT_LT(test.time(), way.ramps * test.cell_ramp()) << way.what;
  EXPECT_LT(residual(test), 1e-3) << way.what;
}

TEST(machine_cell, the_stress_keeps_up_with_the_pressure) {
  for (const bool sleeve : {false, true})
    for (const double ratio : {0.0, 0.1, 0.3, 1.0, 10.0}) // 0: a rigid machine
      expect_to_keep_up({(sleeve ? "sleeve " : "skin ") + std::to_string(ratio),
                         in_cell(ratio > 0 ? ratio * stiffness : not_given, sleeve)});
}

// On a rigid machine too a slow servo gets a longer ramp, and does as well. In a short ramp it is as quick as
// on a rigid machine, though it is told of the pressure in half the ramp and more.
TEST(machine_cell, slow_and_quick_servos_keep_up_with_the_pressure) {
  std::vector<Way> ways{{"slow", in_cell(0.3 * stiffness)}, {"heavy", in_cell(0.3 * stiffness)}};
  ways[0].settings.loading.servo_gain = 1, ways[0].settings.platens.machine.mass = 0.01;
  ways[1].settings.loading.servo_gain = 10, ways[1].settings.platens.machine.mass = 0.5;
  for (const double gain : {0.1, 1.0, 10.0}) {
    ways.push_back({"gain " + std::to_string(gain), in_cell(not_given), 0.05, 1.5});
    ways.back().settings.loading.servo_gain = gain;
  }
  for (const double ratio : {0.03, 0.3}) {
    ways.push_back({"short ramp " + std::to_string(ratio), in_cell(ratio * stiffness), 0.04});
    ways.back().settings.loading.cell->ramp = 2e-4;
  }
  for (const Way &way : ways)
    expect_to_keep_up(way);
}

TEST(machine_cell, whatever_the_platen_is) {
  for (const PlatenKind &kind : {on_seat, yielding, followed, yielding_on_seat})
    expect_to_keep_up(
        {kind.name, with(in_cell(0.3 * stiffness, kind.quasi_static || (kind.elastic && kind.seat)), kind)});
}

// Where a stage controls the bottom platen, the spring behind the top one is in series all the same.
TEST(machine_cell, a_stage_asks_either_platen) {
  for (const SideGroup side : {SideGroup::top, SideGroup::bottom, SideGroup::axial}) {
    PlatenTestSettings settings = in_cell(0.3 * stiffness);
    settings.loading.stages = {asking({asked_of(SideGroup::lateral, SideControl::Mode::pressure, pressure),
                                       asked_of(side, SideControl::Mode::stress, pressure)})};
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
} // namespace platen::coupling::machine_cell_test
