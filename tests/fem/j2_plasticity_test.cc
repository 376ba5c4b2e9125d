// Metal that yields: the law, and the element that carries it.
#include "fem/materials/j2_plasticity.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <Eigen/Eigenvalues>

#include <cmath>
#include <limits>

#include "fem/hyperelastic_cell.h"
#include "fem/materials/logarithmic_strain.h"
#include "tests/fem/metal.h"
#include "tests/fem/rubber_sleeve.h"

namespace platen::fem::j2_plasticity_test {
namespace {

using Matrix3 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

Matrix3 full(const Symmetric<double> &a) {
  Matrix3 m;
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k)
      m(i, k) = a[symmetric_index[i][k]];
  return m;
}

Symmetric<double> strain_of(double size) {
  Symmetric<double> e;
  const double parts[6] = {0.31, -0.52, 0.17, 0.23, -0.41, 0.36};
  for (int k = 0; k < 6; ++k)
    e[k] = size * parts[k];
  return e;
}

TEST(logarithmic_strain, agrees_with_principal_values) {
  for (const double size : {1e-6, 1e-3, 0.03}) {
    const Symmetric<double> e = strain_of(size);
    const Eigen::SelfAdjointEigenSolver<Matrix3> principal(full(e));
    const Matrix3 axes = principal.eigenvectors();
    const Matrix3 exact =
        axes * (2 * principal.eigenvalues()).array().exp().matrix().asDiagonal() * axes.transpose();
    Symmetric<double> b, back;
    exponential_of_twice(e, b);
    half_logarithm(b, back);
    EXPECT_LT((full(b) - exact).norm(), 1e-15 * exact.norm());
    EXPECT_LT((full(back) - full(e)).norm(), 4e-16 + 1e-15 * size);
  }
}

// At 10 % of strain the series still have eleven digits.
TEST(logarithmic_strain, holds_far_beyond_what_metals_reach) {
  const Symmetric<double> e = strain_of(0.1);
  Symmetric<double> b, back;
  exponential_of_twice(e, b);
  half_logarithm(b, back);
  EXPECT_LT((full(back) - full(e)).norm(), 1e-11);
  EXPECT_NEAR(full(b).determinant(), std::exp(2 * full(e).trace()), 1e-11);
}

// Of odd series up to the ninth power: 1/11 e^11 of artanh, 1382/155925 e^11 of tanh.
TEST(logarithmic_strain, is_wrong_by_the_next_term_of_its_series) {
  for (const double x : {0.1, 0.2}) {
    const double next = std::pow(x, 11);
    Symmetric<double> e{{x, -x, 0, 0, 0, 0}}, b{{std::exp(2 * x), std::exp(-2 * x), 1, 0, 0, 0}}, found;
    half_logarithm(b, found);
    EXPECT_NEAR(found[0], x, next / 11 + 1e-15);
    exponential_of_twice(e, found);
    EXPECT_NEAR(0.5 * std::log(found[0]), x, 1382.0 / 155925 * 1.1 * next + 1e-15);
  }
}

TEST(j2_plasticity, the_flow_stress_is_lines_and_a_part_that_saturates) {
  const Hardening::Flow at = curved.at(0.013);
  const double line = 300e6 + (360e6 - 300e6) * (0.013 - 0.01) / (0.05 - 0.01);
  EXPECT_NEAR(at.stress, line + 90e6 * (1 - std::exp(-40 * 0.013)), 1e-6);
  EXPECT_NEAR(at.slope, 60e6 / 0.04 + 90e6 * 40 * std::exp(-40 * 0.013), 1e-3);
  EXPECT_EQ(lines({{0, 1}, {1, 1}, {2, 3}}).at(1).slope, 2); // at a kink that of what follows
  EXPECT_NEAR(curved.at(0.2).stress, 360e6 + 90e6 * (1 - std::exp(-8.0)), 1e-6);
  double work = 0; // by Simpson's rule between the kinks
  for (const auto &[from, to] : {std::pair{0.0, 0.01}, {0.01, 0.05}, {0.05, 0.2}}) {
    const int parts = 2000;
    const double h = (to - from) / parts;
    for (int k = 0; k < parts; ++k)
      work += h / 6 *
              (curved.at(from + k * h).stress + 4 * curved.at(from + (k + 0.5) * h).stress +
               curved.at(from + (k + 1) * h).stress);
  }
  EXPECT_NEAR(curved.at(0.2).work / work, 1, 1e-10);
  EXPECT_EQ(lines({{0, 250e6}}, 90e6, 0).at(0.2).work, 250e6 * 0.2);
}

TEST(j2_plasticity, returns_to_the_yield_surface) {
  const J2Plasticity law{ductile_steel.law.shear_modulus, curved};
  for (const double before : {0.0, 0.004, 0.03, 0.3})
    for (const double beyond : {1e-9, 1e-4, 0.02, 0.4}) {
      const double trial = curved.at(before).stress / (3 * law.shear_modulus) + beyond;
      const auto after = law(trial, before);
      EXPECT_GT(after.plastic_strain, before);
      const double q = 3 * law.shear_modulus * trial * after.share;
      EXPECT_NEAR(q / curved.at(after.plastic_strain).stress, 1, 1e-12);
      EXPECT_NEAR(trial * (1 - after.share), after.plastic_strain - before, 1e-14);
    }
  const auto elastic = law(0.9999 * 300e6 / (3 * law.shear_modulus), 0);
  EXPECT_EQ(elastic.share, 1);
  EXPECT_EQ(elastic.plastic_strain, 0);
}

// Linear hardening has a closed form: da = (q - k) / (3 mu + H).
TEST(j2_plasticity, linear_hardening_returns_in_closed_form) {
  const double hard = 2e9, mu = ductile_steel.law.shear_modulus;
  const J2Plasticity law{mu, lines({{0, 250e6}, {1, 250e6 + hard}})};
  const double trial = 0.004, before = 0.02;
  const double more = (3 * mu * trial - 250e6 - hard * before) / (3 * mu + hard);
  EXPECT_NEAR(law(trial, before).plastic_strain, before + more, 1e-15);
  EXPECT_NEAR(law(trial, before).share, 1 - more / trial, 1e-13);
}

// Flat, steep, flat: Newton's method alone goes to and fro between the flat parts.
TEST(j2_plasticity, returns_to_a_steep_part_between_flat_ones) {
  const J2Plasticity law{1.0 / 3, lines({{0, 1}, {1, 1}, {2, 11}})};
  EXPECT_NEAR(law(7.5, 0).plastic_strain, 1.5, 1e-13); // 7.5 - 1.5 = 1 + 10 x .5
}

Eigen::Matrix<double, 6, 1> stress_of(const J2Plasticity &law, const Eigen::Matrix<double, 6, 1> &strain,
                                      double before) {
  const Symmetric<double> e{{strain[0], strain[1], strain[2], strain[3], strain[4], strain[5]}}; // a deviator
  const double trial = std::sqrt(2.0 / 3.0) * full(e).norm();
  return 2 * law.shear_modulus * law(trial, before).share * strain;
}

TEST(j2_plasticity, the_tangent_is_the_derivative_of_the_return) {
  const J2Plasticity law{ductile_steel.law.shear_modulus, curved};
  Eigen::Matrix<double, 6, 1> at, way;
  at << 3e-3, -1e-3, -2e-3, 1.5e-3, -4e-4, 2.2e-3;
  way << -1, 3, -2, 0.7, 1.9, -0.4;
  const auto product = [](const auto &a, const auto &b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + 2 * (a[3] * b[3] + a[4] * b[4] + a[5] * b[5]);
  };
  const double size = std::sqrt(product(at, at)), trial = std::sqrt(2.0 / 3.0) * size;
  for (const double before : {0.0, 0.02}) {
    const auto tangent = law.tangent(trial, before);
    const double part = product(at, way) / (size * size);
    const Eigen::Matrix<double, 6, 1> expected =
        tangent.across * (way - part * at) + tangent.along * part * at;
    const double h = 1e-8;
    const Eigen::Matrix<double, 6, 1> found =
        (stress_of(law, at + h * way, before) - stress_of(law, at - h * way, before)) / (2 * h);
    EXPECT_LT((found - expected).norm(), 1e-6 * expected.norm());
  }
  EXPECT_EQ(law.tangent(1e-4, 0).along, 2 * law.shear_modulus);
}

// A bar under a uniaxial Kirchhoff stress: Newton's method in axial and lateral strain with the tangent.
TEST(j2_plasticity, newtons_method_converges_quadratically) {
  const J2Plasticity law{ductile_steel.law.shear_modulus, lines({{0, 250e6}}, 200e6, 30)};
  const double mu = law.shear_modulus, axial = 0.03;
  double lateral = -0.012; // of the deviator and of J: volume ln J = axial + 2 lateral
  std::vector<double> residual;
  for (int k = 0; k < 8; ++k) {
    const double deviator = 2.0 / 3.0 * (axial - lateral); // axial part, the lateral ones minus half
    const auto after = law(deviator, 0.0);
    const double volume = std::exp(axial + 2 * lateral), kappa = ductile_steel.law.bulk_modulus;
    const double stress = -mu * after.share * deviator + volume * ductile_steel.law.volume_stress(volume);
    residual.push_back(std::abs(stress) / 250e6);
    const double slope = 0.5 * law.tangent(deviator, 0.0).along * 2.0 / 3.0 + 2 * kappa * volume * volume;
    lateral -= stress / slope;
    if (residual.back() < 1e-13) break;
  }
  EXPECT_LT(residual.back(), 1e-12);
  for (std::size_t k = 1; k + 1 < residual.size(); ++k)
    if (residual[k] < 0.1) {
      EXPECT_LT(residual[k + 1], 20 * residual[k] * residual[k] + 1e-13);
    }
}

TEST(j2_plasticity, an_element_that_does_not_yield_stores_what_is_done_on_it) {
  const ReferenceCell cell = distorted_cell();
  const J2Plasticity law{ductile_steel.law.shear_modulus, lines({{0, 1e12}})};
  const Corners at = corners_of(random_field(8, 2e-5, 4)), way = corners_of(random_field(8, 1, 5));
  const PlasticPoints before;
  PlasticPoints after;
  const auto energy = [&](double h) {
    Corners moved = at;
    for (std::size_t a = 0; a < 8; ++a)
      moved[a] = moved[a] + h * way[a];
    return cell_force(ductile_steel.law, law, cell, moved, before, after).energy;
  };
  const CellForce force = cell_force(ductile_steel.law, law, cell, at, before, after);
  double work = 0;
  for (std::size_t a = 0; a < 8; ++a)
    work += dot(force.force[a], way[a]);
  const double h = 2e-8; // m, of 1 cm
  EXPECT_NEAR((energy(h) - energy(-h)) / (2 * h) / work, 1, 1e-7);
}

// Plastic strain and stress of a bar that is pulled to `axial` of its length: closed forms in the plastic
// strain a, with ln l = a + k / 3 mu + ln J / 3 and kappa/2 (J^2 - 1) = k / 3.
TEST(j2_plasticity, a_patch_of_distorted_elements_follows_the_bar_in_closed_form) {
  for (const Hardening &hardening : {curved, lines({{0, 250e6}}), lines({{0, 250e6}, {0.5, 900e6}})}) {
    HyperelasticSolid solid = distorted_block(hardening);
    for (const double a : {0.0005, 0.012, 0.08, 0.2}) {
      const double k = hardening.at(a).stress, mu = ductile_steel.law.shear_modulus,
                   kappa = ductile_steel.law.bulk_modulus;
      const double volume = std::sqrt(1 + 2 * k / (3 * kappa));
      const double along = a + k / (3 * mu) + std::log(volume) / 3,
                   across = -0.5 * a - k / (6 * mu) + std::log(volume) / 3;
      const Matrix3 f = Eigen::Vector3d(std::exp(across), std::exp(across), std::exp(along)).asDiagonal();
      deform(solid, f);
      for (const CellStress &cell : solid.cell_stresses()) {
        EXPECT_NEAR(cell.cauchy[8], k / volume, 1e-9 * k);
        EXPECT_NEAR(cell.cauchy[0], 0, 1e-8 * k);
        EXPECT_NEAR(cell.cauchy[4], 0, 1e-8 * k);
        EXPECT_NEAR(cell.cauchy[1], 0, 1e-8 * k);
        EXPECT_NEAR(cell.volume_ratio, volume, 1e-12);
      }
      for (const double strain : solid.plastic_strains())
        EXPECT_NEAR(strain, a, 1e-9 * a + 1e-12);
      EXPECT_NEAR(solid.plastic_work() / (hardening.at(a).work * solid.volume()), 1, 1e-8);
      EXPECT_NEAR(face_force(solid, high_end_tag)[2] / (k / volume * end_area(f)), 1, 1e-8);
      EXPECT_LT(largest_inner_force(solid), 1e-8 * k * end_area(f));
      solid.yield_here();
    }
  }
}

// One step of simple shear: the elastic strain has the principal values +-asinh(g/2), along axes at
// tan 2t = 2/g, and returns along itself.
TEST(j2_plasticity, simple_shear_in_one_step_has_a_closed_form) {
  for (const double g : {1e-4, 0.002, 0.05, 0.2}) {
    HyperelasticSolid solid = distorted_block(curved);
    Matrix3 f = Matrix3::Identity();
    f(0, 2) = g;
    deform(solid, f);
    const double mu = ductile_steel.law.shear_modulus, principal = std::asinh(0.5 * g);
    const double trial = 2 / std::sqrt(3.0) * principal;
    const J2Plasticity law{mu, curved};
    const double share = law(trial, 0).share, turn = 1 / std::sqrt(1 + 0.25 * g * g);
    const double shear = 2 * mu * share * principal * turn, across = shear * 0.5 * g;
    for (const CellStress &cell : solid.cell_stresses()) {
      EXPECT_NEAR(cell.cauchy[2] / shear, 1, 1e-8);
      EXPECT_NEAR(cell.cauchy[0], across, 1e-8 * shear);
      EXPECT_NEAR(cell.cauchy[8], -across, 1e-8 * shear);
      EXPECT_NEAR(cell.cauchy[4], 0, 1e-8 * shear);
    }
  }
}

// In many steps a sheared metal of constant strength flows at k / sqrt(3), to the order of its elastic
// strain.
TEST(j2_plasticity, a_metal_sheared_far_flows_at_its_shear_strength) {
  HyperelasticSolid solid = distorted_block(lines({{0, 250e6}}));
  for (int k = 1; k <= 200; ++k) {
    Matrix3 f = Matrix3::Identity();
    f(0, 2) = 0.002 * k;
    deform(solid, f);
    solid.yield_here();
  }
  const double elastic = 250e6 / ductile_steel.law.shear_modulus;
  for (const CellStress &cell : solid.cell_stresses()) {
    EXPECT_NEAR(cell.cauchy[2] * std::sqrt(3.0) / 250e6, 1, elastic);
    const Eigen::Map<const Matrix3> stress(cell.cauchy.data());
    const Matrix3 deviator = stress - stress.trace() / 3 * Matrix3::Identity();
    EXPECT_NEAR(std::sqrt(1.5) * deviator.norm() / 250e6, 1, 1e-9);
    EXPECT_NEAR(cell.volume_ratio, 1, 1e-12);
  }
  for (const double a : solid.plastic_strains())
    EXPECT_NEAR(a, (0.4 - elastic / std::sqrt(3.0)) / std::sqrt(3.0), 1e-3 * 0.4);
}

TEST(j2_plasticity, turning_the_solid_turns_its_stress) {
  HyperelasticSolid still = distorted_block(curved), turning = distorted_block(curved);
  std::vector<Vector3> field = random_field(still.mesh().nodes.size(), 0, 6);
  for (int k = 1; k <= 5; ++k) {
    const std::vector<Vector3> more = random_field(field.size(), 1e-4, static_cast<unsigned>(k));
    for (std::size_t n = 0; n < field.size(); ++n)
      field[n] = field[n] + more[n];
    still.set_displacement(field);
    turning.set_displacement(k % 2 == 1 ? turned_places(turning, field) : field);
    still.yield_here(), turning.yield_here();
  }
  EXPECT_GT(still.plastic_work(), 0);
  double size = 0;
  for (const Vector3 &force : still.internal_forces())
    size = std::max(size, norm(force));
  for (std::size_t n = 0; n < field.size(); ++n)
    EXPECT_LT(norm(turning.internal_forces()[n] - turned(still.internal_forces()[n])), 1e-9 * size);
  EXPECT_NEAR(turning.plastic_work() / still.plastic_work(), 1, 1e-10);
}

TEST(j2_plasticity, forces_do_not_change_until_the_solid_yields_there) {
  HyperelasticSolid solid = distorted_block(curved);
  const std::vector<Vector3> field = random_field(solid.mesh().nodes.size(), 2e-4, 6);
  solid.set_displacement(field);
  const std::vector<Vector3> forces = solid.internal_forces();
  solid.set_displacement(random_field(field.size(), 4e-4, 7));
  solid.set_displacement(field);
  for (std::size_t n = 0; n < field.size(); ++n)
    EXPECT_EQ(norm(solid.internal_forces()[n] - forces[n]), 0);
  EXPECT_GT(solid.plastic_work(), 0);
}

TEST(j2_plasticity, wrong_hardening_is_refused) {
  const auto refused = [](Hardening hardening) {
    EXPECT_THROW(hardening.require_valid(), std::invalid_argument);
    EXPECT_THROW(distorted_block(hardening), std::invalid_argument);
  };
  refused({});
  refused(lines({{0, 0}}));
  refused(lines({{0.001, 250e6}}));
  refused(lines({{0, 250e6}, {0, 260e6}}));
  refused(lines({{0, 250e6}, {0.1, 240e6}}));
  const double infinite = std::numeric_limits<double>::infinity();
  refused(lines({{0, 250e6}, {infinite, 260e6}}));
  refused(lines({{0, 250e6}, {0.1, infinite}}));
  refused(lines({{0, 250e6}}, infinite, 3));
  refused(lines({{0, 250e6}}, 1, infinite));
  refused(lines({{0, 250e6}}, -1, 3));
  refused(lines({{0, 250e6}}, 1, std::nan("")));
  refused(lines({{0, infinite}}));
  Hardening full;
  for (; full.count < Hardening::most_points; ++full.count)
    full.points[full.count] = {0.01 * static_cast<double>(full.count), 250e6};
  EXPECT_NO_THROW(full.require_valid());
  ++full.count;
  try {
    full.require_valid();
    FAIL() << "33 points of 32";
  } catch (const std::invalid_argument &wrong) {
    EXPECT_STREQ(wrong.what(), "hardening: 1 to 32 points");
  }
}

} // namespace
} // namespace platen::fem::j2_plasticity_test
