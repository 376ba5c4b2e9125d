#include "coupling/contact/transfer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "sphere_scene.h"
#include "tests/measured.h"
#include "tests/surface_sums.h"

namespace platen::coupling::transfer_test {
namespace {

struct Tie {
  double seat_modulus; // Pa
  bool glued;
};

// A disc that drifts and turns, with a crowd of spheres pressed into it from all sides at random.
struct Crowd {
  SphereScene scene;
  explicit Crowd(const Tie &tie) : scene(disc(), centres(), contact(tie), true, 0.004) {
    std::mt19937 engine(9);
    std::uniform_real_distribution<double> draw(-1, 1);
    for (std::size_t i = 0; i < scene.particles.size(); ++i) {
      scene.particles.velocity[i] = 0.1 * Vector3{draw(engine), draw(engine), draw(engine)};
      (*scene.particles.angular_velocity)[i] = 30.0 * Vector3{draw(engine), draw(engine), draw(engine)};
    }
    scene.layer.seat_within(scene.particles, scene.body, 0.001);
    scene.body.set_velocity({0.05, -0.02, 0.03}, {2, -3, 1});
    for (int n = 0; n < 20; ++n)
      scene.carry(1e-4);
  }
  static fem::RigidBody disc() {
    fem::RigidBody body(fem::make_grid(fem::CylinderPlate{0.03, 0.01, 0, 7, 2}), steel);
    body.set_velocity({1, 2, 3}, {1, 0.5, -0.7});
    body.drift(1); // skew, and away from the origin
    body.set_velocity({});
    return body;
  }
  static std::vector<Vector3> centres() {
    const fem::RigidBody body = disc();
    const Vector3 c = body.centre();
    std::mt19937 engine(8);
    std::uniform_real_distribution<double> draw(-1, 1);
    std::vector<Vector3> points(400);
    for (Vector3 &p : points)
      p = c + 0.035 * Vector3{draw(engine), draw(engine), draw(engine)};
    return points;
  }
  static SurfaceContact contact(const Tie &tie) {
    SurfaceContact p = frictional(0.4, 0.3);
    p.skin = 0.001;
    p.damping = 0.1;
    p.seat_modulus = tie.seat_modulus;
    if (tie.glued) p.attachment = Attachment::glued;
    return p;
  }
};

class Transfer : public testing::TestWithParam<Tie> {};

// Sum of forces, of moments about any point, and power: what the particles feel is what the body gives, to
// 1e-13 of the sum of the parts' sizes.
TEST_P(Transfer, loads_are_equal_and_opposite_to_what_the_particles_feel) {
  Crowd crowd(GetParam());
  SphereScene &scene = crowd.scene;
  ASSERT_GT(scene.layer.contacts().size(), 40u);
  double worst_force = 0, worst_moment = 0;
  for (const Vector3 &about : {Vector3{0, 0, 0}, Vector3{1, 2, 3}, Vector3{-7, 5, 11}}) {
    Vector3 force, moment;
    double forces = 0, moments = 0;
    for (std::size_t i = 0; i < scene.particles.size(); ++i) {
      const Vector3 f = scene.particles.force[i], arm = scene.particles.position[i] - about;
      force += f;
      moment += cross(arm, f) + (*scene.particles.torque)[i];
      forces += norm(f);
      moments += norm(arm) * norm(f);
    }
    // Each by itself: a maximum passes over what is no number.
    EXPECT_LE(norm(force + scene.load()), 1e-13 * forces);
    EXPECT_LE(norm(moment + scene.body.moment(about)), 1e-13 * moments);
    worst_force = std::max(worst_force, norm(force + scene.load()) / forces);
    worst_moment = std::max(worst_moment, norm(moment + scene.body.moment(about)) / moments);
  }
  measured::expect_below(7, "sum_of_forces", worst_force, 1e-13);
  measured::expect_below(7, "sum_of_moments", worst_moment, 1e-13);
}

// The same weights both ways: the power that the body takes up is force times surface velocity, contact by
// contact.
TEST_P(Transfer, power_is_the_same_on_both_sides) {
  Crowd crowd(GetParam());
  SphereScene &scene = crowd.scene;
  const dem::Particles &p = scene.particles;
  double power = 0, size = 0;
  for (const ActiveContact &c : scene.layer.contacts()) {
    const auto i = static_cast<std::size_t>(c.particle);
    const Vector3 f = p.force[i], r = c.point - scene.body.centre();
    const Vector3 w = scene.body.angular_velocity(), surface = scene.body.velocity() + cross(w, r);
    const Vector3 seat = (*p.torque)[i] - cross(c.point - p.position[i], f);
    power += dot(f, surface) + dot(seat, w);
    size += norm(f) * norm(surface);
  }
  EXPECT_NEAR(fem::load_power(scene.body), -power, 1e-12 * size);
}

INSTANTIATE_TEST_SUITE_P(with_and_without_seats, Transfer,
                         testing::Values(Tie{0, false}, Tie{5e9, false}, Tie{0, true}, Tie{5e9, true}));

// A warped face that moves rigidly: velocity of any of its points, its rotation and its spin are those of the
// motion.
TEST(transfer, a_rigid_motion_of_the_corners_is_a_rigid_motion_of_the_face) {
  std::mt19937 engine(3);
  std::uniform_real_distribution<double> draw(-1, 1);
  const auto random = [&] { return Vector3{draw(engine), draw(engine), draw(engine)}; };
  for (int trial = 0; trial < 200; ++trial) {
    const Vector3 v = random(), w = random(), o = random();
    fem::SurfaceMesh surface;
    const Quad q = {o, o + Vector3{1, 0, 0} + 0.3 * random(), o + Vector3{1, 1, 0} + 0.3 * random(),
                    o + Vector3{0, 1, 0} + 0.3 * random()};
    for (const Vector3 &x : q) {
      surface.vertices.push_back(x);
      surface.velocities.push_back(v + cross(w, x));
    }
    surface.faces = {{0, 1, 2, 3}};
    surface.face_tags = {0};
    const Vector3 centre = o + random();
    const SurfacePoint s = SurfaceSearch(surface, 1).closest_of_all(surface, centre);
    const SurfaceMotion motion = surface_motion(surface, s);
    EXPECT_LT(norm(motion.velocity - (v + cross(w, centre + s.local.point))), 1e-14);
    EXPECT_LT(norm(face_rotation(surface, 0) - w), 1e-13);
    const Vector3 normal = bilinear_normal(face_corners(surface, 0, centre), s.local.u, s.local.v);
    EXPECT_NEAR(motion.spin, dot(w, normal), 1e-13);
  }
}

// Moments laid on a needle of aspect 1e-9 and on a line: finite; exact where a face can take a moment at all.
TEST(transfer, a_moment_on_a_face_is_a_moment_without_a_force) {
  fem::RigidBody body(fem::make_grid(fem::BoxPlate{{0, 0, 0}, {1, 0.001, 0.1}, {1, 1, 1}}), steel);
  apply_moment(body, 0, {1, -2, 3});
  EXPECT_LT(norm(body.total_force()), 1e-13 * 3e3); // forces of M / width
  EXPECT_LT(norm(body.moment({4, 5, 6}) - Vector3{1, -2, 3}), 1e-10);
}

} // namespace
} // namespace platen::coupling::transfer_test
