// What an effect costs that is off: no column, no byte, and none of its instructions.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

#include "base/parallel.h"
#include "base/random.h"
#include "tests/dem/examples.h"
#include "tests/dem/instructions.h"
#include "tests/measured.h"

namespace platen::dem {
namespace {

using namespace examples;

// Eight spheres at the corners of a cube, and twelve pairs of neighbours at its edges.
constexpr std::size_t edges = 12;
Specimen cube() {
  std::vector<Vector3> centres;
  for (int k = 0; k < 8; ++k)
    centres.push_back(2 * radius * Vector3{1.0 * (k % 2), 1.0 * (k / 2 % 2), 1.0 * (k / 4)});
  return spheres(centres);
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
struct Effect {
  const char *name;
  ModelSettings (*scene)();
  Change before; // what the effect needs, on in both
  Change on;
  std::vector<std::string> columns; // that it alone has
  // Instructions that it adds to the loops of a step, at least: about half of what GCC 12 makes of it, for
  // other compilers. Loops that do its work and throw it away save next to nothing.
  long least;
};
void PrintTo(const Effect &effect, std::ostream *to) {
  *to << effect.name;
}

void nothing(ModelSettings &) {}
void turn(ModelSettings &s) {
  s.rotation = true;
}
void rub(ModelSettings &s) {
  s.contact->tangential = TangentialContact::coulomb;
}
void roll(ModelSettings &s) {
  s.contact->tangential = TangentialContact::coulomb_with_rolling;
}

std::vector<Effect> effects() {
  return {
      {"rotation_of_bonded_spheres",
       bare_bonds,
       nothing,
       turn,
       {"particles orientation", "particles angular_velocity", "particles torque", "particles inertia"},
       1000},
      {"rotation_of_grains",
       bare_grains,
       nothing,
       turn,
       {"particles orientation", "particles angular_velocity", "particles torque", "particles inertia"},
       600},
      {"bond_moments",
       bare_bonds,
       [](ModelSettings &s) {
         turn(s);
         s.bond_dashpot = .1;
       },
       [](ModelSettings &s) { parallel_bond(s).moments = true; },
       {"bonds dashpot_bending", "bonds dashpot_moment"},
       800},
      {"bond_dashpots",
       bare_bonds,
       nothing,
       [](ModelSettings &s) { s.bond_dashpot = .1; },
       {"bonds dashpot", "bonds dashpot_force"},
       300},
      {"strength_factors",
       bare_bonds,
       nothing,
       [](ModelSettings &s) {
         s.strength_scatter = StrengthScatter{8., 1};
       },
       {"bonds strength_factor"},
       12},
      {"dissipative_scheme",
       bare_bonds,
       nothing,
       [](ModelSettings &s) { s.scheme = Scheme::tchamwa_wielgosz, s.dissipation = 1.2; },
       {"particles excess_velocity"},
       60},
      {"dissipative_scheme_of_turning_spheres",
       bare_bonds,
       turn,
       [](ModelSettings &s) { s.scheme = Scheme::tchamwa_wielgosz, s.dissipation = 1.2; },
       {"particles excess_velocity", "particles excess_spin"},
       130},
      {"friction",
       bare_grains,
       nothing,
       rub,
       {"contacts normal", "contacts spring", "contacts tangential_stiffness", "contacts sliding"},
       1500},
      {"rolling",
       bare_grains,
       [](ModelSettings &s) {
         turn(s);
         rub(s);
       },
       roll,
       {"contacts rolling", "contacts rolling_stiffness"},
       1400},
      {"contact_dashpots",
       bare_grains,
       nothing,
       [](ModelSettings &s) { s.contact->damping = .1; },
       {"contacts dashpot"},
       300},
      {"hertz",
       bare_grains,
       nothing,
       [](ModelSettings &s) { s.contact->normal = NormalContact::hertz; },
       {},
       40},
  };
}

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
  EXPECT_EQ(own, GetParam().columns);
  EXPECT_EQ(less.size() + own.size(), more.size());
  EXPECT_EQ(bytes > 0, !own.empty());
  EXPECT_EQ(with->bytes() - without->bytes(), bytes);
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

INSTANTIATE_TEST_SUITE_P(effects_off, EffectsOff, testing::ValuesIn(effects()),
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

} // namespace
} // namespace platen::dem
