// State, surface and picture of a solid at finite strain.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <sstream>

#include "base/parallel.h"
#include "tests/fem/rubber_sleeve.h"
#include "tests/same_state.h"

namespace platen::fem {
namespace {

bool same(const std::vector<Vector3> &a, const std::vector<Vector3> &b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Vector3)) == 0;
}

TEST(hyperelastic_solid, a_resumed_run_is_the_same_to_the_last_bit) {
  HyperelasticSolid one = held_sleeve(2e4), other = held_sleeve(0);
  one.set_damping(50), other.set_damping(50);
  const double dt = 0.5 * one.stable_step();
  one.set_prescribed_velocity(1, {0, 0, -0.3}, {0.1, 0.2, 5}, {0, 0, 0.06});
  step(one, dt, 40);
  one.add_surface_force(3, {1, -2, 0.5});
  step(one, dt, 7);
  set_state(other, state_of(one));
  EXPECT_TRUE(same_state(one, other));
  EXPECT_TRUE(same(one.surface().vertices, other.surface().vertices));
  EXPECT_TRUE(same(one.surface().velocities, other.surface().velocities));
  step(one, dt, 40), step(other, dt, 40);
  EXPECT_TRUE(same_state(one, other));
  EXPECT_EQ(one.internal_energy(), other.internal_energy());
  EXPECT_THROW(set_state(other, State()), StateError);
}

TEST(hyperelastic_solid, the_number_of_threads_changes_no_bit) {
  State state[2];
  double energy[2], limit[2];
  for (const int threads : {1, 2}) {
    const ThreadLimit fixed(threads);
    HyperelasticSolid solid = held_sleeve(2e4);
    limit[threads - 1] = solid.stable_step();
    step(solid, 0.5 * limit[threads - 1], 50);
    state[threads - 1] = state_of(solid), energy[threads - 1] = solid.internal_energy();
  }
  EXPECT_TRUE(same_state(state[0], state[1]));
  EXPECT_EQ(energy[0], energy[1]);
  EXPECT_EQ(limit[0], limit[1]);
}

// Only the inner face is seen, and it looks at the axis; loads come back as tractions.
TEST(hyperelastic_solid, particles_see_the_inner_face_alone) {
  HyperelasticSolid solid = sleeve();
  const SurfaceMesh &surface = solid.surface();
  EXPECT_EQ(surface.faces.size(), 16u * 6);
  EXPECT_EQ(surface.vertices.size(), 16u * 7);
  for (std::size_t f = 0; f < surface.faces.size(); ++f) {
    const Vector3 at = surface.vertices[static_cast<std::size_t>(surface.faces[f][0])],
                  area = face_area_vector(surface, f);
    EXPECT_EQ(surface.face_tags[f], inner_tag);
    EXPECT_LT(at[0] * area[0] + at[1] * area[1], 0);
    for (const int v : surface.faces[f])
      solid.add_surface_force(v, -0.25 * 7e4 * area);
  }
  for (std::size_t v = 0; v < surface.vertices.size(); ++v) {
    EXPECT_LT(norm(surface.vertices[v] - solid.node_place(solid.surface_node(static_cast<int>(v)))), 1e-18);
    EXPECT_NEAR(solid.contact_tractions()[v].pressure, 7e4, 1e-8);
    EXPECT_LT(norm(solid.contact_tractions()[v].shear), 1e-8);
  }
  EXPECT_LT(norm(solid.total_force()), 1e-11);
  EXPECT_LT(norm(solid.moment({1, 2, 3})), 1e-11);
  set_velocity(solid, std::vector<Vector3>(solid.mesh().nodes.size(), Vector3{0, 0, 2}));
  EXPECT_EQ(surface.velocities[5], (Vector3{0, 0, 2}));
  EXPECT_EQ(solid.largest_move(0.5), 1);
  EXPECT_THROW(sleeve(rubber, {77}), std::invalid_argument);
}

TEST(hyperelastic_solid, senseless_requests_are_refused) {
  HyperelasticSolid solid = sleeve();
  const std::vector<int> end = solid.nodes_of(low_end_tag);
  solid.prescribe(end, {false, false, true});
  EXPECT_THROW(solid.prescribe(end, {true, true, true}), std::invalid_argument);
  EXPECT_EQ(solid.prescribe(end, {true, true, false}), 1);
  EXPECT_THROW(solid.prescribe({}, {true, true, true}), std::invalid_argument);
  EXPECT_THROW(solid.set_pressure(3, 1e5), std::invalid_argument);
  EXPECT_THROW(solid.set_pressure(mantle_tag, std::nan("")), std::invalid_argument);
  EXPECT_THROW(solid.set_prescribed_velocity(2, {}), std::invalid_argument);
  EXPECT_THROW(solid.set_damping(-1), std::invalid_argument);
  EXPECT_THROW(sleeve({0, rubber.law}), std::invalid_argument);
  EXPECT_THROW(sleeve({1100, {1e6, -1}}), std::invalid_argument);
}

TEST(hyperelastic_solid, the_picture_names_its_fields_and_repeats) {
  HyperelasticSolid solid = sleeve();
  solid.set_displacement(bent(solid));
  std::ostringstream first, second;
  solid.write_vtu(first);
  solid.write_vtu(second, std::vector<double>(solid.surface().vertices.size(), 0.0));
  for (const char *field : {"\"displacement\"", "\"stress\"", "\"von_mises\"", "\"pressure\"", "\"J\"",
                            "\"contact_pressure\"", "\"contact_shear\"", "\"slip\"", "compressor=\"vtkZLib"})
    EXPECT_NE(first.str().find(field), std::string::npos) << field;
  EXPECT_EQ(first.str(), second.str());
  EXPECT_THROW(solid.write_vtu(first, {1.0}), std::invalid_argument);
}

} // namespace
} // namespace platen::fem
