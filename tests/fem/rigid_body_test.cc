#include "fem/rigid_body.h"
#include "base/pi.h"
#include "tests/same_state.h"
#include "tests/surface_sums.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <sstream>
#include <stdexcept>

namespace platen::fem {
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

TEST(rigid_body, vertex_velocities_are_those_of_the_motion) {
  RigidBody body = box();
  body.set_velocity({0.1, -0.2, 0.3}, {3, -2, 5});
  const std::vector<Vector3> velocities = body.surface().velocities, before = body.surface().vertices;
  const double h = 1e-6;
  body.drift(h);
  for (std::size_t v = 0; v < before.size(); ++v) { // difference quotient: error h w^2 r / 2 = 1e-6
    const Vector3 quotient = (1 / h) * (body.surface().vertices[v] - before[v]);
    EXPECT_LT(norm(quotient - velocities[v]), 2e-6);
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

TEST(rigid_body, state_comes_back_to_the_last_bit) {
  RigidBody body = box();
  body.set_velocity({0.1, -0.2, 0.3}, {3, -2, 5});
  for (int step = 0; step < 7; ++step)
    body.drift(1e-3 / 3);
  for (const int v : {20, 3, 11})
    body.add_surface_force(v, {1.0 / 3, 2.0 / 7 * v, -1e-9});
  RigidBody other = box();
  other.add_surface_force(5, {1, 1, 1}); // must be gone afterwards
  set_state(other, state_of(body));
  const auto same = [](const std::vector<Vector3> &a, const std::vector<Vector3> &b) {
    return std::memcmp(a.data(), b.data(), a.size() * sizeof(Vector3)) == 0;
  };
  EXPECT_TRUE(same_state(body, other));
  EXPECT_TRUE(same(other.surface().vertices, body.surface().vertices));
  EXPECT_TRUE(same(other.surface().velocities, body.surface().velocities));
  EXPECT_EQ(other.total_force(), body.total_force());
  EXPECT_EQ(other.contact_load(5), Vector3{});
  body.drift(1e-3), other.drift(1e-3);
  EXPECT_TRUE(same(other.surface().vertices, body.surface().vertices));
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

TEST(rigid_body, no_vertex_moves_farther_than_the_bound) {
  RigidBody body = box();
  body.set_velocity({0.1, -0.2, 0.3}, {3, -2, 5});
  const double bound = body.largest_move(0.01);
  const std::vector<Vector3> before = body.surface().vertices;
  body.drift(0.01);
  double largest = 0;
  for (std::size_t v = 0; v < before.size(); ++v)
    largest = std::max(largest, norm(body.surface().vertices[v] - before[v]));
  EXPECT_LE(largest, bound);
  EXPECT_GT(largest, 0.5 * bound);
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

// All fields that the pictures need stand in the file, which is the same for the same state.
TEST(rigid_body, the_picture_names_its_fields_and_repeats) {
  RigidBody body = box();
  body.add_surface_force(0, {0, 0, 1});
  std::ostringstream first, second;
  body.write_vtu(first);
  body.write_vtu(second, std::vector<double>(body.surface().vertices.size(), 0.0));
  for (const char *field :
       {"displacement", "contact_pressure", "contact_shear", "slip", "compressor=\"vtkZLib"})
    EXPECT_NE(first.str().find(field), std::string::npos) << field;
  EXPECT_EQ(first.str(), second.str());
  EXPECT_THROW(body.write_vtu(first, {1.0}), std::invalid_argument);
}

} // namespace
} // namespace platen::fem
