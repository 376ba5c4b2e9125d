// Figures that a test tells of itself before it has begun.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/coupling/set_ups.h"

namespace platen::coupling {
namespace {

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

// All sides alike, whether a cell or platens press them: strains count from its end. One side alone is no
// consolidation.
TEST(test_figures, pressing_all_sides_alike_consolidates) {
  PlatenTestSettings settings = hydrostatic(false);
  EXPECT_TRUE(PlatenTest(cylinder(), settings).program().stage(0).is_consolidation());
  for (const double axial : {5e6, 6e6}) {
    settings.loading.stages.clear(), settings.loading.cell->alone = false;
    StageSettings &stage = settings.loading.stages.emplace_back();
    stage.asks = {asked_of(SideGroup::lateral, SideAsk::Ask::pressure, 5e6),
                  asked_of(SideGroup::axial, SideAsk::Ask::stress, axial)};
    stage.until = {{Until::Reached::settled}};
    EXPECT_EQ(PlatenTest(cylinder(), settings).program().stage(0).is_consolidation(), axial == 5e6);
  }
}

// Between platens that are far stiffer than bonds the spheres at the ends decide the step. Where platens
// yield, the sphere's share alone is left of two equal springs in series, twice as stiff; a quarter on top
// lets body and spheres be taken by themselves.
TEST(test_figures, platens_that_yield_leave_the_step_that_their_springs_allow) {
  PlatenTestSettings settings = smooth();
  settings.platens.stiffness.value = 300;
  const double rigid = PlatenTest(cylinder(), settings).time_step(),
               yields =
                   PlatenTest(cylinder(), elastic(settings, ElasticMotion::quasi_static, steel)).time_step();
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

} // namespace
} // namespace platen::coupling
