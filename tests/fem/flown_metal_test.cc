// Metal that has flown to another shape: its stiffness, its step and what a state keeps of it.
#include <gtest/gtest.h>

#include <Eigen/Dense>

#include <cmath>
#include <string>
#include <utility>

#include "fem/materials/logarithmic_strain.h"
#include "tests/fem/metal.h"
#include "tests/fem/rubber_sleeve.h"

namespace platen::fem::flown_metal_test {
namespace {

using Matrix3 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

Matrix3 sheared_and_stretched(double volume) {
  Matrix3 f;
  f << 1.3, 0.2, 0.1, -0.1, 0.9, 0.3, 0.2, -0.1, 1.1;
  return std::cbrt(volume / f.determinant()) * f;
}

// Of one that has flown to another shape and has no elastic strain there.
TEST(j2_metal, the_stiffness_of_an_element_is_the_derivative_of_its_forces) {
  const SolidMesh mesh = read_mesh(distorted_grid());
  const J2Plasticity law{ductile_steel.law.shear_modulus, lines({{0, 1e12}})};
  const Matrix3 f = sheared_and_stretched(1), metric = (f.transpose() * f).inverse();
  PlasticPoints flown, after;
  for (int i = 0; i < 3; ++i)
    for (int k = i; k < 3; ++k)
      flown.metric[static_cast<std::size_t>(symmetric_index[i][k])].fill(metric(i, k));
  const Corners way = corners_of(random_field(8, 1, 5));
  const auto forces = [&](double h) {
    Corners moved = mesh.gather(0, mesh.nodes);
    for (std::size_t a = 0; a < 8; ++a) {
      const Eigen::Vector3d x(moved[a].x, moved[a].y, moved[a].z), u = f * x - x;
      moved[a] = Vector3{u[0], u[1], u[2]} + h * way[a];
    }
    const CellForce found = cell_force(ductile_steel.law, law, mesh.cells[0], moved, flown, after);
    return std::pair{moved, found.force};
  };
  const CellStiffness k = cell_stiffness(ductile_steel.law, mesh.cells[0], forces(0).first, &flown);
  const double h = 1e-8; // m, of 1 cm
  const Corners up = forces(h).second, down = forces(-h).second;
  double size = 0, error = 0; // N/m
  for (std::size_t m = 0; m < 24; ++m) {
    double row = 0;
    for (std::size_t n = 0; n < 24; ++n)
      row += k[24 * m + n] * way[n / 3][n % 3];
    size = std::max(size, std::abs(row));
    error = std::max(error, std::abs(row - (up[m / 3][m % 3] - down[m / 3][m % 3]) / (2 * h)));
  }
  EXPECT_LT(error, 1e-6 * size);
}

// It steps as one that was made in the shape that it has flown to.
TEST(j2_metal, a_solid_that_has_flown_far_has_the_step_of_its_new_shape) {
  const Matrix3 f = sheared_and_stretched(1);
  HyperelasticSolid flown = distorted_block(lines({{0, 1e6}}));
  deform(flown, f);
  const HyperelasticSolid made(moved_grid(distorted_grid(),
                                          [&](const Vector3 &p) {
                                            const Eigen::Vector3d x = f * Eigen::Vector3d(p.x, p.y, p.z);
                                            return Vector3{x[0], x[1], x[2]};
                                          }),
                               ductile_steel);
  EXPECT_NEAR(flown.stable_step() / made.stable_step(), 1, 1e-4);
}

TEST(j2_metal, a_place_that_was_only_tried_leaves_nothing) {
  HyperelasticSolid solid = distorted_block(curved);
  const std::vector<Vector3> none(solid.mesh().nodes.size());
  solid.set_displacement(random_field(none.size(), 4e-4, 7));
  EXPECT_GT(solid.plastic_work(), 0);
  solid.set_displacement(none);
  solid.yield_here();
  solid.set_displacement(none);
  EXPECT_EQ(largest(solid.internal_forces()), 0);
}

// Without elastic strain the metric is J^(2/3) F^-1 F^-T.
TEST(j2_metal, a_state_names_the_metric_of_what_has_flown) {
  HyperelasticSolid solid = distorted_block(lines({{0, 1e4}}));
  const Matrix3 f = sheared_and_stretched(1.01);
  const Matrix3 metric = std::pow(1.01, 2.0 / 3) * (f.transpose() * f).inverse();
  deform(solid, f);
  solid.yield_here();
  const State state = state_of(solid);
  const char *const axes = "xyz";
  for (int i = 0; i < 3; ++i)
    for (int k = i; k < 3; ++k) {
      std::string pair{axes[i], axes[k]};
      if (pair == "xz") pair = "zx";
      for (const double found : rows_of<double>(state, "state/plastic_metric_" + pair))
        EXPECT_NEAR(found, metric(i, k), 1e-6) << pair;
    }
  for (const char *name : {"plastic_metric_xx", "plastic_metric_yy", "plastic_metric_zz", "plastic_strain"}) {
    const std::string block = std::string("state/") + name;
    std::vector<double> rows = rows_of<double>(state, block);
    rows[3] = -1e-3;
    EXPECT_THROW(set_state(solid, with_rows(state, block, rows)), StateError) << name;
  }
}

} // namespace
} // namespace platen::fem::flown_metal_test
