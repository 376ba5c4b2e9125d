// Closest points on single faces that deform, turn or only shift. Of whole surfaces and in SIMD vectors:
// surface_search_test.cc.
#include "coupling/contact/faces.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "coupling/contact/surface_search.h"

namespace platen::coupling::faces_test {
namespace {

// A square of side one, its corners moved by up to `by` in all directions, somewhere in space.
Quad strained_square(double by, std::mt19937 &engine) {
  std::uniform_real_distribution<double> draw(-1, 1);
  const Vector3 turn = {draw(engine), draw(engine), draw(engine)}, place = {draw(engine), draw(engine), 7};
  const Quaternion q = rotation_quaternion(3 * turn);
  Quad corners = {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}};
  for (Vector3 &c : corners)
    c = place + rotate(q, c + by * Vector3{draw(engine), draw(engine), draw(engine)});
  return corners;
}

Vector3 point_of(const Quad &q, double u, double v, double off) {
  const std::array<double, 4> w = bilinear_weights(u, v);
  return w[0] * q[0] + w[1] * q[1] + w[2] * q[2] + w[3] * q[3] + off * bilinear_normal(q, 0.5, 0.5);
}

Quad about(const Quad &q, const Vector3 &centre) {
  return {q[0] - centre, q[1] - centre, q[2] - centre, q[3] - centre};
}

// Centres within a fifth of the face on both sides of it, over it and beyond its rim.
TEST(moving_faces, the_point_found_is_the_closest_of_a_warped_face) {
  std::mt19937 engine(3);
  std::uniform_real_distribution<double> along(-0.3, 1.3), off(-0.2, 0.2);
  int found[2] = {}, inside[2] = {}; // on faces warped a little and much
  for (int trial = 0; trial < 20000; ++trial) {
    const int much = trial % 2;
    const Quad q = strained_square(much ? 0.15 : 0.02, engine);
    const MovingFace face = moving_face(q);
    const Vector3 centre = point_of(q, along(engine), along(engine), off(engine));
    const ClosestPoint best = closest_point(about(q, centre));
    EXPECT_LE(least_distance_squared(face, centre), best.distance_squared * (1 + 1e-12));
    if (best.feature == Feature::face) ++inside[much];
    FacePoint closest;
    if (!find_closest(face, centre, closest)) continue;
    ++found[much];
    ASSERT_EQ(best.feature, Feature::face);
    ASSERT_NEAR(norm(closest.out), std::sqrt(best.distance_squared), 4e-15);
    ASSERT_NEAR(closest.u, best.u, 1e-11);
    ASSERT_NEAR(closest.v, best.v, 1e-11);
    ASSERT_LT(norm(cross(closest.out, closest.normal)), 1e-11);
    ASSERT_NEAR(norm(closest.normal), 1, 1e-15);
  }
  EXPECT_GT(inside[0], 3000);
  EXPECT_EQ(found[0], inside[0]);
  EXPECT_GT(found[1], 0.85 * inside[1]); // the rest goes the general way
}

// Far off a face that is much warped there are several closest points: none is given there but the nearest.
TEST(moving_faces, a_closest_point_far_off_is_given_where_it_is_the_only_one) {
  std::mt19937 engine(13);
  std::uniform_real_distribution<double> along(-0.3, 1.3), off(-3, 3);
  int given = 0, refused = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    const Quad q = strained_square(0.4, engine);
    const MovingFace face = moving_face(q);
    const Vector3 centre = point_of(q, along(engine), along(engine), off(engine));
    const ClosestPoint best = closest_point(about(q, centre));
    FacePoint closest;
    const bool found = find_closest(face, centre, closest);
    const double above = std::abs(dot(centre - face.corner, face.normal));
    if (above > single_closest_within(q, face.normal) - 2 * face.half.z) {
      ++refused;
      ASSERT_FALSE(found) << "trial " << trial;
    }
    if (!found) continue;
    ++given;
    ASSERT_EQ(best.feature, Feature::face) << "trial " << trial;
    ASSERT_NEAR(norm(closest.out), std::sqrt(best.distance_squared), 1e-13) << "trial " << trial;
  }
  EXPECT_GT(given, 300);
  EXPECT_GT(refused, 3000);
}

// z = w x y on a unit square about the origin, seen from height h over its middle: along a diagonal the
// square of the distance is s^2 + (w s^2 / 2 - h)^2, with two closest points from h = 1 / w on. The bound by
// the formula at face_of_corners.h, whose edges are 1 + w^2 / 4 and whose determinant is 1.
TEST(moving_faces, a_saddle_has_a_single_closest_point_up_to_a_known_height) {
  for (const double w : {0.01, 0.1, 0.3, 0.8}) {
    const double z = w / 4, inverse = std::sqrt(2 * (1 + w * w / 4));
    const Quad q = {{{-0.5, -0.5, z}, {0.5, -0.5, -z}, {0.5, 0.5, z}, {-0.5, 0.5, -z}}};
    const double expected = 0.5 / (w * (1 + w * inverse) * inverse * inverse);
    const double within = single_closest_within(q, {0, 0, 1});
    EXPECT_NEAR(within / expected, 1, 1e-12) << "w " << w;
    EXPECT_LT(within, 1 / w) << "two closest, w " << w;
    const MovingFace face = moving_face(q);
    EXPECT_NEAR(face.half.z, z, 1e-11) << "w " << w;
    EXPECT_NEAR((face.single_closest + w / 2) / expected, 1, 1e-9) << "w " << w;
  }
}

TEST(moving_faces, faces_without_area_have_a_box_and_no_closest_point) {
  const Vector3 o = {1, 2, 3}, a = {0.5, 0, 0}, b = {0, 0.25, 0};
  for (const Quad &q : {Quad{o, o, o, o}, Quad{o, o + a, o + 0.5 * a, o + 0.25 * a}, Quad{o, o + a, o, o + a},
                        Quad{o, o + b, o + b, o}}) {
    const MovingFace face = moving_face(q);
    for (const Vector3 &centre : {o, o + a + b, o - b, Vector3{}}) {
      FacePoint closest;
      EXPECT_FALSE(find_closest(face, centre, closest));
      EXPECT_LE(least_distance_squared(face, centre),
                closest_point(about(q, centre)).distance_squared * (1 + 1e-12));
    }
  }
}

// Plane quads anywhere in space, each a surface of its own: their corners moved by up to a fifth along their
// plane, every fourth a parallelogram, every tenth warped.
TEST(flat_faces, have_their_closest_points_inside_and_nowhere_else) {
  std::mt19937 engine(5);
  std::uniform_real_distribution<double> draw(-1, 1), along(-0.2, 1.2);
  constexpr int count = 4000;
  int found_inside = 0, flat = 0;
  for (int k = 0; k < count; ++k) {
    const Quaternion turn = rotation_quaternion(3 * Vector3{draw(engine), draw(engine), draw(engine)});
    const Vector3 place{draw(engine), draw(engine), 7}, lean{0.3 * draw(engine), 0, 0};
    fem::SurfaceMesh surface;
    surface.vertices = {{0, 0, 0}, {1, 0, 0}, Vector3{1, 1, 0} + lean, Vector3{0, 1, 0} + lean};
    for (Vector3 &c : surface.vertices) {
      if (k % 4 != 0) c += 0.2 * Vector3{draw(engine), draw(engine), 0};
      if (k % 10 == 5) c.z += 0.01 * draw(engine);
      c = place + rotate(turn, c);
    }
    surface.faces = {{0, 1, 2, 3}};
    surface.only_shifted = true;
    const Quad q =
        face_corners(surface, 0, surface.vertices[0]); // relative to its first corner, as the centre
    const Vector3 centre = point_of(q, along(engine), along(engine), 0.2 * draw(engine));
    const FlatFace face = FlatFaces(surface).face(0);
    const ClosestPoint best = closest_point(about(q, centre));
    FlatPoint closest;
    const bool found = find_closest(face, centre, closest);
    flat += face.flat != 0 ? 1 : 0;
    ASSERT_EQ(found, best.feature == Feature::face && face.flat != 0) << "face " << k;
    if (!found) continue;
    ++found_inside;
    const Vector3 normal = bilinear_normal(q, 0.5, 0.5);
    ASSERT_NEAR(closest.u, best.u, 1e-12) << "face " << k;
    ASSERT_NEAR(closest.v, best.v, 1e-12) << "face " << k;
    ASSERT_NEAR(closest.distance, -dot(best.point, normal), 1e-14) << "face " << k;
    ASSERT_NEAR(norm(face.normal - normal), 0, 1e-15) << "face " << k;
  }
  EXPECT_GT(found_inside, 1000);
  EXPECT_NEAR(flat, 0.9 * count, 0.01 * count); // round-off makes some planes uneven
}

} // namespace
} // namespace platen::coupling::faces_test
