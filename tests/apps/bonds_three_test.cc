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

struct Variant {
  const char *base_bond, *rotation, *plate;
  double strain_ratio[5]; // at k_s / k_n = .5, .6, .7, .8, .9, from the minimum of the energy, to 4 digits
};

void PrintTo(const Variant &v, std::ostream *out) {
  *out << "base bond " << v.base_bond << ", rotation " << v.rotation << ", plate " << v.plate;
}

class Pyramids : public testing::TestWithParam<Variant> {};

TEST_P(Pyramids, spread_as_the_least_energy_says) {
  const Variant v = GetParam();
  const std::vector<BondRun> runs = run_bond_tests(pyramid_scene(
      {std::string("Pair test/Base bond = ") + v.base_bond, std::string("Effects/Rotation = ") + v.rotation,
       std::string("Pair test/Plate = ") + v.plate}));
  ASSERT_EQ(runs.size(), 5u);
  for (std::size_t k = 0; k < 5; ++k) {
    const RigReading &r = runs[k].path.largest;
    EXPECT_NEAR(runs[k].strain_ratio_by_hand, v.strain_ratio[k], .5001e-4); // the printed digits
    EXPECT_NEAR(r.strain_ratio, runs[k].strain_ratio_by_hand, 1e-3 * std::abs(runs[k].strain_ratio_by_hand));
    EXPECT_NEAR(r.force / r.displacement, runs[k].stiffness_by_hand, 1e-4 * runs[k].stiffness_by_hand);
  }
  for (std::size_t k = 1; k < 5; ++k) // stiffer shear springs resist spreading
    EXPECT_LE(runs[k].path.largest.strain_ratio, runs[k - 1].path.largest.strain_ratio);
}

INSTANTIATE_TEST_SUITE_P(
    bonds_three, Pyramids,
    testing::Values(Variant{"off", "off", "frictionless", {.6000, .4286, .2903, .1765, .0811}},
                    Variant{"on", "off", "frictionless", {.1429, .1111, .0811, .0526, .0256}},
                    Variant{"off", "on", "frictionless", {1.6667, 1.6154, 1.5763, 1.5455, 1.5205}},
                    Variant{"on", "on", "frictionless", {.2121, .2000, .1897, .1810, .1733}},
                    Variant{"off", "on", "rolling", {-.0259, -.0848, -.1298, -.1652, -.1939}},
                    Variant{"on", "on", "rolling", {-.0122, -.0432, -.0701, -.0938, -.1148}},
                    Variant{"on", "on", "sticking", {0, 0, 0, 0, 0}}));

// 3(1 - r)/(1 + 3r), (1 - r)/(3 + r), and r/(1 + 4r) for r where spheres turn freely.
TEST(bonds_three, the_energy_gives_the_formulas_of_simple_cases) {
  Pyramid p;
  p.bond.sphere_radius = p.bond.bond_radius = 1e-3;
  p.bond.modulus = 150e9;
  for (const double r : {.1, .5, .9, 1.0}) {
    p.bond.stiffness_ratio = r;
    p.rotation = false, p.base_bond = false;
    EXPECT_NEAR(pyramid_response(p).strain_ratio, 3 * (1 - r) / (1 + 3 * r), 1e-12);
    p.base_bond = true;
    EXPECT_NEAR(pyramid_response(p).strain_ratio, (1 - r) / (3 + r), 1e-12);
    p.rotation = true, p.base_bond = false;
    const double softer = r / (1 + 4 * r);
    EXPECT_NEAR(pyramid_response(p).strain_ratio, 3 * (1 - softer) / (1 + 3 * softer), 1e-12);
  }
}

TEST(bonds_three, unloading_goes_back_on_the_same_line) {
  const BondRun run =
      run_bond_tests(pyramid_scene({"Pair test/Path = cyclic", "Pair test/Steps = 8",
                                    "Pair test/Stiffness ratio list = 0.7", "Effects/Rotation = on"}))
          .at(0);
  for (const RigReading &row : run.path.rows)
    EXPECT_NEAR(row.displacement, row.force / run.stiffness_by_hand, 1e-4 / run.stiffness_by_hand);
}

TEST(bonds_three, what_a_plate_cannot_do_is_refused) {
  for (const Words &words :
       {Words{"Pair test/Path = tension"}, Words{"Pair test/Path = bending"},
        Words{"Pair test/Plate = rolling"}, Words{"Pair test/Base bond = off", "Effects/Contact = linear"}})
    EXPECT_THROW(run_bond_tests(pyramid_scene(words)), InputError) << words[0];
}

} // namespace
} // namespace platen::apps
