#include "coupling/contact/surface_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "sphere_scene.h"

namespace platen::coupling {
namespace {

fem::RigidBody box(int elements) {
  return fem::RigidBody(
      fem::make_grid(fem::BoxPlate{{-1, -0.5, -0.25}, {1, 0.5, 0.25}, {elements, elements, elements}}),
      steel);
}

// Signed distance to the box |x| <= half: the closed form.
double box_distance(const Vector3 &p, const Vector3 &half) {
  const Vector3 q = {std::abs(p.x) - half.x, std::abs(p.y) - half.y, std::abs(p.z) - half.z};
  const Vector3 out = {std::max(q.x, 0.0), std::max(q.y, 0.0), std::max(q.z, 0.0)};
  return norm(out) + std::min(0.0, std::max({q.x, q.y, q.z}));
}

std::vector<Vector3> random_points(int n, double size, unsigned seed) {
  std::mt19937 engine(seed);
  std::uniform_real_distribution<double> draw(-size, size);
  std::vector<Vector3> points(static_cast<std::size_t>(n));
  for (Vector3 &p : points)
    p = {draw(engine), draw(engine), draw(engine)};
  return points;
}

// Inside, outside, beyond edges and corners. Round-off of coordinates of size 1.
TEST(surface_search, distance_to_a_box_is_the_closed_form_with_its_sign) {
  for (const int elements : {1, 2, 5}) {
    const fem::RigidBody body = box(elements);
    const SurfaceSearch search(body.surface(), 0.1);
    for (const Vector3 &p : random_points(3000, 1.5, 5)) {
      const SurfacePoint s = search.closest_of_all(body.surface(), p);
      EXPECT_NEAR(s.distance, box_distance(p, {1, 0.5, 0.25}), 1e-14);
      EXPECT_NEAR(norm(s.normal), 1, 1e-14);
      EXPECT_LT(norm(s.distance * s.normal + s.local.point), 1e-14);
    }
  }
}

// Points exactly over and on edges, corners and inner edges of the mesh.
TEST(surface_search, points_exactly_on_edges_and_vertices_have_one_answer) {
  const fem::RigidBody body = box(2);
  const SurfaceSearch search(body.surface(), 0.1);
  for (const double x : {-1.0, -0.5, 0.0, 0.5, 1.0, 1.25})
    for (const double y : {-0.5, -0.25, 0.0, 0.25, 0.5, 0.75})
      for (const double z : {-0.5, -0.25, 0.0, 0.25, 0.3}) {
        const SurfacePoint s = search.closest_of_all(body.surface(), {x, y, z});
        EXPECT_NEAR(s.distance, box_distance({x, y, z}, {1, 0.5, 0.25}), 1e-15);
        EXPECT_NEAR(norm(s.normal), 1, 1e-15);
      }
}

// Over an inner edge of a flat face the normal is the face's, to the last bit.
TEST(surface_search, an_inner_edge_of_a_flat_face_has_the_normal_of_the_face) {
  const fem::RigidBody body = box(2);
  const SurfaceSearch search(body.surface(), 0.1);
  for (const double x : {-1.0, -0.37, 0.0, 0.5})
    for (const double y : {0.0, 0.1, -0.31}) {
      const SurfacePoint s = search.closest_of_all(body.surface(), {x, y, 0.26});
      EXPECT_EQ(s.normal.z, 1.0);
      EXPECT_EQ(s.normal.x, 0.0);
      EXPECT_EQ(s.distance, 0.26 - 0.25);
    }
}

bool same(const SurfacePoint &a, const SurfacePoint &b) {
  return a.face == b.face && a.distance == b.distance && norm(a.normal - b.normal) == 0 &&
         norm(a.local.point - b.local.point) == 0 && a.local.weights == b.local.weights;
}

// Random walks of particles around a drifting disc, turning or not: at every step, every particle within
// reach is in the list, and its closest point is that of looking at all faces, bit for bit; and that of the
// general way, which a disc that does not turn seldom goes, to round-off.
class Disc : public testing::TestWithParam<bool> {};

TEST_P(Disc, the_list_gives_the_answer_of_looking_at_every_face) {
  fem::RigidBody body(fem::make_grid(fem::CylinderPlate{0.5, 0.2, -0.1, 9, 2}), steel);
  body.set_velocity({0.3, 0.1, -0.2}, GetParam() ? Vector3{0.5, -0.4, 0.3} : Vector3{});
  ASSERT_NE(body.surface().only_shifted, GetParam());
  std::vector<Vector3> centres = random_points(150, 0.8, 11);
  dem::Particles particles(spheres(centres, 0.05), 1000, false);
  SurfaceSearch search(body.surface(), 0.04);
  const std::vector<double> reach(particles.size(), 0.05);
  const std::vector<int> always = {3, 77};
  std::mt19937 engine(4);
  std::normal_distribution<double> draw(0, 0.002);
  int rebuilds = 0, compared = 0;
  for (int step = 0; step < 150; ++step) {
    double farthest = 0;
    for (std::size_t i = 0; i < particles.size(); ++i) {
      const Vector3 d = {draw(engine), draw(engine), draw(engine)};
      particles.position[i] += d;
      farthest = std::max(farthest, norm(d));
    }
    search.moved(farthest + body.largest_move(0.005));
    body.drift(0.005);
    if (search.stale()) search.rebuild(body.surface(), particles.position, reach, always), ++rebuilds;
    for (std::size_t i = 0; i < particles.size(); ++i) {
      const SurfacePoint all = search.closest_of_all(body.surface(), particles.position[i]);
      const auto &rows = search.particles();
      const auto entry = std::lower_bound(rows.begin(), rows.end(), static_cast<int>(i));
      const bool listed = entry != rows.end() && *entry == static_cast<int>(i);
      if (std::abs(all.distance) <= 0.05 || i == 3 || i == 77) {
        ASSERT_TRUE(listed) << step;
      }
      if (!listed) continue;
      const auto k = static_cast<std::size_t>(entry - rows.begin());
      ASSERT_TRUE(same(search.closest(body.surface(), k, particles.position[i]), all)) << step;
      ++compared;
      fem::SurfaceMesh any_motion = body.surface();
      any_motion.only_shifted = false;
      const SurfacePoint general = search.closest(any_motion, k, particles.position[i]);
      ASSERT_EQ(general.face, all.face);
      ASSERT_NEAR(general.distance, all.distance, 1e-15);
      ASSERT_LT(norm(general.normal - all.normal), 1e-14);
      ASSERT_LT(norm(general.local.point - all.local.point), 1e-14);
      for (std::size_t corner = 0; corner < 4; ++corner)
        ASSERT_NEAR(general.local.weights[corner], all.local.weights[corner], 1e-12);
    }
  }
  EXPECT_GT(rebuilds, 5);
  EXPECT_LT(rebuilds, 100);
  EXPECT_GT(compared, 1000);
}

INSTANTIATE_TEST_SUITE_P(turning_or_not, Disc, testing::Bool());

// Surfaces as they should not be: random vertices, some merged, some faces collapsed to needles, triangles,
// lines or points, neighbours that do not share vertices. Every question has one finite answer, the list
// finds it too.
TEST(surface_search, broken_surfaces_still_give_one_finite_answer) {
  std::mt19937 engine(21);
  std::uniform_real_distribution<double> draw(-1, 1);
  std::uniform_int_distribution<int> kind(0, 5);
  for (int trial = 0; trial < 200; ++trial) {
    fem::SurfaceMesh surface;
    for (int f = 0; f < 6; ++f) {
      const Vector3 o = {draw(engine), draw(engine), draw(engine)},
                    a = {draw(engine), draw(engine), draw(engine)},
                    b = {draw(engine), draw(engine), draw(engine)};
      Quad q = {o, o + a, o + a + b, o + b};
      const int k = kind(engine);
      if (k == 1) q = {o, o + a, o + a + 1e-13 * b, o + 1e-13 * b};
      if (k == 2) q = {o, o, o + a, o + b};
      if (k == 3) q = {o, o + a, o + 0.5 * a, o + 0.25 * a};
      if (k == 4) q = {o, o, o, o};
      if (k == 5) q[2] += Vector3{0.3, 0, 0.3};
      std::array<int, 4> face;
      for (std::size_t c = 0; c < 4; ++c) {
        face[c] = static_cast<int>(surface.vertices.size());
        surface.vertices.push_back({q[c].x, q[c].y, q[c].z});
      }
      if (f > 0) face[0] = surface.faces.back()[2]; // neighbours share some vertices and duplicate others
      surface.faces.push_back(face);
    }
    surface.velocities.assign(surface.vertices.size(), {});
    surface.face_tags.assign(surface.faces.size(), 0);
    surface.only_shifted = trial % 2 == 0;
    std::vector<Vector3> centres = random_points(10, 2, static_cast<unsigned>(trial));
    for (const int v : {0, 5, 9}) // exactly on vertices
      centres.push_back(surface.vertices[static_cast<std::size_t>(v)]);
    dem::Particles particles(spheres(centres, 0.1), 1000, false);
    SurfaceSearch search(surface, 0.2);
    search.rebuild(surface, particles.position, std::vector<double>(particles.size(), 5.0), {});
    ASSERT_EQ(search.particles().size(), particles.size());
    for (std::size_t i = 0; i < particles.size(); ++i) {
      const SurfacePoint s = search.closest(surface, i, particles.position[i]);
      ASSERT_GE(s.face, 0);
      ASSERT_TRUE(std::isfinite(s.distance));
      ASSERT_NEAR(norm(s.normal), 1, 1e-14);
      ASSERT_TRUE(same(s, search.closest_of_all(surface, particles.position[i])));
    }
  }
}

// The work of a step follows the particles near the surface: far ones are not in the list.
TEST(surface_search, particles_far_from_the_surface_are_not_listed) {
  const fem::RigidBody body = plate(0.02, 4);
  std::vector<Vector3> centres;
  for (int k = 0; k < 100; ++k)
    centres.push_back({0, 0, sphere_radius * (1 + 2 * k)});
  dem::Particles particles(spheres(centres), 1000, false);
  SurfaceSearch search(body.surface(), 0.3 * sphere_radius);
  search.rebuild(body.surface(), particles.position, std::vector<double>(100, sphere_radius), {});
  ASSERT_EQ(search.particles().size(), 1u);
  EXPECT_EQ(particles.id[static_cast<std::size_t>(search.particles()[0])], 0);
}

} // namespace
} // namespace platen::coupling
