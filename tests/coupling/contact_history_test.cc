// Friction remembers through facets, turns, lists and threads; through stops: conformance_test.cc.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <random>

#include "base/parallel.h"
#include "base/pi.h"
#include "sphere_scene.h"
#include "tests/measured.h"
#include "tests/same_state.h"

namespace platen::coupling::contact_history_test {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

// The list of a long strip takes long to make; a large skin makes it seldom.
SurfaceContact seldom_listed(double friction) {
  SurfaceContact contact = frictional(friction, friction);
  contact.skin = 5 * sphere_radius;
  return contact;
}

constexpr double on_strip = 1e-5, way = 1.0 / 30000; // s, m, of a step along it
SphereScene on_ten_thousand_facets(double friction) {
  return SphereScene(
      fem::RigidBody(fem::make_grid(fem::BoxPlate{{0, -0.005, -0.01}, {1, 0.005, 0}, {10000, 1, 1}}), steel),
      {{0.00102, 0.0001, 0.99 * sphere_radius}}, seldom_listed(friction));
}

// A stretched spring on a sphere that rolls without slip over 10 000 facets: nothing leaks. Each step may
// lose the round-off of v dt, 30 000 steps in all.
TEST(contact_history, ten_thousand_facets_take_nothing_from_a_spring) {
  SphereScene scene = on_ten_thousand_facets(infinite);
  scene.particles.velocity[0] = {0, 0.2, 0};
  scene.carry(on_strip);
  const Vector3 stretched = scene.layer.contacts()[0].shear;
  EXPECT_NEAR(stretched.y, -0.8 * plate_stiffness * 0.2 * on_strip, 1e-12);
  scene.particles.velocity[0] = {way / on_strip, 0, 0};
  (*scene.particles.angular_velocity)[0] = {0, way / on_strip / (0.99 * sphere_radius), 0};
  int crossings = 0, face = scene.layer.contacts()[0].face;
  for (int n = 0; n < 29900; ++n) {
    scene.carry(on_strip);
    ASSERT_EQ(scene.layer.contacts().size(), 1u);
    crossings += scene.layer.contacts()[0].face != face;
    face = scene.layer.contacts()[0].face;
  }
  EXPECT_GT(crossings, 9900);
  measured::expect_below(21, "loss_of_spring_per_crossing",
                         norm(scene.layer.contacts()[0].shear - stretched) / (crossings * norm(stretched)),
                         1e-12);
  EXPECT_EQ(scene.layer.friction_work, 0.0);
}

// Sliding across as many: path and work are those of the plane.
TEST(contact_history, sliding_over_ten_thousand_facets_measures_the_path) {
  SphereScene scene = on_ten_thousand_facets(0.4);
  scene.particles.velocity[0] = {way / on_strip, 0, 0};
  const int steps = 29900;
  for (int n = 0; n < steps; ++n)
    scene.carry(on_strip);
  const double normal = plate_stiffness * 0.01 * sphere_radius,
               slid = way * steps - 0.4 * normal / (0.8 * plate_stiffness); // less what the spring took up
  measured::expect_below(21, "error_of_path", std::abs(scene.layer.contacts()[0].slip / slid - 1), 1e-9);
  // The first step loads the spring and slides: the trapezoid counts half of it.
  EXPECT_NEAR(scene.layer.friction_work, 0.4 * normal * slid, 0.4 * normal * way);
}

TEST(contact_history, losing_contact_clears_it) {
  SphereScene scene(plate(0.01, 4), {{0.001, 0.002, 0.99 * sphere_radius}}, frictional(0.4, 0.3));
  scene.particles.velocity[0] = {0.5, 0, 0};
  for (int n = 0; n < 10; ++n)
    scene.carry(1e-5);
  EXPECT_GT(scene.layer.contacts()[0].slip, 0.0);
  const double before = scene.layer.friction_work, stored = scene.layer.elastic_energy();
  const double spring = norm_squared(scene.layer.contacts()[0].shear) / (2 * 0.8 * plate_stiffness);
  ASSERT_GT(stored, spring);
  scene.particles.velocity[0] = {0, 0, 3};
  scene.carry(1e-5);
  EXPECT_EQ(scene.layer.contacts().size(), 0u);
  EXPECT_EQ(scene.layer.elastic_energy(), 0.0);
  EXPECT_NEAR(scene.layer.friction_work - before, spring, 1e-12 * spring); // what the spring held is lost
  scene.particles.velocity[0] = {0, 0, -3};
  scene.carry(1e-5);
  ASSERT_EQ(scene.layer.contacts().size(), 1u);
  EXPECT_EQ(norm(scene.layer.contacts()[0].shear), 0.0);
  EXPECT_EQ(scene.layer.contacts()[0].slip, 0.0);
}

// Plate and sphere turn together about a skew axis through a point elsewhere: the spring turns with them.
// What a step sees of a rigid rotation falls with its square.
TEST(contact_history, a_common_rotation_turns_the_spring_and_stretches_nothing) {
  double error[2];
  for (int level = 0; level < 2; ++level) {
    SphereScene scene(plate(0.01, 7), {{0.001, 0.002, 0.99 * sphere_radius}}, frictional(infinite, infinite));
    scene.particles.velocity[0] = {0.3, 0.1, 0};
    scene.carry(1e-5); // stretch
    const Vector3 start = scene.layer.contacts()[0].shear;
    const Vector3 centre = scene.body.centre(), axis = Vector3{1, 2, 2} / 3.0;
    const double rate = 2 * pi;
    const int steps = 2000 << level;
    const double dt = 1.0 / steps;
    const Vector3 w = rate * axis, arm = scene.particles.position[0] - centre;
    scene.body.set_velocity({}, w);
    for (int n = 0; n < steps; ++n) {
      // Positions and velocities of the exact circle at the end of the step.
      const Vector3 r = rotate(rotation_quaternion((n + 1) * dt * w), arm);
      scene.particles.velocity[0] = cross(w, r);
      (*scene.particles.angular_velocity)[0] = w;
      scene.particles.position[0] = centre + r - dt * scene.particles.velocity[0];
      scene.carry(dt);
      ASSERT_EQ(scene.layer.contacts().size(), 1u);
    }
    error[level] =
        norm(scene.layer.contacts()[0].shear - start) / norm(start); // a full turn: back where it was
  }
  EXPECT_LT(error[0], 1e-4);
  EXPECT_LT(error[1], error[0] / 3.5 + 1e-12);
}

// A heap of spheres that bounce, slide and roll on a disc, some seated; all at random.
std::unique_ptr<SphereScene> heap(double skin, int n = 300) {
  SurfaceContact contact = frictional(0.5, 0.3);
  contact.damping = 0.1;
  contact.skin = skin;
  contact.seat_modulus = 1e9;
  std::mt19937 engine(5);
  std::uniform_real_distribution<double> draw(-1, 1);
  std::vector<Vector3> centres(static_cast<std::size_t>(n));
  for (Vector3 &c : centres)
    c = {0.02 * draw(engine), 0.02 * draw(engine), sphere_radius * (1.4 + 0.5 * draw(engine))};
  auto scene = std::make_unique<SphereScene>(
      fem::RigidBody(fem::make_grid(fem::CylinderPlate{0.03, 0.01, -0.01, 11, 1}), steel), centres, contact);
  scene->gravity = {3, 1, -2000};
  scene->layer.seat_within(scene->particles, scene->body, 0.2 * sphere_radius);
  for (std::size_t i = 0; i < scene->particles.size(); ++i)
    scene->particles.velocity[i] = 2.0 * Vector3{draw(engine), draw(engine), draw(engine)};
  scene->body.set_velocity({0.1, 0.05, 0.2}, {1, 2, 3});
  return scene;
}

void expect_same(const SphereScene &a, const SphereScene &b) {
  // But for the rows: which particles are listed as near depends on when the list was made.
  EXPECT_TRUE(same_state(without(state_of(a), "/rows/"), without(state_of(b), "/rows/")));
  EXPECT_EQ(a.layer.closed, b.layer.closed);
  EXPECT_EQ(a.layer.elastic_energy(), b.layer.elastic_energy());
  EXPECT_EQ(a.layer.contacts().size(), b.layer.contacts().size());
}

constexpr double dt = 2e-7;

void run(SphereScene &scene, int steps) {
  for (int n = 0; n < steps; ++n)
    scene.step(dt);
}

TEST(contact_history, the_result_does_not_know_when_the_list_was_made) {
  const auto often = heap(0.02 * sphere_radius), seldom = heap(1.5 * sphere_radius);
  run(*often, 3000), run(*seldom, 3000);
  EXPECT_GT(often->layer.contacts().size(), 5u);
  EXPECT_GT(often->layer.friction_work, 0.0);
  EXPECT_GT(often->layer.damping_work, 0.0);
  expect_same(*often, *seldom);
}

// Time steps are estimated on lists made for them, between the forces and what is told of them.
TEST(contact_history, contacts_are_told_the_same_after_the_list_was_made_anew) {
  const auto scene = heap(0.5 * sphere_radius);
  run(*scene, 3000);
  const std::vector<int> rows = scene->layer.search().particles();
  const std::vector<ActiveContact> before = scene->layer.contacts();
  const std::vector<double> slip = scene->layer.vertex_slip(scene->body);
  ASSERT_GT(before.size(), 5u);
  scene->layer.make_list(scene->particles, scene->body);
  const std::vector<int> now = scene->layer.search().particles();
  const auto place = [](const std::vector<int> &in, int particle) {
    return std::find(in.begin(), in.end(), particle) - in.begin();
  };
  EXPECT_NE(place(rows, before.back().particle), place(now, before.back().particle)); // or this shows nothing
  const std::vector<ActiveContact> after = scene->layer.contacts();
  ASSERT_EQ(after.size(), before.size());
  double sheared = 0;
  for (std::size_t k = 0; k < before.size(); ++k) {
    EXPECT_EQ(after[k].particle, before[k].particle) << k;
    EXPECT_EQ(after[k].normal_force, before[k].normal_force) << k;
    EXPECT_EQ(norm(after[k].shear - before[k].shear), 0) << k;
    EXPECT_EQ(after[k].sliding, before[k].sliding) << k;
    EXPECT_EQ(after[k].slip, before[k].slip) << k;
    sheared += norm(before[k].shear);
  }
  EXPECT_GT(sheared, 0);
  EXPECT_EQ(scene->layer.vertex_slip(scene->body), slip);
}

TEST(contact_history, threads_do_not_show) {
  const auto one = heap(0.3 * sphere_radius, 5000), four = heap(0.3 * sphere_radius, 5000);
  {
    const ThreadLimit limit(1);
    run(*one, 60);
  }
  const ThreadLimit limit(4);
  run(*four, 60);
  EXPECT_GT(one->layer.history().size(), 2048u); // more than one block of rows
  expect_same(*one, *four);
}

// Sphere by sphere the friction bound, in the heap.
TEST(contact_history, no_contact_of_a_heap_passes_its_friction_limit) {
  const auto scene = heap(0.3 * sphere_radius);
  int slides = 0, sticks = 0;
  for (int n = 0; n < 3000; ++n) {
    scene->step(dt);
    for (const ActiveContact &c : scene->layer.contacts()) {
      ASSERT_GE(c.normal_force, 0);
      ASSERT_LE(norm(c.shear), (c.sliding ? 0.3 : 0.5) * c.normal_force * (1 + 1e-14));
      ASSERT_LE(std::abs(dot(c.shear, c.normal)), 1e-14 * (c.normal_force + norm(c.shear)));
      (c.sliding ? slides : sticks) += 1;
    }
  }
  EXPECT_GT(slides, 1000);
  EXPECT_GT(sticks, 1000);
}

// A seat: the moment is 2 G_b pi R^3 / 8 times the angle, up to half of N R; the body feels its opposite.
TEST(contact_history, a_seat_rocks_on_its_spring_up_to_its_limit) {
  SurfaceContact contact = frictional(infinite, infinite);
  contact.seat_modulus = 40e9;
  SphereScene scene(plate(0.01, 6), {{0.001, 0.0004, sphere_radius}}, contact);
  scene.layer.seat_within(scene.particles, scene.body, 0.1 * sphere_radius);
  const double normal = 50; // N
  scene.particles.position[0].z -= normal / plate_stiffness;
  scene.compute_forces(0);
  const double k = 2 * 40e9 * pi * 1e-9 / 8, h = 1e-5, limit = 0.5 * normal * sphere_radius;
  // Rolls about its contact point: no slip there, so the torque is the seat's alone.
  const double arm = scene.particles.position[0].z, rate = limit / k / (50 * h);
  (*scene.particles.angular_velocity)[0] = {0, rate, 7.0}; // drilling is free
  scene.particles.velocity[0] = {rate * arm, 0, 0};
  for (int n = 1; n <= 100; ++n) {
    scene.carry(h);
    const double expected = std::min(limit, k * rate * h * n);
    ASSERT_NEAR((*scene.particles.torque)[0].y, -expected, 1e-9 * limit) << n;
    const Vector3 c = {scene.particles.position[0].x, scene.particles.position[0].y,
                       scene.particles.position[0].z};
    ASSERT_NEAR(scene.body.moment(c)[1], expected, 1e-9 * limit);
    ASSERT_NEAR((*scene.particles.torque)[0].z, 0, 1e-9 * limit);
  }
  EXPECT_NEAR(scene.layer.friction_work, limit * rate * h * 50, 0.02 * limit * rate * h * 50);
}

} // namespace
} // namespace platen::coupling::contact_history_test
