// Loading stages: what they ask, when they end, how they follow each other, and that a stop changes nothing.
#include "coupling/program/program.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <utility>

#include "coupling/program/circumferential_task.h"
#include "coupling/program/drive.h"
#include "coupling/program/loading_stage.h"
#include "coupling/program/pressure_task.h"
#include "coupling/program/stress_task.h"
#include "tests/same_state.h"

namespace platen::coupling {
namespace {

constexpr double dt = 1e-6, area = 2e-4; // s, m^2

// A test as its program sees it, with numbers set by hand.
struct Seen : Measures {
  double now = 0, closure = 0, stress = 0, pressure = 0, broken = 0, wider = 0;
  double time() const override { return now; }
  double time_step() const override { return dt; }
  double closure_strain() const override { return closure; }
  double closure_strain(int axis) const override { return axis == 2 ? closure : 0.1 * closure; }
  double circumferential_strain() const override { return wider; }
  double axial_stress() const override { return stress; }
  double lateral_pressure() const override { return pressure; }
  double broken_bonds() const override { return broken; }
  Vector3 force(std::size_t) const override { return {0, 0, stress * area}; }
  double load(std::size_t) const override { return stress * area; }
  Vector3 inward(std::size_t boundary) const override { return {0, 0, boundary == 0 ? 1. : -1.}; }
  ServoLoad servo_load(std::size_t) const override { return {1e8, 100}; }
};

const PlatensOfAxis axial{{0, 1}, area, 0.1, 2}, top{{1}, area, 0.1, 2};
constexpr std::size_t lateral = 2; // place of what presses the lateral surface

using Stages = std::vector<std::unique_ptr<Stage>>;
using Tasks = std::vector<std::unique_ptr<Task>>;

Until until(Until::Reached what, double value, double direction = 1) {
  return {what, value, axial, direction, true};
}

std::unique_ptr<Stage> stage_of(const std::string &name, Tasks tasks, const StageEnd::Parameters &end,
                                double expected = 0) {
  return std::make_unique<LoadingStage>(LoadingStage::Parameters{name, name == "consolidation", expected},
                                        std::move(tasks), StageEnd(end));
}

// Closes at a rate until a closure strain.
std::unique_ptr<Stage> at_rate(const std::shared_ptr<Drive> &drive, double rate, double ramp,
                               const Until &end) {
  Tasks tasks;
  tasks.push_back(std::make_unique<RateTask>(drive, rate, ramp));
  StageEnd::Parameters over;
  over.any = {end};
  over.ramp = ramp;
  return stage_of("compression", std::move(tasks), over, end.value * 0.1 / std::abs(rate));
}

std::shared_ptr<Drive> drive_of_both(const std::optional<RateControl::Parameters> &control = std::nullopt) {
  return std::make_shared<Drive>(Drive::Parameters{axial, control});
}

std::unique_ptr<Task> stress_on_top(double stress, double ramp) {
  StressTask::Parameters p;
  p.platens = top;
  p.side = "top";
  p.value = stress;
  p.ramp = ramp;
  p.servo = {10, 0.1};
  p.settled_by = {axial};
  return std::make_unique<StressTask>(p);
}

PressureTask::Parameters to(double pressure, double ramp) {
  PressureTask::Parameters p;
  p.place = lateral;
  p.value = pressure;
  p.ramp = ramp;
  return p;
}

// All sides alike within 1 ms, and .5 ms more.
std::unique_ptr<Stage> consolidation(double pressure) {
  Tasks tasks;
  tasks.push_back(std::make_unique<PressureTask>(to(pressure, 1e-3)));
  tasks.push_back(stress_on_top(pressure, 1e-3));
  StageEnd::Parameters end;
  end.any = {until(Until::Reached::settled, 0)};
  end.ramp = 1e-3, end.least = 1.5e-3, end.latest = 3e-3;
  return stage_of("consolidation", std::move(tasks), end, 1.5e-3);
}

Stages list_of(std::unique_ptr<Stage> one) {
  Stages stages;
  stages.push_back(std::move(one));
  return stages;
}

Commands ask(Program &program) {
  Commands asked(3);
  program.command(asked);
  return asked;
}

TEST(axial_rate, each_platen_goes_at_half_the_rate_from_a_smooth_start) {
  for (const double sign : {1.0, -1.0}) {
    Seen seen;
    const auto drive = drive_of_both();
    Program program(seen, list_of(at_rate(drive, sign * 0.08, 1e-3, until(Until::Reached::strain, 1e-3))),
                    {drive});
    for (const double x : {0.25, 0.5, 0.9}) { // of the ramp, in the middle of the step
      seen.now = x * 1e-3 + 0.5 * dt;
      const Commands asked = ask(program);
      const double speed = sign * 0.5 * 0.08 * x * x * (3 - 2 * x);
      EXPECT_NEAR(asked[1].velocity[2], -speed, 1e-12) << x;
      EXPECT_NEAR(asked[0].velocity[2], speed, 1e-12) << x;
    }
    seen.now = 2e-3;
    EXPECT_EQ(ask(program)[0].velocity[2], sign * 0.04);
    EXPECT_EQ(ask(program)[2].pressure, 0);
  }
}

TEST(axial_rate, ends_at_its_strain_and_goes_on_asking) {
  Seen seen;
  const auto drive = drive_of_both();
  Program program(seen, list_of(at_rate(drive, 0.08, 0, until(Until::Reached::strain, 1e-3))), {drive});
  seen.now = dt, ask(program);
  seen.closure = 0.999e-3;
  program.update();
  EXPECT_FALSE(program.finished());
  EXPECT_NEAR(program.progress(), 0.999, 1e-12);
  seen.closure = 1e-3;
  program.update();
  EXPECT_TRUE(program.finished());
  EXPECT_EQ(program.progress(), 1);
  EXPECT_EQ(ask(program)[0].velocity[2], 0.04);
  EXPECT_NEAR(program.expected_seconds(), 1e-3 * 0.1 / 0.08, 1e-15);
}

// Load to a strain, unload to a quarter of the stress there, load on.
Program turning(const Seen &seen, const std::shared_ptr<Drive> &drive, double ramp) {
  Stages stages;
  stages.push_back(at_rate(drive, 0.08, ramp, until(Until::Reached::strain, 4e-4)));
  stages.push_back(at_rate(drive, -0.08, ramp, until(Until::Reached::share_of_start, 0.25)));
  stages.push_back(at_rate(drive, 0.08, ramp, until(Until::Reached::strain, 1e-3)));
  return {seen, std::move(stages), {drive}};
}

TEST(axial_rate, turns_round_at_its_strain_and_back_at_the_share_of_the_stress) {
  Seen seen;
  Program program = turning(seen, drive_of_both(), 0);
  const auto at = [&](double closure, double stress) {
    seen.now += dt, ask(program);
    seen.closure = closure, seen.stress = stress;
    program.update();
    return ask(program)[0].velocity[2];
  };
  EXPECT_EQ(at(3.9e-4, 10e6), 0.04);
  EXPECT_FALSE(program.is_cycling());
  EXPECT_EQ(at(4e-4, 12e6), -0.04);
  EXPECT_TRUE(program.is_cycling());
  EXPECT_EQ(at(2e-4, 3.1e6), -0.04);
  EXPECT_EQ(at(1.9e-4, 3.0e6), 0.04); // a quarter of what it was at the turn
  EXPECT_TRUE(program.is_cycling());  // until the strain of the turn
  EXPECT_EQ(at(4e-4, 12e6), 0.04);    // and it turns round there once
  EXPECT_FALSE(program.is_cycling());
  EXPECT_EQ(program.stage_number(), 2u);
  EXPECT_FALSE(program.finished());
}

// From one rate to its opposite within the ramp, evenly; and to twice the rate without a jump.
TEST(axial_rate, a_change_of_the_rate_is_no_jump) {
  Seen seen;
  const auto drive = drive_of_both();
  const double ramp = 100 * dt;
  Program program = turning(seen, drive, ramp);
  const auto step = [&] {
    seen.now += dt;
    const double speed = ask(program)[0].velocity[2];
    program.update();
    return speed;
  };
  for (int n = 0; n < 150; ++n)
    step();
  seen.closure = 4e-4, seen.stress = 12e6;
  double before = step();
  EXPECT_EQ(before, 0.04);
  for (int n = 1; n <= 100; ++n) {
    const double speed = step();
    EXPECT_NEAR(speed, 0.04 * (1 - 0.02 * n), 1e-15) << n;
    before = speed;
  }
  EXPECT_NEAR(step(), -0.04, 1e-15);
  drive->ask(-0.16, ramp, seen, seen.now); // a stage that asks twice the rate
  seen.now += dt;
  EXPECT_NEAR(drive->speed(seen), -0.04 - 0.08 * 2.0 / 100, 1e-15);
}

TEST(stress, is_led_to_its_value_and_held_for_its_time) {
  for (const bool by_strain : {false, true}) {
    Seen seen;
    Tasks tasks;
    tasks.push_back(stress_on_top(5e6, 1e-3));
    StageEnd::Parameters end;
    end.any = {until(Until::Reached::time, 3e-3), until(Until::Reached::strain, 1e-2)};
    Program program(seen, list_of(stage_of("stress", std::move(tasks), end)));
    seen.now = by_strain ? 1e-4 : 2.9999e-3;
    EXPECT_LT(ask(program)[1].velocity[2], 0); // presses
    EXPECT_EQ(ask(program)[0].velocity[2], 0);
    program.update();
    EXPECT_FALSE(program.finished());
    (by_strain ? seen.closure = 1e-2 : seen.now = 3e-3);
    program.update();
    EXPECT_TRUE(program.finished());
  }
}

// The servo answers a share of the error; halfway through the ramp half of the change is asked.
TEST(stress, goes_from_what_it_finds_smoothly) {
  for (const double found : {0.0, 2e6, 8e6}) {
    Seen seen;
    seen.stress = found;
    Tasks tasks;
    tasks.push_back(stress_on_top(5e6, 1e-3));
    StageEnd::Parameters end;
    end.any = {until(Until::Reached::settled, 0)};
    end.least = 1e-3;
    Program program(seen, list_of(stage_of("stress", std::move(tasks), end)));
    seen.now = dt, ask(program);
    for (const double x : {0.25, 0.5, 0.75, 1.5}) {
      const double wanted = x >= 1 ? 5e6 : found + x * x * (3 - 2 * x) * (5e6 - found);
      seen.now = x * 1e-3 + 0.5 * dt, seen.stress = wanted;
      for (int n = 0; n < 60; ++n) // what is left of the velocity halves
        ask(program);
      EXPECT_NEAR(ask(program)[1].velocity[2], 0, 1e-12) << found << " " << x;
      seen.stress = wanted - 1e4;
      EXPECT_LT(ask(program)[1].velocity[2], 0) << found << " " << x;
    }
    seen.stress = 5e6 * 1.0101;
    program.update();
    EXPECT_FALSE(program.finished()) << found;
    seen.stress = 5e6 * 1.0099;
    program.update();
    EXPECT_TRUE(program.finished()) << found;
  }
}

// What is missing over time is asked again: a servo that is held off by a tenth asks for twice as much after
// its integral time, three times after two.
TEST(stress, what_stays_missing_is_asked_again) {
  const double time = 1e-3;
  Seen seen;
  StressTask::Parameters p;
  p.platens = top;
  p.side = "top";
  p.value = 5e6;
  p.servo = {10, 100}; // no limit that it reaches
  p.integral_time = time;
  StressTask task(p);
  seen.stress = 0.9 * p.value;
  task.begin(seen, 0, {});
  const auto speed = [&] {
    Commands all(3);
    for (int n = 0; n < 60; ++n)
      task.command(seen, all);
    return all[1].velocity[2];
  };
  seen.now = dt;
  const double first = speed();
  EXPECT_LT(first, 0);
  for (int n = 1; n <= 2000; ++n) {
    seen.now = n * dt;
    task.update(seen);
    if (n % 1000 == 0) {
      EXPECT_NEAR(speed() / first, 1 + n * dt / time, 1e-6) << n;
    }
  }
}

// A platen that is pulled settles within the same hundredth.
TEST(stress, of_either_sign_settles_within_a_hundredth) {
  for (const double value : {5e6, -5e6}) {
    Seen seen;
    StressTask::Parameters p;
    p.platens = top;
    p.side = "top";
    p.value = value;
    p.servo = {10, 0.1};
    StressTask task(p);
    task.begin(seen, 0, {});
    seen.now = dt;
    for (const auto &[share, settled] : {std::pair{1.0, true}, std::pair{1.009, true}, std::pair{0.991, true},
                                         std::pair{1.011, false}, std::pair{0.989, false}}) {
      seen.stress = share * value;
      EXPECT_EQ(task.has_settled(seen), settled) << share << " of " << value;
    }
  }
}

TEST(axial_rate, of_nothing_is_refused) {
  Seen seen;
  Drive drive(Drive::Parameters{axial, std::nullopt});
  EXPECT_THROW(drive.ask(0, 1e-3, seen, 0), std::invalid_argument);
  EXPECT_NO_THROW(drive.ask(-0.1, 1e-3, seen, 0));
}

// Platens that were moving come to rest within the ramp to rest.
TEST(stress, what_moves_is_brought_to_rest) {
  for (const bool hold : {false, true}) {
    Seen seen;
    const auto drive = drive_of_both();
    Stages stages;
    stages.push_back(at_rate(drive, 0.08, 0, until(Until::Reached::strain, 1e-3)));
    Tasks tasks;
    StressTask::Parameters p;
    p.platens = axial;
    p.value = 5e6, p.ramp = 1e-3, p.ramp_to_rest = 2e-4;
    p.servo = {1, 0.1};
    if (hold)
      tasks.push_back(std::make_unique<HoldTask>(axial, 2e-4));
    else
      tasks.push_back(std::make_unique<StressTask>(p));
    StageEnd::Parameters end;
    end.any = {until(Until::Reached::time, 1)};
    stages.push_back(stage_of("after", std::move(tasks), end));
    Program program(seen, std::move(stages), {drive});
    seen.now = dt, seen.stress = 5e6, seen.closure = 1e-3;
    EXPECT_EQ(ask(program)[0].velocity[2], 0.04);
    program.update();
    ASSERT_EQ(program.stage_number(), 1u);
    for (const double x : {0.25, 0.5, 1.0, 2.0}) {
      seen.now = dt + x * 2e-4 + 0.5 * dt;
      const double left = x >= 1 ? 0 : 1 - x * x * (3 - 2 * x);
      EXPECT_NEAR(ask(program)[0].velocity[2], 0.04 * left, 1e-12) << x;
      EXPECT_NEAR(ask(program)[1].velocity[2], -0.04 * left, 1e-12) << x;
    }
  }
}

TEST(stress, a_share_of_its_own_stress_is_refused) {
  StressTask::Parameters p;
  p.platens = top;
  p.followed = axial;
  p.lag = 1e-5;
  p.servo = {1, 0.1};
  EXPECT_THROW(StressTask{p}, std::invalid_argument);
  p.platens.places = {2};
  EXPECT_NO_THROW(StressTask{p});
  p.lag = 0;
  EXPECT_THROW(StressTask{p}, std::invalid_argument);
}

TEST(consolidation, waits_for_the_platens_and_hands_over_from_its_end) {
  Seen seen;
  const auto drive = drive_of_both();
  Stages stages = list_of(consolidation(4e6));
  Tasks tasks;
  tasks.push_back(std::make_unique<RateTask>(drive, 0.08, 1e-3));
  tasks.push_back(std::make_unique<HoldPressureTask>(lateral));
  StageEnd::Parameters end;
  end.any = {until(Until::Reached::strain, 1e-3)};
  stages.push_back(stage_of("compression", std::move(tasks), end));
  Program program(seen, std::move(stages), {drive});
  seen.now = 0.5e-3;
  EXPECT_NEAR(ask(program)[2].pressure, 2e6, 1e-6); // half of the ramp
  seen.now = 1.6e-3, seen.pressure = 4e6, seen.stress = 3.95e6, seen.closure = 2e-4;
  ask(program), program.update();
  EXPECT_FALSE(program.in_axial_stage()); // 1.25 % away
  EXPECT_EQ(program.axial_closure(), 0);
  seen.stress = 3.97e6;
  program.update();
  EXPECT_TRUE(program.in_axial_stage());
  EXPECT_EQ(program.axial_closure(), 0);
  seen.now = 1.6e-3 + 0.5e-3 + 0.5 * dt, seen.closure = 5e-4;
  EXPECT_NEAR(ask(program)[0].velocity[2], 0.02, 1e-9); // half of the ramp from there
  EXPECT_EQ(ask(program)[2].pressure, 4e6);
  EXPECT_NEAR(program.axial_closure(), 3e-4, 1e-18);
  seen.closure = 1.19e-3; // strains count from the end of the consolidation
  program.update();
  EXPECT_FALSE(program.finished());
  seen.closure = 1.2e-3 + 1e-12;
  program.update();
  EXPECT_TRUE(program.finished());
}

TEST(consolidation, does_not_wait_for_ever) {
  Seen seen;
  Program program(seen, list_of(consolidation(4e6)));
  seen.pressure = 4e6; // the platens never get there
  seen.now = 2.999e-3; // twice as long as ramp and hold
  ask(program), program.update();
  EXPECT_FALSE(program.finished());
  seen.now = 3e-3;
  program.update();
  EXPECT_TRUE(program.finished());
}

// What it tells stays what it was at the end, and goes with the state; a state from before it was told says
// nothing.
TEST(consolidation, tells_that_its_stress_was_not_borne) {
  for (const double borne : {3.95e6, 3.97e6}) {
    const bool settles = borne > 3.96e6;
    Seen seen;
    Program program(seen, list_of(consolidation(4e6)));
    seen.stress = borne, seen.now = settles ? 1.6e-3 : 3e-3;
    ask(program);
    EXPECT_EQ(program.stage(0).ended_by(), "");
    EXPECT_EQ(program.stages_ended(), 0u);
    program.update();
    seen.stress = 1e6;
    Program resumed(seen, list_of(consolidation(4e6))), older(seen, list_of(consolidation(4e6)));
    const State state = state_of(program);
    set_state(resumed, state);
    set_state(older, without(without(state, "ended_by"), "at_end"));
    EXPECT_TRUE(same_state(program, resumed));
    for (const Program *one : {&program, &resumed}) {
      EXPECT_EQ(one->stages_ended(), 1u);
      EXPECT_EQ(one->stage(0).ended_by(), settles ? "settled" : "not settled");
      const std::vector<AskedStress> stresses = one->stage(0).stresses_at_end();
      ASSERT_EQ(stresses.size(), 1u);
      EXPECT_EQ(stresses[0].side, "top");
      EXPECT_EQ(stresses[0].asked, 4e6);
      EXPECT_EQ(stresses[0].borne, borne);
    }
    EXPECT_EQ(older.stages_ended(), 1u);
    EXPECT_EQ(older.stage(0).ended_by(), "");
    for (const std::string &name : state.names())
      if (name.find("ended_by") != std::string::npos) {
        EXPECT_THROW(set_state(older, with_rows(state, name, std::vector<int>{2})), StateError);
        EXPECT_THROW(set_state(older, with_rows(state, name, std::vector<int>{-2})), StateError);
      }
  }
}

// Of platens that have to bear it each by itself the one that is farthest is told.
TEST(stress, the_platen_that_is_farthest_from_it_is_told) {
  struct Uneven : Seen {
    double load(std::size_t boundary) const override { return area * (boundary == 0 ? 4.98e6 : low); }
    double low = 4.94e6;
  } seen;
  StressTask::Parameters p;
  p.platens = {{0, 1}, area, 0.1, 0}; // along x
  p.value = 5e6;
  p.servo = {10, 0.1};
  StressTask task(p);
  task.begin(seen, 0, {});
  EXPECT_FALSE(task.has_settled(seen)); // though their mean is within 1 %
  task.end(seen);
  EXPECT_EQ(task.stress_at_end()->borne, 4.94e6);
  seen.low = 5.04e6;
  EXPECT_TRUE(task.has_settled(seen));
  task.end(seen);
  EXPECT_EQ(task.stress_at_end()->borne, 5.04e6);
  seen.low = 5.01e6; // the other one
  task.end(seen);
  EXPECT_EQ(task.stress_at_end()->borne, 4.98e6);
}

// One per cent of nothing would never be reached.
TEST(stress, none_has_settled_after_its_ramp) {
  Seen seen;
  const std::unique_ptr<Task> task = stress_on_top(0, 1e-3);
  task->begin(seen, 0, {});
  seen.stress = 10, seen.now = 0.9e-3;
  EXPECT_FALSE(task->has_settled(seen));
  seen.now = 1.1e-3;
  EXPECT_TRUE(task->has_settled(seen));
}

TEST(pressure, follows_the_deviator_with_its_lag_and_is_never_negative) {
  Seen seen;
  seen.pressure = 10e6, seen.stress = 16e6; // a deviator of 6 MPa
  PressureTask::Parameters p = to(10e6, 0);
  p.path = -1.0 / 3, p.lag = 50 * dt;
  PressureTask path(p);
  Handover from;
  from.asked.resize(3);
  from.asked[lateral].pressure = 10e6;
  path.begin(seen, 0, from);
  const auto asked = [&] {
    Commands all(3);
    path.command(seen, all);
    return all[lateral].pressure;
  };
  for (int n = 1; n <= 50; ++n)
    seen.now = n * dt, path.update(seen);
  EXPECT_NEAR(asked(), 10e6 - 2e6 * (1 - std::pow(1 - 1.0 / 50, 50)), 1e-3);
  PressureTask after(p); // a stage that goes on along the path
  from.asked[lateral].pressure = 9e6;
  after.begin(seen, seen.now, from);
  Commands all(3);
  after.command(seen, all);
  EXPECT_NEAR(all[lateral].pressure, 9e6, 1e-6);
  seen.stress = 1e9;
  for (int n = 51; n <= 550; ++n)
    seen.now = n * dt, path.update(seen);
  EXPECT_EQ(asked(), 0);
}

TEST(pressure, rises_from_what_it_finds_and_follows_a_share) {
  Seen seen;
  Handover from;
  from.asked.resize(3);
  from.asked[lateral].pressure = 3e6;
  PressureTask up(to(7e6, 1e-3));
  up.begin(seen, 1e-3, from);
  Commands all(3);
  for (const double x : {0.0, 0.25, 0.5, 1.0, 3.0}) {
    seen.now = 1e-3 + x * 1e-3;
    up.command(seen, all);
    EXPECT_NEAR(all[lateral].pressure, x >= 1 ? 7e6 : 3e6 + 4e6 * x * x * (3 - 2 * x), 1e-3) << x;
  }
  PressureTask::Parameters p = to(0.25, 0);
  p.followed = axial, p.lag = 10 * dt;
  PressureTask share(p);
  seen.stress = 8e6;
  share.begin(seen, seen.now, from);
  share.command(seen, all);
  EXPECT_NEAR(all[lateral].pressure, 2e6, 1e-6);
  seen.stress = 16e6, seen.now += dt;
  share.update(seen), share.command(seen, all);
  EXPECT_NEAR(all[lateral].pressure, 0.25 * (8e6 + 0.1 * 8e6), 1e-6);
}

// Each of what ends a stage, just before and at it.
TEST(stage_end, is_met_at_its_value) {
  struct Case {
    Until until;
    Seen at_begin, before, at;
  };
  const auto seen = [](double now, double closure, double stress, double wider = 0) {
    Seen s;
    s.now = now, s.closure = closure, s.stress = stress, s.wider = wider, s.pressure = 1e6;
    return s;
  };
  using R = Until::Reached;
  const Seen from = seen(1, 2e-3, 5e6, 1e-4);
  const std::vector<Case> cases{
      {until(R::strain, 3e-3), from, seen(1, 3.4e-3, 0), seen(1, 3.5e-3 + 1e-12, 0)}, // of .5e-3 on
      {until(R::strain, 1e-3, -1), from, seen(1, 1.6e-3, 0), seen(1, 1.5e-3, 0)},
      {until(R::strain_change, 3e-4), from, seen(1, 1.71e-3, 0), seen(1, 1.69e-3, 0)},
      {until(R::strain_change, 3e-4), from, seen(1, 2.29e-3, 0), seen(1, 2.31e-3, 0)},
      {until(R::stress, 7e6), from, seen(1, 0, 6.9e6), seen(1, 0, 7e6)},
      {until(R::stress, 4e6), from, seen(1, 0, 4.1e6), seen(1, 0, 4e6)},
      {until(R::share_of_start, 0.25), from, seen(1, 0, 2.1e6), seen(1, 0, 2e6)}, // less 1 MPa
      {until(R::circumferential_strain, 2e-4), from, seen(1, 0, 0, 1.9e-4), seen(1, 0, 0, 2e-4)},
      {until(R::time, 2e-3), from, seen(1.0019, 0, 5e6), seen(1.0021, 0, 5e6)}};
  Handover handover;
  handover.zero = {0, 0, 0.5e-3};
  for (std::size_t k = 0; k < cases.size(); ++k) {
    const Case &c = cases[k];
    StageEnd end({{c.until}, 0, 0, std::numeric_limits<double>::infinity()});
    end.begin(c.at_begin, handover);
    EXPECT_EQ(end.reached(c.before, c.before.now - 1, false), 0) << k;
    EXPECT_EQ(end.reached(c.at, c.at.now - 1, false), 1) << k;
  }
}

TEST(stage_end, a_share_of_the_peak_counts_after_the_ramp) {
  Seen seen;
  seen.pressure = 1e6;
  StageEnd end(
      {{until(Until::Reached::share_of_peak, 0.5)}, 1e-3, 0, std::numeric_limits<double>::infinity()});
  end.begin(seen, {});
  const auto at = [&](double passed, double stress) {
    seen.stress = stress;
    end.update(seen, passed);
    return end.reached(seen, passed, false) == 1;
  };
  EXPECT_FALSE(at(1e-4, 3e6));
  EXPECT_FALSE(at(2e-4, 1.5e6)); // waves of the start
  EXPECT_FALSE(at(2e-3, 11e6));
  EXPECT_FALSE(at(3e-3, 6.1e6));
  EXPECT_TRUE(at(4e-3, 6e6)); // 5 of 10 MPa
}

// The first of the list that is met; that its time is over counts where none is.
TEST(stage_end, says_which_of_its_list_it_was) {
  using R = Until::Reached;
  Seen seen;
  StageEnd end({{until(R::strain, 1e-3), until(R::settled, 0), until(R::stress, 9e6)}, 0, 1e-3, 2e-3});
  end.begin(seen, {});
  EXPECT_EQ(end.reached(seen, 0.9e-3, true), 0); // not before it has gone on for its least time
  EXPECT_EQ(end.reached(seen, 1e-3, true), 2);
  EXPECT_EQ(end.reached(seen, 1.999e-3, false), 0);
  EXPECT_EQ(end.reached(seen, 2e-3, false), StageEnd::too_late);
  EXPECT_EQ(end.reached(seen, 2e-3, true), 2);
  seen.stress = 9e6;
  EXPECT_EQ(end.reached(seen, 2e-3, false), 3);
  seen.closure = 1e-3;
  EXPECT_EQ(end.reached(seen, 2e-3, true), 1);
}

TEST(stage_end, every_end_has_its_word) {
  using R = Until::Reached;
  EXPECT_STREQ(name_of(R::strain), "strain");
  EXPECT_STREQ(name_of(R::strain_change), "strain change");
  EXPECT_STREQ(name_of(R::stress), "stress");
  EXPECT_STREQ(name_of(R::share_of_peak), "share of peak");
  EXPECT_STREQ(name_of(R::share_of_start), "share of start");
  EXPECT_STREQ(name_of(R::circumferential_strain), "circumferential strain");
  EXPECT_STREQ(name_of(R::time), "time");
  EXPECT_STREQ(name_of(R::settled), "settled");
}

// The strain asked is the integral of a smooth start; the platens close faster where the specimen lags, and
// part where it is ahead, no faster than they may.
TEST(circumferential, leads_the_platens_by_the_width) {
  const double rate = 2, ramp = 1e-3, transit = 1e-5;
  CircumferentialTask task({axial, rate, ramp, transit, 5});
  Seen seen;
  seen.wider = 3e-4;
  task.begin(seen, 0, {});
  const auto speed = [&](double passed, double wider) {
    seen.wider = wider, seen.now = passed + 0.5 * dt;
    Commands all(3);
    for (int n = 0; n < 200; ++n)
      task.command(seen, all);
    EXPECT_EQ(all[0].velocity[2], -all[1].velocity[2]);
    return 2 * all[0].velocity[2];
  };
  const double half = 3e-4 + rate * ramp * 0.125 * 0.75; // integral of 3 x^2 - 2 x^3 to 1/2: 3/32
  EXPECT_NEAR(speed(0.5e-3, half), 0.1 * 0.5 * rate / 0.2, 1e-9);
  const double later = 3e-4 + rate * (0.5e-3 + 1e-3);
  EXPECT_NEAR(speed(2e-3, later), 0.1 * rate / 0.2, 1e-9);
  EXPECT_NEAR(speed(2e-3, later - 1e-5), 0.1 * (rate + 1e-5 / (20 * transit)) / 0.2, 1e-9);
  EXPECT_NEAR(speed(2e-3, later + 1e-5), 0.1 * (rate - 1e-5 / transit) / 0.2, 1e-9);
  EXPECT_NEAR(speed(2e-3, later + 1), -1e-4 * 0.1 / transit < -5 ? -1e-4 * 0.1 / transit : -5, 1e-9);
  EXPECT_NEAR(speed(2e-3, later - 1), 5, 1e-9);
  EXPECT_THROW(CircumferentialTask({axial, 0, ramp, transit, 5}), std::invalid_argument);
}

TEST(program, goes_on_from_its_state_to_the_last_bit) {
  const auto make = [](const Seen &seen) {
    const auto drive = drive_of_both(RateControl::Parameters{4, 1e-5, 1e-4, 1000});
    Stages stages = list_of(consolidation(4e6));
    const auto add = [&](double rate, const Until &end) {
      Tasks tasks;
      tasks.push_back(std::make_unique<RateTask>(drive, rate, 1e-3));
      PressureTask::Parameters p = to(4e6, 0);
      p.path = 0.5, p.lag = 20 * dt;
      tasks.push_back(std::make_unique<PressureTask>(p));
      StageEnd::Parameters over;
      over.any = {end};
      stages.push_back(stage_of("compression", std::move(tasks), over, 1e-3));
    };
    add(0.08, until(Until::Reached::strain, 3e-5));
    add(-0.08, until(Until::Reached::time, 3e-4));
    add(0.08, until(Until::Reached::strain, 1e-3));
    return std::make_unique<Program>(seen, std::move(stages), std::vector{drive});
  };
  Seen seen;
  const auto drive = [&](Program &program, int first, int last) {
    std::vector<double> asked;
    for (int n = first; n < last; ++n) {
      seen.now = (n + 1) * dt;
      for (const Command &command : ask(program))
        asked.insert(asked.end(), {command.velocity[2], command.pressure});
      seen.closure = 2e-7 * n, seen.pressure = 4e6, seen.stress = 4e6 + 1e3 * std::max(0, n - 1500);
      program.update();
    }
    return asked;
  };
  for (const int stop : {700, 1499, 1501, 1750, 3200}) {
    const auto whole = make(seen), resumed = make(seen);
    seen = {};
    drive(*whole, 0, stop);
    set_state(*resumed, state_of(*whole));
    const Seen at_stop = seen;
    const std::vector<double> expected = drive(*whole, stop, stop + 600);
    seen = at_stop;
    EXPECT_EQ(drive(*resumed, stop, stop + 600), expected) << stop;
    EXPECT_TRUE(same_state(*whole, *resumed)) << stop;
  }
}

TEST(program, without_a_stage_is_refused) {
  const Seen seen;
  EXPECT_THROW(Program(seen, {}), std::invalid_argument);
}

} // namespace
} // namespace platen::coupling
