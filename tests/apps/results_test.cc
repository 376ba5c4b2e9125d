// When a run has its peak behind it.
#include "apps/run/results.h"

#include <gtest/gtest.h>

#include "coupling/platen_test.h"
#include "dem/packing/advancing_front.h"
#include "tests/coupling/elastic_problem.h"

namespace platen::apps {
namespace {

class FallenTo : public testing::Test {
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

} // namespace
} // namespace platen::apps
