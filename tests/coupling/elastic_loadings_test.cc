// Elastic platens in every test there is: stiff ones are rigid ones, soft ones are in series, and a stress is
// held.
#include "tests/coupling/set_ups.h"

#include <algorithm>
#include <string>

#include "tests/measured.h"

namespace platen::coupling::elastic_loadings_test {
namespace {

// Load on rigid platens over that on stiff ones that are led alike, less one, at 10, 100 and 1000 times the
// modulus of steel.
std::array<double, 3> shortfalls(const dem::Specimen &specimen, PlatenTestSettings rigid, long steps) {
  PlatenTestSettings yields = elastic(rigid, ElasticMotion::quasi_static, steel_modulus);
  rigid.time_step.fixed_step = yields.time_step.fixed_step = 0.5 * PlatenTest(specimen, rigid).time_step();
  PlatenTest reference(specimen, rigid);
  advance_to(reference, steps);
  const double load = reference.axial_stress();
  EXPECT_GT(std::abs(load), 1e5);
  std::array<double, 3> all{};
  for (std::size_t k = 0; k < 3; ++k) {
    yields.platens.material.young_modulus = std::array{10.0, 100.0, 1000.0}[k] * steel_modulus;
    PlatenTest test(specimen, yields);
    advance_to(test, steps);
    EXPECT_EQ(clamp_closure(test), clamp_closure(reference));
    all[k] = 1 - test.axial_stress() / load;
  }
  return all;
}

// As 1 / E, so that the next order is left out, and by less than 0.1 % at a thousand times steel.
void expect_stiff_is_rigid(const std::string &what, const dem::Specimen &specimen,
                           const PlatenTestSettings &rigid, long steps) {
  const std::array<double, 3> s = shortfalls(specimen, rigid, steps);
  EXPECT_GT(s[2], 0);
  measured::expect_below(32, "shortfall_at_a_thousand_times_steel_" + what, s[2], 1e-3);
  EXPECT_NEAR(s[0] / s[1], 10, 1) << s[0] << " " << s[1] << " " << s[2];
  EXPECT_NEAR(s[1] / s[2], 10, 1) << s[0] << " " << s[1] << " " << s[2];
}

TEST(elastic_loadings, stiff_platens_press_as_rigid_ones) {
  PlatenTestSettings seated = pulled();
  seated.seat = true; // grains give moments too
  expect_stiff_is_rigid("pressed", cylinder(), smooth(), 1500);
  expect_stiff_is_rigid("pulled", cylinder(), pulled(), 1500);
  expect_stiff_is_rigid("pulled_by_seats", cylinder(), seated, 1500);
  expect_stiff_is_rigid("bent", bar(), bent(), 1500);
  expect_stiff_is_rigid("split_by_strips", disc(), split(1.5e-3), 1500);
  expect_stiff_is_rigid("split_by_platens", disc(), split(0), 1500);
  expect_stiff_is_rigid("in_a_wall", cylinder(), walled(), 1500);
}

// Without lateral strain of the platen an even load moves its face evenly, so that by reciprocity the mean of
// the face goes by F t / (E A) under any load: pulled, too.
TEST(elastic_loadings, a_pulled_platen_gives_way_by_its_thickness_over_its_modulus) {
  for (const bool glued_in_tension : {true, false}) {
    PlatenTestSettings s = elastic(glued_in_tension ? pulled() : smooth(), ElasticMotion::quasi_static, 10e9);
    s.platens.material.poisson_ratio = 0;
    s.platens.overhang = 1;
    s.seat = true;
    PlatenTest test(block(), s);
    advance_to(test, 1500);
    for (Platen *platen : {&test.top(), &test.bottom()}) {
      auto &solid = static_cast<fem::ElasticSolid &>(platen->body());
      const double load = platen->load();
      ASSERT_GT((glued_in_tension ? -1 : 1) * load, 1);
      solid.solve_for(solid.contact_loads(), 0); // the shape under the loads of now
      const double yielded = dot(solid.displacement(), platen->inward()) - platen->closure();
      const double expected = load * s.platens.thickness / (10e9 * test.nominal_area());
      EXPECT_NEAR(yielded / expected, 1, 1e-6) << platen->name();
    }
  }
}

// 1 / K = 1 / K of the specimen between rigid ends + 2 t / (E A); soft platens hold its ends a little less.
TEST(elastic_loadings, soft_glued_platens_are_in_series_with_the_specimen) {
  PlatenTestSettings rigid = pulled();
  rigid.platens.overhang = 1;
  rigid.platens.material.poisson_ratio = 0;
  rigid.platens.thickness = 20e-3;
  rigid.platens.stiffness.value = 0.5; // the mesh takes no more of the contacts than they have
  rigid.model.local_damping = 0.5;
  rigid.loading.rate = 0.02;
  rigid.time_step.fixed_step = 4e-8;
  const auto compliance = [](const PlatenTestSettings &s) { // m/Pa
    PlatenTest test(block(), s);
    advance_to(test, 6000);
    EXPECT_LT(test.axial_stress(), -1e5);
    EXPECT_LT(residual(test), 0.01);
    return clamp_closure(test) / test.axial_stress();
  };
  const double specimen = compliance(rigid);
  for (const ElasticMotion motion : both_motions) {
    const double soft = 100e9, own = 2 * rigid.platens.thickness / soft;
    ASSERT_GT(own, 0.2 * specimen);
    EXPECT_NEAR(compliance(elastic(rigid, motion, soft)) / (specimen + own), 1, 0.02)
        << static_cast<int>(motion) << " " << specimen << " " << own;
  }
}

TEST(elastic_loadings, all_sides_press_alike_between_stiff_platens_as_between_rigid_ones) {
  for (const bool sleeve : {false, true}) {
    PlatenTestSettings rigid = hydrostatic(sleeve);
    rigid.loading.cell->ramp = 0; // long enough for the servo
    rigid.time_step.fixed_step = 5e-8;
    PlatenTest reference(cylinder(), rigid);
    advance_to_end(reference, 40000);
    EXPECT_NEAR(reference.axial_stress(), 5e6, 5e4) << sleeve;
    for (const ElasticMotion motion : both_motions) {
      const bool still = motion == ElasticMotion::quasi_static;
      PlatenTest test(cylinder(), elastic(rigid, motion, still ? 100 * steel_modulus : steel_modulus));
      advance_to_end(test, 40000);
      EXPECT_NEAR(test.axial_stress(), 5e6, 5e4) << sleeve << still;
      EXPECT_NEAR(test.closure_strain() / reference.closure_strain(), 1, still ? 0.01 : 0.03)
          << sleeve << still;
      EXPECT_LT(residual(test), 5e-3) << sleeve << still;
    }
  }
}

// A bar on steel strips and one on strips with sheets of 2 GPa: these take a part of the deflection of the
// clamps.
TEST(elastic_loadings, sheets_on_strips_are_in_series_with_the_bar) {
  PlatenTestSettings s = elastic(bent(), ElasticMotion::quasi_static, steel_modulus);
  s.model.local_damping = 0.5;
  PlatenTest hard(bar(), s);
  s.platens.elastic->pad_thickness = 0.5e-3;
  s.platens.elastic->pad = {1200, 2e9, 0};
  PlatenTest soft(bar(), s);
  double yielded[2], force[2];
  for (PlatenTest *test : {&hard, &soft}) {
    advance_to(*test, 6000);
    const bool pad = test == &soft;
    force[pad] = test->top().load();
    yielded[pad] = dot(test->top().body().displacement(), test->top().inward()) - test->top().closure();
    EXPECT_LT(residual(*test), 5e-3) << pad;
    // Half of the load on each support, and the moment of the bar between P L / 4 and that of the strips'
    // inner edges.
    const double nominal = 0.25 * 10e-3 * force[pad];
    EXPECT_GT(test->midspan_moment(), 0.55 * nominal);
    EXPECT_LT(test->midspan_moment(), 1.1 * nominal);
  }
  // P t / (E A) on the mean over an evenly loaded strip: 3 mm wide, 4.8 mm long, 4 mm of it over the bar.
  const double even = force[1] * 0.5e-3 / (2e9 * 3e-3 * 4.8e-3);
  EXPECT_GT(yielded[1], even);
  EXPECT_LT(yielded[1], 1.6 * even);
  EXPECT_LT(yielded[0] / force[0], 0.1 * yielded[1] / force[1]);
}

struct Held {
  std::string what;
  const dem::Specimen &(*specimen)();
  PlatenTestSettings settings;
  double within = 0.01;  // of the stress, in the last fifth of the hold
  double missing = 5e-3; // of the work, in the energy balance
};
// On steel and on sheets a hundred times softer, through the spring of the machine, on a platen that turns.
std::vector<Held> held_stresses() {
  std::vector<Held> all;
  for (const ElasticMotion motion : both_motions)
    for (const bool pad : {false, true}) {
      PlatenTestSettings s = elastic(held_at(5e6), motion, steel_modulus);
      s.loading.ramp = 1e-4; // some twenty transits of a wave, and a hundred to stand
      s.loading.hold = 5e-4;
      if (pad) {
        s.loading.hold = 1.5e-3; // the servo's dashpot has more to close
        s.platens.elastic->pad_thickness = 1e-3;
        s.platens.elastic->pad = {1200, 2e9, 0.3};
      }
      all.push_back({std::to_string(static_cast<int>(motion)) + (pad ? " on sheets" : ""), cylinder, s});
    }
  for (const double machine : {0.03 * contact_stiffness, contact_stiffness}) {
    PlatenTestSettings s = one_sphere(machine);
    s.platens.machine.damping = 0.1;
    s.loading.servo = true;
    s.loading.top_stress = 2e6, s.loading.rate = 1, s.loading.ramp = 2e-3, s.loading.hold = 8e-3;
    all.push_back({"machine " + std::to_string(machine), sphere, s, 0.01, 1e-3});
  }
  PlatenTestSettings s = with(held_at(2e6), on_seat);
  s.loading.ramp = 4e-4, s.loading.hold = 2e-4, s.loading.rate = 0.5;
  all.push_back({"seat", cylinder, s, 0.02, 2e-3});
  return all;
}

TEST(elastic_loadings, a_servo_holds_its_stress_whatever_it_acts_through) {
  for (const Held &held : held_stresses()) {
    const double asked = held.settings.loading.top_stress;
    PlatenTest test(held.specimen(), held.settings);
    const double held_from = test.ramp() + 0.8 * held.settings.loading.hold;
    double farthest = 0, most = 0;
    while (!test.program().finished() && test.steps() < 200000) {
      advance_to(test, test.steps() + 1);
      most = std::max(most, test.stress_top() / asked);
      if (test.time() > held_from) farthest = std::max(farthest, std::abs(test.stress_top() / asked - 1));
    }
    EXPECT_TRUE(test.program().finished()) << held.what;
    EXPECT_LT(farthest, held.within) << held.what;
    EXPECT_LT(most, 1.05) << held.what;
    EXPECT_LT(residual(test), held.missing) << held.what;
    if (held.settings.platens.elastic) {
      EXPECT_GT(clamp_closure(test), test.closure_strain() * test.shape().height) << held.what;
    }
    const Quaternion &turn = test.top().body().rotation();
    EXPECT_EQ(turn.w != 1, held.settings.platens.spherical_seat) << held.what;
    if (held.settings.platens.spherical_seat) {
      EXPECT_GT(2 * std::hypot(turn.x, turn.y), 1e-6) << held.what;
    }
  }
}

} // namespace
} // namespace platen::coupling::elastic_loadings_test
