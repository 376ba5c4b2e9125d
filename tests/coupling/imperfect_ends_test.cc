// Ends that are not flat, a platen that is not square to the axis, a load beside the axis.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "coupling/platen_test.h"
#include "tests/coupling/set_ups.h"

namespace platen::coupling::imperfect_ends_test {
namespace {

constexpr double slope = 0.01;

// Friction keeps the specimen from sliding out between planes that are not parallel.
PlatenTestSettings held() {
  PlatenTestSettings s = elastic_settings(0.5);
  s.platens.top = s.platens.bottom = {0.5, 0.5};
  s.platens.damping = 0.1;
  s.loading.rate = 0.1;
  static const double dt = 0.5 * PlatenTest(packed_cylinder(), s).time_step();
  s.time_step.fixed_step = dt; // the same for mirrored specimens
  return s;
}

dem::Specimen mirrored(dem::Specimen specimen) {
  for (Vector3 &c : specimen.centre)
    c.x = -c.x;
  return specimen;
}

struct Load {
  double force = 0;   // N, on a platen
  double middle = 0;  // m, x of its resultant
  double along_y = 0; // m
  double push_y = 0;  // N
};

// The mean over so many steps from a closure on.
Load load_at(PlatenTest &problem, double strain, int steps = 1000, bool top = true) {
  while (problem.closure_strain() < strain)
    advance_to(problem, problem.steps() + 50);
  Vector3 moment{};
  Load load;
  for (int k = 0; k < steps; ++k) {
    advance_to(problem, problem.steps() + 1);
    const fem::Body &body = top ? problem.top().body() : problem.bottom().body();
    moment += body.moment({0, 0, top ? problem.shape().height : 0});
    load.force += body.total_force().z;
    load.push_y += body.total_force().y;
  }
  load.middle = -moment.y / load.force;
  load.along_y = moment.x / load.force;
  load.force /= steps, load.push_y /= steps;
  return load;
}

Load of(const PlatenTestSettings &settings, double strain, const dem::Specimen &specimen = packed_cylinder(),
        bool top = true) {
  PlatenTest problem(specimen, settings);
  const Load load = load_at(problem, strain, 1000, top);
  EXPECT_LT(residual(problem), 1e-3);
  return load;
}

// Between flat faces the load begins with the closure; a face below its plane is met later by as much.
TEST(imperfect_ends, are_met_when_the_platen_has_come_so_far) {
  PlatenTestSettings s = held();
  s.ends = Ends::concave, s.end_height = 0.2e-3; // the rim, where the spheres lie, hardly lies deeper
  s.end_faces = FacedEnds::both;
  PlatenTest concave(packed_cylinder(), s);
  s.ends = Ends::not_parallel;
  PlatenTest inclined(packed_cylinder(), s);
  s.ends = Ends::ground;
  PlatenTest flat(packed_cylinder(), s);
  const auto touching = [](const PlatenTest &problem) { return problem.top().closed(); };
  for (PlatenTest *problem : {&flat, &inclined, &concave})
    while (problem->closure_strain() * problem->shape().height < 0.1e-3)
      advance_to(*problem, problem->steps() + 10);
  EXPECT_GT(touching(flat), 3u);
  EXPECT_LT(touching(inclined), touching(flat));
  EXPECT_GT(touching(inclined), 0u);
  EXPECT_LT(touching(concave), touching(flat));
}

// Either face is as deep as the other's slope: the tilted platen has other normals alone.
TEST(imperfect_ends, a_tilted_platen_presses_as_an_inclined_end) {
  PlatenTestSettings tilted = held(), inclined = held();
  tilted.platens.tilt = std::asin(slope);
  inclined.ends = Ends::not_parallel;
  inclined.end_height = 2 * slope * packed_cylinder().shape.radius;
  const Load one = of(tilted, 0.01), other = of(inclined, 0.01), flat = of(held(), 0.01);
  EXPECT_NEAR(one.force / other.force, 1, 0.02);
  EXPECT_NEAR(one.middle, other.middle, 0.02 * packed_cylinder().shape.radius);
  // The side that comes first bears more.
  EXPECT_LT(one.middle - flat.middle, -0.1 * packed_cylinder().shape.radius);
  EXPECT_LT(one.force, 0.95 * flat.force);
}

// The bottom end: its platen bears more on the same side.
TEST(imperfect_ends, an_end_that_faces_down_is_as_inclined) {
  PlatenTestSettings s = held();
  s.ends = Ends::not_parallel;
  s.end_height = 2 * slope * packed_cylinder().shape.radius;
  s.end_faces = FacedEnds::bottom;
  const Load below = of(s, 0.01, packed_cylinder(), false), flat = of(held(), 0.01, packed_cylinder(), false);
  EXPECT_LT(below.middle - flat.middle, -0.1 * packed_cylinder().shape.radius);
  EXPECT_LT(std::abs(below.force), 0.95 * std::abs(flat.force));
  PlatenTestSettings both = s;
  both.end_faces = FacedEnds::both;
  EXPECT_LT(std::abs(of(both, 0.01, packed_cylinder(), false).force), 0.95 * std::abs(below.force));
}

TEST(imperfect_ends, the_load_acts_on_an_eccentric_seat) {
  const double radius = packed_cylinder().shape.radius;
  double at_rest = 0; // of a seat on the axis
  for (const double e : {0.0, -0.2 * radius, 0.1 * radius}) {
    PlatenTestSettings s = held();
    s.platens.spherical_seat = true;
    s.platens.eccentricity = e;
    PlatenTest problem(packed_cylinder(), s);
    const Load load = load_at(problem, 0.01, 3000);
    EXPECT_NEAR(load.middle, e, 0.05 * radius) << e;
    EXPECT_LT(residual(problem), 1e-3) << e;
    const double turned = problem.top().body().rotation().y; // the pressed side sinks
    if (e == 0) at_rest = turned;
    if (e == 0) continue;
    EXPECT_GT((turned - at_rest) * e, 0) << e;
  }
}

TEST(imperfect_ends, mirrored_tests_give_mirrored_results) {
  PlatenTestSettings s = held(), m = held();
  s.platens.tilt = slope, m.platens.tilt = -slope;
  const Load tilted = of(s, 0.01), other = of(m, 0.01, mirrored(packed_cylinder()));
  EXPECT_NEAR(tilted.force, other.force, 1e-6 * tilted.force);
  EXPECT_NEAR(tilted.middle, -other.middle, 1e-6 * packed_cylinder().shape.radius);

  s = m = held();
  s.platens.spherical_seat = m.platens.spherical_seat = true;
  s.platens.eccentricity = 1e-3, m.platens.eccentricity = -1e-3;
  const Load beside = of(s, 0.005), beyond = of(m, 0.005, mirrored(packed_cylinder()));
  EXPECT_NEAR(beside.force, beyond.force, 1e-6 * beside.force);
  EXPECT_NEAR(beside.middle, -beyond.middle, 1e-6 * packed_cylinder().shape.radius);
}

// A disc is met at one end of its axis first, under a strip and under a whole platen.
TEST(imperfect_ends, a_tilted_platen_splits_a_disc_from_one_end_of_its_axis) {
  for (const double strip : {0.0, 1.5e-3}) {
    PlatenTestSettings flat = split(strip);
    flat.time_step.fixed_step = 0.5 * PlatenTest(disc(), flat).time_step(); // the same for a mirrored disc
    PlatenTestSettings tilted = flat, turned = flat;
    tilted.platens.tilt = slope, turned.platens.tilt = -slope;
    dem::Specimen other = disc();
    for (Vector3 &c : other.centre)
      c.y = -c.y;
    const double strain = 4e-3;
    const Load level = of(flat, strain, disc()), one = of(tilted, strain, disc()),
               two = of(turned, strain, other);
    EXPECT_NEAR(one.force, two.force, 1e-6 * one.force) << strip;
    EXPECT_NEAR(one.along_y, -two.along_y, 1e-6 * disc().shape.width_y) << strip;
    EXPECT_NEAR(one.middle, two.middle, 1e-6 * disc().shape.width_y) << strip;
    EXPECT_LT(one.along_y - level.along_y, -0.1 * disc().shape.width_y) << strip;
    EXPECT_NEAR(one.push_y / one.force, -std::tan(slope), 1e-6) << strip; // without friction along the normal
    EXPECT_LT(one.force, 0.95 * level.force) << strip;
    EXPECT_GT(one.force, 0.2 * level.force) << strip; // the middle is as high as half of the rise
  }
}

} // namespace
} // namespace platen::coupling::imperfect_ends_test
