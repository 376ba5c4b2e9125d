// A cell whose oil presses on a rubber sleeve: the specimen feels what it feels under the same pressure on
// its skin, and the energy balance closes.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <sstream>
#include <string>

#include "coupling/platen_test.h"
#include "dem/measure/gauge.h"
#include "tests/coupling/set_ups.h"
#include "tests/same_state.h"

namespace platen::coupling {
namespace {

SleeveSettings butyl(bool bonded) {
  SleeveSettings s;
  s.thickness = 2e-3;
  s.poisson_ratio = 0.4995;
  s.mass_scaling = 1;
  s.bonded_rims = bonded;
  s.mass_damping = 1000;
  return s;
}

PlatenTestSettings in_cell(double pressure, bool sleeve, bool bonded = false) {
  PlatenTestSettings s = elastic_settings(0.3);
  s.platens.damping = 0;
  s.loading.cell.emplace();
  s.loading.cell->pressure = pressure;
  if (sleeve) s.loading.cell->sleeve = butyl(bonded);
  return s;
}

struct Answer {
  dem::GaugeStrain strain; // when the cell's own stage is over
  double axial = 0;        // Pa, of the platens at a closure of 4e-4 from there on
  double gauge_axial = 0, gauge_lateral = 0;
};

Answer run(PlatenTest &problem) {
  const dem::Gauge gauge(problem.model.particles, problem.shape(), problem.model.bonds.get());
  while (!problem.axial_stage())
    problem.advance(16);
  Answer a;
  a.strain = gauge.strain(problem.model.particles);
  while (problem.axial_closure() < 4e-4)
    problem.advance(16);
  const dem::GaugeStrain now = gauge.strain(problem.model.particles);
  a.axial = mean_stress(problem) - problem.confining_pressure();
  a.gauge_axial = now.axial - a.strain.axial;
  a.gauge_lateral = now.lateral() - a.strain.lateral();
  return a;
}

TEST(sleeve_cell, a_soft_sleeve_is_as_good_as_a_pressure_on_the_skin) {
  PlatenTest oil(packed_cylinder(), in_cell(10e6, true)), skin(packed_cylinder(), in_cell(10e6, false));
  const Answer a = run(oil), b = run(skin);
  EXPECT_EQ(oil.confining_pressure(), 10e6);
  EXPECT_EQ(oil.sleeve()->cuts(), 0);
  // The skin's spheres get the pressure at slightly other places and the rims of the sleeve hang on platens.
  EXPECT_NEAR(a.strain.axial / b.strain.axial, 1, 0.02);
  EXPECT_NEAR(a.strain.lateral() / b.strain.lateral(), 1, 0.03);
  EXPECT_NEAR(a.axial / a.gauge_axial / (b.axial / b.gauge_axial), 1, 0.01);
  EXPECT_NEAR(a.gauge_lateral / a.gauge_axial / (b.gauge_lateral / b.gauge_axial), 1, 0.05);
  // Rubber of so small a modulus carries next to nothing of the axial load.
  EXPECT_LT(std::abs(oil.sleeve_deviator()), 0.01 * a.axial);
}

TEST(sleeve_cell, the_energy_balance_of_sleeve_cell_and_specimen_closes) {
  for (const bool bonded : {true, false}) {
    PlatenTest problem(packed_cylinder(), in_cell(10e6, true, bonded));
    run(problem);
    const dem::EnergyLedger e = problem.energy();
    EXPECT_GT(problem.sleeve()->solid().pressure_work(), 0.2 * e.boundary);
    EXPECT_GT(e.bodies, 0);
    EXPECT_LT(std::abs(e.residual()), 2e-3 * e.boundary) << bonded;
  }
}

// Pressure and deviator go up a straight line; with -1/3 the mean stress stays.
TEST(sleeve_cell, a_stress_path_is_followed) {
  for (const bool sleeve : {false, true})
    for (const double path : {-1.0 / 3, 0.5}) {
      PlatenTestSettings settings = in_cell(10e6, sleeve);
      settings.loading.cell->path = path;
      PlatenTest problem(packed_cylinder(), settings);
      while (!problem.axial_stage())
        problem.advance(16);
      double worst = 0, last = 0;
      while (problem.axial_closure() < 6e-4) {
        problem.advance(16);
        last = mean_stress(problem) - problem.confining_pressure();
        worst = std::max(worst, std::abs(problem.confining_pressure() - 10e6 - path * last));
      }
      EXPECT_GT(last, 8e6) << path;
      EXPECT_LT(worst, 0.02 * 10e6) << path << (sleeve ? " sleeve" : " skin");
      const dem::EnergyLedger e = problem.energy();
      EXPECT_LT(std::abs(e.residual()), 2e-3 * e.boundary) << path;
    }
}

// In most steps of an interval nobody needs the loads on the sleeve: they are added up for who asks, and
// whoever asks first gets them.
TEST(sleeve_cell, loads_of_every_step_are_there_for_who_asks) {
  PlatenTestSettings settings = in_cell(10e6, true, true);
  settings.loading.cell->sleeve->contact.friction_static = 0.5; // so that its rims bear some of the load
  PlatenTest problem(packed_cylinder(), settings);
  while (!problem.axial_stage())
    problem.advance(16);
  const Sleeve &sleeve = *problem.sleeve();
  const auto picture = [&] {
    std::ostringstream text;
    sleeve.write_vtu(text);
    return text.str();
  };
  std::array<int, 3> within{}; // steps in which an interval went on, by who asked first
  for (std::size_t step = 0; step < 60; ++step) {
    problem.advance(1);
    const std::size_t first = step % 3;
    const double axial = first == 0 ? sleeve.axial_force_beyond_pressure() : 0;
    const std::string seen = first == 1 ? picture() : "";
    const State state = state_of(sleeve);
    const auto steps = [&](const char *name) { return rows_of<int>(state, name).front(); };
    within[first] += steps("state/planned_steps") != steps("state/steps_made") ? 1 : 0;
    Vector3 pushed{};   // N, of the sleeve on the particles
    double pressed = 0; // N
    for (const ActiveContact &c : sleeve.layer().contacts()) {
      pushed += c.normal_force * c.normal + c.shear;
      pressed += c.normal_force;
    }
    ASSERT_GT(pressed, 0);
    EXPECT_LT(norm(sleeve.solid().total_force() + pushed), 1e-12 * pressed) << "step " << step;
    const double axial_again = first == 0 ? sleeve.axial_force_beyond_pressure() : 0;
    EXPECT_EQ(axial, axial_again) << "step " << step;
    EXPECT_EQ(seen, first == 1 ? picture() : "") << "step " << step;
    EXPECT_TRUE(same_state(state, sleeve)) << "step " << step;
  }
  for (const int steps : within)
    EXPECT_GT(steps, 5);
}

} // namespace
} // namespace platen::coupling
