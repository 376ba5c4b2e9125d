// What each controlled quantity of a stage tells: what was asked, what was reached, and whether that is met.
#include "tests/coupling/seen.h"

#include <gtest/gtest.h>

#include <limits>

#include "coupling/program/widening_task.h"

namespace platen::coupling::controlled_test {
namespace {

using namespace seen;

// Platen 2 bears a stress of its own.
struct Beside : Seen {
  Beside(double axial_stress, double left_stress) : left(left_stress) { stress = axial_stress, now = 1; }
  double load(std::size_t boundary) const override { return area * (boundary == 2 ? left : stress); }
  double left;
};
const PlatensOfAxis left_one{{2}, area, 0.1, 0};

Seen at(double now, double stress, double pressure) {
  Seen s;
  s.now = now, s.stress = stress, s.pressure = pressure;
  return s;
}

// Just within a hundredth of what is asked, and just beyond.
void expect_told(const Task &task, const Seen &within, const Seen &beyond, const Controlled &told) {
  const std::optional<Controlled> near = task.controlled(within), far = task.controlled(beyond);
  ASSERT_TRUE(near && far) << told.quantity;
  EXPECT_EQ(near->quantity, told.quantity);
  EXPECT_EQ(near->side, told.side) << told.quantity;
  EXPECT_EQ(near->unit, told.unit) << told.quantity;
  EXPECT_EQ(near->axis, told.axis) << told.quantity;
  EXPECT_NEAR(near->target / told.target, 1, 1e-12) << told.quantity;
  EXPECT_NEAR(near->reached / told.reached, 1, 1e-12) << told.quantity;
  EXPECT_TRUE(near->is_met()) << told.quantity << ' ' << near->reached;
  EXPECT_FALSE(far->is_met()) << told.quantity << ' ' << far->reached;
  if (told.quantity != "stress") return;
  EXPECT_TRUE(task.has_settled(within));
  EXPECT_FALSE(task.has_settled(beyond));
}

TEST(controlled, a_stress_is_met_within_a_hundredth) {
  expect_told(*stress_on_top(5e6, 0), at(1, 4.951e6, 0), at(1, 4.949e6, 0),
              {"stress", "top", "Pa", 2, false, 5e6, 4.951e6});
  expect_told(*stress_on_top(5e6, 0), at(1, 5.049e6, 0), at(1, 5.051e6, 0),
              {"stress", "top", "Pa", 2, false, 5e6, 5.049e6});
  expect_told(*stress_on_top(-5e6, 0), at(1, -4.951e6, 0), at(1, -4.949e6, 0),
              {"stress", "top", "Pa", 2, false, -5e6, -4.951e6}); // pulled
}

TEST(controlled, a_share_is_told_as_the_stress_that_it_asks) {
  StressTask::Parameters p;
  p.quantity = "share of axial", p.side = "left", p.value = 0.5, p.servo = {10, 1};
  p.platens = left_one, p.followed = axial, p.lag = 1e-5;
  expect_told(StressTask(p), Beside(8e6, 4.039e6), Beside(8e6, 4.041e6),
              {"share of axial", "left", "Pa", 0, false, 4e6, 4.039e6});
  PressureTask::Parameters cell = to(0.25, 0);
  cell.quantity = "share of axial", cell.followed = axial, cell.lag = 1e-5;
  expect_told(PressureTask(cell), at(1, 8e6, 2.019e6), at(1, 8e6, 2.021e6),
              {"share of axial", "lateral", "Pa", Controlled::around, false, 2e6, 2.019e6});
}

TEST(controlled, a_pressure_is_the_one_that_acts) {
  const Controlled told{"pressure", "lateral", "Pa", Controlled::around, false, 3e6, 2.971e6};
  expect_told(PressureTask(to(3e6, 1e-3)), at(1, 0, 2.971e6), at(1, 0, 2.969e6), told);
  Transfer from = after_pressure(3e6);
  HoldPressureTask held(lateral);
  held.begin(Seen{}, 0, from);
  expect_told(held, at(1, 0, 2.971e6), at(1, 0, 2.969e6), told);
  EXPECT_TRUE(held.controlled(Seen{})->constant);
  EXPECT_FALSE(PressureTask(to(3e6, 1e-3)).controlled(Seen{})->constant);
}

// 3 MPa and half of the deviator, of 3.06 MPa at a pressure of 4.53.
TEST(controlled, a_path_asks_by_the_deviator_that_there_is) {
  PressureTask::Parameters p = to(3e6, 0);
  p.quantity = "stress path", p.path = 0.5, p.lag = 1e-5;
  expect_told(PressureTask(p), at(1, 7.59e6, 4.53e6), at(1, 7.59e6, 4.57e6),
              {"stress path", "lateral", "Pa", Controlled::around, false, 4.53e6, 4.53e6});
  EXPECT_NEAR(PressureTask(p).controlled(at(1, 7.59e6, 4.57e6))->target, 4.51e6, 1);
  p.path = -0.5; // never negative
  EXPECT_EQ(PressureTask(p).controlled(at(1, 20e6, 0))->target, 0);
}

// 3 per cent of the stress that it had is not yet nothing; half a one is.
TEST(controlled, nothing_is_a_hundredth_of_what_there_was) {
  StressTask::Parameters p;
  p.platens = left_one, p.side = "left", p.value = 0, p.servo = {10, 1};
  StressTask task(p);
  task.begin(Beside(1e6, 4e6), 0, {});
  EXPECT_FALSE(task.controlled(Beside(1e6, 0.12e6))->is_met());
  EXPECT_TRUE(task.controlled(Beside(1e6, 0.02e6))->is_met());
  EXPECT_TRUE(task.controlled(Beside(12e6, 0.12e6))->is_met()); // of the axial stress
  StressTask free(p);
  free.begin(Beside(0, 0), 0, {});
  EXPECT_TRUE(free.controlled(Beside(0, 0))->is_met());
}

// The machine closes by 8e-5 m in 1 ms; the faces, 0.1 m apart, by what they strain.
TEST(controlled, a_rate_is_that_of_the_faces) {
  for (const double sign : {1.0, -1.0}) {
    RateTask task(drive_of_both(), sign * 0.08, 0, "axial");
    Seen seen;
    seen.closure = 3e-4;
    seen.now = 1;
    task.begin(seen, 1, {});
    EXPECT_FALSE(task.controlled(seen)); // no step has been made
    Commands asked(3);
    for (int n = 1; n <= 1000; ++n)
      seen.now = 1 + n * dt, task.command(seen, asked);
    const auto closed = [&](double share) {
      Seen s = seen;
      s.closure += sign * share * 8e-4;
      return s;
    };
    expect_told(task, closed(0.9905), closed(0.9895),
                {"rate", "axial", "m/s", 2, false, sign * 0.08, sign * 0.9905 * 0.08});
  }
}

TEST(controlled, a_circumferential_rate_is_the_mean_of_the_stage) {
  WideningTask task({axial, 2, 1e-3, 1e-5, 5});
  Seen seen;
  seen.wider = 3e-4;
  task.begin(seen, 0, {});
  EXPECT_FALSE(task.controlled(seen));
  const double gained = 2 * (0.5e-3 + 3e-3); // the ramp counts half
  const auto wide = [&](double share) {
    Seen s = seen;
    s.now = 4e-3, s.wider += share * gained;
    return s;
  };
  expect_told(task, wide(1.0099), wide(1.0101),
              {"circumferential rate", "axial", "1/s", 2, false, gained / 4e-3, 1.0099 * gained / 4e-3});
}

TEST(controlled, what_is_not_finite_is_not_met) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN(),
                   endless = std::numeric_limits<double>::infinity();
  const auto met = [](double asked, double reached, double whole) {
    Controlled c;
    c.target = asked, c.reached = reached, c.reference = whole;
    return c.is_met();
  };
  EXPECT_TRUE(met(1, 1.009, 1));
  EXPECT_FALSE(met(none, none, none));
  EXPECT_FALSE(met(1, none, 1));
  EXPECT_FALSE(met(endless, endless, endless));
  EXPECT_FALSE(met(1, endless, 1));
  EXPECT_FALSE(met(1, 1, none));
}

// Which stage was on: at the end of one that one, not the next.
TEST(controlled, stages_are_found_by_the_time) {
  Seen seen;
  Stages stages = list_of(consolidation(4e6));
  stages.push_back(stage_of("compression", one_task(std::make_unique<HoldPressureTask>(lateral)),
                            ends_at(Until::Reached::time, 1)));
  Program program(seen, std::move(stages));
  ask(program);
  EXPECT_EQ(program.stage_at(2e-3), 0u);
  seen.now = 2e-3, seen.stress = seen.pressure = 4e6;
  program.update();
  ASSERT_EQ(program.stage_number(), 1u);
  EXPECT_EQ(program.stage_at(0), 0u);
  EXPECT_EQ(program.stage_at(2e-3), 0u);
  EXPECT_EQ(program.stage_at(2.001e-3), 1u);
}

// A servo that is to lead to 9 MPa, and is stopped at 5, was asked for 5.
TEST(controlled, a_stage_that_ends_at_a_stress_asks_no_more) {
  for (const bool by_stress : {true, false}) {
    Seen seen;
    Tasks tasks;
    tasks.push_back(stress_on_top(9e6, 1e-3));
    StageEnd::Parameters end;
    end.any = {by_stress ? until(Until::Reached::stress, 5e6) : until(Until::Reached::time, 1e-3)};
    Program program(seen, list_of(stage_of("stress", std::move(tasks), end)));
    seen.now = dt, ask(program);
    seen.now = 1e-3, seen.stress = 5.01e6;
    program.update();
    ASSERT_TRUE(program.finished());
    const std::vector<Controlled> told = program.controls(0);
    ASSERT_EQ(told.size(), 1u);
    EXPECT_EQ(told[0].target, by_stress ? 5e6 : 9e6);
    EXPECT_EQ(told[0].is_met(), by_stress);
  }
}

} // namespace
} // namespace platen::coupling::controlled_test
