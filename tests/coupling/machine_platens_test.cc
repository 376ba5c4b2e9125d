// The machine's spring behind platens of every kind.
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
// what its dashpot bears of the load, 2 xi / w of its rate. What is left of the path is the specimen's, less
// what yields.
TEST(machine_platens, are_in_series_with_the_machine) {
  for (const PlatenKind &kind : all_kinds) {
    const bool rigid = !kind.elastic && !kind.seat;
    for (const double machine : rigid ? std::vector{0.01, 0.1, 1., 100.} : std::vector{0.1, 100.}) {
      SCOPED_TRACE(std::string(kind.name) + " " + std::to_string(machine));
      PlatenTestSettings settings = with(one_sphere(machine * contact), kind);
      // With the square of the step falls what the light vertex under the sphere swings between kicks.
      if (kind.elastic && !kind.quasi_static) settings.time_step.fixed_step = 2e-8;
      PlatenTest test(sphere(), settings);
      advance_until(test, rigid ? 2e-3 : 8e-4);
      const double force = test.top().load(), k = test.machine()->settings().stiffness;
      const double lag = 2 * 0.3 * std::sqrt(test.machine()->settings().mass / k),
                   rate = 0.01 - test.platen_speed();
      EXPECT_GT(force, 0.5);
      EXPECT_NEAR((test.machine_closure() - clamp_closure(test) + lag * rate) * k / force, 1,
                  rigid ? 1e-3 : 2e-3);
      EXPECT_NEAR(test.bottom().load() / force, 1, 2e-3);
      EXPECT_NEAR(test.closure_strain() * 2e-3, 2 * force / contact, (rigid ? 2e-3 : 0.04) * force / contact);
      const dem::EnergyLedger energy = test.energy();
      EXPECT_LT(residual(test), rigid ? 1e-4 : 1e-3);
      EXPECT_GT(energy.bodies, 0.5 * test.machine()->elastic_energy());
      if (rigid) {
        EXPECT_NEAR(energy.boundary, 0.5 * force * test.machine_closure(), 0.02 * energy.boundary);
      }
    }
  }
  PlatenTest without(sphere(), one_sphere(not_given));
  EXPECT_EQ(without.machine(), nullptr);
  EXPECT_TRUE(std::isnan(without.machine_closure()));
  advance_until(without, 2e-3);
  EXPECT_NEAR(without.top().load() / without.bottom().closure() / contact, 1, 1e-3); // half of the closure
}

// A spring that is stiff against the light nodes of a clamp, or against a rigid platen.
TEST(machine_platens, the_time_step_counts_the_spring) {
  for (const PlatenKind &kind : all_kinds) {
    PlatenTestSettings settings = with(one_sphere(contact), kind);
    settings.platens.damping = 0;
    const double soft = PlatenTest(sphere(), settings).time_step();
    settings.platens.machine.stiffness = 1e5 * contact;
    PlatenTest test(sphere(), settings);
    EXPECT_LT(test.time_step(), 0.5 * soft) << kind.name;
    EXPECT_NE(test.time_step_reason().find("spring of the machine"), std::string::npos)
        << kind.name << ": " << test.time_step_reason();
    if (!kind.elastic && !kind.seat) {
      const double mass = test.top().body().mass();
      EXPECT_EQ(test.machine()->settings().mass, mass);
      EXPECT_NEAR(test.time_step(), 0.8 * 2 * std::sqrt(mass / (1e5 * contact)), 2e-3 * test.time_step());
    }
    advance_to(test, 20000);
    EXPECT_LT(residual(test), 1e-3) << kind.name;
  }
}

// What else does not go with it is in faults_test.cc.
TEST(machine_platens, a_mass_below_that_of_its_platen_is_refused) {
  for (const PlatenKind &kind : {rigid_kind, yielding}) {
    PlatenTestSettings settings = with(one_sphere(1e7), kind);
    settings.platens.machine.mass = 1e-6;
    expect_refused(sphere(), settings, "platens.machine.mass", "at least");
  }
}

} // namespace
} // namespace platen::coupling
