// Figures that a test tells of itself before it has begun, and that its steps are the same however they are
// asked.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "tests/coupling/set_ups.h"
#include "tests/same_state.h"

namespace platen::coupling::test_figures_test {
namespace {

PlatenTestSettings with_weight() {
  PlatenTestSettings s = crushing();
  s.model.gravity = {0, 0, -9.81};
  return s;
}

// The spheres weigh what the shape filled with the solid weighs, and a wave crosses in h sqrt(rho / E).
TEST(test_figures, a_density_of_the_solid_is_that_of_the_specimen) {
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

TEST(test_figures, the_coordination_number_is_the_mean_number_of_bonds_at_a_sphere) {
  const PlatenTest problem(cylinder(), crushing());
  const dem::Model &model = problem.model;
  std::vector<double> bonds_at(model.particles.size(), 0);
  for (std::size_t k = 0; k < model.bonds->size(); ++k)
    ++bonds_at[static_cast<std::size_t>(model.bonds->first[k])],
        ++bonds_at[static_cast<std::size_t>(model.bonds->second[k])];
  double mean = 0;
  for (const double bonds : bonds_at)
    mean += bonds / static_cast<double>(bonds_at.size());
  EXPECT_NEAR(problem.coordination_number(), mean, 1e-12 * mean);
  EXPECT_GT(mean, 4);
}

TEST(test_figures, platens_without_a_thickness_have_a_tenth_of_the_height) {
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

TEST(test_figures, a_density_of_the_solid_needs_a_volume) {
  dem::Specimen loose;
  loose.centre = {{0, 0, 0}}, loose.radius = {1e-3};
  EXPECT_EQ(dem::grain_density(loose, 2201, dem::DensityOf::grains), 2201);
  EXPECT_THROW(dem::grain_density(loose, 2201, dem::DensityOf::solid), std::invalid_argument);
}

// A slender beam on two supports: omega = (pi / L)^2 sqrt(E I / (rho A)).
TEST(test_figures, a_bar_on_supports_has_the_first_period_of_a_beam) {
  const PlatenTest problem(bar(), bent());
  const SpecimenFacts &f = problem.facts();
  const double span = bent().platens.span, depth = problem.shape().height, width = problem.shape().width_y,
               density = f.grain_density * f.packing_fraction, inertia = width * std::pow(depth, 3) / 12;
  const double omega =
      std::pow(pi / span, 2) * std::sqrt(f.voigt_modulus * inertia / (density * width * depth));
  EXPECT_NEAR(problem.bending_period() * omega / (2 * pi), 1, 1e-12);
}

// What a scene says of its mass the sleeve has, and keeps: only 0 leaves it to the program.
TEST(test_figures, a_sleeve_is_as_heavy_as_it_was_asked_to_be) {
  PlatenTestSettings settings = hydrostatic(true);
  for (const double scaling : {1.0, 7.0}) {
    settings.loading.cell->sleeve->mass_scaling = scaling;
    PlatenTest problem(cylinder(), settings);
    problem.advance(1); // by then the program has set up what is left to it
    EXPECT_EQ(problem.sleeve()->mass_scaling(), scaling);
    EXPECT_NEAR(problem.sleeve()->solid().material().density,
                scaling * settings.loading.cell->sleeve->density, 1e-9);
  }
}

// Between platens that are far stiffer than bonds the spheres at the ends decide the step. Where platens
// yield, the sphere's share alone is left of two equal springs in series, twice as stiff; a quarter on top
// lets body and spheres be taken by themselves.
TEST(test_figures, platens_that_yield_leave_the_step_that_their_springs_allow) {
  PlatenTestSettings settings = smooth();
  settings.platens.stiffness.value = 300;
  const double rigid = PlatenTest(cylinder(), settings).time_step(),
               yields = PlatenTest(cylinder(), elastic(settings, ElasticMotion::quasi_static, steel_modulus))
                            .time_step();
  EXPECT_GT(yields / rigid, 1 / std::sqrt(2 * 1.25)); // bonds count on both sides
  EXPECT_LT(yields / rigid, 1 / std::sqrt(2.));
}

// As many elements around as faces of five mean radii have room, and eight at least.
TEST(test_figures, a_sleeve_has_faces_of_some_spheres) {
  PlatenTestSettings settings = hydrostatic(true);
  for (const double larger : {1.0, 5.0}) {
    dem::Specimen specimen =
        dem::advancing_front(dem::cylinder(6e-3, 14e-3), dem::equal_radii(0.25e-3 * larger), 5);
    const PlatenTest problem(specimen, settings);
    std::size_t outer = 0; // faces around, of the outer rim
    const auto &points = problem.sleeve()->solid().mesh().nodes;
    double lowest = 1;
    for (const Vector3 &x : points)
      lowest = std::min(lowest, x.z);
    for (const Vector3 &x : points)
      outer += x.z < lowest + 1e-9 && std::hypot(x.x, x.y) > 6e-3 + 1e-3;
    EXPECT_EQ(outer, larger == 1 ? 30u : 8u);
  }
}

// Past the first closed contacts, where the time step is chosen anew.
TEST(platen_test, steps_in_one_go_are_the_same_as_one_by_one) {
  const dem::Specimen &specimen = cylinder();
  PlatenTest one_by_one(specimen, with_weight()), in_one_go(specimen, with_weight());
  constexpr long steps = 900;
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
} // namespace platen::coupling::test_figures_test
