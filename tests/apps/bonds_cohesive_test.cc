// platen-bonds on elasto-damage-plastic bonds and facets, on prescribed paths: strengths, displacements of
// failure and energies of theory 2.6 and 2.8. PLATEN_SCENES is the folder of the scenes.
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

// The scene's concrete: spheres of 1 mm, E 28 GPa, 5 and 16 MPa, nu .2.
constexpr double length = 2e-3, area = 3.14159265358979323846e-6, kn = 28e9 / length, ks = kn / 2.4;
// Positions of 2 mm are known to eps, of displacements of .4 um that is 1e-12 of the load; a failure a share
// of 1e-9 beside its row takes as much of the energy.
constexpr double close = 1e-8;

ComparedRun run_cohesive(const Words &overrides) {
  return compared_run("softening_bond.prm", overrides);
}

// The row at a place on the driven way, the first one.
std::size_t row_at(const ComparedRun &run, double displacement, std::size_t from = 0) {
  for (std::size_t k = from; k < run.rows.size(); ++k)
    if (std::abs(run.rows[k].displacement - displacement) <= 1e-6 * std::abs(displacement) + 1e-18) return k;
  ADD_FAILURE() << "no row at " << displacement << " m";
  return 0;
}
double force_at(const ComparedRun &run, double displacement, std::size_t from = 0) {
  return run.rows[row_at(run, displacement, from)].force;
}

void expect_by_hand(const ComparedRun &run) {
  EXPECT_LT(run.largest_difference(), close);
  const BondReading &m = run.last();
  EXPECT_NEAR(m.dissipated, run.by_hand.back().dissipated, close * m.work);
  EXPECT_NEAR(m.work, m.stored + m.dissipated, close * m.work);
}

TEST(bonds_cohesive, tension_softens_to_its_end_and_takes_the_energy_of_the_triangle) {
  for (const char *steps : {"Pair test/Steps = 7", "Pair test/Steps = 500"}) {
    const ComparedRun run = run_cohesive({steps});
    const double limit = 5e6 / kn;
    EXPECT_NEAR(run.break_load, 5e6 * area, close * 5e6 * area);
    EXPECT_NEAR(force_at(run, limit), 5e6 * area, 1e-5 * 5e6 * area);
    EXPECT_EQ(run.rows.back().force, 0);
    EXPECT_EQ(run.rows.back().intact, 0);
    EXPECT_EQ(run.broken_tension, 1);
    const double whole = .5 * 5e6 * 1.2 * limit * area;
    EXPECT_NEAR(run.last().dissipated, whole, close * whole);
    EXPECT_NEAR(run.last().work, whole, close * whole);
    EXPECT_NEAR(run.fracture_energy, .5 * 5e6 * .2 * limit, 2 * close * 5e6 * limit);
    EXPECT_EQ(run.last().stored, 0);
    expect_by_hand(run);
  }
}

TEST(bonds_cohesive, a_given_fracture_energy_is_what_it_takes) {
  for (const char *radius : {"Specimen/Sphere radius = 1 mm", "Specimen/Sphere radius = 0.25 mm"}) {
    const ComparedRun run =
        run_cohesive({radius, "Bond/Fracture energy tension = 4", "Pair test/Displacement = 3 um"});
    EXPECT_NEAR(run.fracture_energy, 4, close * 4) << radius;
    expect_by_hand(run);
  }
}

TEST(bonds_cohesive, damaged_tension_unloads_by_the_secant_and_comes_back) {
  const double limit = 5e6 / kn; // .357 um
  const ComparedRun run = run_cohesive({"Pair test/Displacement =",
                                        "Pair test/Turns = 0.392857142857143 um, "
                                        "0.1 um, 0.5 um"});
  const std::size_t turn = row_at(run, 1.1 * limit);
  EXPECT_NEAR(run.rows[turn].force, 2.5e6 * area, 1e-5 * 5e6 * area); // half of the softening
  EXPECT_NEAR(run.rows[turn].tension_damage, .5, 1e-6);
  const std::size_t low = row_at(run, .1e-6, turn);
  EXPECT_NEAR(run.rows[low].force / .1e-6, 2.5e6 * area / (1.1 * limit), 1e-5 * kn * area);
  EXPECT_NEAR(run.rows[low].dissipated, run.rows[turn].dissipated, close * run.rows[turn].dissipated);
  const std::size_t again = row_at(run, 1.1 * limit, low);
  EXPECT_NEAR(run.rows[again].force, run.rows[turn].force, 1e-5 * 5e6 * area);
  const double whole = .5 * 5e6 * 1.2 * limit * area;
  EXPECT_NEAR(run.last().dissipated, whole, close * whole);
  expect_by_hand(run);
}

// LCS 20, 45, 70 MPa at slopes of a third, a twelfth and a 22nd: strains 7.142857e-4, 3.392857e-3,
// 1.4107143e-2.
TEST(bonds_cohesive, compression_yields_along_its_branches_and_unloads_elastically) {
  const ComparedRun run = run_cohesive(
      {"Pair test/Path = compression", "Pair test/Displacement =", "Pair test/Turns = -40 um, 0"});
  const double strains[] = {7.142857142857143e-4, 3.392857142857143e-3, 1.4107142857142857e-2};
  const double stresses[] = {20e6, 45e6, 70e6};
  for (int k = 0; k < 3; ++k)
    EXPECT_NEAR(force_at(run, -strains[k] * length), -stresses[k] * area, 1e-5 * stresses[k] * area);
  const double end = 70e6 + 28e9 / 22 * (.02 - strains[2]);
  const std::size_t turn = row_at(run, -40e-6);
  EXPECT_NEAR(run.rows[turn].force, -end * area, close * end * area);
  const double stays = .02 * length - end / kn;
  EXPECT_NEAR(run.last().plastic_closing, stays, close * stays);
  EXPECT_NEAR(run.break_load, 5e6 * area, close * end * area); // torn on the way back
  // Going back to touching spheres opens it by what stays: torn long before.
  EXPECT_EQ(run.rows.back().intact, 0);
  EXPECT_EQ(run.rows.back().force, 0);
  // Yield takes the area under the branches less what it gives back; tearing the triangle of tension.
  const double corners[] = {0, strains[0], strains[1], strains[2], .02},
               heights[] = {0, stresses[0], stresses[1], stresses[2], end};
  double yield = -.5 * end * end / kn;
  for (int k = 0; k < 4; ++k)
    yield += .5 * (heights[k] + heights[k + 1]) * (corners[k + 1] - corners[k]) * length;
  const double torn = .5 * 5e6 * 1.2 * 5e6 / kn;
  EXPECT_NEAR(run.last().dissipated, area * (yield + torn), close * area * yield);
  expect_by_hand(run);
}

TEST(bonds_cohesive, shear_softens_from_cohesion_and_static_friction_to_dynamic_friction) {
  const double pressure = 10e6, strength = 16e6 + .9 * pressure, residual = .25 * pressure;
  const double limit = strength / ks, stretch = residual / ks;
  const ComparedRun run = run_cohesive(
      {"Pair test/Path = shear", "Pair test/Pressure = 10 MPa", "Pair test/Displacement = 12 um"});
  EXPECT_NEAR(run.break_load, strength * area, close * strength * area);
  EXPECT_NEAR(run.rows.back().force, residual * area, close * strength * area);
  EXPECT_NEAR(run.rows.back().normal, -pressure * area, close * pressure * area);
  EXPECT_EQ(run.broken_shear, 1);
  for (const BondReading &row : run.rows) // along three straight lines
    if (row.displacement > limit && row.displacement < 2 * limit) {
      const double share = row.displacement / limit - 1;
      EXPECT_NEAR(row.force, ((1 - share) * strength + share * residual) * area, 2 * close * strength * area);
    }
  // Cohesion takes its triangle; friction slides by half of the softening, then by all, but for its spring.
  const double by_hand =
      .5 * strength * 2 * limit + residual * (.5 * limit + 12e-6 - 2 * limit) - .5 * ks * stretch * stretch;
  EXPECT_NEAR(run.last().dissipated, area * by_hand, close * area * by_hand);
  expect_by_hand(run);
}

TEST(bonds_cohesive, sliding_back_sticks_by_the_spring_of_friction_first) {
  const double residual = 2.5e6;
  const ComparedRun run = run_cohesive({"Pair test/Path = shear", "Pair test/Pressure = 10 MPa",
                                        "Pair test/Displacement =", "Pair test/Turns = 10 um, -10 um, 0"});
  const std::size_t turn = row_at(run, 10e-6);
  EXPECT_NEAR(force_at(run, 10e-6 - 2 * residual / ks, turn), -residual * area, 1e-5 * residual * area);
  EXPECT_NEAR(force_at(run, -10e-6, turn), -residual * area, close * 25e6 * area);
  EXPECT_NEAR(run.rows.back().force, residual * area, close * 25e6 * area);
  expect_by_hand(run);
}

// Half damaged in shear, unloaded and loaded again.
TEST(bonds_cohesive, damaged_shear_unloads_by_its_secant_and_its_friction) {
  const ComparedRun run = run_cohesive({"Pair test/Path = shear", "Pair test/Pressure = 5 MPa",
                                        "Pair test/Displacement =", "Pair test/Turns = 5 um, 0, 12 um"});
  EXPECT_EQ(run.broken_shear, 1);
  expect_by_hand(run);
}

TEST(bonds_cohesive, pure_shear_takes_the_energy_of_its_triangle) {
  const ComparedRun run = run_cohesive(
      {"Pair test/Path = shear", "Pair test/Displacement = 6 um", "Bond/Fracture energy shear = 25"});
  EXPECT_NEAR(run.fracture_energy, 25, close * 25);
  EXPECT_NEAR(run.last().dissipated, area * (25 + .5 * 16e6 * 16e6 / ks), close * area * 50);
  EXPECT_EQ(run.rows.back().force, 0);
  expect_by_hand(run);
}

// Opening and slip that use up equal shares of both strengths: the coupled line fails at half of each, the
// uncoupled one at all.
TEST(bonds_cohesive, the_coupled_line_of_failure_adds_both_shares) {
  const double ratio = 16e6 / ks / (5e6 / kn); // 7.68
  for (const bool coupled : {false, true}) {
    const ComparedRun run =
        run_cohesive({"Pair test/Path = combined", "Pair test/Displacement = 0.6 um",
                      "Bond/Softening shear = 0.2", "Pair test/Slip ratio = " + std::to_string(ratio),
                      coupled ? "Bond/Failure line = coupled" : "Bond/Failure line = uncoupled"});
    const double share = coupled ? .5 : 1;
    EXPECT_NEAR(run.break_load, share * 5e6 * area, close * 5e6 * area);
    double shear = 0;
    for (const BondReading &row : run.rows)
      shear = std::max(shear, row.shear);
    EXPECT_NEAR(shear, share * 16e6 * area, close * 16e6 * area);
    const double whole = share * share * 1.2 * .5 * (5e6 * 5e6 / kn + 16e6 * 16e6 / ks) * area;
    EXPECT_NEAR(run.last().dissipated, whole, 2 * close * whole);
    EXPECT_EQ(run.last().stored, 0);
    expect_by_hand(run);
  }
}

// The direction that is used up first takes the other one with it.
TEST(bonds_cohesive, what_one_direction_uses_up_the_other_lets_go) {
  const ComparedRun run = run_cohesive({"Pair test/Path = combined", "Pair test/Displacement = 0.6 um",
                                        "Pair test/Slip ratio = 3", "Bond/Failure line = coupled"});
  EXPECT_EQ(run.rows.back().intact, 0);
  EXPECT_EQ(run.rows.back().shear, 0);
  EXPECT_LT(run.last().shear_damage, 1);
  expect_by_hand(run);
}

TEST(bonds_cohesive, a_cycle_through_tension_and_compression_is_the_one_by_hand) {
  const ComparedRun run =
      run_cohesive({"Pair test/Displacement =", "Pair test/Turns = 0.38 um, -5 um, -3 um, -3.3 um, -2 um",
                    "Pair test/Steps = 200"});
  expect_by_hand(run);
  EXPECT_GT(run.last().plastic_closing, 1e-6);
}

const Words turned{"Effects/Interface moments = on", "Bond/Moment contribution = 0.5"};
Words turning(Words more) {
  more.insert(more.begin(), turned.begin(), turned.end());
  return more;
}

// The skin's strength 5 MPa at beta R_b of the axis: M = sigma I/(beta R_b), and the turn that goes with it.
TEST(bonds_cohesive, bending_softens_from_the_strength_of_the_skin) {
  const ComparedRun run =
      run_cohesive(turning({"Pair test/Path = bending", "Pair test/Displacement = 1.2 um"}));
  expect_by_hand(run);
  const double inertia = .25 * area * 1e-6, strength = 5e6 * inertia / (.5 * 1e-3);
  EXPECT_NEAR(run.break_load, strength, close * strength);
  EXPECT_NEAR(run.rows.front().moment / run.rows.front().rotation, kn * inertia, 1e-6 * kn * inertia);
  const double limit = strength / (kn * inertia); // rad; nothing is left at 1.2 times as much
  EXPECT_NEAR(run.last().dissipated, .5 * strength * 1.2 * limit, 1e-6 * strength * limit);
  EXPECT_EQ(run.broken_tension, 1);
  EXPECT_EQ(run.last().normal, 0);
}

TEST(bonds_cohesive, twisting_softens_from_the_strength_of_the_skin_in_shear) {
  const ComparedRun run =
      run_cohesive(turning({"Pair test/Path = twisting", "Pair test/Displacement = 12 um"}));
  expect_by_hand(run);
  const double inertia = .5 * area * 1e-6, strength = 16e6 * inertia / (.5 * 1e-3);
  EXPECT_NEAR(run.break_load, strength, close * strength);
  EXPECT_EQ(run.broken_shear, 1);
}

// A skin that is only twisted is not pulled, so that no line couples it, whatever the last digits of a length
// are.
TEST(bonds_cohesive, what_has_been_bent_too_far_turns_back_by_the_secant_and_on_by_what_is_left) {
  for (const char *line : {"Bond/Failure line = uncoupled", "Bond/Failure line = coupled"})
    for (const char *path : {"bending", "twisting"})
      for (const char *set : {"best", "baseline"}) {
        SCOPED_TRACE(std::string(line) + ", " + path + ", " + set);
        const ComparedRun run = run_cohesive(
            turning({line, std::string("Pair test/Path = ") + path, "Bond/Softening tension = 0.4",
                     std::string("Integration/Instruction set = ") + set,
                     "Pair test/Displacement =", "Pair test/Turns = 0.8 um, -0.9 um, 0.85 um, 12 um"}));
        expect_by_hand(run);
        measured::expect_below(51, "load_off_of_softening_moments", run.largest_difference(), close);
        EXPECT_EQ(run.rows.back().moment, 0);
      }
}

TEST(bonds_cohesive, a_skin_that_does_not_count_never_breaks) {
  const ComparedRun run = run_cohesive({"Effects/Interface moments = on", "Bond/Moment contribution = 0",
                                        "Pair test/Path = bending", "Pair test/Displacement = 5 um"});
  expect_by_hand(run);
  EXPECT_EQ(run.broken_tension + run.broken_shear, 0);
  EXPECT_TRUE(std::isnan(run.break_load));
}

// The end of its softening, where a thousandth of the energy is left, is cut off (theory 2.8).
TEST(bonds_cohesive, a_facet_takes_its_fracture_energy) {
  const BondRun run = run_bond_tests(read_scene(std::string(PLATEN_SCENES) + "/softening_bond.prm",
                                                {"Effects/Bond = facet", "Bond/Fracture energy = 20 J/m2",
                                                 "Pair test/Displacement = 40 um"},
                                                program("bonds")))
                          .at(0);
  EXPECT_NEAR(run.break_load, 5e6 * area, 1e-2 * 5e6 * area);
  EXPECT_EQ(run.rows.back().intact, 0);
  EXPECT_NEAR(run.rows.back().dissipated, 20 * area, 1e-3 * 20 * area);
  EXPECT_NEAR(run.rows.back().work, run.rows.back().dissipated, 1e-5 * 20 * area);
}

TEST(bonds_cohesive, a_facet_is_sheared_up_to_its_cohesion) {
  const BondRun run = run_bond_tests(read_scene(std::string(PLATEN_SCENES) + "/softening_bond.prm",
                                                {"Effects/Bond = facet", "Bond/Fracture energy = 20 J/m2",
                                                 "Bond/Stiffness ratio = 0.4", "Pair test/Path = shear",
                                                 "Pair test/Displacement = 8 um"},
                                                program("bonds")))
                          .at(0);
  EXPECT_NEAR(run.rows.back().force, 16e6 * area, 1e-3 * 16e6 * area);
  const double slip = 8e-6 - 16e6 / (0.4 * kn);
  EXPECT_NEAR(run.rows.back().dissipated, 16e6 * slip * area, 2e-3 * run.rows.back().dissipated);
  EXPECT_TRUE(std::isnan(run.fracture_energy)); // it has not failed
}

TEST(bonds_cohesive, without_rotation_the_normal_law_is_the_same) {
  const ComparedRun with = run_cohesive({}), without = run_cohesive({"Effects/Rotation = off"});
  ASSERT_EQ(with.rows.size(), without.rows.size());
  for (std::size_t k = 0; k < with.rows.size(); ++k)
    EXPECT_EQ(with.rows[k].force, without.rows[k].force);
}

TEST(bonds_cohesive, what_cannot_be_led_is_refused) {
  const std::pair<Words, const char *> faults[] = {
      {{"Pair test/Path = bending"}, "Effects/Interface moments = on"},
      {{"Pair test/Path = twisting", "Effects/Interface moments = on", "Effects/Rotation = off"},
       "Effects/Rotation and"},
      {{"Pair test/Particles = 3"}, "Pair test/Particles"},
      {{"Pair test/Force = 1 kN"}, "through its softening"},
      {{"Pair test/Displacement ="}, "is not set"},
      {{"Pair test/Turns = 1 um"}, "contradicts Pair test/Displacement"},
      {{"Pair test/Displacement =", "Pair test/Turns = 1 um, 1 um"}, "stays where it is"},
      {{"Pair test/Path = shear", "Effects/Rotation = off"}, "Effects/Rotation"},
      {{"Bond/Area factor = 0"}, "two spheres are none"},
      {{"Pair test/Stiffness ratio list = 0.2, 0.4"}, "is for parallel bonds"}};
  for (const auto &[words, says] : faults)
    try {
      run_cohesive(words);
      ADD_FAILURE() << words.front() << " is taken";
    } catch (const InputError &error) {
      EXPECT_NE(std::string(error.what()).find(says), std::string::npos) << error.what();
    }
  EXPECT_THROW(read_scene(std::string(PLATEN_SCENES) + "/two_particles.prm", {"Pair test/Path = combined"},
                          program("bonds")),
               InputError);
}

} // namespace
} // namespace platen::apps::testing
