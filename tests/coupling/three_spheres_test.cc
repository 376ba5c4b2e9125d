// Three bonded spheres pressed between two plates: bonds, rotation and surface contact together against the
// exact linear solution, with plates that slide and with plates that do not.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "dem/model.h"
#include "sphere_scene.h"

namespace platen::coupling::three_spheres_test {
namespace {

constexpr double modulus = 40e9; // Pa, of the bonds

// u/w of the two lower spheres, times sqrt 3: lateral move of each over the approach of the upper one.
double strain_ratio(double stiffness_ratio, bool rotation, double friction) {
  const double r = sphere_radius, height = std::sqrt(3.0) * r;
  dem::ModelSettings settings;
  settings.rotation = rotation;
  settings.local_damping = 0.7;
  settings.bond_layout.modulus = modulus;
  settings.bond_layout.gap.value = 1e-6;
  dem::ParallelBond::Parameters bond;
  bond.stiffness_ratio = stiffness_ratio;
  settings.bond = bond;
  dem::Model model(spheres({{-r, 0, 0}, {r, 0, 0}, {0, 0, height}}), settings);
  EXPECT_EQ(model.bonds->initial_count(), 3u);

  fem::RigidBody bottom(
      fem::make_grid(fem::BoxPlate{{-4 * r, -4 * r, -3 * r}, {4 * r, 4 * r, -r}, {7, 7, 1}}), steel);
  fem::RigidBody top(
      fem::make_grid(fem::BoxPlate{{-4 * r, -4 * r, height + r}, {4 * r, 4 * r, height + 3 * r}, {4, 4, 1}}),
      steel);
  const double axial = settings.bond_layout.axial_stiffness(r, r);
  SurfaceContact contact = frictional(friction, friction);
  contact.particle_stiffness =
      300 * axial; // its own give is 1/300 of the bonds' and falls out of the ratio but for slip
  contact.tangential_ratio = 3;
  ContactLayer below(model.particles, bottom, contact), above(model.particles, top, contact);

  const double mass = model.particles.mass[0], dt = 0.1 * std::sqrt(mass / (900 * axial));
  const double press = 1e-4 * r; // small: the solution is linear
  const int ramp = 20000, settle = 60000;
  for (int n = 0; n < ramp + settle; ++n) {
    model.begin_step(dt);
    top.set_velocity({0, 0, n < ramp ? -press / (ramp * dt) : 0.0});
    top.drift(dt);
    double fastest = 0;
    for (const Vector3 &v : model.particles.velocity)
      fastest = std::max(fastest, norm(v));
    model.compute_forces(dt);
    for (auto *pair : {&below, &above}) {
      fem::RigidBody &body = pair == &below ? bottom : top;
      pair->moved(fastest * dt + body.largest_move(dt));
      body.clear_loads();
      pair->add_forces(model.particles, body, dt);
    }
    model.end_step(dt);
  }
  double lateral = 0, sunk_low = 0, sunk_high = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector3 u = model.particles.position[i] - model.particles.reference_position[i];
    if (model.particles.id[i] == 2)
      sunk_high = -u.z;
    else
      lateral += 0.5 * std::copysign(1.0, model.particles.position[i].x) * u.x, sunk_low -= 0.5 * u.z;
  }
  EXPECT_LT(model.last_sums().kinetic_energy, 1e-8 * model.energy().bonds); // at rest
  return std::sqrt(3.0) * lateral / (sunk_high - sunk_low);
}

// On slippery plates (1 - r)/(3 + r), the linear solution of a pair of springs at 60 degrees, met to the
// relative size of the motion; where they may turn the minimum of the energy of bonds with rotation, four
// published digits; on plates that hold the contact point they roll and draw together, where the springs
// along the plate give by 1/900 of the bonds' stiffness.
TEST(three_spheres, spread_as_the_linear_solution_says) {
  constexpr double r[3] = {.5, .7, .9}, turning[3] = {.2121, .1897, .1733},
                   rolling[3] = {-.0122, -.0701, -.1148};
  for (int k = 0; k < 3; ++k) {
    const double sliding = (1 - r[k]) / (3 + r[k]);
    EXPECT_NEAR(strain_ratio(r[k], false, 0), sliding, 1e-3 * sliding);
    EXPECT_NEAR(strain_ratio(r[k], true, 0), turning[k], 1e-3 * turning[k]);
    EXPECT_NEAR(strain_ratio(r[k], true, std::numeric_limits<double>::infinity()), rolling[k], 1e-3);
  }
}

} // namespace
} // namespace platen::coupling::three_spheres_test
