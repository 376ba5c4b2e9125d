// Moduli without inertia are those of the explicit scheme, loaded slowly.
#include "coupling/static_press.h"

#include <gtest/gtest.h>

#include <cmath>

#include "dem/measure/gauge.h"
#include "tests/coupling/set_ups.h"

namespace platen::coupling::static_press_test {
namespace {

PlatenTestSettings pressed_by(double friction, const dem::BondParameters &bond) {
  PlatenTestSettings s = elastic_settings(0.5, bond);
  s.platens.top = s.platens.bottom = {friction, friction};
  s.platens.damping = 0;
  s.loading.rate = 4e-4;
  return s;
}

struct Case {
  const char *name;
  double friction; // enough of it to stick
  dem::BondParameters bond;
  bool glued = false;
};
void PrintTo(const Case &c, std::ostream *out) {
  *out << c.name;
}

class StaticAgainstExplicit : public testing::TestWithParam<Case> {};

TEST_P(StaticAgainstExplicit, gives_the_same_modulus_and_poissons_ratio) {
  PlatenTestSettings settings = pressed_by(GetParam().friction, GetParam().bond);
  settings.platens.glued = GetParam().glued;
  PlatenTest problem(cylinder(), settings);
  const StaticPress still = press_statically(problem, 1e-5);
  EXPECT_GT(still.closed_top, 10u);
  EXPECT_GT(still.closed_bottom, 10u);
  EXPECT_GT(still.poisson_ratio(), 0.02);
  EXPECT_LT(still.youngs_modulus(), problem.facts().voigt_modulus);
  EXPECT_EQ(problem.closure_strain(), 0); // the problem itself has not moved

  const dem::Gauge gauge(problem.model.particles, problem.shape(), problem.model.bonds.get());
  while (problem.closure_strain() < 1e-5)
    problem.step();
  const dem::GaugeStrain strain = gauge.strain(problem.model.particles);
  const double stress = mean_stress(problem);
  EXPECT_GT(problem.steps(), 2000);
  EXPECT_NEAR(still.youngs_modulus() / (stress / -strain.axial), 1, 1e-3);
  EXPECT_NEAR(still.platen_modulus() / (stress / problem.closure_strain()), 1, 1e-3);
  EXPECT_NEAR(still.poisson_ratio() / (strain.lateral() / -strain.axial), 1, 1e-3);
}

INSTANTIATE_TEST_SUITE_P(static_press, StaticAgainstExplicit,
                         testing::Values(Case{"parallel_bonds_sticking", 1e6, unbreakable_bond()},
                                         Case{"parallel_bonds_lubricated", 0, unbreakable_bond()},
                                         Case{"beams_sticking", 1e6, dem::CohesiveBeam::Parameters{}},
                                         Case{"glued", 0, unbreakable_bond(), true}),
                         [](const testing::TestParamInfo<Case> &c) { return c.param.name; });

TEST(static_press, stress_is_linear_where_no_contact_changes) {
  PlatenTestSettings settings = pressed_by(1e6, unbreakable_bond());
  settings.end_layer = 0.05; // few seats, and no other sphere within reach
  PlatenTest problem(cylinder(), settings);
  const StaticPress once = press_statically(problem, 1e-7), twice = press_statically(problem, 2e-7);
  ASSERT_EQ(once.closed_top, twice.closed_top);
  EXPECT_NEAR(twice.stress, 2 * once.stress, 1e-6 * once.stress);
}

// Glue holds sideways without friction, and where free ends would let go.
TEST(static_press, glued_ends_are_stiffer_than_free_ones) {
  PlatenTestSettings settings = pressed_by(0, unbreakable_bond());
  PlatenTest lubricated(cylinder(), settings);
  settings.platens.glued = true;
  PlatenTest glued(cylinder(), settings);
  settings = pressed_by(1e6, unbreakable_bond());
  PlatenTest sticking(cylinder(), settings);
  const StaticPress slides = press_statically(lubricated, 1e-5), holds = press_statically(glued, 1e-5),
                    sticks = press_statically(sticking, 1e-5);
  EXPECT_GT(holds.platen_modulus(), 1.001 * slides.platen_modulus());
  EXPECT_GE(holds.platen_modulus(), (1 - 1e-6) * sticks.platen_modulus()); // one spring more or as many
  EXPECT_GE(holds.closed_top, sticks.closed_top);
  EXPECT_EQ(holds.closed_top, static_cast<std::size_t>(glued.top().layer().seats()));
  EXPECT_EQ(holds.closed_bottom, static_cast<std::size_t>(glued.bottom().layer().seats()));
}

// One on the lower platen, carried up by it alone, and one that touches nothing.
TEST(static_press, loose_spheres_change_nothing) {
  const dem::Specimen bonded = cylinder();
  const double r = 0.5e-3, beside = bonded.shape.radius + 1.2 * r;
  dem::Specimen more = bonded;
  for (const double z : {r, 0.5 * bonded.shape.height}) {
    more.centre.push_back({beside, 0, z});
    more.radius.push_back(r);
  }
  for (const double friction : {0., 1e6}) {
    PlatenTest without(bonded, pressed_by(friction, unbreakable_bond())),
        with(more, pressed_by(friction, unbreakable_bond()));
    ASSERT_EQ(with.model.bonds->size(), without.model.bonds->size());
    const StaticPress a = press_statically(without, 1e-5), b = press_statically(with, 1e-5);
    EXPECT_EQ(b.closed_top, a.closed_top);
    EXPECT_NEAR(b.youngs_modulus(), a.youngs_modulus(), 1e-6 * a.youngs_modulus());
    EXPECT_NEAR(b.platen_modulus(), a.platen_modulus(), 1e-6 * a.platen_modulus());
    EXPECT_NEAR(b.poisson_ratio(), a.poisson_ratio(), 1e-6);
  }
}

PlatenTestSettings breakable(double rate) {
  dem::ParallelBond::Parameters bond = unbreakable_bond();
  bond.tensile_strength = 10e6;
  bond.shear_strength = 28e6;
  bond.friction_angle = 0.7853981633974483; // 45 degrees
  PlatenTestSettings s = pressed_by(1e6, bond);
  s.model.contact = dem::ContactSettings{};
  s.model.contact->damping = 0;
  s.loading.rate = rate;
  return s;
}
struct Loaded {
  double modulus = 0, strength = 0, first_crack = 0, strain_at_peak = 0;
};
// To well beyond the peak; the modulus is the gauge's secant at the strain `at`.
Loaded load(PlatenTest &problem, double at) {
  const dem::Gauge gauge(problem.model.particles, problem.shape(), problem.model.bonds.get());
  Loaded result;
  while (problem.closure_strain() < 6e-3 && mean_stress(problem) > 0.6 * result.strength - 1) {
    problem.advance(10);
    const double stress = mean_stress(problem), strain = problem.closure_strain();
    if (result.modulus == 0 && strain >= at)
      result.modulus = stress / -gauge.strain(problem.model.particles).axial;
    if (result.first_crack == 0 && problem.model.broken_tension + problem.model.broken_shear > 0)
      result.first_crack = strain;
    if (stress > result.strength) result.strength = stress, result.strain_at_peak = strain;
  }
  return result;
}

TEST(static_start, leaves_nothing_in_motion_and_closes_the_energy_balance) {
  constexpr double strain = 5e-4;
  PlatenTest problem(cylinder(), breakable(1e-6)); // platens that all but stand
  const StaticPress p = start_statically(problem, strain);
  EXPECT_EQ(problem.time(), 0);
  EXPECT_EQ(problem.steps(), 0);
  EXPECT_NEAR(problem.closure_strain(), strain, 1e-12);
  // The solve is linear: what directions turn by under the strain is left over.
  EXPECT_NEAR(mean_stress(problem), p.stress, 5 * strain * p.stress);
  EXPECT_NEAR(problem.stress_top(), problem.stress_bottom(), 5 * strain * p.stress);
  const dem::EnergyLedger start = problem.energy();
  const double internal = start.bonds + start.contacts;
  EXPECT_EQ(start.kinetic, 0);
  EXPECT_NEAR(internal, 0.5 * p.stress * strain * problem.shape().volume(), 0.01 * internal);
  EXPECT_LT(std::abs(start.residual()), 5 * strain * internal);
  double most = 0;
  for (int look = 0; look < 100; ++look) {
    problem.advance(10);
    most = std::max(most, problem.energy().kinetic);
  }
  EXPECT_LT(most, 1e-6 * internal);
  EXPECT_GT(most, 0);
  EXPECT_LT(std::abs(problem.energy().residual()), 5 * strain * internal);
  EXPECT_EQ(problem.model.broken_tension + problem.model.broken_shear, 0);
}

// All at 0.04 m/s, a hundred thousandth of the speed of waves, with a smooth start of their own. Which bonds
// break after the first is decided by round-off after a while: one peak scatters by 2 %, now and then by 9,
// so that peaks are compared in the mean.
TEST(static_start, goes_on_to_the_same_modulus_and_strength) {
  double strength_from_nothing = 0, strength_from_start = 0;
  for (unsigned seed = 2; seed <= 7; ++seed) {
    SCOPED_TRACE(testing::Message() << "packing " << seed);
    const auto problem = [&] { return PlatenTest(small_cylinder(seed), breakable(0.04)); };
    PlatenTest scout = problem();
    const Loaded found = load(scout, 0);
    const double start = 0.8 * found.first_crack;
    ASSERT_GT(start, 0.2 * found.strain_at_peak); // worth it
    PlatenTest whole = problem(), begun = problem();
    start_statically(begun, start);
    const Loaded from_nothing = load(whole, 1.05 * start), from_start = load(begun, 1.05 * start);
    EXPECT_NEAR(from_start.modulus, from_nothing.modulus, 0.005 * from_nothing.modulus);
    EXPECT_NEAR(from_start.first_crack, from_nothing.first_crack, 0.01 * from_nothing.first_crack);
    strength_from_nothing += from_nothing.strength;
    strength_from_start += from_start.strength;
  }
  EXPECT_NEAR(strength_from_start, strength_from_nothing, 0.05 * strength_from_nothing);
}

TEST(static_start, is_refused_where_bonds_break_or_the_run_has_begun) {
  PlatenTest beyond(cylinder(), breakable(0.04));
  EXPECT_THROW(start_statically(beyond, 5e-3), BadSetup);
  PlatenTest late(cylinder(), breakable(0.04));
  late.step();
  EXPECT_THROW(start_statically(late, 1e-5), std::logic_error);
}

TEST(static_press, asks_for_bonds_and_a_strain) {
  PlatenTest problem(cylinder(), pressed_by(0, unbreakable_bond()));
  EXPECT_THROW(press_statically(problem, 0), NumericsStopped);
}

} // namespace
} // namespace platen::coupling::static_press_test
