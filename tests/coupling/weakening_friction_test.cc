#include "dem/laws/weakening_friction.h"

#include <gtest/gtest.h>

#include <cmath>

#include "dem/laws/friction_law.h"
#include "sphere_scene.h"

namespace platen::dem {
namespace {

constexpr double k = 2e5, normal = 10;   // N/m, N
constexpr double mu_s = 0.5, mu_d = 0.2; // 1
constexpr double s_0 = 1e-4, v_0 = 0.02; // m, m/s
constexpr double round_off = 1e-13;      // of a force
const SlipWeakeningFriction by_slip{{mu_s, mu_d, s_0}};

double coefficient(double s) {
  return mu_d + (mu_s - mu_d) * s_0 / (s_0 + s);
}

struct Drag {
  double path = 0, lost = 0;
  CoulombFriction::State state;
};

Drag drag(const SlipWeakeningFriction &friction, double way, int steps) {
  Drag d;
  for (int n = 0; n < steps; ++n) {
    d.lost += friction(d.state, {way / steps, 0, 0}, normal, k).dissipated;
    d.path += way / steps;
  }
  return d;
}

TEST(slip_weakening_friction, drawn_one_way_it_follows_the_curve_of_its_own_slip) {
  CoulombFriction::State state;
  double path = 0, last = mu_s * normal;
  for (int n = 0; n < 5000; ++n) {
    const double step = 1e-7;
    path += step;
    const auto r = by_slip(state, {step, 0, 0}, normal, k);
    ASSERT_NEAR(state.slip, path - r.force.x / k, 1e-12 * path); // what the spring does not hold has slid
    if (k * path <= mu_s * normal) {
      ASSERT_EQ(state.sliding, 0);
      continue;
    }
    ASSERT_EQ(state.sliding, 1);
    ASSERT_NEAR(r.force.x, coefficient(state.slip) * normal, round_off * normal);
    ASSERT_LT(r.force.x, last);
    last = r.force.x;
  }
  EXPECT_GT(state.slip, 4 * s_0);
}

// Integral of mu N over s, N (mu_d s + (mu_s - mu_d) s_0 ln(1 + s / s_0)), to second order in the step.
TEST(slip_weakening_friction, it_dissipates_the_integral_of_its_law) {
  double error[2];
  for (int level = 0; level < 2; ++level) {
    const Drag d = drag(by_slip, 5e-4, 1000 << level);
    const double s = d.state.slip;
    error[level] = d.lost - normal * (mu_d * s + (mu_s - mu_d) * s_0 * std::log1p(s / s_0));
    EXPECT_LT(std::abs(error[level]), 1e-4 * d.lost);
  }
  EXPECT_LT(std::abs(error[1]), 0.4 * std::abs(error[0])); // a quarter but for the step in which it begins
}

TEST(slip_weakening_friction, a_long_slip_length_is_the_static_law_and_a_short_one_the_dynamic) {
  const SlipWeakeningFriction endless{{mu_s, mu_d, 1e6}}, at_once{{mu_s, mu_d, 1e-18}};
  CoulombFriction::State slow, quick, held;
  const CoulombFriction constant{{mu_s, mu_s}};
  for (int n = 0; n < 1000; ++n) {
    const Vector3 stretch = {3e-7 * std::cos(0.01 * n), 1e-7, 0};
    const auto expected = constant(held, stretch, normal, k);
    ASSERT_LT(norm(endless(slow, stretch, normal, k).force - expected.force), 1e-9 * normal);
    at_once(quick, stretch, normal, k);
    ASSERT_LE(norm(quick.spring), (quick.slip > 0 ? mu_d : mu_s) * normal * (1 + 1e-9));
  }
  EXPECT_GT(quick.slip, 0);
  EXPECT_NEAR(norm(quick.spring), mu_d * normal, 1e-9 * normal);
}

// (mu_s - mu_d) N / s_0 = 300 k: no equilibrium near the old one; the one that is found lies on the curve.
TEST(slip_weakening_friction, steeper_than_its_spring_it_jumps_to_the_curve) {
  const SlipWeakeningFriction steep{{mu_s, mu_d, (mu_s - mu_d) * normal / (300 * k)}};
  CoulombFriction::State state;
  const double way = 1.01 * mu_s * normal / k;
  const auto r = steep(state, {way, 0, 0}, normal, k);
  EXPECT_NEAR(r.force.x, steep.coefficient(r.slip) * normal, round_off * normal);
  EXPECT_NEAR(r.slip, way - r.force.x / k, 1e-12 * way);
  EXPECT_LT(r.force.x, 1.1 * mu_d * normal);
}

TEST(slip_weakening_friction, rest_heals_nothing_and_parting_all) {
  Drag d = drag(by_slip, 5e-4, 1000);
  by_slip(d.state, {-1e-6, 0, 0}, normal, k);
  EXPECT_EQ(d.state.sliding, 0);
  const double slid = d.state.slip;
  for (int n = 0; n < 3; ++n)
    by_slip(d.state, {1e-6, 0, 0}, normal, k);
  EXPECT_NEAR(norm(d.state.spring), coefficient(d.state.slip) * normal, round_off * normal);
  EXPECT_GT(d.state.slip, slid);
  by_slip(d.state, {}, 0, k);
  EXPECT_EQ(d.state.slip, 0);
  EXPECT_EQ(norm(d.state.spring), 0);
}

TEST(velocity_weakening_friction, drawn_at_a_speed_it_slides_at_its_coefficient) {
  const VelocityWeakeningFriction friction{{mu_s, mu_d, v_0}};
  constexpr double step = 1e-7; // m
  for (const double speed : {1e-6 * v_0, 0.5 * v_0, v_0, 3 * v_0, 1000 * v_0}) {
    const double expected = (mu_d + (mu_s - mu_d) * std::exp(-speed / v_0)) * normal;
    CoulombFriction::State state;
    double lost = 0;
    for (int n = 0; n < 1000; ++n)
      lost += friction(state, {step, 0, 0}, normal, k, step / speed).dissipated;
    EXPECT_NEAR(norm(state.spring), expected, round_off * normal) << speed;
    EXPECT_NEAR(state.slip, 1000 * step - expected / k, 1e-12 * state.slip) << speed;
    EXPECT_NEAR(lost, expected * state.slip, expected * step) << speed; // the step in which it begins
  }
}

TEST(velocity_weakening_friction, a_high_slip_velocity_is_the_static_law_and_a_low_one_the_dynamic) {
  const VelocityWeakeningFriction high{{mu_s, mu_d, 1e9}}, low{{mu_s, mu_d, 1e-9}};
  const CoulombFriction fixed{{mu_s, mu_s}}, loose{{mu_d, mu_d}};
  CoulombFriction::State a, b, c, d;
  for (int n = 0; n < 1000; ++n) {
    const Vector3 stretch = {3e-7 * std::cos(0.01 * n), 1e-7, 0};
    // exp(-v / v_0) falls short of 1 by 3e-10.
    ASSERT_LT(norm(high(a, stretch, normal, k, 1e-6).force - fixed(b, stretch, normal, k).force),
              1e-9 * normal);
    ASSERT_EQ(norm(low(c, stretch, normal, k, 1e-6).force - loose(d, stretch, normal, k).force), 0);
  }
}

// Stored energy + loss = work of the mean force, whatever the path and the normal force: an
// identity, the tolerance is round-off of 1e5 terms.
TEST(friction_law, work_is_stored_or_lost_to_the_last_digit) {
  using By = Weakening::By;
  for (const By by : {By::slip, By::velocity}) {
    const FrictionLaw law = friction_law({mu_s, mu_d, {by, 3e-6, 1e-4}});
    CoulombFriction::State state;
    double work = 0, lost = 0;
    for (int n = 0; n < 100000; ++n) {
      const double t = 1e-3 * n, pressing = 10 * (0.8 + std::sin(0.31 * t)); // lets go at times
      const Vector3 stretch = {3e-7 * std::sin(t), 2e-7 * std::cos(1.7 * t), 0}, before = state.spring;
      const auto r = slide_weakening(law, state, stretch, pressing, k, 1e-3);
      work += dot(0.5 * (before + r.force), stretch);
      lost += r.dissipated;
      ASSERT_LE(norm(r.force), mu_s * std::max(pressing, 0.0) * (1 + 1e-14));
    }
    EXPECT_GT(lost, 1e-4);
    EXPECT_NEAR(work, lost + 0.5 * norm_squared(state.spring) / k, 1e-11 * lost);
  }
}

} // namespace
} // namespace platen::dem

namespace platen::coupling {
namespace {

// A sphere drawn over a plate for 0.4 mm: force, slip and work of the layer are those of the law.
TEST(friction_law, a_layer_hands_the_slip_from_step_to_step) {
  SurfaceContact contact = frictional(0.5, 0.2);
  contact.weakening = {dem::Weakening::By::slip, 1e-4, 0};
  SphereScene scene(plate(0.01, 40), {{-0.002, 0.0003, 0.99 * sphere_radius}}, contact, false);
  scene.particles.velocity[0] = {0.4, 0, 0};
  for (int n = 0; n < 1000; ++n)
    scene.carry(1e-6);
  const ActiveContact found = scene.layer.contacts().at(0);
  const double normal = stiffness * 0.01 * sphere_radius, s = found.slip;
  EXPECT_NEAR(s, 0.4e-3 - norm(found.shear) / (0.8 * stiffness), 1e-12);
  EXPECT_NEAR(norm(found.shear), (0.2 + 0.3 * 1e-4 / (1e-4 + s)) * normal, 1e-9 * normal);
  EXPECT_NEAR(scene.layer.friction_work, normal * (0.2 * s + 0.3 * 1e-4 * std::log1p(s / 1e-4)),
              1e-3 * scene.layer.friction_work);
}

TEST(friction_law, what_makes_no_sense_is_refused) {
  const dem::Particles particles(spheres({{0, 0, 1.5 * sphere_radius}}), 2500, false);
  const fem::RigidBody body = plate(0.01, 4);
  const auto refused = [&](SurfaceContact contact, const dem::Weakening &weakening) {
    contact.weakening = weakening;
    EXPECT_THROW(ContactLayer(particles, body, contact), std::invalid_argument);
  };
  refused(frictional(0.5, 0.2), {dem::Weakening::By::slip, 0, 1});
  refused(frictional(0.5, 0.2), {dem::Weakening::By::velocity, 1, 0});
  refused(frictional(0.2, 0.5), {dem::Weakening::By::slip, 1e-3, 0});
}

} // namespace
} // namespace platen::coupling
