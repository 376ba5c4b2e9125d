// The machine's spring behind platens that are bodies of their own: elastic ones, with inertia and without,
// and such on a spherical seat.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "tests/coupling/set_ups.h"

namespace platen::coupling {
namespace {

// The crosshead starts at once at full speed; the sphere hardly bears anything.
TEST(machine_platens, an_elastic_one_swings_on_the_spring_with_all_of_the_mass) {
  for (const PlatenKind &kind : {yielding, followed})
    for (const double mass : {not_given, 5e-4}) {
      PlatenTestSettings settings = with(one_sphere(1e6), kind);
      settings.platens.stiffness.value = 1;
      settings.platens.machine.mass = mass;
      settings.platens.machine.damping = 0.1;
      settings.loading.ramp = 1e-12;
      const double own = PlatenTest(sphere(), settings).top().body().mass(),
                   whole = std::isnan(mass) ? own : mass;
      const double xi = 0.1, omega = std::sqrt(1e6 / whole), root = std::sqrt(1 - xi * xi),
                   speed = 0.5 * 0.01;
      settings.time_step.fixed_step = std::min(0.01 / omega, PlatenTest(sphere(), settings).time_step());
      PlatenTest test(sphere(), settings);
      EXPECT_EQ(test.machine()->settings().mass, whole);
      double error = 0;
      while (test.time() * omega < 12) {
        advance_to(test, test.steps() + 1);
        const double t = test.time();
        const double exact = speed / omega / root * std::exp(-xi * omega * t) * std::sin(root * omega * t);
        error = std::max(error, std::abs(test.machine()->compression() - exact) * omega / speed);
      }
      // The platen itself is a thousand times as stiff.
      EXPECT_LT(error, 5e-3) << kind.name << " " << mass;
      EXPECT_LT(residual(test), 1e-3) << kind.name << " " << mass;
    }
}

// What the crosshead goes beyond the platens' far ends is the load over the stiffness of the machine, and
// what its dashpot bears of the load.
TEST(machine_platens, are_in_series_with_the_machine) {
  for (const PlatenKind &kind : softer_kinds)
    for (const double machine : {0.1 * contact, 100 * contact}) {
      PlatenTestSettings settings = with(one_sphere(machine), kind);
      // With the square of the step falls what the light vertex under the sphere swings between kicks.
      if (kind.elastic && !kind.quasi_static) settings.time_step.fixed_step = 2e-8;
      PlatenTest test(sphere(), settings);
      advance_until(test, 8e-4);
      const double force = test.top().load();
      const double lag = 2 * 0.3 * std::sqrt(test.machine()->settings().mass / machine),
                   rate = 0.01 - test.platen_speed();
      EXPECT_GT(force, 0.5);
      EXPECT_NEAR((test.machine_closure() - clamp_closure(test) + lag * rate) * machine / force, 1, 2e-3)
          << kind.name << " " << machine;
      EXPECT_NEAR(test.bottom().load() / force, 1, 2e-3);
      // The specimen closes by what is left of the path, less what yields.
      EXPECT_NEAR(test.closure_strain() * 2e-3, 2 * force / contact, 0.04 * force / contact) << kind.name;
      EXPECT_LT(residual(test), 1e-3) << kind.name << " " << machine;
      EXPECT_GT(test.energy().bodies, 0.5 * test.machine()->elastic_energy());
    }
}

// A column that is pulled until a bond breaks: what the spring holds becomes motion of the mass, the more
// the softer the machine.
TEST(machine_platens, a_soft_machine_jumps_with_what_it_holds_when_the_specimen_breaks) {
  dem::Specimen column = sphere();
  column.shape = dem::box(2e-3, 2e-3, 6e-3);
  column.centre = {{0, 0, 1e-3}, {0, 0, 3e-3}, {0, 0, 5e-3}}, column.radius.assign(3, 1e-3);
  for (const PlatenKind &kind : {yielding, followed}) {
    double motion[2];
    for (const bool stiff : {false, true}) {
      const double machine = stiff ? 1e6 : 1e5;
      PlatenTestSettings settings = with(one_sphere(machine), kind);
      settings.model.bond_layout.modulus = 36e9;
      settings.model.bond_layout.gap.value = 0.05;
      settings.model.bond = dem::ParallelBond::Parameters{0.4, 2e6, 20e6, 0.785, 0.3};
      settings.platens.glued = true;
      settings.platens.machine.mass = 5e-3;
      settings.platens.machine.damping = 0;
      settings.loading.tension = true;
      settings.loading.ramp = 1e-3;
      settings.loading.rate = stiff ? 2e-3 : 2e-2;
      PlatenTest test(column, settings);
      double held = 0, peak = 0;
      motion[stiff] = 0;
      while (test.model.broken_tension == 0 && test.time() < 0.1) {
        peak = -test.top().load(), held = test.machine()->elastic_energy();
        advance_to(test, test.steps() + 10);
      }
      ASSERT_GT(test.model.broken_tension, 0);
      const double broken = test.time();
      while (test.time() < broken + 2 * std::sqrt(5e-3 / machine)) {
        advance_to(test, test.steps() + 10);
        motion[stiff] = std::max(motion[stiff], test.machine()->kinetic_energy());
      }
      EXPECT_NEAR(held * 2 * machine / (peak * peak), 1, 0.05) << kind.name << machine;
      // Seen from the crosshead.
      const double with_it = std::sqrt(0.5 * 5e-3) * 0.5 * settings.loading.rate;
      EXPECT_NEAR(std::sqrt(motion[stiff] / held) - with_it / std::sqrt(held), 1, 0.01)
          << kind.name << machine;
      EXPECT_LT(residual(test), 1e-3) << kind.name << machine;
    }
    EXPECT_NEAR(motion[0] / motion[1], 10, 1) << kind.name;
  }
}

// A spring that is stiff against the light nodes of a clamp.
TEST(machine_platens, the_time_step_counts_the_spring) {
  for (const PlatenKind &kind : softer_kinds) {
    PlatenTestSettings settings = with(one_sphere(contact), kind);
    const double soft = PlatenTest(sphere(), settings).time_step();
    settings.platens.machine.stiffness = 1e5 * contact;
    PlatenTest test(sphere(), settings);
    EXPECT_LT(test.time_step(), 0.5 * soft) << kind.name;
    EXPECT_NE(test.time_step_reason().find("spring of the machine"), std::string::npos)
        << kind.name << ": " << test.time_step_reason();
    advance_to(test, 20000);
    EXPECT_LT(residual(test), 1e-3) << kind.name;
  }
}

} // namespace
} // namespace platen::coupling
