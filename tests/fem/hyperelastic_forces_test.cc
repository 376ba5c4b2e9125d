// Mass, internal forces, pressure and surface of a solid at finite strain, and what it refuses.
#include <gtest/gtest.h>

#include <cmath>

#include "base/pi.h"
#include "tests/fem/rubber_sleeve.h"
#include "tests/fem/tangent.h"

namespace platen::fem::hyperelastic_forces_test {
namespace {

TEST(hyperelastic_solid, mass_is_density_times_volume) {
  const HyperelasticSolid solid = sleeve();
  const double volume = 8 * std::sin(pi / 8) * (0.055 * 0.055 - 0.05 * 0.05) * 0.06;
  EXPECT_NEAR(solid.volume(), volume, 1e-13 * volume);
  double sum = 0;
  for (const double m : solid.nodal_mass())
    sum += m;
  EXPECT_NEAR(sum, 1100 * volume, 1e-13 * 1100 * volume);
}

// Energy in mu V: round-off of 1 - 1; forces in mu A: the bulk modulus is 50 mu.
TEST(hyperelastic_solid, a_rotation_by_any_angle_stores_nothing) {
  HyperelasticSolid solid = sleeve();
  solid.set_displacement(turned_places(solid, std::vector<Vector3>(solid.mesh().nodes.size())));
  const double mu = rubber.law.shear_modulus;
  EXPECT_LT(std::abs(solid.internal_energy()), 1e-14 * mu * solid.volume());
  EXPECT_LT(largest(solid.internal_forces()), 1e-12 * mu * 1e-4);
}

TEST(hyperelastic_solid, forces_and_pressure_turn_with_the_solid) {
  HyperelasticSolid solid = sleeve();
  solid.set_pressure(mantle_tag, 1e5);
  solid.set_displacement(bent(solid));
  const std::vector<Vector3> inner = solid.internal_forces(), pressed = solid.pressure_forces();
  const double energy = solid.internal_energy(), size = largest(inner);
  solid.set_displacement(turned_places(solid, bent(solid)));
  EXPECT_NEAR(solid.internal_energy(), energy, 1e-12 * energy);
  for (std::size_t n = 0; n < inner.size(); ++n) {
    EXPECT_LT(norm(solid.internal_forces()[n] - turned(inner[n])), 1e-11 * size);
    EXPECT_LT(norm(solid.pressure_forces()[n] - turned(pressed[n])), 1e-11 * size);
  }
}

TEST(hyperelastic_solid, the_tangent_with_pressure_is_the_slope_of_the_forces) {
  HyperelasticSolid solid = sleeve();
  solid.set_pressure(mantle_tag, 2e6), solid.set_pressure(inner_tag, 5e5);
  const std::vector<Vector3> u = bent(solid, 0.002), d = random_field(u.size(), 1);
  solid.set_displacement(u);
  const Eigen::VectorXd k = tangent_of(solid) * as_column(d);
  const double h = 1e-8, size = k.cwiseAbs().maxCoeff();
  const auto forces = [&](double step) {
    std::vector<Vector3> place = u;
    for (std::size_t n = 0; n < u.size(); ++n)
      place[n] = u[n] + step * d[n];
    solid.set_displacement(place);
    std::vector<Vector3> f = solid.internal_forces();
    for (std::size_t n = 0; n < f.size(); ++n)
      f[n] = f[n] - solid.pressure_forces()[n];
    return as_column(f);
  };
  EXPECT_LT((k - (forces(h) - forces(-h)) / (2 * h)).cwiseAbs().maxCoeff(), 1e-6 * size);
}

double current_volume(const HyperelasticSolid &solid) {
  double volume = 0;
  const std::vector<CellStress> cells = solid.cell_stresses();
  for (std::size_t c = 0; c < cells.size(); ++c)
    volume += solid.mesh().cells[c].volume * cells[c].volume_ratio;
  return volume;
}

// All four sides pressed alike: the surface is closed.
HyperelasticSolid pressed_all_around(double pressure) {
  HyperelasticSolid solid = sleeve();
  for (const int tag : {mantle_tag, inner_tag, low_end_tag, high_end_tag})
    solid.set_pressure(tag, pressure);
  solid.update_forces();
  return solid;
}

// Of a solid, and of the pressure on a closed surface.
TEST(hyperelastic_solid, internal_forces_and_pressure_have_no_sum_and_no_moment) {
  HyperelasticSolid solid = pressed_all_around(1e6);
  solid.set_displacement(bent(solid));
  for (const auto *all : {&solid.internal_forces(), &solid.pressure_forces()}) {
    Vector3 sum{}, moment{};
    double forces = 0;
    for (std::size_t n = 0; n < all->size(); ++n) {
      sum += (*all)[n], moment += cross(solid.node_place(static_cast<int>(n)), (*all)[n]);
      forces += norm((*all)[n]);
    }
    const double round_off = all == &solid.internal_forces() ? 1e-13 : 1e-14;
    EXPECT_LT(norm(sum), round_off * forces);
    EXPECT_LT(norm(moment), round_off * forces * 0.08);
  }
}

// Work of the drifts = -p (V after - V before), V from the cells: another integral of the same trilinear
// geometry. Exact for one long drift, where the trapezoidal rule is off by percents.
TEST(hyperelastic_solid, pressure_does_the_work_p_dv) {
  const double p = 1e6;
  HyperelasticSolid solid = pressed_all_around(p);
  const double before = current_volume(solid);
  set_velocity(solid, bent(solid));
  solid.drift(1);
  const double first = current_volume(solid);
  EXPECT_GT(std::abs(first - before), 1e-3 * before);
  EXPECT_NEAR(solid.pressure_work(), -p * (first - before), 1e-10 * p * std::abs(first - before));
  for (int step = 0; step < 50; ++step)
    solid.drift(-0.013);
  const double last = current_volume(solid);
  EXPECT_NEAR(solid.pressure_work(), -p * (last - before), 1e-10 * p * std::abs(first - before));
}

// On the inner face alone, ends in their planes: the same with the volume inside the tube.
TEST(hyperelastic_solid, pressure_inside_a_tube_does_the_work_of_its_lumen) {
  HyperelasticSolid solid = sleeve();
  const double share = 8 * std::sin(pi / 8);
  EXPECT_NEAR(solid.enclosed_volume(inner_tag), share * 0.05 * 0.05 * 0.06, 1e-17);
  EXPECT_NEAR(solid.enclosed_volume(mantle_tag), share * 0.055 * 0.055 * 0.06, 1e-17);
  solid.set_pressure(inner_tag, 1e5);
  solid.update_forces();
  std::vector<Vector3> v = bent(solid);
  for (std::size_t n = 0; n < v.size(); ++n) {
    const double z = solid.mesh().nodes[n][2];
    if (z < 1e-9 || z > 0.06 - 1e-9) v[n][2] = 0;
  }
  set_velocity(solid, v);
  const double before = solid.enclosed_volume(inner_tag);
  solid.drift(1);
  const double change = solid.enclosed_volume(inner_tag) - before;
  EXPECT_NEAR(solid.pressure_work(), 1e5 * change, 1e-10 * 1e5 * std::abs(change));
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

} // namespace
} // namespace platen::fem::hyperelastic_forces_test
