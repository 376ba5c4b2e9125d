// A cell around the specimen: what a uniform pressure, a stiff wall and unloading do is what elasticity says.
#include <gtest/gtest.h>

#include <cmath>

#include "coupling/platen_test.h"
#include "coupling/static_press.h"
#include "dem/measure/gauge.h"
#include "tests/coupling/set_ups.h"

namespace platen::coupling {
namespace {

PlatenTestSettings lubricated() {
  PlatenTestSettings s = elastic_settings(0.3);
  s.platens.damping = 0;
  return s;
}

CellSettings cell_of(double pressure) {
  CellSettings cell;
  cell.pressure = pressure;
  return cell;
}

struct Elastic {
  double young, poisson;
};
const Elastic &elastic() {
  static const Elastic e = [] {
    PlatenTest problem(packed_cylinder(), lubricated());
    const StaticPress p = press_statically(problem, 1e-5);
    return Elastic{p.youngs_modulus(), p.poisson_ratio()};
  }();
  return e;
}

TEST(cell, a_pressure_on_all_sides_gives_the_bulk_modulus_and_stays_in_the_axial_stage) {
  PlatenTestSettings settings = lubricated();
  settings.loading.cell = cell_of(2e6);
  PlatenTest problem(packed_cylinder(), settings);
  const dem::Gauge gauge(problem.model.particles, problem.shape(), problem.model.bonds.get());
  while (!problem.axial_stage())
    problem.advance(16);
  const dem::GaugeStrain s = gauge.strain(problem.model.particles);
  EXPECT_NEAR(problem.confining_pressure(), 2e6, 1);
  EXPECT_NEAR(mean_stress(problem), 2e6, 0.011 * 2e6);
  const double bulk = 2e6 / -(s.axial + s.lateral_x + s.lateral_y);
  // E and nu come from another test on the same packing, nu = 0.15 only through 1 - 2 nu. The skin is
  // pressed at the spheres' centres and is softer than the bulk; 8 % at eight spheres from axis to skin and
  // back.
  EXPECT_NEAR(bulk / (elastic().young / (3 * (1 - 2 * elastic().poisson))), 1, 0.08);
  // Alike in all directions, as far as so small a packing is.
  EXPECT_NEAR(s.lateral_x / s.axial, 1, 0.15);
  EXPECT_NEAR(s.lateral_y / s.axial, 1, 0.15);
  // The only forces from outside are platens and pressure, and both are in the energy balance.
  EXPECT_LT(std::abs(problem.energy().residual()), 1e-6 * problem.energy().boundary);
  EXPECT_GT(problem.skin()->skin().work(), 0.5 * problem.energy().boundary);
  while (problem.closure_strain() < 4e-4)
    problem.advance(16);
  const dem::GaugeStrain now = gauge.strain(problem.model.particles);
  EXPECT_EQ(problem.confining_pressure(), 2e6);
  // The pressure is constant, so the deviator is uniaxial: E, nu. 3 %: the stage begins within 1 % of the
  // pressure, which is 0.3 % here, and the platens are not infinitely slow.
  EXPECT_NEAR((mean_stress(problem) - 2e6) / -(now.axial - s.axial) / elastic().young, 1, 0.03);
  EXPECT_NEAR((now.lateral() - s.lateral()) / -(now.axial - s.axial) / elastic().poisson, 1, 0.1);
}

TEST(cell, a_stiff_wall_takes_nu_over_one_minus_nu_of_the_axial_stress) {
  PlatenTestSettings settings = lubricated();
  settings.loading.wall = true;
  settings.loading.wall_layer = 1;
  PlatenTest problem(packed_cylinder(), settings);
  const dem::Gauge gauge(problem.model.particles, problem.shape(), problem.model.bonds.get());
  while (problem.closure_strain() < 2e-4)
    problem.advance(16);
  const dem::GaugeStrain s = gauge.strain(problem.model.particles);
  const double axial = mean_stress(problem);
  EXPECT_LT(std::abs(s.lateral()), 0.03 * -s.axial); // held
  EXPECT_GT(problem.wall()->seats(), 100u);
  const double nu = elastic().poisson;
  // 8 %: the centres lie a radius inside the wall that the pressure is told for; nu itself is a small number.
  EXPECT_NEAR(problem.confining_pressure() / axial / (nu / (1 - nu)), 1, 0.08);
  const double constrained = elastic().young * (1 - nu) / ((1 + nu) * (1 - 2 * nu));
  EXPECT_NEAR(axial / -s.axial / constrained, 1, 0.05);
  // A wall at rest does no work; its springs are in the energy balance.
  EXPECT_LT(std::abs(problem.energy().residual()), 1e-5 * problem.energy().boundary);
}

TEST(cell, what_is_elastic_unloads_along_the_path_it_was_loaded) {
  PlatenTestSettings settings = lubricated();
  settings.loading.unload_at = {1e-4};
  settings.loading.unload_to = 0.2;
  PlatenTest problem(packed_cylinder(), settings);
  const auto stress = [&] { return mean_stress(problem); };
  const auto run_until = [&](const auto &met) {
    for (int k = 0; k < 100000 && !met(); ++k)
      problem.step();
    ASSERT_TRUE(met());
  };
  run_until([&] { return problem.closure_strain() > 5e-5; });
  const double loading = stress() / problem.closure_strain();
  run_until([&] { return problem.cycling(); });
  const double turn = stress();
  double fastest = 0, before = problem.platen_speed();
  run_until([&] {
    fastest = std::max(fastest, std::abs(problem.platen_speed() - before));
    before = problem.platen_speed();
    return problem.closure_strain() < 5e-5;
  });
  EXPECT_LT(problem.platen_speed(), 0);
  EXPECT_LT(fastest, 0.01 * settings.loading.rate); // smoothly, within the ramp
  EXPECT_NEAR(stress() / problem.closure_strain() / loading, 1, 0.02);
  double least = turn;
  run_until([&] {
    least = std::min(least, stress());
    return problem.platen_speed() > 0.99 * settings.loading.rate;
  });
  // The way on until the speed is zero: half the ramp at half the speed.
  const double way = 0.25 * settings.loading.rate * problem.ramp() / problem.shape().height;
  EXPECT_NEAR(least, 0.2 * turn - loading * way, 0.02 * turn);
  run_until([&] { return !problem.cycling(); });
  EXPECT_NEAR(stress() / problem.closure_strain() / loading, 1, 0.02);
}

} // namespace
} // namespace platen::coupling
