// Spheres on platens by Hertz and Mindlin: the law by itself, its energies, its springs, and how scenes of
// the library come to it.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "coupling/platen_test.h"
// After what it would shadow.
#include "sphere_scene.h"

#include "base/pi.h"
#include "dem/packing/specimen.h"

namespace platen::coupling::hertz_platen_test {
namespace {

constexpr double sphere_modulus = 70e9, sphere_poisson = 0.25; // Pa, 1
constexpr double infinite = std::numeric_limits<double>::infinity();

const dem::HertzOnPlane::Side glass{sphere_modulus, sphere_poisson};

SurfaceContact by_hertz(double friction, const dem::HertzOnPlane::Side &plane = {}) {
  SurfaceContact contact;
  contact.hertz = dem::HertzOnPlane::between(glass, plane);
  contact.friction_static = friction;
  contact.skin = 0.3 * sphere_radius;
  return contact;
}

TEST(hertz_platen, both_sides_give_way_as_their_moduli_say) {
  const double nu = sphere_poisson;
  const dem::HertzOnPlane rigid = dem::HertzOnPlane::between(glass, {}),
                          alike = dem::HertzOnPlane::between(glass, glass);
  EXPECT_NEAR(rigid.modulus, sphere_modulus / (1 - nu * nu), 1e-12 * sphere_modulus);
  EXPECT_NEAR(alike.modulus, 0.5 * rigid.modulus, 1e-12 * sphere_modulus);
  // Mindlin 1949: k_t/k_n = 2 (1 - nu)/(2 - nu) of alike sides, and of one against what is rigid.
  for (const dem::HertzOnPlane &law : {rigid, alike})
    EXPECT_NEAR(law.tangential_ratio, 2 * (1 - nu) / (2 - nu), 1e-12);
  // 1/G* = (2 - nu_1)/G_1 + (2 - nu_2)/G_2, k_t = 8 G* a, k_n = 2 E* a.
  const dem::HertzOnPlane::Side steel_side{210e9, 0.3};
  const double g1 = sphere_modulus / (2 * (1 + nu)), g2 = 210e9 / 2.6;
  const dem::HertzOnPlane mixed = dem::HertzOnPlane::between(glass, steel_side);
  EXPECT_NEAR(mixed.tangential_ratio, 8 / ((2 - nu) / g1 + 1.7 / g2) / (2 * mixed.modulus), 1e-12);
}

// N = 4/3 E* sqrt(R) d^1.5; its slope; its integral.
TEST(hertz_platen, the_force_is_the_power_of_three_halves) {
  const dem::HertzOnPlane law = dem::HertzOnPlane::between(glass, {});
  const double d = 1e-3 * sphere_radius, force = 4.0 / 3 * law.modulus * std::sqrt(sphere_radius * d) * d;
  const dem::HertzOnPlane::Response r = law(d, sphere_radius);
  EXPECT_NEAR(r.force, force, 1e-14 * force);
  EXPECT_NEAR(r.stiffness, 2 * law.modulus * std::sqrt(sphere_radius * d), 1e-12 * r.stiffness);
  EXPECT_NEAR(r.energy, 0.4 * force * d, 1e-14 * force * d);
  EXPECT_NEAR(law(2 * d, sphere_radius).force, std::pow(2, 1.5) * force, 1e-12 * force);
  EXPECT_NEAR(law(d, 4 * sphere_radius).force, 2 * force, 1e-12 * force);
}

// The mesh gives c N, so that both together are the law wherever that is possible; force, slope and energy go
// on without a jump where it ends to be.
TEST(hertz_platen, the_indentation_of_a_mesh_is_taken_out_of_the_law) {
  const dem::HertzOnPlane law = dem::HertzOnPlane::between(glass, {});
  const double c = 3e-8; // m/N
  double work = 0, last = 0, stiffness = 0;
  bool taken_out = true, some_taken_out = false, beyond = false;
  constexpr int steps = 200000;
  const double most = 0.05 * sphere_radius;
  for (int n = 1; n <= steps; ++n) {
    const double d = most * n / steps;
    const dem::HertzOnPlane::Response r = law(d, sphere_radius, c);
    work += 0.5 * (last + r.force) * most / steps;
    ASSERT_GT(r.force, last);
    const double whole = d + c * r.force; // with what the mesh gives
    const double k = law(whole, sphere_radius).stiffness;
    const bool takes = k * c < dem::HertzOnPlane::most_indentation;
    if (n > 10 && takes == taken_out) {
      ASSERT_NEAR((r.force - last) / (most / steps), 0.5 * (stiffness + r.stiffness), 1e-2 * r.stiffness)
          << n;
    }
    taken_out = takes;
    some_taken_out = some_taken_out || takes;
    if (takes) {
      ASSERT_NEAR(r.force, law(whole, sphere_radius).force, 1e-9 * r.force);
    } else {
      ASSERT_GT(law(whole, sphere_radius).force, r.force);
      beyond = true;
    }
    last = r.force;
    stiffness = r.stiffness;
  }
  EXPECT_TRUE(some_taken_out && beyond);
  EXPECT_NEAR(law(most, sphere_radius, c).energy, work, 1e-6 * work);
}

// A sphere that is pushed in, dragged aside, turned and let go at will: what the plate gets, the springs
// hold, and friction and dashpots take is what came in.
double imbalance(double friction, double damping) {
  SurfaceContact contact = by_hertz(friction);
  contact.damping = damping;
  SphereScene scene(plate(0.01, 7), {{-0.001, 0.0007, 1.001 * sphere_radius}}, contact);
  const double dt = 2e-9;
  double in = 0, size = 0;
  Vector3 force{}, torque{};
  for (int n = 0; n < 40000; ++n) {
    const double t = n / 10000.0;
    const Vector3 v{0.05 * std::sin(2.3 * t), 0.04 * std::cos(3.1 * t), -0.1 * std::cos(1.9 * t)},
        w{20 * std::cos(2.9 * t), 30 * std::sin(1.3 * t), 25 * std::cos(2.1 * t)};
    scene.particles.velocity[0] = v;
    (*scene.particles.angular_velocity)[0] = w;
    scene.carry(dt);
    const Vector3 now = scene.particles.force[0], turning = (*scene.particles.torque)[0];
    const double work = -0.5 * dt * (dot(v, force + now) + dot(w, torque + turning));
    in += work;
    size += std::abs(work);
    force = now, torque = turning;
  }
  const double found = scene.layer.elastic_energy() + scene.layer.friction_work + scene.layer.damping_work;
  EXPECT_EQ(scene.layer.friction_work > 0, friction > 0);
  return std::abs(found - in) / size;
}

TEST(hertz_platen, what_comes_in_is_stored_or_lost) {
  for (const double friction : {0.0, 0.2, infinite})
    for (const double damping : {0.0, 0.3})
      EXPECT_LT(imbalance(friction, damping), 1e-4) << friction << " " << damping;
}

// Loading at a constant obliquity T = b N below the Coulomb limit leaves a T; unloading along another path
// with a softer spring must give back less than was put in (Elata and Berryman 1996: a spring that grows with
// the overlap may make energy).
TEST(hertz_platen, a_closed_path_never_gives_energy) {
  SphereScene scene(plate(0.01, 7), {{0, 0, sphere_radius}}, by_hertz(infinite), false);
  const double dt = 1e-9;
  double given = 0;
  Vector3 force{};
  const auto move = [&](const Vector3 &v, int steps) {
    for (int n = 0; n < steps; ++n) {
      scene.particles.velocity[0] = v;
      scene.carry(dt);
      given += 0.5 * dt * dot(v, force + scene.particles.force[0]); // of the contact on the sphere
      force = scene.particles.force[0];
    }
  };
  move({0, 0, -1}, 1000);
  for (int turn = 0; turn < 5; ++turn) {
    move({0.5, 0, 0}, 500);
    move({0, 0, 1}, 800);
    move({-0.5, 0, 0}, 500);
    move({0, 0, -1}, 800);
  }
  move({0, 0, 1}, 1100);
  EXPECT_LT(given, 0);
  EXPECT_NEAR(-given, scene.layer.friction_work, 1e-3 * scene.layer.friction_work);
  EXPECT_EQ(scene.layer.elastic_energy(), 0);
}

// Sphere and plate turn together about the normal: the tangential force turns with them.
TEST(hertz_platen, a_rigid_turn_carries_the_tangential_force) {
  SphereScene scene(plate(0.01, 7), {{0, 0, 0.999 * sphere_radius}}, by_hertz(infinite));
  scene.particles.velocity[0] = {0.01, 0, 0};
  for (int n = 0; n < 100; ++n)
    scene.carry(1e-6 / 100);
  const double before = scene.particles.force[0].x;
  ASSERT_LT(before, 0);
  // The sphere alone, by half a right angle: its spring turns half as far.
  scene.particles.velocity[0] = {};
  constexpr int steps = 1000;
  (*scene.particles.angular_velocity)[0] = {0, 0, 0.5 * pi};
  for (int n = 0; n < steps; ++n)
    scene.carry(1.0 / steps);
  EXPECT_NEAR(scene.particles.force[0].x, before * std::cos(0.25 * pi), 1e-9 * std::abs(before));
  EXPECT_NEAR(scene.particles.force[0].y, before * std::sin(0.25 * pi), 1e-9 * std::abs(before));
}

// Springs are counted as stiff as the deepest contact may yet become; deeper ones ask for another count.
TEST(hertz_platen, springs_for_the_time_step_follow_the_overlap) {
  SphereScene scene(plate(0.01, 7), {{0, 0, sphere_radius}, {0.004, 0, 0.9999 * sphere_radius}},
                    by_hertz(0.3));
  scene.carry(0);
  scene.layer.allow_for_depth();
  const auto counted = [&] { return scene.layer.ground_springs(scene.particles, scene.body); };
  const dem::HertzOnPlane law = *by_hertz(0.3).hertz;
  EXPECT_EQ(counted().at(0).normal_stiffness, law(2e-3 * sphere_radius, sphere_radius).stiffness);
  EXPECT_FALSE(scene.layer.stiffened());
  scene.particles.position[1].z = 0.99 * sphere_radius;
  scene.carry(0);
  EXPECT_TRUE(scene.layer.stiffened());
  scene.layer.allow_for_depth();
  EXPECT_FALSE(scene.layer.stiffened());
  for (const dem::GroundSpring &spring : counted()) {
    EXPECT_NEAR(spring.normal_stiffness, law(0.02 * sphere_radius, sphere_radius).stiffness,
                1e-9 * spring.normal_stiffness);
    EXPECT_NEAR(spring.tangential_stiffness, law.tangential_ratio * spring.normal_stiffness,
                1e-9 * spring.normal_stiffness);
  }
}

// A small column without bonds between platens.
PlatenTestSettings column_settings() {
  PlatenTestSettings s;
  s.model.contact = dem::ContactSettings{};
  s.model.contact->normal = dem::NormalContact::hertz;
  s.model.contact->young_modulus = sphere_modulus;
  s.model.contact->poisson_ratio = sphere_poisson;
  s.platens.thickness = 2 * sphere_radius;
  s.loading.rate = 0.1;
  s.loading.ramp = 1e-5;
  return s;
}

dem::Specimen column() {
  dem::Specimen s = spheres({{0, 0, sphere_radius}, {0, 0, 3 * sphere_radius}});
  s.shape = {dem::ShapeKind::cylinder, sphere_radius, 4 * sphere_radius};
  return s;
}

// Three contacts of two grains in a row, all of Hertz: platens that are rigid give E* of one side, so that
// each takes its own share of the closure.
TEST(hertz_platen, platens_press_as_grains_do) {
  PlatenTest test(column(), column_settings());
  ASSERT_TRUE(test.top().layer().parameters().hertz.has_value());
  EXPECT_NEAR(test.top().layer().parameters().hertz->modulus,
              sphere_modulus / (1 - sphere_poisson * sphere_poisson), 1);
  PlatenTestSettings linear = column_settings();
  linear.platens.contact = PlatenContact::linear;
  linear.platens.stiffness = {dem::Stiffness::Kind::absolute, 1e7};
  EXPECT_FALSE(PlatenTest(column(), linear).top().layer().parameters().hertz.has_value());
  PlatenTestSettings yielding = column_settings();
  yielding.platens.contact_modulus = sphere_modulus;
  yielding.platens.material.poisson_ratio = sphere_poisson;
  EXPECT_NEAR(PlatenTest(column(), yielding).top().layer().parameters().hertz->modulus,
              0.5 * sphere_modulus / (1 - sphere_poisson * sphere_poisson), 1);
  yielding.platens.contact_modulus = 0;
  yielding.platens.elastic = ElasticPlatens{};
  yielding.platens.material = {7800, sphere_modulus, sphere_poisson};
  EXPECT_NEAR(PlatenTest(column(), yielding).top().layer().parameters().hertz->modulus,
              0.5 * sphere_modulus / (1 - sphere_poisson * sphere_poisson), 1);
}

// What else it cannot be is in faults_test.cc.
TEST(hertz_platen, of_a_soft_sheet_or_of_grains_without_contacts_is_refused) {
  PlatenTestSettings sheet = column_settings(), bare = column_settings();
  sheet.platens.elastic.emplace().pad_thickness = 0.5e-3;
  sheet.platens.elastic->pad = {1100, 5e6, 0.45};
  bare.model.contact.reset();
  bare.platens.contact = PlatenContact::hertz;
  for (const PlatenTestSettings &s : {sheet, bare}) {
    try {
      PlatenTest test(column(), s);
      ADD_FAILURE();
    } catch (const BadSetup &e) {
      EXPECT_EQ(e.member(), "platens.contact");
    }
  }
}

} // namespace
} // namespace platen::coupling::hertz_platen_test
