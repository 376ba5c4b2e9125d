// What bonds remember and how they are damped, one at a time.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/dem/examples.h"

namespace platen::dem {
namespace {

using namespace examples;

// The pair spins about its line by a radian, as one: shear goes round with it, the right way.
TEST(bond_history, shear_of_a_cohesive_bond_spins_with_the_pair) {
  ElastoDamagePlastic::Parameters p;
  p.poisson_ratio = .2;
  const ElastoDamagePlastic law(p); // never breaks
  const double length = .01, aside = 1e-6;
  const CohesiveGeometry<double> geometry{length, .5, 28e9 / length, 5e-5};
  const Triple<double> distance{0, 0, length}, none{0, 0, 0};
  for (const double angle : {1., -1., 2.}) {
    CohesiveState<double> state{0, 0, 0, {aside, 0, 0}, {0, 0, 0}, 0};
    const double before = law.response(state, geometry, distance).shear.x;
    CohesiveResponse<double> now{};
    constexpr int steps = 1000; // Cayley's form is off by a twelfth of the cube of an angle
    for (int k = 0; k < steps; ++k)
      now = law(state, geometry, {distance, none, none, angle / steps * length});
    EXPECT_NEAR(now.shear.x / before, std::cos(angle), 1e-6) << angle;
    EXPECT_NEAR(now.shear.y / before, std::sin(angle), 1e-6) << angle; // from x to y about z
  }
}

// Onate's dashpot: 2 gamma alpha r_c / |D| of critical, alpha r_c^2 the square of the bond's radius, along
// the normal alone; other bonds take gamma itself.
TEST(bond_history, dashpots_are_the_share_of_critical_that_their_law_says) {
  constexpr double gamma = .3, large = 2 * radius;
  for (const bool by_range : {true, false}) {
    ModelSettings settings = by_range ? interfaces() : bonded();
    settings.bond_dashpot = gamma;
    const double distance = (by_range ? 1.05 : 1.) * (radius + large);
    Specimen s = spheres({{0, 0, 0}, {distance, 0, 0}});
    s.radius = {radius, large};
    const Model model(s, settings);
    const Particles &p = model.particles;
    const Bonds &b = *model.bonds;
    ASSERT_EQ(b.size(), 1u);
    const double section = pi * b.bond_radius[0] * b.bond_radius[0],
                 critical = 2 * std::sqrt(b.normal_stiffness[0] * section * p.mass[0] * p.mass[1] /
                                          (p.mass[0] + p.mass[1])),
                 share = by_range ? gamma * b.bond_radius[0] * b.bond_radius[0] / (radius * distance) : gamma;
    EXPECT_NEAR((*b.dashpot)[0], share * critical, 1e-12 * critical) << by_range;
    EXPECT_NEAR(b.dashpot_shear_ratio, by_range ? 0 : std::sqrt(stiffness_ratio), 1e-12) << by_range;
  }
}

// Bonds that carry forces alone store nothing where a sphere turns on the spot but what their shear takes:
// the loop that sums them up says the same as the law.
TEST(bond_history, bonds_without_moments_store_no_bending) {
  ModelSettings settings = bonded();
  parallel_bond(settings).moments = false;
  Model model(row(6, {1, 0, 0}), settings);
  Particles &p = model.particles;
  for (std::size_t i = 0; i < p.size(); ++i) // a twist that grows along the row: no contact point moves
    (*p.orientation)[i] = rotation_quaternion({1e-3 * p.reference_position[i].x / radius, 0, 0});
  EXPECT_LT(bond_energy(p, *model.bonds), 1e-12 * modulus * radius * radius * radius * 1e-6);
  for (std::size_t i = 0; i < p.size(); ++i)
    p.position[i].y = 1e-3 * radius * std::sin(static_cast<double>(i));
  double sum = 0;
  for (std::size_t k = 0; k < model.bonds->size(); ++k)
    sum += model.bonds->response(k, p).energy;
  EXPECT_NEAR(bond_energy(p, *model.bonds), sum, 1e-12 * sum);
}

// The sum that the equilibrium of a step is compared with: magnitudes of the forces of all bonds.
TEST(bond_history, forces_of_bonds_are_summed_by_their_size) {
  Model model(row(9, {1, 2, -1}), bonded());
  Particles &p = model.particles;
  double sum = 0;
  for (std::size_t i = 0; i < p.size(); ++i)
    p.position[i] +=
        1e-4 * radius *
        Vector3{std::sin(2.0 * static_cast<double>(i)), .3, std::cos(3.0 * static_cast<double>(i))};
  for (std::size_t k = 0; k < model.bonds->size(); ++k) {
    const Triple<double> f = model.bonds->response(k, p).force;
    sum += root(dot(f, f));
  }
  EXPECT_NEAR(bond_totals(p, *model.bonds).force, sum, 1e-9 * sum);
}

// Memory that a model says it takes, by what it has.
TEST(bond_history, memory_is_that_of_spheres_bonds_and_contacts) {
  const Specimen specimen = row(9, {1, 0, 0});
  ModelSettings neither = breakable();
  neither.contact.reset();
  const ModelSettings with_bonds = neither, with_both = breakable();
  neither.bond.reset();
  const Model alone(specimen, neither), bonds(specimen, with_bonds), both(specimen, with_both);
  EXPECT_GE(alone.bytes(), 10 * 9 * sizeof(double)); // places, velocities, forces
  EXPECT_EQ(bonds.bytes() - alone.bytes(), bonds.bonds->bytes());
  EXPECT_GE(bonds.bonds->bytes(), 9 * 8 * sizeof(double));
  EXPECT_EQ(both.bytes() - bonds.bytes(), both.contacts->table.size() * both.contacts->table.bytes_per_row() +
                                              both.contacts->search_state().bytes());
}

} // namespace
} // namespace platen::dem
