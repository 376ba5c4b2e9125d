// What the tasks of a loading stage ask of platens: stresses, pressures, a circumferential rate.
#include "tests/coupling/seen.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "coupling/program/widening_task.h"

namespace platen::coupling::program_task_test {
namespace {

using namespace seen;

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
    const std::unique_ptr<Task> task = stress_on_top(5e6, 1e-3);
    task->begin(seen, 0, {});
    for (const double x : {0.25, 0.5, 0.75, 1.5}) {
      const double wanted = x >= 1 ? 5e6 : found + x * x * (3 - 2 * x) * (5e6 - found);
      seen.now = x * 1e-3 + 0.5 * dt, seen.stress = wanted;
      EXPECT_NEAR(speed_of(*task, seen, 1), 0, 1e-12) << found << " " << x;
      seen.stress = wanted - 1e4;
      EXPECT_LT(speed_of(*task, seen, 1), 0) << found << " " << x; // presses
      EXPECT_EQ(speed_of(*task, seen, 0), 0);
    }
    seen.stress = 5e6 * 1.0101;
    EXPECT_FALSE(task->has_settled(seen)) << found;
    seen.stress = 5e6 * 1.0099;
    EXPECT_TRUE(task->has_settled(seen)) << found;
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
  seen.now = dt;
  const double first = speed_of(task, seen, 1);
  EXPECT_LT(first, 0);
  for (int n = 1; n <= 2000; ++n) {
    seen.now = n * dt;
    task.update(seen);
    if (n % 1000 == 0) {
      EXPECT_NEAR(speed_of(task, seen, 1) / first, 1 + n * dt / time, 1e-6) << n;
    }
  }
}

// A platen that is pulled settles within the same hundredth.
TEST(stress, of_either_sign_settles_within_a_hundredth) {
  for (const double value : {5e6, -5e6}) {
    Seen seen;
    const StressTask::Parameters p = stress_of(value);
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
    stages.push_back(stage_of("after", std::move(tasks), ends_at(Until::Reached::time, 1)));
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
  EXPECT_EQ(task.controlled(seen)->reached, 4.94e6);
  seen.low = 5.04e6;
  EXPECT_TRUE(task.has_settled(seen));
  EXPECT_EQ(task.controlled(seen)->reached, 5.04e6);
  seen.low = 5.01e6; // the other one
  EXPECT_EQ(task.controlled(seen)->reached, 4.98e6);
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
  Transfer from = after_pressure(10e6);
  path.begin(seen, 0, from);
  // Of a step s the mean of n values is s (1 - q^n), that of the means s (1 - q^n (1 + n / 50)).
  for (int n = 1; n <= 25; ++n)
    seen.now = n * dt, path.update(seen);
  EXPECT_NEAR(pressure_of(path, seen), 10e6 - 2e6 * (1 - 0.5 * std::pow(1 - 1.0 / 50, 25)), 1e-3);
  PressureTask after(p); // a stage that goes on along the path
  from.commands[lateral].pressure = 9e6;
  after.begin(seen, seen.now, from);
  EXPECT_NEAR(pressure_of(after, seen), 9e6, 1e-6);
  // What grows steadily is followed without a lag.
  for (int n = 26; n <= 1025; ++n)
    seen.now = n * dt, seen.stress = 16e6 + 1e3 * (n - 25), path.update(seen);
  EXPECT_NEAR(pressure_of(path, seen), 10e6 - (6e6 + 1e6) / 3, 1);
  seen.stress = 1e9;
  for (int n = 1026; n <= 1550; ++n)
    seen.now = n * dt, path.update(seen);
  EXPECT_EQ(pressure_of(path, seen), 0);
}

TEST(pressure, rises_from_what_it_finds_and_follows_a_share) {
  Seen seen;
  Transfer from = after_pressure(3e6);
  PressureTask up(to(7e6, 1e-3));
  up.begin(seen, 1e-3, from);
  for (const double x : {0.0, 0.25, 0.5, 1.0, 3.0}) {
    seen.now = 1e-3 + x * 1e-3;
    EXPECT_NEAR(pressure_of(up, seen), x >= 1 ? 7e6 : 3e6 + 4e6 * x * x * (3 - 2 * x), 1e-3) << x;
  }
  PressureTask::Parameters p = to(0.25, 0);
  p.followed = axial, p.lag = 10 * dt;
  PressureTask share(p);
  seen.stress = 8e6;
  share.begin(seen, seen.now, from);
  EXPECT_NEAR(pressure_of(share, seen), 2e6, 1e-6);
  seen.stress = 16e6, seen.now += dt;
  share.update(seen);
  EXPECT_NEAR(pressure_of(share, seen), 0.25 * (8e6 + (2 * 0.1 - 0.01) * 8e6), 1e-6);
}

// The strain asked is the integral of a smooth start; the platens close faster where the specimen lags, and
// part where it is ahead, no faster than they may.
TEST(circumferential, leads_the_platens_by_the_width) {
  const double rate = 2, ramp = 1e-3, transit = 1e-5;
  WideningTask task({axial, rate, ramp, transit, 5});
  Seen seen;
  seen.wider = 3e-4;
  task.begin(seen, 0, {});
  const auto speed = [&](double passed, double wider) {
    seen.wider = wider, seen.now = passed + 0.5 * dt;
    EXPECT_EQ(speed_of(task, seen, 0), -speed_of(task, seen, 1));
    return 2 * speed_of(task, seen);
  };
  const double half = 3e-4 + rate * ramp * 0.125 * 0.75; // integral of 3 x^2 - 2 x^3 to 1/2: 3/32
  EXPECT_NEAR(speed(0.5e-3, half), 0.1 * 0.5 * rate / 0.2, 1e-9);
  const double later = 3e-4 + rate * (0.5e-3 + 1e-3);
  EXPECT_NEAR(speed(2e-3, later), 0.1 * rate / 0.2, 1e-9);
  EXPECT_NEAR(speed(2e-3, later - 1e-5), 0.1 * (rate + 1e-5 / (20 * transit)) / 0.2, 1e-9);
  EXPECT_NEAR(speed(2e-3, later + 1e-5), 0.1 * (rate - 1e-5 / transit) / 0.2, 1e-9);
  EXPECT_NEAR(speed(2e-3, later + 1), -1e-4 * 0.1 / transit < -5 ? -1e-4 * 0.1 / transit : -5, 1e-9);
  EXPECT_NEAR(speed(2e-3, later - 1), 5, 1e-9);
  EXPECT_THROW(WideningTask({axial, 0, ramp, transit, 5}), std::invalid_argument);
}

// The same with the opening of a notch, over the closure that a broken bar needs for it.
TEST(program, leads_the_platens_by_the_mouth_of_a_notch) {
  const double rate = 0.02, transit = 1e-5, closure = 0.9;
  WideningTask task({axial, rate, 0, transit, 5, Widening::mouth, closure});
  Seen seen;
  seen.wider = 3e-6;
  task.begin(seen, 0, {});
  const auto speed = [&](double behind) { // m
    seen.now = 2e-3 + 0.5 * dt, seen.wider = 3e-6 + rate * 2e-3 - behind;
    return 2 * speed_of(task, seen);
  };
  EXPECT_NEAR(speed(0), closure * rate, 1e-9);
  EXPECT_NEAR(speed(1e-6), closure * (rate + 1e-6 / (20 * transit)), 1e-9);
  EXPECT_NEAR(speed(-1e-6), closure * (rate - 1e-6 / transit), 1e-9);
  const std::optional<Controlled> told = task.controlled(seen);
  ASSERT_TRUE(told);
  EXPECT_EQ(told->quantity + " " + told->side + " " + told->unit, "cmod rate axial m/s");
  EXPECT_THROW(WideningTask({axial, rate, 0, transit, 5, Widening::mouth}), std::invalid_argument);
}

} // namespace
} // namespace platen::coupling::program_task_test
