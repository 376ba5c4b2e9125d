// Surface and refusals of a solid at finite strain.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/fem/rubber_sleeve.h"

namespace platen::fem {
namespace {

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

} // namespace
} // namespace platen::fem
