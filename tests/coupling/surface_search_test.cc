#include "coupling/contact/surface_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

#include "sphere_scene.h"
#include "tests/instruction_sets.h"

namespace platen::coupling::surface_search_test {
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

// Around a centre of curvature of a saddle many points are as near as the closest one, which is then found to
// a few digits alone: the normal is that of the surface all the same, not the way to the centre.
TEST(surface_search, the_normal_of_a_saddle_is_square_to_it_at_its_centre_of_curvature) {
  fem::SurfaceMesh saddle; // z = x y / 2
  saddle.vertices = {{-1, -1, 0.5}, {1, -1, -0.5}, {1, 1, 0.5}, {-1, 1, -0.5}};
  saddle.velocities.resize(4), saddle.faces = {{0, 1, 2, 3}}, saddle.face_tags = {0};
  const SurfaceSearch search(saddle, 0.1);
  int met = 0;
  for (const Vector3 &p : random_points(1000, 1e-6, 3)) {
    const SurfacePoint s = search.closest_of_all(saddle, Vector3{0, 0, 2} + p);
    ASSERT_EQ(s.local.feature, Feature::face);
    ASSERT_NEAR(norm(s.normal), 1, 1e-15);
    ASSERT_LT(std::abs(dot(s.normal, s.along_u)), 1e-15);
    ASSERT_LT(std::abs(dot(s.normal, s.along_v)), 1e-15);
    ASSERT_NEAR(s.distance, 2, 1e-5);
    met += norm(s.distance * s.normal + s.local.point) > 1e-12;
  }
  EXPECT_GT(met, 50); // few digits
}

bool same(const SurfacePoint &a, const SurfacePoint &b) {
  return a.face == b.face && a.distance == b.distance && norm(a.normal - b.normal) == 0 &&
         a.local.weights == b.local.weights;
}

// Each listed particle, alone and in vectors of any number: bit for bit what all faces have.
void expect_one_answer(const SurfaceSearch &search, const fem::SurfaceMesh &surface,
                       const dem::Particles &particles) {
  const std::size_t listed = search.particles().size();
  for (std::size_t first = 0, many = 1; first < listed; first += many, many = many % 32 + 1) {
    many = std::min(many, listed - first);
    std::vector<std::size_t> entry(many);
    std::iota(entry.begin(), entry.end(), first);
    const int *at = &search.particles()[first];
    SurfacePoints packed;
    search.closest(surface, entry.data(), particles.position.data(), at, many, packed);
    for (std::size_t k = 0; k < many; ++k) {
      const Vector3 centre = particles.position[static_cast<std::size_t>(at[k])];
      const SurfacePoint all = search.closest_of_all(surface, centre),
                         alone = search.closest(surface, entry[k], centre), in_vector = packed.at(k);
      ASSERT_TRUE(same(alone, all) && norm(alone.local.point - all.local.point) == 0) << entry[k];
      ASSERT_TRUE(same(in_vector, all)) << entry[k];
      if (surface.only_shifted)
        ASSERT_EQ(norm(in_vector.local.point - all.local.point), 0) << entry[k];
      else
        ASSERT_EQ(norm(in_vector.along_u - all.along_u) + norm(in_vector.along_v - all.along_v), 0)
            << entry[k];
      double nearest = std::numeric_limits<double>::infinity();
      for (int face = 0; face < static_cast<int>(surface.faces.size()); ++face)
        nearest = std::min(nearest, closest_point(face_corners(surface, face, centre)).distance_squared);
      ASSERT_NEAR(std::abs(all.distance), std::sqrt(nearest), 1e-14);
    }
  }
}

struct Motion {
  const char *name;
  bool only_shifts;
  Vector3 (*place)(const Vector3 &start, int step);
};
const std::vector<Motion> motions{
    {"drops", true,
     [](const Vector3 &p, int step) {
       return p - step * Vector3{0, 0, 0.007};
     }},
    {"drifts", true,
     [](const Vector3 &p, int step) {
       return p + step * Vector3{1.5e-3, 5e-4, -1e-3};
     }},
    {"turns", false,
     [](const Vector3 &p, int step) {
       return rotate(rotation_quaternion(step * Vector3{2.5e-3, -2e-3, 1.5e-3}), p) +
              step * Vector3{1.5e-3, 5e-4, -1e-3};
     }},
    {"is strained", false, [](const Vector3 &p, int step) {
       const double bend = 0.01 * step;
       return Vector3{p[0] * (1 + 0.2 * bend) - bend * p[1] * p[2], p[1] + bend * p[0] * p[2],
                      p[2] + bend * (p[0] * p[0] + p[0] * p[1])};
     }}};

// A disc with two flat ends and a side of many faces, among particles that walk at random. All within reach
// are in the list; their closest points are those of the general way too, which a surface that only shifts
// seldom goes, to round-off.
TEST(surface_search, a_surface_that_moves_or_is_strained_has_one_answer) {
  for (const Motion &motion : motions)
    for (const dem::InstructionSet set : dem::instruction_sets_here()) {
      fem::SurfaceMesh surface =
          fem::RigidBody(fem::make_grid(fem::CylinderPlate{0.5, 0.2, -0.1, 9, 2}), steel).surface();
      surface.only_shifted = motion.only_shifts;
      const std::vector<Vector3> start = surface.vertices;
      std::vector<Vector3> centres = random_points(200, 0.6, 8);
      for (Vector3 &c : centres)
        c.z *= 0.5;
      dem::Particles particles(spheres(centres, 0.05), 1000, false);
      const std::vector<double> reach(particles.size(), 0.05);
      const std::vector<int> always = {3, 77};
      SurfaceSearch search(surface, 0.04, set);
      std::mt19937 engine(4);
      std::normal_distribution<double> draw(0, 0.002);
      int rebuilds = 0, compared = 0;
      for (int step = 1; step <= 40; ++step) {
        SCOPED_TRACE(testing::Message() << motion.name << ", step " << step << ", " << dem::name(set));
        double farthest = 0, walked = 0;
        for (std::size_t v = 0; v < start.size(); ++v) {
          const Vector3 now = motion.place(start[v], step);
          farthest = std::max(farthest, norm(now - surface.vertices[v]));
          surface.vertices[v] = now;
        }
        for (Vector3 &centre : particles.position) {
          const Vector3 d = {draw(engine), draw(engine), draw(engine)};
          centre += d;
          walked = std::max(walked, norm(d));
        }
        search.moved(farthest + walked);
        if (search.stale()) search.rebuild(surface, particles.position, reach, always), ++rebuilds;
        search.update(surface);
        expect_one_answer(search, surface, particles);
        if (testing::Test::HasFatalFailure()) return;
        const std::vector<int> &rows = search.particles();
        fem::SurfaceMesh any_motion = surface;
        any_motion.only_shifted = false;
        for (std::size_t i = 0; i < particles.size(); ++i) {
          const SurfacePoint all = search.closest_of_all(surface, particles.position[i]);
          const auto entry = std::lower_bound(rows.begin(), rows.end(), static_cast<int>(i));
          const bool listed = entry != rows.end() && *entry == static_cast<int>(i);
          ASSERT_TRUE(listed || (std::abs(all.distance) > 0.05 && i != 3 && i != 77)) << i;
          if (!listed) continue;
          ++compared;
          if (!motion.only_shifts) continue;
          const SurfacePoint general = search.closest(
              any_motion, static_cast<std::size_t>(entry - rows.begin()), particles.position[i]);
          ASSERT_EQ(general.face, all.face);
          ASSERT_NEAR(general.distance, all.distance, 1e-15);
          ASSERT_LT(norm(general.normal - all.normal), 1e-14);
          ASSERT_LT(norm(general.local.point - all.local.point), 1e-14);
          for (std::size_t corner = 0; corner < 4; ++corner)
            ASSERT_NEAR(general.local.weights[corner], all.local.weights[corner], 1e-12);
        }
      }
      EXPECT_GT(rebuilds, 5);
      EXPECT_LT(rebuilds, 35);
      EXPECT_GT(compared, 1000);
    }
}

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
    for (const dem::InstructionSet set : dem::instruction_sets_here()) {
      SurfaceSearch search(surface, 0.2, set);
      search.rebuild(surface, particles.position, std::vector<double>(particles.size(), 5.0), {});
      ASSERT_EQ(search.particles().size(), particles.size());
      for (std::size_t i = 0; i < particles.size(); ++i) {
        const SurfacePoint s = search.closest(surface, i, particles.position[i]);
        ASSERT_GE(s.face, 0);
        ASSERT_TRUE(std::isfinite(s.distance));
        ASSERT_NEAR(norm(s.normal), 1, 1e-14);
        ASSERT_TRUE(same(s, search.closest_of_all(surface, particles.position[i])));
      }
      search.update(surface);
      expect_one_answer(search, surface, particles);
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
} // namespace platen::coupling::surface_search_test
