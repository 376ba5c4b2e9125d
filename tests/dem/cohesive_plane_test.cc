// How a displacement in the plane of an interface goes along with it.
#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"
#include "dem/laws/cohesive_form.h"
#include "dem/laws/rotating_plane.h"

namespace platen::dem {
namespace {

Triple<double> triple(const Vector3 &v) {
  return {v.x, v.y, v.z};
}
Vector3 vector(const Triple<double> &t) {
  return {t.x, t.y, t.z};
}

// A pair that turns by up to 150 degrees and grows or shrinks by up to a third in one step.
struct Turn {
  Vector3 before, after, normal_before, normal, in_plane;
};
Turn turn(Random &random) {
  const auto any = [&] {
    return Vector3{random.uniform() - 0.5, random.uniform() - 0.5, random.uniform() - 0.5};
  };
  Turn t;
  do {
    const Vector3 a = any(), b = any();
    t.normal_before = a / norm(a), t.normal = b / norm(b);
  } while (dot(t.normal_before, t.normal) < std::cos(150.0 / 180 * 3.14159265358979));
  t.before = 3e-3 * t.normal_before;
  t.after = 3e-3 * (1 + (random.uniform() - 0.5) / 1.5) * t.normal;
  const Vector3 v = any();
  t.in_plane = 1e-6 * (v - dot(v, t.normal_before) * t.normal_before);
  return t;
}

TEST(cohesive_plane, a_displacement_turns_by_the_least_rotation_whatever_the_angle) {
  Random random(11);
  for (int n = 0; n < 1000; ++n) {
    const Turn t = turn(random);
    CohesiveMotion<double> m{};
    m.distance = triple(t.after), m.travelled = triple(t.after - t.before);
    const PlaneMotion<double> plane(m, norm(t.after));
    const Vector3 carried = vector(plane.carried(triple(t.in_plane)));
    const Vector3 expected = carry_with_plane(t.in_plane, t.normal_before, t.normal);
    EXPECT_LT(norm(carried - expected), 1e-13 * norm(t.in_plane)) << "turn " << n;
    EXPECT_LT(norm(vector(plane.n) - t.normal), 1e-14) << "turn " << n;
  }
}

TEST(cohesive_plane, a_spin_keeps_the_length_and_turns_by_its_angle) {
  Random random(12);
  for (int n = 0; n < 1000; ++n) {
    const Turn t = turn(random);
    CohesiveMotion<double> m{};
    m.distance = triple(t.after), m.travelled = triple(t.after - t.before);
    const double spin = 2 * (random.uniform() - 0.5); // rad
    m.spun_along = spin * norm(t.after);
    const PlaneMotion<double> plane(m, norm(t.after));
    const Vector3 carried = vector(plane.carried(triple(t.in_plane)));
    const double angle = 2 * std::atan(0.5 * spin); // Cayley
    const Vector3 turned = carry_with_plane(t.in_plane, t.normal_before, t.normal);
    const Vector3 expected = std::cos(angle) * turned + std::sin(angle) * cross(t.normal, turned);
    EXPECT_LT(norm(carried - expected), 1e-13 * norm(t.in_plane)) << "turn " << n;
  }
}

TEST(cohesive_plane, what_the_step_adds_lies_in_the_plane_of_now) {
  Random random(13);
  for (int n = 0; n < 1000; ++n) {
    const Turn t = turn(random);
    CohesiveMotion<double> m{};
    m.distance = triple(t.after), m.travelled = triple(t.after - t.before), m.moved = m.travelled;
    const Vector3 added = vector(PlaneMotion<double>(m, norm(t.after)).carried(triple(Vector3{})));
    const Vector3 travelled = t.after - t.before;
    EXPECT_LT(norm(added - (travelled - dot(travelled, t.normal) * t.normal)), 1e-14 * 3e-3) << "turn " << n;
  }
}

} // namespace
} // namespace platen::dem
