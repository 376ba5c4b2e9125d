// A restart in every loading stage and with every boundary, the platens' kinds and laws of bonds apart
// (restart_test.cc): a pressed skin, a sleeve, a wall, strips, glued ends, a servo, a rate multiplier.
#include <array>
#include <cmath>
#include <set>

#include "dem/packing/growth.h"
#include "tests/coupling/elastic_problem.h"
#include "tests/stability/restart.h"

namespace platen::apps {
namespace {

using coupling::PlatenTest;
using coupling::PlatenTestSettings;

// Loaded to 0.4 % at 1 m/s; breaks on the way.
PlatenTestSettings crushed() {
  PlatenTestSettings s = coupling::elastic_settings(0.5);
  s.model.bond = dem::ParallelBond::Parameters{0.4, 10e6, 30e6, 0.7853981633974483, 0.3};
  s.model.contact = dem::ContactSettings{};
  s.model.local_damping = 0.3;
  s.platens.top = s.platens.bottom = {0.3, 0.2};
  s.platens.damping = 0.1;
  s.platens.elements_across = 4;
  s.loading.rate = 1;
  s.loading.ramp = 5e-6;
  s.loading.target_strain = 4e-3;
  return s;
}

// Pressed by 1 MPa on the skin.
PlatenTestSettings in_cell() {
  PlatenTestSettings s = crushed();
  s.loading.cell.emplace();
  s.loading.cell->pressure = 1e6;
  s.loading.cell->ramp = 2e-5;
  return s;
}

class RestartOfStages : public RestartFolder {
protected:
  // Stops at five steps of the whole test, of each number of threads in turn. Expects that the stops lie in
  // these stages; a turn of the platens is "cycling".
  void compare(const dem::Specimen &specimen, const PlatenTestSettings &settings,
               const std::set<std::string> &stages) {
    constexpr std::array threads{1, 2, 4};
    constexpr std::size_t stops = 5;
    const long steps = whole(specimen, settings);
    std::set<std::string> met;
    Stop stop;
    stop.expect = [&met](const PlatenTest &p) {
      met.insert(p.cycling() ? "cycling" : p.program().stage().name());
    };
    int off = 0;
    for (std::size_t k = 0; k < stops; ++k) {
      stop.at = static_cast<long>(2 * k + 1) * steps / static_cast<long>(2 * stops) + 1;
      off += different(specimen, settings, stop, threads[k % 3], {threads[(k + 1) % 3]});
    }
    EXPECT_EQ(met, stages);
    note_states(static_cast<int>(stops), off);
  }
  void compare(const PlatenTestSettings &settings, const std::set<std::string> &stages) {
    compare(coarse_cylinder(), settings, stages);
  }

private:
  static long whole(const dem::Specimen &specimen, const PlatenTestSettings &settings) {
    constexpr long most = 20000;
    PlatenTest test(specimen, settings);
    while (!test.program().finished() && test.steps() < most) {
      test.advance(most);
      test.model.take_cracks();
    }
    EXPECT_TRUE(test.program().finished()) << "after " << most << " steps";
    return test.steps();
  }
};

TEST_F(RestartOfStages, a_pressed_skin_along_a_path_of_constant_mean_stress) {
  PlatenTestSettings s = in_cell();
  s.loading.cell->path = -1.0 / 3;
  compare(s, {"consolidation", "compression"});
}

TEST_F(RestartOfStages, a_sleeve_whose_platens_turn_round) {
  PlatenTestSettings s = in_cell();
  coupling::SleeveSettings sleeve;
  sleeve.thickness = 1.5e-3;
  sleeve.mass_scaling = 1;
  s.loading.cell->sleeve = sleeve;
  s.loading.cell->ramp = 4e-5;
  s.loading.unload_at = {3e-3};
  compare(s, {"consolidation", "compression", "cycling"});
}

TEST_F(RestartOfStages, pressed_alike_on_all_sides) {
  PlatenTestSettings s = in_cell();
  s.loading.cell->alone = true;
  compare(s, {"consolidation"});
}

TEST_F(RestartOfStages, a_wall_at_the_lateral_surface) {
  PlatenTestSettings s = crushed();
  s.loading.wall = true;
  compare(s, {"compression"});
}

TEST_F(RestartOfStages, a_stress_that_a_servo_holds) {
  PlatenTestSettings s = crushed();
  s.loading.servo = true;
  s.loading.top_stress = 5e6;
  s.loading.hold = 1e-5;
  compare(s, {"stress"});
}

TEST_F(RestartOfStages, glued_ends_that_part) {
  PlatenTestSettings s = crushed();
  s.loading.tension = true;
  s.platens.glued = true;
  s.loading.target_strain = 1e-3;
  compare(s, {"tension"});
}

TEST_F(RestartOfStages, a_rate_that_falls_as_the_specimen_fails) {
  PlatenTestSettings s = crushed();
  s.loading.rate_multiplier = 4;
  compare(s, {"compression"});
}

TEST_F(RestartOfStages, strips_that_split_a_disc) {
  PlatenTestSettings s = crushed();
  s.platens.strip_width = 1.5e-3;
  compare(coarse_specimen(dem::disc(4e-3, 4e-3)), s, {"compression"});
}

TEST_F(RestartOfStages, strips_that_bend_a_bar) {
  PlatenTestSettings s = crushed();
  s.end_layer = 1;
  s.platens.strip_width = 3e-3;
  s.platens.span = 10e-3;
  s.loading.ramp = 2e-5;
  const dem::Specimen bar = dem::random_close_packing(dem::box(4e-3, 4e-3, 14e-3), 0.6e-3, 0.25, 3);
  compare(dem::laid_along_x(bar), s, {"compression"});
}

} // namespace
} // namespace platen::apps
