// The spring of a machine: oscillation and decay, its stable step, and what falls by itself. Behind platens:
// machine_platens_test.cc.
#include "coupling/boundaries/machine_spring.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/pi.h"
#include "coupling/platen_test.h"
#include "tests/coupling/set_ups.h"

namespace platen::coupling {
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

} // namespace
} // namespace platen::coupling
