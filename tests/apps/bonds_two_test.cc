// platen-bonds on two spheres: the thesis' tables and the closed forms of one bond. PLATEN_SCENES is the
// folder of the scenes.
#include <gtest/gtest.h>

#include <cmath>

#include "apps/bonds/run_bonds.h"
#include "apps/programs.h"
#include "apps/scene/errors.h"

namespace platen::apps {
namespace {

using Words = std::vector<std::string>;

Scene pair_scene(const Words &overrides) {
  return read_scene(std::string(PLATEN_SCENES) + "/two_particles.prm", overrides, program("bonds"));
}

// The row nearest to a load, which the scene's load steps meet exactly.
BondReading at_force(const BondRun &run, double force) {
  for (const BondReading &row : run.rows)
    if (std::abs(row.force - force) < 1e-9 * std::abs(force)) return row;
  ADD_FAILURE() << "no row at " << force << " N";
  return {};
}

// Tannu 2017, table 5: displacements in mm at 1.5, 2, 2.5, 3 kN; three digits are printed.
TEST(bonds_two, displacements_are_those_of_the_thesis) {
  const struct {
    double modulus, displacement[4];
  } table[] = {{100e9, {.00955, .0127, .0159, .0191}},
               {125e9, {.00764, .0102, .0127, .0153}},
               {150e9, {.00637, .00849, .0106, .0127}},
               {175e9, {.00546, .00728, .00909, .0109}},
               {200e9, {.00477, .00637, .00796, .00955}}};
  const double forces[4] = {1500, 2000, 2500, 3000};
  const std::vector<BondRun> runs = run_bond_tests(pair_scene({}));
  ASSERT_EQ(runs.size(), 5u);
  for (std::size_t r = 0; r < 5; ++r) {
    EXPECT_EQ(runs[r].modulus, table[r].modulus);
    for (int k = 0; k < 4; ++k) {
      const double measured = 1e3 * at_force(runs[r], forces[k]).displacement,
                   printed = table[r].displacement[k];
      const double last_digit = printed < .01 ? 1e-5 : 1e-4;
      EXPECT_LE(std::abs(measured - printed), .51 * last_digit)
          << runs[r].modulus << " Pa, " << forces[k] << " N";
    }
  }
}

// Tables 8 and 9: strength times area; the published forces lie up to 15 % higher, where load steps end.
TEST(bonds_two, strength_in_tension_is_strength_times_area) {
  for (const double strength : {.25e9, .5e9, .75e9, 1e9, 1.25e9}) {
    const std::vector<BondRun> runs =
        run_bond_tests(pair_scene({"Bond/Tensile strength = " + std::to_string(strength),
                                   "Pair test/Force = 5 kN", "Pair test/Modulus list = 150 GPa"}));
    const double expected = strength * 3.14159265358979e-6;
    EXPECT_NEAR(runs[0].break_load, expected, 1e-3 * expected);
    EXPECT_EQ(runs[0].broken_tension, 1);
    EXPECT_EQ(runs[0].broken_shear, 0);
  }
}

struct PathCase {
  const char *word;
  double stiffness, strength; // N/m and N, or N m and N m
};
void PrintTo(const PathCase &path, std::ostream *out) {
  *out << path.word;
}
class Path : public ::testing::TestWithParam<PathCase> {};
class BeamPath : public Path {};
std::string word_of_case(const ::testing::TestParamInfo<PathCase> &path) {
  return path.param.word;
}

// While the bond is intact; `close` covers the finite rotation.
void expect_line(const BondRun &run, double stiffness, double close) {
  int rows = 0;
  for (const BondReading &row : run.rows)
    if (row.intact == 1) {
      EXPECT_NEAR(row.travel(), row.load() / stiffness, close * std::abs(row.travel()));
      ++rows;
    }
  EXPECT_GT(rows, 0);
}

// Loaded and moved, every path breaks where the section says so, within the step of 2e-4 before the break.
TEST_P(Path, breaks_at_the_strength_of_the_section) {
  const PathCase c = GetParam();
  for (const Words &drive :
       {Words{"Pair test/Force = 5 kN"}, Words{"Pair test/Force =", "Pair test/Displacement = 0.03 mm"}}) {
    Words words{"Bond/Tensile strength = 0.5 GPa", "Bond/Shear strength = 0.25 GPa",
                "Pair test/Modulus list = 150 GPa", std::string("Pair test/Path = ") + c.word};
    words.insert(words.end(), drive.begin(), drive.end());
    const BondRun run = run_bond_tests(pair_scene(words)).at(0);
    EXPECT_NEAR(run.break_load, c.strength, 1e-3 * c.strength);
    const std::string word = c.word;
    EXPECT_EQ(run.broken_tension, word == "tension" || word == "bending" ? 1 : 0);
    EXPECT_EQ(run.broken_shear, word == "shear" || word == "twisting" ? 1 : 0);
    EXPECT_GT(run.fracture_work, 0);
    expect_line(run, c.stiffness, 1e-4);
  }
}

// K = 150 GPa A / 2 mm and half of it in shear; sigma_c A, tau_c A, sigma_c I/R, tau_c J/R with R = 1 mm.
constexpr double section = 3.14159265358979e-6, axial = 150e9 * section / 2e-3;
INSTANTIATE_TEST_SUITE_P(bonds_two, Path,
                         ::testing::Values(PathCase{"tension", axial, .5e9 * section},
                                           PathCase{"shear", axial / 2, .25e9 * section},
                                           PathCase{"bending", axial * 1e-6 / 4, .5e9 * section * 1e-3 / 4},
                                           PathCase{"twisting", axial * 1e-6 / 4,
                                                    .25e9 * section * 1e-3 / 2}),
                         word_of_case);

// A beam of the radius .71 mm between centres 2 mm apart, E = 150 GPa, nu = .25, sigma_c .5 GPa, tau_c .25
// GPa.
TEST_P(BeamPath, is_that_of_strength_of_materials) {
  const PathCase c = GetParam();
  const BondRun run =
      run_bond_tests(pair_scene({"Effects/Bond = cohesive beam", "Bond/Radius multiplier = 0.71",
                                 "Bond/Poisson ratio = 0.25", "Bond/Tensile strength = 0.5 GPa",
                                 "Bond/Shear strength = 0.25 GPa", "Pair test/Modulus list = 150 GPa",
                                 std::string("Pair test/Path = ") + c.word, "Pair test/Force = 2 kN"}))
          .at(0);
  EXPECT_NEAR(run.break_load, c.strength, 1.5e-3 * c.strength); // where the step before the break ends
  expect_line(run, c.stiffness, 2e-4);
}

constexpr double beam_section = 3.14159265358979 * .71e-3 * .71e-3,
                 beam_inertia = beam_section * .71e-3 * .71e-3 / 4;
INSTANTIATE_TEST_SUITE_P(
    bonds_two, BeamPath,
    ::testing::Values(
        PathCase{"tension", 150e9 * beam_section / 2e-3, .5e9 * beam_section},
        PathCase{"shear", 12 * 150e9 * beam_inertia / 8e-9, 2 * .5e9 * beam_inertia / (.71e-3 * 2e-3)},
        PathCase{"bending", 150e9 * beam_inertia / 2e-3, .5e9 * beam_inertia / .71e-3},
        PathCase{"twisting", 60e9 * 2 * beam_inertia / 2e-3, .25e9 * 2 * beam_inertia / .71e-3}),
    word_of_case);

TEST(bonds_two, compression_breaks_nothing) {
  const BondRun run =
      run_bond_tests(pair_scene({"Bond/Tensile strength = 1 MPa", "Bond/Shear strength = 1 MPa",
                                 "Pair test/Path = compression", "Pair test/Modulus list = 150 GPa"}))
          .at(0);
  EXPECT_TRUE(std::isnan(run.break_load));
  const BondReading last = run.rows.back(); // 1000 times the strength
  EXPECT_EQ(last.intact, 1);
  EXPECT_NEAR(last.displacement, -3000 / axial, 1e-7 * 3000 / axial);
}

// Up, back, through compression, up again: the same line while the bond is whole.
TEST(bonds_two, an_intact_bond_comes_back_on_its_line) {
  const BondRun run = run_bond_tests(pair_scene({"Pair test/Path = cyclic",
                                                 "Pair test/Modulus list = 150 GPa", "Pair test/Steps = 30"}))
                          .at(0);
  ASSERT_EQ(run.rows.size(), 30u);
  bool pressed = false;
  for (const BondReading &row : run.rows) {
    EXPECT_NEAR(row.displacement, row.force / axial, 1e-7 * 3000 / axial);
    pressed = pressed || row.force < -1000;
  }
  EXPECT_TRUE(pressed);
}

// After the break: nothing in tension, the contact in compression, cycle after cycle.
TEST(bonds_two, a_broken_bond_pushes_and_never_pulls) {
  const BondRun run =
      run_bond_tests(pair_scene({"Pair test/Path = cyclic", "Pair test/Modulus list = 150 GPa",
                                 "Pair test/Steps = 60", "Bond/Tensile strength = 0.25 GPa",
                                 "Pair test/Force =", "Pair test/Displacement = 0.02 mm"}))
          .at(0);
  bool broken = false, pressed = false;
  for (const BondReading &row : run.rows) {
    broken = broken || row.intact == 0;
    if (!broken) continue;
    const double expected = std::min(0.0, row.displacement) * axial; // contact as stiff as the bond
    EXPECT_NEAR(row.force, expected, 1e-9 * 2e-5 * axial);
    pressed = pressed || row.force < -100;
  }
  EXPECT_TRUE(broken && pressed);
}

// Damping brings the spheres to rest; where, it must not decide.
TEST(bonds_two, the_result_does_not_depend_on_damping_mass_or_step) {
  const Words one{"Pair test/Modulus list = 150 GPa", "Pair test/Path = shear"};
  const double expected = run_bond_tests(pair_scene(one)).at(0).rows.back().displacement;
  for (const char *word : {"Integration/Damping = 0.2", "Integration/Safety = 0.3", "Bond/Damping = 0.3",
                           "Integration/Mass scaling = 100", "Material/Density = 7800 kg/m3"}) {
    Words other = one;
    other.emplace_back(word);
    EXPECT_NEAR(run_bond_tests(pair_scene(other)).at(0).rows.back().displacement, expected, 1e-6 * expected)
        << word;
  }
}

TEST(bonds_two, what_cannot_be_tested_is_refused) {
  for (const Words &words :
       {Words{"Effects/Gravity = on"}, Words{"Integration/Damping = 0"},
        Words{"Pair test/Displacement = 1 mm"}, Words{"Pair test/Path = bending", "Effects/Rotation = off"},
        Words{"Integration/Time step = 1 s"}})
    EXPECT_THROW(run_bond_tests(pair_scene(words)), InputError) << words[0];
}

} // namespace
} // namespace platen::apps
