// One sphere against a flat plate: what a plane's formula says must come out whatever the mesh.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "sphere_scene.h"
#include "tests/measured.h"

namespace platen::coupling::contact_plate_test {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

// The closed form beside which everything is held: plane z = 0, spring along it, written without any mesh.
struct PlaneContact {
  double friction_static, friction_dynamic, k_t = 0.8 * plate_stiffness;
  Vector3 spring;
  bool sliding = false;
  Vector3 force(double height, const Vector3 &velocity, double dt) {
    const double normal = plate_stiffness * std::max(0.0, sphere_radius - height);
    Vector3 t = spring - k_t * dt * Vector3{velocity.x, velocity.y, 0};
    const double size = norm(t);
    if (size > (sliding ? friction_dynamic : friction_static) * normal) {
      sliding = true;
      t *= friction_dynamic * normal / size;
    } else {
      sliding = false;
    }
    spring = t;
    return {t.x, t.y, normal};
  }
};

struct Way {
  const char *name;
  Vector3 start, direction;
};

// Ways over the plate: anywhere; along inner edges of the finer meshes; through their vertices on the
// diagonal; just beside an edge.
const std::vector<Way> ways = {{"askew", {-0.0073, -0.0041, 0}, {0.8, 0.6, 0}},
                               {"along an edge", {-0.008, 0, 0}, {1, 0, 0}},
                               {"through vertices", {-0.006, -0.006, 0}, {1, 1, 0}},
                               {"beside an edge", {-0.008, 1e-15, 0}, {1, 0, 0}}};

class DraggedSphere : public testing::TestWithParam<int> {};

// Drag with a height that goes up and down, so that stick and slip alternate. Force to 1e-12 of the plane's
// formula: the sphere overlaps by 1e-3 R or more, which leaves 1e-13 after the subtraction R - height.
TEST_P(DraggedSphere, feels_a_plane_however_the_plate_is_meshed) {
  double worst = 0;
  for (const Way &way : ways) {
    SphereScene scene(plate(0.01, GetParam()), {way.start + Vector3{0, 0, 0.995 * sphere_radius}},
                      frictional(0.5, 0.3));
    PlaneContact plane{0.5, 0.3, 0.8 * plate_stiffness, {}, false};
    const double dt = 1e-5;
    const int steps = 3000;
    const double speed = 0.012 / norm(way.direction) / (steps * dt);
    int slides = 0;
    for (int n = 0; n < steps; ++n) {
      const double forth = (n / 300) % 3 == 2 ? -0.2 : 1; // back at times, which lets friction stick
      scene.particles.velocity[0] = forth * speed * way.direction + Vector3{0, 0, -0.1 * std::sin(0.02 * n)};
      scene.carry(dt);
      const Vector3 expected = plane.force(scene.particles.position[0].z, scene.particles.velocity[0], dt);
      ASSERT_EQ(scene.layer.contacts().size(), 1u) << way.name << n;
      const double off = norm(scene.particles.force[0] - expected) / expected.z;
      ASSERT_LE(off, 1e-12) << way.name << n; // not of the worst: a maximum passes over what is no number
      worst = std::max(worst, off);
      ASSERT_LE(norm(scene.load() + expected), 1e-12 * expected.z) << way.name << n;
      ASSERT_EQ(scene.layer.contacts()[0].sliding, plane.sliding) << way.name << n;
      slides += plane.sliding;
    }
    EXPECT_GT(slides, 1000);
    EXPECT_LT(slides, steps - 100);
  }
  measured::note_figure(20, "force_against_a_plane", worst, "<= 1e-12");
}

// Without friction there is no force along the plate at all: no ripple, not a bit of it.
TEST_P(DraggedSphere, has_no_ripple_without_friction) {
  for (const Way &way : ways) {
    SphereScene scene(plate(0.01, GetParam()), {way.start + Vector3{0, 0, 0.999 * sphere_radius}},
                      frictional(0, 0));
    const double overlap = sphere_radius - scene.particles.position[0].z;
    scene.particles.velocity[0] = 0.4 * way.direction;
    for (int n = 0; n < 3000; ++n) {
      scene.carry(1e-5);
      ASSERT_EQ(scene.particles.force[0].x, 0.0) << way.name << n;
      ASSERT_EQ(scene.particles.force[0].y, 0.0) << way.name << n;
      ASSERT_EQ(scene.particles.force[0].z, plate_stiffness * overlap) << way.name << n;
    }
    EXPECT_EQ(scene.layer.friction_work, 0.0);
  }
}

INSTANTIATE_TEST_SUITE_P(quads_along_a_side, DraggedSphere, testing::Values(1, 10, 100));

// The same on a plate turned into a skew position: only round-off of turned coordinates (1e-17 m against
// overlaps of 5e-6 m) may show.
TEST(contact_plate, a_skew_plate_feels_like_a_level_one) {
  fem::RigidBody body = plate(0.01, 10);
  body.set_velocity({}, {0.3, -0.5, 0.2});
  body.drift(1);
  body.set_velocity({});
  Vector3 up;
  for (std::size_t f = 0; f < body.surface().faces.size(); ++f) {
    const Vector3 a = fem::face_area_vector(body.surface(), f);
    if (body.surface().face_tags[f] == fem::high_end_tag) up = a / norm(a);
  }
  const Vector3 top = body.centre() + 0.005 * up;
  const Vector3 along = cross(up, Vector3{1, 0, 0}) / norm(cross(up, Vector3{1, 0, 0}));
  SphereScene scene(std::move(body), {top - 0.006 * along + 0.995 * sphere_radius * up},
                    frictional(0.4, 0.4));
  scene.particles.velocity[0] = 1.2 * along;
  const double normal = plate_stiffness * 0.005 * sphere_radius;
  for (int n = 0; n < 1000; ++n) {
    scene.carry(1e-5);
    const double sliding = std::min(0.4 * normal, 0.8 * plate_stiffness * 1.2 * 1e-5 * (n + 1));
    ASSERT_LT(norm(scene.particles.force[0] - (normal * up - sliding * along)), 1e-11 * normal);
  }
}

// The stiffest spring on a face is that over its softest corner, whichever that is.
TEST(contact_plate, the_softest_corner_of_a_face_bounds_its_springs) {
  const auto spring = [](int softest) {
    SurfaceContact contact = frictional(0.4, 0.4);
    contact.face_compliance.assign(plate(0.01, 1).surface().faces.size(), fem::FaceCompliance{});
    for (fem::FaceCompliance &c : contact.face_compliance)
      for (int corner = 0; corner < 4; ++corner)
        c[corner][corner] = (corner == softest ? 0.2 : 0.05) / plate_stiffness;
    SphereScene scene(plate(0.01, 1), {{0, 0, 0.99 * sphere_radius}}, contact, false);
    scene.carry(1e-9);
    return scene.layer.ground_springs(scene.particles, scene.body).at(0).normal_stiffness;
  };
  const double nowhere = spring(-1);
  EXPECT_GT(nowhere, plate_stiffness);
  EXPECT_GT(spring(0), 1.1 * nowhere);
  for (int corner = 1; corner < 4; ++corner)
    EXPECT_EQ(spring(corner), spring(0)) << corner;
}

TEST(contact_plate, sliding_starts_at_the_static_limit_and_goes_on_at_the_dynamic_one) {
  SphereScene scene(plate(0.01, 10), {{-0.005, 0.001, 0.99 * sphere_radius}}, frictional(0.57, 0.3));
  const double normal = plate_stiffness * 0.01 * sphere_radius, dt = 1e-6;
  scene.particles.velocity[0] = {0.01, 0, 0};
  double largest = 0;
  for (int n = 0; n < 2000; ++n) {
    scene.carry(dt);
    const double t = norm(scene.layer.contacts()[0].shear);
    largest = std::max(largest, t);
    if (scene.layer.contacts()[0].sliding) {
      ASSERT_NEAR(t, 0.3 * normal, 1e-12 * normal);
    }
  }
  // One step adds k_t v dt to the force: so close below the limit was the last that held.
  EXPECT_LE(largest, 0.57 * normal);
  EXPECT_GT(largest, 0.57 * normal - 0.8 * plate_stiffness * 0.01 * dt * 1.001);
  EXPECT_TRUE(scene.layer.contacts()[0].sliding);
}

TEST(contact_plate, a_seat_has_its_own_zero) {
  for (const double height : {0.9, 1.4}) { // sawn into; standing off
    SphereScene scene(plate(0.01, 4), {{0.0012, 0, height * sphere_radius}}, frictional(0, 0));
    EXPECT_EQ(scene.layer.seat_within(scene.particles, scene.body, 0.5 * sphere_radius), 1);
    EXPECT_EQ(scene.layer.seats(), 1);
    scene.compute_forces(0);
    EXPECT_EQ(scene.particles.force[0].z, 0.0);
    scene.particles.position[0].z -= 1e-6;
    scene.compute_forces(0);
    EXPECT_NEAR(scene.particles.force[0].z, plate_stiffness * 1e-6, 1e-9 * plate_stiffness * 1e-6);
    scene.particles.position[0].z += 2e-6;
    scene.compute_forces(0);
    EXPECT_EQ(scene.particles.force[0].z, 0.0);
  }
}

TEST(contact_plate, seats_are_those_within_the_end_layer) {
  std::vector<Vector3> centres;
  for (int k = 0; k < 8; ++k)
    centres.push_back({-0.008 + 0.0022 * k, 0, sphere_radius * (0.9 + 0.1 * k)});
  SphereScene scene(plate(0.01, 4), centres, frictional(0, 0));
  EXPECT_EQ(scene.layer.seat_within(scene.particles, scene.body, 0.35 * sphere_radius), 5); // up to 1.3 R
}

// A strip grinds what is under its face, round-off of the face included; a face that leans grinds nothing.
TEST(contact_plate, seats_under_a_face_allow_for_its_round_off) {
  for (const auto &[slope, seats] : {std::pair{0.0, 1}, std::pair{1e-6, 1}, std::pair{1e-3, 0}}) {
    const fem::Grid face =
        fem::moved_grid(fem::make_grid(fem::BoxPlate{{-0.01, -0.01, -0.01}, {0.01, 0.01, 0}, {4, 4, 1}}),
                        [slope = slope](const Vector3 &p) {
                          return Vector3{p.x, p.y, p.z + slope * p.x};
                        });
    SphereScene scene(fem::RigidBody(face, steel), {{0.0012, 0, sphere_radius}}, frictional(0, 0));
    EXPECT_EQ(scene.layer.seat_within(scene.particles, scene.body, 0.1 * sphere_radius, true), seats)
        << slope;
    EXPECT_EQ(scene.layer.seat_within(scene.particles, scene.body, 0.1 * sphere_radius, false), 1) << slope;
  }
}

// Glue: pull and push alike, and no limit along the plate.
TEST(contact_plate, glue_holds_in_tension_and_shear) {
  SurfaceContact contact = frictional(0.1, 0.1);
  contact.attachment = Attachment::glued;
  SphereScene scene(plate(0.01, 4), {{0.0012, 0, sphere_radius}}, contact, false);
  scene.layer.seat_within(scene.particles, scene.body, 0.1 * sphere_radius);
  scene.particles.velocity[0] = {0.002, 0, 0.01};
  for (int n = 0; n < 1000; ++n)
    scene.carry(1e-5);
  EXPECT_NEAR(scene.particles.force[0].z, -plate_stiffness * 1e-4, 1e-9 * plate_stiffness * 1e-4);
  EXPECT_NEAR(scene.particles.force[0].x, -0.8 * plate_stiffness * 2e-5, 1e-9 * plate_stiffness * 1e-4);
  EXPECT_EQ(scene.layer.friction_work, 0.0);
  // What was put in by hand is all stored.
  EXPECT_NEAR(scene.layer.elastic_energy(), 0.5 * plate_stiffness * (1e-8 + 0.8 * 4e-10),
              1e-9 * plate_stiffness * 1e-8);
}

TEST(contact_plate, a_sphere_on_no_slip_ground_rolls) {
  SphereScene scene(plate(0.01, 20), {{-0.006, 0, 0.999 * sphere_radius}}, frictional(infinite, infinite));
  // Pulled by a force at its centre it accelerates with F / (m + I/r^2); the spring's vibration averages out.
  const double dt = 2e-7, pull = 0.02, r = 0.999 * sphere_radius;
  scene.gravity = {pull / scene.particles.mass[0], 0,
                   -plate_stiffness * 1e-3 * sphere_radius / scene.particles.mass[0]};
  scene.compute_forces(0);
  const int steps = 20000;
  for (int n = 0; n < steps; ++n)
    scene.step(dt);
  const double expected =
      pull / (scene.particles.mass[0] + (*scene.particles.inertia)[0] / (r * r)) * steps * dt;
  EXPECT_NEAR(scene.particles.velocity[0].x, expected, 2e-3 * expected);
  EXPECT_NEAR((*scene.particles.angular_velocity)[0].y * r, expected, 2e-3 * expected);
  EXPECT_EQ(scene.layer.friction_work, 0.0);
}

// Over the rim of the plate: the force changes by no more than k times the way of a step, and half the step
// halves the largest change: no jump hides in it.
TEST(contact_plate, force_is_continuous_over_the_rim) {
  double change[2] = {0, 0};
  for (int level = 0; level < 2; ++level) {
    SphereScene scene(plate(0.01, 5), {{0.0085, 0.0003, 0.98 * sphere_radius}}, frictional(0.3, 0.3));
    const double dt = level == 0 ? 1e-5 : 5e-6, speed = 0.3;
    scene.compute_forces(0);
    Vector3 last = scene.particles.force[0];
    int touching = 0;
    for (double way = 0; way < 0.0035; way += speed * dt) {
      scene.particles.velocity[0] = {speed, 0, -0.1};
      (*scene.particles.angular_velocity)[0] = {0, speed / sphere_radius, 0};
      scene.carry(dt);
      change[level] = std::max(change[level], norm(scene.particles.force[0] - last));
      last = scene.particles.force[0];
      touching += scene.layer.contacts().size() == 1;
      ASSERT_LE(scene.layer.contacts().size(), 1u);
    }
    EXPECT_GT(touching, 100);
    EXPECT_EQ(scene.layer.contacts().size(), 0u); // it has left
    EXPECT_LE(change[level], 4 * plate_stiffness * speed * dt);
  }
  EXPECT_NEAR(change[0] / change[1], 2, 0.2);
}

TEST(contact_plate, a_sphere_may_move_up_to_its_radius_in_a_step_and_no_farther) {
  for (const double share : {0.01, 0.03, 0.1, 0.3, 0.5, 0.99}) {
    SphereScene scene(plate(0.01, 20), {{0.00031, 0.0007, 5 * sphere_radius}}, frictional(0.3, 0.3));
    const double dt = 1e-6;
    scene.particles.velocity[0] = {0, 0, -share * sphere_radius / dt};
    bool seen = false;
    for (int n = 0; n < 1000 && !seen; ++n) {
      scene.carry(dt);
      seen = scene.particles.force[0].z > 0;
      ASSERT_GT(scene.particles.position[0].z, -sphere_radius) << share; // has not passed unseen
    }
    EXPECT_TRUE(seen) << share;
  }
  SphereScene scene(plate(0.01, 20), {{0, 0, 5 * sphere_radius}}, frictional(0.3, 0.3));
  EXPECT_NO_THROW(scene.layer.moved(sphere_radius));
  EXPECT_THROW(scene.layer.moved(1.001 * sphere_radius), std::runtime_error);
  EXPECT_THROW(scene.layer.moved(std::nan("")), std::runtime_error);
}

TEST(contact_plate, parameters_out_of_range_are_refused_by_name) {
  const auto refusal = [](const std::function<void(SurfaceContact &)> &change) -> std::string {
    SurfaceContact contact = frictional(0.3, 0.3);
    change(contact);
    try {
      SphereScene scene(plate(0.01, 1), {{0, 0, 1}}, contact, false);
    } catch (const std::invalid_argument &e) {
      return e.what();
    }
    return "";
  };
  using C = SurfaceContact;
  using By = dem::Weakening::By;
  const double none = std::nan("");
  const std::vector<std::pair<std::string, std::function<void(C &)>>> all{
      {"particle stiffness", [&](C &c) { c.particle_stiffness = none; }},
      {"static friction", [](C &c) { c.friction_static = -0.1; }},
      {"dynamic friction", [](C &c) { c.friction_dynamic = -0.1; }},
      {"slip length",
       [](C &c) {
         c.friction_dynamic = 0.2, c.weakening = {By::slip, 0, 1};
       }},
      {"slip velocity",
       [](C &c) {
         c.friction_dynamic = 0.2, c.weakening = {By::velocity, 1, 0};
       }},
      {"must not grow",
       [](C &c) {
         c.friction_dynamic = 0.5, c.weakening = {By::slip, 1e-3, 0};
       }},
      {"damping", [](C &c) { c.damping = -1; }},
      {"skin", [](C &c) { c.skin = 0; }},
      {"one entry per face", [](C &c) { c.face_compliance.resize(1); }}, // a box has six faces
      {"rotate", [](C &c) { c.seat_modulus = 1e9; }}};                   // spheres of this scene do not
  for (const auto &[word, change] : all)
    EXPECT_NE(refusal(change).find(word), std::string::npos) << word;
  EXPECT_EQ(refusal([&](C &c) { c.friction_dynamic = none; }), ""); // not given: the static one
  EXPECT_EQ(frictional(0.3, none).dynamic(), 0.3);
}

} // namespace
} // namespace platen::coupling::contact_plate_test
