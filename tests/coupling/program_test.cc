// Loading stages: what they ask, when they end, how they follow each other, and that a stop changes nothing.
#include "coupling/program/program.h"

#include <gtest/gtest.h>

#include <cmath>

#include "coupling/program/stages.h"
#include "tests/same_state.h"

namespace platen::coupling {
namespace {

constexpr double dt = 1e-6, area = 2e-4; // s, m^2

// A test as its program sees it, with numbers set by hand.
struct Seen : Measures {
  double now = 0, closure = 0, stress = 0, pressure = 0, broken = 0;
  double time() const override { return now; }
  double time_step() const override { return dt; }
  double closure_strain() const override { return closure; }
  double axial_stress() const override { return stress; }
  double lateral_pressure() const override { return pressure; }
  double broken_bonds() const override { return broken; }
  Vector3 force(std::size_t) const override { return {0, 0, stress * area}; }
  double load(std::size_t) const override { return stress * area; }
  double closure_of(std::size_t) const override { return 0; }
  Vector3 inward(std::size_t boundary) const override { return {0, 0, boundary == 0 ? 1. : -1.}; }
  ServoLoad servo_load(std::size_t) const override { return {1e8, 100}; }
};

AxialRate::Parameters at_rate(double rate, double ramp) {
  AxialRate::Parameters p;
  p.rate = rate;
  p.ramp = ramp;
  p.target_strain = 1e-3;
  p.height = 0.1;
  return p;
}

Consolidation::Parameters to_pressure(double pressure) {
  Consolidation::Parameters p;
  p.sides.lateral = 2;
  p.pressure = pressure;
  p.ramp = 1e-3;
  p.hold = 5e-4;
  p.area = area;
  p.servo = {10, 0.1};
  return p;
}

template <class Kind, class Parameters>
std::vector<std::unique_ptr<Stage>> list_of(const Parameters &parameters) {
  std::vector<std::unique_ptr<Stage>> stages;
  stages.push_back(std::make_unique<Kind>(parameters));
  return stages;
}

Commands ask(Program &program) {
  Commands asked(3);
  program.command(asked);
  return asked;
}

TEST(axial_rate, each_platen_goes_at_half_the_rate_from_a_smooth_start) {
  for (const bool tension : {false, true}) {
    Seen seen;
    AxialRate::Parameters p = at_rate(0.08, 1e-3);
    p.tension = tension;
    Program program(seen, list_of<AxialRate>(p));
    const double sign = tension ? -1 : 1;
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
  Program program(seen, list_of<AxialRate>(at_rate(0.08, 0)));
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

TEST(axial_rate, turns_round_at_its_strain_and_back_at_the_share_of_the_stress) {
  Seen seen;
  AxialRate::Parameters p = at_rate(0.08, 0);
  p.unload_at = {4e-4};
  p.unload_to = 0.25;
  Program program(seen, list_of<AxialRate>(p));
  const auto at = [&](double closure, double stress) {
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
}

TEST(axial_stress, ends_after_ramp_and_hold_or_at_its_strain) {
  AxialStress::Parameters p;
  p.stress = 5e6, p.ramp = 1e-3, p.hold = 2e-3, p.target_strain = 1e-2, p.area = area;
  p.servo = {5, 0.1};
  for (const bool by_strain : {false, true}) {
    Seen seen;
    Program program(seen, list_of<AxialStress>(p));
    seen.now = by_strain ? 1e-4 : 2.9999e-3;
    program.update();
    EXPECT_FALSE(program.finished());
    EXPECT_LT(ask(program)[1].velocity[2], 0); // presses
    EXPECT_EQ(ask(program)[0].velocity[2], 0);
    (by_strain ? seen.closure = 1e-2 : seen.now = 3e-3);
    program.update();
    EXPECT_TRUE(program.finished());
  }
}

TEST(consolidation, waits_for_the_platens_and_hands_over_from_its_end) {
  Seen seen;
  std::vector<std::unique_ptr<Stage>> stages = list_of<Consolidation>(to_pressure(4e6));
  AxialRate::Parameters axial = at_rate(0.08, 1e-3);
  axial.sides.lateral = 2;
  axial.lateral = LateralPressure::Parameters{4e6, 0, 1};
  stages.push_back(std::make_unique<AxialRate>(axial));
  Program program(seen, std::move(stages));
  seen.now = 0.5e-3;
  EXPECT_NEAR(ask(program)[2].pressure, 2e6, 1e-6); // half of the ramp
  seen.now = 1.6e-3, seen.pressure = 4e6, seen.stress = 3.95e6, seen.closure = 2e-4;
  program.update();
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
}

TEST(consolidation, does_not_wait_for_ever) {
  Seen seen;
  Program program(seen, list_of<Consolidation>(to_pressure(4e6)));
  seen.pressure = 4e6; // the platens never get there
  seen.now = 2.999e-3; // twice as long as ramp and hold
  program.update();
  EXPECT_FALSE(program.finished());
  seen.now = 3e-3;
  program.update();
  EXPECT_TRUE(program.finished());
}

TEST(lateral_pressure, follows_the_deviator_with_its_lag_and_is_never_negative) {
  Seen seen;
  seen.pressure = 10e6, seen.stress = 16e6; // a deviator of 6 MPa
  LateralPressure path({10e6, -1.0 / 3, 50 * dt});
  for (int n = 0; n < 50; ++n)
    path.follow(seen);
  EXPECT_NEAR(path.asked(), 10e6 - 2e6 * (1 - std::pow(1 - 1.0 / 50, 50)), 1e-3);
  seen.stress = 1e9;
  for (int n = 0; n < 500; ++n)
    path.follow(seen);
  EXPECT_EQ(path.asked(), 0);
}

TEST(program, goes_on_from_its_state_to_the_last_bit) {
  const auto make = [](const Seen &seen) {
    std::vector<std::unique_ptr<Stage>> stages = list_of<Consolidation>(to_pressure(4e6));
    AxialRate::Parameters axial = at_rate(0.08, 1e-3);
    axial.sides.lateral = 2;
    axial.lateral = LateralPressure::Parameters{4e6, 0.5, 20 * dt};
    axial.unload_at = {3e-4};
    axial.rate_control = RateControl::Parameters{4, 1e-5, 1e-4, 1000};
    stages.push_back(std::make_unique<AxialRate>(axial));
    return std::make_unique<Program>(seen, std::move(stages));
  };
  Seen seen;
  const auto drive = [&](Program &program, int first, int last) {
    std::vector<double> asked;
    for (int n = first; n < last; ++n) {
      seen.now = n * dt;
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
