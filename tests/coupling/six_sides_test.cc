// A box between platens on all sides: where they lie, equal stresses, stress of one side by another, and that
// no direction is another than the others.
#include "coupling/platen_test.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "coupling/program_of_test.h"
#include "fem/grids.h"
#include "tests/coupling/set_ups.h"

namespace platen::coupling::six_sides_test {
namespace {

constexpr double edge = 12e-3, asked = 5e6; // m, Pa

// Turned so that what lay along x lies along y, y along z, z along x.
dem::Specimen turned(const dem::Specimen &from) {
  dem::Specimen to = from;
  for (std::size_t i = 0; i < from.size(); ++i) {
    const Vector3 c = from.centre[i];
    to.centre[i] = {c.z - 0.5 * edge, c.x, c.y + 0.5 * edge};
  }
  return to;
}

// Strains count from the end of a stage that presses all three axes alike, by platens or in a cell, of no
// other.
TEST(six_sides, all_three_axes_alike_consolidate) {
  const auto consolidates = [](const PlatenTestSettings &settings) {
    return PlatenTest(cube(), settings).program().stage(0).is_consolidation();
  };
  EXPECT_TRUE(consolidates(six_platens()));
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::array<double, 3> stresses{asked, asked, asked};
    stresses[axis] = 2 * asked;
    EXPECT_FALSE(consolidates(six_platens(stresses))) << axis;
    PlatenTestSettings two = six_platens();
    std::vector<SideControl> &controls = two.loading.stages[0].controls;
    controls.erase(controls.begin() + static_cast<std::ptrdiff_t>(axis));
    EXPECT_FALSE(consolidates(two)) << axis;
  }
  PlatenTestSettings cell = hydrostatic(false);
  EXPECT_TRUE(PlatenTest(cylinder(), cell).program().stage(0).is_consolidation());
  cell.loading.cell->alone = false;
  for (const double axial : {asked, 1.2 * asked}) {
    cell.loading.stages = {asking({asked_of(SideGroup::lateral, SideControl::Mode::pressure, asked),
                                   asked_of(SideGroup::axial, SideControl::Mode::stress, axial)})};
    EXPECT_EQ(PlatenTest(cylinder(), cell).program().stage(0).is_consolidation(), axial == asked);
  }
}

// Lowest and highest corner of what a platen fills.
std::array<Vector3, 2> extent(const PlatenTest &test, Side side) {
  std::array<Vector3, 2> corners{Vector3{1, 1, 1}, {-1, -1, -1}};
  for (const Vector3 &x : test.platen(side)->body().surface().vertices)
    for (const int k : {0, 1, 2})
      corners[0][k] = std::min(corners[0][k], x[k]), corners[1][k] = std::max(corners[1][k], x[k]);
  return corners;
}

// Inner faces in the planes of the specimen; edges short of the neighbours by a fiftieth. A mesh is laid on
// its side as a plate is, z towards the specimen, x and y exchanged in a cycle; it must end short of them
// too.
TEST(six_sides, platens_lie_on_the_faces_and_short_of_each_other) {
  const PlatenTest test(cube(), six_platens());
  const double gap = edge / 50, thick = 2e-3;
  for (const Side side : all_sides) {
    ASSERT_NE(test.platen(side), nullptr) << name_of(side);
    const int axis = axis_of(side);
    Vector3 low{-0.5 * edge + gap, -0.5 * edge + gap, gap}, high = low + (edge - 2 * gap) * Vector3{1, 1, 1};
    const double inner = (axis == 2 ? 0 : -0.5 * edge) + (is_high(side) ? edge : 0);
    low[axis] = inner - (is_high(side) ? 0 : thick), high[axis] = inner + (is_high(side) ? thick : 0);
    EXPECT_LT(norm(extent(test, side)[0] - low), 1e-12) << name_of(side);
    EXPECT_LT(norm(extent(test, side)[1] - high), 1e-12) << name_of(side);
  }
  const auto with_mesh = [](double half_width) {
    PlatenTestSettings settings = six_platens();
    settings.platens.partial_cover = true;
    settings.platens.left->grid =
        fem::make_grid(fem::BoxPlate{{-half_width, -3e-3, 7e-3}, {half_width, 3e-3, 9e-3}, {4, 4, 1}});
    return settings;
  };
  const auto [low, high] = extent(PlatenTest(cube(), with_mesh(5e-3)), Side::left);
  EXPECT_LT(norm(low - Vector3{-0.5 * edge - 2e-3, -5e-3, 0.5 * edge - 3e-3}), 1e-12);
  EXPECT_LT(norm(high - Vector3{-0.5 * edge, 5e-3, 0.5 * edge + 3e-3}), 1e-12);
  expect_refused(cube(), with_mesh(5.9e-3), "platens.left.grid", "along y, where the platen");
}

TEST(six_sides, axes_turn_into_one_another) {
  for (const Side side : all_sides) {
    const Vector3 up = from_upright(side, {0, 0, 1});
    EXPECT_EQ(norm(up - (is_high(side) ? -1.0 : 1.0) * inward(side)), 0) << name_of(side);
    const Vector3 v{1, 2, 3}, w{-2, 5, 0.5}, there = from_upright(side, v);
    EXPECT_EQ(norm(to_upright(side, there) - v), 0) << name_of(side);
    EXPECT_EQ(norm(cross(there, from_upright(side, w)) - from_upright(side, cross(v, w))), 0)
        << name_of(side);
    EXPECT_EQ(norm(inward(side) + inward(opposite(side))), 0) << name_of(side);
  }
}

TEST(six_sides, equal_stresses_on_all_sides) {
  for (const bool yields : {false, true}) {
    PlatenTestSettings settings = six_platens();
    if (yields) {
      settings.platens.elastic.emplace();
      settings.platens.elements_across = 4;
      settings.time_step.fixed_step = 0;
    }
    PlatenTest test(cube(), settings);
    advance_to_end(test, 100000);
    for (const Side side : all_sides)
      EXPECT_NEAR(test.stress(side), asked, 0.01 * asked) << name_of(side);
    EXPECT_LT(test.time(), 1e-3); // not by its time
    const dem::EnergyLedger energy = test.energy();
    EXPECT_EQ(energy.bodies > 0, yields);
    EXPECT_LT(std::abs(energy.residual()), (yields ? 1e-2 : 1e-4) * energy.boundary);
    for (const int axis : {0, 1, 2})
      EXPECT_GT(test.closure_strain(axis), 0) << axis;
  }
}

// Between platens alone servos are four times as quick as in a cell, which has to keep up with a pressure; on
// the machine's spring they would swing. What is given holds.
TEST(six_sides, servos_are_quick_between_platens_alone) {
  const auto gain = [](const PlatenTestSettings &settings) {
    return PlatenTest(cube(), settings).servo_for(asked, 0, 1e-3, 0.1).gain;
  };
  PlatenTestSettings settings = six_platens();
  EXPECT_EQ(gain(settings), 40);
  settings.platens.machine.stiffness = 1e8;
  EXPECT_EQ(gain(settings), 10);
  settings.loading.servo_gain = 3;
  EXPECT_EQ(gain(settings), 3);
}

// Along x twice what z bears, which rises by itself; y is free of platens.
TEST(six_sides, a_side_follows_a_share_of_another_sides_stress) {
  PlatenTestSettings settings = six_platens();
  settings.platens.front.reset(), settings.platens.back.reset();
  settings.loading.stages = {asking({asked_of(SideGroup::axial, SideControl::Mode::rate, 0.05),
                                     asked_of(SideGroup::lateral_x, SideControl::Mode::fraction, 0.5)},
                                    {{Until::Reached::stress, 2 * asked, SideGroup::axial}})};
  PlatenTest test(cube(), settings);
  advance_to_end(test, 100000);
  const double axial = test.axial_stress(), left = test.stress(Side::left), right = test.stress(Side::right);
  EXPECT_GE(axial, 2 * asked);
  EXPECT_LT(axial, 2.05 * asked);
  EXPECT_NEAR(0.5 * (left + right), 0.5 * axial, 0.02 * axial);
  EXPECT_TRUE(std::isnan(test.stress(Side::front)));
  EXPECT_TRUE(std::isnan(test.closure_strain(1)));
}

TEST(six_sides, what_has_no_such_sides_is_refused) {
  PlatenTestSettings settings = six_platens();
  settings.platens.left.reset(), settings.platens.right.reset(), settings.platens.front.reset();
  expect_refused(cylinder(), settings, "platens.back", "box");
  settings = six_platens();
  settings.platens.edge_gap = 0.26 * edge;
  expect_refused(cube(), settings, "platens.edge_gap", "quarter");
}

// The axis of the platens that go at a rate, the axial one among several; what holds or bears a stress loads
// nothing.
TEST(six_sides, a_test_loads_the_axis_that_its_stages_drive) {
  using G = SideGroup;
  using Mode = SideControl::Mode;
  const auto axis = [](const std::vector<SideControl> &first, const std::vector<SideControl> &second) {
    PlatenTestSettings settings = six_platens();
    const std::vector<StageUntil> end{{Until::Reached::time, 1e-3}};
    settings.loading.stages = {asking(first, end), asking(second, end)};
    return loaded_axis(PlatenTest(cube(), settings));
  };
  const SideControl held = asked_of(G::axial, Mode::stress, 1e6), x = asked_of(G::lateral_x, Mode::rate, 0.1),
                    left = asked_of(G::left, Mode::rate, 0.1), y = asked_of(G::lateral_y, Mode::rate, 0.1),
                    top = asked_of(G::top, Mode::rate, 0.1), sides = asked_of(G::lateral, Mode::rate, 0.1),
                    stress_x = asked_of(G::lateral_x, Mode::stress, 2e6);
  EXPECT_EQ(axis({held}, {x, held}), 0);
  EXPECT_EQ(axis({held}, {left, held}), 0);
  EXPECT_EQ(axis({held, stress_x}, {y, held}), 1);
  EXPECT_EQ(axis({x}, {y, held}), 0);
  EXPECT_EQ(axis({y}, {x, held}), 1);
  EXPECT_EQ(axis({x}, {top}), 2);
  EXPECT_EQ(axis({held}, {stress_x}), 2);
  EXPECT_EQ(axis({held}, {sides}), 0);
  PlatenTestSettings by_keys = six_platens();
  by_keys.loading.stages.clear();
  by_keys.loading.rate = 0.1;
  EXPECT_EQ(loaded_axis(PlatenTest(cube(), by_keys)), 2);
}

// Steel would meet steel: the run ends before it does, and says which platen.
TEST(six_sides, platens_do_not_pass_through_each_other) {
  PlatenTestSettings settings = six_platens();
  settings.platens.edge_gap = 5e-6;
  settings.loading.stages = {asking({asked_of(SideGroup::lateral_x, SideControl::Mode::rate, 1)},
                                    {{Until::Reached::strain, 0.5, SideGroup::lateral_x}})};
  PlatenTest test(cube(), settings);
  try {
    test.advance(100000);
    FAIL() << "closed by " << test.closure_strain(0) * edge << " m";
  } catch (const NumericsStopped &e) {
    EXPECT_NE(std::string(e.what()).find("left has closed"), std::string::npos) << e.what();
    EXPECT_NE(std::string(e.what()).find("`platens.edge_gap`"), std::string::npos) << e.what();
  }
  const double closed = test.platen(Side::left)->closure();
  EXPECT_GE(closed, 5e-6);
  EXPECT_LT(closed, 1.5e-5); // asked every hundred steps
}

// The packing turned, and with it the stresses: each axis does what the one before it did.
TEST(six_sides, no_axis_is_another_than_the_others) {
  PlatenTest before(cube(), six_platens({1e6, 3e6, 5e6})),
      after(turned(cube()), six_platens({5e6, 1e6, 3e6}));
  for (PlatenTest *test : {&before, &after})
    for (int steps = 0; steps < 2000; ++steps)
      test->step();
  for (const int axis : {0, 1, 2}) {
    const double was = before.closure_strain(axis), is = after.closure_strain((axis + 1) % 3);
    EXPECT_NEAR(is, was, 1e-9 * std::abs(was)) << "along " << axis;
  }
}

} // namespace
} // namespace platen::coupling::six_sides_test
