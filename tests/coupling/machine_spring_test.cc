// The spring of a machine, by itself and behind platens of every kind: oscillation and decay, its stable
// step, what falls by itself, and what is in series.
#include "coupling/boundaries/machine_spring.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "base/pi.h"
#include "coupling/platen_test.h"
#include "tests/coupling/set_ups.h"

namespace platen::coupling::machine_spring_test {
namespace {

constexpr double k = 4e6, m = 0.1; // N/m, kg
const double omega = std::sqrt(k / m);

// A crosshead that starts at full speed and goes on: x - q = V/w exp(-xi w t) sin(w_d t) / sqrt(1 - xi^2), to
// the second order of the step.
TEST(machine_spring, swings_at_its_frequency_and_decays_by_its_damping) {
  constexpr double speed = 0.1;
  for (const double xi : {0.0, 0.1, 0.5}) {
    double error[2];
    for (const bool fine : {false, true}) {
      MachineSpring spring({k, m, xi});
      const double dt = (fine ? 0.01 : 0.02) / omega;
      error[fine] = 0;
      for (int n = 1; n * dt * omega < 30; ++n) {
        spring.drift(speed, 0, dt);
        spring.finish(0, dt);
        const double t = n * dt, root = std::sqrt(1 - xi * xi);
        const double exact = speed / omega / root * std::exp(-xi * omega * t) * std::sin(root * omega * t);
        error[fine] = std::max(error[fine], std::abs(spring.compression() - exact) * omega / speed);
      }
    }
    EXPECT_LT(error[1], 5e-4) << xi;
    EXPECT_NEAR(error[0] / error[1], 4, 0.2) << xi;
  }
}

// On a specimen of stiffness s, which is lossless: what the machine did is in springs and motion, or lost to
// the dashpot, but for the band of velocity Verlet, m dt^2 a^2 / 8.
TEST(machine_spring, its_works_are_those_that_change_its_energy) {
  MachineSpring spring({k, m, 0.1});
  constexpr double s = 3e6;
  const double dt = 0.3 / omega, c = 0.2 * std::sqrt(k * m);
  double q = 0, work = 0, most = 0, band = 0;
  for (int n = 0; n < 400; ++n) {
    const double speed = 0.1 * std::cos(0.02 * n); // presses, and turns round
    const auto square = [&] {
      const double a = (k * spring.compression() - s * q + c * (speed - spring.velocity())) / m;
      return a * a;
    };
    band -= m * dt * dt / 8 * square();
    q += dt * spring.drift(speed, s * q, dt);
    spring.finish(s * q, dt);
    band += m * dt * dt / 8 * square();
    work += 0.5 * dt * spring.power();
    const double stored = spring.elastic_energy() + spring.kinetic_energy() + 0.5 * s * q * q;
    most = std::max(most, stored);
    ASSERT_NEAR(stored + spring.damping_work() - work, band, 1e-12 * most) << n;
  }
  EXPECT_GT(spring.damping_work(), 0.03 * most);
}

// Bounded just below its limit and not above, with its own dashpot and without.
TEST(machine_spring, its_step_is_the_largest_stable_one) {
  constexpr double s = 3e7; // N/m, of the specimen
  for (const double xi : {0.0, 0.3})
    for (const double share : {0.99, 1.01}) {
      MachineSpring spring({k, m, xi});
      const double dt = share * spring.stable_step(s, 0);
      double q = 0, most = 0;
      for (int n = 0; n < 3000; ++n) {
        q += dt * spring.drift(n == 0 ? 0.1 : 0.0, s * q, dt);
        spring.finish(s * q, dt);
        most = std::max(most, std::abs(q) / (0.1 * dt));
      }
      EXPECT_EQ(most < 100, share < 1) << xi << " " << most;
      EXPECT_EQ(most > 1e6, share > 1) << xi << " " << most;
    }
  const MachineSpring spring({k, m, 0.1});
  const double c = 500, dt = spring.stable_step(s, c);
  EXPECT_NEAR(dt * dt * (k + s) + 2 * dt * c, 4 * m, 1e-12 * m);
}

// A specimen of stiffness s up to a peak, which then falls by f per closure.
struct Falling {
  double s = 1e7, peak = 1e3, f = 5e6;
  double load(double q) const { return q < peak / s ? s * q : std::max(0.0, peak - f * (q - peak / s)); }
};

struct Fall {
  double kinetic = 0; // J, largest until it bears nothing
  double seconds = 0; // from the peak till then
};
Fall fall_of(const Falling &specimen, double stiffness, double speed) {
  MachineSpring spring({stiffness, 1e-3, 0});
  const double dt = 0.02 * std::sqrt(1e-3 / (stiffness + specimen.s)), peak = specimen.peak / specimen.s;
  double q = 0;
  Fall fall;
  for (long n = 0; q < peak || specimen.load(q) > 0; ++n) {
    const double ramp = std::min(1.0, 1e-4 * static_cast<double>(n)); // starts without a swing
    q += dt * spring.drift(ramp * speed, specimen.load(q), dt);
    spring.finish(specimen.load(q), dt);
    fall.kinetic = std::max(fall.kinetic, spring.kinetic_energy());
    if (q > peak) fall.seconds += dt;
  }
  return fall;
}

// Stable where the machine is stiffer than the fall: the platen then goes k / (k - f) as fast as the
// crosshead. Softer, it runs ahead with what the spring gives and the specimen does not take, (P^2 / 2 f) (1
// - k / f), however slow the test.
TEST(machine_spring, a_specimen_falls_by_itself_where_the_machine_is_softer_than_the_fall) {
  const Falling specimen;
  constexpr double speed = 0.01;
  const double path = specimen.peak / specimen.f, area = 0.5 * specimen.peak * path;
  for (const double ratio : {0.1, 0.5, 0.9}) {
    const Fall fall = fall_of(specimen, ratio * specimen.f, 0.1 * speed);
    EXPECT_NEAR(fall.kinetic, area * (1 - ratio), 0.02 * area) << ratio;
    EXPECT_LT(fall.seconds, 0.05 * path / speed) << ratio;
  }
  for (const double ratio : {1.5, 3.0, 10.0}) {
    const Fall fall = fall_of(specimen, ratio * specimen.f, speed);
    EXPECT_LT(fall.kinetic, 1e-4 * area) << ratio;
    EXPECT_NEAR(fall.seconds * speed / path, (ratio - 1) / ratio, 0.01) << ratio;
  }
}

TEST(machine_spring, what_is_no_spring_is_refused) {
  EXPECT_THROW(MachineSpring({not_given, m, 0.1}), BadParameter);
  EXPECT_THROW(MachineSpring({k, not_given, 0.1}), BadParameter);
  EXPECT_THROW(MachineSpring({-k, m, 0.1}), BadParameter);
  EXPECT_THROW(PlatenTest(sphere(), one_sphere(-1)), BadParameter);
  EXPECT_THROW(MachineSpring({k, 0, 0.1}), BadParameter);
  EXPECT_THROW(MachineSpring({k, m, 1.1}), BadParameter);
}

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
      const double xi = 0.1, frequency = std::sqrt(1e6 / whole), root = std::sqrt(1 - xi * xi),
                   speed = 0.5 * 0.01;
      settings.time_step.fixed_step = std::min(0.01 / frequency, PlatenTest(sphere(), settings).time_step());
      PlatenTest test(sphere(), settings);
      EXPECT_EQ(test.machine()->settings().mass, whole);
      double error = 0;
      while (test.time() * frequency < 12) {
        advance_to(test, test.steps() + 1);
        const double t = test.time();
        const double exact =
            speed / frequency / root * std::exp(-xi * frequency * t) * std::sin(root * frequency * t);
        error = std::max(error, std::abs(test.machine()->compression() - exact) * frequency / speed);
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
      PlatenTestSettings settings = with(one_sphere(machine * contact_stiffness), kind);
      // With the square of the step falls what the light vertex under the sphere swings between kicks.
      if (kind.elastic && !kind.quasi_static) settings.time_step.fixed_step = 2e-8;
      PlatenTest test(sphere(), settings);
      advance_until(test, rigid ? 2e-3 : 8e-4);
      const double force = test.top().load(), spring = test.machine()->settings().stiffness;
      const double lag = 2 * 0.3 * std::sqrt(test.machine()->settings().mass / spring),
                   rate = 0.01 - test.platen_speed();
      EXPECT_GT(force, 0.5);
      EXPECT_NEAR((test.machine_closure() - clamp_closure(test) + lag * rate) * spring / force, 1,
                  rigid ? 1e-3 : 2e-3);
      EXPECT_NEAR(test.bottom().load() / force, 1, 2e-3);
      EXPECT_NEAR(test.closure_strain() * 2e-3, 2 * force / contact_stiffness,
                  (rigid ? 2e-3 : 0.04) * force / contact_stiffness);
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
  EXPECT_NEAR(without.top().load() / without.bottom().closure() / contact_stiffness, 1,
              1e-3); // half of the closure
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

// A spring that is stiff against the light nodes of a clamp, or against a rigid platen.
TEST(machine_platens, the_time_step_counts_the_spring) {
  for (const PlatenKind &kind : all_kinds) {
    PlatenTestSettings settings = with(one_sphere(contact_stiffness), kind);
    settings.platens.damping = 0;
    const double soft = PlatenTest(sphere(), settings).time_step();
    settings.platens.machine.stiffness = 1e5 * contact_stiffness;
    PlatenTest test(sphere(), settings);
    EXPECT_LT(test.time_step(), 0.5 * soft) << kind.name;
    EXPECT_NE(test.time_step_reason().find("spring of the machine"), std::string::npos)
        << kind.name << ": " << test.time_step_reason();
    if (!kind.elastic && !kind.seat) {
      const double mass = test.top().body().mass();
      EXPECT_EQ(test.machine()->settings().mass, mass);
      EXPECT_NEAR(test.time_step(), 0.8 * 2 * std::sqrt(mass / (1e5 * contact_stiffness)),
                  2e-3 * test.time_step());
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
} // namespace platen::coupling::machine_spring_test
