#include "coupling/pace.h"
#include "base/state.h"
#include "coupling/servo.h"

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

constexpr double crossing = 1e-5, dt = 1e-7, rate = 1; // s, s, 1/s of closure: 100 crossings in 0.1 %
constexpr Pace::Parameters parameters{5, crossing, 10 * crossing, 1e5};

struct Ride {
  double strain = 0, time = 0;
  Pace pace{parameters};
  double step(const Specimen &specimen, double direction = 1) {
    const double factor = pace.factor(time, dt);
    strain += direction * rate * factor * dt;
    time += dt;
    pace.look(time, specimen.stress(strain), strain, specimen.broken(strain));
    return factor;
  }
  double to(double until, const Specimen &specimen, double direction = 1) {
    double factor = 1;
    while (direction * (until - strain) > 0)
      factor = step(specimen, direction);
    return factor;
  }
};

TEST(pace, is_quick_while_elastic_and_slow_while_failing) {
  const Specimen specimen;
  Ride ride;
  EXPECT_EQ(ride.to(9e-5, specimen), 1); // the first ten crossings
  EXPECT_EQ(ride.to(1.9e-3, specimen), parameters.hurry);
  // Found within the five crossings of a slope, and slowed down in three.
  ride.to(2e-3 + 8.1 * crossing * rate * parameters.hurry, specimen);
  EXPECT_EQ(ride.step(specimen), 1);
  EXPECT_EQ(ride.to(6e-3, specimen), 1);
  // 1e-4 slow, 4.3 crossings of ramp at a mean of 3 ... : a third of what constant speed takes to the peak.
  Ride again;
  again.to(2e-3, specimen);
  EXPECT_LT(again.time, 0.36 * 2e-3 / rate);
}

TEST(pace, is_slow_while_bonds_break_though_the_slope_tells_nothing) {
  Specimen specimen;
  specimen.breaks_from = 1e-3;
  specimen.broken_per_strain = 2 * 5e-5 * parameters.bonds / (crossing * rate); // twice what is hardly a bond
  Ride ride;
  EXPECT_EQ(ride.to(1e-3, specimen), parameters.hurry);
  ride.to(1e-3 + 5 * crossing * rate * parameters.hurry, specimen);
  EXPECT_EQ(ride.step(specimen), 1);
  EXPECT_EQ(ride.to(1.9e-3, specimen), 1);
}

TEST(pace, is_quick_on_the_way_back) {
  const Specimen specimen;
  Ride ride;
  ride.to(2.5e-3, specimen);
  EXPECT_EQ(ride.step(specimen), 1);
  Specimen unloading; // elastic from where it stands
  unloading.peak = 1;
  EXPECT_EQ(ride.to(1.0e-3, unloading, -1), parameters.hurry);
}

TEST(pace, goes_on_from_its_state_to_the_last_bit) {
  const Specimen specimen;
  for (const double stop : {5e-5, 3e-4, 1.99e-3, 2.2e-3}) {
    Ride whole;
    whole.to(stop, specimen);
    Ride resumed = whole;
    resumed.pace = Pace(parameters);
    set_state(resumed.pace, state_of(whole.pace));
    for (int n = 0; n < 3000; ++n)
      ASSERT_EQ(whole.step(specimen), resumed.step(specimen)) << stop << ", " << n;
  }
}

TEST(pace, of_no_hurry_is_one_and_nonsense_is_refused) {
  Pace calm({1, crossing, crossing, 10});
  EXPECT_EQ(calm.factor(1, dt), 1);
  EXPECT_THROW(Pace({0.5, crossing, crossing, 10}), std::invalid_argument);
  EXPECT_THROW(Pace({2, 0, crossing, 10}), std::invalid_argument);
  EXPECT_THROW(Pace({2, crossing, 0, 10}), std::invalid_argument);
  EXPECT_THROW(set_state(calm, state_of(Servo({1, 1}))), StateError);
}

} // namespace
} // namespace platen::coupling
