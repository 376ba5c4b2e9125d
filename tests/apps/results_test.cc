// When a run has its peak behind it.
#include "apps/run/results.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "apps/run/validity.h"
#include "apps/scratch_folder.h"
#include "coupling/program_of_test.h"
#include "dem/packing/advancing_front.h"
#include "tests/coupling/elastic_problem.h"

namespace platen::apps {
namespace {

using namespace testing;

class FallenTo : public ::testing::Test {
protected:
  // At a deviator (Pa) in a cell of 4.5 MPa, with so many bonds broken since the start.
  void at(double deviator, double broken, double axial_stage = 1) {
    Sample s;
    s.cell_pressure = 4.5e6;
    s.stress_top = s.stress_bottom = 4.5e6 + deviator;
    s.intact_bonds = bonds_ - broken;
    s.broken_tension = broken;
    s.axial_stage = axial_stage;
    results_.add(s, problem_);
  }
  double bonds_ = 100;
  coupling::PlatenTest problem_{dem::advancing_front(dem::box(6e-3, 6e-3, 8e-3), dem::equal_radii(1e-3), 3),
                                coupling::elastic_settings(0.5)};
  Results results_{false};
};

TEST_F(FallenTo, the_first_oscillations_of_the_platens_are_no_peak) {
  at(-2e4, 3, 0);
  at(4e4, 3);
  at(1e4, 3);
  EXPECT_FALSE(results_.fallen_to(0.7));
  at(2e7, 40);
  EXPECT_FALSE(results_.fallen_to(0.7));
  at(1.5e7, 60);
  EXPECT_FALSE(results_.fallen_to(0.7));
  at(1.3e7, 70);
  EXPECT_TRUE(results_.fallen_to(0.7));
}

TEST_F(FallenTo, without_bonds_a_fall_is_a_fall) {
  bonds_ = 0;
  at(1e6, 0);
  at(6e5, 0);
  EXPECT_TRUE(results_.fallen_to(0.7));
  EXPECT_FALSE(results_.fallen_to(0.5));
}

// What is told of the peak, by what stages ask.
class Asked : public FallenTo {
protected:
  static constexpr auto none = coupling::Loads::none, closure = coupling::Loads::by_closure,
                        widening = coupling::Loads::by_widening;
  // At a deviator (MPa) and a strain (1e-3); gives whether the pattern was taken.
  bool at(double deviator, double strain, coupling::Loads loads, double pressure = 2, double setting = 0) {
    Sample s;
    s.time = ++time_;
    s.cell_pressure = s.confining_pressure = 1e6 * pressure;
    s.stress_top = s.stress_bottom = 1e6 * (pressure + deviator);
    s.strain_platen = s.strain_gauge = 1e-3 * strain;
    s.opening = strain;
    s.intact_bonds = 100 - time_, s.broken_tension = time_;
    s.loads = static_cast<double>(loads);
    s.setting = setting;
    return results_.add(s, problem_);
  }
  double time_ = 0;
};

TEST_F(Asked, a_stress_that_falls_by_command_has_no_peak) {
  for (const auto loads : {closure, widening}) {
    at(0, 0, loads);
    at(30, 1, loads);
    EXPECT_FALSE(at(20, 1.1, none));
    EXPECT_FALSE(results_.fallen_to(0.8));
    EXPECT_FALSE(results_.peak().reached());
    EXPECT_TRUE(results_.goes_on_by_command());
    EXPECT_TRUE(std::isnan(results_.pattern().time));
    EXPECT_TRUE(at(20, 1.2, loads)) << "it has given way";
    EXPECT_TRUE(results_.fallen_to(0.8));
    EXPECT_EQ(results_.peak().kind, PeakKind::fallen);
    results_ = Results(false);
  }
}

// The way back to the strain of the turn shows nothing new, whatever is borne there.
TEST_F(Asked, what_is_loaded_again_counts_from_where_it_came_down) {
  at(0, 0, widening);
  at(30, 1, widening);
  at(10, 0.6, none);
  at(24, 0.9, widening);
  EXPECT_FALSE(results_.peak().reached());
  EXPECT_FALSE(results_.fallen_to(0.9));
  at(32, 0.95, widening);
  EXPECT_NEAR(results_.strength(), 32e6, 1);
  at(31, 1, widening);
  EXPECT_NEAR(results_.strength(), 33e6, 1); // 31 and the pressure of 2
  at(24, 0.9, widening);                     // the platens part: class II
  EXPECT_TRUE(results_.peak().reached());
  EXPECT_TRUE(results_.fallen_to(0.8));
}

TEST_F(Asked, a_fall_at_another_pressure_is_none) {
  at(0, 0, closure, 12, 1);
  at(60, 1, closure, 12, 1);
  EXPECT_FALSE(at(40, 1.5, closure, 2, 2));
  EXPECT_FALSE(results_.fallen_to(0.8));
  EXPECT_FALSE(results_.peak().reached());
  EXPECT_TRUE(results_.goes_on_by_command());
  EXPECT_TRUE(at(40, 1.5, closure, 12, 1));
  EXPECT_TRUE(results_.peak().reached());
}

// Platens hold while the pressure goes up, then down: the largest stress is of one moment, the largest
// deviator of another, and neither is at the peak.
TEST_F(Asked, figures_at_the_peak_are_of_one_sample_and_the_largest_of_the_column) {
  at(0, 0, closure, 2, 1);
  at(40, 1, closure, 2, 1);
  at(38, 1.1, closure, 2, 1);
  at(35, 1.2, none, 12, 2);
  at(41, 1.2, none, 1, 3);
  at(20, 1.2, none, 1, 3);
  EXPECT_TRUE(results_.peak().reached());
  EXPECT_NEAR(results_.strength(), 42e6, 1);
  EXPECT_NEAR(results_.deviator_strength(), 40e6, 1);
  EXPECT_NEAR(results_.confining_pressure(), 2e6, 1);
  EXPECT_NEAR(results_.strain_at_peak(&Sample::strain_platen), 1e-3, 1e-15);
  EXPECT_EQ(results_.at_peak(&Sample::opening), 1);
  EXPECT_EQ(results_.time_at_peak(), 2);
  EXPECT_NEAR(results_.largest_stress().value, 47e6, 1);
  EXPECT_EQ(results_.largest_stress().time, 4);
  EXPECT_NEAR(results_.largest_deviator().value, 41e6, 1);
  EXPECT_EQ(results_.largest_deviator().time, 5);
}

TEST_F(Asked, without_a_peak_the_pressure_is_that_at_the_end_and_a_hold_is_no_loading) {
  at(0, 0, none, 2, 1);
  EXPECT_FALSE(results_.is_ever_loaded_on());
  at(9, 1, none, 5, 2);
  EXPECT_FALSE(results_.is_ever_loaded_on());
  EXPECT_TRUE(std::isnan(results_.strength()));
  EXPECT_NEAR(results_.largest_stress().value, 14e6, 1);
  EXPECT_NEAR(results_.confining_pressure(), 5e6, 1);
  at(11, 2, closure, 5, 2);
  EXPECT_TRUE(results_.is_ever_loaded_on());
  EXPECT_NEAR(results_.confining_pressure(), 5e6, 1);
}

// The work of a triangle; what goes back on the way gives back what it took.
TEST_F(Asked, work_is_the_area_under_the_curve) {
  EXPECT_TRUE(std::isnan(results_.work_over_strain()));
  for (const auto &[stress, strain] : {std::pair{0.0, 0.0},
                                       {10.0, 0.5},
                                       {20.0, 1.0},
                                       {30.0, 1.5},
                                       {20.0, 1.0},
                                       {30.0, 1.5},
                                       {15.0, 3.0},
                                       {0.0, 4.5}})
    at(stress, strain, widening, 0);
  EXPECT_NEAR(results_.work_over_strain(), 0.5 * 30e6 * 4.5e-3, 1e-6);
}

// What bonds lose passes from damage and yield to fracture as they fail.
TEST_F(Asked, losses_of_bonds_count_from_the_start) {
  for (const auto &[plastic, fracture] : {std::pair{1.0, 2.0}, {4.0, 2.0}, {2.5, 7.0}}) {
    Sample s;
    s.platen_plastic = 3 * plastic; // what platens lose is none of it
    s.plastic = plastic + s.platen_plastic, s.fracture = fracture;
    results_.add(s, problem_);
  }
  EXPECT_DOUBLE_EQ(results_.lost_in_bonds(), 6.5);
}

// Between a pressure that rises and another one a ratio of stress and strain is no modulus.
TEST_F(Asked, moduli_are_of_a_specimen_that_is_loaded_on_with_the_same_sides) {
  const auto loaded_on = [&](coupling::Loads loads, double setting) {
    results_ = Results(false);
    at(0, 0, closure, 2, 1);
    at(30, 1, loads, 2, setting);
    at(40, 2, closure, 2, 1);
    return results_.modulus_state().loaded_on;
  };
  EXPECT_TRUE(loaded_on(closure, 1));
  EXPECT_FALSE(loaded_on(none, 1));
  EXPECT_FALSE(loaded_on(closure, 2));
}

// What is not a number is not passed over.
TEST_F(Asked, a_largest_of_what_is_not_finite_is_none) {
  at(30, 1, closure);
  at(std::nan(""), 1, closure);
  at(20, 2, closure);
  EXPECT_TRUE(std::isnan(results_.largest_stress().value));
  EXPECT_TRUE(std::isnan(results_.largest_stress().time));
}

// A box between six platens, those along x driven.
coupling::PlatenTestSettings driven_along_x() {
  coupling::PlatenTestSettings s = coupling::elastic_settings(0.5);
  coupling::PlatenSide side;
  s.platens.left = s.platens.right = s.platens.front = s.platens.back = side;
  coupling::StageSettings stage;
  stage.controls.emplace_back();
  stage.controls.back().side = coupling::SideGroup::lateral_x;
  stage.controls.back().mode = coupling::SideControl::Mode::rate;
  stage.controls.back().value = 0.1;
  stage.until = {{coupling::Until::Reached::time, 1}};
  s.loading.stages = {stage};
  return s;
}

class Along : public ::testing::Test {
protected:
  Along() { problem_.advance(500); }
  // Stresses along x and y in Pa, strains there of x; the axial platens bear and close more.
  bool at(Results &results, double x, double strain_x, double y, double axial_stage = 1) {
    Sample s;
    s.time = ++time_;
    s.stress_left = 1.1 * x, s.stress_right = 0.9 * x, s.strain_x = strain_x;
    s.stress_front = 1.2 * y, s.stress_back = 0.8 * y, s.strain_y = 2 * strain_x;
    s.stress_top = s.stress_bottom = 60e6 + x, s.strain_platen = 7 * strain_x, s.strain_gauge = 5 * strain_x;
    s.lateral_strain = -strain_x;
    s.broken_tension = time_, s.intact_bonds = 100 - time_;
    s.axial_stage = axial_stage;
    return results.add(s, problem_);
  }
  void crush(Results &results) {
    at(results, 1e6, 1e-4, 1e6, 0);
    at(results, 10e6, 5e-4, 1e6);
    at(results, 20e6, 1.1e-3, 2e6);
    EXPECT_FALSE(at(results, 17e6, 1.2e-3, 30e6));
    EXPECT_FALSE(results.fallen_to(0.85));
    const bool fallen = at(results, 15e6, 1.3e-3, 20e6);
    EXPECT_EQ(fallen, results.axis() != 2);
    results.finish(problem_, {});
  }
  double time_ = 0;
  coupling::PlatenTest problem_{
      dem::advancing_front(dem::box(10e-3, 10e-3, 12e-3), dem::equal_radii(1e-3), 3), driven_along_x()};
};

TEST_F(Along, strength_and_strain_are_of_the_axis_that_is_driven) {
  Results x(false, {}, 0), y(false, {}, 1), z(false, {}, 2);
  for (Results *results : {&x, &y, &z})
    time_ = 0, crush(*results);
  EXPECT_NEAR(x.strength(), 20e6, 1);
  EXPECT_NEAR(x.strain_at_peak(&Sample::strain_x), 1e-3, 1e-15); // since the end of the consolidation
  EXPECT_NEAR(x.secant(&Sample::strain_x), (8e6 - 1e6) / (1e-4 + 4e-4 * 7 / 9 - 1e-4), 1); // since then
  EXPECT_EQ(x.time_at_peak(), 3);
  EXPECT_TRUE(x.fallen_to(0.8));
  EXPECT_FALSE(x.fallen_to(0.7));
  EXPECT_NEAR(y.strength(), 30e6, 1);
  EXPECT_NEAR(y.strain_at_peak(&Sample::strain_y), 2.2e-3, 1e-15);
  EXPECT_TRUE(y.fallen_to(0.7));
  EXPECT_NEAR(z.strength(), 80e6, 1);
  EXPECT_NEAR(z.strain_at_peak(&Sample::strain_platen), 7e-3, 1e-15);
  EXPECT_FALSE(z.fallen_to(0.9));
  EXPECT_EQ(x.at_peak(stress_of(coupling::Side::top)), 80e6);
  EXPECT_NEAR(x.unequal_at_peak(), 0.2, 1e-12); // 1.1 and 0.9 of the mean
  EXPECT_NEAR(x.modulus_state().unequal, 0.2, 1e-12);
  EXPECT_NEAR(y.unequal_at_peak(), 0.4, 1e-12);
  EXPECT_EQ(z.unequal_at_peak(), 0);
  EXPECT_EQ(x.readings_to_peak(), 2u); // the first row is of the consolidation
  EXPECT_EQ(x.modulus_state().readings, 1u);
  EXPECT_EQ(x.modulus_state().broken, 1);
  EXPECT_NEAR(x.modulus_state().stress, 8e6, 1e-6);
  EXPECT_TRUE(x.peak().reached());
  EXPECT_NEAR(x.stress_at_end(), 15e6, 1e-6);
}

TEST_F(Along, the_pattern_is_taken_where_that_stress_has_fallen) {
  ASSERT_EQ(coupling::loaded_axis(problem_), 0);
  ASSERT_GT(std::abs(problem_.closure_strain(0)), 1e-5);
  Results x(false, {}, 0), z(false, {}, 2);
  crush(x), time_ = 0, crush(z);
  EXPECT_EQ(x.pattern().strain, problem_.closure_strain(0));
  EXPECT_EQ(x.pattern().broken_tension, 0);
  EXPECT_TRUE(std::isnan(z.pattern().strain));
  EXPECT_EQ(z.last_pattern().strain, problem_.closure_strain());
}

// Ends, cones and the gauge are those of a specimen that is loaded along z.
TEST_F(Along, what_is_measured_along_z_is_not_measured_along_x) {
  Results x(false, {}, 0), z(false, {}, 2);
  crush(x), time_ = 0, crush(z);
  for (Results *results : {&x, &z}) {
    const dem::FailureMeasures &failure = results->last_pattern().failure;
    for (const double value : {failure.broken_fraction, failure.damage.end_top, failure.damage.middle})
      EXPECT_EQ(std::isnan(value), results == &x);
    const Scene scene;
    const RunCosts costs;
    const Reasons reasons = reasons_against({scene, problem_, *results, costs}, figures(), Json::object());
    for (const char *gauged : {"strain_at_peak_gauge", "youngs_modulus_gauge_pa", "poisson_ratio",
                               "poisson_ratio_extremal", "barrel_at_peak"}) {
      const auto found = reasons.find(gauged);
      const bool told = found != reasons.end() && std::count(found->second.begin(), found->second.end(),
                                                             "the gauge is of tests along z") == 1;
      EXPECT_EQ(told, results == &x) << gauged;
    }
  }
  EXPECT_TRUE(std::isnan(x.pattern().failure.broken_fraction));
}

// Both ends by turns: a dome is told as one, on whichever platen it stands.
TEST(FailureWords, name_a_dome_beside_a_cone) {
  const auto words = [](dem::DeadZoneVerdict bottom, dem::DeadZoneVerdict top) {
    dem::FailureMeasures m;
    m.dead[dem::bottom_end].verdict = bottom, m.dead[dem::top_end].verdict = top;
    return reason_words(m);
  };
  const auto cone = dem::DeadZoneVerdict::cone, dome = dem::DeadZoneVerdict::dome;
  EXPECT_EQ(words(cone, cone), "what moves with the platens is a cone on each");
  for (const std::string &one : {words(cone, dome), words(dome, cone)})
    EXPECT_EQ(one, "what moves with the platens is a cone on one and a dome on the other");
  EXPECT_FALSE(contains(words(dome, dome), "cone"));
}

} // namespace
} // namespace platen::apps
