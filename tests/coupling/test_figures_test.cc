// Figures that a test tells of itself before it has begun.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/coupling/elastic_loadings.h"

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

} // namespace
} // namespace platen::coupling
