// The energy balance of spheres on a plate: nothing appears, nothing goes without being counted.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "sphere_scene.h"

#include "base/pi.h"

namespace platen::coupling::contact_energy_test {
namespace {

// Steps as a share of the period of a sphere on its contact spring.
double step_of(const SphereScene &scene, double share) {
  return share * 2 * pi * std::sqrt(scene.particles.mass[0] / plate_stiffness);
}

// Free flight, contact, free flight. Returns the relative loss of kinetic energy not found in the works.
double bounce_error(const Vector3 &velocity, const Vector3 &spin, const SurfaceContact &contact, double share,
                    double *restitution = nullptr) {
  SphereScene scene(plate(0.01, 9), {{-0.001, 0.0007, 1.05 * sphere_radius}}, contact);
  scene.particles.velocity[0] = velocity;
  (*scene.particles.angular_velocity)[0] = spin;
  const double before = scene.kinetic_energy(), dt = step_of(scene, share);
  bool touched = false;
  for (int n = 0; n < 10000000; ++n) {
    scene.step(dt);
    touched = touched || !scene.layer.contacts().empty();
    if (touched && scene.particles.position[0].z > 1.05 * sphere_radius) break;
  }
  EXPECT_TRUE(touched);
  if (restitution != nullptr) *restitution = -scene.particles.velocity[0].z / velocity.z;
  return std::abs(scene.kinetic_energy() + scene.layer.friction_work + scene.layer.damping_work - before) /
         before;
}

TEST(contact_energy, a_surface_that_nothing_has_touched_holds_no_energy) {
  const SphereScene scene(plate(0.01, 3), {{0, 0, 2 * sphere_radius}}, frictional(0.3, 0.3));
  EXPECT_EQ(scene.layer.elastic_energy(), 0);
  EXPECT_EQ(scene.layer.friction_work, 0);
  EXPECT_EQ(scene.layer.damping_work, 0);
}

TEST(contact_energy, a_sphere_bounces_back_with_its_energy) {
  const double coarse = bounce_error({0, 0, -1}, {}, frictional(0.3, 0.3), 0.02);
  const double fine = bounce_error({0, 0, -1}, {}, frictional(0.3, 0.3), 0.002);
  EXPECT_LT(coarse, 5e-2);
  EXPECT_LT(fine, 1e-3);
}

// Sliding, sticking and spinning up at an angle, without and with dashpots.
TEST(contact_energy, an_oblique_bounce_loses_what_friction_and_dashpots_took) {
  for (const double damping : {0.0, 0.2})
    for (const double friction : {0.05, 0.3, 2.0}) {
      SurfaceContact contact = frictional(friction, 0.8 * friction);
      contact.damping = damping;
      EXPECT_LT(bounce_error({2, 0.5, -1}, {100, -300, 50}, contact, 0.0005), 1e-3)
          << friction << " " << damping;
    }
}

// Linear spring and dashpot with the pull cut off: e = exp(-xi / sqrt(1 - xi^2) (pi - arctan(2 xi sqrt(1 -
// xi^2) / (2 xi^2 - 1)) ...)), Schwager and Poeschel 2007, Eq. (20) for xi < 1/sqrt 2: the contact ends where
// the force vanishes, at omega t = pi - arctan(2 xi sqrt(1 - xi^2) / (1 - 2 xi^2)).
TEST(contact_energy, restitution_is_that_of_a_spring_and_a_dashpot_that_cannot_pull) {
  for (const double xi : {0.05, 0.2, 0.5}) {
    SurfaceContact contact = frictional(0, 0);
    contact.damping = xi;
    double measured = 0;
    bounce_error({0, 0, -1}, {}, contact, 0.0002, &measured);
    const double root = std::sqrt(1 - xi * xi);
    const double phase = pi - std::atan2(2 * xi * root, 1 - 2 * xi * xi);
    EXPECT_NEAR(measured, std::exp(-xi / root * phase), 2e-3) << xi;
  }
}

// A sphere that cannot turn slides to rest: kinetic energy goes to friction and the little that the spring
// keeps.
TEST(contact_energy, a_sliding_sphere_stops_when_friction_has_taken_its_energy) {
  SphereScene scene(plate(0.01, 40), {{-0.008, 0.0003, 0.9999 * sphere_radius}}, frictional(0.4, 0.4), false);
  const double weight = plate_stiffness * 1e-4 * sphere_radius;
  scene.gravity = {0, 0, -weight / scene.particles.mass[0]};
  scene.particles.velocity[0] = {1.2, 0.2, 0};
  const double before = scene.kinetic_energy(), dt = step_of(scene, 0.02);
  scene.compute_forces(0);
  const double pressed = scene.layer.elastic_energy(), start = scene.particles.position[0].x;
  for (int n = 0; n < 4000; ++n)
    scene.step(dt);
  const double left = scene.kinetic_energy() + scene.layer.elastic_energy() - pressed;
  EXPECT_NEAR(scene.layer.friction_work + left, before, 1e-3 * before);
  EXPECT_LT(left, 0.02 * before);
  // The way to rest is v^2 / (2 mu g) along the velocity, give or take the stretch of the spring (0.03 %).
  const double way = (1.44 + 0.04) / (2 * 0.4 * weight / scene.particles.mass[0]);
  EXPECT_NEAR(scene.particles.position[0].x - start, way * 1.2 / std::sqrt(1.48), 1e-3 * way);
}

// Backspin, slide, then rolling: a billiard ball on no-slip terms ends at v = 5/7 v0 - 2/7 r w0.
TEST(contact_energy, a_sliding_ball_ends_rolling_at_five_sevenths_of_its_speed) {
  SphereScene scene(plate(0.01, 40), {{-0.009, 0.0003, 0.9999 * sphere_radius}}, frictional(0.3, 0.3));
  const double weight = plate_stiffness * 1e-4 * sphere_radius, r = 0.9999 * sphere_radius;
  scene.gravity = {0, 0, -weight / scene.particles.mass[0]};
  scene.particles.velocity[0] = {0.4, 0, 0};
  const double dt = step_of(scene, 0.01), before = scene.kinetic_energy();
  scene.compute_forces(0);
  const double pressed = scene.layer.elastic_energy();
  double speed = 0, turn = 0; // means over many oscillations of the spring that holds it now
  for (int n = 0; n < 60000; ++n) {
    scene.step(dt);
    if (n < 40000) continue;
    speed += scene.particles.velocity[0].x / 20000;
    turn += (*scene.particles.angular_velocity)[0].y / 20000;
  }
  EXPECT_NEAR(speed, 5.0 / 7 * 0.4, 1e-3 * 0.4);
  EXPECT_NEAR(turn * r, 5.0 / 7 * 0.4, 1e-3 * 0.4);
  EXPECT_NEAR(scene.kinetic_energy() + scene.layer.elastic_energy() - pressed + scene.layer.friction_work,
              before, 1e-3 * before);
}

// With a plate that moves the work comes in through it: the mean of the loads before and after each step,
// times the way of the step.
TEST(contact_energy, a_moving_plate_puts_in_what_the_energy_balance_shows) {
  SurfaceContact contact = frictional(0.5, 0.3);
  contact.damping = 0.1;
  contact.seat_modulus = 2e9;
  SphereScene scene(
      plate(0.01, 12),
      {{-0.004, 0.0003, sphere_radius}, {0.001, -0.002, sphere_radius}, {0.004, 0.003, 1.02 * sphere_radius}},
      contact);
  scene.layer.seat_within(scene.particles, scene.body, 0.01 * sphere_radius);
  scene.gravity = {200, 0, -5000};
  const double dt = step_of(scene, 0.0005);
  double work = 0, size = 0, potential = 0;
  const Vector3 g = scene.gravity;
  std::vector<Vector3> start(3);
  for (std::size_t i = 0; i < 3; ++i)
    start[i] = scene.particles.position[i];
  scene.compute_forces(0);
  Vector3 last = scene.load();
  for (int n = 0; n < 100000; ++n) {
    scene.body.set_velocity({0.02 * std::sin(2e-4 * n), 0.01, 0.03 * std::cos(3e-4 * n)});
    const Vector3 u = scene.body.velocity();
    scene.step(dt);
    const double in = -dt * dot(0.5 * (last + scene.load()), u);
    work += in;
    size += std::abs(in);
    last = scene.load();
  }
  for (std::size_t i = 0; i < 3; ++i)
    potential -= scene.particles.mass[i] * dot(g, scene.particles.position[i] - start[i]);
  const double found = scene.kinetic_energy() + scene.layer.elastic_energy() + potential +
                       scene.layer.friction_work + scene.layer.damping_work;
  EXPECT_GT(scene.layer.friction_work, 0.0);
  EXPECT_GT(scene.layer.damping_work, 0.0);
  EXPECT_NEAR(found, work, 5e-3 * size);
}

} // namespace
} // namespace platen::coupling::contact_energy_test
