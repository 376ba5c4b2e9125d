// The machine's spring behind the top platen of a cell: the stress keeps up with the rising pressure through
// springs of any stiffness, on the skin and in a sleeve, whatever the platen is.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "coupling/boundaries/machine_spring.h"
#include "dem/packing/growth.h"
#include "tests/coupling/elastic_problem.h"
#include "tests/coupling/on_machine.h"
#include "tests/same_state.h"

namespace platen::coupling {
namespace {

constexpr double pressure = 4e6; // Pa

const dem::Specimen &specimen() {
  static const dem::Specimen s = dem::random_close_packing(dem::cylinder(6e-3, 12e-3), 1.3e-3, 0.25, 7);
  return s;
}

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
const double stiffness = 20e9 * specimen().shape.cross_section() / specimen().shape.height;

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

void keeps_up(const PlatenTestSettings &settings, const std::string &what, double within = 0.02) {
  PlatenTest test(specimen(), settings);
  const Consolidation off = consolidate(test);
  EXPECT_LT(off.most, within) << what;
  EXPECT_LT(std::abs(off.end), 0.01) << what;
  EXPECT_LT(test.time(), 1.2 * test.cell_ramp()) << what;
  EXPECT_LT(std::abs(test.energy().residual() + test.energy().unbalanced), 1e-3 * test.energy().boundary)
      << what;
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

// As quick as on a rigid machine, though the servo is told of it in half the ramp and more.
TEST(machine_cell, so_it_does_in_a_short_ramp) {
  for (const double ratio : {0.03, 0.3}) {
    PlatenTestSettings settings = in_cell(ratio * stiffness);
    settings.loading.cell->ramp = 2e-4;
    keeps_up(settings, "ramp " + std::to_string(ratio), 0.04);
  }
}

// Rigid, on a seat, elastic with inertia or without, or on a seat too.
PlatenTestSettings as_kind(PlatenTestSettings settings, int kind) {
  settings.platens.spherical_seat = kind == 1 || kind == 4;
  if (kind < 2) return settings;
  settings.platens.elastic.emplace().motion =
      kind == 3 ? fem::ElasticMotion::quasi_static : fem::ElasticMotion::explicit_steps;
  return settings;
}
constexpr int kinds = 5;

TEST(machine_cell, whatever_the_platen_is) {
  for (int kind = 1; kind < kinds; ++kind)
    keeps_up(as_kind(in_cell(0.3 * stiffness, kind > 2), kind), "kind " + std::to_string(kind));
}

// Where a stage asks the bottom platen, the spring behind the top one is in series all the same.
TEST(machine_cell, a_stage_asks_either_platen) {
  for (const SideGroup side : {SideGroup::top, SideGroup::bottom, SideGroup::axial}) {
    PlatenTestSettings settings = in_cell(0.3 * stiffness);
    StageSettings &stage = settings.loading.stages.emplace_back();
    SideAsk ask;
    ask.side = SideGroup::lateral, ask.ask = SideAsk::Ask::pressure, ask.value = pressure;
    stage.asks = {ask};
    ask.side = side, ask.ask = SideAsk::Ask::stress;
    stage.asks.push_back(ask);
    stage.until = {{Until::Reached::settled}};
    PlatenTest test(specimen(), settings);
    double most = 0;
    while (!test.program().finished()) {
      test.advance(1);
      most = std::max(most, std::abs(test.axial_stress() - test.confining_pressure()) / pressure);
    }
    EXPECT_LT(most, 0.05) << static_cast<int>(side);
    EXPECT_NEAR(test.axial_stress() / pressure, 1, 0.01) << static_cast<int>(side);
  }
}

TEST(machine_cell, a_stop_and_threads_change_nothing) {
  for (int kind = 0; kind < kinds; ++kind)
    for (const bool sleeve : {false, true}) {
      PlatenTestSettings settings = crushing(1e8);
      settings.loading.cell = in_cell(1e8, sleeve).loading.cell;
      settings.loading.cell->ramp = 1e-4;
      settings = as_kind(settings, kind);
      const ThreadLimit one(1);
      PlatenTest whole(cylinder(), settings), first(cylinder(), settings);
      steps_to(whole, 1000);
      steps_to(first, 613); // within an interval of the sleeve, and in the middle of the loads' mean
      EXPECT_NE(first.machine()->compression(), 0);
      for (const int threads : {1, 2}) {
        const ThreadLimit limit(threads);
        PlatenTest second(cylinder(), settings);
        set_state(second, state_of(first));
        steps_to(second, 1000);
        // But for rows of contacts: which particles are listed as near depends on when that was done.
        EXPECT_TRUE(same_state(without(state_of(whole), "/contacts/rows/"),
                               without(state_of(second), "/contacts/rows/")))
            << kind << sleeve << threads;
        EXPECT_EQ(whole.energy().boundary, second.energy().boundary) << kind << sleeve << threads;
      }
    }
}

} // namespace
} // namespace platen::coupling
