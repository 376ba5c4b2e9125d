// Coulomb friction, and the laws by which it weakens.
#include "base/pi.h"
#include "dem/laws/coulomb_friction.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "dem/laws/friction_law.h"
#include "dem/laws/rotating_plane.h"
#include "sphere_scene.h"

namespace platen::dem::friction_laws_test {
namespace {

constexpr double k = 2e5; // N/m
constexpr double infinite = std::numeric_limits<double>::infinity();

TEST(coulomb_friction, the_spring_holds_up_to_the_static_limit_and_then_slides_at_the_dynamic_one) {
  const CoulombFriction friction{{0.5, 0.3}};
  CoulombFriction::State state;
  const double normal = 10, step = 1e-7;
  double path = 0;
  while (path * k + step * k <= 0.5 * normal) {
    path += step;
    const auto r = friction(state, {step, 0, 0}, normal, k);
    ASSERT_NEAR(r.force.x, k * path, 1e-12 * normal);
    ASSERT_EQ(r.dissipated, 0.0);
    ASSERT_EQ(state.sliding, 0);
  }
  for (int n = 0; n < 100; ++n) {
    const auto r = friction(state, {step, 0, 0}, normal, k);
    ASSERT_NEAR(r.force.x, 0.3 * normal, 1e-15 * normal);
    ASSERT_EQ(state.sliding, 1);
  }
}

// Back off until the trial is below the dynamic limit: it sticks, and the static limit holds again.
TEST(coulomb_friction, it_sticks_again_below_the_dynamic_limit_and_then_holds_to_the_static_one) {
  const CoulombFriction friction{{0.5, 0.3}};
  CoulombFriction::State state{{3.0, 0, 0}, 1};
  friction(state, {-1e-6, 0, 0}, 10, k); // 2.8 N
  EXPECT_EQ(state.sliding, 0);
  friction(state, {9e-6, 0, 0}, 10, k); // 4.6 N < 5 N
  EXPECT_EQ(state.sliding, 0);
  EXPECT_NEAR(state.spring.x, 4.6, 1e-14);
  friction(state, {9e-6, 0, 0}, 10, k);
  EXPECT_EQ(state.sliding, 1);
  EXPECT_NEAR(state.spring.x, 3.0, 1e-14);
}

TEST(coulomb_friction, sliding_keeps_the_direction_of_the_trial) {
  const CoulombFriction friction{{0.4, 0.4}};
  CoulombFriction::State state{{1, 0, 0}, 0};
  const Vector3 trial = {1, k * 1e-4, 0};
  const auto r = friction(state, {0, 1e-4, 0}, 10, k);
  EXPECT_LT(norm(cross(r.force, trial)), 1e-14 * norm(trial) * 4);
  EXPECT_NEAR(norm(r.force), 4, 4e-15);
}

// A tangential stiffness of 0 that a scene may ask for, or that Hertz' law has at an overlap of exactly 0.
TEST(coulomb_friction, without_stiffness_nothing_is_held_and_nothing_is_lost) {
  for (const double normal : {0.0, 10.0})
    for (const double held : {0.0, 2.0, 8.0}) {
      CoulombFriction::State state{{held, 0, 0}, 0};
      const auto r = CoulombFriction{{0.5, 0.5}}(state, {1e-6, 0, 0}, normal, 0);
      EXPECT_EQ(r.dissipated, 0) << normal << ", " << held;
      EXPECT_EQ(r.slip, 0) << normal << ", " << held;
      EXPECT_EQ(r.force.x, normal > 0 ? std::min(held, 5.0) : 0) << normal << ", " << held;
      CoulombFriction::State slid{{held, 0, 0}, 0}, gone{{held, 0, 0}, 0};
      EXPECT_EQ(CoulombFriction::let_go(gone, {held, 0, 0}, 0).dissipated, 0);
      if (held == 0) continue;
      const auto of = CoulombFriction::slide(slid, {held, 0, 0}, held, 1, 0);
      EXPECT_EQ(of.dissipated, 0);
      EXPECT_EQ(of.slip, 0);
      EXPECT_EQ(of.force.x, 1);
    }
}

TEST(coulomb_friction, loss_of_the_normal_force_releases_the_spring) {
  const CoulombFriction friction{{0.5, 0.5}};
  CoulombFriction::State state{{1, 2, 0}, 1};
  const auto r = friction(state, {}, 0, k);
  EXPECT_EQ(norm(r.force) + norm(state.spring) + state.sliding, 0);
  EXPECT_NEAR(r.dissipated, 5.0 / (2 * k), 1e-18); // all that was stored
}

TEST(coulomb_friction, without_a_limit_it_never_slides) {
  const CoulombFriction friction{{infinite, infinite}};
  CoulombFriction::State state;
  const auto r = friction(state, {1, 0, 0}, 1e-9, k);
  EXPECT_EQ(r.force.x, k);
  EXPECT_EQ(state.sliding, 0);
}

// A dynamic coefficient above the static one must not push: the force never exceeds the trial.
TEST(coulomb_friction, a_larger_dynamic_coefficient_never_adds_energy) {
  const CoulombFriction friction{{0.3, 0.5}};
  CoulombFriction::State state;
  for (int n = 1; n < 200; ++n) {
    const Vector3 before = state.spring;
    const auto r = friction(state, {1e-7, 0, 0}, 10, k);
    ASSERT_LE(norm(r.force), norm(before + Vector3{k * 1e-7, 0, 0}));
    ASSERT_LE(norm(r.force), 5.0 * (1 + 1e-15));
    ASSERT_GE(r.dissipated, 0);
  }
}

// Stored energy + loss = work of the mean force, step by step, by every law, whatever the path and the normal
// force do. That is an identity; the tolerance is round-off of 1e5 terms.
TEST(coulomb_friction, work_is_stored_or_lost_to_the_last_digit) {
  using By = Weakening::By;
  for (const By by : {By::nothing, By::slip, By::velocity}) {
    const FrictionLaw law = friction_law({0.5, 0.3, {by, 3e-6, 1e-4}});
    CoulombFriction::State state;
    double work = 0, lost = 0;
    for (int n = 0; n < 100000; ++n) {
      const double t = 1e-3 * n, normal = 10 * (0.8 + std::sin(0.31 * t)); // lets go at times
      const Vector3 stretch = {3e-7 * std::sin(t), 2e-7 * std::cos(1.7 * t), 0}, before = state.spring;
      const CoulombFriction::Result r = by == By::nothing
                                            ? std::get<CoulombFriction>(law)(state, stretch, normal, k)
                                            : slide_weakening(law, state, stretch, normal, k, 1e-3);
      work += dot(0.5 * (before + r.force), stretch);
      lost += r.dissipated;
      ASSERT_LE(norm(r.force), 0.5 * std::max(normal, 0.0) * (1 + 1e-14));
    }
    EXPECT_GT(lost, 1e-4);
    EXPECT_NEAR(work, lost + 0.5 * norm_squared(state.spring) / k, 1e-11 * lost);
  }
}

// Two million stick-slip steps in a turning plane: the limit is never passed, the spring stays in its plane.
// Limits of the check are a few units in the last place.
TEST(coulomb_friction, stick_slip_cycles_never_pass_the_limit_nor_leave_the_plane) {
  const CoulombFriction friction{{0.4, 0.4}};
  CoulombFriction::State state;
  Vector3 normal = {0, 0, 1};
  int slips = 0;
  for (int n = 0; n < 2000000; ++n) {
    const double t = 1e-2 * n;
    const Vector3 tilted = {0.3 * std::sin(0.01 * t), 0.2 * std::cos(0.013 * t), 1};
    const Vector3 next = tilted / norm(tilted);
    state.spring = carry_with_plane(state.spring, normal, next);
    normal = next;
    Vector3 stretch = {4e-7 * std::sin(t), 4e-7 * std::cos(0.7 * t), 0};
    stretch -= dot(stretch, normal) * normal;
    const double pressing = 10 + 5 * std::sin(0.11 * t);
    friction(state, stretch, pressing, k);
    ASSERT_LE(norm(state.spring), 0.4 * pressing * (1 + 1e-14));
    ASSERT_LE(std::abs(dot(state.spring, normal)), 1e-14 * pressing);
    slips += state.sliding;
  }
  EXPECT_GT(slips, 100000);
  EXPECT_LT(slips, 1900000);
}

TEST(rotating_plane, a_carried_vector_keeps_its_length_and_its_angle_to_the_way_of_the_normal) {
  const Vector3 from = {0, 0, 1}, to = {std::sin(1.0), 0, std::cos(1.0)};
  const Vector3 carried = carry_with_plane({3, 4, 0}, from, to);
  EXPECT_LT(norm(carried - Vector3{3 * std::cos(1.0), 4, -3 * std::sin(1.0)}), 1e-15);
  EXPECT_LT(std::abs(dot(carried, to)), 1e-15);
  EXPECT_NEAR(norm(carried), 5, 1e-15);
}

// About the axis that is square to both normals, by the angle between them; some normals have but one
// component that differs.
TEST(rotating_plane, a_vector_turns_about_the_axis_of_both_normals) {
  const Vector3 vector = {3, 4, -5};
  std::vector<std::array<Vector3, 2>> normals{{{{2.0 / 7, 3.0 / 7, 6.0 / 7}, {-0.48, 0.6, 0.64}}}};
  for (const Vector3 &from : {Vector3{1, 2, 2} / 3, Vector3{2, 1, 2} / 3, Vector3{2, 2, 1} / 3})
    for (const int axis : {0, 1, 2}) {
      Vector3 mirrored = from;
      mirrored[axis] = -mirrored[axis];
      normals.push_back({mirrored, from});
    }
  for (const auto &[from, to] : normals) {
    const Vector3 flat = vector - dot(vector, from) * from, axis = cross(from, to) / norm(cross(from, to));
    const double angle = std::atan2(norm(cross(from, to)), dot(from, to));
    const Vector3 turned = std::cos(angle) * flat + std::sin(angle) * cross(axis, flat) +
                           ((1 - std::cos(angle)) * dot(axis, flat)) * axis;
    EXPECT_LT(norm(carry_with_plane(vector, from, to) - turned), 1e-14) << from.x << ' ' << from.y;
  }
}

TEST(rotating_plane, opposite_normals_keep_the_vector) {
  EXPECT_NEAR(norm(carry_with_plane({3, 4, 0}, {0, 0, 1}, {0, 0, -1})), 5, 1e-15);
}

// Once around a circle on the sphere of normals the plane has turned by the solid angle (parallel transport):
// a closed form of something that a projection would get wrong. Error of second order in the step.
TEST(rotating_plane, a_closed_way_of_the_normal_turns_the_vector_by_its_solid_angle) {
  const double polar = 0.5;
  const auto at = [&](double angle) {
    return Vector3{std::sin(polar) * std::cos(angle), std::sin(polar) * std::sin(angle), std::cos(polar)};
  };
  const Vector3 start = Vector3{std::cos(polar), 0, -std::sin(polar)};
  double error[2];
  for (int level = 0; level < 2; ++level) {
    const int steps = 1000 << level;
    Vector3 v = start;
    for (int n = 0; n < steps; ++n)
      v = carry_with_plane(v, at(2 * pi * n / steps), at(2 * pi * (n + 1) / steps));
    const double turned = std::acos(dot(v, start)), solid = 2 * pi * (1 - std::cos(polar));
    error[level] = std::abs(turned - solid);
    EXPECT_NEAR(norm(v), 1, 1e-13);
  }
  EXPECT_LT(error[0], 1e-5);
  EXPECT_NEAR(error[0] / error[1], 4, 0.1);
}

TEST(rotating_plane, spin_turns_about_the_normal) {
  const Vector3 n = {0, 0, 1}, turned = spin_in_plane({1, 0, 0}, n, 0.3);
  EXPECT_NEAR(turned.x, std::cos(0.3), 1e-16);
  EXPECT_NEAR(turned.y, std::sin(0.3), 1e-16);
  // Those of a step take a series instead, up to 1e-4.
  for (const double angle : {1e-7, 1e-5, 9.9e-5, -9.9e-5, 1.01e-4}) {
    const Vector3 a_little = spin_in_plane({1, 0, 0}, n, angle);
    EXPECT_NEAR(a_little.x, std::cos(angle), 2e-16) << angle;
    EXPECT_NEAR(a_little.y, std::sin(angle), 4e-16 * std::abs(angle)) << angle;
  }
}

constexpr double normal = 10;            // N
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

} // namespace
} // namespace platen::dem::friction_laws_test

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
  const double normal = plate_stiffness * 0.01 * sphere_radius, s = found.slip;
  EXPECT_NEAR(s, 0.4e-3 - norm(found.shear) / (0.8 * plate_stiffness), 1e-12);
  EXPECT_NEAR(norm(found.shear), (0.2 + 0.3 * 1e-4 / (1e-4 + s)) * normal, 1e-9 * normal);
  EXPECT_NEAR(scene.layer.friction_work, normal * (0.2 * s + 0.3 * 1e-4 * std::log1p(s / 1e-4)),
              1e-3 * scene.layer.friction_work);
}

} // namespace
} // namespace platen::coupling
