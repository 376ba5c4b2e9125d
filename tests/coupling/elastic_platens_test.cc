// Platens that yield: loads go through them, sheets on them, meshes of one's own.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "coupling/platen_test.h"
#include "fem/elastic_solid.h"
#include "tests/coupling/set_ups.h"

namespace platen::coupling {
namespace {

PlatenTestSettings between(ElasticMotion motion, double young) {
  PlatenTestSettings s = elastic(elastic_settings(0.5), motion, young);
  s.platens.damping = 0.1;
  s.platens.top = s.platens.bottom = {0.3, 0.2};
  s.platens.thickness = 4e-3;
  return s;
}

// With inertia or without, after some wave transits: what is left is the waves.
TEST(elastic_platens, explicit_and_quasi_static_ones_bear_alike) {
  double stress[2], closure[2];
  for (const bool still : {false, true}) {
    PlatenTestSettings settings =
        between(still ? ElasticMotion::quasi_static : ElasticMotion::explicit_steps, 20e9);
    settings.time_step.fixed_step = 4e-8;
    PlatenTest problem(cylinder(), settings);
    advance_to(problem, 5000);
    stress[still] = problem.stress_top();
    closure[still] = problem.closure_strain();
    EXPECT_LT(problem.closure_strain() * problem.shape().height, 0.999 * clamp_closure(problem));
    EXPECT_NEAR(problem.top().body().energy_balance().strain, problem.bottom().body().energy_balance().strain,
                0.5 * problem.top().body().energy_balance().strain);
    // Contacts, friction, bonds and platens in one energy balance.
    const dem::EnergyLedger energy = problem.energy();
    EXPECT_LT(std::abs(energy.residual() + energy.unbalanced), 1e-3 * energy.boundary) << still;
    EXPECT_GT(energy.bodies, 0.01 * energy.boundary);
  }
  EXPECT_NEAR(stress[1] / stress[0], 1, 0.01);
  EXPECT_NEAR(closure[1] / closure[0], 1, 0.01);
}

// 8 x 8 spheres, one in the middle of each element of the face: a uniform pressure. What the machine bears is
// the loads' sum, and so is the mean stress in any cut.
TEST(elastic_platens, a_layer_of_spheres_transmits_the_load) {
  constexpr int across = 8;
  constexpr double r = 1e-3;
  dem::Specimen layer;
  layer.shape = dem::box(across * 2 * r, across * 2 * r, 2 * r);
  for (int i = 0; i < across * across; ++i) {
    layer.centre.push_back({(2 * (i % across) - across + 1) * r, (2 * (i / across) - across + 1) * r, r});
    layer.radius.push_back(r);
  }
  PlatenTestSettings settings = between(ElasticMotion::quasi_static, steel);
  settings.model.bond.reset();
  settings.ends = Ends::as_packed;
  settings.platens.overhang = 1;
  settings.platens.thickness = 8e-3;
  settings.platens.elements_across = across;
  settings.loading.ramp = 2e-5;
  PlatenTest problem(layer, settings);
  advance_to(problem, 1000);
  for (fem::Body *body : {&problem.top().body(), &problem.bottom().body()}) {
    auto &solid = static_cast<fem::ElasticSolid &>(*body);
    const Vector3 load = solid.total_force();
    ASSERT_GT(std::abs(load[2]), 10);
    solid.aim(solid.contact_loads(), 0); // the shape under the loads of now
    const std::vector<Vector3> u = solid.deformation();
    std::vector<Vector3> force;
    fem::multiply(solid.model().stiffness, u, force);
    Vector3 reaction{};
    for (const int node : solid.clamped_nodes())
      reaction = reaction + force[static_cast<std::size_t>(node)];
    EXPECT_LT(norm(reaction + load), 1e-12 * norm(load)) << norm(reaction + load);
    double mean = 0;
    int cells = 0;
    const std::vector<fem::Stress> stress = cell_stress(solid.model(), solid.deformation());
    const double middle =
        (body == &problem.top().body() ? 2 * r : 0) + (body == &problem.top().body() ? 4e-3 : -4e-3);
    for (std::size_t c = 0; c < stress.size(); ++c) {
      double z = 0;
      for (std::size_t k = 0; k < 8; ++k)
        z += 0.125 * solid.model().nodes[static_cast<std::size_t>(solid.model().cell_nodes[8 * c + k])][2];
      if (std::abs(z - middle) > 1.5e-3) continue;
      mean += stress[c][2], ++cells;
    }
    ASSERT_GT(cells, 0);
    const double pressure = std::abs(load[2]) / (across * across * 4 * r * r);
    EXPECT_NEAR(-mean / cells, pressure, 0.01 * pressure);
  }
}

// Few spheres bear, never evenly: a platen that may not turn takes a moment from them, one on a seat turns
// away until little is left, and stays where it is led.
TEST(elastic_platens, a_spherical_seat_takes_no_moment) {
  for (const ElasticMotion motion : both_motions) {
    double arm[2]; // m, of the load about the seat, mean over the last steps
    for (const bool seat : {false, true}) {
      PlatenTestSettings settings = between(motion, steel);
      settings.platens.spherical_seat = seat;
      PlatenTest problem(cylinder(), settings);
      advance_to(problem, 2000);
      Vector3 moment{};
      double force = 0;
      for (int k = 0; k < 1000; ++k) {
        advance_to(problem, problem.steps() + 1);
        const Vector3 seat_now = Vector3{0, 0, problem.shape().height} + problem.top().body().displacement();
        moment = moment + problem.top().body().moment(seat_now);
        force += problem.top().body().total_force()[2];
      }
      arm[seat] = norm(Vector3{moment[0], moment[1], 0}) / force;
      EXPECT_LT(residual(problem), 2e-3);
      EXPECT_EQ(clamp_closure(problem) > 0, true);
      const double turned = problem.elastic_top()->solid().rotation().w;
      EXPECT_EQ(turned == 1, !seat);
    }
    EXPECT_LT(arm[1], 0.1 * arm[0]) << static_cast<int>(motion) << " " << arm[0] << " " << arm[1];
  }
}

PlatenTestSettings on_pads(ElasticMotion motion) {
  PlatenTestSettings settings = between(motion, steel);
  settings.platens.overhang = 1;
  settings.platens.elastic->pad_thickness = 1e-3;
  settings.platens.elastic->pad = {1200, 1e9, 0.3};
  return settings;
}

// A sheet between platen and specimen is in series: it takes p t (1 + nu)(1 - 2 nu) / (E (1 - nu)) of the
// closure where it cannot spread sideways, more where it can, and p t / E at most.
TEST(elastic_platens, a_pad_yields_by_its_thickness_over_its_modulus) {
  PlatenTest problem(cylinder(), on_pads(ElasticMotion::explicit_steps));
  advance_to(problem, 5000);
  const double pressure = 0.5 * (problem.stress_top() + problem.stress_bottom());
  ASSERT_GT(pressure, 1e5);
  const double yielded = 0.5 * (clamp_closure(problem) - problem.closure_strain() * problem.shape().height);
  const double most = pressure * 1e-3 / 1e9, least = most * (1 + 0.3) * (1 - 2 * 0.3) / (1 - 0.3);
  EXPECT_GT(yielded, least);
  EXPECT_LT(yielded, most);
  // Damped vibrations are .1 % of so small a work.
  EXPECT_LT(residual(problem), 2e-3);
}

// Softer than its contacts, and still at rest from solve to solve.
TEST(elastic_platens, a_soft_pad_without_inertia_does_not_oscillate) {
  PlatenTest problem(cylinder(), on_pads(ElasticMotion::quasi_static));
  advance_to(problem, 5000);
  const dem::EnergyLedger e = problem.energy();
  EXPECT_LT(std::abs(e.residual() + e.unbalanced), 1e-4 * e.boundary);
}

// What platens do not hold of the work on them is no loss: the balance misses it, and names it.
TEST(elastic_platens, work_that_platens_without_inertia_do_not_hold_stays_in_the_residual) {
  PlatenTestSettings settings = on_pads(ElasticMotion::quasi_static);
  settings.loading.rate = 5;
  PlatenTest late(cylinder(), settings);
  advance_to(late, 2000);
  const dem::EnergyLedger e = late.energy();
  EXPECT_GT(std::abs(e.unbalanced), 5e-3 * e.boundary);
  EXPECT_LT(std::abs(e.residual() + e.unbalanced), 1e-3 * e.boundary);
  PlatenTest prompt(cylinder(), on_pads(ElasticMotion::explicit_steps));
  advance_to(prompt, 500);
  EXPECT_EQ(prompt.energy().unbalanced, 0);
}

// The softer the sheet, the later it comes; with its inertia there is nothing to come late.
TEST(elastic_platens, sheets_without_inertia_say_how_late_they_come) {
  double last = 0;
  for (const double young : {20e9, 1e9, 50e6}) {
    PlatenTestSettings settings = on_pads(ElasticMotion::quasi_static);
    settings.platens.elastic->pad.young_modulus = young;
    const PlatenTest problem(cylinder(), settings);
    EXPECT_GT(problem.seconds_behind(), 4 * last);
    last = problem.seconds_behind();
  }
  EXPECT_EQ(PlatenTest(cylinder(), on_pads(ElasticMotion::explicit_steps)).seconds_behind(), 0);
}

// A grid of one's own that is the plate which would have been made presses as that does, wherever it lay:
// but for the last bits of its nodes' places, by which friction chooses among paths.
TEST(elastic_platens, a_given_mesh_of_the_same_plate_presses_alike) {
  for (const bool yields : {false, true}) {
    PlatenTestSettings settings = between(ElasticMotion::explicit_steps, steel);
    if (!yields) settings.platens.elastic.reset();
    PlatenTest plain(cylinder(), settings);
    const double radius = settings.platens.overhang * cylinder().shape.radius;
    const fem::Grid somewhere = fem::make_grid(
        fem::CylinderPlate{radius, settings.platens.thickness, 3, settings.platens.elements_across,
                           yields ? static_cast<int>(std::lround(settings.platens.elements_across *
                                                                 settings.platens.thickness / (2 * radius)))
                                  : 2});
    settings.platens.top.grid = settings.platens.bottom.grid = somewhere;
    PlatenTest given(cylinder(), settings);
    advance_to(plain, 600);
    advance_to(given, 600);
    ASSERT_GT(plain.stress_top(), 1e4);
    EXPECT_NEAR(given.stress_top() / plain.stress_top(), 1, 1e-4) << yields;
    EXPECT_NEAR(given.stress_bottom() / plain.stress_bottom(), 1, 1e-4) << yields;
    EXPECT_NEAR(given.closure_strain() / plain.closure_strain(), 1, 1e-4) << yields;
  }
}

TEST(elastic_platens, a_mesh_that_cannot_be_held_is_refused_by_name) {
  PlatenTestSettings settings = between(ElasticMotion::explicit_steps, steel);
  const fem::Grid plate = fem::make_grid(fem::CylinderPlate{5e-3, 4e-3, 0, 4, 2});
  settings.platens.top.grid = fem::moved_grid(plate, [](const Vector3 &p) {
    return Vector3{p[0], p[1], p[2] * (1 + 20 * p[0])}; // its upper side slants
  });
  expect_refused(cylinder(), settings, "platens.top.grid", "nothing to hold");
}

TEST(elastic_platens, and_those_on_seats_are_not_carried_to_a_start) {
  for (const PlatenKind &kind : {yielding, on_seat}) {
    PlatenTest problem(cylinder(), with(elastic_settings(0.5), kind));
    EXPECT_THROW(problem.carry({}, {}, {{0, 0, 1e-6}, {0, 0, -1e-6}}), std::logic_error) << kind.name;
  }
}

} // namespace
} // namespace platen::coupling
