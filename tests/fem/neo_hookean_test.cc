// The law and the element that carries it.
#include "fem/materials/neo_hookean.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include <cmath>
#include <limits>
#include <random>

#include "fem/hyperelastic_cell.h"
#include "fem/solid_mesh.h"
#include "tests/fem/neo_hookean_point.h"

namespace platen::fem::neo_hookean_test {
namespace {

using Matrix24 = Eigen::Matrix<double, 24, 24, Eigen::RowMajor>;

class Random {
public:
  double operator()(double size) { return size * spread_(engine_); }
  Vector3 point(double size) { return {(*this)(size), (*this)(size), (*this)(size)}; }
  Tensor tensor(double size) {
    Tensor f = identity_tensor;
    for (double &x : f)
      x += (*this)(size);
    return f;
  }
  Corners corners(double size) {
    Corners c;
    for (Vector3 &p : c)
      p = point(size);
    return c;
  }

private:
  std::mt19937_64 engine_{7};
  std::uniform_real_distribution<double> spread_{-1, 1};
};

const std::vector<NeoHookean> laws = {NeoHookean::from_young(2.5, 0.0), NeoHookean::from_young(2.5, 0.3),
                                      NeoHookean::from_young(2.5, 0.4995)};

TEST(neo_hookean, small_strains_obey_hooke) {
  const double young = 3e6, poisson = 0.45, e = 1e-6;
  const NeoHookean law = NeoHookean::from_young(young, poisson);
  const Tensor tau = kirchhoff(law, {1 + e, 0, 0, 0, 1 - poisson * e, 0, 0, 0, 1 - poisson * e});
  EXPECT_NEAR(tau[0], young * e, 1e-5 * young * e); // second order in the strain, times kappa / E
  EXPECT_NEAR(tau[4], 0, 1e-5 * young * e);
  const Tensor shear = kirchhoff(law, {1, e, 0, 0, 1, 0, 0, 0, 1});
  EXPECT_NEAR(shear[1], young / (2 * (1 + poisson)) * e, 1e-9 * young * e);
}

TEST(neo_hookean, constants_out_of_range_are_refused) {
  EXPECT_THROW(NeoHookean::from_young(-1, 0.3), std::invalid_argument);
  EXPECT_THROW(NeoHookean::from_young(1, 0.5), std::invalid_argument);
  EXPECT_THROW(NeoHookean::from_young(1, -1), std::invalid_argument);
  EXPECT_THROW(NeoHookean::from_moduli(1, std::nan("")), std::invalid_argument);
  EXPECT_NEAR(NeoHookean::from_young(1, 0.4995).bulk_modulus, 1 / 0.003, 1e-9);
}

TEST(neo_hookean, inverted_is_known_before_the_law_is_asked) {
  EXPECT_FALSE(is_inverted(determinant(identity_tensor)));
  EXPECT_TRUE(is_inverted(determinant({-1, 0, 0, 0, 1, 0, 0, 0, 1})));
  EXPECT_TRUE(is_inverted(determinant({0, 0, 0, 0, 1, 0, 0, 0, 1})));
  EXPECT_TRUE(is_inverted(std::nan("")));
}

// ---- the element, on the cells of a tube: no two faces parallel
const SolidMesh &tube() {
  static const SolidMesh mesh = read_mesh(make_grid(Tube{1.0, 0.5, 0.0, 0.7, 7, 1, 1}));
  return mesh;
}

TEST(mean_dilatation, forces_and_stiffness_are_slopes_and_the_stiffness_is_symmetric) {
  Random random;
  const ReferenceCell &cell = tube().cells[2];
  const double h = 1e-5;
  for (const NeoHookean &law : laws) {
    const Corners u = random.corners(0.08);
    const CellForce at = cell_force(law, cell, u);
    const CellStiffness k = cell_stiffness(law, cell, u);
    for (std::size_t n = 0; n < 24; ++n) {
      Corners up = u, down = u;
      up[n / 3][n % 3] += h, down[n / 3][n % 3] -= h;
      const CellForce f_up = cell_force(law, cell, up), f_down = cell_force(law, cell, down);
      EXPECT_NEAR(at.force[n / 3][n % 3], (f_up.energy - f_down.energy) / (2 * h), 1e-7 * law.bulk_modulus);
      for (std::size_t m = 0; m < 24; ++m) {
        const double slope = (f_up.force[m / 3][m % 3] - f_down.force[m / 3][m % 3]) / (2 * h);
        EXPECT_NEAR(k[24 * m + n], slope, 1e-6 * law.bulk_modulus);
        EXPECT_NEAR(k[24 * m + n], k[24 * n + m], 1e-13 * law.bulk_modulus);
      }
    }
  }
}

// Six motions of a rigid cell are free, every other costs energy: no hourglass mode, however stiff the
// volume. The softest is some hundredths of the shear modulus times the cell's size.
TEST(mean_dilatation, only_rigid_motions_are_free) {
  for (const NeoHookean &law : laws)
    for (const ReferenceCell &cell :
         {tube().cells[0], read_mesh(make_grid(BoxPlate{{0, 0, 0}, {1, 1, 1}, {1, 1, 1}})).cells[0]}) {
      const CellStiffness k = cell_stiffness(law, cell, Corners{});
      const Eigen::SelfAdjointEigenSolver<Matrix24> solver{Matrix24(k.data())};
      for (Eigen::Index m = 0; m < 6; ++m)
        EXPECT_NEAR(solver.eigenvalues()[m], 0, 1e-12 * law.bulk_modulus);
      EXPECT_GT(solver.eigenvalues()[6], 0.02 * law.shear_modulus);
      // Volume is one number of the cell: one stiff mode, the rest is of the order of the shear modulus.
      EXPECT_LT(solver.eigenvalues()[22], 4 * law.shear_modulus);
    }
}

TEST(mean_dilatation, the_eigenvalue_bound_is_safe_and_close) {
  Random random;
  for (const NeoHookean &law : laws)
    for (int trial = 0; trial < 5; ++trial) {
      const ReferenceCell &cell = tube().cells[3];
      const CellStiffness k = cell_stiffness(law, cell, random.corners(0.1));
      Matrix24 scaled(k.data());
      for (Eigen::Index m = 0; m < 24; ++m)
        for (Eigen::Index n = 0; n < 24; ++n)
          scaled(m, n) /= std::sqrt(cell.node_volume[static_cast<std::size_t>(m / 3)] *
                                    cell.node_volume[static_cast<std::size_t>(n / 3)]);
      const double largest = Eigen::SelfAdjointEigenSolver<Matrix24>(scaled).eigenvalues()[23];
      const double bound = eigenvalue_bound(k, cell.node_volume);
      EXPECT_GE(bound, largest * (1 - 1e-12));
      EXPECT_LE(bound, 1.22 * largest);
    }
}

TEST(mean_dilatation, the_mean_stress_of_an_even_strain_is_that_of_the_law) {
  Random random;
  const Tensor f = random.tensor(0.2);
  const Corners place = tube().gather(4, tube().nodes);
  Corners u;
  for (std::size_t a = 0; a < 8; ++a)
    for (std::size_t i = 0; i < 3; ++i)
      u[a][i] =
          f[3 * i] * place[a][0] + f[3 * i + 1] * place[a][1] + f[3 * i + 2] * place[a][2] - place[a][i];
  const CellStress stress = cell_stress(laws[2], tube().cells[4], u);
  const Tensor tau = kirchhoff(laws[2], f);
  EXPECT_NEAR(stress.volume_ratio, determinant(f), 1e-13);
  for (std::size_t k = 0; k < 9; ++k)
    EXPECT_NEAR(stress.cauchy[k], tau[k] / determinant(f), 1e-11 * laws[2].bulk_modulus);
}

// ---- faces
FaceCorners warped() {
  return {Vector3{0.1, 0, 0.2}, {1, -0.1, -0.3}, {1.2, 0.9, 0.4}, {-0.2, 1.1, -0.1}};
}

TEST(follower_pressure, corner_areas_sum_to_the_area_vector) {
  const FaceCorners x = warped();
  Vector3 sum{};
  for (const Vector3 &area : corner_areas(x))
    sum = sum + area;
  EXPECT_LT(norm(sum - 0.5 * cross(x[2] - x[0], x[3] - x[1])), 1e-15);
}

// By a fine quadrature of the definition, which is exact to its own error 1e-6.
TEST(follower_pressure, corner_areas_are_those_of_the_shape_functions) {
  const FaceCorners x = warped(), areas = corner_areas(x);
  FaceCorners sum{};
  const int n = 400;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const double s = (i + 0.5) / n, t = (j + 0.5) / n;
      const Vector3 along = (1 - t) * (x[1] - x[0]) + t * (x[2] - x[3]);
      const Vector3 across = (1 - s) * (x[3] - x[0]) + s * (x[2] - x[1]);
      const Vector3 area = (1.0 / (n * n)) * cross(along, across);
      const std::array<double, 4> shape = {(1 - s) * (1 - t), s * (1 - t), s * t, (1 - s) * t};
      for (std::size_t k = 0; k < 4; ++k)
        sum[k] = sum[k] + shape[k] * area;
    }
  for (std::size_t k = 0; k < 4; ++k)
    EXPECT_LT(norm(sum[k] - areas[k]), 1e-5);
}

} // namespace
} // namespace platen::fem::neo_hookean_test
