// The energy of bodies that nothing damps, over a million steps at a tenth of the limit.
//
// Velocity Verlet does not keep E = K + U, which it shows swung by dt^2, but for linear forces to the last
// bit E - dt^2/8 sum(F^2/m + T^2/I), the mean of what K would be with half-step velocities before and after.
// So both are measured over what E was at the start: E by the band in which it oscillates, which is small
// where the motion is smooth and (w dt)^2 / 4 of a single mode of frequency w, and what is kept by its trend.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/dem/examples.h"
#include "tests/measured.h"

namespace platen::dem::energy_drift_test {
namespace {

using namespace examples;
using measured::expect_below;

constexpr double share_of_limit = .1;

double kept_energy(const Model &model, double dt) {
  const Particles &p = model.particles;
  double squares = 0;
  for (std::size_t i = 0; i < p.size(); ++i)
    squares += norm_squared(p.force[i]) / p.mass[i] + norm_squared((*p.torque)[i]) / (*p.inertia)[i];
  return model.energy().stored() - dt * dt / 8 * squares;
}

// Slope of a straight line through values by least squares.
class Trend {
public:
  void add(double x, double y) { ++n_, x_ += x, y_ += y, xx_ += x * x, xy_ += x * y; }
  double slope() const { return (n_ * xy_ - x_ * y_) / (n_ * xx_ - x_ * x_); }

private:
  double n_ = 0, x_ = 0, y_ = 0, xx_ = 0, xy_ = 0;
};

struct Drift {
  double band = 0, kept_band = 0;   // largest distance from the start, over the energy of the start
  double slope = 0, kept_slope = 0; // per step, of the same
  double lost = 0;                  // J, counted as lost
};

Drift drift_of(Model &model, long steps, long every) {
  const double dt = share_of_limit * model.stable_step({}, 0).limit;
  step(model, dt); // forces belong to places from here on
  const double start = model.energy().stored(), kept = kept_energy(model, dt);
  Trend trend, kept_trend;
  Drift drift;
  for (long s = 1; s <= steps; ++s) {
    step(model, dt);
    if (s % every != 0) continue;
    const double e = model.energy().stored() / start - 1, k = (kept_energy(model, dt) - kept) / start;
    drift.band = std::max(drift.band, std::abs(e));
    drift.kept_band = std::max(drift.kept_band, std::abs(k));
    trend.add(static_cast<double>(s), e);
    kept_trend.add(static_cast<double>(s), k);
  }
  drift.slope = std::abs(trend.slope());
  drift.kept_slope = std::abs(kept_trend.slope());
  drift.lost = model.energy().lost();
  return drift;
}

// Stretched and sheared oscillations of two bonded spheres, fast ones: w dt is .2 at most.
TEST(energy_drift, of_a_pair_over_a_million_steps) {
  Model model(row(1, {1, 0, 0}), bonded());
  Particles &p = model.particles;
  const double v = 1e-3; // m/s: turns by 1e-5 in an oscillation
  p.velocity[0] = {v, .5 * v, 0}, p.velocity[1] = {-v, -.5 * v, 0};
  (*p.angular_velocity)[0] = {0, .3 * v / radius, 0};
  const Drift drift = drift_of(model, 1000000, 37);
  expect_below(4, "energy_band_of_a_pair", drift.band, share_of_limit * share_of_limit); // (w dt)^2 / 4
  expect_below(4, "kept_energy_band_of_a_pair", drift.kept_band, 1e-4);
  expect_below(4, "kept_energy_slope_of_a_pair_per_step", drift.kept_slope, 1e-11);
  EXPECT_EQ(drift.lost, 0);
}

// 5 x 5 x 40 spheres, stretched, bent and twisted by waves as long as the bar. (A smaller bar goes through
// 40 000 steps in dem.integrator.)
TEST(energy_drift, long_of_a_bar_over_a_million_steps) {
  std::vector<Vector3> centres;
  for (int z = 0; z < 40; ++z)
    for (int y = 0; y < 5; ++y)
      for (int x = 0; x < 5; ++x)
        centres.push_back(2 * radius * Vector3{1.0 * x, 1.0 * y, 1.0 * z});
  Model model(spheres(centres), bonded());
  Particles &p = model.particles;
  ASSERT_EQ(p.size(), 1000u);
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Vector3 x = p.position[i];
    const double c = std::cos(pi * x.z / (78 * radius));
    p.velocity[i] = Vector3{.2 * c, .1 * c * c - .05, .5 * c} + cross(Vector3{0, 0, 20 * c}, x);
    (*p.angular_velocity)[i] = {0, 0, 20 * c};
  }
  const Drift drift = drift_of(model, 1000000, 20);
  expect_below(4, "energy_band_of_a_bar", drift.band, 1e-4);
  expect_below(4, "energy_slope_of_a_bar_per_step", drift.slope, 1e-11);
  expect_below(4, "kept_energy_band_of_a_bar", drift.kept_band, 1e-4);
  expect_below(4, "kept_energy_slope_of_a_bar_per_step", drift.kept_slope, 1e-11);
  EXPECT_EQ(drift.lost, 0);
}

} // namespace
} // namespace platen::dem::energy_drift_test
