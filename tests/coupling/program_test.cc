// Loading stages one after the other: rates and their ends. That a stop changes nothing is in
// conformance_test.cc.
#include "tests/coupling/seen.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/same_state.h"

namespace platen::coupling::program_test {
namespace {

using namespace seen;

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

// As one that was read with a larger strain than it had finished at.
TEST(axial_rate, goes_on_to_a_later_end_as_if_there_had_been_none_before) {
  const auto told = [](double at, double closure, Program &program, Seen &seen) {
    seen.now = at, seen.closure = closure;
    const Commands asked = ask(program);
    program.update();
    return asked[0].velocity[2];
  };
  Seen one, other;
  const auto first = drive_of_both(), second = drive_of_both();
  const double ramp = 10 * dt;
  Program early(one, list_of(at_rate(first, 0.08, ramp, until(Until::Reached::strain, 1e-3))), {first}),
      late(other, list_of(at_rate(second, 0.08, ramp, until(Until::Reached::strain, 2e-3))), {second});
  EXPECT_NEAR(early.expected_seconds(), 1e-3 * 0.1 / 0.08, 1e-15);
  for (int k = 1; k <= 5; ++k) {
    EXPECT_FALSE(early.finished());
    told(k * dt, 2.1e-4 * k, early, one);
    EXPECT_NEAR(early.progress(), std::min(1., 0.21 * k), 1e-12);
  }
  ASSERT_TRUE(early.finished());
  EXPECT_EQ(early.stage().ended_by(), "strain");
  early.go_on();
  EXPECT_TRUE(early.finished()) << "nothing has changed";

  set_state(late, state_of(early));
  ASSERT_TRUE(late.finished()) << "as it was kept";
  other.now = 5 * dt, other.closure = 1.05e-3;
  late.go_on();
  EXPECT_FALSE(late.finished());
  EXPECT_EQ(late.stage().ended_by(), "");
  EXPECT_EQ(late.stages_ended(), 0u);
  for (int k = 6; k <= 9; ++k)
    EXPECT_EQ(told(k * dt, 2.1e-4 * k, late, other), told(k * dt, 2.1e-4 * k, early, one)) << k;
  EXPECT_FALSE(late.finished());
  told(10 * dt, 2.1e-3, late, other);
  EXPECT_TRUE(late.finished());
  EXPECT_EQ(late.stage().ended_by(), "strain");
}

// Load to a strain, unload to a quarter of the stress there, load on.
Program turning(const Seen &seen, const std::shared_ptr<Drive> &drive, double ramp) {
  Stages stages;
  stages.push_back(at_rate(drive, 0.08, ramp, until(Until::Reached::strain, 4e-4)));
  stages.push_back(at_rate(drive, -0.08, ramp, until(Until::Reached::fraction_of_start, 0.25)));
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
  drive->set_rate(-0.16, ramp, seen, seen.now); // a stage that asks twice the rate
  seen.now += dt;
  EXPECT_NEAR(drive->speed(seen), -0.04 - 0.08 * 2.0 / 100, 1e-15);
}

TEST(axial_rate, of_nothing_is_refused) {
  Seen seen;
  Drive drive(Drive::Parameters{axial, std::nullopt});
  EXPECT_THROW(drive.set_rate(0, 1e-3, seen, 0), std::invalid_argument);
  EXPECT_THROW(drive.change_rate(0.1, seen), std::invalid_argument); // of a drive that was asked for none
  EXPECT_NO_THROW(drive.set_rate(-0.1, 1e-3, seen, 0));
  EXPECT_THROW(drive.change_rate(0, seen), std::invalid_argument);
  EXPECT_NO_THROW(drive.change_rate(0.1, seen));
}

TEST(program, without_a_stage_is_refused) {
  const Seen seen;
  EXPECT_THROW(Program(seen, {}), std::invalid_argument);
}

} // namespace
} // namespace platen::coupling::program_test
