// A top platen on a spherical seat: rigid or elastic, bare, under a servo and in a cell, with the rim of a
// sleeve that goes with it.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "coupling/platen_test.h"
#include "fem/rigid_body.h"
#include "tests/coupling/set_ups.h"

namespace platen::coupling::spherical_seat_test {
namespace {

PlatenTestSettings seated(bool elastic) {
  PlatenTestSettings s = with(elastic_settings(0.5), elastic ? followed_on_seat : on_seat);
  s.platens.damping = 0.1;
  s.platens.top = s.platens.bottom = PlatenSide{};
  s.platens.thickness = 4e-3;
  s.platens.material.young_modulus = steel_modulus;
  return s;
}

Vector3 middle_of_face(const PlatenTest &problem) {
  return Vector3{0, 0, problem.shape().height} + problem.top().body().displacement();
}

// rad, of the top platen about x and y.
Vector3 tilt(const PlatenTest &problem) {
  const Quaternion &turn = problem.top().body().rotation();
  return {2 * turn.x, 2 * turn.y, 0};
}

// m, from the middle of the face to the load on it, on the mean over so many steps.
double arm_of_load(PlatenTest &problem, int steps) {
  Vector3 moment{};
  double force = 0;
  for (int k = 0; k < steps; ++k) {
    advance_to(problem, problem.steps() + 1);
    moment = moment + problem.top().body().moment(middle_of_face(problem));
    force += problem.top().body().total_force().z;
  }
  return norm(Vector3{moment.x, moment.y, 0}) / force;
}

// A cylinder whose upper end was cut askew: what stands above a slope of 1 % is shortened to it. A platen
// that may not turn presses the high side first; one on a seat lays itself on the cut.
TEST(spherical_seat, an_oblique_end_is_pressed_evenly) {
  dem::Specimen oblique = cylinder();
  const double slope = 0.01, height = oblique.shape.height;
  for (Vector3 &c : oblique.centre)
    c.z += slope * c.x * c.z / height;
  double arm[2];
  for (const bool seat : {false, true}) {
    PlatenTestSettings settings = seated(false);
    settings.platens.spherical_seat = seat;
    settings.ends = Ends::as_packed;
    settings.loading.rate = 0.1;
    PlatenTest problem(oblique, settings);
    while (problem.closure_strain() < 0.01)
      advance_to(problem, problem.steps() + 50);
    arm[seat] = arm_of_load(problem, 3000);
    EXPECT_GE(-tilt(problem).y, seat ? 0.5 * slope : 0) << seat;
    EXPECT_LE(-tilt(problem).y, seat ? 3 * slope : 0) << seat; // its few spheres press in unlike
    EXPECT_LT(residual(problem), 1e-3) << seat;
  }
  EXPECT_GT(arm[0], 0.1 * oblique.shape.radius);
  EXPECT_LT(arm[1], 0.2 * arm[0]);
}

// The ball of the seat sticks: the same cut turns the platen only while the load lies farther from the seat
// than friction bears; an arm as long as the specimen is wide leaves it fixed.
TEST(spherical_seat, friction_leaves_the_load_as_far_from_the_seat_as_its_arm) {
  dem::Specimen oblique = cylinder();
  const double radius = oblique.shape.radius;
  for (Vector3 &c : oblique.centre)
    c.z += 0.01 * c.x * c.z / oblique.shape.height;
  double stress[2];
  for (const double share : {0.05, 2.0}) {
    PlatenTestSettings settings = seated(false);
    settings.platens.spherical_seat = true;
    settings.platens.seat_friction_arm = share * radius;
    settings.ends = Ends::as_packed;
    settings.loading.rate = 0.1;
    PlatenTest problem(oblique, settings);
    while (problem.closure_strain() < 0.01)
      advance_to(problem, problem.steps() + 50);
    stress[share > 1] = problem.stress_top();
    const double arm = arm_of_load(problem, 3000);
    EXPECT_LT(residual(problem), 1e-3) << share;
    const Vector3 turned = 2 * vector_part(problem.top().body().rotation());
    EXPECT_EQ(norm(turned) < 1e-20, share > 1); // stuck, to the round-off of its first touch
    if (share < 1) {
      EXPECT_LT(arm, 1.5 * share * radius);
      EXPECT_GT(arm, 0.5 * share * radius);
    }
  }
  PlatenTestSettings fixed = seated(false);
  fixed.platens.spherical_seat = false;
  fixed.ends = Ends::as_packed;
  fixed.loading.rate = 0.1;
  PlatenTest problem(oblique, fixed);
  while (problem.closure_strain() < 0.01)
    advance_to(problem, problem.steps() + 50);
  EXPECT_NEAR(stress[1] / problem.stress_top(), 1, 0.01); // at steps of other lengths
  EXPECT_LT(stress[0], stress[1]); // the one that turns goes out of the way of the high side
}

// Few spheres bear, never evenly: an elastic platen that may not turn takes a moment from them, one on a seat
// turns away until little is left.
TEST(spherical_seat, takes_no_moment_of_elastic_platens) {
  for (const auto &[fixed, free] : {std::pair{yielding, yielding_on_seat}, {followed, followed_on_seat}}) {
    double arm[2];
    for (const PlatenKind &kind : {fixed, free}) {
      PlatenTestSettings settings = with(seated(false), kind);
      settings.platens.top = settings.platens.bottom = {0.3, 0.2};
      PlatenTest problem(cylinder(), settings);
      advance_to(problem, 2000);
      arm[kind.seat] = arm_of_load(problem, 1000);
      EXPECT_LT(residual(problem), 2e-3) << kind.name;
      EXPECT_GT(clamp_closure(problem), 0) << kind.name;
      EXPECT_EQ(problem.elastic_top()->solid().rotation().w == 1, !kind.seat) << kind.name;
    }
    EXPECT_LT(arm[1], 0.1 * arm[0]) << free.name << " " << arm[0] << " " << arm[1];
  }
}

// A thousand times as stiff as steel and without inertia of deformation, an elastic platen on its seat turns
// as a rigid one, with the same inertia about it.
TEST(spherical_seat, a_stiff_elastic_platen_turns_as_a_rigid_one) {
  PlatenTestSettings settings[2] = {seated(false), seated(true)};
  settings[1].platens.material.young_modulus = 1000 * steel_modulus;
  const double dt = 0.5 * PlatenTest(cylinder(), settings[0]).time_step();
  double stress[2];
  Vector3 turned[2];
  for (const int elastic : {0, 1}) {
    settings[elastic].model.local_damping = 0; // which goes by the signs of velocities
    settings[elastic].time_step.fixed_step = dt;
    settings[elastic].platens.elements_across = 12; // lumped masses turn as the volume does
    PlatenTest problem(cylinder(), settings[elastic]);
    advance_to(problem, 3000);
    stress[elastic] = problem.stress_top();
    turned[elastic] = tilt(problem);
    EXPECT_LT(residual(problem), 1e-3) << elastic;
  }
  ASSERT_GT(stress[0], 1e5);
  ASSERT_GT(norm(turned[0]), 1e-6);
  EXPECT_NEAR(stress[1] / stress[0], 1, 0.01);
  EXPECT_LT(norm(turned[1] - turned[0]), 0.03 * norm(turned[0]));
}

// A light platen sets the time step by its turning; the reason says so, and the run stays stable below it.
TEST(spherical_seat, a_light_platen_sets_the_time_step) {
  PlatenTestSettings settings = seated(false);
  const double heavy = PlatenTest(cylinder(), settings).time_step();
  settings.platens.material.density = 20;
  settings.platens.thickness = 5e-4;
  PlatenTest problem(cylinder(), settings);
  EXPECT_LT(problem.time_step(), 0.5 * heavy);
  EXPECT_NE(problem.time_step_reason().find("turns on its seat"), std::string::npos)
      << problem.time_step_reason();
  advance_to(problem, 4000);
  EXPECT_LT(residual(problem), 2e-3);
  settings.time_step.fixed_step = 1.5 * problem.time_step(); // the limit is 1.25 times the step
  EXPECT_THROW(PlatenTest(cylinder(), settings), BadSetup);
}

PlatenTestSettings in_sleeve(bool elastic, bool bonded) {
  PlatenTestSettings s = seated(false);
  if (elastic) s = with(s, yielding_on_seat);
  make_brittle(s);
  for (PlatenSide *side : {&s.platens.top, &s.platens.bottom})
    side->friction_static = side->friction_dynamic = 0.3;
  s.seat = true;
  s.loading.rate = 0.3, s.loading.ramp = 5e-6;
  press(s, 1e6, 5e-5);
  wrap(s, 1e-3, 0.49).bonded_rims = bonded;
  return s;
}

// Whatever turns, the rim lies on the face: bonded at the places of the rigid motion, sliding in its plane.
TEST(spherical_seat, the_rim_of_a_sleeve_goes_with_the_platen) {
  for (const bool elastic : {false, true})
    for (const bool bonded : {false, true}) {
      PlatenTest problem(cylinder(), in_sleeve(elastic, bonded));
      while (norm(tilt(problem)) < 1e-4 && problem.steps() < 20000)
        advance_to(problem, problem.steps() + 100);
      ASSERT_GT(norm(tilt(problem)), 1e-4);
      const fem::HyperelasticSolid &solid = problem.sleeve()->solid();
      const Vector3 middle = {0, 0, problem.end_planes().high};
      const fem::Body &platen = problem.top().body();
      const Vector3 normal = rotate(platen.rotation(), {0, 0, 1});
      // Within what the platen goes in an interval of the sleeve.
      const double way = problem.sleeve()->steps_of_interval() * problem.time_step() *
                         (norm(platen.velocity()) + 8e-3 * norm(platen.angular_velocity()));
      const std::vector<int> rim = solid.nodes_of(fem::high_end_tag);
      ASSERT_LT(2 * way, 0.2 * 6e-3 * norm(tilt(problem)));
      for (const int node : rim) {
        const Vector3 start = solid.mesh().nodes[static_cast<std::size_t>(node)];
        const Vector3 on_face = middle + rotate(platen.rotation(), start - Vector3{0, 0, 14e-3});
        const Vector3 place = solid.node_place(node);
        EXPECT_LT(bonded ? norm(place - on_face) : std::abs(dot(normal, place - middle)), 2 * way)
            << elastic << bonded;
      }
    }
}

} // namespace
} // namespace platen::coupling::spherical_seat_test
