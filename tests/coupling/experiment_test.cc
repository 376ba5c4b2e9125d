// An experiment of boundaries that note what is asked of them: order of a step, commands, energy, time step.
#include "coupling/experiment.h"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <functional>
#include <thread>

#include "base/parallel.h"
#include "coupling/program/program.h"
#include "tests/coupling/seen.h"
#include "tests/coupling/set_ups.h"

namespace platen::coupling::experiment_test {
namespace {

using Log = std::vector<std::string>;

class Noted : public Boundary {
public:
  Noted(std::string name, Log &log) : Boundary(std::move(name)), log_(log) {}
  void drift(const Step &step, const Command &command) override {
    note("drift");
    commands.push_back(command);
    steps.push_back(step);
  }
  std::size_t prepare(const dem::Particles &, const Step &) override {
    note("prepare");
    done.assign(parts, 0);
    return parts;
  }
  int particle_of_part(std::size_t part) const override { return particles.empty() ? 0 : particles.at(part); }
  void compute_part(const dem::Particles &, const Step &, std::size_t part) override {
    ++done.at(part);
    if (!particles.empty()) note("part " + std::to_string(part));
  }
  void apply_forces(dem::Particles &, const Step &) override { pushing(); }
  void finish(const Step &) override { note("finish"); }
  double power_on_machine() const override { return power; }
  bool follows_others() const override { return follows; }
  const std::vector<int> *listed_particles() const override { return &listed; }
  StepLimit limit(const dem::Particles &) const override { return own; }
  void add_springs(const dem::Particles &, std::vector<dem::GroundSpring> &all) override {
    all.insert(all.end(), springs.begin(), springs.end());
  }
  bool stiffened() const override { return stiffer; }
  void add_energy(dem::EnergyLedger &energy) const override { energy.bodies += 0.25; }
  bool is_finite() const override { return finite; }
  void describe(Archive &) override {}

  std::size_t parts = 3;
  bool follows = false, finite = true, stiffer = false;
  std::function<void()> pushing = [this] { note("apply"); };
  std::vector<dem::GroundSpring> springs;
  double power = 0;
  StepLimit own;
  std::vector<int> listed{7}, done; // all push the same particle: one after the other
  std::vector<int> particles;       // of each part; empty: of no matter
  std::vector<Command> commands;
  std::vector<Step> steps;

private:
  void note(const std::string &what) { log_.push_back(name() + " " + what); }
  Log &log_;
};

// Asks 1 m/s of the first boundary, 2 m/s of the second and so on; over after so many steps.
class Counting : public Stage {
public:
  explicit Counting(int steps) : left_(steps) {}
  std::string name() const override { return "counting"; }
  void command(const Measures &, Commands &commands) override {
    for (std::size_t b = 0; b < commands.size(); ++b)
      commands[b].velocity = {0, 0, 1.0 + static_cast<double>(b)};
  }
  void update(const Measures &) override { --left_; }
  bool has_ended(const Measures &) const override { return left_ <= 0; }
  double expected_seconds() const override { return 1; }
  double progress(const Measures &) const override { return 0; }
  double fastest() const override { return 1; }

private:
  int left_;
};

struct ThreeAround { // three boundaries around a bonded cylinder at rest
  Log log;
  seen::Seen seen;
  Experiment experiment{small_cylinder(), settings(), TimeStepSettings{}};
  Noted &a = experiment.add(std::make_unique<Noted>("a", log));
  Noted &b = experiment.add(std::make_unique<Noted>("b", log));
  Noted &c = experiment.add(std::make_unique<Noted>("c", log));
  static dem::ModelSettings settings() {
    dem::ModelSettings s;
    s.bond_layout.modulus = 36e9;
    s.bond = dem::ParallelBond::Parameters{0.4, 1e9, 1e9, 0.7853981633974483, 0.3};
    return s;
  }
  void begin(int steps = 1000) {
    std::vector<std::unique_ptr<Stage>> stages;
    stages.push_back(std::make_unique<Counting>(steps));
    experiment.begin(std::make_unique<Program>(seen, std::move(stages)));
  }
};

TEST(experiment, forces_that_throw_on_the_way_to_a_start_leave_the_time_step) {
  ThreeAround s;
  s.begin();
  const double chosen = s.experiment.time_step();
  ASSERT_GT(chosen, 0);
  ASSERT_LT(chosen, 1e-3);
  const std::vector<Vector3> still(s.experiment.model.particles.size());
  s.b.pushing = [] { throw std::runtime_error("no force"); };
  EXPECT_THROW(s.experiment.carry(still, {}, std::vector<Vector3>(3)), std::runtime_error);
  EXPECT_EQ(s.experiment.time_step(), chosen);
}

TEST(experiment, a_step_has_one_order_and_followers_drift_last) {
  ThreeAround s;
  s.a.follows = true;
  s.begin();
  s.experiment.advance(1);
  EXPECT_EQ(s.log, (Log{"b drift", "c drift", "a drift", "a prepare", "b prepare", "c prepare", "a apply",
                        "b apply", "c apply", "a finish", "b finish", "c finish"}));
  for (const Noted *boundary : {&s.a, &s.b, &s.c})
    EXPECT_EQ(boundary->done, std::vector<int>(3, 1)) << boundary->name(); // each part once
}

// Each stays for a while with the particle that it pushes, and sees whether another one is there.
TEST(experiment, boundaries_that_push_one_particle_take_turns) {
  const ThreadLimit limit(2);
  ThreeAround s;
  std::array<std::atomic<int>, 2> at{};
  std::atomic<int> met{0};
  for (const auto &[boundary, particle] : {std::pair{&s.a, 0}, {&s.b, 1}, {&s.c, 0}}) {
    boundary->listed = {particle};
    boundary->pushing = [&met, &here = at[static_cast<std::size_t>(particle)]] {
      if (++here > 1) ++met;
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
      --here;
    };
  }
  s.begin();
  s.experiment.advance(10);
  EXPECT_EQ(met, 0);
}

TEST(experiment, parts_of_boundaries_without_any_do_not_shift_those_of_others) {
  ThreeAround s;
  s.a.parts = 0, s.b.parts = 5, s.c.parts = 1;
  s.begin();
  s.experiment.advance(1);
  EXPECT_EQ(s.b.done, std::vector<int>(5, 1));
  EXPECT_EQ(s.c.done, std::vector<int>(1, 1));
}

// So that they go to the threads that move the particles.
TEST(experiment, parts_of_all_boundaries_are_made_in_the_order_of_their_particles) {
  const ThreadLimit limit(1);
  ThreeAround s;
  s.a.particles = {1, 4, 9}, s.b.particles = {0, 4, 8}, s.c.particles = {2, 3, 4};
  s.begin();
  s.experiment.advance(1);
  Log parts;
  for (const std::string &line : s.log)
    if (line.find("part") != std::string::npos) parts.push_back(line);
  EXPECT_EQ(parts, (Log{"b part 0", "a part 0", "c part 0", "c part 1", "a part 1", "b part 1", "c part 2",
                        "b part 2", "a part 2"}));
}

TEST(experiment, each_boundary_gets_its_own_command_and_the_step) {
  ThreeAround s;
  s.begin();
  s.experiment.advance(2);
  const double dt = s.experiment.time_step();
  EXPECT_EQ(s.a.commands[0].velocity[2], 1);
  EXPECT_EQ(s.b.commands[1].velocity[2], 2);
  EXPECT_EQ(s.c.commands[1].velocity[2], 3);
  EXPECT_EQ(s.c.steps[0].number, 0);
  EXPECT_EQ(s.c.steps[1].number, 1);
  EXPECT_EQ(s.c.steps[1].dt, dt);
  EXPECT_NEAR(s.c.steps[1].time, 2 * dt, 1e-20);
}

TEST(experiment, power_on_the_machine_is_its_work_by_the_trapezoid) {
  ThreeAround s;
  s.a.power = 8, s.c.power = -2; // W, at both ends of the drift together
  s.begin();
  s.experiment.advance(10);
  EXPECT_NEAR(s.experiment.energy().boundary, -0.5 * 6 * 10 * s.experiment.time_step(), 1e-18);
  EXPECT_EQ(s.experiment.energy().bodies, 0.75);
}

TEST(experiment, a_step_that_falls_tells_where_it_is_set_and_one_that_need_not_stays) {
  ThreeAround s;
  dem::GroundSpring spring;
  spring.particle = 5;
  spring.normal = {0, 0, 1};
  spring.normal_stiffness = 1e13; // N/m, far above that of bonds
  s.a.springs = {spring};
  s.begin();
  s.experiment.advance(1);
  const double first = s.experiment.time_step();
  const std::string place = "highest mode at particle " + std::to_string(s.experiment.model.particles.id[5]);
  EXPECT_NE(s.experiment.time_step_reason().find(place), std::string::npos)
      << s.experiment.time_step_reason();
  s.a.stiffer = true;
  spring.particle = 9;
  spring.normal_stiffness *=
      1.2 * s.experiment.model.particles.mass[9] / s.experiment.model.particles.mass[5];
  s.a.springs = {spring};
  s.experiment.advance(1);
  const double second = s.experiment.time_step();
  EXPECT_NEAR(second, first / std::sqrt(1.2), 0.01 * first);
  const std::string next = "highest mode at particle " + std::to_string(s.experiment.model.particles.id[9]);
  const std::string told = s.experiment.time_step_reason();
  EXPECT_NE(told.find(next), std::string::npos) << told;
  s.a.springs[0].normal_stiffness *= 0.5;
  s.experiment.advance(1);
  EXPECT_EQ(s.experiment.time_step(), second);
  EXPECT_EQ(s.experiment.time_step_reason(), told);
}

TEST(experiment, the_smallest_limit_of_a_boundary_sets_the_step_with_its_reason) {
  ThreeAround free, held;
  free.begin();
  const double limit = free.experiment.time_step() / 0.8;
  held.b.own = {0.5 * limit, "a thin sheet"};
  held.c.own = {0.7 * limit, "a thick sheet"};
  held.begin();
  EXPECT_EQ(held.experiment.time_step_reason(), "a thin sheet");
  EXPECT_NEAR(held.experiment.time_step(), 0.8 * 0.5 * limit, 1e-12 * limit);
}

TEST(experiment, boundaries_of_one_name_and_those_named_as_other_parts_are_refused) {
  for (const std::string taken : {"b", "specimen", "program"}) {
    ThreeAround s;
    s.experiment.add(std::make_unique<Noted>(taken, s.log));
    try {
      s.begin();
      FAIL() << taken << " began";
    } catch (const BadSetup &e) {
      EXPECT_EQ(e.member(), "boundaries");
      EXPECT_NE(e.reason().find("the name " + taken), std::string::npos) << e.reason();
    }
  }
}

TEST(experiment, steps_end_early_where_the_program_is_over_and_go_on_if_asked) {
  ThreeAround s;
  s.begin(7);
  EXPECT_EQ(s.experiment.advance(20), 7);
  EXPECT_TRUE(s.experiment.program().finished());
  EXPECT_EQ(s.experiment.advance(20), 20);
  EXPECT_EQ(s.experiment.steps(), 27);
}

TEST(experiment, a_boundary_that_is_not_finite_stops_the_run_by_its_name) {
  ThreeAround s;
  s.begin();
  s.experiment.advance(3);
  s.b.finite = false;
  try {
    s.experiment.advance(10);
    FAIL() << "went on";
  } catch (const NumericsStopped &e) {
    EXPECT_NE(std::string(e.what()).find("the force on the b at step 4"), std::string::npos) << e.what();
  }
}

} // namespace
} // namespace platen::coupling::experiment_test
