// Fibres in resin: the law and its element, and rings that are widened until they tear.
#include <gtest/gtest.h>

#include <Eigen/Dense>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "base/pi.h"
#include "fem/hyperelastic_cell.h"
#include "tests/fem/metal.h"
#include "tests/fem/rubber_sleeve.h"
#include "tests/measured.h"
#include "tests/same_state.h"

namespace platen::fem::fibres_test {
namespace {

using Matrix3 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

const NeoHookean resin = NeoHookean::from_young(3e9, 0.35);
constexpr double density = 1600, never = std::numeric_limits<double>::infinity();

// Directions of a block: oblique to its axes and to each other.
FibreCell oblique(const Vector3 &) {
  return {{Vector3{0.6, 0, 0.8}, Vector3{0.48, 0.6, -0.64}}, 1.5};
}
// Hoops and axis of a tube; `weaker`: of the cells at y > 0.
FibreCell hoops(const Vector3 &middle, double weaker = 1) {
  const double radius = std::hypot(middle.x, middle.y);
  return {{Vector3{-middle.y / radius, middle.x / radius, 0}, Vector3{0, 0, 1}}, middle.y > 0 ? weaker : 1};
}

SolidMaterial laminate(double along, double across, double rupture,
                       const std::function<FibreCell(const Vector3 &)> &layout) {
  return {density, resin, {}, Fibres{{along, across}, rupture, layout}};
}

TEST(fibres, a_patch_of_distorted_elements_follows_the_nominal_law_in_closed_form) {
  Matrix3 f;
  f << 1.012, 0.004, -0.003, 0.002, 0.995, 0.006, -0.001, 0.003, 1.008;
  HyperelasticSolid with(distorted_grid(), laminate(200e9, 70e9, never, oblique)),
      without(distorted_grid(), {density, resin});
  deform(with, f), deform(without, f);
  const FibreCell own = oblique({});
  Matrix3 nominal = Matrix3::Zero(); // Pa
  double energy = 0;                 // J/m^3
  for (int k : {0, 1}) {
    const Vector3 &d = own.direction[static_cast<std::size_t>(k)];
    const Eigen::Vector3d along(d.x, d.y, d.z), now = f * along;
    const double modulus = 1.5 * (k == 0 ? 200e9 : 70e9), strain = now.norm() - 1;
    nominal += modulus * strain * now.normalized() * along.transpose();
    energy += 0.5 * modulus * strain * strain;
    if (k == 0) {
      for (const double found : with.fibre_strains())
        EXPECT_NEAR(found, strain, 1e-14);
    }
  }
  EXPECT_NEAR((with.internal_energy() - without.internal_energy()) / (energy * with.volume()), 1, 1e-11);
  const Matrix3 cauchy = nominal * f.transpose() / f.determinant();
  const std::vector<CellStress> all = with.cell_stresses(), matrix = without.cell_stresses();
  for (std::size_t c = 0; c < all.size(); ++c)
    for (Eigen::Index k = 0; k < 9; ++k)
      EXPECT_NEAR(all[c].cauchy[static_cast<std::size_t>(k)] - matrix[c].cauchy[static_cast<std::size_t>(k)],
                  cauchy.data()[k], 1e-10 * cauchy.norm());
  EXPECT_LT(largest_inner_force(with), 1e-9 * cauchy.norm() * end_area(f));
  const Vector3 pull = face_force(with, high_end_tag) - face_force(without, high_end_tag);
  for (Eigen::Index k = 0; k < 3; ++k)
    EXPECT_NEAR(pull[static_cast<std::size_t>(k)] / (nominal(k, 2) * 0.03 * 0.03), 1, 1e-10);
}

TEST(fibres, forces_and_stiffness_are_derivatives_of_the_energy) {
  const ReferenceCell cell = distorted_cell();
  const Fibres law{{200e9, 70e9}, never, oblique};
  const Corners at = corners_of(random_field(8, 1e-4, 4)), way = corners_of(random_field(8, 1, 5));
  for (const double share : {1.5, 0.0}) {
    FibreCell own = oblique({});
    own.share = share;
    const auto forces = [&](double h) {
      Corners moved = at;
      for (std::size_t a = 0; a < 8; ++a)
        moved[a] = moved[a] + h * way[a];
      CellForce result = cell_force(resin, cell, moved);
      add_fibres(law, own, cell, moved, result);
      return result;
    };
    CellStiffness stiffness = cell_stiffness(resin, cell, at);
    add_fibres(law, own, cell, at, stiffness);
    const double h = 1e-7; // m, of 1 cm
    const CellForce ahead = forces(h), behind = forces(-h), here = forces(0);
    double work = 0, size = 0, wrong = 0;
    for (std::size_t m = 0; m < 24; ++m) {
      double expected = 0;
      for (std::size_t n = 0; n < 24; ++n) {
        expected += stiffness[24 * m + n] * way[n / 3][n % 3];
        EXPECT_NEAR(stiffness[24 * m + n], stiffness[24 * n + m], 1e-10 * std::abs(stiffness[0]));
      }
      const double found = (ahead.force[m / 3][m % 3] - behind.force[m / 3][m % 3]) / (2 * h);
      size = std::max(size, std::abs(expected)), wrong = std::max(wrong, std::abs(found - expected));
      work += here.force[m / 3][m % 3] * way[m / 3][m % 3];
    }
    EXPECT_LT(wrong, 1e-6 * size);
    EXPECT_NEAR((ahead.energy - behind.energy) / (2 * h) / work, 1, 1e-6);
  }
}

// Stiffness grows by that of the fibres over at most the stiffest mode of the resin.
TEST(fibres, the_stable_step_knows_of_them) {
  HyperelasticSolid with(distorted_grid(), laminate(200e9, 70e9, never, oblique)),
      without(distorted_grid(), {density, resin});
  const double stiffer = 1 + 1.5 * 200e9 / (3 * resin.shear_modulus + resin.bulk_modulus); // at least
  EXPECT_LT(with.stable_step(), without.stable_step() / std::sqrt(stiffer / 2));
}

TEST(fibres, turning_the_solid_turns_its_forces) {
  HyperelasticSolid still(distorted_grid(), laminate(200e9, 70e9, never, oblique)), turning = still;
  const std::vector<Vector3> field = random_field(still.mesh().nodes.size(), 1e-4, 6);
  still.set_displacement(field);
  turning.set_displacement(turned_places(turning, field));
  double size = 0;
  for (const Vector3 &force : still.internal_forces())
    size = std::max(size, norm(force));
  for (std::size_t n = 0; n < field.size(); ++n)
    EXPECT_LT(norm(turning.internal_forces()[n] - turned(still.internal_forces()[n])), 1e-9 * size);
  EXPECT_NEAR(turning.internal_energy() / still.internal_energy(), 1, 1e-10);
}

// A hoop with pressure inside: p r = E t e, with the radius now and the wall at the start. That its elements
// are flat makes wall and pressed area smaller by the same factor.
constexpr double wall = 1e-3; // m
HyperelasticSolid ring(double rupture, double weaker = 1) {
  const Fibres fibres{{227e9, 0}, rupture, [=](const Vector3 &x) { return hoops(x, weaker); }};
  HyperelasticSolid solid(make_grid(Tube{0.1, wall, 0.0, 0.03, 48, 3, 1}),
                          {density, NeoHookean::from_young(3e9, 0), {}, fibres}, {inner_tag});
  solid.prescribe(solid.nodes_of(low_end_tag), {false, false, true});
  solid.update_forces();
  return solid;
}

// The pressure rises to its value and the ring comes to rest.
void blow_up(HyperelasticSolid &solid, double pressure) {
  const double period = 2 * pi * 0.1 / std::sqrt(230e9 / density), dt = 0.6 * solid.stable_step();
  const int rising = static_cast<int>(12 * period / dt);
  solid.set_damping(4 / period);
  for (int k = 0; k < 2 * rising; ++k) {
    solid.set_pressure(inner_tag, pressure * std::min(1.0, (k + 1.0) / rising));
    step(solid, dt, 1);
  }
}

TEST(fibres, a_wrap_bears_the_pressure_of_its_hoops) {
  HyperelasticSolid solid = ring(never);
  const double strain = 0.008;
  blow_up(solid, 230e9 * strain * wall / (0.1 * (1 + strain)));
  double worst = 0;
  for (const double found : solid.fibre_strains())
    worst = std::max(worst, std::abs(found / strain - 1));
  measured::expect_below(71, "hoop_strain_of_a_wrap_under_pressure", worst, 1e-3);
  EXPECT_EQ(solid.torn_energy(), 0);
}

// Half of the ring has fibres of two layers where the other half has three.
TEST(fibres, a_wrap_tears_at_its_rupture_strain_where_it_is_weakest) {
  const double rupture = 0.008, weakest = 2.0 / 3;
  const double bears =
      weakest * (227e9 + 3e9) * rupture * 1e-3 / (0.1 * (1 + rupture) * (1 - 0.35 * rupture));
  HyperelasticSolid below = ring(rupture, weakest), above = ring(rupture, weakest);
  blow_up(below, 0.98 * bears);
  for (const double share : below.fibre_shares())
    EXPECT_GT(share, 0);
  EXPECT_EQ(below.torn_energy(), 0);
  const double period = 2 * pi * 0.1 / std::sqrt(230e9 / density), dt = 0.3 * above.stable_step();
  above.set_damping(4 / period);
  double least = 0, intact = 0; // of the last state without a tear
  for (double pressure = 0; above.torn_energy() == 0 && pressure < 1.1 * bears;
       pressure += bears * dt / (30 * period)) {
    intact = pressure, least = *std::min_element(above.fibre_strains().begin(), above.fibre_strains().end());
    above.set_pressure(inner_tag, pressure);
    step(above, dt, 1);
  }
  EXPECT_NEAR(intact / bears, 1, 0.02);
  EXPECT_NEAR(least / (weakest * rupture), 1, 0.03);
  const std::vector<double> shares = above.fibre_shares();
  for (std::size_t c = 0; c < shares.size(); ++c)
    if (shares[c] == 0) {
      EXPECT_GT(above.mesh().nodes[static_cast<std::size_t>(above.mesh().cell_nodes[c][0])].y +
                    above.mesh().nodes[static_cast<std::size_t>(above.mesh().cell_nodes[c][7])].y,
                0);
    }
}

// Energy per volume of a bar of one element that is pulled over its limit: E e^2 / 2, of fibres and resin.
TEST(fibres, what_tears_gives_its_energy) {
  const double rupture = 0.01;
  HyperelasticSolid solid(make_grid(BoxPlate{{0, 0, 0}, {0.01, 0.01, 0.01}, {1, 1, 1}}),
                          laminate(97e9, 0, rupture, [](const Vector3 &) {
                            return FibreCell{{Vector3{0, 0, 1}, Vector3{1, 0, 0}}, 1};
                          }));
  const auto pulled = [&](double strain) {
    Matrix3 f = Matrix3::Identity();
    f(2, 2) = 1 + strain;
    deform(solid, f);
    solid.yield_here();
  };
  pulled(rupture * (1 - 1e-9));
  EXPECT_EQ(solid.fibre_shares().front(), 1);
  const double stored = solid.internal_energy();
  pulled(rupture * (1 + 1e-9));
  EXPECT_EQ(solid.fibre_shares().front(), 0);
  HyperelasticSolid bare(make_grid(BoxPlate{{0, 0, 0}, {0.01, 0.01, 0.01}, {1, 1, 1}}), {density, resin});
  Matrix3 f = Matrix3::Identity();
  f(2, 2) = 1 + rupture;
  deform(bare, f);
  const double rest = Fibres::rest_of_torn * bare.internal_energy();
  EXPECT_NEAR(solid.torn_energy() / (stored - rest), 1, 1e-7);
  solid.update_forces();
  EXPECT_NEAR(solid.cell_stresses()[0].cauchy[8] / bare.cell_stresses()[0].cauchy[8], Fibres::rest_of_torn,
              1e-9);
  EXPECT_NEAR(stored - bare.internal_energy(), 0.5 * 97e9 * rupture * rupture * 1e-6, 1e-6 * stored);
  pulled(2 * rupture);
  EXPECT_LT(solid.internal_energy(), 0.01 * stored);
  EXPECT_NEAR(solid.torn_energy() / (stored - rest), 1, 1e-7);
}

TEST(fibres, an_explicit_path_through_a_tear_closes_its_energy_balance) {
  double worst[2] = {0, 0}, work = 0;
  for (const int fine : {0, 1}) {
    HyperelasticSolid solid = ring(0.004, 0.7);
    const double dt = 0.5 * solid.stable_step() / (1 + fine);
    const int steps = 3000 * (1 + fine);
    for (int k = 0; k < steps && solid.torn_energy() < 5; ++k) {
      solid.set_pressure(inner_tag, 12e6 * k / steps);
      step(solid, dt, 1);
      worst[fine] = std::max(worst[fine], std::abs(imbalance(solid) + solid.torn_energy()));
    }
    work = solid.pressure_work();
    EXPECT_GT(solid.torn_energy(), 0.1 * work);
  }
  measured::expect_below(71, "energy_residual_over_work", worst[1] / work, 1e-3);
  EXPECT_LT(worst[1], 0.6 * worst[0]);
}

TEST(fibres, goes_on_from_a_stored_state_with_the_same_bits) {
  HyperelasticSolid one = ring(0.004, 0.7);
  const double dt = 0.5 * one.stable_step();
  const auto rise = [&](HyperelasticSolid &solid, int first, int last) {
    for (int k = first; k < last; ++k) {
      solid.set_pressure(inner_tag, 4e3 * k);
      step(solid, dt, 1);
    }
  };
  int begun = 0;
  while (one.torn_energy() == 0 && begun < 5000)
    rise(one, begun, begun + 1), ++begun;
  EXPECT_GT(one.torn_energy(), 0);
  HyperelasticSolid other = ring(0.004, 0.7);
  set_state(other, state_of(one));
  EXPECT_EQ(other.fibre_strains(), one.fibre_strains());
  EXPECT_EQ(other.stable_step(), one.stable_step());
  rise(one, begun, begun + 40), rise(other, begun, begun + 40);
  EXPECT_TRUE(same_state(state_of(one), other));
  EXPECT_EQ(other.torn_energy(), one.torn_energy());
}

TEST(fibres, wrong_ones_are_refused) {
  const auto refused = [](const Fibres &fibres) {
    EXPECT_THROW(HyperelasticSolid(distorted_grid(), {density, resin, {}, fibres}), std::invalid_argument);
  };
  refused({{-1, 0}, 0.01, oblique});
  refused({{1e9, never}, 0.01, oblique});
  refused({{1e9, std::nan("")}, 0.01, oblique});
  refused({{1e9, 0}, 0, oblique});
  refused({{1e9, 0}, std::nan(""), oblique});
  refused({{1e9, 0}, 0.01, {}});
}

} // namespace
} // namespace platen::fem::fibres_test
