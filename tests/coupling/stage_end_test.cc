// When loading stages end, and what they tell of it.
#include "tests/coupling/seen.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "coupling/program/widening_task.h"
#include "tests/same_state.h"

namespace platen::coupling::stage_end_test {
namespace {

using namespace seen;

TEST(consolidation, waits_for_the_platens_and_hands_over_from_its_end) {
  Seen seen;
  const auto drive = drive_of_both();
  Stages stages = list_of(consolidation(4e6));
  Tasks tasks;
  tasks.push_back(std::make_unique<RateTask>(drive, 0.08, 1e-3));
  tasks.push_back(std::make_unique<HoldPressureTask>(lateral));
  stages.push_back(stage_of("compression", std::move(tasks), ends_at(Until::Reached::strain, 1e-3)));
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

// Its task of a stress kept what was asked and borne, and nobody the rest.
State as_of_version_1(const State &state) {
  State older = without(without(state, "ended_by"), "at_end");
  const std::string task = "task_2/";
  for (const std::string &name : state.names()) {
    const std::size_t at = name.find(task + "version");
    if (at == std::string::npos) continue;
    EXPECT_EQ(rows_of<int>(state, name), std::vector<int>{2});
    older = with_rows(older, name, std::vector<int>{1});
    for (const char *former : {"asked_at_end", "borne_at_end"}) {
      const double value = 4e6;
      older.add(name.substr(0, at) + task + former, block_type<double>("Pa"), &value, 1);
    }
  }
  return older;
}

// What it tells stays what it was at the end, and goes with the state; a state from before it was told says
// nothing.
TEST(consolidation, tells_that_its_stress_was_not_borne) {
  for (const double borne : {3.95e6, 3.97e6}) {
    const bool settles = borne > 3.96e6;
    Seen seen;
    Program program(seen, list_of(consolidation(4e6)));
    seen.stress = borne, seen.pressure = 4e6, seen.now = settles ? 1.6e-3 : 3e-3;
    ask(program);
    EXPECT_EQ(program.stage(0).ended_by(), "");
    EXPECT_EQ(program.stages_ended(), 0u);
    program.update();
    seen.stress = seen.pressure = 1e6;
    Program resumed(seen, list_of(consolidation(4e6))), older(seen, list_of(consolidation(4e6)));
    const State state = state_of(program);
    set_state(resumed, state);
    set_state(older, as_of_version_1(state));
    EXPECT_TRUE(older.controls(0).empty());
    EXPECT_TRUE(same_state(program, resumed));
    for (const Program *one : {&program, &resumed}) {
      EXPECT_EQ(one->stages_ended(), 1u);
      EXPECT_EQ(one->stage(0).ended_by(), settles ? "settled" : "not settled");
      const std::vector<Controlled> told = one->controls(0);
      ASSERT_EQ(told.size(), 2u);
      EXPECT_EQ(told[0].quantity, "pressure");
      EXPECT_EQ(told[0].reached, 4e6);
      EXPECT_TRUE(told[0].is_met());
      EXPECT_EQ(told[1].side, "top");
      EXPECT_EQ(told[1].target, 4e6);
      EXPECT_EQ(told[1].reached, borne);
      EXPECT_EQ(told[1].is_met(), settles);
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
      {until(R::fraction_of_start, 0.25), from, seen(1, 0, 2.1e6), seen(1, 0, 2e6)}, // less 1 MPa
      {until(R::circumferential_strain, 2e-4), from, seen(1, 0, 0, 1.9e-4), seen(1, 0, 0, 2e-4)},
      {until(R::mouth_opening, 2e-4), from, seen(1, 0, 0, 1.9e-4), seen(1, 0, 0, 2e-4)},
      {until(R::time, 2e-3), from, seen(1.0019, 0, 5e6), seen(1.0021, 0, 5e6)}};
  Transfer handover;
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
      {{until(Until::Reached::fraction_of_peak, 0.5)}, 1e-3, 0, std::numeric_limits<double>::infinity()});
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

} // namespace
} // namespace platen::coupling::stage_end_test
