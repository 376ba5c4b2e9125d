// Rows of bonded spheres against strength of materials.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/dem/examples.h"
#include "tests/dem/static_solve.h"

namespace platen::dem::bond_chain_test {
namespace {

using namespace examples;

// Loads are so small that finite rotation, of the order of (deflection / length)^2, stays at 1e-9, and so
// large that the round-off of forces, which Newton's method runs into, stays at 1e-9 of the load.
constexpr double slenderness = 3e-5, closeness = 2e-8;

class ChainOf : public testing::TestWithParam<int> {};

Vector3 tip_displacement(Model &model, int bonds) {
  const std::size_t tip = row_of(model.particles, bonds);
  return model.particles.position[tip] - model.particles.reference_position[tip];
}

// Sphere 0 clamped, tip load P: P [l^3/(3 G_b I) (1 - 1/(4 n^2)) + l/(r G_b A)], exact for every n.
TEST_P(ChainOf, bends_as_a_beam_of_n_rigid_links_does) {
  const int n = GetParam();
  const double l = 2 * radius * n;
  const double compliance = l * l * l / (3 * modulus * second_moment) * (1 - 1.0 / (4.0 * n * n)) +
                            l / (stiffness_ratio * modulus * area);
  const double load = slenderness * l / compliance;
  Model model(row(n, {1, 0, 0}), bonded());
  solve_statics(model, {row_of(model.particles, 0)}, {{row_of(model.particles, n), {0, 0, load}, {}}},
                radius);
  const Vector3 tip = tip_displacement(model, n);
  EXPECT_NEAR(tip.z, load * compliance, closeness * load * compliance);
  EXPECT_LT(std::abs(tip.y), closeness * tip.z);
}

TEST_P(ChainOf, stretches_as_a_rod_does) {
  const int n = GetParam();
  const double l = 2 * radius * n, load = slenderness * modulus * area;
  Model model(row(n, {0, 1, 0}), bonded());
  solve_statics(model, {row_of(model.particles, 0)}, {{row_of(model.particles, n), {0, load, 0}, {}}},
                radius);
  const double elongation = load * l / (modulus * area);
  EXPECT_NEAR(tip_displacement(model, n).y, elongation, closeness * elongation);
}

TEST_P(ChainOf, twists_as_a_shaft_does) {
  const int n = GetParam();
  const double l = 2 * radius * n;
  const double twist = 3e-5, torque = twist * stiffness_ratio * modulus * polar_moment / l; // G J / l
  Model model(row(n, {0, 0, 1}), bonded());
  const std::size_t tip = row_of(model.particles, n);
  solve_statics(model, {row_of(model.particles, 0)}, {{tip, {}, {0, 0, torque}}}, radius);
  const Quaternion q = (*model.particles.orientation)[tip];
  EXPECT_NEAR(2 * std::asin(q.z), twist, closeness * twist);
}

INSTANTIATE_TEST_SUITE_P(bond_chain, ChainOf, testing::Values(1, 2, 3, 7));

// One bond: the moment P R at the bond gives sigma = 4 P / A, so that P = min(sigma_c / 4, tau_c) A breaks
// it.
TEST(bond_chain, a_transverse_load_bends_the_only_bond) {
  ModelSettings settings = bonded();
  parallel_bond(settings).tensile_strength = tensile_strength;
  parallel_bond(settings).shear_strength = shear_strength;
  Model model(row(1, {1, 0, 0}), settings);
  const double load = .25 * tensile_strength * area;
  solve_statics(model, {row_of(model.particles, 0)}, {{row_of(model.particles, 1), {0, load, 0}, {}}},
                radius);
  const BondResponse<double> r = model.bonds->response(0, model.particles);
  // Finite rotation: the deflection is 1e-3 of the length here.
  EXPECT_NEAR(r.tension_ratio, 1, 2e-3);
  EXPECT_NEAR(r.shear_ratio, load / area / shear_strength, 2e-3);
  const double compliance =
      1 / (shear_stiffness * area) + radius * radius / (normal_stiffness * second_moment);
  EXPECT_NEAR(tip_displacement(model, 1).y, load * compliance, 1e-3 * load * compliance);
}

// The explicit scheme with local damping comes to rest at the same place.
TEST(bond_chain, dynamic_relaxation_finds_the_static_deflection) {
  const int n = 3;
  const double l = 2 * radius * n;
  const double compliance = l * l * l / (3 * modulus * second_moment) * (1 - 1.0 / (4.0 * n * n)) +
                            l / (stiffness_ratio * modulus * area);
  const double load = 1e-5 * l / compliance;
  ModelSettings settings = bonded();
  settings.local_damping = .5;
  Model model(row(n, {1, 0, 0}), settings);
  const std::size_t clamp = row_of(model.particles, 0), tip = row_of(model.particles, n);
  model.particles.mass[clamp] = (*model.particles.inertia)[clamp] = 1e30; // does not move within this test
  const double dt = .5 * model.stable_step({}, 0).limit;
  for (int s = 0; s < 20000; ++s)
    step(model, dt, [&](Particles &p) { p.force[tip].z += load; });
  EXPECT_NEAR(tip_displacement(model, n).z, load * compliance, 1e-7 * load * compliance);
}

} // namespace
} // namespace platen::dem::bond_chain_test
