#include "coupling/contact/faces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>
#include <random>

#include "coupling/contact/surface_search.h"
#include "sphere_scene.h"
#include "tests/instruction_sets.h"

namespace platen::coupling {
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
    const double u = along(engine), v = along(engine);
    const std::array<double, 4> w = bilinear_weights(u, v);
    const Vector3 centre =
        w[0] * q[0] + w[1] * q[1] + w[2] * q[2] + w[3] * q[3] + off(engine) * bilinear_normal(q, 0.5, 0.5);
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
    const std::array<double, 4> w = bilinear_weights(along(engine), along(engine));
    const Vector3 centre =
        w[0] * q[0] + w[1] * q[1] + w[2] * q[2] + w[3] * q[3] + off(engine) * bilinear_normal(q, 0.5, 0.5);
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

// Every instruction set and every number of closest points in a call: the bits of one closest point alone.
TEST(moving_faces, closest_points_in_lanes_are_those_of_single_centres) {
  std::mt19937 engine(11);
  std::uniform_real_distribution<double> along(-0.2, 1.2), off(-0.3, 0.3);
  std::vector<MovingFace> faces;
  std::vector<Vector3> centres;
  for (int k = 0; k < 3000; ++k) {
    const Quad q = strained_square(k % 3 == 0 ? 0.3 : 0.05, engine);
    const std::array<double, 4> w = bilinear_weights(along(engine), along(engine));
    faces.push_back(moving_face(k % 50 == 0 ? Quad{q[0], q[0], q[0], q[0]} : q));
    centres.push_back(w[0] * q[0] + w[1] * q[1] + w[2] * q[2] + w[3] * q[3] +
                      off(engine) * bilinear_normal(q, 0.5, 0.5));
  }
  centres[7].x = std::numeric_limits<double>::quiet_NaN();
  const auto bits_of = [](const FacePoint &closest) {
    std::array<char, sizeof(FacePoint)> bytes;
    std::memcpy(bytes.data(), &closest, sizeof closest);
    return bytes;
  };
  std::vector<Vector3> turned_round(centres.rbegin(), centres.rend());
  turned_round.emplace_back(); // to spare
  int closest = 0;
  for (const dem::InstructionSet set : dem::instruction_sets_here()) {
    for (std::size_t first = 0, count = 1; first < faces.size(); first += count, count = count % 32 + 1) {
      count = std::min(count, faces.size() - first);
      const MovingFace *face[SurfacePoints::most];
      int at[SurfacePoints::most];
      for (std::size_t k = 0; k < count; ++k) {
        face[k] = &faces[first + k];
        at[k] = static_cast<int>(faces.size() - 1 - first - k);
      }
      SurfacePoints points;
      const std::uint32_t found =
          kernels::find_closest_points(set)(face, turned_round.data(), at, count, points);
      for (std::size_t k = 0; k < count; ++k) {
        FacePoint alone;
        const bool expected = find_closest(faces[first + k], centres[first + k], alone);
        ASSERT_EQ((found >> k & 1u) != 0, expected)
            << dem::name(set) << ", face " << first + k << ", " << count;
        if (!expected) continue;
        ++closest;
        const SurfacePoint p = points.at(k);
        const FacePoint packed{p.local.u, p.local.v, -p.local.point, p.along_u, p.along_v, p.normal};
        ASSERT_EQ(bits_of(packed), bits_of(alone)) << dem::name(set) << ", face " << first + k;
        ASSERT_EQ(p.local.weights, bilinear_weights(alone.u, alone.v))
            << dem::name(set) << ", face " << first + k;
        ASSERT_EQ(p.distance, dot(alone.out, alone.normal)) << dem::name(set) << ", face " << first + k;
        ASSERT_EQ(p.local.distance_squared, norm_squared(alone.out))
            << dem::name(set) << ", face " << first + k;
      }
    }
  }
  EXPECT_GT(closest, 1500);
}

// The same of what faces are set up from: all of it, warped, flat, folded over and without area.
TEST(moving_faces, in_packs_are_those_of_single_ones) {
  std::mt19937 engine(12);
  std::uniform_real_distribution<double> draw(-1, 1);
  std::vector<Vector3> vertices;
  for (int k = 0; k < 400; ++k)
    vertices.push_back({draw(engine), k % 3 == 0 ? 0.25 : draw(engine), draw(engine)});
  std::uniform_int_distribution<int> any(0, 399);
  std::vector<std::array<int, 4>> corners;
  std::vector<int> number;
  for (int k = 0; k < 1000; ++k) {
    corners.push_back({any(engine), any(engine), any(engine), any(engine)});
    if (k % 20 == 3) corners.back() = {k % 400, k % 400, k % 400, k % 400};
    if (k % 7 != 0) number.push_back(k);
  }
  const auto bits_of = [](const MovingFace &face) {
    std::array<double, 36> members;
    std::memcpy(members.data(), &face, sizeof members);
    return members;
  };
  int single = 0, none = 0;
  for (const dem::InstructionSet set : dem::instruction_sets_here()) {
    std::vector<MovingFace> faces(corners.size());
    for (std::size_t first = 0, count = 1; first < number.size(); first += count, count = count % 32 + 1) {
      count = std::min(count, number.size() - first);
      kernels::set_faces(set)(vertices.data(), corners[0].data(), &number[first], count, faces.data());
    }
    for (std::size_t k = 0; k < faces.size(); ++k) {
      const auto &c = corners[k];
      const auto at = [&](std::size_t corner) { return vertices[static_cast<std::size_t>(c[corner])]; };
      const bool asked = k % 7 != 0;
      const MovingFace alone = asked ? moving_face({at(0), at(1), at(2), at(3)}) : MovingFace{};
      ASSERT_EQ(bits_of(faces[k]), bits_of(alone)) << "face " << k << ", set " << static_cast<int>(set);
      if (asked) ++(alone.single_closest > 0 ? single : none);
    }
  }
  EXPECT_GT(single, 20);
  EXPECT_GT(none, 20);
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

// A disc with two flat ends and a side of many faces, which drops by steps, or is bent and twisted more and
// more: what the list and the look at its faces find, alone and in packs of any number, is bit for bit what
// all faces have, and that is the nearest point of all.
TEST(moving_faces, a_surface_that_drops_or_is_strained_has_one_answer) {
  for (const bool drops : {true, false})
    for (const auto set : {dem::InstructionSet::baseline, dem::best_instruction_set()}) {
      fem::SurfaceMesh surface =
          fem::RigidBody(fem::make_grid(fem::CylinderPlate{0.5, 0.2, -0.1, 9, 2}), steel).surface();
      ASSERT_TRUE(surface.only_shifted);
      surface.only_shifted = drops;
      const std::vector<Vector3> start = surface.vertices;
      std::mt19937 engine(8);
      std::uniform_real_distribution<double> draw(-0.6, 0.6), high(-0.2, 0.2);
      std::vector<Vector3> centres;
      for (int k = 0; k < 400; ++k)
        centres.push_back({draw(engine), draw(engine), high(engine)});
      const dem::Particles particles(spheres(centres, 0.05), 1000, false);
      SurfaceSearch search(surface, 0.04, set);
      int inside = 0, beside = 0;
      for (int step = 0; step < (drops ? 12 : 40); ++step) {
        SCOPED_TRACE(testing::Message() << (drops ? "drops" : "is strained") << ", step " << step);
        const double bend = 0.01 * step;
        double farthest = 0;
        for (std::size_t v = 0; v < start.size(); ++v) {
          const Vector3 &p = start[v];
          const Vector3 now =
              drops ? surface.vertices[v] - Vector3{0, 0, 0.007}
                    : Vector3{p[0] * (1 + 0.2 * bend) - bend * p[1] * p[2], p[1] + bend * p[0] * p[2],
                              p[2] + bend * (p[0] * p[0] + p[0] * p[1])};
          farthest = std::max(farthest, norm(now - surface.vertices[v]));
          surface.vertices[v] = now;
        }
        search.moved(farthest);
        if (search.stale())
          search.rebuild(surface, particles.position, std::vector<double>(particles.size(), 0.05), {});
        search.update(surface);
        const std::size_t listed = search.particles().size();
        for (std::size_t first = 0, many = 1; first < listed; first += many, many = many % 32 + 1) {
          many = std::min(many, listed - first);
          std::vector<std::size_t> entry(many);
          std::iota(entry.begin(), entry.end(), first);
          const int *at = &search.particles()[first];
          SurfacePoints packed;
          search.closest(surface, entry.data(), particles.position.data(), at, many, packed);
          for (std::size_t k = 0; k < many; ++k) {
            const Vector3 &centre = particles.position[static_cast<std::size_t>(at[k])];
            const SurfacePoint all = search.closest_of_all(surface, centre);
            for (const SurfacePoint &p : {packed.at(k), search.closest(surface, entry[k], centre)}) {
              ASSERT_EQ(p.face, all.face) << entry[k];
              ASSERT_EQ(p.distance, all.distance) << entry[k];
              ASSERT_EQ(norm(p.normal - all.normal), 0) << entry[k];
              ASSERT_EQ(p.local.weights, all.local.weights) << entry[k];
              if (drops) {
                ASSERT_EQ(norm(p.local.point - all.local.point), 0) << entry[k];
                ASSERT_EQ(p.local.distance_squared, all.local.distance_squared) << entry[k];
              } else {
                ASSERT_EQ(norm(p.along_u - all.along_u) + norm(p.along_v - all.along_v), 0) << entry[k];
              }
            }
            double nearest = std::numeric_limits<double>::infinity();
            for (int face = 0; face < static_cast<int>(surface.faces.size()); ++face)
              nearest =
                  std::min(nearest, closest_point(face_corners(surface, face, centre)).distance_squared);
            ASSERT_NEAR(std::abs(all.distance), std::sqrt(nearest), 1e-14);
            ++(all.local.feature == Feature::face ? inside : beside);
          }
        }
      }
      EXPECT_GT(inside, 250);
      EXPECT_GT(beside, 50);
    }
}

} // namespace
} // namespace platen::coupling
