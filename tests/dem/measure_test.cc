// What is read off a specimen: strain, stress, damage, opening, pieces, moduli.
#include <gtest/gtest.h>

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "dem/measure/bond_network.h"
#include "dem/measure/circumference.h"
#include "dem/measure/fragments.h"
#include "dem/measure/gauge.h"
#include "dem/measure/stress.h"
#include "dem/packing/advancing_front.h"
#include "tests/dem/examples.h"

namespace platen::dem::measure_test {
namespace {

using namespace examples;

Specimen small_cylinder() {
  return advancing_front(cylinder(7 * radius, 24 * radius), uniform_radii_of_spread(radius, .25), 4);
}

// Rows of the displacement gradient; lengths in the specimen do not matter to an affine motion.
struct Gradient {
  Vector3 row[3];
  Vector3 operator()(const Vector3 &x) const { return {dot(row[0], x), dot(row[1], x), dot(row[2], x)}; }
};

void deform(Particles &p, const Gradient &g, const Vector3 &shift) {
  for (std::size_t i = 0; i < p.size(); ++i)
    p.position[i] = p.reference_position[i] + g(p.reference_position[i]) + shift;
}

TEST(measure, the_gauge_reads_an_affine_motion_exactly) {
  const Specimen specimen = small_cylinder();
  Model model(specimen, bonded());
  const Gauge gauge(model.particles, specimen.shape, model.bonds.get());
  EXPECT_GT(gauge.size(), 50u);
  EXPECT_LT(gauge.size(), model.particles.size());
  const Gradient g{{{1.1e-3, 4e-4, -7e-4}, {2e-4, .9e-3, 3e-4}, {-5e-4, 6e-4, -4.2e-3}}};
  deform(model.particles, g, {.3, -.2, .1});
  const GaugeStrain s = gauge.strain(model.particles);
  // Positions of .3 m against displacements of 1e-6 m: 1e-16 * .3 / 1e-5 relative, averaged over the
  // particles.
  EXPECT_NEAR(s.axial, -4.2e-3, 1e-12);
  EXPECT_NEAR(s.lateral_x, 1.1e-3, 1e-12);
  EXPECT_NEAR(s.lateral_y, .9e-3, 1e-12);
  EXPECT_NEAR(s.lateral(), 1e-3, 1e-12);
}

// Every sphere of the skin moves outwards by the same share of its distance from the axis, whatever z does.
TEST(measure, a_chain_reads_the_widening_of_a_cylinder) {
  const Specimen specimen = small_cylinder();
  Model model(specimen, bonded());
  const Circumference chain(model.particles, specimen.shape, model.bonds.get());
  EXPECT_GT(chain.size(), 50u);
  EXPECT_LT(chain.size(), model.particles.size());
  EXPECT_EQ(chain.strain(model.particles), 0);
  deform(model.particles, {{{1.5e-3, 0, 0}, {0, 1.5e-3, 0}, {0, 0, -8e-3}}}, {});
  EXPECT_NEAR(chain.strain(model.particles), 1.5e-3, 1e-12);
  deform(model.particles, {{{-2e-4, 3e-3, 0}, {-3e-3, -2e-4, 0}, {0, 0, 0}}}, {}); // and turned
  EXPECT_NEAR(chain.strain(model.particles), -2e-4, 1e-12);
}

// What flies off counts three times the median at most: a tenth of the skin far away adds a fifth.
TEST(measure, a_chain_passes_over_pieces_that_fly_off) {
  const Specimen specimen = small_cylinder();
  Model model(specimen, bonded());
  Particles &p = model.particles;
  const Circumference chain(p, specimen.shape, model.bonds.get());
  deform(p, {{{1e-3, 0, 0}, {0, 1e-3, 0}, {0, 0, 0}}}, {});
  int gone = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Vector3 x = p.reference_position[i];
    if (x.x < 5 * radius || std::abs(x.z - 12 * radius) > 2 * radius) continue;
    p.position[i] = x + Vector3{radius, 0, 0}, ++gone;
  }
  ASSERT_GT(gone, 2);
  const double few = chain.strain(p);
  EXPECT_GT(few, 1e-3);
  EXPECT_LE(few, 1e-3 * (1 + 2.0 * gone / static_cast<double>(chain.size())) + 1e-12);
  for (std::size_t i = 0; i < p.size(); ++i)
    if (p.position[i].x - p.reference_position[i].x > 0.5 * radius) p.position[i].x += 100 * radius;
  EXPECT_NEAR(chain.strain(p), few, 1e-12);
}

// Of a box each side counts over half of its own width.
TEST(measure, a_chain_reads_both_widths_of_a_box) {
  const Specimen specimen = cubic(6, 6, 12);
  Model model(specimen, bonded());
  const Circumference chain(model.particles, specimen.shape, model.bonds.get());
  deform(model.particles, {{{1e-3, 0, 0}, {0, 1e-3, 0}, {0, 0, 5e-3}}}, {});
  EXPECT_NEAR(chain.strain(model.particles), 1e-3, 1e-12);
  deform(model.particles, {{{1e-3, 0, 0}, {0, 5e-4, 0}, {0, 0, 0}}}, {});
  const double of_x = chain.strain(model.particles);
  deform(model.particles, {{{5e-4, 0, 0}, {0, 1e-3, 0}, {0, 0, 0}}}, {});
  EXPECT_NEAR(of_x + chain.strain(model.particles), 1.5e-3, 1e-12);
  EXPECT_GT(of_x, 5e-4);
  EXPECT_LT(of_x, 1e-3);
}

// A lattice that is bonded, 12 radii wide and 24 high, and in its wide holes and around it small spheres that
// touch nothing.
Specimen lattice_with_loose_spheres() {
  Specimen s;
  s.shape = box(16 * radius, 16 * radius, 24 * radius);
  const auto place = [&](double half, double z0, double layers, double r) {
    for (double z = 0; z < layers; ++z)
      for (double y = -half; y <= half; ++y)
        for (double x = -half; x <= half; ++x) {
          s.centre.push_back({2 * radius * x, 2 * radius * y, 2 * radius * z + z0});
          s.radius.push_back(r);
        }
  };
  place(2.5, radius, 12, radius);
  place(3, 2 * radius, 11, .1 * radius);
  return s;
}
// Strains what is bonded and leaves the rest.
void deform_bonded(Model &model, const Gradient &g) {
  Particles &p = model.particles;
  for (std::size_t i = 0; i < p.size(); ++i)
    if (p.radius[i] > .5 * radius) p.position[i] = p.reference_position[i] + g(p.reference_position[i]);
}
constexpr double squeezed = 1e-3, widened = 2e-4;
const Gradient squeeze{{{widened, 0, 0}, {0, widened, 0}, {0, 0, -squeezed}}};

// What is in no bond stays behind where the network is strained.
TEST(measure, loose_spheres_do_not_enter_the_gauges) {
  const Specimen specimen = lattice_with_loose_spheres();
  Model model(specimen, bonded());
  const Gauge gauge(model.particles, specimen.shape, model.bonds.get());
  const ExtremalPairs pairs(model.particles, specimen.shape, model.bonds.get());
  EXPECT_EQ(gauge.size(), 6u * 6 * 6);
  deform_bonded(model, squeeze);
  const GaugeStrain s = gauge.strain(model.particles);
  EXPECT_NEAR(s.axial, -squeezed, 1e-12);
  EXPECT_NEAR(s.lateral_x, widened, 1e-12);
  EXPECT_NEAR(s.lateral_y, widened, 1e-12);
  EXPECT_NEAR(pairs.axial(model.particles), -squeezed, 1e-5); // pairs may lean by a sphere: lengths mix
  EXPECT_NEAR(pairs.lateral(model.particles), widened, 1e-4);
}

// A resumed run makes its gauge when bonds have broken and their rows are gone.
TEST(measure, broken_bonds_leave_the_gauge_as_it_was) {
  const Specimen specimen = lattice_with_loose_spheres();
  Model model(specimen, bonded());
  const Gauge before(model.particles, specimen.shape, model.bonds.get());
  break_rows_where(*model.bonds, model.particles, [](std::size_t) { return true; });
  model.bonds->compact();
  ASSERT_EQ(model.bonds->size(), 0u);
  const Gauge after(model.particles, specimen.shape, model.bonds.get());
  EXPECT_EQ(after.size(), before.size());
  deform_bonded(model, squeeze);
  EXPECT_EQ(after.strain(model.particles).axial, before.strain(model.particles).axial);
}

TEST(measure, without_bonds_the_gauge_counts_every_sphere) {
  const Specimen specimen = small_cylinder();
  ModelSettings settings = bonded();
  settings.bond.reset();
  const Model loose(specimen, settings);
  const Gauge all(loose.particles, specimen.shape, loose.bonds.get());
  std::size_t middle = 0;
  for (const Vector3 &x : loose.particles.reference_position)
    middle += std::abs(x.z - .5 * specimen.shape.height) < .25 * specimen.shape.height;
  EXPECT_EQ(all.size(), middle);
  settings.bond = bonded().bond;
  settings.bond_layout.gap = {false, 1e-12}; // nobody is that near: bonds, but none
  Specimen apart = specimen;
  for (double &r : apart.radius)
    r *= .9;
  const Model none(apart, settings);
  ASSERT_EQ(none.bonds->initial_count(), 0u);
  EXPECT_EQ(Gauge(none.particles, specimen.shape, none.bonds.get()).size(), middle);
}

TEST(measure, the_gauge_does_not_see_the_ends) {
  const Specimen specimen = small_cylinder();
  Model model(specimen, bonded());
  Particles &p = model.particles;
  const Gauge gauge(p, specimen.shape, model.bonds.get());
  for (std::size_t i = 0; i < p.size(); ++i)
    if (p.reference_position[i].z < 3 * radius) p.position[i].z -= 1e-3;
  EXPECT_EQ(gauge.strain(p).axial, 0);
}

TEST(measure, extremal_pairs_read_an_affine_motion) {
  const Specimen specimen = small_cylinder();
  Model model(specimen, bonded());
  const ExtremalPairs pairs(model.particles, specimen.shape, model.bonds.get());
  const Gradient g{{{1e-3, 0, 0}, {0, 1e-3, 0}, {0, 0, -4e-3}}};
  deform(model.particles, g, {});
  EXPECT_NEAR(pairs.axial(model.particles), -4e-3, 1e-12);
  // Lateral pairs are not quite level: their z difference, below 4 R on 14 R, contracts by 4e-3.
  EXPECT_NEAR(pairs.lateral(model.particles), 1e-3, .15e-3);
  for (const bool along_x : {true, false}) { // half of the pairs are of each axis
    Model one(specimen, bonded());
    deform(one.particles, {{{along_x ? 1e-3 : 0, 0, 0}, {0, along_x ? 0 : 1e-3, 0}, {0, 0, 0}}}, {});
    EXPECT_NEAR(pairs.lateral(one.particles), .5e-3, .05e-3) << along_x;
  }
}

// Sum over particles of V sigma : eps is twice the energy stored, for spheres that follow an affine strain.
TEST(measure, particle_stress_does_the_work_that_the_bonds_store) {
  Model model(packed_box(12, 12, 12), bonded());
  Particles &p = model.particles;
  const double e = 1e-6; // the work conjugate changes by a relative strain
  const Gradient g{{{e, .5 * e, 0}, {.5 * e, -2 * e, .3 * e}, {0, .3 * e, .7 * e}}};
  deform(p, g, {});
  model.compute_forces(1e-9);
  const double fraction = .55;
  const auto stress = particle_stress(p, model.bonds.get(), nullptr, fraction);
  double work = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const double volume = 4.0 / 3.0 * pi * std::pow(p.radius[i], 3) / fraction;
    for (std::size_t r = 0; r < 3; ++r)
      for (std::size_t c = 0; c < 3; ++c) {
        work += volume * stress[i][3 * r + c] * g.row[r][static_cast<int>(c)];
        EXPECT_EQ(stress[i][3 * r + c], stress[i][3 * c + r]);
      }
  }
  const double stored = bond_energy(p, *model.bonds);
  EXPECT_NEAR(work, 2 * stored, 1e-4 * stored);
}

TEST(measure, a_pulled_row_is_under_tension_of_force_over_section) {
  Model model(row(4, {1, 0, 0}), bonded());
  Particles &p = model.particles;
  deform(p, {{{1e-4, 0, 0}, {0, 0, 0}, {0, 0, 0}}}, {});
  model.compute_forces(1e-9);
  const auto stress = particle_stress(p, model.bonds.get(), nullptr, 1);
  const double force = modulus * area * 1e-4, volume = 4.0 / 3.0 * pi * std::pow(radius, 3);
  EXPECT_NEAR(stress[row_of(p, 2)][0], force * 2 * radius / volume, 2e-4 * force / area); // lengths now
  EXPECT_NEAR(stress[row_of(p, 0)][0], force * radius / volume, 2e-4 * force / area);     // one bond only
}

// k = 1: the affine bound and the static estimate meet, E = K/3 and nu = 0. Otherwise the bound is above.
TEST(measure, network_moduli_meet_at_equal_stiffness) {
  const Specimen specimen = packed_box(14, 14, 14);
  for (const double k : {.3, .7, 1.0}) {
    ModelSettings settings = bonded();
    parallel_bond(settings).stiffness_ratio = k;
    Model model(specimen, settings);
    const NetworkModuli m = network_moduli(*model.bonds, specimen.shape.volume());
    const double sum =
        static_cast<double>(model.bonds->size()) * 4 * radius * radius * normal_stiffness * area;
    const double stiffness = sum / specimen.shape.volume();
    EXPECT_NEAR(m.young_voigt, stiffness / 3 * (2 + 3 * k) / (4 + k), 1e-9 * stiffness);
    EXPECT_NEAR(m.poisson_voigt, (1 - k) / (4 + k), 1e-15);
    EXPECT_GE(m.young_voigt, m.young_reuss * (1 - 1e-12));
    if (k == 1) {
      EXPECT_NEAR(m.young_voigt, m.young_reuss, 1e-12 * stiffness);
    }
  }
}

// Shear force of a bond under affine strain, averaged over directions, is what the formula says; a packing is
// isotropic to a few percent.
TEST(measure, the_affine_bound_is_the_energy_of_an_affine_strain) {
  const Specimen specimen = packed_box(26, 26, 26);
  ModelSettings settings = bonded();
  settings.rotation = false;
  Model model(specimen, settings);
  const NetworkModuli m = network_moduli(*model.bonds, specimen.shape.volume());
  const double nu = m.poisson_voigt, e = 1e-6;
  // Uniaxial stress of the affine solid: strains e, -nu e, -nu e store E e^2 / 2 per volume.
  deform(model.particles, {{{e, 0, 0}, {0, -nu * e, 0}, {0, 0, -nu * e}}}, {});
  const double expected = .5 * m.young_voigt * e * e * specimen.shape.volume();
  EXPECT_NEAR(bond_energy(model.particles, *model.bonds), expected, .05 * expected);
}

// Stiffnesses of affine strains along the axes from the bonds' own energies, and of those Young's moduli: no
// strain across costs less than the one that the load chooses.
TEST(measure, affine_moduli_are_those_of_the_energies_of_affine_strains) {
  const Specimen specimen = packed_box(26, 20, 32);
  ModelSettings settings = bonded();
  settings.rotation = false;
  const double e = 1e-6;
  const auto energy = [&](double x, double y, double z) {
    Model model(specimen, settings);
    deform(model.particles, {{{x * e, 0, 0}, {0, y * e, 0}, {0, 0, z * e}}}, {});
    return bond_energy(model.particles, *model.bonds) / (.5 * e * e * specimen.shape.volume());
  };
  Eigen::Matrix3d c;
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b) {
      const auto of = [&](bool first, bool second) {
        Eigen::Vector3d s = Eigen::Vector3d::Zero();
        if (first) s[a] += 1;
        if (second) s[b] += 1;
        return energy(s[0], s[1], s[2]);
      };
      c(a, b) = a == b ? of(true, false) : .5 * (of(true, true) - of(true, false) - of(false, true));
    }
  const Eigen::Matrix3d compliance = c.inverse();
  const auto found = affine_moduli(*Model(specimen, settings).bonds, specimen.shape.volume());
  for (int a = 0; a < 3; ++a)
    EXPECT_NEAR(found[a] * compliance(a, a), 1, 1e-5) << a; // strains of 1e-6
  // A packing has nearly the same in every direction: that of Voigt's isotropic network.
  const double voigt = network_moduli(*Model(specimen, settings).bonds, specimen.shape.volume()).young_voigt;
  for (const double modulus : found)
    EXPECT_NEAR(modulus / voigt, 1, .1);
}

// Bonds along the axes answer to strain along them alone.
TEST(measure, a_simple_cubic_lattice_is_stiffer_along_its_bonds_than_in_the_mean) {
  const Specimen lattice = cubic(3, 4, 5);
  Model model(lattice, bonded());
  const auto found = affine_moduli(*model.bonds, lattice.shape.volume());
  const double of_chain = normal_stiffness * area / (2 * radius); // one bond on each square of 2 R
  EXPECT_NEAR(found[0] / of_chain, 2. / 3, 1e-12);                // its bonds over its spheres
  EXPECT_NEAR(found[1] / of_chain, 3. / 4, 1e-12);
  EXPECT_NEAR(found[2] / of_chain, 4. / 5, 1e-12);
  EXPECT_GT(found[0], 1.5 * 2. / 3 * network_moduli(*model.bonds, lattice.shape.volume()).young_voigt);
}

TEST(measure, damage_is_counted_where_it_is) {
  const Specimen specimen = small_cylinder();
  const double rc = specimen.shape.radius, h = specimen.shape.height;
  Model model(specimen, bonded());
  break_where(*model.bonds, model.particles, [&](const Vector3 &m) { return m.z > h - .5 * rc; });
  DamageByRegion d =
      damage_by_region(model.particles, *model.bonds, specimen.shape, bond_losses(*model.bonds));
  EXPECT_EQ(d.end_top, 1);
  EXPECT_EQ(d.end_bottom, 0);
  EXPECT_EQ(d.middle, 0);
  EXPECT_EQ(d.worse_end(), 1);
  break_where(*model.bonds, model.particles,
              [&](const Vector3 &m) { return std::abs(m.z - .5 * h) < .25 * rc; });
  model.bonds->compact(); // measures read the records, not the rows
  d = damage_by_region(model.particles, *model.bonds, specimen.shape, bond_losses(*model.bonds));
  EXPECT_EQ(d.middle, 1);
  EXPECT_EQ(d.end_bottom, 0);
  const BondCounts counts = bond_counts(model.particles, *model.bonds);
  EXPECT_EQ(std::accumulate(counts.broken.begin(), counts.broken.end(), 0),
            2 * static_cast<int>(model.bonds->initial_count() - model.bonds->size()));
}

TEST(measure, a_barrel_is_told_from_a_column) {
  const Specimen specimen = small_cylinder();
  const double h = specimen.shape.height;
  Model model(specimen, bonded());
  Particles &p = model.particles;
  const auto bulge = [&](double ends) {
    for (std::size_t i = 0; i < p.size(); ++i) {
      const Vector3 &x = p.reference_position[i];
      const double s = 2 * x.z / h - 1, share = 1e-3 * (1 - (1 - ends) * s * s);
      p.position[i] = {x.x * (1 + share), x.y * (1 + share), x.z};
    }
    return skin_opening(p, *model.bonds, specimen.shape);
  };
  const std::vector<double> column = bulge(1), barrelled = bulge(0);
  ASSERT_EQ(column.size(), 10u);
  EXPECT_NEAR(barrel(column), 1, .05);
  EXPECT_NEAR(end_spread(column), 1, .05);
  EXPECT_LT(barrel(barrelled), .3);
  EXPECT_LT(end_spread(barrelled), .35);
}

// Squeezed by a strain e along z alone, a bond of touching spheres at an angle t to the horizontal bears
// G_b e sin^2 t.
TEST(measure, bonds_bear_by_their_direction) {
  Model model(small_cylinder(), bonded());
  Particles &p = model.particles;
  constexpr double strain = 1e-6;
  for (std::size_t i = 0; i < p.size(); ++i)
    p.position[i].z *= 1 - strain;
  int bonds = 0;
  for (const DirectionClass &c : bond_stress_by_direction(p, *model.bonds, 6)) {
    ASSERT_GT(c.bonds, 10);
    EXPECT_GE(c.mean, modulus * strain * std::pow(std::sin(c.low), 2) - 1);
    EXPECT_LE(c.mean, modulus * strain * std::pow(std::sin(c.high), 2) + 1);
    EXPECT_GE(c.mean_pressed, c.mean - 1);
    bonds += c.bonds;
  }
  EXPECT_EQ(bonds, static_cast<int>(model.bonds->size()));
}

TEST(measure, pieces_are_what_bonds_hold_together) {
  Model model(row(9, {0, 0, 1}), bonded());
  Fragments f = find_fragments(model.particles, model.bonds.get());
  EXPECT_EQ(f.count, 1);
  EXPECT_EQ(f.single, 0);
  EXPECT_EQ(f.particles[0], 10);
  // Cut into 4, 5 and a single one.
  break_where(*model.bonds, model.particles, [](const Vector3 &m) {
    const int bond = static_cast<int>(m.z / (2 * radius));
    return bond == 3 || bond == 8;
  });
  f = find_fragments(model.particles, model.bonds.get());
  EXPECT_EQ(f.count, 2);
  EXPECT_EQ(f.single, 1);
  EXPECT_EQ(f.particles, (std::vector<int>{5, 4, 1}));
  EXPECT_EQ(f.of_particle[row_of(model.particles, 9)], 2);
  EXPECT_EQ(f.of_particle[row_of(model.particles, 4)], 0);
  EXPECT_NEAR(std::accumulate(f.mass.begin(), f.mass.end(), 0.0), 10 * model.particles.mass[0], 1e-18);
  EXPECT_EQ(find_fragments(model.particles, nullptr).single, 10);
}

TEST(measure, bonds_are_counted_at_both_ends) {
  Model model(row(3, {0, 0, 1}), bonded());
  break_where(*model.bonds, model.particles, [](const Vector3 &m) { return m.z < 2 * radius; });
  const BondCounts c = bond_counts(model.particles, *model.bonds);
  const auto at = [&](const std::vector<int> &column, int id) { return column[row_of(model.particles, id)]; };
  EXPECT_EQ(at(c.broken, 0), 1);
  EXPECT_EQ(at(c.intact, 0), 0);
  EXPECT_EQ(at(c.broken, 1), 1);
  EXPECT_EQ(at(c.intact, 1), 1);
  EXPECT_EQ(at(c.intact, 2), 2);
}

} // namespace
} // namespace platen::dem::measure_test
