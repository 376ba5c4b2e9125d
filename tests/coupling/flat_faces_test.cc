// closest points on the flat faces of a surface that only shifts: the closest point in general, the same in
// packs.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include "coupling/contact/faces.h"
#include "coupling/contact/surface_search.h"
#include "sphere_scene.h"
#include "tests/instruction_sets.h"

namespace platen::coupling {
namespace {

// Plane quads anywhere in space, each a surface of its own: their corners moved by up to a fifth along their
// plane, every fourth a parallelogram, every tenth warped.
class FlatFeet : public testing::Test {
protected:
  static constexpr int count = 4000;

  FlatFeet() {
    std::uniform_real_distribution<double> draw(-1, 1), along(-0.2, 1.2);
    for (int k = 0; k < count; ++k) {
      const Quaternion q = rotation_quaternion(3 * Vector3{draw(engine), draw(engine), draw(engine)});
      const Vector3 place{draw(engine), draw(engine), 7}, lean{0.3 * draw(engine), 0, 0};
      fem::SurfaceMesh surface;
      surface.vertices = {{0, 0, 0}, {1, 0, 0}, Vector3{1, 1, 0} + lean, Vector3{0, 1, 0} + lean};
      for (Vector3 &c : surface.vertices) {
        if (k % 4 != 0) c += 0.2 * Vector3{draw(engine), draw(engine), 0};
        if (k % 10 == 5) c.z += 0.01 * draw(engine);
        c = place + rotate(q, c);
      }
      surface.faces = {{0, 1, 2, 3}};
      surface.only_shifted = true;
      const Quad corners = face_corners(surface, 0, surface.vertices[0]);
      const std::array<double, 4> w = bilinear_weights(along(engine), along(engine));
      Vector3 centre = 0.2 * draw(engine) * bilinear_normal(corners, 0.5, 0.5);
      for (std::size_t c = 0; c < 4; ++c)
        centre += w[c] * corners[c];
      quads.push_back(corners), centres.push_back(centre);
      faces.push_back(FlatFaces(surface).face(0));
    }
  }

  std::mt19937 engine{5};
  std::vector<Quad> quads;
  std::vector<Vector3> centres; // relative to the first corner, as the quads
  std::vector<FlatFace> faces;
};

TEST_F(FlatFeet, are_the_closest_points_inside_flat_faces_and_nowhere_else) {
  int found_inside = 0, flat = 0;
  for (int k = 0; k < count; ++k) {
    const Quad &q = quads[k];
    const Vector3 &c = centres[k];
    const ClosestPoint best = closest_point({q[0] - c, q[1] - c, q[2] - c, q[3] - c});
    FlatPoint closest;
    const bool found = find_closest(faces[k], c, closest);
    flat += faces[k].flat != 0 ? 1 : 0;
    ASSERT_EQ(found, best.feature == Feature::face && faces[k].flat != 0) << "face " << k;
    if (!found) continue;
    ++found_inside;
    const Vector3 normal = bilinear_normal(q, 0.5, 0.5);
    ASSERT_NEAR(closest.u, best.u, 1e-12) << "face " << k;
    ASSERT_NEAR(closest.v, best.v, 1e-12) << "face " << k;
    ASSERT_NEAR(closest.distance, -dot(best.point, normal), 1e-14) << "face " << k;
    ASSERT_NEAR(norm(faces[k].normal - normal), 0, 1e-15) << "face " << k;
  }
  EXPECT_GT(found_inside, 1000);
  EXPECT_NEAR(flat, 0.9 * count, 0.01 * count); // round-off makes some planes uneven
}

TEST_F(FlatFeet, have_the_bits_of_single_ones_in_packs) {
  centres[7].y = std::numeric_limits<double>::quiet_NaN();
  const auto same_bits = [](const FlatPoint &a, const FlatPoint &b) {
    return std::memcmp(&a, &b, sizeof a) == 0;
  };
  std::vector<Vector3> corners, turned_round(centres.size() + 1); // one to spare
  for (std::size_t k = 0; k < centres.size(); ++k) {
    corners.push_back({0.1 * static_cast<double>(k % 7), -0.2 * static_cast<double>(k % 3), 1});
    turned_round[centres.size() - 1 - k] = corners[k] + centres[k];
  }
  int found_inside = 0, none = 0;
  for (const dem::InstructionSet set : dem::instruction_sets_here()) {
    for (std::size_t first = 0, many = 1; first < faces.size(); first += many, many = many % 32 + 1) {
      many = std::min(many, faces.size() - first);
      const FlatFace *face[SurfacePoints::most];
      const Vector3 *corner[SurfacePoints::most];
      int at[SurfacePoints::most];
      for (std::size_t k = 0; k < many; ++k) {
        face[k] = &faces[first + k], corner[k] = &corners[first + k];
        at[k] = static_cast<int>(faces.size() - 1 - first - k);
      }
      SurfacePoints points;
      const std::uint32_t found =
          kernels::find_flat_closest_points(set)(face, corner, turned_round.data(), at, many, points);
      for (std::size_t k = 0; k < many; ++k) {
        FlatPoint alone;
        const bool expected = find_closest(
            faces[first + k], turned_round[static_cast<std::size_t>(at[k])] - corners[first + k], alone);
        ASSERT_EQ((found >> k & 1u) != 0, expected)
            << dem::name(set) << ", face " << first + k << ", " << many;
        ++(expected ? found_inside : none);
        if (!expected) continue;
        ASSERT_TRUE(same_bits({points.u[k], points.v[k], points.distance[k]}, alone))
            << dem::name(set) << ", face " << first + k;
      }
    }
  }
  EXPECT_GT(found_inside, 1000);
  EXPECT_GT(none, 1000);
}

} // namespace
} // namespace platen::coupling
