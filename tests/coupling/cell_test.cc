// A cell around the specimen: what a uniform pressure, a stiff wall, a sleeve and unloading do is what
// elasticity says.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <sstream>
#include <string>
#include <utility>

#include "coupling/static_press.h"
#include "dem/measure/gauge.h"
#include "tests/coupling/set_ups.h"
#include "tests/same_state.h"

namespace platen::coupling::cell_test {
namespace {

PlatenTestSettings lubricated() {
  PlatenTestSettings s = elastic_settings(0.3);
  s.platens.damping = 0;
  return s;
}
PlatenTestSettings in_cell(double pressure, bool sleeve, bool bonded = false) {
  PlatenTestSettings s = lubricated();
  press(s, pressure);
  if (!sleeve) return s;
  SleeveSettings &butyl = wrap(s, 2e-3, 0.4995);
  butyl.mass_scaling = 1, butyl.mass_damping = 1000, butyl.bonded_rims = bonded;
  return s;
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

struct Answer {
  dem::GaugeStrain strain;        // when the cell's own stage is over
  double all_sides = 0;           // Pa, of the platens by then
  double work = 0, skin_work = 0; // J, by then: of all that moves the specimen, and of a pressure on the skin
  double axial = 0;               // Pa, beyond the pressure, at a closure of 4e-4 from there on
  double gauge_axial = 0, gauge_lateral = 0;
};

Answer run(PlatenTest &problem) {
  const dem::Gauge gauge(problem.model.particles, problem.shape(), problem.model.bonds.get());
  while (!problem.axial_stage())
    problem.advance(16);
  Answer a;
  a.strain = gauge.strain(problem.model.particles);
  a.all_sides = mean_stress(problem), a.work = problem.energy().boundary;
  if (problem.skin() != nullptr) a.skin_work = problem.skin()->skin().work();
  while (problem.axial_closure() < 4e-4)
    problem.advance(16);
  const dem::GaugeStrain now = gauge.strain(problem.model.particles);
  a.axial = mean_stress(problem) - problem.confining_pressure();
  a.gauge_axial = now.axial - a.strain.axial;
  a.gauge_lateral = now.lateral() - a.strain.lateral();
  return a;
}

TEST(cell, a_pressure_on_all_sides_gives_the_bulk_modulus_and_stays_in_the_axial_stage) {
  PlatenTest problem(packed_cylinder(), in_cell(2e6, false));
  const Answer a = run(problem);
  EXPECT_EQ(problem.confining_pressure(), 2e6);
  EXPECT_NEAR(a.all_sides, 2e6, 0.011 * 2e6);
  const double bulk = 2e6 / -(a.strain.axial + a.strain.lateral_x + a.strain.lateral_y);
  // E and nu come from another test on the same packing, nu = 0.15 only through 1 - 2 nu. The skin is
  // pressed at the spheres' centres and is softer than the bulk; 8 % at eight spheres from axis to skin and
  // back.
  EXPECT_NEAR(bulk / (elastic().young / (3 * (1 - 2 * elastic().poisson))), 1, 0.08);
  // Alike in all directions, as far as so small a packing is.
  EXPECT_NEAR(a.strain.lateral_x / a.strain.axial, 1, 0.15);
  EXPECT_NEAR(a.strain.lateral_y / a.strain.axial, 1, 0.15);
  // The only forces from outside are platens and pressure, and both are in the energy balance.
  EXPECT_LT(std::abs(problem.energy().residual()), 1e-6 * problem.energy().boundary);
  EXPECT_GT(a.skin_work, 0.5 * a.work);
  // The pressure is constant, so the deviator is uniaxial: E, nu. 3 %: the stage begins within 1 % of the
  // pressure, which is 0.3 % here, and the platens are not infinitely slow.
  EXPECT_NEAR((a.axial + 2e6 - a.all_sides) / -a.gauge_axial / elastic().young, 1, 0.03);
  EXPECT_NEAR(-a.gauge_lateral / a.gauge_axial / elastic().poisson, 1, 0.1);
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

// Half as much with springs twice as stiff: it is no volume of the specimen.
TEST(sleeve_cell, its_volume_also_has_what_its_springs_give_way) {
  double beyond[2];
  for (const int stiff : {0, 1}) {
    PlatenTestSettings settings = in_cell(10e6, true);
    settings.loading.cell->sleeve->stiffness = stiff == 0 ? 0.02 : 0.04;
    PlatenTest problem(packed_cylinder(), settings);
    const dem::Gauge gauge(problem.model.particles, problem.shape(), problem.model.bonds.get());
    while (!problem.axial_stage())
      problem.advance(16);
    // Along the axis it goes with the platens.
    const double along = clamp_closure(problem) / problem.shape().height;
    const double lateral = gauge.strain(problem.model.particles).lateral();
    beyond[stiff] = problem.sleeve_volumetric_strain() - (along + 2 * lateral);
  }
  EXPECT_NEAR(beyond[0] / beyond[1], 2, 0.3);
  EXPECT_NEAR(beyond[0] / (0.08 * dem::mean_radius(packed_cylinder()) / packed_cylinder().shape.radius), 1,
              0.5);
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
TEST(sleeve_cell, a_stress_path_is_followed_and_the_energy_balance_closes) {
  for (const auto &[sleeve, bonded] : {std::pair{false, false}, {true, false}, {true, true}})
    for (const double path : {-1.0 / 3, 0.5}) {
      if (bonded && path < 0) continue;
      PlatenTestSettings settings = in_cell(10e6, sleeve, bonded);
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
      if (!sleeve) continue;
      EXPECT_GT(problem.sleeve()->solid().pressure_work(), 0.2 * e.boundary);
      EXPECT_GT(e.bodies, 0);
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
    std::vector<double> all;
    for (const fem::PictureField &field : sleeve.picture().of_points)
      all.insert(all.end(), field.values.begin(), field.values.end());
    return all;
  };
  std::array<int, 3> within{}; // steps in which an interval went on, by who asked first
  for (std::size_t step = 0; step < 60; ++step) {
    problem.advance(1);
    const std::size_t first = step % 3;
    const double axial = first == 0 ? sleeve.axial_force_beyond_pressure() : 0;
    const std::vector<double> seen = first == 1 ? picture() : std::vector<double>();
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
    EXPECT_EQ(seen, first == 1 ? picture() : std::vector<double>()) << "step " << step;
    EXPECT_TRUE(same_state(state, sleeve)) << "step " << step;
  }
  for (const int steps : within)
    EXPECT_GT(steps, 5);
}

} // namespace
} // namespace platen::coupling::cell_test
