// The bond law by itself: one bond driven by hand.
#include "dem/laws/parallel_bond.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "tests/dem/examples.h"

namespace platen::dem {
namespace {

using namespace examples;
using Geometry = BondGeometry<double>;
using Response = BondResponse<double>;

constexpr double bond_length = 2 * radius;

Quaternion random_turn(Random &random, double most) {
  return rotation_quaternion(random.uniform(0, most) * random.direction());
}

ParallelBond breakable_bond(double friction = 0, double beta = 1) {
  return ParallelBond::Parameters{stiffness_ratio, tensile_strength, shear_strength, std::atan(friction),
                                  beta};
}

// Equal spheres along x.
Geometry along_x() {
  return {{bond_length, 0, 0}, bond_length, .5, normal_stiffness, radius};
}
BondMotion<double> at_rest() {
  return {{bond_length, 0, 0}, {1, 0, 0, 0}, {1, 0, 0, 0}};
}

struct RandomBond {
  Geometry geometry;
  BondMotion<double> motion;
};
// Unequal spheres in any direction, turned and strained finitely.
RandomBond random_bond(Random &random) {
  const Vector3 direction = random.direction();
  const double length = bond_length * random.uniform(.6, 1.4);
  RandomBond b;
  b.geometry = {triple(length * direction), length, random.uniform(.2, .8), normal_stiffness, radius};
  const Quaternion common = random_turn(random, 3);
  b.motion.distance =
      triple(rotate(common, length * (random.uniform(.8, 1.2) * direction + .2 * random.direction())));
  b.motion.turn_i = rotation(random_turn(random, .5) * common);
  b.motion.turn_j = rotation(random_turn(random, .5) * common);
  return b;
}

// Linear: only round-off of the length, 1e-16 over the strain of 1e-5, is left.
TEST(parallel_bond, axial_force_follows_youngs_modulus) {
  const double force = 100; // N
  BondMotion<double> m = at_rest();
  m.distance.x += force * bond_length / (modulus * area);
  const Response r = breakable_bond()(along_x(), m);
  EXPECT_NEAR(r.force.x, force, 1e-10 * force);
  EXPECT_NEAR(r.normal_force, force, 1e-10 * force);
  EXPECT_EQ(r.force.y, 0);
  EXPECT_EQ(r.force.z, 0);
}

TEST(parallel_bond, tension_breaks_at_strength_times_area) {
  BondMotion<double> m = at_rest();
  m.distance.x += tensile_strength * bond_length / modulus;
  const Response r = breakable_bond()(along_x(), m);
  EXPECT_NEAR(r.tension_ratio, 1, 1e-10);
  EXPECT_NEAR(r.force.x, tensile_strength * area, 1e-10 * tensile_strength * area);
  EXPECT_NEAR(r.shear_ratio, 0, 1e-14);
}

// Ends turned against each other about y: sigma_c I / R_b.
TEST(parallel_bond, bending_breaks_at_the_section_modulus) {
  const double strength = tensile_strength * second_moment / radius;
  const double angle = strength / (normal_stiffness * second_moment);
  BondMotion<double> m = at_rest();
  m.turn_i = rotation(rotation_quaternion({0, -.5 * angle, 0}));
  m.turn_j = rotation(rotation_quaternion({0, .5 * angle, 0}));
  const Response r = breakable_bond()(along_x(), m);
  // sin(angle) for angle: angle^2 / 6 = 3e-8 here.
  EXPECT_NEAR(r.tension_ratio, 1, 1e-7);
  EXPECT_NEAR(r.torque_i.y, strength, 1e-7 * strength);
  EXPECT_NEAR(r.torque_i.y / strength, r.tension_ratio, 1e-10);
  EXPECT_NEAR(r.torque_j.y, -r.torque_i.y, 1e-12 * strength);
  EXPECT_LT(r.shear_ratio, 1e-10);
}

TEST(parallel_bond, bending_stiffness_is_that_of_the_section) {
  const double angle = 1e-6; // relative error angle^2 / 6
  BondMotion<double> m = at_rest();
  m.turn_j = rotation(rotation_quaternion({0, 0, angle}));
  m.distance = triple(.5 * bond_length * (Vector3{1, 0, 0} + Vector3{std::cos(angle), std::sin(angle), 0}));
  const Response r = breakable_bond()(along_x(), m); // the contact points stay together: no shear
  const double moment = normal_stiffness * second_moment * angle;
  EXPECT_NEAR(r.torque_i.z, moment, 1e-9 * moment);
  EXPECT_NEAR(r.torque_j.z, -moment, 1e-9 * moment);
}

TEST(parallel_bond, torsion_breaks_at_the_polar_section_modulus) {
  const double strength = shear_strength * polar_moment / radius;
  const double angle = strength / (shear_stiffness * polar_moment);
  BondMotion<double> m = at_rest();
  m.turn_j = rotation(rotation_quaternion({angle, 0, 0}));
  const Response r = breakable_bond()(along_x(), m);
  const double softening = angle * angle / 6; // sin(angle) for angle
  EXPECT_NEAR(r.shear_ratio, 1 - softening, 1e-9);
  EXPECT_NEAR(r.torque_i.x, strength * (1 - softening), 1e-9 * strength);
  EXPECT_NEAR(r.torque_i.x / strength, r.shear_ratio, 1e-10);
  EXPECT_EQ(r.tension_ratio, 0);
}

// Spheres shifted against each other without turning: no moment at the contact point.
TEST(parallel_bond, shear_follows_its_stiffness) {
  const double slip = 1e-6 * bond_length;
  BondMotion<double> m = at_rest();
  m.distance.y = slip;
  const Response r = breakable_bond()(along_x(), m);
  const double force = shear_stiffness * area * slip;
  EXPECT_NEAR(r.force.y, force, 1e-9 * force); // second order in slip / length
  EXPECT_NEAR(r.torque_i.z, .5 * bond_length * force, 1e-9 * .5 * bond_length * force);
}

TEST(parallel_bond, shear_breaks_at_strength_times_area) {
  const double slip = shear_strength / shear_stiffness;
  BondMotion<double> m = at_rest();
  // On the sphere around i, so that shear is all there is: the slip is the component along the tangent.
  const double angle = std::asin(slip / bond_length);
  m.distance = {bond_length * std::cos(angle), bond_length * std::sin(angle), 0};
  const Response r = breakable_bond()(along_x(), m);
  EXPECT_NEAR(r.shear_ratio, 1, 1e-10);
  EXPECT_NEAR(r.shear_force, shear_strength * area, 1e-10 * shear_strength * area);
  EXPECT_NEAR(r.tension_ratio, 0, 1e-10);
}

TEST(parallel_bond, compression_alone_never_breaks) {
  for (const double strain : {1e-6, 1e-3, .1, .5}) {
    BondMotion<double> m = at_rest();
    m.distance.x *= 1 - strain;
    const Response r = breakable_bond()(along_x(), m);
    EXPECT_LT(r.tension_ratio, 0);
    EXPECT_NEAR(r.shear_ratio, 0, 1e-12);
  }
}

TEST(parallel_bond, friction_angle_raises_the_shear_strength_by_the_compression) {
  const double tangent = std::tan(42 * pi / 180), pressure = 20e6; // Pa
  BondMotion<double> m = at_rest();
  const double length = bond_length * (1 - pressure / modulus);
  const double strength = shear_strength + tangent * pressure;
  // The slip is |u_s| of u = d - D.
  const double angle = std::asin(strength / shear_stiffness / bond_length);
  m.distance = {length * std::cos(angle), length * std::sin(angle), 0};
  EXPECT_NEAR(breakable_bond(tangent)(along_x(), m).shear_ratio, 1, 1e-10);
  EXPECT_NEAR(breakable_bond()(along_x(), m).shear_ratio, strength / shear_strength, 1e-9);
  // Tension takes nothing away.
  const double longer = bond_length * (1 + 1e-4);
  m.distance = {longer * std::cos(angle), longer * std::sin(angle), 0};
  EXPECT_NEAR(breakable_bond(tangent)(along_x(), m).shear_ratio, strength / shear_strength, 1e-9);
}

TEST(parallel_bond, moment_contribution_scales_only_the_moments) {
  BondMotion<double> m = at_rest();
  m.distance.x *= 1 + 1e-5;
  const double axial = breakable_bond()(along_x(), m).tension_ratio;
  m.turn_i = rotation(rotation_quaternion({-1e-5, -1e-4, 0}));
  m.turn_j = rotation(rotation_quaternion({1e-5, 1e-4, 0}));
  const Response whole = breakable_bond(0, 1)(along_x(), m), third = breakable_bond(0, .3)(along_x(), m),
                 none = breakable_bond(0, 0)(along_x(), m);
  EXPECT_NEAR(none.tension_ratio, axial, 1e-14);
  EXPECT_NEAR(third.tension_ratio - axial, .3 * (whole.tension_ratio - axial), 1e-12);
  EXPECT_NEAR(third.shear_ratio - none.shear_ratio, .3 * (whole.shear_ratio - none.shear_ratio), 1e-12);
  EXPECT_EQ(whole.energy, none.energy); // strength only
}

// The loops ask for the excess alone; the ratios then decide.
TEST(parallel_bond, no_ratio_reaches_one_where_the_excess_is_below_zero) {
  Random random(23);
  long reached = 0, held = 0, in_doubt = 0;
  for (int trial = 0; trial < 4000; ++trial) {
    const RandomBond b = random_bond(random);
    ParallelBond::Parameters p = breakable_bond(.7, trial % 3 * .5).parameters;
    const Response at_hand = ParallelBond(p)(b.geometry, b.motion);
    // Strengths about what this motion asks for, so that both outcomes are seen, the very limit among them.
    const double share = trial % 5 == 0 ? 1 : .5 + random.uniform();
    if (at_hand.tension_ratio > 0) p.tensile_strength *= share * at_hand.tension_ratio;
    p.shear_strength *= 10 * random.uniform() * at_hand.shear_ratio;
    const Response r = ParallelBond(p)(b.geometry, b.motion);
    const double ratio = std::max(r.tension_ratio, r.shear_ratio);
    if (r.excess < 0) {
      EXPECT_LT(ratio, 1);
    }
    if (ratio < 1 - 1e-9) {
      EXPECT_LT(r.excess, 0);
    }
    (ratio >= 1 ? reached : held) += 1;
    in_doubt += std::abs(ratio - 1) < 1e-9;
  }
  EXPECT_GT(reached, 500);
  EXPECT_GT(held, 500);
  EXPECT_GT(in_doubt, 100);
}

// Bonds that resist no bending or twisting: a twist about the axis, and a bend that leaves both contact
// points where they are, store nothing.
TEST(parallel_bond, without_moments_turning_about_the_contact_point_costs_nothing) {
  ParallelBond law = breakable_bond();
  law.parameters.moments = false;
  BondMotion<double> m = at_rest();
  m.turn_j = rotation(rotation_quaternion({.3, 0, 0}));
  const Response twisted = law(along_x(), m);
  EXPECT_NEAR(twisted.energy, 0, 1e-20);
  EXPECT_LT(twisted.shear_ratio, 1e-10);
  law.parameters.moments = true;
  EXPECT_GT(law(along_x(), m).energy, 0);
}

} // namespace
} // namespace platen::dem
