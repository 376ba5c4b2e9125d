// One sphere on a block that yields: what gives way near the contact is counted once, wherever on whatever
// mesh it lies.
#include "tests/coupling/pressed_block.h"

#include <array>
#include <random>

#include "tests/elastic_nodes.h"

namespace platen::coupling {
namespace {

double hertz_secant(double a) {
  return hertz_force(a) / hertz_approach(a);
}

// Places in a face, as shares of its edge.
const std::vector<std::array<double, 2>> places = {{0, 0}, {0.5, 0}, {0.5, 0.5}, {0.1, 0.3}};

// Approach under Hertz's force over Hertz's approach. The contact is the secant of Hertz at that force (a
// linear spring can be Hertz at one force only), so that this is 1 if no compliance is missing or counted
// twice.
double share_of_hertz(PressedBlock &pressed, double h, double a, const std::array<double, 2> &place) {
  return hertz_force(a) / pressed.press(place[0] * h, place[1] * h, hertz_approach(a));
}

// 5 % are asked for, 1 % is reached, half of which is the end of the block 10 radii away.
TEST(pressed_block, yields_as_hertz_says_at_any_element_size) {
  for (const double h : {4 * radius, 2 * radius, radius, 0.5 * radius})
    for (const double a : {0.05 * radius, 0.1 * radius}) {
      PressedBlock pressed(graded_block(h, 10 * radius), 1, hertz_secant(a), true);
      for (const auto &place : places)
        EXPECT_NEAR(share_of_hertz(pressed, h, a, place), 1, 0.02)
            << h / radius << ' ' << a / radius << ' ' << place[0] << ' ' << place[1];
    }
}

TEST(pressed_block, yields_as_hertz_says_in_degree_two) {
  constexpr double h = 4 * radius, a = 0.1 * radius;
  PressedBlock pressed(graded_block(h, 10 * radius), 2, hertz_secant(a), true);
  for (const auto &place : places)
    EXPECT_NEAR(share_of_hertz(pressed, h, a, place), 1, 0.02) << place[0] << ' ' << place[1];
}

// What the tests above would say of a spring with the mesh's indentation on top: too soft, the more the finer
// the mesh, and three times as much on a vertex as in the middle of a face.
TEST(pressed_block, yields_twice_where_the_indentation_stays_in_the_spring) {
  constexpr double a = 0.1 * radius;
  double excess[2];
  for (const bool fine : {false, true}) {
    const double h = fine ? 0.5 * radius : radius;
    PressedBlock pressed(graded_block(h, 8 * radius), 1, hertz_secant(a), false);
    excess[fine] = share_of_hertz(pressed, h, a, places[0]) - 1;
    EXPECT_GT(excess[fine], 2 * (share_of_hertz(pressed, h, a, places[2]) - 1));
  }
  EXPECT_GT(excess[1], 0.4);
  EXPECT_GT(excess[1], 1.8 * excess[0]);
}

// Where the mesh alone gives way more than the contact should, nothing can be taken out; on the way there a
// spring is made stiffer by 1.85 at most. What the stable step is told covers any place in the face; an
// equilibrium is told of the whole contact.
TEST(pressed_block, makes_a_spring_stiffer_within_bounds) {
  constexpr double h = 0.5 * radius, overlap = 0.01 * radius;
  for (const double a : {0.05 * radius, 0.2 * radius}) {
    const double k = hertz_secant(a);
    PressedBlock pressed(graded_block(h, 4 * radius), 1, k, true);
    double largest = 0, smallest = std::numeric_limits<double>::infinity();
    for (const auto &place : places) {
      pressed.particles.position[0] = {place[0] * h, place[1] * h, radius - overlap};
      pressed.particles.force[0] = {};
      pressed.layer.make_list(pressed.particles, pressed.block);
      pressed.layer.add_forces(pressed.particles, pressed.block, 0);
      const double spring = pressed.particles.force[0].z / overlap;
      largest = std::max(largest, spring), smallest = std::min(smallest, spring);
      const auto bound = pressed.layer.ground_springs(pressed.particles, pressed.block);
      ASSERT_EQ(bound.size(), 1u);
      EXPECT_LE(spring, bound[0].normal_stiffness * (1 + 1e-12));
      const fem::VertexSprings vertices = pressed.layer.vertex_springs(pressed.particles, pressed.block);
      double sum = 0;
      for (const double stiffness : vertices.stiffness)
        sum += stiffness;
      EXPECT_LE(spring, sum * (1 + 1e-12));
      EXPECT_EQ(pressed.layer.ground_springs(pressed.particles, pressed.block, true)[0].normal_stiffness, k);
    }
    if (a < 0.1 * radius) {
      EXPECT_GT(smallest, 1.05 * k);
      EXPECT_LT(largest, 1.5 * k);
    } else { // on a vertex the indentation is .9 of the whole, in the middle of the face a third
      EXPECT_NEAR(smallest, k, 1e-9 * k);
      EXPECT_GT(largest, 1.4 * k);
      EXPECT_LE(largest, 1.85 * k);
    }
  }
}

// In-plane the vertices lie anywhere within a fifth of an edge of where they belong.
fem::Grid irregular_block(double h) {
  std::mt19937 engine(5);
  std::uniform_real_distribution<double> draw(-0.2 * h, 0.2 * h);
  return fem::moved_grid(graded_block(h, 6 * radius), [&](const Vector3 &p) {
    const Vector3 shift = {draw(engine), draw(engine), draw(engine)};
    const double inside = 3.01 * h;
    if (std::abs(p[0]) > inside || std::abs(p[1]) > inside || p[2] < -inside) return p;
    return p + Vector3{shift[0], shift[1], p[2] < 0 ? shift[2] : 0.0};
  });
}

// Dragged at a constant approach over edges and past vertices, in its own indentation all the way. Without
// the compliance taken out the force oscillates by 5 %.
TEST(pressed_block, feels_no_mesh_under_a_dragged_sphere) {
  constexpr double h = radius, a = 0.1 * radius;
  PressedBlock pressed(irregular_block(h), 1, hertz_secant(a), true);
  for (const double slope : {0.3, 1.0}) {
    double least = std::numeric_limits<double>::infinity(), most = 0;
    for (int n = 0; n <= 24; ++n) {
      const double x = (n / 12.0 - 1) * 1.2 * h;
      const double force = pressed.press(x, slope * x + 1e-5, hertz_approach(a));
      least = std::min(least, force), most = std::max(most, force);
      ASSERT_EQ(pressed.layer.contacts().size(), 1u) << x;
      // Along the face there is none but that of an indentation which the mesh cannot round.
      const Vector3 f = pressed.particles.force[0];
      ASSERT_LT(std::hypot(f.x, f.y), 0.005 * f.z) << x;
    }
    EXPECT_LT(most - least, 0.01 * most) << slope;
  }
}

// A strain that is the same everywhere leaves the face a plane, though no longer z = 0: force and normal are
// those of the plane to the round-off of places (1e-18 m) against the overlap (1e-5 m).
TEST(pressed_block, is_a_plane_to_a_sphere_where_it_is_evenly_strained) {
  PressedBlock pressed(graded_block(radius, 6 * radius), 1, 1e6, false);
  const auto strained = [](const Vector3 &p) {
    return Vector3{0.01 * p[0] + 0.02 * p[1], -0.01 * p[1], 0.02 * p[0] - 0.01 * p[1] + 0.03 * p[2]};
  };
  std::vector<Vector3> u;
  for (const Vector3 &node : pressed.block.model().nodes)
    u.push_back(strained(node));
  fem::set_deformation(pressed.block, u, {});
  // Normal of the plane that the face is in, from where it goes along x and y.
  const Vector3 along_x{1.01, 0, 0.02}, along_y{0.02, 0.99, -0.01};
  const Vector3 n = cross(along_x, along_y) / norm(cross(along_x, along_y));
  const double overlap = 0.01 * radius;
  for (int k = 0; k <= 600; ++k) {
    const double s = (k / 300.0 - 1) * 2.5 * radius;
    // Through vertices, then along an edge.
    const Vector3 closest = k % 2 == 0 ? s * along_x + s * along_y : s * along_x;
    pressed.particles.position[0] = closest + (radius - overlap) * n;
    pressed.particles.force[0] = {};
    pressed.block.clear_loads();
    pressed.layer.make_list(pressed.particles, pressed.block);
    pressed.layer.add_forces(pressed.particles, pressed.block, 0);
    ASSERT_EQ(pressed.layer.contacts().size(), 1u) << k;
    ASSERT_LT(norm(pressed.particles.force[0] - 1e6 * overlap * n), 1e-11 * 1e6 * overlap) << k;
  }
}

} // namespace
} // namespace platen::coupling
