// Spheres that are bonded to a face: what the bond bears in shear and in tension, and that it never comes
// back.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/pi.h"
#include "coupling/boundaries/sleeve.h"
#include "dem/laws/cohesive_friction.h"
#include "tests/coupling/set_ups.h"
#include "tests/coupling/sphere_scene.h"
#include "tests/same_state.h"

namespace platen::coupling::bonded_face_test {
namespace {

using dem::CohesiveFriction;
using State = CohesiveFriction::State;

constexpr double k = 2e5;                                           // N/m
constexpr CohesiveFriction::Parameters steel_face{0.4, 6, 5, 1e-4}; // 1, N, N, m: falls by .3 k

// Elastic to mu N + c, then T = mu N + c (1 - d / s_0) with k (u - d) = T, then mu N; after any number of
// steps.
TEST(cohesive_friction, rises_to_cohesion_and_friction_softens_and_rubs) {
  const double mu_n = 4, peak = 10, fall = 6 / 1e-4, begins = peak / k, ends = 1e-4 + mu_n / k;
  for (const int steps : {7, 1000}) {
    State state;
    double left = 1, lost = 0;
    const double step = 3e-4 / steps;
    for (int n = 1; n <= steps; ++n) {
      const double u = n * step, d = (k * u - peak) / (k - fall);
      const auto r = CohesiveFriction{steel_face}(state, left, {0, -step, 0}, 10, k);
      lost += r.dissipated;
      ASSERT_NEAR(r.force.y, -(u < begins ? k * u : u < ends ? peak - fall * d : mu_n), 1e-12 * peak) << u;
      ASSERT_NEAR(left, u < begins ? 1 : u < ends ? 1 - d / 1e-4 : 0, 1e-12) << u;
      ASSERT_NEAR(state.slip, u < begins ? 0 : u < ends ? d : u - mu_n / k, 1e-12 * 3e-4) << u;
    }
    // The triangle under the cohesion and the friction; steps with a corner of the line count it a little
    // off.
    EXPECT_NEAR(lost, 0.5 * 6 * 1e-4 + mu_n * (3e-4 - mu_n / k), 6 * step);
  }
}

TEST(cohesive_friction, what_is_lost_stays_lost_whichever_way_it_slides) {
  State state;
  double left = 1;
  const CohesiveFriction law{steel_face};
  // To half the cohesion: 7 N at u = 5e-5 + 7e-5 / 2 ... from k (u - d) = 7, d = 5e-5.
  law(state, left, {7 / k + 5e-5, 0, 0}, 10, k);
  EXPECT_NEAR(left, 0.5, 1e-12);
  EXPECT_NEAR(state.spring.x, 7, 1e-12);
  law(state, left, {-13.9 / k, 0, 0}, 10, k); // back to -6.9 N: holds
  EXPECT_EQ(state.sliding, 0);
  EXPECT_NEAR(left, 0.5, 1e-12);
  law(state, left, {-0.2 / k, 0, 0}, 10, k); // -7.1 N: slides on
  EXPECT_EQ(state.sliding, 1);
  EXPECT_LT(left, 0.5);
  EXPECT_NEAR(state.spring.x, -(4 + 6 * left), 1e-12);
  law(state, left, {-2e-4, 0, 0}, 10, k);
  EXPECT_EQ(left, 0);
  for (const double way : {3e-4, -5e-4}) {
    law(state, left, {way, 0, 0}, 10, k);
    EXPECT_NEAR(state.spring.x, way > 0 ? 4 : -4, 1e-12);
    EXPECT_EQ(left, 0);
  }
}

// Without a slip, or where the line falls more steeply than the spring, from peak to friction at once.
TEST(cohesive_friction, a_brittle_one_breaks_where_it_first_slides) {
  for (const double slip : {0.0, 0.99 * 6 / k, 1.01 * 6 / k}) {
    State state;
    double left = 1;
    const CohesiveFriction law{{0.4, 6, 5, slip}};
    law(state, left, {9.999 / k, 0, 0}, 10, k);
    EXPECT_EQ(left, 1);
    EXPECT_NEAR(state.spring.x, 9.999, 1e-12);
    law(state, left, {0.002 / k, 0, 0}, 10, k);
    EXPECT_EQ(left > 0, slip > 6 / k) << slip;
    EXPECT_EQ(left > 0, state.spring.x > 4.01) << slip;
  }
}

// One line from (0, c) to (s, 0), which shrinks as a whole.
TEST(cohesive_friction, tension_takes_from_the_cohesion) {
  const CohesiveFriction law{steel_face};
  for (const double whole : {1.0, 0.5})
    for (const double pulled : {0.0, 1.0, 2.4}) {
      const double limit = 6 * (whole - pulled / 5);
      State held, slid;
      double left = whole, less = whole;
      law(held, left, {0.999 * limit / k, 0, 0}, -pulled, k);
      EXPECT_EQ(left, whole);
      EXPECT_NEAR(held.spring.x, 0.999 * limit, 1e-12);
      law(slid, less, {1.001 * limit / k, 0, 0}, -pulled, k);
      EXPECT_LT(less, whole);
      EXPECT_GT(less, 0.99 * whole);
    }
  State state; // at the end of the line nothing is left in shear, and slip takes the rest
  double left = 1;
  law(state, left, {1e-6, 0, 0}, -5, k);
  EXPECT_NEAR(left, 0.99, 1e-12);
  EXPECT_EQ(norm(state.spring), 0);
  law(state, left, {1.1e-4, 0, 0}, -4.95, k);
  EXPECT_EQ(left, 0);
  EXPECT_EQ(norm(state.spring), 0);
}

// Elastic to 5 N at 25 um, then in a straight line to 0 at 100 um; unloads to the origin.
TEST(cohesive_friction, softens_as_it_is_opened) {
  const CohesiveFriction law{steel_face};
  EXPECT_EQ(law.left_at(24.9e-6, 1, k), 1);
  EXPECT_NEAR(law.stiffness(1, k), k, 1e-9 * k);
  for (const double opening : {26e-6, 50e-6, 99e-6}) {
    const double left = law.left_at(opening, 1, k);
    EXPECT_NEAR(left, (100e-6 - opening) / 75e-6, 1e-12);
    EXPECT_NEAR(law.stiffness(left, k) * opening, 5 * left, 1e-12); // on the line
    EXPECT_EQ(law.left_at(0.99 * opening, left, k), left);
  }
  EXPECT_EQ(law.left_at(100e-6, 0.4, k), 0);
  EXPECT_EQ(law.stiffness(0, k), 0);
  for (const double slip : {0.0, 24e-6}) { // steeper than the spring
    const CohesiveFriction brittle{{0.4, 6, 5, slip}};
    EXPECT_EQ(brittle.left_at(24.9e-6, 1, k), 1);
    EXPECT_EQ(brittle.left_at(25.1e-6, 1, k), 0);
  }
}

// As of the other laws of friction (friction_laws_test.cc): an identity.
TEST(cohesive_friction, work_is_stored_or_lost_to_the_last_digit) {
  const CohesiveFriction law{{0.3, 8, 20, 1e-3}};
  State state;
  double work = 0, lost = 0, left = 1;
  for (int n = 0; n < 100000; ++n) {
    const double t = 1e-3 * n, normal = 10 * (0.8 + std::sin(0.31 * t)), before_left = left;
    const Vector3 stretch = {3e-7 * std::sin(t), 2e-7 * std::cos(1.7 * t), 0}, before = state.spring;
    const auto r = law(state, left, stretch, normal, k);
    work += dot(0.5 * (before + r.force), stretch);
    lost += r.dissipated;
    ASSERT_LE(left, before_left);
    ASSERT_LE(norm(r.force), 0.3 * std::max(0.0, normal) + 8 * left + 1e-12);
  }
  EXPECT_LT(left, 0.5);
  EXPECT_NEAR(work, lost + 0.5 * norm_squared(state.spring) / k, 1e-11 * lost);
}

SurfaceContact bonded(double friction, const SurfaceBond &bond) {
  SurfaceContact contact = frictional(friction, friction);
  contact.bond = bond;
  return contact;
}
// One sphere that touches it, over 2 mm^2.
struct OnAPlate : SphereScene {
  explicit OnAPlate(const SurfaceContact &contact)
      : SphereScene(plate(0.01, 10), {{-0.002, 0.001, sphere_radius}}, contact, false) {
    layer.seat_within(particles, body, 0.1 * sphere_radius);
    if (contact.bond.strength > 0) layer.bond_seats(particles, 2e-6);
  }
};

// A sphere that is pushed along a plate and into it: load over way, to round-off of positions.
TEST(bonded_face, a_pushed_sphere_bears_cohesion_over_its_area_and_friction) {
  const double tau = 3e6, area = 2e-6, slip = 2e-5, k_t = 0.8 * plate_stiffness, c = tau * area, mu = 0.4,
               pressed = 5e-6, n = plate_stiffness * pressed, step = 1e-7;
  OnAPlate scene(bonded(mu, {tau, not_given, slip}));
  scene.particles.velocity[0] = {0, 0, -pressed / 1e-5};
  scene.carry(1e-5);
  for (int m = 1; m <= 500; ++m) {
    scene.particles.velocity[0] = {step / 1e-5, 0, 0};
    scene.carry(1e-5);
    const double u = m * step, d = (k_t * u - mu * n - c) / (k_t - c / slip);
    const double expected = d < 0 ? k_t * u : d < slip ? mu * n + c * (1 - d / slip) : mu * n;
    ASSERT_NEAR(-scene.particles.force[0].x, expected, 1e-8 * c) << m;
    ASSERT_NEAR(scene.load().x, expected, 1e-8 * c) << m;
    ASSERT_NEAR(scene.particles.force[0].z, n, 1e-8 * n) << m;
    ASSERT_EQ(scene.layer.bonded_share(), d < slip ? 1 : 0) << m;
  }
  EXPECT_EQ(scene.layer.bonded_share(), 0);
  EXPECT_NEAR(scene.layer.friction_work, 0.5 * c * slip + mu * n * (500 * step - mu * n / k_t), c * step);
}

class PulledSphere : public testing::TestWithParam<SurfaceBond> {}; // of a tension of 1 MPa

TEST_P(PulledSphere, is_held_until_it_comes_off_and_only_pressed_then) {
  const double s = 1e6 * 2e-6, elastic = s / plate_stiffness, s_0 = GetParam().slip, step = 1e-8; // N, m
  OnAPlate scene(bonded(0, GetParam()));
  double height = 0, before = 0, work = 0;
  const auto lift = [&](double by) {
    scene.particles.velocity[0] = {0, 0, by / 1e-5};
    scene.carry(1e-5);
    height += by;
    work -= 0.5 * (before + scene.particles.force[0].z) * by;
    before = scene.particles.force[0].z;
  };
  const auto held = [&](double g) { // N, on the way up
    return g < elastic ? plate_stiffness * g : std::max(0.0, s_0 > 0 ? s * (s_0 - g) / (s_0 - elastic) : 0);
  };
  lift(0.3 * step); // corners of the law lie between steps
  for (int n = 0; n < 1100; ++n) {
    lift(step);
    ASSERT_NEAR(-scene.particles.force[0].z, held(height), 1e-8 * s) << height;
    ASSERT_NEAR(scene.layer.elastic_energy(), 0.5 * held(height) * height, 1e-8 * s * elastic);
    ASSERT_EQ(scene.layer.bonded_share(), held(height) > 0);
    if (s_0 == 0 || n != 600) continue;
    const double top = height; // down and up again, towards the origin
    for (const double way : {-3e-6, 3e-6}) {
      lift(way);
      ASSERT_NEAR(-scene.particles.force[0].z, held(top) * height / top, 1e-8 * s);
    }
  }
  EXPECT_EQ(scene.layer.elastic_energy(), 0);
  EXPECT_TRUE(scene.layer.contacts().empty());
  EXPECT_NEAR(scene.layer.friction_work, work, 1e-9 * work); // all that the pull has given
  EXPECT_NEAR(work, 0.5 * s * (s_0 > 0 ? s_0 : elastic), 0.01 * work);
  lift(-height - 5e-6);
  EXPECT_NEAR(scene.particles.force[0].z, plate_stiffness * 5e-6, 1e-8 * s);
  lift(5.1e-6);
  EXPECT_EQ(scene.particles.force[0].z, 0);
  lift(-5e-6), scene.particles.velocity[0] = {1, 0, 0}, scene.carry(1e-5); // and no cohesion
  EXPECT_EQ(scene.particles.force[0].x, 0);
}
INSTANTIATE_TEST_SUITE_P(bonded_face, PulledSphere,
                         testing::Values(SurfaceBond{3e6, 1e6, 1e-5}, SurfaceBond{1e6, not_given, 1e-5},
                                         SurfaceBond{1e6, 1e6, 0}));

// Spring and dashpot together; as of any contact that opens fast the dashpot cancels the rest.
TEST(bonded_face, a_dashpot_pulls_no_harder_than_the_bond) {
  SurfaceContact contact = bonded(0, {1e6, 1e4, 1e-5});
  contact.damping = 0.5;
  OnAPlate scene(contact);
  const double dt = 1e-7, c = 2 * 0.5 * std::sqrt(plate_stiffness * scene.particles.mass[0]); // s, N s/m
  const auto move = [&](double by) {
    scene.particles.velocity[0] = {0, 0, by / dt};
    scene.carry(dt);
  };
  move(-1e-6);
  const double before = c * 1e-6 / dt, lost = scene.layer.damping_work;
  EXPECT_NEAR(lost, 0.5 * before * 1e-6, 1e-8 * lost);
  EXPECT_NEAR(scene.particles.force[0].z, 1 + before, 1e-8 * before);
  move(1e-7); // 3 N of the dashpot, .9 N of the spring
  EXPECT_NEAR(scene.particles.force[0].z, -0.02, 1e-9);
  EXPECT_NEAR(scene.layer.damping_work - lost, -0.5 * (before - 0.92) * 1e-7, 1e-8 * lost);
  EXPECT_EQ(scene.layer.bonded_share(), 1);
  EXPECT_EQ(scene.layer.friction_work, 0);
}

TEST(bonded_face, a_bond_that_slides_off_while_it_is_pulled_leaves_no_dashpot) {
  SurfaceContact contact = bonded(0.4, {3e6, 1e6, 1e-5});
  contact.damping = 0.1;
  OnAPlate scene(contact);
  const double dt = 1e-5, c = 2 * 0.1 * std::sqrt(plate_stiffness * scene.particles.mass[0]); // s, N s/m
  const auto move = [&](const Vector3 &by) {
    scene.particles.velocity[0] = (1 / dt) * by;
    scene.carry(dt);
    return scene.particles.force[0];
  };
  const double step = 1e-7, dashpot = c * step / dt; // m, N
  EXPECT_NEAR(move({0, 0, step}).z, -plate_stiffness * step - dashpot, 1e-9);
  const double lost = scene.layer.damping_work;
  EXPECT_EQ(norm(move({1e-4, 0, step})), 0);
  EXPECT_EQ(scene.layer.bonded_share(), 0);
  EXPECT_NEAR(scene.layer.damping_work - lost, 0.5 * dashpot * step, 1e-9 * lost);
  const double after = scene.layer.damping_work;
  EXPECT_EQ(norm(move({0, 0, step})), 0);
  EXPECT_EQ(scene.layer.damping_work, after);
}

TEST(bonded_face, spheres_share_its_area_by_their_radius_squared) {
  dem::Specimen two = spheres({{-0.004, 0, 1e-3}, {0.004, 0, 2e-3}, {0, 0.004, 1.5e-3}});
  two.radius = {1e-3, 2e-3, 1e-3}; // the third does not touch
  dem::Particles particles(two, 2500, false);
  fem::RigidBody body = plate(0.01, 10);
  ContactLayer layer(particles, body, bonded(0, {1e6, not_given, 1e3}));
  ASSERT_EQ(layer.seat_within(particles, body, 1e-5), 2);
  layer.bond_seats(particles, 5e-6);
  EXPECT_EQ(layer.bonded_share(), 1);
  for (std::size_t i = 0; i < 3; ++i)
    particles.position[i].x += 1e-4, particles.velocity[i].x = 10, particles.force[i] = {};
  layer.moved(1e-4);
  layer.add_forces(particles, body, 1e-5);
  for (std::size_t i = 0; i < 3; ++i) { // in an order of their own
    const double r = particles.radius[i];
    EXPECT_NEAR(particles.force[i].x, particles.position[i].y > 0 ? 0 : -1e6 * r * r, 1e-6) << i;
  }
}

// A sphere on its bond is struck askew: it swings, slides and comes off.
TEST(bonded_face, energy_is_stored_or_lost_to_a_thousandth) {
  for (const Vector3 &blow : {Vector3{4, 0, 0.5}, {0.3, 0.2, 4}, {4, 1, -1}}) {
    OnAPlate scene(bonded(0.4, {3e6, 2e6, 1e-5}));
    scene.particles.velocity[0] = blow;
    const double before = scene.kinetic_energy();
    int whole = 0;
    for (int n = 0; n < 20000; ++n) {
      scene.step(5e-9);
      whole += scene.layer.bonded_share() > 0;
      ASSERT_NEAR(scene.kinetic_energy() + scene.layer.elastic_energy() + scene.layer.friction_work, before,
                  1e-3 * before)
          << n;
    }
    EXPECT_GT(whole, 100);
    EXPECT_LT(whole, 20000);
    EXPECT_GT(scene.layer.friction_work, 1e-3 * before);
  }
}

TEST(bonded_face, a_stop_in_the_middle_changes_no_byte) {
  const auto contact = bonded(0.4, {3e6, not_given, 1e-4});
  OnAPlate whole(contact), stopped(contact), resumed(contact), without(frictional(0.4, 0.4));
  const auto push = [](SphereScene &scene, int steps) {
    for (int n = 0; n < steps; ++n)
      scene.particles.velocity[0] = {0.1, 0.02, -0.01}, scene.carry(1e-6);
  };
  push(whole, 300), push(stopped, 150);
  EXPECT_GT(stopped.layer.contacts()[0].slip, 0);
  set_state(resumed, state_of(stopped));
  push(resumed, 150);
  EXPECT_TRUE(same_state(whole, resumed));
  EXPECT_TRUE(state_of(whole).find("state/contacts/rows/bond").has_value());
  EXPECT_FALSE(state_of(without).find("state/contacts/rows/bond").has_value());
}

// A core that is moved along a tube that stays: bond strength x perimeter x length, and friction beside it.
TEST(bonded_face, a_core_that_is_pushed_out_bears_the_strength_on_its_whole_face) {
  const dem::Shape &shape = coarse_cylinder().shape;
  const double area = 2 * pi * shape.radius * shape.height;
  SleeveSettings tube;
  tube.young_modulus = 210e9, tube.poisson_ratio = 0.3, tube.elements_around = 16, tube.seat_depth = 0.5e-3;
  tube.contact.particle_stiffness = 1e6, tube.contact.skin = 3e-4;
  struct Pushed {
    double largest = 0, now = 0;
  };
  const auto pushed = [&](double friction, const SurfaceBond &bond, double pressed) {
    tube.contact.friction_static = friction, tube.contact.bond = bond;
    dem::Model model(coarse_cylinder(), elastic_settings(0.5).model);
    Sleeve sleeve(model.particles, shape, 0, shape.height, tube);
    for (double &r : model.particles.radius)
      r += pressed;
    Pushed core; // N
    for (int n = 0; n < 100; ++n) {
      sleeve.solid().clear_loads();
      for (std::size_t i = 0; i < model.particles.size(); ++i)
        model.particles.position[i].z += 2e-7, model.particles.velocity[i] = {0, 0, 0.02};
      sleeve.layer().moved(2e-7);
      sleeve.layer().add_forces(model.particles, sleeve.solid(), 1e-5);
      core.now = sleeve.solid().total_force()[2];
      core.largest = std::max(core.largest, core.now);
    }
    return core;
  };
  const double tau = 0.55e6, rubs = pushed(0.4, {}, 1e-6).largest;
  EXPECT_GT(rubs, 0.4 * 30 * 1e6 * 1e-6); // N, of thirty spheres and more
  EXPECT_NEAR(pushed(0, {tau, not_given, 1}, 0).largest / (tau * area), 1, 0.015); // a polygon's
  EXPECT_NEAR(pushed(0, {2 * tau, not_given, 1}, 0).largest / (2 * tau * area), 1, 0.015);
  EXPECT_NEAR((pushed(0.4, {tau, not_given, 1}, 1e-6).largest - rubs) / (tau * area), 1, 0.015);
  const Pushed loose = pushed(0.4, {tau, not_given, 1e-5}, 1e-6); // its spheres slide 8 um and more
  EXPECT_GT(loose.largest, 1.1 * rubs);
  EXPECT_NEAR(loose.now / rubs, 1, 1e-6);
}

} // namespace
} // namespace platen::coupling::bonded_face_test
