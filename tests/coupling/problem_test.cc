// A whole problem: steps one by one and in one go are the same, to the last bit.
#include "coupling/problem.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>

#include "tests/coupling/small_cylinder.h"

namespace platen::coupling {
namespace {

// Brittle and fast, so that bonds break and platens slide within some hundred steps.
ProblemSettings crushing() {
  ProblemSettings s;
  s.model.bond_layout.modulus = 36e9;
  s.model.bond_layout.gap.value = 0.05;
  s.model.bond = dem::ParallelBond::Parameters{0.4, 2e6, 6e6, 0.7853981633974483, 0.3};
  s.model.contact = dem::ContactSettings{};
  s.model.contact->damping = 0;
  s.model.local_damping = 0.3;
  s.model.gravity = {0, 0, -9.81};
  s.ends = Ends::ground;
  s.end_layer = 0.5;
  s.platens.top = s.platens.bottom = {0.3, 0.2};
  s.platens.thickness = 2e-3;
  s.loading.rate = 1;
  s.loading.ramp = 1e-6;
  return s;
}

void expect_same_bits(const dem::Table &a, const dem::Table &b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t c = 0; c < a.columns().size(); ++c) {
    const dem::ColumnBase &one = *a.columns()[c], &other = *b.columns()[c];
    EXPECT_EQ(std::memcmp(one.bytes(), other.bytes(), one.size() * one.bytes_per_row()), 0) << one.name();
  }
}

// The spheres weigh what the shape filled with the solid weighs, and a wave crosses in h sqrt(rho / E).
TEST(problem, a_density_of_the_solid_is_that_of_the_specimen) {
  const dem::Specimen specimen = small_cylinder();
  ProblemSettings settings = crushing();
  settings.model.density = 2201;
  settings.model.density_of = dem::DensityOf::solid;
  settings.model.mass_scaling = 4;
  const Problem problem(specimen, settings);
  const double volume = specimen.shape.volume();
  double mass = 0;
  for (const double m : problem.model.particles.mass)
    mass += m;
  EXPECT_NEAR(mass / 4, 2201 * volume, 1e-12 * 2201 * volume);
  EXPECT_NEAR(problem.grain_density() * problem.packing_fraction(), 2201, 1e-12 * 2201);
  const double crossing = specimen.shape.height * std::sqrt(4 * 2201 / problem.voigt_modulus());
  EXPECT_NEAR(problem.wave_crossing(), crossing, 1e-12 * crossing);
}

TEST(problem, a_density_of_the_solid_needs_a_volume) {
  dem::Specimen loose;
  loose.centre = {{0, 0, 0}}, loose.radius = {1e-3};
  EXPECT_EQ(dem::grain_density(loose, 2201, dem::DensityOf::grains), 2201);
  EXPECT_THROW(dem::grain_density(loose, 2201, dem::DensityOf::solid), std::invalid_argument);
}

TEST(problem, steps_in_one_go_are_the_same_as_one_by_one) {
  const dem::Specimen specimen = small_cylinder();
  Problem one_by_one(specimen, crushing()), in_one_go(specimen, crushing());
  constexpr long steps = 900; // past the first closed contacts, where the time step is chosen anew
  for (long s = 0; s < steps; ++s)
    one_by_one.step();
  long stops = 0;
  while (in_one_go.steps() < steps) {
    in_one_go.advance(std::min(29L, steps - in_one_go.steps()));
    in_one_go.model.take_cracks();
    ++stops;
  }
  EXPECT_GT(one_by_one.model.broken_tension, 20);
  EXPECT_GT(stops, steps / 29 + 5); // breaks end a run of steps early
  EXPECT_LT(stops, steps);
  EXPECT_EQ(one_by_one.numbers(), in_one_go.numbers());
  expect_same_bits(one_by_one.model.particles.table, in_one_go.model.particles.table);
  expect_same_bits(one_by_one.model.bonds->table, in_one_go.model.bonds->table);
  expect_same_bits(one_by_one.model.contacts->table, in_one_go.model.contacts->table);
  expect_same_bits(one_by_one.top_layer.history(), in_one_go.top_layer.history());
}

void copy(const dem::Table &from, dem::Table &to) {
  to.resize(from.size());
  for (std::size_t c = 0; c < from.columns().size(); ++c) {
    const dem::ColumnBase &column = *from.columns()[c];
    std::memcpy(to.columns()[c]->bytes(), column.bytes(), column.size() * column.bytes_per_row());
  }
}

// What a checkpoint keeps.
void restore(const Problem &from, Problem &to) {
  copy(from.model.particles.table, to.model.particles.table);
  copy(from.model.bonds->table, to.model.bonds->table);
  copy(from.model.bonds->records, to.model.bonds->records);
  copy(from.model.contacts->table, to.model.contacts->table);
  to.model.contacts->search_state().set_state(from.model.contacts->search_state().state());
  to.top.set_state(from.top.state());
  to.bottom.set_state(from.bottom.state());
  copy(from.top_layer.history(), to.top_layer.history());
  copy(from.bottom_layer.history(), to.bottom_layer.history());
  to.set_numbers(from.numbers());
  to.restored();
}

// The time step is chosen anew every 400 steps where contacts have closed; a run that is resumed just there
// has not touched anything yet.
TEST(problem, a_run_resumed_where_the_step_is_chosen_goes_on_the_same) {
  const dem::Specimen specimen = small_cylinder();
  ProblemSettings slow = crushing();
  slow.loading.rate = 0.3; // few contacts close between two choices
  Problem run(specimen, slow);
  constexpr std::size_t springs_at_choice = 4; // place in numbers()
  int choices = 0;
  for (int part = 0; part < 8; ++part) {
    run.advance(400 - run.steps() % 400);
    while (run.steps() % 400 != 0)
      run.advance(400 - run.steps() % 400);
    Problem resumed(specimen, slow);
    restore(run, resumed);
    EXPECT_EQ(run.springs_near(), resumed.springs_near());
    EXPECT_GT(resumed.springs_near(), 0u);
    const double before = run.numbers()[springs_at_choice];
    run.step();
    resumed.step();
    choices += run.numbers()[springs_at_choice] != before;
    EXPECT_EQ(run.numbers(), resumed.numbers()) << run.steps();
  }
  EXPECT_GT(choices, 0);
}

} // namespace
} // namespace platen::coupling
