// Energies, stresses, moduli and sections of a bonded network under small strain, and what is read of its
// motion in time.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "dem/equilibrium.h"
#include "dem/measure/bond_network.h"
#include "dem/measure/spectrum.h"
#include "dem/measure/stress.h"
#include "tests/dem/examples.h"

namespace platen::dem::network_measure_test {
namespace {

using namespace examples;

StaticSettings exact() {
  StaticSettings s;
  s.tolerance = 1e-13;
  return s;
}

// A box of spheres fixed at its lower end and pulled, and pushed aside, at its upper one.
struct Pulled {
  Model model;
  StaticState state;
  Vector3 force{40, -30, 120};
  double low = 2, high = 14; // end layers, in radii
  explicit Pulled(const ModelSettings &settings) : model(packed_box(9, 9, 16), settings) {
    const Particles &p = model.particles;
    StaticCase load;
    std::vector<std::size_t> top;
    for (std::size_t i = 0; i < p.size(); ++i) {
      if (p.position[i].z < low * radius) load.prescribed.push_back({static_cast<int>(i), {}, {}});
      if (p.position[i].z > high * radius) top.push_back(i);
    }
    load.force.resize(p.size());
    for (const std::size_t i : top)
      load.force[i] = force / static_cast<double>(top.size());
    state = solve_static(p, *model.bonds, load, exact());
  }
};

ModelSettings beams() {
  return bonded_by_beams(40e9, .2, .7);
}

// Clapeyron: half the load times its displacement; and the same as the bonds' own potential, to the size of
// the strain.
TEST(network, shares_of_the_energy_are_the_work_of_the_load) {
  for (const ModelSettings &settings : {bonded(), beams()}) {
    Pulled pulled(settings);
    Particles &p = pulled.model.particles;
    const BondEnergies shares =
        bond_energies(p, *pulled.model.bonds, pulled.state.displacement, pulled.state.turn);
    double work = 0;
    int top = 0;
    for (std::size_t i = 0; i < p.size(); ++i)
      if (p.position[i].z > pulled.high * radius) {
        work += 0.5 * dot(pulled.force, pulled.state.displacement[i]);
        ++top;
      }
    EXPECT_NEAR(shares.total(), work / top, 1e-9 * shares.total());
    for (const double share : {shares.axial, shares.bending, shares.torsion})
      EXPECT_GT(share, 0);
    for (std::size_t i = 0; i < p.size(); ++i) {
      p.position[i] += pulled.state.displacement[i];
      (*p.orientation)[i] = rotation_quaternion(pulled.state.turn[i]);
    }
    EXPECT_NEAR(bond_energy(p, *pulled.model.bonds), shares.total(), 5e-3 * shares.total());
    EXPECT_NEAR(bond_energies(p, *pulled.model.bonds).total(), shares.total(), 1e-6 * shares.total());
  }
}

// Each share by itself, in one beam: all three closed forms.
TEST(network, a_beam_stores_what_it_is_asked_to) {
  const double l = 2 * radius, r = .7 * radius, section = pi * r * r, ei = 40e9 * section * r * r / 4;
  Model model(row(1, {0, 0, 1}), beams());
  const std::size_t far = row_of(model.particles, 1);
  const auto shares = [&](const Vector3 &u, const Vector3 &turn) {
    std::vector<Vector3> displacement(2), turned(2);
    displacement[far] = u;
    turned[far] = turn;
    return bond_energies(model.particles, *model.bonds, displacement, turned);
  };
  const double u = 1e-6, angle = 1e-3;
  EXPECT_NEAR(shares({0, 0, u}, {}).axial, 40e9 * section / l * u * u / 2,
              1e-12 * 40e9 * section / l * u * u);
  EXPECT_NEAR(shares({u, 0, 0}, {}).bending, 12 * ei / (l * l * l) * u * u / 2,
              1e-9 * ei / (l * l * l) * u * u);
  EXPECT_NEAR(shares({}, {0, angle, 0}).bending, 4 * ei / l * angle * angle / 2,
              1e-9 * ei / l * angle * angle);
  EXPECT_NEAR(shares({}, {0, 0, angle}).torsion, ei / 1.2 / l * angle * angle / 2,
              1e-9 * ei / l * angle * angle);
  EXPECT_EQ(shares({0, 0, u}, {}).bending + shares({0, 0, u}, {}).torsion, 0);
}

// Any slab between the ends carries the load, wherever it is cut through spheres and bonds.
TEST(network, mean_stress_of_a_slab_is_the_load_over_the_section) {
  for (const ModelSettings &settings : {bonded(), beams()}) {
    const Pulled pulled(settings);
    const double area = 100 * radius * radius;
    for (const double bottom : {3.1, 4.7, 6.})
      for (const double height : {.3, 2., 7.}) {
        const Region slab{box(10 * radius, 10 * radius, height * radius), bottom * radius};
        const Tensor stress = mean_stress(slab, pulled.model.particles, *pulled.model.bonds,
                                          pulled.state.displacement, pulled.state.turn);
        EXPECT_NEAR(stress[2][2], pulled.force.z / area, 1e-8 * pulled.force.z / area) << bottom << height;
      }
  }
}

TEST(network, a_line_lies_in_a_region_by_the_share_that_is_inside) {
  const Region slab{box(2, 4, 1), 3};
  EXPECT_DOUBLE_EQ(slab.fraction_inside({0, 0, 2}, {0, 0, 5}), 1.0 / 3);
  EXPECT_DOUBLE_EQ(slab.fraction_inside({0, 0, 3.5}, {4, 0, 3.5}), .25);
  EXPECT_DOUBLE_EQ(slab.fraction_inside({3, 0, 3.5}, {4, 0, 3.5}), 0);
  EXPECT_DOUBLE_EQ(slab.fraction_inside({1.5, 0, 3.2}, {1.5, 0, 3.8}), 0); // beside it, along a wall
  const Region round{cylinder(2, 10), 0};
  EXPECT_DOUBLE_EQ(round.fraction_inside({-4, 0, 5}, {4, 0, 5}), .5);
  EXPECT_DOUBLE_EQ(round.fraction_inside({1, 1, 9}, {1, 1, 11}), .5);
  EXPECT_DOUBLE_EQ(round.fraction_inside({-4, 2.1, 5}, {4, 2.1, 5}), 0);
}

TEST(network, a_uniform_strain_is_found_whatever_turns_with_it) {
  const Model model(packed_box(9, 9, 9), bonded());
  const Particles &p = model.particles;
  std::vector<Vector3> displacement(p.size());
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Vector3 x = p.position[i];
    displacement[i] = {1e-4 * x.x + 5e-5 * x.y + .3, -2e-4 * x.y, 3e-4 * x.z + 1e-5 * x.y};
    displacement[i] += cross(Vector3{1e-3, 2e-3, -4e-3}, x);
  }
  const Tensor e = mean_strain({box(6 * radius, 6 * radius, 7 * radius), radius}, p, displacement);
  std::vector<char> counted(p.size(), 1);
  std::vector<Vector3> behind = displacement;
  for (std::size_t i = 0; i < p.size(); i += 9)
    counted[i] = 0, behind[i] = {};
  const Region region{box(6 * radius, 6 * radius, 7 * radius), radius};
  EXPECT_NEAR(mean_strain(region, p, behind, counted)[2][2], 3e-4, 1e-12);
  EXPECT_GT(std::abs(mean_strain(region, p, behind)[2][2] - 3e-4), 1e-6);
  const double expected[3][3] = {{1e-4, 2.5e-5, 0}, {2.5e-5, -2e-4, 5e-6}, {0, 5e-6, 3e-4}};
  for (std::size_t r = 0; r < 3; ++r)
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_NEAR(e[r][c], expected[r][c], 1e-12);
  EXPECT_TRUE(
      std::isnan(mean_strain({box(6 * radius, 6 * radius, radius), 20 * radius}, p, displacement)[0][0]));
}

TEST(network, moduli_come_back_from_six_strains) {
  const double young = 70e9, poisson = .2, shear = young / (2 * (1 + poisson)),
               lame = young * poisson / ((1 + poisson) * (1 - 2 * poisson));
  std::array<Tensor, 6> strain{}, stress{};
  for (std::size_t k = 0; k < 6; ++k) {
    for (std::size_t r = 0; r < 3; ++r)
      for (std::size_t c = 0; c <= r; ++c)
        strain[k][r][c] = strain[k][c][r] =
            1e-4 * std::sin(1.0 + 7.0 * static_cast<double>(k * k * (r + 2 * c + 1)) +
                            2.0 * static_cast<double>(r * c + r));
    const double trace = strain[k][0][0] + strain[k][1][1] + strain[k][2][2];
    for (std::size_t r = 0; r < 3; ++r)
      for (std::size_t c = 0; c < 3; ++c)
        stress[k][r][c] = 2 * shear * strain[k][r][c] + (r == c ? lame * trace : 0);
  }
  const Moduli m = isotropic_moduli(strain, stress);
  EXPECT_NEAR(m.youngs, young, 1e-6 * young);
  EXPECT_NEAR(m.poisson, poisson, 1e-6);
  EXPECT_LT(m.anisotropy, 1e-6);
  strain[5] = strain[4];
  EXPECT_TRUE(std::isnan(isotropic_moduli(strain, stress).youngs));
}

// Four columns of spheres at the corners of a square: mass with its own extent, bonds on the lines of
// centres.
TEST(network, sections_of_four_columns_are_as_by_hand) {
  std::vector<Vector3> centres;
  const double a = 3 * radius;
  for (int k = 0; k < 5; ++k)
    for (const double x : {-a, a})
      for (const double y : {-a, 2 * a})
        centres.push_back({x + radius, y, (2 * k + 1) * radius});
  const Model model(spheres(centres), bonded());
  const Gyration mass = mass_gyration(model.particles, 0, 10 * radius),
                 bonds = bond_gyration(model.particles, *model.bonds, 0, 10 * radius);
  const double own = radius * radius / 5;
  EXPECT_NEAR(mass.centre_x, radius, 1e-12);
  EXPECT_NEAR(mass.centre_y, a / 2, 1e-12);
  EXPECT_NEAR(mass.xx, a * a + own, 1e-12 * a * a);
  EXPECT_NEAR(mass.yy, 2.25 * a * a + own, 1e-12 * a * a);
  EXPECT_NEAR(bonds.xx, a * a, 1e-12 * a * a);
  EXPECT_NEAR(bonds.yy, 2.25 * a * a, 1e-12 * a * a);
  EXPECT_EQ(bond_gyration(model.particles, *model.bonds, 20 * radius, 30 * radius).xx, 0);
}

// Not a multiple of 1/T, beside two other lines, whatever the phase.
TEST(spectrum, the_largest_line_is_found_between_the_grid) {
  for (const double phase : {0., .7, 2.5}) {
    std::vector<double> x;
    const double step = 1e-5, f = 1234.5; // 12.3 periods
    for (int k = 0; k < 1000; ++k)
      x.push_back(3 + std::cos(2 * pi * f * step * k + phase) + .11 * std::cos(2 * pi * 3 * f * step * k) +
                  .04 * std::cos(2 * pi * 5 * f * step * k + 1));
    EXPECT_NEAR(main_frequency(x, step, .5 * f, 2 * f), f, 1e-4 * f);
  }
  EXPECT_TRUE(std::isnan(main_frequency({1, 2, 3}, 1, 0, 1)));
  EXPECT_TRUE(std::isnan(main_frequency(std::vector<double>(50, 2.0), 1, .1, .4)));
}

// A pulse of the chain of masses and springs, whose short waves lag behind: after n masses it is J_2n(2 t) in
// units of sqrt(m/k), spread over n^(1/3), and its middle still goes at the speed of long waves.
TEST(spectrum, a_dispersed_pulse_passes_when_long_waves_do) {
  const double step = .05;
  for (const int n : {20, 60}) {
    std::vector<double> v;
    for (int k = 0; k * step < 3 * n; ++k)
      v.push_back(std::cyl_bessel_j(2.0 * n, 2 * k * step));
    EXPECT_NEAR(passing_time(v, step, 1.2 * n, .9 * n), n, 2e-3 * n) << n;
    v.resize(v.size() / 2);
    EXPECT_TRUE(std::isnan(passing_time(v, step, 1.2 * n, .9 * n))); // ends before it has passed
  }
}

} // namespace
} // namespace platen::dem::network_measure_test
