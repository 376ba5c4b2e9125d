#include "coupling/contact/closest_point.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace platen::coupling::closest_point_test {
namespace {

class Draw {
public:
  explicit Draw(unsigned seed) : engine_(seed) {}
  double number(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  Vector3 vector(double size) { return {number(-size, size), number(-size, size), number(-size, size)}; }

private:
  std::mt19937 engine_;
};

double distance_at(const Quad &q, double u, double v) {
  const double w[4] = {(1 - u) * (1 - v), u * (1 - v), u * v, (1 - u) * v};
  return norm(w[0] * q[0] + w[1] * q[1] + w[2] * q[2] + w[3] * q[3]);
}

// The smallest distance by search alone: a grid, then ever smaller grids around its best few points.
double searched_distance(const Quad &q) {
  constexpr int n = 48;
  std::vector<std::array<double, 3>> points;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n; ++j) {
      const double u = static_cast<double>(i) / n, v = static_cast<double>(j) / n;
      points.push_back({distance_at(q, u, v), u, v});
    }
  std::sort(points.begin(), points.end());
  double smallest = points[0][0];
  for (std::size_t k = 0; k < 12; ++k) {
    double u = points[k][1], v = points[k][2], here = points[k][0];
    for (double h = 1.0 / n; h > 1e-12; h *= 0.6)
      for (int i = -2; i <= 2; ++i)
        for (int j = -2; j <= 2; ++j) {
          const double a = std::clamp(u + 0.5 * h * i, 0.0, 1.0), b = std::clamp(v + 0.5 * h * j, 0.0, 1.0);
          const double d = distance_at(q, a, b);
          if (d < here) here = d, u = a, v = b;
        }
    smallest = std::min(smallest, here);
  }
  return smallest;
}

// What must hold for any quad whatsoever.
void expect_sound(const Quad &q, const ClosestPoint &c) {
  double size = 0;
  Vector3 sum;
  for (std::size_t k = 0; k < 4; ++k) {
    size = std::max(size, norm(q[k]));
    sum += c.weights[k] * q[k];
    ASSERT_GE(c.weights[k], -1e-15);
    ASSERT_LE(c.weights[k], 1 + 1e-15);
  }
  ASSERT_EQ(((c.weights[0] + c.weights[1]) + c.weights[2]) + c.weights[3], 1.0);
  ASSERT_LE(norm(sum - c.point), 4e-15 * size);
  ASSERT_EQ(c.distance_squared, norm_squared(c.point));
}

TEST(closest_point, projection_onto_a_parallelogram_is_exact_to_round_off) {
  Draw draw(1);
  for (int trial = 0; trial < 2000; ++trial) {
    const Vector3 a = draw.vector(1), b = draw.vector(1), n = cross(a, b) / norm(cross(a, b));
    if (norm(cross(a, b)) < 0.05) continue;
    const double u = draw.number(0, 1), v = draw.number(0, 1), h = draw.number(-2, 2);
    const Vector3 origin = -(u * a + v * b + h * n);
    const ClosestPoint c = closest_point({origin, origin + a, origin + a + b, origin + b});
    EXPECT_EQ(c.feature, Feature::face);
    EXPECT_LT(norm(c.point - (-h * n)), 1e-13); // solve with a condition number of up to 1e3
    EXPECT_NEAR(c.u, u, 1e-12);
    EXPECT_NEAR(c.v, v, 1e-12);
  }
}

// A face in a coordinate plane returns that coordinate with all its bits, wherever the closest point lies.
TEST(closest_point, a_level_face_gives_its_height_to_the_last_bit) {
  Draw draw(2);
  for (int trial = 0; trial < 2000; ++trial) {
    const double z = draw.number(-1, 1), x = draw.number(-3, 0), y = draw.number(-3, 0);
    const double lx = draw.number(0.1, 4), ly = draw.number(0.1, 4), skew = draw.number(-1, 1);
    const Quad square = {Vector3{x, y, z}, {x + lx, y, z}, {x + lx + skew, y + ly, z}, {x + skew, y + ly, z}};
    EXPECT_EQ(closest_point(square).point.z, z);
    const Quad trapezoid = {square[0], square[1], square[2] + Vector3{0.3, 0.1, 0}, square[3]};
    EXPECT_EQ(closest_point(trapezoid).point.z, z);
  }
}

TEST(closest_point, the_nine_regions_of_a_square_find_face_edge_and_vertex) {
  const Feature features[3][3] = {{Feature::vertex, Feature::edge, Feature::vertex},
                                  {Feature::edge, Feature::face, Feature::edge},
                                  {Feature::vertex, Feature::edge, Feature::vertex}};
  const int locals[3][3] = {{0, 0, 1}, {3, 0, 1}, {3, 2, 2}};
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i) {
      const Vector3 p = {-0.5 + i * 1.0, -0.5 + j * 1.0, 0.7};
      const ClosestPoint c = closest_point(
          {Vector3{0, 0, 0} - p, Vector3{1, 0, 0} - p, Vector3{1, 1, 0} - p, Vector3{0, 1, 0} - p});
      EXPECT_EQ(c.feature, features[j][i]) << i << j;
      EXPECT_EQ(c.local, locals[j][i]) << i << j;
      const Vector3 expected = {std::clamp(p.x, 0.0, 1.0), std::clamp(p.y, 0.0, 1.0), 0};
      EXPECT_LT(norm(c.point + p - expected), 1e-16);
    }
}

struct QuadKind {
  const char *name;
  Quad (*make)(Draw &);
};

void PrintTo(const QuadKind &kind, std::ostream *out) {
  *out << kind.name;
}

Quad any_warped(Draw &d) {
  return {d.vector(1), d.vector(1), d.vector(1), d.vector(1)};
}

Quad slightly_warped(Draw &d) {
  const Vector3 o = d.vector(1.5), a = d.vector(1), b = d.vector(1);
  return {o, o + a + d.vector(0.1), o + a + b + d.vector(0.1), o + b + d.vector(0.1)};
}

Quad flat_trapezoid(Draw &d) {
  const Vector3 o = d.vector(1.5), a = d.vector(1), b = d.vector(1);
  return {o, o + a, o + d.number(0.3, 1.5) * a + d.number(0.3, 1.5) * b, o + b};
}

Quad strained_trapezoid(Draw &d) { // a face of a mesh, out of its plane by up to a hundredth
  Quad q = flat_trapezoid(d);
  for (Vector3 &corner : q)
    corner += d.vector(std::pow(10, d.number(-8, -2)));
  return q;
}

Quad flat_re_entrant(Draw &d) {
  const Vector3 o = d.vector(1.5), a = d.vector(1), b = d.vector(1);
  return {o, o + a, o + 0.2 * a + 0.2 * b, o + b};
}

Quad needle(Draw &d) {
  const Vector3 o = d.vector(1), a = d.vector(1), b = 1e-6 * d.vector(1);
  return {o, o + a, o + a + b, o + b + 1e-7 * d.vector(1)};
}

Quad triangle(Draw &d) { // one edge of length zero
  const Vector3 o = d.vector(1), a = d.vector(1), b = d.vector(1);
  return {o, o, o + a, o + b};
}

Quad line(Draw &d) { // no area
  const Vector3 o = d.vector(1), a = d.vector(1);
  return {o, o + d.number(-1, 1) * a, o + d.number(-1, 1) * a, o + d.number(-1, 1) * a};
}

Quad folded(Draw &d) { // corners 0 and 2 coincide
  const Vector3 o = d.vector(1), a = d.vector(1), b = d.vector(1);
  return {o, o + a, o, o + b};
}

Quad point(Draw &d) {
  const Vector3 o = d.vector(1);
  return {o, o, o, o};
}

class ClosestPointOfAnyQuad : public testing::TestWithParam<QuadKind> {};

// The found point lies on the quad, so its distance cannot be too small; the search, which itself stops at
// 1e-9, shows that it is not too large. Where it lies inside, the way to it is square to the surface, to
// round-off of the second derivatives.
TEST_P(ClosestPointOfAnyQuad, is_nowhere_beaten_by_a_search_and_square_to_the_surface) {
  Draw draw(7);
  for (int trial = 0; trial < 400; ++trial) {
    const Quad q = GetParam().make(draw);
    const ClosestPoint c = closest_point(q);
    expect_sound(q, c);
    ASSERT_LE(std::sqrt(c.distance_squared), searched_distance(q) + 1e-9) << trial;
    if (c.feature != Feature::face) continue;
    const Vector3 a = derivative_u(q, c.v), b = derivative_v(q, c.u);
    if (norm(cross(a, b)) < 1e-3 * norm(a) * norm(b)) continue; // at a fold the way is square to it alone
    EXPECT_LE(std::abs(dot(c.point, a)), 1e-13) << trial;
    EXPECT_LE(std::abs(dot(c.point, b)), 1e-13) << trial;
  }
}

INSTANTIATE_TEST_SUITE_P(quads, ClosestPointOfAnyQuad,
                         testing::Values(QuadKind{"any_warped", any_warped},
                                         QuadKind{"slightly_warped", slightly_warped},
                                         QuadKind{"flat_trapezoid", flat_trapezoid},
                                         QuadKind{"strained_trapezoid", strained_trapezoid},
                                         QuadKind{"flat_re_entrant", flat_re_entrant},
                                         QuadKind{"needle", needle}, QuadKind{"triangle", triangle},
                                         QuadKind{"line", line}, QuadKind{"folded", folded},
                                         QuadKind{"point", point}),
                         [](const auto &quad) { return quad.param.name; });

TEST(closest_point, weights_add_up_to_one_exactly) {
  Draw draw(3);
  for (int trial = 0; trial < 100000; ++trial) {
    const double u = std::pow(draw.number(0, 1), draw.number(0, 20)),
                 v = std::pow(draw.number(0, 1), draw.number(0, 20));
    const auto w = bilinear_weights(u, v);
    ASSERT_EQ(((w[0] + w[1]) + w[2]) + w[3], 1.0) << u << " " << v;
  }
}

TEST(closest_point, the_normal_of_a_quad_without_area_is_zero_and_never_not_a_number) {
  Draw draw(4);
  for (int trial = 0; trial < 200; ++trial) {
    EXPECT_EQ(norm(bilinear_normal(point(draw), 0.5, 0.5)), 0.0);
    for (const Quad &q : {triangle(draw), line(draw), folded(draw), needle(draw)})
      for (const double u : {0.0, 0.5, 1.0})
        for (const double v : {0.0, 0.5, 1.0}) {
          const double size = norm(bilinear_normal(q, u, v));
          EXPECT_TRUE(size == 0 || std::abs(size - 1) < 1e-14);
        }
  }
}

} // namespace
} // namespace platen::coupling::closest_point_test
