// The time integration: order, energy, momentum, rotation, damping.
#include "dem/integrator.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/dem/examples.h"
#include "tests/measured.h"

namespace platen::dem::integrator_test {
namespace {

using namespace examples;
using measured::expect_below;
using measured::note_figure;

// A bar on a cubic lattice.
Specimen bar() {
  return cubic(3, 3, 12);
}

// Long waves along and across the bar, and a twist: smooth, so that the error of the time step is what is
// seen.
void set_in_motion(Particles &p) {
  const double length = 24 * radius;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Vector3 x = p.position[i];
    const double c = std::cos(pi * x.z / length);
    p.velocity[i] = {.2 * c, .1 * c * c - .05, .5 * c};
    p.velocity[i] += cross(Vector3{0, 0, 20 * c}, x);
    (*p.angular_velocity)[i] = {0, 0, 20 * c};
  }
}

std::vector<Vector3> positions_after(double duration, int steps) {
  Model model(bar(), bonded());
  set_in_motion(model.particles);
  step(model, duration / steps, steps);
  return {model.particles.position.begin(), model.particles.position.end()};
}

double difference(const std::vector<Vector3> &a, const std::vector<Vector3> &b) {
  double sum = 0;
  for (std::size_t k = 0; k < a.size(); ++k)
    sum += norm_squared(a[k] - b[k]);
  return std::sqrt(sum);
}

// The forces at rest are zero, so the first half kick is exact. Errors against a run with steps 16 times
// finer differ from those against the exact motion by 1/256.
TEST(integrator, halving_the_step_quarters_the_error) {
  Model model(bar(), bonded());
  const double limit = model.stable_step({}, 0).limit, duration = 200 * limit;
  const auto finest = positions_after(duration, 200 * 64);
  const double coarse = difference(positions_after(duration, 200 * 4), finest),
               fine = difference(positions_after(duration, 200 * 8), finest);
  const double expected =
      (1 - 1 / 256.0) / (1 / 4.0 - 1 / 256.0); // of second order, seen against the finest run
  note_figure(4, "order_of_the_step", std::log2(coarse / fine * 4 / expected), "2 +- 0.07");
  EXPECT_NEAR(coarse / fine, expected, .05 * expected);
}

TEST(integrator, energy_stays_in_a_narrow_band_without_trend) {
  Model model(bar(), bonded());
  set_in_motion(model.particles);
  const double dt = .1 * model.stable_step({}, 0).limit, start = model.energy().stored();
  const int steps = 40000;
  double most = 0, sum_t = 0, sum_e = 0, sum_tt = 0, sum_te = 0;
  int n = 0;
  for (int s = 1; s <= steps; ++s) {
    step(model, dt);
    if (s % 20 != 0) continue;
    const double e = model.energy().stored() / start - 1;
    most = std::max(most, std::abs(e));
    ++n, sum_t += s, sum_e += e, sum_tt += 1.0 * s * s, sum_te += s * e;
  }
  const double slope = (n * sum_te - sum_t * sum_e) / (n * sum_tt - sum_t * sum_t);
  expect_below(4, "energy_band", most, 1e-3);
  // A band of 1e-4 that wanders over 2000 samples leaves a slope of about 1e-4 / (sqrt(2000) 4e4) by chance.
  expect_below(4, "energy_slope_per_step", std::abs(slope), 3e-10);
  EXPECT_EQ(model.energy().lost(), 0);
}

TEST(integrator, the_energy_band_shrinks_with_the_square_of_the_step) {
  const auto band = [](double share) {
    Model model(bar(), bonded());
    set_in_motion(model.particles);
    const double dt = share * model.stable_step({}, 0).limit, start = model.energy().stored();
    double most = 0;
    for (int s = 0; s < static_cast<int>(400 / share); ++s) {
      step(model, dt);
      most = std::max(most, std::abs(model.energy().stored() / start - 1));
    }
    return most;
  };
  EXPECT_NEAR(band(.2) / band(.1), 4, .4); // extremes of a signal, not its error at one time
}

TEST(integrator, momentum_is_conserved_to_round_off) {
  Model model(bar(), bonded());
  set_in_motion(model.particles);
  const Momentum before = momentum(model.particles);
  const double dt = .5 * model.stable_step({}, 0).limit;
  step(model, dt, 20000);
  const Momentum after = momentum(model.particles);
  expect_below(6, "drift_of_momentum", norm(after.linear - before.linear) / before.linear_scale, 1e-11);
  expect_below(6, "drift_of_angular_momentum", norm(after.angular - before.angular) / before.angular_scale,
               1e-11);
}

// A lone sphere: orientation after a million steps keeps its norm and has turned by w t. The rotation of one
// step is exact to (w dt)^3 / 12.
TEST(integrator, orientation_keeps_its_norm_and_turns_by_the_spin) {
  ModelSettings settings = bonded();
  settings.bond.reset();
  Model model(spheres({{0, 0, 0}}), settings);
  const Vector3 axis = Vector3{1, -2, 2} / 3;
  const double spin = 100, dt = 1e-5;
  (*model.particles.angular_velocity)[0] = spin * axis;
  const int steps = 1000000;
  step(model, dt, steps);
  const Quaternion q = (*model.particles.orientation)[0];
  expect_below(17, "square_norm_of_orientation_less_one",
               std::abs(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z - 1), 1e-14);
  const double angle = 2 * std::atan(.5 * spin * dt) * steps;
  EXPECT_NEAR(angle, spin * dt * steps, std::pow(spin * dt, 3) / 12 * steps * 1.01);
  const Quaternion expected = rotation_quaternion(std::fmod(angle, 4 * pi) * axis);
  const double overlap = q.w * expected.w + q.x * expected.x + q.y * expected.y + q.z * expected.z;
  EXPECT_NEAR(std::abs(overlap), 1, 1e-14 * steps * 1e-2);
}

TEST(integrator, a_thrown_sphere_follows_its_parabola) {
  ModelSettings settings = bonded();
  settings.bond.reset();
  settings.gravity = {0, 0, -9.80665};
  Model model(spheres({{0, 0, 0}}), settings);
  Particles &p = model.particles;
  p.velocity[0] = {1, 0, 3};
  p.force[0] = p.mass[0] * settings.gravity; // from t = 0 on
  step(model, 1e-4, 1000);
  EXPECT_NEAR(p.position[0].x, .1, 1e-13);
  EXPECT_NEAR(p.position[0].z, .3 - .5 * 9.80665 * .01, 1e-13); // leapfrog is exact for a constant force
  // The work of the weight is taken at full-step velocities: half a step's kick is open at either end.
  const double open = .5 * 1e-4 * p.mass[0] * 9.80665 * 9.80665 * .1;
  EXPECT_NEAR(model.energy().residual(), .5 * p.mass[0] * 10, 1.01 * open);
}

// Leapfrog turns x'' = -w^2 x into x(+dt) + x(-dt) = (2 - (w dt)^2) x: the frequency can be read off three
// steps without the error of the time step.
TEST(integrator, a_free_pair_rings_at_its_axial_and_its_torsional_frequency) {
  for (const bool twisting : {false, true}) {
    Model model(row(1, {1, 0, 0}), bonded());
    Particles &p = model.particles;
    const double stiffness = twisting ? shear_stiffness * polar_moment : normal_stiffness * area,
                 omega = std::sqrt(2 * stiffness / (twisting ? (*p.inertia)[0] : p.mass[0])), dt = .3 / omega;
    for (const int k : {0, 1}) {
      const double sign = k == 0 ? -1 : 1;
      p.velocity[k].x = twisting ? 0 : sign * 1e-5 * radius * omega;
      (*p.angular_velocity)[k].x = twisting ? sign * 1e-4 * omega : 0;
    }
    std::vector<double> x;
    for (int s = 0; s < 50; ++s) {
      step(model, dt);
      x.push_back(twisting ? 2 * std::asin((*p.orientation)[1].x) - 2 * std::asin((*p.orientation)[0].x)
                           : norm(p.position[1] - p.position[0]) - 2 * radius);
    }
    std::size_t at = 1;
    for (std::size_t k = 1; k + 1 < x.size(); ++k)
      if (std::abs(x[k]) > std::abs(x[at])) at = k;
    const double found = std::sqrt(2 - (x[at + 1] + x[at - 1]) / x[at]) / dt;
    EXPECT_NEAR(found, omega, (twisting ? 1e-7 : 1e-8) * omega); // twist^2 / 6 of softening
  }
}

// Cundall's damping on a free oscillator: a constant share of the force acts against the motion. A quarter
// cycle inwards releases (1 - a) of the energy, one outwards stores 1/(1 + a) of it.
class DampedSwing : public testing::TestWithParam<DampingForm> {};

TEST_P(DampedSwing, loses_a_fixed_share_of_every_half_cycle) {
  const double alpha = .2;
  ModelSettings settings = bonded();
  settings.local_damping = alpha;
  settings.damping_form = GetParam();
  const Vector3 axis = GetParam() == DampingForm::vector ? Vector3{2, -3, 6} / 7 : Vector3{1, 0, 0};
  Model model(row(1, axis), settings);
  Particles &p = model.particles;
  const double start = 1e-4 * radius;
  p.position[0] -= .5 * start * axis, p.position[1] += .5 * start * axis;
  p.force[0] = normal_stiffness * area * start * axis, p.force[1] = -1 * p.force[0];
  const double omega = std::sqrt(2 * normal_stiffness * area / p.mass[0]);
  const double energy = bond_energy(p, *model.bonds);
  std::vector<double> extremes;
  double before = start, sign = -1;
  for (int s = 0; s < 6000 && extremes.size() < 4; ++s) {
    step(model, .005 / omega);
    const double now = norm(p.position[1] - p.position[0]) - 2 * radius;
    if (sign * (now - before) < 0) {
      extremes.push_back(std::abs(before));
      sign = -sign;
    }
    before = now;
  }
  ASSERT_EQ(extremes.size(), 4u);
  for (std::size_t k = 0; k < 4; ++k) {
    const double expected = start * std::pow((1 - alpha) / (1 + alpha), .5 * static_cast<double>(k + 1));
    EXPECT_NEAR(extremes[k], expected, .01 * expected); // the force jumps when the motion turns
  }
  EXPECT_NEAR(model.energy().stored() + model.energy().damping, energy, 1e-3 * energy);
}

INSTANTIATE_TEST_SUITE_P(integrator, DampedSwing,
                         testing::Values(DampingForm::component, DampingForm::vector), [](const auto &form) {
                           return form.param == DampingForm::vector ? "vector" : "component";
                         });

// Against the velocity and of the size of the whole load, whatever its direction; nothing where nothing
// moves.
TEST(integrator, damping_along_the_velocity_knows_no_axes) {
  Integrator how;
  how.local_damping = .4;
  how.damping_form = DampingForm::vector;
  const double slow = 1e-12; // s: the kick does not matter
  Particles p(spheres({{0, 0, 0}, {1, 0, 0}}), 2400, true);
  p.velocity[0] = {3, 0, -4};
  (*p.angular_velocity)[0] = {0, 8, 6};
  for (int i = 0; i < 2; ++i) {
    p.force[i] = {0, 12, 5};
    (*p.torque)[i] = {1e-6, 0, 0};
  }
  const KickSums sums = how.end(p, {}, slow);
  const auto near = [](const Vector3 &a, const Vector3 &b) { return norm(a - b) <= 1e-15 * norm(b); };
  EXPECT_TRUE(near(p.force[0], {-.4 * 13 * .6, 12, 5 + .4 * 13 * .8}));
  EXPECT_TRUE(near((*p.torque)[0], {1e-6, -.4e-6 * .8, -.4e-6 * .6}));
  EXPECT_TRUE(near(p.force[1], {0, 12, 5}));
  EXPECT_TRUE(near((*p.torque)[1], {1e-6, 0, 0}));
  EXPECT_NEAR(sums.damping_work, slow * (.4 * 13 * 5 + .4e-6 * 10), 1e-3 * slow * 26);
}

TEST(integrator, bond_dashpots_damp_by_their_fraction) {
  const double xi = .1;
  ModelSettings settings = bonded();
  settings.bond_dashpot = xi;
  Model model(row(1, {1, 0, 0}), settings);
  Particles &p = model.particles;
  const double omega = std::sqrt(2 * normal_stiffness * area / p.mass[0]), v = 1e-5 * radius * omega;
  p.velocity[0].x = -.5 * v, p.velocity[1].x = .5 * v;
  const double dt = .001 / omega, damped = omega * std::sqrt(1 - xi * xi), energy = kinetic_energy(p);
  double t = 0;
  for (int s = 0; s < 10000; ++s) {
    step(model, dt), t += dt;
    const double expected = v / damped * std::exp(-xi * omega * t) * std::sin(damped * t);
    ASSERT_NEAR(norm(p.position[1] - p.position[0]) - 2 * radius, expected, 2e-3 * v / omega);
  }
  EXPECT_NEAR(model.energy().stored() + model.energy().damping, energy, 5e-3 * energy);
}

} // namespace
} // namespace platen::dem::integrator_test
