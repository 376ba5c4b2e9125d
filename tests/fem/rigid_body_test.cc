#include "fem/rigid_body.h"
#include "base/pi.h"
#include "tests/same_state.h"
#include "tests/surface_sums.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace platen::fem::rigid_body_test {
namespace {

constexpr Material steel{7850, 210e9, 0.3};

RigidBody box() {
  return RigidBody(make_grid(BoxPlate{{-0.02, -0.03, 0.1}, {0.04, 0.03, 0.11}, {3, 4, 2}}), steel);
}

double distance(const RigidBody &body, std::size_t a, std::size_t b) {
  return norm(body.surface().vertices[a] - body.surface().vertices[b]);
}

TEST(rigid_body, mass_is_density_times_volume) {
  const RigidBody body = box();
  const double volume = 0.06 * 0.06 * 0.01;
  EXPECT_NEAR(body.volume(), volume, 1e-14 * volume);
  EXPECT_NEAR(body.mass(), 7850 * volume, 1e-14 * 7850 * volume);
  EXPECT_NEAR(body.centre()[0], 0.01, 1e-14);
  EXPECT_NEAR(body.centre()[2], 0.105, 1e-14);
}

// A cuboid about z: I = m (a^2 + b^2) / 12.
TEST(rigid_body, kinetic_energy_is_that_of_a_cuboid) {
  RigidBody body = box();
  body.set_velocity({1, 2, 3}, {0, 0, 40});
  const double inertia = body.mass() * (0.06 * 0.06 + 0.06 * 0.06) / 12;
  const double expected = 0.5 * body.mass() * 14 + 0.5 * inertia * 1600;
  EXPECT_NEAR(body.kinetic_energy(), expected, 1e-13 * expected);
}

// A cuboid's inertia turns with it: spun about z after a quarter turn about x it is that about its own y.
TEST(rigid_body, inertia_turns_with_the_body) {
  RigidBody body(make_grid(BoxPlate{{0, 0, 0}, {1, 2, 3}, {1, 1, 1}}), steel);
  body.set_velocity({}, {std::acos(0.0), 0, 0});
  body.drift(1);
  body.set_velocity({}, {0, 0, 1});
  const double about_y = body.mass() * (1 + 9) / 12.0;
  EXPECT_NEAR(body.kinetic_energy(), 0.5 * about_y, 1e-12 * about_y);
}

// 10 000 drifts about a skew axis: lengths are kept to the round-off of one rotation, because vertices are
// placed from the reference and never from each other.
TEST(rigid_body, rigid_rotation_keeps_the_shape) {
  RigidBody body = box();
  const RigidBody start = box();
  body.set_velocity({0.1, -0.2, 0.3}, {3, -2, 5});
  for (int step = 0; step < 10000; ++step)
    body.drift(1e-3);
  const std::size_t n = body.surface().vertices.size();
  for (std::size_t v = 1; v < n; ++v)
    EXPECT_NEAR(distance(body, 0, v), distance(start, 0, v), 1e-15);
  EXPECT_NEAR(enclosed_volume(body.surface()), body.volume(), 1e-12 * body.volume());
}

// Angle after many exponentials against one: a full number of turns brings every vertex back. Round-off of
// 1e4 products of quaternions.
TEST(rigid_body, whole_turns_bring_every_vertex_back) {
  RigidBody body = box();
  const std::vector<Vector3> start = body.surface().vertices;
  const double rate = 2 * pi * 10;
  body.set_velocity({}, {rate / 3, 2 * rate / 3, 2 * rate / 3});
  for (int step = 0; step < 10000; ++step)
    body.drift(1e-4);
  for (std::size_t v = 0; v < start.size(); ++v)
    EXPECT_LT(norm(body.surface().vertices[v] - start[v]), 1e-13);
}

// A difference quotient over 1e-6 s: error h w^2 r / 2 = 1e-6.
TEST(rigid_body, vertices_move_by_their_velocities_and_no_farther_than_the_bound) {
  for (const double h : {1e-6, 0.01}) {
    RigidBody body = box();
    body.set_velocity({0.1, -0.2, 0.3}, {3, -2, 5});
    const std::vector<Vector3> velocities = body.surface().velocities, before = body.surface().vertices;
    const double bound = body.largest_move(h);
    body.drift(h);
    double largest = 0;
    for (std::size_t v = 0; v < before.size(); ++v) {
      const Vector3 path = body.surface().vertices[v] - before[v];
      if (h == 1e-6) {
        EXPECT_LT(norm(path / h - velocities[v]), 2e-6);
      }
      largest = std::max(largest, norm(path));
    }
    EXPECT_LE(largest, bound);
    EXPECT_GT(largest, 0.5 * bound);
  }
}

TEST(rigid_body, a_translated_face_stays_flat_to_the_last_bit) {
  RigidBody body = box();
  body.set_velocity({0, 0, -0.0123});
  for (int step = 0; step < 1000; ++step)
    body.drift(1e-7 / 3);
  for (std::size_t f = 0; f < body.surface().faces.size(); ++f) {
    if (body.surface().face_tags[f] != low_end_tag) continue;
    for (const int v : body.surface().faces[f])
      EXPECT_EQ(body.surface().vertices[static_cast<std::size_t>(v)][2], 0.1 + body.displacement()[2]);
  }
}

// Power of the loads = force . velocity + moment . angular velocity for a rigid body.
TEST(rigid_body, load_power_is_force_times_velocity_plus_moment_times_spin) {
  RigidBody body = box();
  body.set_velocity({0.4, -0.2, 0.3}, {3, -2, 5});
  body.add_surface_force(3, {10, 20, -30});
  body.add_surface_force(17, {-5, 1, 2});
  body.add_surface_force(3, {1, 1, 1});
  EXPECT_EQ(body.contact_load(3), (Vector3{11, 21, -29}));
  const double power =
      dot(body.total_force(), body.velocity()) + dot(body.moment(body.centre()), body.angular_velocity());
  EXPECT_NEAR(load_power(body), power, 1e-13 * std::abs(power));
  const Vector3 shifted = body.moment({1, 2, 3}) - body.moment({});
  EXPECT_LT(norm(shifted - cross(Vector3{-1, -2, -3}, body.total_force())), 1e-13);
  body.clear_loads();
  EXPECT_EQ(body.total_force(), Vector3{});
  EXPECT_EQ(body.contact_load(3), Vector3{});
}

TEST(rigid_body, a_state_of_another_body_is_refused) {
  RigidBody body = box();
  EXPECT_THROW(set_state(body, State()), StateError);
  RigidBody finer(make_grid(BoxPlate{{0, 0, 0}, {1, 1, 1}, {20, 20, 2}}), {1, 1, 0.3});
  finer.add_surface_force(static_cast<int>(finer.surface().vertices.size()) - 1, {1, 0, 0});
  EXPECT_THROW(set_state(body, state_of(finer)), StateError);
  EXPECT_EQ(body.total_force(), Vector3{});
}

TEST(rigid_body, impossible_materials_are_refused) {
  const Grid grid = make_grid(BoxPlate{{0, 0, 0}, {1, 1, 1}, {1, 1, 1}});
  EXPECT_THROW(RigidBody(grid, {0, 1e9, 0.2}), std::invalid_argument);
  EXPECT_THROW(RigidBody(grid, {1, -1e9, 0.2}), std::invalid_argument);
  EXPECT_THROW(RigidBody(grid, {1, 1e9, 0.5}), std::invalid_argument);
  EXPECT_THROW(RigidBody(grid, {1, std::nan(""), 0.2}), std::invalid_argument);
}

// Consistent loads of an even pressure with an even shear on one face give that pressure and shear at every
// vertex of it, at its rim and corners too, and nothing elsewhere.
TEST(rigid_body, an_even_load_is_an_even_pressure_up_to_the_rim) {
  for (const bool disc : {false, true}) {
    RigidBody body = disc ? RigidBody(make_grid(CylinderPlate{0.03, 0.01, 0, 9, 2}), steel) : box();
    const double pressure = 3e6;
    const Vector3 shear = {1e6, -5e5, 0};
    std::vector<char> on_top(body.surface().vertices.size(), 0);
    double area = 0;
    for (std::size_t f = 0; f < body.surface().faces.size(); ++f) {
      if (body.surface().face_tags[f] != high_end_tag) continue;
      const Vector3 a = face_area_vector(body.surface(), f);
      area += a[2];
      for (const int v : body.surface().faces[f]) {
        body.add_surface_force(v, 0.25 * (a[2] * shear - pressure * a));
        on_top[static_cast<std::size_t>(v)] = 1;
      }
    }
    const std::vector<RigidBody::Traction> tractions = body.contact_tractions();
    double sum = 0;
    for (std::size_t v = 0; v < tractions.size(); ++v) {
      EXPECT_NEAR(tractions[v].pressure, on_top[v] ? pressure : 0, 1e-9 * pressure);
      EXPECT_LT(norm(tractions[v].shear - (on_top[v] ? 1.0 : 0.0) * shear), 1e-9 * pressure);
      sum += tractions[v].pressure * norm(tractions[v].area);
    }
    EXPECT_NEAR(sum, pressure * area, 1e-12 * pressure * area);
    EXPECT_NEAR(body.total_force()[2], -pressure * area, 1e-12 * pressure * area);
  }
}

} // namespace
} // namespace platen::fem::rigid_body_test
