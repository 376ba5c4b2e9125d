// Indentations of a mesh under single forces: against a half space, and what they may not depend on.
#include "base/pi.h"
#include "fem/elastic_model.h"

#include <gtest/gtest.h>

#include <cmath>

#include "fem/elastic_solid.h"

namespace platen::fem::face_compliance_test {
namespace {

constexpr Material rock{2600, 50e9, 0.3};
constexpr double h = 1e-3; // m, of an element
const double scale = rock.young_modulus / (1 - rock.poisson_ratio * rock.poisson_ratio) * h;

Grid block(int across, double edge = h) {
  const double half = 0.5 * across * edge;
  return make_grid(BoxPlate{{-half, -half, -half}, {half, half, 0}, {across, across, across / 2}});
}

ElasticSolid solid(Grid grid, int degree, const Material &material = rock) {
  ElasticOptions options;
  options.degree = degree;
  options.motion = ElasticMotion::quasi_static;
  return ElasticSolid(std::move(grid), {material}, Clamp{low_end_tag}, options);
}

// Of the vertex on the upper face that is closest to (x, y), from some face around it.
double own_compliance(const ElasticSolid &s, const std::vector<FaceCompliance> &c, double x, double y) {
  double least = 1e300, found = 0;
  for (std::size_t f = 0; f < c.size(); ++f)
    for (std::size_t k = 0; k < 4; ++k) {
      const Vector3 &p = s.surface().vertices[static_cast<std::size_t>(s.surface().faces[f][k])];
      const double away = norm(p - Vector3{x, y, 0});
      if (away < least) least = away, found = c[f][k][k];
    }
  return found;
}

// The indentation of one vertex in a block, with what the block's finite size takes from it put back: at four
// elements from the force the mesh is fine enough for Boussinesq's 1 / (pi E* r), and what differs there is
// the block's. The rest of that is 1 %; 3 % are claimed.
TEST(face_compliance, is_the_indentation_of_a_half_space) {
  for (const int degree : {1, 2}) {
    const int across = degree == 1 ? 12 : 8;
    ElasticSolid s = solid(block(across), degree);
    const std::vector<FaceCompliance> c = s.face_compliance();
    const std::vector<Vector3> before = s.surface().vertices;
    for (const double at : {0.0, 0.5}) {
      if (degree == 1 && at > 0) continue; // a node in the middle of an edge
      std::vector<Vector3> load(s.surface().vertices.size(), Vector3{});
      const auto vertex = [&](double x, double y) {
        std::size_t best = 0;
        for (std::size_t v = 0; v < before.size(); ++v)
          if (norm(before[v] - Vector3{x, y, 0}) < norm(before[best] - Vector3{x, y, 0})) best = v;
        return best;
      };
      const std::size_t loaded = vertex(at * h, 0);
      load[loaded] = {0, 0, -1};
      s.solve_for(load, 0);
      const auto indentation = [&](std::size_t v) { return before[v][2] - s.surface().vertices[v][2]; };
      double block_share = 0;
      for (const Vector3 &way : {Vector3{4, 0, 0}, Vector3{-4, 0, 0}, Vector3{0, 4, 0}, Vector3{0, -4, 0}})
        block_share += 0.25 * (indentation(vertex((at + way[0]) * h, way[1] * h)) - 1 / (pi * scale * 4));
      const double expected = indentation(loaded) - block_share;
      EXPECT_NEAR(own_compliance(s, c, at * h, 0), expected, 0.04 * expected) << degree << ' ' << at;
      EXPECT_GT(expected * scale, 0.8); // far from nothing
    }
  }
}

// As 1 / (E h), whatever the place and turn of the body; the same from both sides of an edge; nothing where
// the machine holds.
TEST(face_compliance, scales_and_turns_with_the_body) {
  const ElasticSolid plain = solid(block(4), 1);
  const std::vector<FaceCompliance> c = plain.face_compliance();
  Material soft = rock;
  soft.young_modulus *= 0.5;
  const std::vector<FaceCompliance> large_and_soft = solid(block(4, 3 * h), 1, soft).face_compliance();
  const auto turn = [](const Vector3 &p) {
    return Vector3{0.6 * p[0] - 0.8 * p[2] + 2, p[1] - 1, 0.8 * p[0] + 0.6 * p[2]};
  };
  const std::vector<FaceCompliance> turned = solid(moved_grid(block(4), turn), 1).face_compliance();
  ASSERT_EQ(c.size(), plain.surface().faces.size());
  bool has_held = false;
  std::vector<double> of_vertex(plain.surface().vertices.size(), -1);
  for (std::size_t f = 0; f < c.size(); ++f)
    for (std::size_t i = 0; i < 4; ++i) {
      double &own = of_vertex[static_cast<std::size_t>(plain.surface().faces[f][i])];
      if (own < 0) own = c[f][i][i];
      EXPECT_EQ(c[f][i][i], own);
      for (std::size_t j = 0; j < 4; ++j) {
        EXPECT_EQ(c[f][i][j], c[f][j][i]);
        EXPECT_NEAR(large_and_soft[f][i][j], c[f][i][j] * 2 / 3, 1e-10 / scale);
        EXPECT_NEAR(turned[f][i][j], c[f][i][j], 1e-10 / scale);
        if (plain.surface().face_tags[f] != low_end_tag) continue;
        EXPECT_EQ(c[f][i][j], 0);
        has_held = true;
      }
    }
  EXPECT_TRUE(has_held);
}

} // namespace
} // namespace platen::fem::face_compliance_test
