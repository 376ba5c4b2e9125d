#include "base/state.h"
#include "coupling/program/platen_speed.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace platen::coupling {
namespace {

// A specimen without inertia: elastic up to a strain, then softening to nothing, or breaking bonds.
struct Specimen {
  double modulus = 20e9, peak = 2e-3, softening = -10e9;
  double broken_per_strain = 0; // beyond `breaks_from`
  double breaks_from = 1;
  double stress(double strain) const {
    return strain < peak ? modulus * strain : std::max(0.0, modulus * peak + softening * (strain - peak));
  }
  double broken(double strain) const { return broken_per_strain * std::max(0.0, strain - breaks_from); }
};

constexpr double transit = 1e-5, dt = 1e-7, rate = 1; // s, s, 1/s of closure: 100 transits in 0.1 %
constexpr RateControl::Parameters parameters{5, transit, 10 * transit, 1e5};

struct Ride {
  double strain = 0, time = 0;
  RateControl control{parameters};
  double step(const Specimen &specimen, double direction = 1) {
    const double factor = control.factor(time, dt);
    strain += direction * rate * factor * dt;
    time += dt;
    control.update(time, specimen.stress(strain), strain, specimen.broken(strain));
    return factor;
  }
  double to(double until, const Specimen &specimen, double direction = 1) {
    double factor = 1;
    while (direction * (until - strain) > 0)
      factor = step(specimen, direction);
    return factor;
  }
};

TEST(rate_control, is_quick_while_elastic_and_slow_while_failing) {
  const Specimen specimen;
  Ride ride;
  EXPECT_EQ(ride.to(9e-5, specimen), 1); // the first ten transits
  EXPECT_EQ(ride.to(1.9e-3, specimen), parameters.multiplier);
  // Found within the five transits of a slope, and slowed down in three.
  ride.to(2e-3 + 8.1 * transit * rate * parameters.multiplier, specimen);
  EXPECT_EQ(ride.step(specimen), 1);
  EXPECT_EQ(ride.to(6e-3, specimen), 1);
  // 1e-4 slow, 4.3 transits of ramp at a mean of 3 ... : a third of what constant speed takes to the peak.
  Ride again;
  again.to(2e-3, specimen);
  EXPECT_LT(again.time, 0.36 * 2e-3 / rate);
}

TEST(rate_control, is_slow_while_bonds_break_though_the_slope_tells_nothing) {
  Specimen specimen;
  specimen.breaks_from = 1e-3;
  specimen.broken_per_strain = 2 * 5e-5 * parameters.bonds / (transit * rate); // twice what is hardly a bond
  Ride ride;
  EXPECT_EQ(ride.to(1e-3, specimen), parameters.multiplier);
  ride.to(1e-3 + 5 * transit * rate * parameters.multiplier, specimen);
  EXPECT_EQ(ride.step(specimen), 1);
  EXPECT_EQ(ride.to(1.9e-3, specimen), 1);
}

TEST(rate_control, is_quick_on_the_path_back) {
  const Specimen specimen;
  Ride ride;
  ride.to(2.5e-3, specimen);
  EXPECT_EQ(ride.step(specimen), 1);
  Specimen unloading; // elastic from where it stands
  unloading.peak = 1;
  EXPECT_EQ(ride.to(1.0e-3, unloading, -1), parameters.multiplier);
}

TEST(rate_control, goes_on_from_its_state_to_the_last_bit) {
  const Specimen specimen;
  for (const double stop : {5e-5, 3e-4, 1.99e-3, 2.2e-3}) {
    Ride whole;
    whole.to(stop, specimen);
    Ride resumed = whole;
    resumed.control = RateControl(parameters);
    set_state(resumed.control, state_of(whole.control));
    for (int n = 0; n < 3000; ++n)
      ASSERT_EQ(whole.step(specimen), resumed.step(specimen)) << stop << ", " << n;
  }
}

TEST(rate_control, of_multiplier_one_is_one_and_nonsense_is_refused) {
  RateControl calm({1, transit, transit, 10});
  EXPECT_EQ(calm.factor(1, dt), 1);
  EXPECT_THROW(RateControl({0.5, transit, transit, 10}), std::invalid_argument);
  EXPECT_THROW(RateControl({2, 0, transit, 10}), std::invalid_argument);
  EXPECT_THROW(RateControl({2, transit, 0, 10}), std::invalid_argument);
  EXPECT_THROW(set_state(calm, state_of(Servo({1, 1}))), StateError);
}

} // namespace
} // namespace platen::coupling
