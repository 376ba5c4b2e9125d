// What every elastic bond law has to be, of unequal spheres in any direction, turned and strained finitely;
// the parallel bond against its closed forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "dem/laws/cohesive_beam.h"
#include "dem/laws/parallel_bond.h"
#include "tests/dem/examples.h"

namespace platen::dem::elastic_law_test {
namespace {

using namespace examples;
using Geometry = BondGeometry<double>;
using Motion = BondMotion<double>;
using Response = BondResponse<double>;

Quaternion quaternion(const Rotation<double> &r) {
  return {r.w, r.x, r.y, r.z};
}

struct Parallel {
  static ParallelBond law() {
    return ParallelBond::Parameters{stiffness_ratio, tensile_strength, shear_strength, std::atan(.7), .5};
  }
};
struct WithoutMoments {
  static ParallelBond law() {
    ParallelBond law = Parallel::law();
    law.parameters.moments = false;
    return law;
  }
};
struct Beam {
  static CohesiveBeam law() { return CohesiveBeam::Parameters{.3, 30e6, 90e6, std::atan(.7), .5}; }
};

template <class Of>
class ElasticLaw : public testing::Test {
protected:
  static constexpr double length = 2 * radius;
  Random random{7};
  const decltype(Of::law()) law = Of::law();

  Quaternion random_turn(double most) {
    return rotation_quaternion(random.uniform(0, most) * random.direction());
  }
  struct Bond {
    Geometry geometry;
    Motion motion;
  };
  Bond random_bond() {
    const Vector3 direction = random.direction();
    const double l = length * random.uniform(.6, 1.4);
    Bond b;
    b.geometry = {triple(l * direction), l, random.uniform(.2, .8), normal_stiffness, radius};
    const Quaternion common = random_turn(3);
    b.motion.distance =
        triple(rotate(common, l * (random.uniform(.8, 1.2) * direction + .2 * random.direction())));
    b.motion.turn_i = rotation(random_turn(.5) * common);
    b.motion.turn_j = rotation(random_turn(.5) * common);
    return b;
  }
  static double torque(const Response &r) { return norm(vector(r.torque_i)) + norm(vector(r.torque_j)); }
};
struct Names {
  template <class Of>
  static std::string GetName(int) {
    return std::is_same_v<Of, Beam>       ? "beam"
           : std::is_same_v<Of, Parallel> ? "parallel_bond"
                                          : "without_moments";
  }
};
using ElasticLaws = testing::Types<Parallel, WithoutMoments, Beam>;
TYPED_TEST_SUITE(ElasticLaw, ElasticLaws, Names);

// Action on j is minus the force, by construction; the moments must balance about any point too.
TYPED_TEST(ElasticLaw, forces_and_moments_balance_for_any_finite_motion) {
  for (int trial = 0; trial < 2000; ++trial) {
    const auto b = this->random_bond();
    const Response r = this->law(b.geometry, b.motion);
    const Vector3 lever = cross(vector(b.motion.distance), vector(r.force));
    const Vector3 sum = vector(r.torque_i) + vector(r.torque_j) - lever; // T_i + T_j + d x F_j
    EXPECT_LE(norm(sum), 2e-13 * (this->torque(r) + norm(lever)));
  }
}

// Central differences: h^2 of truncation against 1e-16 / h of round-off leaves about 1e-9 of the scale.
TYPED_TEST(ElasticLaw, forces_are_derivatives_of_the_stored_energy) {
  constexpr double h = 1e-5;
  const double l = this->length;
  for (int trial = 0; trial < 200; ++trial) {
    const auto b = this->random_bond();
    const Response r = this->law(b.geometry, b.motion);
    const double scale = r.energy / l * 10 + norm(vector(r.force));
    for (int c = 0; c < 3; ++c) {
      Vector3 e;
      e[c] = h;
      const auto slope = [&](auto change) {
        Motion plus = b.motion, minus = b.motion;
        change(plus, e);
        change(minus, -e);
        return (this->law(b.geometry, plus).energy - this->law(b.geometry, minus).energy) / (2 * h);
      };
      const double by_distance =
          slope([&](Motion &m, const Vector3 &s) { m.distance = m.distance + triple(l * s); });
      const double by_turn_i = slope([](Motion &m, const Vector3 &s) {
        m.turn_i = rotation(rotation_quaternion(s) * quaternion(m.turn_i));
      });
      const double by_turn_j = slope([](Motion &m, const Vector3 &s) {
        m.turn_j = rotation(rotation_quaternion(s) * quaternion(m.turn_j));
      });
      EXPECT_NEAR(vector(r.force)[c], by_distance / l, 1e-7 * scale); // on i, which moves against d
      EXPECT_NEAR(vector(r.torque_i)[c], -by_turn_i, 1e-7 * scale * l);
      EXPECT_NEAR(vector(r.torque_j)[c], -by_turn_j, 1e-7 * scale * l);
    }
  }
}

TYPED_TEST(ElasticLaw, naming_the_other_end_first_changes_nothing) {
  for (int trial = 0; trial < 500; ++trial) {
    const auto b = this->random_bond();
    Geometry g = b.geometry;
    g.reference = scale(-1.0, g.reference);
    g.lever = 1 - g.lever;
    const Response one = this->law(b.geometry, b.motion),
                   other = this->law(g, {scale(-1.0, b.motion.distance), b.motion.turn_j, b.motion.turn_i});
    EXPECT_LE(norm(vector(one.force + other.force)), 1e-12 * norm(vector(one.force)));
    EXPECT_LE(norm(vector(one.torque_i - other.torque_j)), 1e-12 * this->torque(one));
    EXPECT_LE(norm(vector(one.torque_j - other.torque_i)), 1e-12 * this->torque(one));
    EXPECT_NEAR(one.energy, other.energy, 1e-12 * one.energy);
    EXPECT_NEAR(one.tension_ratio, other.tension_ratio, 1e-12 * std::abs(one.tension_ratio) + 1e-12);
    EXPECT_NEAR(one.shear_ratio, other.shear_ratio, 1e-12 * one.shear_ratio);
  }
}

TYPED_TEST(ElasticLaw, the_frame_of_reference_does_not_matter) {
  for (int trial = 0; trial < 500; ++trial) {
    const auto b = this->random_bond();
    const Quaternion q = this->random_turn(6);
    const Response before = this->law(b.geometry, b.motion),
                   after = this->law(b.geometry, {triple(rotate(q, vector(b.motion.distance))),
                                                  rotation(q * quaternion(b.motion.turn_i)),
                                                  rotation(q * quaternion(b.motion.turn_j))});
    EXPECT_LE(norm(rotate(q, vector(before.force)) - vector(after.force)),
              1e-12 * norm(vector(before.force)));
    EXPECT_LE(norm(rotate(q, vector(before.torque_i)) - vector(after.torque_i)),
              1e-12 * this->torque(before));
    EXPECT_LE(norm(rotate(q, vector(before.torque_j)) - vector(after.torque_j)),
              1e-12 * this->torque(before));
    EXPECT_NEAR(before.tension_ratio, after.tension_ratio, 1e-10);
  }
}

// Turned by any angle, the sign of a quaternion included.
TYPED_TEST(ElasticLaw, stores_nothing_when_it_is_turned_rigidly) {
  for (int trial = 0; trial < 100; ++trial) {
    auto b = this->random_bond();
    const Quaternion q = this->random_turn(6);
    b.motion = {triple(rotate(q, vector(b.geometry.reference))), rotation(q),
                rotation(trial % 2 ? q : Quaternion{-q.w, -q.x, -q.y, -q.z})};
    const Response r = this->law(b.geometry, b.motion);
    const double force = normal_stiffness * area * this->length;
    EXPECT_LT(norm(vector(r.force)), 1e-12 * force);
    EXPECT_LT(this->torque(r), 1e-12 * force * this->length);
    EXPECT_LT(r.energy, 1e-24 * force * this->length);
  }
}

// The loops ask for the excess alone; the ratios then decide.
TYPED_TEST(ElasticLaw, no_ratio_reaches_one_where_the_excess_is_below_zero) {
  // Of beams, whose excess is computed another way, but for round-off.
  const double one = std::is_same_v<TypeParam, Beam> ? 1 + 1e-12 : 1;
  long reached = 0, held = 0, in_doubt = 0;
  for (int trial = 0; trial < 4000; ++trial) {
    const auto b = this->random_bond();
    auto p = this->law.parameters;
    p.moment_contribution = trial % 3 * .5;
    const Response at_hand = decltype(this->law)(p)(b.geometry, b.motion);
    // Strengths about what this motion asks for, so that both outcomes are seen, the very limit among them.
    const double share = trial % 5 == 0 ? 1 : .5 + this->random.uniform();
    if (at_hand.tension_ratio > 0) p.tensile_strength *= share * at_hand.tension_ratio;
    p.shear_strength *= 10 * this->random.uniform() * at_hand.shear_ratio;
    const Response r = decltype(this->law)(p)(b.geometry, b.motion);
    const double ratio = std::max(r.tension_ratio, r.shear_ratio);
    EXPECT_TRUE(r.excess >= 0 || ratio < one) << trial << ", " << ratio - 1;
    EXPECT_TRUE(r.excess < 0 || ratio >= 1 - 1e-9) << trial;
    (ratio >= 1 ? reached : held) += 1;
    in_doubt += std::abs(ratio - 1) < 1e-9;
  }
  EXPECT_GT(reached, 500);
  EXPECT_GT(held, 500);
  EXPECT_GT(in_doubt, 100);
}

TYPED_TEST(ElasticLaw, a_broken_bond_is_silent) {
  auto b = this->random_bond();
  b.geometry.normal_stiffness = 0;
  const Response r = this->law(b.geometry, b.motion);
  EXPECT_EQ(norm(vector(r.force)) + this->torque(r) + r.energy, 0);
  EXPECT_EQ(r.tension_ratio, 0);
  EXPECT_NEAR(r.shear_ratio, 0, 1e-12);
}

using ParallelLaw = ElasticLaw<Parallel>; // the only one with a form of its own
TEST_F(ParallelLaw, without_turning_both_forms_agree) {
  for (int trial = 0; trial < 200; ++trial) {
    auto b = random_bond();
    b.motion.turn_i = b.motion.turn_j = {1, 0, 0, 0};
    b.motion.distance = b.geometry.reference + triple(.1 * length * random.direction());
    const Response with = law(b.geometry, b.motion),
                   without = law.without_rotation(b.geometry, b.motion.distance);
    EXPECT_LE(norm(vector(with.force - without.force)), 1e-12 * norm(vector(with.force)));
    EXPECT_NEAR(with.energy, without.energy, 1e-12 * with.energy);
    EXPECT_NEAR(with.tension_ratio, without.tension_ratio, 1e-10 * std::abs(with.tension_ratio));
    EXPECT_NEAR(with.shear_ratio, without.shear_ratio, 1e-10 * with.shear_ratio);
  }
}

constexpr double bond_length = 2 * radius;

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

// Linear: only round-off of the length, 1e-16 over the strain of 1e-4, is left.
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
  const double tangent = std::tan(42 * degree), pressure = 20e6; // Pa
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
} // namespace platen::dem::elastic_law_test
