// The energy balance of spheres on a plate: nothing appears, nothing goes without being counted.
#include <gtest/gtest.h>

#include <cmath>

#include "sphere_scene.h"

#include "base/pi.h"

namespace platen::coupling {
namespace {

// Steps as a share of the period of a sphere on its contact spring.
double step_of(const SphereScene &scene, double share) {
  return share * 2 * pi * std::sqrt(scene.particles.mass[0] / stiffness);
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

// Backspin, slide, then rolling: a billiard ball on no-slip terms ends at v = 5/7 v0 - 2/7 r w0.
TEST(contact_energy, a_sliding_ball_ends_rolling_at_five_sevenths_of_its_speed) {
  SphereScene scene(plate(0.01, 40), {{-0.009, 0.0003, 0.9999 * sphere_radius}}, frictional(0.3, 0.3));
  const double weight = stiffness * 1e-4 * sphere_radius, r = 0.9999 * sphere_radius;
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

} // namespace
} // namespace platen::coupling
