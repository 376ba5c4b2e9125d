// Effects that are on and have nothing to do change no bit of the motion.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <memory>
#include <ostream>
#include <string>

#include "base/random.h"
#include "tests/dem/examples.h"

namespace platen::dem {
namespace {

using namespace examples;

using Change = void (*)(ModelSettings &);
void nothing(ModelSettings &) {}
void rub(ModelSettings &s) {
  s.contact->tangential = TangentialContact::coulomb;
}
void roll(ModelSettings &s) {
  s.contact->tangential = TangentialContact::coulomb_with_rolling;
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

INSTANTIATE_TEST_SUITE_P(
    effects_off, IdleEffects,
    testing::Values(Idle{"friction_of_no_coefficient", [](ModelSettings &s) { s.contact->friction = 0; },
                         rub},
                    Idle{"rolling_of_no_coefficient", rub, roll},
                    Idle{"factors_of_one", nothing,
                         [](ModelSettings &s) {
                           s.strength_scatter = StrengthScatter{1e18, 1};
                         }},
                    Idle{"crack_log", nothing, [](ModelSettings &s) { s.crack_log = false; }},
                    Idle{"energy_ledger", rub, [](ModelSettings &s) { s.energy_ledger = false; }}),
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
} // namespace platen::dem
