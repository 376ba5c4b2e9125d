// platen-bonds on a yielding parallel bond that is led, beside theory 2.7. PLATEN_SCENES is the folder of the
// scenes.
#include <gtest/gtest.h>

#include <cmath>

#include "apps/bonds/run_bonds.h"
#include "apps/compared_pair.h"
#include "apps/programs.h"
#include "apps/scene/errors.h"
#include "tests/measured.h"

namespace platen::apps::testing {
namespace {

using Words = std::vector<std::string>;

// The scene's concrete: spheres of 1 mm, G_b 48 GPa.
constexpr double section_area = 3.14159265358979323846e-6;

ComparedRun run_yielding(Words overrides) {
  if (!overrides.empty()) overrides.insert(overrides.begin(), "Pair test/Turns =");
  return compared_run("yielding_bond.prm", overrides);
}

void expect_yields_by_hand(const ComparedRun &run, double tolerance) {
  EXPECT_LT(run.largest_difference(), tolerance);
  const BondReading &m = run.last();
  EXPECT_NEAR(m.dissipated, run.by_hand.back().dissipated, 10 * tolerance * m.work);
  EXPECT_NEAR(m.work, m.stored + m.dissipated, 10 * tolerance * m.work);
}

TEST(bonds_yielding, closing_yields_unloads_and_comes_back_as_by_hand) {
  const ComparedRun run = run_yielding({});
  expect_yields_by_hand(run, 1e-8);
  measured::expect_below(51, "load_off_in_compression", run.largest_difference(), 1e-8);
  // 160 MPa at 60 + 150 + 600 over 48000 MPa, then a slope of G_b/22 up to 50 um of 2 mm.
  const double stress = 160e6 + (0.025 - 810e6 / 48e9) * 48e9 / 22;
  EXPECT_NEAR(run.rows.back().force, -stress * section_area, 1e-8 * stress * section_area);
  EXPECT_NEAR(run.last().plastic_closing, 2e-3 * (0.025 - stress / 48e9), 1e-12);
  EXPECT_EQ(run.broken_tension + run.broken_shear, 0);
}

TEST(bonds_yielding, tension_is_brittle_at_its_strength) {
  const ComparedRun run = run_yielding({"Pair test/Path = tension", "Pair test/Displacement = 0.5 um"});
  expect_yields_by_hand(run, 1e-8);
  EXPECT_NEAR(run.break_load, 9e6 * section_area, 1e-8 * 9e6 * section_area);
  EXPECT_EQ(run.rows.back().force, 0);
  EXPECT_EQ(run.broken_tension, 1);
  const double whole = 0.5 * 9e6 * section_area * 9e6 / 48e9 * 2e-3;
  EXPECT_NEAR(run.last().dissipated, whole, 1e-8 * whole);
}

TEST(bonds_yielding, shear_under_pressure_falls_to_the_friction_of_grains) {
  const Words sheared{"Pair test/Path = shear", "Pair test/Pressure = 80 MPa"};
  Words there = sheared, there_and_back = sheared;
  there.emplace_back("Pair test/Displacement = 20 um");
  there_and_back.emplace_back("Pair test/Turns = 5 um, -8 um, 20 um, -20 um");
  for (const ComparedRun &run : {run_yielding(there), run_yielding(there_and_back)}) {
    expect_yields_by_hand(run, 1e-5);
    EXPECT_EQ(run.broken_shear, 1);
    EXPECT_NEAR(std::abs(run.rows.back().force), 0.35 * 80e6 * section_area, 1e-8 * 80e6 * section_area);
    EXPECT_NEAR(run.break_load, (36e6 + 40e6) * section_area,
                5e-3 * 76e6 * section_area); // at arms that are 0.25 % shorter
  }
}

TEST(bonds_yielding, tension_and_shear_at_once_break_by_the_first_of_both) {
  const ComparedRun run = run_yielding(
      {"Pair test/Path = combined", "Pair test/Slip ratio = 3", "Pair test/Displacement = 3 um"});
  EXPECT_EQ(run.broken_tension, 1);          // 9 MPa against 3 / 4 of it in shear
  EXPECT_LT(run.largest_difference(), 1e-3); // lines by hand are of small strains
  EXPECT_EQ(run.rows.back().force, 0);
}

// M = sigma I/(beta R_b) of 9 MPa and tau J/(beta R_b), of what neither opens nor slips.
TEST(bonds_yielding, bending_and_twisting_break_at_the_strength_of_the_skin) {
  for (const bool twists : {false, true}) {
    const ComparedRun run =
        run_yielding({std::string("Pair test/Path = ") + (twists ? "twisting" : "bending"),
                      "Bond/Moment contribution = 0.5", "Pair test/Turns = 0.5 um, -1 um, 60 um"});
    expect_yields_by_hand(run, 1e-7);
    measured::expect_below(51, twists ? "load_off_in_twisting" : "load_off_in_bending",
                           run.largest_difference(), 1e-7);
    const double inertia = .25 * section_area * 1e-6;
    const double by_hand = twists ? 36e6 * 2 * inertia / .5e-3 : 9e6 * inertia / .5e-3;
    EXPECT_NEAR(run.break_load, by_hand, 3e-7 * by_hand); // the row before
    EXPECT_EQ(twists ? run.broken_shear : run.broken_tension, 1);
    EXPECT_EQ(run.rows.back().moment, 0);
  }
}

TEST(bonds_yielding, stiffness_ratios_are_a_list_as_of_the_parallel_bond) {
  const auto scene =
      read_scene(std::string(PLATEN_SCENES) + "/yielding_bond.prm",
                 {"Pair test/Turns =", "Pair test/Path = shear", "Pair test/Displacement = 1 um",
                  "Pair test/Stiffness ratio list = 0.2, 0.4"},
                 program("bonds"));
  const std::vector<BondRun> runs = run_bond_tests(scene);
  ASSERT_EQ(runs.size(), 2u);
  EXPECT_NEAR(runs[1].rows.back().force, 2 * runs[0].rows.back().force,
              1e-9 * std::abs(runs[1].rows.back().force));
}

} // namespace
} // namespace platen::apps::testing
