// Which stages load the axis of a test on: what falls in another, or with other sides, falls by command.
#include "tests/coupling/seen.h"

#include <gtest/gtest.h>

#include "coupling/platen_test.h"
#include "coupling/program/widening_task.h"
#include "tests/coupling/set_ups.h"

namespace platen::coupling::loads_test {
namespace {

using namespace seen;
using Mode = SideControl::Mode;

constexpr double compression = 1, tension = -1;

TEST(loads, a_rate_loads_on_in_the_sense_of_the_test) {
  const auto drive = drive_of_both();
  const RateTask closes(drive, 0.08, 0), parts(drive, -0.08, 0);
  EXPECT_EQ(closes.loads(compression), Loads::by_closure);
  EXPECT_EQ(parts.loads(compression), Loads::none);
  EXPECT_EQ(closes.loads(tension), Loads::none);
  EXPECT_EQ(parts.loads(tension), Loads::by_closure);
  EXPECT_EQ(HoldTask(axial, 0).loads(compression), Loads::none);
  EXPECT_EQ(WideningTask({axial, 0.1, 0, 1e-5, 0.1}).loads(compression), Loads::by_widening);
}

// What is asked again within the 1 % that counts as reached is no lower stress.
TEST(loads, a_stress_loads_on_where_it_is_not_below_what_is_found) {
  const auto loads = [](double found, double value, double sense = compression) {
    Seen seen;
    seen.stress = found;
    const StressTask::Parameters p = stress_of(value);
    StressTask task(p);
    task.begin(seen, 0, {});
    return task.loads(sense);
  };
  EXPECT_EQ(loads(0, 5e6), Loads::by_stress);
  EXPECT_EQ(loads(5e6, 5e6), Loads::by_stress);
  EXPECT_EQ(loads(5e6, 4.96e6), Loads::by_stress);
  EXPECT_EQ(loads(5e6, 4.94e6), Loads::none);
  EXPECT_EQ(loads(0, 0), Loads::none); // free
  EXPECT_EQ(loads(0, 5e6, tension), Loads::none);
}

TEST(loads, a_share_of_another_stress_is_none) {
  StressTask::Parameters p;
  p.platens = top;
  p.value = 1;
  p.followed = PlatensOfAxis{{lateral}, area, 0.1, 0};
  p.lag = 1e-4;
  p.servo = {10, 0.1};
  EXPECT_EQ(StressTask(p).loads(compression), Loads::none);
}

// After an unloading that begins a test, loading is no part of a cycle.
TEST(loads, an_unloading_that_comes_first_does_not_turn_the_sense_of_the_test) {
  Seen seen;
  const auto drive = drive_of_both();
  drive->set_rate(-0.08, 0, seen, 0);
  EXPECT_FALSE(drive->is_cycling(seen));
  drive->set_rate(0.08, 0, seen, 0);
  EXPECT_FALSE(drive->is_cycling(seen));
  seen.closure = 1e-3;
  drive->set_rate(-0.08, 0, seen, 0);
  EXPECT_TRUE(drive->is_cycling(seen));
  drive->set_rate(0.08, 0, seen, 0);
  seen.closure = 0.9e-3;
  EXPECT_TRUE(drive->is_cycling(seen));
  seen.closure = 1e-3;
  EXPECT_FALSE(drive->is_cycling(seen));
}

SideControl back() {
  SideControl one = asked_of(SideGroup::axial, Mode::rate);
  one.back = true;
  return one;
}

// A small cylinder in a cell, or a small cube between six platens.
class LoadsOfStages : public testing::Test {
protected:
  void add(const std::vector<SideControl> &controls) {
    stages_.push_back(asking(controls, {{Until::Reached::time, 1e-3}}));
  }
  std::unique_ptr<PlatenTest> made(bool boxed = false) const {
    PlatenTestSettings s = six_platens();
    s.time_step.fixed_step = 0;
    s.loading.rate = 0.1;
    s.loading.stages = stages_;
    for (auto *side : {&s.platens.left, &s.platens.right, &s.platens.front, &s.platens.back})
      if (!boxed) side->reset();
    if (!boxed) s.loading.cell.emplace();
    return std::make_unique<PlatenTest>(boxed ? cube() : cylinder(), s);
  }
  std::vector<StageSettings> stages_;
};

// Of stages that have not begun, once their ramps are over.
std::vector<Loads> loads_of(const PlatenTest &test) {
  Seen later;
  later.now = 1;
  std::vector<Loads> all;
  for (std::size_t k = 0; k < test.program().stage_count(); ++k)
    all.push_back(test.program().stage(k).loads(later));
  return all;
}
std::vector<int> settings_of(const PlatenTest &test) {
  std::vector<int> all;
  for (std::size_t k = 0; k < test.program().stage_count(); ++k)
    all.push_back(test.program().stage(k).setting());
  return all;
}

const SideControl drive = asked_of(SideGroup::axial, Mode::rate);
SideControl pressure(double value) {
  return asked_of(SideGroup::lateral, Mode::pressure, value);
}

TEST_F(LoadsOfStages, the_sides_count_where_they_are_asked_something_else) {
  add({pressure(2e6), asked_of(SideGroup::top, Mode::stress, 2e6)}); // consolidates
  add({drive});
  add({back()});
  add({drive, pressure(2e6)});
  add({pressure(5e6), asked_of(SideGroup::axial, Mode::stress, 5e6)});
  add({asked_of(SideGroup::axial, Mode::circumferential, 0.1)});
  add({asked_of(SideGroup::lateral, Mode::fraction, 0.1)});
  add({pressure(5e6)});
  const auto test = made();
  const Loads none = Loads::none, closure = Loads::by_closure;
  EXPECT_EQ(loads_of(*test), (std::vector<Loads>{none, closure, none, closure, Loads::by_stress,
                                                 Loads::by_widening, none, none}));
  EXPECT_EQ(settings_of(*test), (std::vector<int>{1, 1, 1, 1, 2, 2, 3, 4}));
}

// A circumferential rate reaches its strain in that over the rate, and half of the ramp more.
TEST_F(LoadsOfStages, a_circumferential_stage_is_as_long_as_its_strain_at_its_rate) {
  add({asked_of(SideGroup::axial, Mode::circumferential, 0.1)});
  stages_.back().ramp = 2e-4;
  stages_.back().until = {{Until::Reached::circumferential_strain, 3e-4}};
  EXPECT_DOUBLE_EQ(made()->program().stage(0).expected_seconds(), 1e-4 + 3e-4 / 0.1);
}

// While it is on its way, the stress of the axis may fall with it.
TEST_F(LoadsOfStages, within_the_ramp_of_another_pressure_none_loads_on) {
  add({drive, pressure(5e6)});
  stages_.back().ramp = 1e-4;
  add({drive, pressure(5e6)});
  const auto test = made();
  Seen seen;
  seen.now = 0.9e-4;
  EXPECT_EQ(test->program().stage(0).loads(seen), Loads::none);
  EXPECT_EQ(test->program().stage(1).loads(seen), Loads::by_closure);
  seen.now = 1.1e-4;
  EXPECT_EQ(test->program().stage(0).loads(seen), Loads::by_closure);
}

// A share from the start follows; one that comes later changes what the sides bear.
TEST_F(LoadsOfStages, a_share_on_the_sides_from_the_start_changes_nothing_on_its_way) {
  const SideControl half = asked_of(SideGroup::lateral_x, Mode::fraction, 0.5);
  for (const bool first : {true, false}) {
    stages_.clear();
    if (!first) add({drive, asked_of(SideGroup::lateral_x, Mode::stress, 1e6)});
    add({drive, half});
    add({drive, half});
    const auto test = made(true);
    Seen seen;
    seen.now = 1e-9;
    EXPECT_EQ(test->program().stage(first ? 0 : 1).loads(seen), first ? Loads::by_closure : Loads::none);
    EXPECT_EQ(test->program().stage(first ? 1 : 2).loads(seen), Loads::by_closure);
  }
}

TEST_F(LoadsOfStages, platens_that_part_on_any_side_load_nothing_on) {
  SideControl sides_back = back();
  sides_back.side = SideGroup::lateral_x;
  add({drive, sides_back});
  add({asked_of(SideGroup::top, Mode::rate, 0.1), asked_of(SideGroup::bottom, Mode::free)});
  add({asked_of(SideGroup::top, Mode::rate, 0.1)});
  add({asked_of(SideGroup::top, Mode::rate, 0.1), asked_of(SideGroup::bottom, Mode::stress, 5e6)});
  add({asked_of(SideGroup::top, Mode::rate, 0.1), asked_of(SideGroup::bottom, Mode::stress, 0)});
  add({asked_of(SideGroup::top, Mode::stress, 0), asked_of(SideGroup::bottom, Mode::rate, 0.1)});
  const auto test = made(true);
  EXPECT_EQ(loads_of(*test), (std::vector<Loads>{Loads::none, Loads::none, Loads::by_closure,
                                                 Loads::by_stress, Loads::none, Loads::none}));
}

} // namespace
} // namespace platen::coupling::loads_test
