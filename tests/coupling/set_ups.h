// Whole tests that others share: specimens of some hundred spheres; what is pulled, bent, split, held and
// crushed; platens of every kind, and the machine's spring behind them.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>

#include "coupling/boundaries/machine_spring.h"
#include "coupling/platen_test.h"
#include "dem/packing/advancing_front.h"
#include "dem/packing/growth.h"
#include "fem/elastic_solid.h"
#include "tests/coupling/elastic_problem.h"

namespace platen::coupling {

using fem::ElasticMotion;

inline constexpr double steel_modulus = 200e9; // Pa
inline constexpr std::array both_motions{ElasticMotion::explicit_steps, ElasticMotion::quasi_static};

inline dem::Specimen filled(const dem::Shape &shape, unsigned seed) {
  return dem::advancing_front(shape, {dem::RadiusDistribution::Kind::uniform, 0.7e-3, 1e-3}, seed);
}
inline dem::Specimen small_cylinder(unsigned seed = 5) {
  return filled(dem::cylinder(6e-3, 14e-3), seed);
}
inline const dem::Specimen &cylinder() {
  static const dem::Specimen s = small_cylinder();
  return s;
}
inline const dem::Specimen &thin_cylinder() {
  static const dem::Specimen s = filled(dem::cylinder(4e-3, 9e-3), 5);
  return s;
}
inline const dem::Specimen &block() {
  static const dem::Specimen s = filled(dem::box(12e-3, 12e-3, 14e-3), 3);
  return s;
}
inline const dem::Specimen &cube() {
  static const dem::Specimen s = filled(dem::box(12e-3, 12e-3, 12e-3), 3);
  return s;
}
inline const dem::Specimen &bar() {
  static const dem::Specimen s =
      dem::laid_along_x(dem::random_close_packing(dem::box(4e-3, 4e-3, 14e-3), 0.6e-3, 0.25, 3));
  return s;
}
inline dem::Specimen disc_of(unsigned seed) {
  return dem::laid_down(dem::random_close_packing(dem::cylinder(4e-3, 4e-3), 0.6e-3, 0.25, seed));
}
inline const dem::Specimen &disc() {
  static const dem::Specimen s = disc_of(3);
  return s;
}
inline const dem::Specimen &
packed_cylinder() { // some 900 spheres, eleven across: a third of them is the skin
  static const dem::Specimen s = dem::random_close_packing(dem::cylinder(11e-3, 26e-3), 1.3e-3, 0.25, 7);
  return s;
}
inline const dem::Specimen &coarse_cylinder() {
  static const dem::Specimen s = dem::random_close_packing(dem::cylinder(6e-3, 12e-3), 1.3e-3, 0.25, 7);
  return s;
}
inline const dem::Specimen &sphere() {
  static const dem::Specimen s = [] {
    dem::Specimen one;
    one.shape = dem::box(2e-3, 2e-3, 2e-3);
    one.centre = {{0, 0, 1e-3}}, one.radius = {1e-3};
    return one;
  }();
  return s;
}

// Nothing breaks, slides or is damped by signs of velocities, so that nothing decides by the last bits.
inline PlatenTestSettings smooth() {
  PlatenTestSettings s = elastic_settings(0.5);
  s.model.local_damping = 0;
  s.platens.damping = 0.1;
  s.platens.elements_across = 6;
  s.platens.thickness = 4e-3;
  s.loading.rate = 0.2;
  s.loading.ramp = 2e-5;
  return s;
}
inline PlatenTestSettings pulled() {
  PlatenTestSettings s = smooth();
  s.platens.glued = s.loading.tension = true;
  return s;
}
inline PlatenTestSettings split(double strip) {
  PlatenTestSettings s = smooth();
  s.end_layer = 1;
  s.platens.strip_width = strip;
  s.platens.thickness = 2e-3;
  return s;
}
inline PlatenTestSettings bent() {
  PlatenTestSettings s = split(3e-3);
  s.platens.span = 10e-3;
  return s;
}
inline PlatenTestSettings walled() {
  PlatenTestSettings s = smooth();
  s.loading.wall = true;
  return s;
}
inline void press(PlatenTestSettings &s, double pressure, double ramp = CellSettings{}.ramp) {
  CellSettings &cell = s.loading.cell.emplace();
  cell.pressure = pressure, cell.ramp = ramp;
}
// In rubber, within the cell.
inline SleeveSettings &wrap(PlatenTestSettings &s, double thickness,
                            double poisson = SleeveSettings{}.poisson_ratio) {
  SleeveSettings &sleeve = s.loading.cell->sleeve.emplace();
  sleeve.thickness = thickness, sleeve.poisson_ratio = poisson;
  return sleeve;
}
inline PlatenTestSettings hydrostatic(bool sleeve) {
  PlatenTestSettings s = smooth();
  press(s, 5e6, 4e-5);
  s.loading.cell->alone = true;
  if (sleeve) wrap(s, 1.5e-3).mass_scaling = 1;
  return s;
}
inline PlatenTestSettings held_at(double stress) {
  PlatenTestSettings s = smooth();
  s.model.local_damping = 0.3;
  s.loading.servo = true;
  s.loading.rate = 1, s.loading.top_stress = stress, s.loading.hold = 4e-5, s.loading.target_strain = 1;
  return s;
}

inline const dem::ParallelBond::Parameters brittle_bond{0.4, 2e6, 6e6, 0.7853981633974483, 0.3};
// What breaks within some hundred steps, and slides on platens of friction .3, then .2.
inline void make_brittle(PlatenTestSettings &s) {
  s.model.bond = brittle_bond;
  s.model.contact.emplace().damping = 0;
  s.model.local_damping = 0.3;
  s.platens.top = s.platens.bottom = {0.3, 0.2};
}
// Brittle and fast, under a machine of this stiffness (N/m).
inline PlatenTestSettings crushing(double machine = not_given) {
  PlatenTestSettings s = elastic_settings(0.5);
  make_brittle(s);
  s.platens.machine.stiffness = machine;
  s.loading.rate = 1;
  s.loading.ramp = 1e-6;
  return s;
}

// One sphere: two contacts, half of the stiffness of one, in series with the machine.
inline constexpr double contact_stiffness = 1e7; // N/m
inline PlatenTestSettings one_sphere(double machine) {
  PlatenTestSettings s;
  s.model.rotation = false;
  s.model.local_damping = 0.5;
  s.platens.stiffness = {dem::Stiffness::Kind::absolute, contact_stiffness};
  s.platens.thickness = 1e-3;
  s.platens.elements_across = 2;
  s.platens.machine.stiffness = machine;
  s.platens.machine.damping = 0.3;
  s.loading.rate = 0.01;
  s.loading.ramp = 2e-4;
  return s;
}

inline PlatenTestSettings elastic(PlatenTestSettings s, ElasticMotion motion, double young = steel_modulus) {
  s.platens.material.young_modulus = young;
  s.platens.elastic.emplace().motion = motion;
  return s;
}
// What the top platen is.
struct PlatenKind {
  const char *name;
  bool elastic = false, quasi_static = false, seat = false;
};
inline constexpr PlatenKind rigid_kind{"rigid"}, on_seat{"on_a_seat", false, false, true},
    yielding{"elastic", true}, followed{"quasi_static", true, true},
    yielding_on_seat{"elastic_on_a_seat", true, false, true},
    followed_on_seat{"quasi_static_on_a_seat", true, true, true};
inline constexpr std::array all_kinds{rigid_kind, on_seat,          yielding,
                                      followed,   yielding_on_seat, followed_on_seat};
inline constexpr std::array softer_kinds{yielding, followed, on_seat, yielding_on_seat, followed_on_seat};
inline PlatenTestSettings with(PlatenTestSettings s, const PlatenKind &kind) {
  if (kind.elastic) s.platens.elastic.emplace().motion = both_motions[kind.quasi_static];
  s.platens.spherical_seat = kind.seat;
  return s;
}

inline SideControl asked_of(SideGroup side, SideControl::Mode what, double value = not_given) {
  SideControl ask;
  ask.side = side, ask.mode = what, ask.value = value;
  return ask;
}

inline StageSettings asking(const std::vector<SideControl> &controls,
                            const std::vector<StageUntil> &until = {{Until::Reached::settled}}) {
  StageSettings stage;
  stage.controls = controls, stage.until = until;
  return stage;
}

// A cube pressed on all sides through frictionless platens, by stresses along x, y and z (Pa).
inline PlatenTestSettings six_platens(const std::array<double, 3> &stresses = {5e6, 5e6, 5e6}) {
  PlatenTestSettings s = elastic_settings(0.5);
  s.model.bond = dem::ParallelBond::Parameters{0.4, 1e12, 1e12, 0.0, 0.3};
  s.model.local_damping = 0; // its signs would tell round-off at rest apart
  s.platens.stiffness.value = 10;
  PlatenSide side;
  side.friction_static = side.friction_dynamic = 0;
  s.platens.top = s.platens.bottom = side;
  s.platens.left = s.platens.right = s.platens.front = s.platens.back = side;
  s.time_step.fixed_step = 8e-8; // that of two packings alike
  s.loading.stages = {asking({asked_of(SideGroup::lateral_x, SideControl::Mode::stress, stresses[0]),
                              asked_of(SideGroup::lateral_y, SideControl::Mode::stress, stresses[1]),
                              asked_of(SideGroup::axial, SideControl::Mode::stress, stresses[2])},
                             {{Until::Reached::settled}, {Until::Reached::time, 1e-3}})};
  s.loading.stages[0].name = "stresses", s.loading.stages[0].latest = 1e-3;
  return s;
}

inline void advance_to(PlatenTest &test, long steps) {
  while (test.steps() < steps) {
    test.advance(steps - test.steps());
    test.model.take_cracks();
  }
}
inline void advance_until(PlatenTest &test, double seconds) {
  while (test.time() < seconds)
    advance_to(test, test.steps() + 100);
}
inline void advance_to_end(PlatenTest &test, long most) {
  while (!test.program().finished() && test.steps() < most) {
    test.advance(most);
    test.model.take_cracks();
  }
  EXPECT_TRUE(test.program().finished()) << "after " << most << " steps";
}
inline void advance_to_axial_stage(PlatenTest &test, long most = 20000) {
  while (!test.axial_stage() && test.steps() < most)
    advance_to(test, test.steps() + 100);
  ASSERT_TRUE(test.axial_stage()) << "after " << most << " steps";
}
inline double mean_stress(const PlatenTest &test) {
  return 0.5 * (test.stress_top() + test.stress_bottom());
}
// What the energy balance misses over the work done, but for what platens without inertia are behind their
// loads.
inline double residual(const PlatenTest &test) {
  const dem::EnergyLedger energy = test.energy();
  return std::abs((energy.residual() + energy.unbalanced) / energy.boundary);
}

// Member and reason of what is refused; empty: nothing is.
inline std::string refusal(const dem::Specimen &specimen, const PlatenTestSettings &settings) {
  try {
    const PlatenTest test(specimen, settings);
  } catch (const BadSetup &e) {
    return e.member() + " " + e.reason();
  }
  return "";
}
inline void expect_refused(const dem::Specimen &specimen, const PlatenTestSettings &settings,
                           const std::string &member, const std::string &word = "") {
  const std::string told = refusal(specimen, settings);
  EXPECT_EQ(told.substr(0, member.size() + 1), member + " ") << told;
  EXPECT_NE(told.find(word), std::string::npos) << told;
}

} // namespace platen::coupling
