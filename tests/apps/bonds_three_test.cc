// platen-bonds on three spheres: the exact linear solution, for every plate. PLATEN_SCENES is the folder of
// scenes.
#include <gtest/gtest.h>

#include <cmath>

#include "apps/bonds/run_bonds.h"
#include "apps/programs.h"
#include "apps/scene/errors.h"

namespace platen::apps {
namespace {

using Words = std::vector<std::string>;

Scene pyramid_scene(const Words &overrides) {
  return read_scene(std::string(PLATEN_SCENES) + "/three_particles.prm", overrides, program("bonds"));
}

constexpr double axial_of_base = 150e9 * 3.14159265358979e-6 / 2e-3; // k_n A, N/m

// Minimum of the elastic energy of the three bonds over the spread u of each base sphere and its rotation,
// for the top sphere pressed down by w = 1; small displacements, no contact forces.
struct Response {
  double stiffness = 0;    // over k_n A: load on the top sphere over its path down
  double strain_ratio = 0; // sqrt(3) u / w: lateral strain of the base over the vertical strain
};
// Base sphere at (R, 0), top sphere at (0, sqrt(3) R); the base sphere moves out by u and rolls outwards by
// theta = t / R. Inclined bond: stretch u/2 - sqrt(3)/2, slip sqrt(3)/2 u + 1/2 + t, relative rotation theta;
// the base bond stretches by 2u and bends by 2 theta, half of it for each half.
Response by_least_energy(double shear_ratio, PairPlate plate, bool base_bond, bool rotation) {
  const double root3 = std::sqrt(3.0), k = shear_ratio, bending = .25; // k_n I over k_n A R^2
  // Energy / (k_n A) = 1/2 (u a11 u + 2 u a12 t + t a22 t) + f1 u + f2 t + 1/2 c.
  double a11 = .25 + .75 * k, a12 = root3 / 2 * k, a22 = k + bending;
  const double f1 = -root3 / 4 + root3 / 4 * k, f2 = k / 2, c = .75 + .25 * k;
  if (base_bond) a11 += 2, a22 += 2 * bending;
  double u = 0, t = 0;
  if (plate == PairPlate::frictionless && rotation) {
    const double determinant = a11 * a22 - a12 * a12;
    u = (-f1 * a22 + f2 * a12) / determinant;
    t = (-f2 * a11 + f1 * a12) / determinant;
  } else if (plate == PairPlate::frictionless) {
    u = -f1 / a11;
  } else if (plate == PairPlate::rolling) { // t = u
    u = t = -(f1 + f2) / (a11 + 2 * a12 + a22);
  } // sticking: neither moves nor turns
  const double energy = .5 * (a11 * u * u + 2 * a12 * u * t + a22 * t * t) + f1 * u + f2 * t + .5 * c;
  return {2 * 2 * energy, root3 * u}; // two halves; F = 2 E / w
}

struct Variant {
  const char *base_bond, *rotation, *plate;
  double strain_ratio[5]; // at k_s / k_n = .5, .6, .7, .8, .9, from the minimum of the energy, to 4 digits
};

void PrintTo(const Variant &v, std::ostream *out) {
  *out << "base bond " << v.base_bond << ", rotation " << v.rotation << ", plate " << v.plate;
}

class Pyramids : public ::testing::TestWithParam<Variant> {};

TEST_P(Pyramids, spread_as_the_least_energy_says) {
  const Variant v = GetParam();
  const Scene scene = pyramid_scene({std::string("Pair test/Base bond = ") + v.base_bond,
                                     std::string("Effects/Rotation = ") + v.rotation,
                                     std::string("Pair test/Plate = ") + v.plate});
  const PairTest &test = pair_test_of(scene);
  const std::vector<BondRun> runs = run_bond_tests(scene);
  ASSERT_EQ(runs.size(), 5u);
  for (std::size_t k = 0; k < 5; ++k) {
    const BondReading &r = runs[k].largest;
    const Response by_hand =
        by_least_energy(test.stiffness_ratios[k], test.plate, test.base_bond, scene.model.rotation);
    EXPECT_NEAR(by_hand.strain_ratio, v.strain_ratio[k], .5001e-4); // the printed digits
    EXPECT_NEAR(r.strain_ratio, by_hand.strain_ratio, 1e-3 * std::abs(by_hand.strain_ratio));
    EXPECT_NEAR(r.force / r.displacement, axial_of_base * by_hand.stiffness,
                1e-4 * axial_of_base * by_hand.stiffness);
  }
  for (std::size_t k = 1; k < 5; ++k) // stiffer shear springs resist spreading
    EXPECT_LE(runs[k].largest.strain_ratio, runs[k - 1].largest.strain_ratio);
}

INSTANTIATE_TEST_SUITE_P(
    bonds_three, Pyramids,
    ::testing::Values(Variant{"off", "off", "frictionless", {.6000, .4286, .2903, .1765, .0811}},
                      Variant{"on", "off", "frictionless", {.1429, .1111, .0811, .0526, .0256}},
                      Variant{"off", "on", "frictionless", {1.6667, 1.6154, 1.5763, 1.5455, 1.5205}},
                      Variant{"on", "on", "frictionless", {.2121, .2000, .1897, .1810, .1733}},
                      Variant{"off", "on", "rolling", {-.0259, -.0848, -.1298, -.1652, -.1939}},
                      Variant{"on", "on", "rolling", {-.0122, -.0432, -.0701, -.0938, -.1148}},
                      Variant{"on", "on", "sticking", {0, 0, 0, 0, 0}}));

// 3(1 - r)/(1 + 3r), (1 - r)/(3 + r), and r/(1 + 4r) for r where spheres turn freely.
TEST(bonds_three, the_energy_gives_the_formulas_of_simple_cases) {
  const auto ratio = [](double r, bool base_bond, bool rotation) {
    return by_least_energy(r, PairPlate::frictionless, base_bond, rotation).strain_ratio;
  };
  for (const double r : {.1, .5, .9, 1.0}) {
    const double softer = r / (1 + 4 * r);
    EXPECT_NEAR(ratio(r, false, false), 3 * (1 - r) / (1 + 3 * r), 1e-12);
    EXPECT_NEAR(ratio(r, true, false), (1 - r) / (3 + r), 1e-12);
    EXPECT_NEAR(ratio(r, false, true), 3 * (1 - softer) / (1 + 3 * softer), 1e-12);
  }
}

TEST(bonds_three, unloading_goes_back_on_the_same_line) {
  const BondRun run =
      run_bond_tests(pyramid_scene({"Pair test/Path = cyclic", "Pair test/Steps = 8",
                                    "Pair test/Stiffness ratio list = 0.7", "Effects/Rotation = on"}))
          .at(0);
  const double stiffness = axial_of_base * by_least_energy(.7, PairPlate::frictionless, true, true).stiffness;
  for (const BondReading &row : run.rows)
    EXPECT_NEAR(row.displacement, row.force / stiffness, 1e-4 / stiffness);
}

TEST(bonds_three, what_a_plate_cannot_do_is_refused) {
  for (const Words &words :
       {Words{"Pair test/Path = tension"}, Words{"Pair test/Path = bending"},
        Words{"Pair test/Plate = rolling"}, Words{"Pair test/Base bond = off", "Effects/Contact = linear"}})
    EXPECT_THROW(run_bond_tests(pyramid_scene(words)), InputError) << words[0];
}

} // namespace
} // namespace platen::apps
