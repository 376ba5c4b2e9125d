// What turns or rubs for very long: a platen that is free on its seat, and one that a sphere sticks to and
// slips on.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/pi.h"
#include "fem/elastic_solid.h"
#include "tests/coupling/sphere_scene.h"
#include "tests/elastic_nodes.h"
#include "tests/measured.h"

namespace platen::coupling::long_motion_test {
namespace {

using measured::expect_below;

// Three unlike moments of inertia about a seat outside of its middle, spinning about the axis between: an
// asymmetric top, which tumbles. As for an elastic platen of a test, its clamp turns with the rotor and the
// rest is strained by it.
TEST(long_motion, long_a_platen_tumbles_on_its_seat_for_ten_million_steps) {
  fem::Clamp clamp;
  clamp.turns = true;
  clamp.seat = {0.004, 0.002, 0.02};
  fem::ElasticSolid top(fem::make_grid(fem::BoxPlate{{-0.03, -0.02, 0}, {0.03, 0.02, 0.015}, {2, 1, 1}}),
                        {steel}, clamp, {1});
  top.set_velocity({}, {20, 300, -5});
  const Vector3 start = fem::momenta(top).angular;
  const double dt = 0.8 * top.stable_step();
  double off_unit = 0, drift = 0;
  double most = -1, least = 1; // of the axis' component along where it was
  for (int n = 1; n <= 10000000; ++n) {
    top.drift(dt, 1);
    if (n % 1000 != 0) continue;
    const Quaternion &q = top.rotation();
    off_unit = std::max(off_unit, std::abs(std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z) - 1));
    drift = std::max(drift, norm(fem::momenta(top).angular - start));
    const double axis = rotate(q, {0, 1, 0})[1];
    most = std::max(most, axis), least = std::min(least, axis);
  }
  EXPECT_GT(most - least, 0.5); // it has tumbled
  expect_below(17, "norm_of_orientation_of_a_free_platen_less_one", off_unit, 1e-14);
  expect_below(17, "drift_of_angular_momentum_of_a_free_platen", drift / norm(start), 1e-8);
}

// To and fro under a changing load, half as far again as the spring holds: each cycle sticks twice and slips
// twice.
void stick_and_slip(int cycles) {
  constexpr double mu = 0.4;
  constexpr int steps = 16; // of a cycle
  SphereScene scene(plate(0.01, 4), {{0.001, 0.0007, 0.999 * sphere_radius}}, frictional(mu, mu), false);
  dem::Particles &p = scene.particles;
  const double overlap = 0.001 * sphere_radius, fixed = mu * overlap / 0.8; // m, along the face
  constexpr double dt = 1e-6;
  double beyond = 0, off_plane = 0;
  long slips = 0, sticks = 0;
  bool slid = false;
  for (int n = 0; n < cycles * steps; ++n) {
    const double phase = 2 * pi * n / steps, turn = 1e-3 * n;
    const double way = 6 * fixed * std::cos(phase) * 2 * pi / steps;
    p.velocity[0] =
        Vector3{way * std::cos(turn), way * std::sin(turn), 0.05 * overlap * std::sin(0.37 * n)} / dt;
    scene.carry(dt);
    const auto contacts = scene.layer.contacts();
    ASSERT_EQ(contacts.size(), 1u) << n;
    const ActiveContact &c = contacts[0];
    beyond = std::max(beyond, norm(c.shear) / (mu * c.normal_force) - 1);
    off_plane = std::max(off_plane, std::abs(dot(c.shear, c.normal)) / c.normal_force);
    slips += c.sliding && !slid, sticks += !c.sliding && slid;
    slid = c.sliding;
  }
  EXPECT_GT(slips, cycles);
  EXPECT_GT(sticks, cycles);
  expect_below(17, "friction_on_a_platen_over_its_limit_less_one", beyond, 1e-14);
  expect_below(17, "friction_off_the_face_over_load", off_plane, 1e-14);
}

TEST(long_motion, a_sphere_sticks_and_slips_on_a_platen) {
  stick_and_slip(10000);
}

TEST(long_motion, long_a_sphere_sticks_and_slips_a_million_times_on_a_platen) {
  stick_and_slip(1000000);
}

} // namespace
} // namespace platen::coupling::long_motion_test
