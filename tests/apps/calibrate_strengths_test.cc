// The search for strengths, on closed forms that stand for specimens.
#include "apps/calibrate/strengths.h"
#include "base/pi.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "apps/calibrate/response_model.h"
#include "apps/scene/errors.h"

namespace platen::apps {
namespace {

constexpr double degree = pi / 180; // rad

Scene scene_of(double compressive, double tensile, double triaxial = not_given) {
  Scene s;
  s.bond.set("tensile_strength", 9.5e6);
  s.bond.set("shear_strength", 26.6e6);
  s.bond.set("friction_angle", 45 * degree);
  s.bond.set("moment_contribution", 0.3);
  s.calibrate.compressive_strength = compressive;
  s.calibrate.tensile_strength = tensile;
  s.calibrate.triaxial_strength = triaxial;
  s.calibrate.confining_pressure = 4.5e6;
  s.calibrate.tolerance = 0.02;
  s.calibrate.most_trials = 30;
  return s;
}

// A specimen that is made up: tension by the bond's tensile strength alone; compression over tension grows
// with shear over tensile strength to a limit and with falling moments; the rise with pressure is Mohr's and
// Coulomb's for an angle that follows the bond's.
struct StandIn {
  double by_moments = 2.6, by_friction = 0.6;
  double scatter = 0; // of the logarithm of each strength
  std::mt19937 random{1};

  double over_tension(const BondChoice &c) const {
    const double ratio = c.shear_strength / c.tensile_strength;
    return std::exp(2.34 - 0.62 / ratio - by_moments * (c.moment_contribution - 0.3) +
                    0.2 * (c.friction_angle - 45 * degree) / ratio);
  }
  double slope(const BondChoice &c) const {
    const double sine = std::sin(by_friction * c.friction_angle);
    return (1 + sine) / (1 - sine);
  }
  Strengths operator()(const BondChoice &c) {
    std::normal_distribution<double> normal;
    Strengths s;
    const auto noise = [&] { return std::exp(scatter * normal(random)); };
    s.tensile = 0.545 * c.tensile_strength;
    s.compressive = s.tensile * over_tension(c);
    s.triaxial = s.compressive + slope(c) * 4.5e6;
    s.tensile *= noise(), s.compressive *= noise(), s.triaxial *= noise();
    return s;
  }
};

FoundStrengths found(const Scene &scene, StandIn &specimen) {
  return search_strengths(scene, choice_of(scene), [&](const BondChoice &c, int) { return specimen(c); });
}

// Strengths are proportional to the bonds': one trial tells the factor, the second that it was right.
TEST(StrengthSearch, one_wanted_strength_is_met_in_two_trials) {
  for (const double goal : {0.5, 20.0}) {
    StandIn specimen;
    Scene scene = scene_of(not_given, goal * 1e6);
    const FoundStrengths f = found(scene, specimen);
    EXPECT_EQ(f.trials, 2);
    EXPECT_NEAR(f.choice.tensile_strength, goal * 1e6 / 0.545, 1e-3 * goal * 1e6);
    // What tension does not ask for stays as it was.
    EXPECT_NEAR(f.choice.shear_strength / f.choice.tensile_strength, 2.8, 1e-12);
    EXPECT_EQ(f.choice.moment_contribution, 0.3);
    EXPECT_EQ(f.choice.friction_angle, 45 * degree);
  }
}

TEST(StrengthSearch, compressive_and_tensile_strength_are_met_whatever_the_slopes) {
  for (const double slope : {1.3, 2.6, 5.2}) // half, once and twice what the model begins with
    for (const double ratio : {5.0, 8.0, 10.0, 11.9}) {
      StandIn specimen;
      specimen.by_moments = slope;
      const FoundStrengths f = found(scene_of(ratio * 4e6, 4e6), specimen);
      const Strengths s = specimen(f.choice);
      EXPECT_NEAR(s.compressive, ratio * 4e6, 0.02 * ratio * 4e6);
      EXPECT_NEAR(s.tensile, 4e6, 0.02 * 4e6);
      EXPECT_LE(f.trials, 6);
      EXPECT_TRUE(f.missed.empty());
      EXPECT_LE(f.choice.shear_strength, 6 * f.choice.tensile_strength * (1 + 1e-12));
      EXPECT_LE(f.choice.moment_contribution, 0.3);
    }
}

// Means over three packings of 5000 spheres vary by a percent with bonds that differ by less.
TEST(StrengthSearch, scatter_of_the_trials_does_not_lead_it_astray) {
  double trials = 0, worst = 0;
  constexpr int searches = 40;
  for (int k = 0; k < searches; ++k) {
    StandIn specimen;
    specimen.scatter = 0.01, specimen.random.seed(static_cast<unsigned>(k));
    const double ratio = 6 + 0.15 * k;
    const FoundStrengths f = found(scene_of(ratio * 4e6, 4e6), specimen);
    trials += f.trials;
    specimen.scatter = 0;
    const Strengths s = specimen(f.choice);
    worst = std::max(
        {worst, std::abs(std::log(s.compressive / (ratio * 4e6))), std::abs(std::log(s.tensile / 4e6))});
  }
  RecordProperty("mean_trials", std::to_string(trials / searches));
  EXPECT_LE(trials / searches, 5);
  EXPECT_LE(worst, 0.02 + 3 * 0.01); // of the trial that ended it
}

TEST(StrengthSearch, a_triaxial_strength_finds_the_friction_angle) {
  double trials = 0;
  int searches = 0;
  for (const double angle : {15.0, 30.0, 50.0})
    for (const double compressive : {34e6, 44e6}) {
      StandIn specimen;
      BondChoice sought = choice_of(scene_of(1, 1));
      sought.friction_angle = angle * degree;
      const double triaxial = compressive + specimen.slope(sought) * 4.5e6;
      const FoundStrengths f = found(scene_of(compressive, 4e6, triaxial), specimen);
      const Strengths s = specimen(f.choice);
      EXPECT_NEAR(s.compressive, compressive, 0.02 * compressive);
      EXPECT_NEAR(s.tensile, 4e6, 0.02 * 4e6);
      EXPECT_NEAR(s.triaxial, triaxial, 0.02 * triaxial);
      EXPECT_TRUE(f.missed.empty());
      trials += f.trials, ++searches;
    }
  RecordProperty("mean_trials", std::to_string(trials / searches));
  EXPECT_LE(trials / searches, 6);
}

TEST(StrengthSearch, a_triaxial_strength_is_met_beside_a_compressive_one_alone) {
  StandIn specimen;
  const FoundStrengths f = found(scene_of(40e6, not_given, 50e6), specimen);
  EXPECT_NEAR(specimen(f.choice).triaxial, 50e6, 0.02 * 50e6);
  EXPECT_LT(f.choice.friction_angle, 43 * degree); // 45 degree would give 52 MPa
  EXPECT_EQ(f.choice.moment_contribution, 0.3);
}

TEST(StrengthSearch, the_friction_angle_is_turned_within_its_bounds_alone) {
  Scene scene = scene_of(5.4 * 4e6, 4e6);
  scene.bond.set("friction_angle", 0);
  scene.calibrate.moments_low = 0.3; // not to be turned
  scene.calibrate.strengths_high = 1;
  StandIn specimen;
  const FoundStrengths without = found(scene, specimen);
  EXPECT_EQ(without.choice.friction_angle, 0);
  ASSERT_EQ(without.missed.size(), 1u);
  EXPECT_NE(without.missed[0].find("searched from 0.5 to 1)"), std::string::npos);
  scene.calibrate.friction_high = 40 * degree;
  const FoundStrengths with = found(scene, specimen);
  EXPECT_TRUE(with.missed.empty());
  EXPECT_GT(with.choice.friction_angle, 5 * degree);
  EXPECT_LE(with.choice.friction_angle, 40 * degree);
  scene.bond.law = static_cast<int>(dem::BondLaws::place<dem::ElastoDamagePlastic>()); // has none
  EXPECT_FALSE(strength_parameters(scene).friction);
}

TEST(StrengthSearch, what_is_out_of_reach_is_told_after_few_trials) {
  StandIn specimen;
  const FoundStrengths f = found(scene_of(40 * 4e6, 4e6), specimen);
  ASSERT_EQ(f.missed.size(), 1u);
  EXPECT_NE(f.missed[0].find("were not reached"), std::string::npos);
  EXPECT_LE(f.trials, 8);
  EXPECT_NEAR(f.choice.shear_strength / f.choice.tensile_strength, 6, 1e-6);
  EXPECT_NEAR(f.choice.moment_contribution, 0, 1e-6);
  const Strengths s = specimen(f.choice);
  EXPECT_NEAR(s.compressive / 160e6, 4e6 / s.tensile, 0.01); // both are off by as much
}

TEST(StrengthSearch, bonds_too_strong_for_a_peak_are_weakened) {
  StandIn specimen;
  int asked = 0;
  const auto test = [&](const BondChoice &c, int trial) {
    EXPECT_EQ(trial, ++asked);
    Strengths s = specimen(c);
    if (c.tensile_strength > 9e6) s.compressive = not_given;
    return s;
  };
  const Scene scene = scene_of(8 * 4e6, 4e6);
  const FoundStrengths f = search_strengths(scene, choice_of(scene), test);
  EXPECT_NEAR(specimen(f.choice).compressive, 32e6, 0.02 * 32e6);
  EXPECT_EQ(f.trials, asked);
  EXPECT_THROW(search_strengths(scene, choice_of(scene), [](const BondChoice &, int) { return Strengths{}; }),
               NumericsError);
}

TEST(StrengthSearch, a_confined_specimen_without_a_peak_gets_less_friction) {
  StandIn specimen;
  const auto test = [&](const BondChoice &c, int) {
    Strengths s = specimen(c);
    if (c.friction_angle > 40 * degree) s.triaxial = not_given;
    return s;
  };
  const Scene scene = scene_of(34e6, 4e6, 42e6);
  const FoundStrengths f = search_strengths(scene, choice_of(scene), test);
  EXPECT_NEAR(specimen(f.choice).triaxial, 42e6, 0.02 * 42e6);
  EXPECT_TRUE(f.missed.empty());
}

TEST(ResponseModel, learns_the_slopes_of_a_linear_response) {
  Eigen::MatrixXd slopes(2, 2), guess(2, 2);
  slopes << 1, -2, 0.3, 4;
  guess << 1, 0, 0, 1;
  ResponseModel model({{0, -9, 9, 1, false}, {0, -9, 9, 1, false}}, guess);
  for (const auto &[x, y] : {std::pair{0.0, 0.0}, {0.9, 0.1}, {-0.4, 0.8}, {0.7, 0.7}})
    model.add(Eigen::Vector2d(x, y), slopes * Eigen::Vector2d(x, y) + Eigen::Vector2d(2, 1));
  // The guess weighs as much as one trial a thirtieth of a large change away: a hundredth of these.
  EXPECT_LT((model.slopes() - slopes).norm(), 0.03 * (guess - slopes).norm());
}

TEST(ResponseModel, keeps_to_bounds_and_to_a_step) {
  ResponseModel model({{2, 0, 1, 0.3, false}}, Eigen::MatrixXd::Constant(1, 1, 1.0));
  EXPECT_EQ(model.start()[0], 1);
  model.add(model.start(), Eigen::VectorXd::Constant(1, 5.0));
  EXPECT_NEAR((*model.next())[0], 0.7, 1e-6); // a step towards less
  model.add(Eigen::VectorXd::Constant(1, 0.7), Eigen::VectorXd::Constant(1, 6.0));
  EXPECT_FALSE(model.next()); // the response falls with the parameter, which is at its bound
}

TEST(ResponseModel, leaves_known_slopes_as_they_are) {
  ResponseModel model({{0, -9, 9, 9, true}}, Eigen::MatrixXd::Constant(1, 1, 1.0));
  model.add(Eigen::VectorXd::Constant(1, 0.0), Eigen::VectorXd::Constant(1, 1.0));
  model.add(Eigen::VectorXd::Constant(1, -1.0), Eigen::VectorXd::Constant(1, 0.1));
  EXPECT_NEAR(model.slopes()(0, 0), 1, 1e-5);
  EXPECT_NEAR((*model.next())[0], -1.1, 1e-4);
}

} // namespace
} // namespace platen::apps
