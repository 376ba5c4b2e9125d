// A whole test: steps one by one and in one go are the same, to the last bit.
#include "coupling/platen_test.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "tests/coupling/set_ups.h"
#include "tests/same_state.h"

namespace platen::coupling {
namespace {

PlatenTestSettings with_weight() {
  PlatenTestSettings s = crushing();
  s.model.gravity = {0, 0, -9.81};
  return s;
}

// The spheres weigh what the shape filled with the solid weighs, and a wave crosses in h sqrt(rho / E).
TEST(platen_test, a_density_of_the_solid_is_that_of_the_specimen) {
  const dem::Specimen &specimen = cylinder();
  PlatenTestSettings settings = with_weight();
  settings.model.density = 2201;
  settings.model.density_of = dem::DensityOf::solid;
  settings.model.mass_scaling = 4;
  const PlatenTest problem(specimen, settings);
  const double volume = specimen.shape.volume();
  double mass = 0;
  for (const double m : problem.model.particles.mass)
    mass += m;
  EXPECT_NEAR(mass / 4, 2201 * volume, 1e-12 * 2201 * volume);
  EXPECT_NEAR(problem.facts().grain_density * problem.facts().packing_fraction, 2201, 1e-12 * 2201);
  const double crossing = specimen.shape.height * std::sqrt(4 * 2201 / problem.facts().voigt_modulus);
  EXPECT_NEAR(problem.facts().wave_transit, crossing, 1e-12 * crossing);
}

TEST(platen_test, platens_without_a_thickness_have_a_tenth_of_the_height) {
  const dem::Specimen &specimen = cylinder();
  PlatenTestSettings settings = with_weight();
  settings.platens.thickness = 0;
  const PlatenTest problem(specimen, settings);
  EXPECT_DOUBLE_EQ(problem.settings().platens.thickness, 0.1 * specimen.shape.height);
  settings.platens.thickness = 0.1 * specimen.shape.height;
  const PlatenTest given(specimen, settings);
  EXPECT_DOUBLE_EQ(problem.top().body().mass(), given.top().body().mass());
  EXPECT_GT(given.top().body().mass(), 0);
}

TEST(platen_test, a_density_of_the_solid_needs_a_volume) {
  dem::Specimen loose;
  loose.centre = {{0, 0, 0}}, loose.radius = {1e-3};
  EXPECT_EQ(dem::grain_density(loose, 2201, dem::DensityOf::grains), 2201);
  EXPECT_THROW(dem::grain_density(loose, 2201, dem::DensityOf::solid), std::invalid_argument);
}

TEST(platen_test, steps_in_one_go_are_the_same_as_one_by_one) {
  const dem::Specimen &specimen = cylinder();
  PlatenTest one_by_one(specimen, with_weight()), in_one_go(specimen, with_weight());
  constexpr long steps = 900; // past the first closed contacts, where the time step is chosen anew
  std::vector<double> strains;
  for (long s = 0; s < steps; ++s) {
    one_by_one.step();
    for ([[maybe_unused]] const dem::Crack &crack : one_by_one.model.take_cracks())
      strains.push_back(one_by_one.closure_strain());
  }
  while (in_one_go.steps() < steps)
    in_one_go.advance(std::min(29L, steps - in_one_go.steps()));
  EXPECT_GT(one_by_one.model.broken_tension, 20);
  EXPECT_TRUE(same_state(one_by_one, in_one_go));
  // Each crack has the strain of its own step, whatever came after it.
  const std::vector<dem::Crack> cracks = in_one_go.model.take_cracks();
  ASSERT_EQ(cracks.size(), strains.size());
  for (std::size_t k = 0; k < cracks.size(); ++k)
    EXPECT_EQ(cracks[k].strain, strains[k]) << "crack " << k;
  EXPECT_GT(strains.back(), strains.front());
}

// Grain contacts that are near, platen contacts that are closed.
std::size_t contacts_closed(const PlatenTest &test) {
  std::size_t sum = test.model.contacts->table.size();
  for (const auto &boundary : test.boundaries())
    sum += boundary->closed();
  return sum;
}

// The time step is chosen anew every 400 steps where contacts have closed; a run that is resumed just there
// has not touched anything yet.
TEST(platen_test, a_run_resumed_where_the_step_is_chosen_goes_on_the_same) {
  const dem::Specimen &specimen = cylinder();
  PlatenTestSettings slow = with_weight();
  slow.loading.rate = 0.3; // few contacts close between two choices
  PlatenTest run(specimen, slow);
  const auto near_at_choice = [](const PlatenTest &problem) {
    return rows_of<std::size_t>(state_of(problem), "state/near_at_choice").front();
  };
  int choices = 0;
  for (int part = 0; part < 8; ++part) {
    run.advance(400 - run.steps() % 400);
    while (run.steps() % 400 != 0)
      run.advance(400 - run.steps() % 400);
    PlatenTest resumed(specimen, slow);
    set_state(resumed, state_of(run));
    EXPECT_EQ(contacts_closed(run), contacts_closed(resumed));
    EXPECT_GT(contacts_closed(resumed), 0u);
    const std::size_t before = near_at_choice(run);
    run.step();
    resumed.step();
    choices += near_at_choice(run) != before;
    EXPECT_TRUE(same_state(run, resumed)) << run.steps();
  }
  EXPECT_GT(choices, 0);
}

} // namespace
} // namespace platen::coupling
