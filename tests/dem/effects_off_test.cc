// What an effect costs that is off: no column, no byte, and none of its instructions. Effects that are on and
// have nothing to do change no bit of the motion.
#include <gtest/gtest.h>
#include <sys/ptrace.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstring>
#include <functional>
#include <map>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

#include "base/parallel.h"
#include "base/random.h"
#include "tests/dem/examples.h"
#include "tests/measured.h"

namespace platen::dem::effects_off_test {
namespace {

using namespace examples;

// Eight spheres at the corners of a cube, and twelve pairs of neighbours at its edges.
constexpr std::size_t edges = 12;
Specimen cube() {
  return cubic(2, 2, 2);
}

// Scenes in which every effect of this test is off. The plainest kernels: two lanes.
ModelSettings bare_bonds() {
  ModelSettings s = bonded();
  s.rotation = s.energy_ledger = s.crack_log = parallel_bond(s).moments = false;
  s.instruction_set = InstructionSet::baseline;
  return s;
}
ModelSettings bare_grains() {
  ModelSettings s = bare_bonds();
  s.bond.reset();
  s.contact = ContactSettings{};
  s.contact->damping = 0;
  s.contact->tangential = TangentialContact::none;
  s.contact->friction = .5;
  s.contact->rolling_friction = .1;
  s.contact->young_modulus = modulus;
  s.contact->poisson_ratio = .2;
  return s;
}

using Change = void (*)(ModelSettings &);
const Change nothing = [](ModelSettings &) {};
const Change turn = [](ModelSettings &s) { s.rotation = true; };
const Change rub = [](ModelSettings &s) { s.contact->tangential = TangentialContact::coulomb; };
const Change roll = [](ModelSettings &s) { s.contact->tangential = TangentialContact::coulomb_with_rolling; };
const Change turn_and_rub = [](ModelSettings &s) { turn(s), rub(s); };
const Change dash = [](ModelSettings &s) { s.bond_dashpot = .1; };
const Change turn_and_dash = [](ModelSettings &s) { turn(s), dash(s); };
const Change bend = [](ModelSettings &s) { parallel_bond(s).moments = true; };
const Change scatter = [](ModelSettings &s) { s.strength_scatter = StrengthScatter{8., 1}; };
const Change dissipate = [](ModelSettings &s) { s.scheme = Scheme::tchamwa_wielgosz, s.dissipation = 1.2; };
const Change damp = [](ModelSettings &s) { s.contact->damping = .1; };
const Change hertz = [](ModelSettings &s) { s.contact->normal = NormalContact::hertz; };

struct Effect {
  const char *name;
  ModelSettings (*scene)();
  Change before, on; // what the effect needs, on in both; the effect
  // Instructions that it adds to the loops of a step, at least: about half of what GCC 12 makes of it, for
  // other compilers. Loops that do its work and throw it away save next to nothing.
  long least;
  const char *table;                // of the columns that it alone has
  std::vector<std::string> columns; // their names
};
void PrintTo(const Effect &effect, std::ostream *to) {
  *to << effect.name;
}

const std::vector<std::string> turning{"orientation", "angular_velocity", "torque", "inertia"};
const std::vector<std::string> rubbing{"normal", "spring", "tangential_stiffness", "sliding"};
const Effect effects[] = {
    {"rotation_of_bonded_spheres", bare_bonds, nothing, turn, 1000, "particles", turning},
    {"rotation_of_grains", bare_grains, nothing, turn, 600, "particles", turning},
    {"bond_moments", bare_bonds, turn_and_dash, bend, 800, "bonds", {"dashpot_bending", "dashpot_moment"}},
    {"bond_dashpots", bare_bonds, nothing, dash, 300, "bonds", {"dashpot", "dashpot_force"}},
    {"strength_factors", bare_bonds, nothing, scatter, 12, "bonds", {"strength_factor"}},
    {"dissipative_scheme", bare_bonds, nothing, dissipate, 60, "particles", {"excess_velocity"}},
    {"dissipative_scheme_of_turning_spheres",
     bare_bonds,
     turn,
     dissipate,
     130,
     "particles",
     {"excess_velocity", "excess_spin"}},
    {"friction", bare_grains, nothing, rub, 1500, "contacts", rubbing},
    {"rolling", bare_grains, turn_and_rub, roll, 1400, "contacts", {"rolling", "rolling_stiffness"}},
    {"contact_dashpots", bare_grains, nothing, damp, 300, "contacts", {"dashpot"}},
    {"hertz", bare_grains, nothing, hertz, 40, "contacts", {}}};

struct Listed {
  std::string name;
  std::size_t bytes; // of the column
};
std::vector<Listed> columns_of(const Model &model) {
  std::vector<Listed> all;
  const auto add = [&](const std::string &of, const Table &table) {
    for (const auto &column : table.columns())
      all.push_back({of + " " + column->name(), table.size() * column->bytes_per_row()});
  };
  add("particles", model.particles.table);
  if (model.bonds) add("bonds", model.bonds->table);
  if (model.bonds) add("records", model.bonds->records);
  if (model.contacts) add("contacts", model.contacts->table);
  return all;
}

// All bonds stretched, all grains pressed, and everything in motion.
void set_in_motion(Particles &p) {
  Random random(3);
  for (std::size_t i = 0; i < p.size(); ++i) {
    p.position[i] *= .999;
    p.position[i] += 1e-5 * radius * random.direction();
    p.velocity[i] = 1e-3 * random.direction();
    const Vector3 spin = random.direction();
    if (p.has_rotation()) (*p.angular_velocity)[i] = spin;
  }
}
constexpr double dt = 1e-8; // s, far below any limit

std::unique_ptr<Model> in_motion(const ModelSettings &settings, int steps) {
  auto model = std::make_unique<Model>(cube(), settings);
  set_in_motion(model->particles);
  for (int s = 0; s < steps; ++s)
    step(*model, dt);
  return model;
}

class EffectsOff : public testing::TestWithParam<Effect> {
protected:
  ModelSettings off() const {
    ModelSettings s = GetParam().scene();
    GetParam().before(s);
    return s;
  }
  ModelSettings on() const {
    ModelSettings s = off();
    GetParam().on(s);
    return s;
  }
};

TEST_P(EffectsOff, have_no_columns_and_no_bytes) {
  const auto with = in_motion(on(), 2), without = in_motion(off(), 2);
  ASSERT_EQ(without->bonds ? without->bonds->size() : without->contacts->touching_count(), edges);
  const std::vector<Listed> more = columns_of(*with), less = columns_of(*without);
  const auto has = [](const std::vector<Listed> &columns, const std::string &name) {
    return std::any_of(columns.begin(), columns.end(), [&](const Listed &c) { return c.name == name; });
  };
  std::vector<std::string> own;
  std::size_t bytes = 0;
  for (const Listed &column : more)
    if (!has(less, column.name)) own.push_back(column.name), bytes += column.bytes;
  std::vector<std::string> expected;
  for (const std::string &column : GetParam().columns)
    expected.push_back(GetParam().table + (" " + column));
  EXPECT_EQ(own, expected);
  EXPECT_EQ(less.size() + own.size(), more.size());
  EXPECT_EQ(bytes > 0, !own.empty());
  EXPECT_EQ(with->bytes() - without->bytes(), bytes);
}

// Instructions that a piece of work takes, exactly, on any Linux: processors count them too, but not where
// they are shared out to guests. Of one thread. A child process does the work twice, so that memory and
// libraries are ready, and this one lets it go on one instruction at a time: some microseconds each. What the
// work changes is the child's. -1 where the system does not allow that.
long instructions_of(const std::function<void()> &work) {
  const pid_t child = fork();
  if (child == 0) {
    if (ptrace(PTRACE_TRACEME, 0, nullptr, nullptr) != 0) _exit(1);
    work();
    raise(SIGSTOP);
    work();
    raise(SIGSTOP);
    _exit(0);
  }
  long count = -1;
  int status = 0;
  waitpid(child, &status, 0);
  if (WIFSTOPPED(status) && WSTOPSIG(status) == SIGSTOP) do {
      ++count;
      ptrace(PTRACE_SINGLESTEP, child, nullptr, nullptr);
      waitpid(child, &status, 0);
    } while (WIFSTOPPED(status) && WSTOPSIG(status) == SIGTRAP);
  const bool done = WIFSTOPPED(status) && WSTOPSIG(status) == SIGSTOP;
  if (WIFSTOPPED(status)) {
    kill(child, SIGKILL);
    waitpid(child, &status, 0);
  }
  return done ? count : -1;
}

// The loops over rows that a step consists of, without the clocks of its stages.
long instructions_of_loops(const ModelSettings &settings) {
  const ThreadLimit one(1);
  const auto model = in_motion(settings, 2);
  const Integrator how{settings.rotation,      settings.local_damping,   settings.gravity,
                       settings.energy_ledger, settings.instruction_set, settings.phi()};
  std::vector<BondBreak> breaks;
  KickSums sums;
  return instructions_of([&] {
    if (model->bonds)
      compute_bond_forces(model->particles, *model->bonds, settings.instruction_set, {}, dt, breaks);
    if (model->contacts) model->contacts->compute(model->particles, dt);
    how.end_and_begin(model->particles, {}, dt, dt, sums);
  });
}

// Counted once for all effects that are added to the same.
long instructions_without(const Effect &effect, const ModelSettings &off) {
  static std::map<std::pair<ModelSettings (*)(), Change>, long> counted;
  const auto [at, is_new] = counted.insert({{effect.scene, effect.before}, 0});
  if (is_new) at->second = instructions_of_loops(off);
  return at->second;
}

TEST_P(EffectsOff, take_no_instructions) {
  const long with = instructions_of_loops(on()), without = instructions_without(GetParam(), off());
  if (with < 0 || without < 0) GTEST_SKIP() << "no process may step another one here";
  const long saved = with - without, least = GetParam().least;
  measured::note_figure(
      46, std::string("instructions_saved_of_") + std::to_string(with) + "_without_" + GetParam().name,
      static_cast<double>(saved), ">= " + std::to_string(least));
  EXPECT_GE(saved, least) << "of " << with;
}

INSTANTIATE_TEST_SUITE_P(effects_off, EffectsOff, testing::ValuesIn(effects),
                         [](const auto &effect) { return std::string(effect.param.name); });

// Stages of what a scene has not are not even begun.
TEST(effects_off, stages_that_are_off_take_no_time) {
  const auto bonds = in_motion(bare_bonds(), 20), grains = in_motion(bare_grains(), 20);
  for (const Stage stage : {Stage::search, Stage::contacts}) {
    EXPECT_EQ(bonds->clock.seconds(stage), 0);
    EXPECT_GT(grains->clock.seconds(stage), 0);
  }
  EXPECT_EQ(grains->clock.seconds(Stage::bonds), 0);
  EXPECT_GT(bonds->clock.seconds(Stage::bonds), 0);
}

// A scene, and what is on beside it.
struct Idle {
  const char *name;
  Change scene, on; // of crushed grains without friction
};
void PrintTo(const Idle &idle, std::ostream *to) {
  *to << idle.name;
}

struct Crushed {
  std::unique_ptr<Model> model;
  std::size_t touches = 0; // sum over steps
};
// Driven together until bonds have broken and their grains touch.
Crushed crushed(const ModelSettings &settings) {
  Crushed run{std::make_unique<Model>(packed_box(12, 12, 12), settings), 0};
  Random random(5);
  Particles &p = run.model->particles;
  const Vector3 middle{0, 0, 6 * radius};
  for (std::size_t i = 0; i < p.size(); ++i)
    p.velocity[i] = 500 * (middle - p.position[i]) + .3 * random.direction();
  for (int s = 0; s < 100; ++s) {
    step(*run.model, 5e-8);
    run.touches += run.model->contacts->touching_count();
  }
  return run;
}

class IdleEffects : public testing::TestWithParam<Idle> {
protected:
  static ModelSettings settings() {
    ModelSettings s = breakable();
    s.contact->tangential = TangentialContact::none;
    GetParam().scene(s);
    return s;
  }
};

TEST_P(IdleEffects, change_no_bit) {
  ModelSettings with = settings();
  GetParam().on(with);
  const Crushed one = crushed(settings()), other = crushed(with);
  EXPECT_GT(one.model->intact_bonds(), 10u);
  EXPECT_GT(one.model->broken(BondState::broken_in_tension), 100u);
  EXPECT_GT(one.touches, 100u);
  const auto &columns = one.model->particles.table.columns(),
             &others = other.model->particles.table.columns();
  ASSERT_EQ(columns.size(), others.size());
  for (std::size_t c = 0; c < columns.size(); ++c)
    EXPECT_TRUE(std::memcmp(columns[c]->bytes(), others[c]->bytes(),
                            columns[c]->size() * columns[c]->bytes_per_row()) == 0)
        << columns[c]->name();
  EXPECT_EQ(other.model->intact_bonds(), one.model->intact_bonds());
  EXPECT_EQ(other.touches, one.touches);
}

const Idle idle_effects[] = {
    {"friction_of_no_coefficient", [](ModelSettings &s) { s.contact->friction = 0; }, rub},
    {"rolling_of_no_coefficient", rub, roll},
    {"factors_of_one", nothing,
     [](ModelSettings &s) {
       s.strength_scatter = StrengthScatter{1e18, 1};
     }},
    {"crack_log", nothing, [](ModelSettings &s) { s.crack_log = false; }},
    {"energy_ledger", rub, [](ModelSettings &s) { s.energy_ledger = false; }}};
INSTANTIATE_TEST_SUITE_P(effects_off, IdleEffects, testing::ValuesIn(idle_effects),
                         [](const auto &idle) { return std::string(idle.param.name); });

TEST(effects_off, a_ledger_that_is_off_sums_nothing) {
  ModelSettings settings = breakable();
  settings.contact->damping = .1;
  settings.local_damping = .2;
  settings.gravity = {0, 0, -9.81};
  for (const bool ledger : {true, false}) {
    settings.energy_ledger = ledger;
    const Crushed run = crushed(settings);
    EXPECT_EQ(run.model->contacts->friction_work > 0, ledger);
    EXPECT_EQ(run.model->contacts->damping_work > 0, ledger);
    EXPECT_EQ(run.model->works.damping > 0, ledger);
    EXPECT_EQ(run.model->works.weight != 0, ledger);
    EXPECT_EQ(std::isnan(run.model->energy().stored()), !ledger);
    EXPECT_EQ(std::isnan(run.model->energy().lost()), !ledger);
  }
}

TEST(effects_off, a_crack_log_that_is_off_holds_nothing) {
  for (const bool log : {true, false}) {
    ModelSettings settings = breakable();
    settings.crack_log = log;
    Model model(row(1, {1, 0, 0}), settings);
    model.particles.position[1].x += .01 * radius;
    step(model, 1e-9);
    EXPECT_EQ(model.broken(BondState::broken_in_tension), 1u);
    EXPECT_EQ(model.cracks.size(), log ? 1u : 0u);
    EXPECT_EQ(model.cracks.capacity() > 0, log);
  }
}

} // namespace
} // namespace platen::dem::effects_off_test
