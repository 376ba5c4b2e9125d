// Platens that yield: loads go through them, sheets on them, layers that they are made of, meshes of one's
// own.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "coupling/platen_layers.h"
#include "coupling/platens_of_test.h"
#include "fem/grids.h"
#include "tests/coupling/set_ups.h"
#include "tests/same_state.h"

namespace platen::coupling::elastic_platens_test {
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
  PlatenTestSettings settings = between(ElasticMotion::quasi_static, steel_modulus);
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
    solid.solve_for(solid.contact_loads(), 0); // the shape under the loads of now
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

// Under a specimen that is far stronger: its stress is held by the platens, and most of the work is lost in
// them.
TEST(elastic_platens, of_metal_yield_and_the_ledger_has_their_work) {
  double stress[2];
  for (const bool metal : {false, true}) {
    PlatenTestSettings settings = between(ElasticMotion::explicit_steps, 70e9);
    settings.loading.rate = 1;
    if (metal) settings.platens.elastic->metal.emplace().yield_strength = 10e6;
    PlatenTest problem(cylinder(), settings);
    while (clamp_closure(problem) < 6e-5)
      advance_to(problem, problem.steps() + 100);
    stress[metal] = problem.stress_top();
    const dem::EnergyLedger energy = problem.energy();
    EXPECT_LT(std::abs(energy.residual()), 1e-3 * energy.boundary) << metal;
    EXPECT_EQ(problem.platens_yield(), metal);
    EXPECT_EQ(energy.plastic, problem.platen_plastic_work());
    EXPECT_EQ(energy.plastic > 0.3 * energy.boundary, metal);
    EXPECT_EQ(problem.platen_plastic_strain() > 1e-3, metal);
  }
  EXPECT_LT(stress[1], 0.6 * stress[0]);
}

PlatenTestSettings on_pads(ElasticMotion motion) {
  PlatenTestSettings settings = between(motion, steel_modulus);
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

TEST(elastic_platens, a_mesh_that_cannot_be_held_is_refused_by_name) {
  PlatenTestSettings settings = between(ElasticMotion::explicit_steps, steel_modulus);
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

constexpr fem::Material plain{7850, 210e9, 0.3}, rubber{1100, 5e6, 0.45}, lead{11300, 16e9, 0.44};

PlatenTestSettings layered(double thickness) {
  PlatenTestSettings s = elastic_settings(0.5);
  s.platens.thickness = thickness;
  s.platens.material = plain;
  s.platens.elastic = ElasticPlatens{};
  return s;
}

TEST(platen_layers, begin_at_the_specimen_and_leave_the_rest_to_the_platen) {
  PlatenSettings p = layered(10e-3).platens;
  p.elastic->layers = {{1e-3, rubber}, {2e-3, lead}};
  for (const Side side : {Side::top, Side::bottom}) {
    const std::vector<PlatenLayer> layers = layers_of(p, side);
    ASSERT_EQ(layers.size(), 3u);
    EXPECT_EQ(layers[0].material.density, rubber.density);
    EXPECT_EQ(layers[1].material.density, lead.density);
    EXPECT_EQ(layers[2].material.density, plain.density);
    EXPECT_NEAR(layers[2].thickness, 7e-3, 1e-17);
    const std::vector<fem::Material> upwards = materials_of(p, side);
    EXPECT_EQ(upwards.front().density, side == Side::top ? rubber.density : plain.density);
    EXPECT_EQ(upwards.back().density, side == Side::top ? plain.density : rubber.density);
    const std::vector<fem::Layer> elements = elements_of_layers(p, side, 10e-3);
    EXPECT_EQ(side == Side::top ? elements.front().thickness : elements.back().thickness, 1e-3);
  }
  p.bottom.layers = {{4e-3, lead}};
  p.bottom.thickness = 4e-3;
  EXPECT_EQ(layers_of(p, Side::bottom).size(), 1u);
  EXPECT_EQ(thickness_of(p, Side::bottom), 4e-3);
  EXPECT_EQ(thickness_of(p, Side::top), 10e-3);
  EXPECT_EQ(layers_of(p, Side::top).size(), 3u);
  // Thicknesses that add up but for round-off leave nothing.
  p.elastic->layers = {{0.1 * 10e-3, rubber}, {0.7 * 10e-3, lead}, {0.2 * 10e-3, rubber}};
  EXPECT_EQ(layers_of(p, Side::top).size(), 3u);
}

TEST(platen_layers, yield_where_they_are_of_the_platens_own_material) {
  PlatenSettings p = layered(10e-3).platens;
  const auto yielding = [&](Side side) {
    std::vector<bool> all;
    for (const fem::Material &material : materials_of(p, side))
      all.push_back(material.hardening.has_value());
    return all;
  };
  using Which = std::vector<bool>;
  EXPECT_EQ(yielding(Side::top), Which{false});
  p.elastic->metal.emplace().yield_strength = 40e6;
  p.elastic->metal->saturation = 30e6, p.elastic->metal->saturation_rate = 20;
  EXPECT_EQ(yielding(Side::top), Which{true});
  const fem::Hardening hardening = *materials_of(p, Side::top)[0].hardening;
  EXPECT_EQ(hardening.yield_strength(), 40e6);
  EXPECT_EQ(hardening.saturation, 30e6);
  EXPECT_EQ(hardening.rate, 20);
  p.elastic->pad_thickness = 1e-3, p.elastic->pad = rubber;
  EXPECT_EQ(yielding(Side::top), (Which{false, true}));
  p.elastic->pad_thickness = 0;
  p.elastic->layers = {{1e-3, rubber}, {2e-3, lead, true}, {3e-3, lead}};
  EXPECT_EQ(yielding(Side::top), (Which{false, true, false, true}));
  EXPECT_EQ(yielding(Side::bottom), (Which{true, false, true, false}));
  EXPECT_EQ(materials_of(p, Side::top)[1].density, plain.density);
}

// Of elastic platens by the nodes of degree 1 that were made: planes of one more node than layers.
TEST(platen_layers, elements_are_counted_as_they_are_made) {
  for (const int across : {4, 9, 16}) {
    PlatenTestSettings s = layered(6e-3);
    s.platens.elastic->degree = 1;
    s.platens.elements_across = across;
    for (const bool layered : {false, true}) {
      if (layered) s.platens.elastic->layers = {{1e-3, lead}};
      const PlatenTest problem(cylinder(), s);
      const double half = s.platens.overhang * problem.shape().radius;
      double through = 0;
      for (const fem::Layer &layer : elements_of_layers(s.platens, Side::top, half))
        through += layer.elements;
      const double cells = cells_of_platen(problem.shape(), s, Side::top), in_plane = cells / through,
                   nodes = static_cast<double>(problem.elastic_top()->solid().model().nodes.size());
      const double on_the_rim = across - across / 4 * 2; // a quarter of the nodes there
      EXPECT_EQ((in_plane + 2 * on_the_rim + 1) * (through + 1), nodes) << across; // Euler: of a disc
    }
    s.platens.elastic.reset();
    EXPECT_EQ(cells_of_platen(cylinder().shape, s, Side::bottom), 2 * fem::cells_in({1, 1, 0, across, 1}));
  }
}

TEST(platen_layers, that_cannot_be_are_refused_by_name) {
  PlatenTestSettings s = layered(4e-3);
  const auto expect_layers_refused = [&](const std::vector<PlatenLayer> &layers, const std::string &member,
                                         const std::string &word) {
    s.platens.elastic->layers = layers;
    expect_refused(cylinder(), s, member, word);
  };
  expect_layers_refused({{1e-3, rubber}, {3.1e-3, lead}}, "platens.elastic.layers",
                        "is 0.0041 m thick. Allowed: up to 0.004 m");
  expect_layers_refused({{1e-3, rubber}, {0, lead}}, "platens.elastic.layers", "has a layer of no thickness");
  s.platens.top.layers = {{5e-3, lead}};
  expect_layers_refused({}, "platens.top.layers", "is 0.005 m thick");
  s.platens.top.layers.clear();
  s.platens.elastic->layers = {{1e-3, {1100, 5e6, 0.5}}};
  EXPECT_NE(refusal(cylinder(), s).find("Poisson ratio"), std::string::npos);
}

// Without Poisson's ratio an even traction shortens layers by p sum t / E, the same everywhere on the face.
// So by Betti any loads move the mean of the face by their sum times sum t / (E A), exactly.
TEST(platen_layers, yield_as_springs_in_series) {
  constexpr double side = 12e-3, thickness = 8e-3;
  for (const ElasticPlatens &with :
       {ElasticPlatens{}, [] {
          ElasticPlatens p;
          p.layers = {{1e-3, {1100, 5e6, 0}}, {2e-3, {2700, 70e9, 0}}, {0.5e-3, {2200, 0.5e9, 0}}};
          return p;
        }()}) {
    PlatenSettings p = layered(thickness).platens;
    p.elastic = with;
    p.elastic->motion = fem::ElasticMotion::quasi_static;
    p.material.poisson_ratio = 0;
    double flexibility = 0; // m/N
    for (const PlatenLayer &layer : layers_of(p, Side::top))
      flexibility += layer.thickness / (layer.material.young_modulus * side * side);
    const fem::BoxPlate plate{{0, 0, 0}, {side, side, thickness}, {4, 4, 1}};
    fem::ElasticOptions options;
    options.motion = p.elastic->motion;
    fem::ElasticSolid solid(fem::make_grid(plate, elements_of_layers(p, Side::top, 0.5 * side)),
                            materials_of(p, Side::top), fem::Clamp{}, options);
    std::vector<Vector3> loads(solid.surface().vertices.size());
    std::vector<double> weights(loads.size(), 0.0);
    double sum = 0;
    for (std::size_t f = 0; f < solid.surface().faces.size(); ++f)
      if (solid.surface().face_tags[f] == fem::low_end_tag)
        for (const int v : solid.surface().faces[f])
          weights[static_cast<std::size_t>(v)] += 0.25 / 16;
    for (std::size_t v = 0; v < loads.size(); ++v) {
      if (weights[v] == 0) continue;
      loads[v].z = 10 + 2000 * solid.surface().vertices[v].x;
      sum += loads[v].z;
    }
    const std::vector<Vector3> before = solid.surface().vertices;
    solid.solve_for(loads, 0);
    double mean = 0;
    for (std::size_t v = 0; v < loads.size(); ++v)
      mean += weights[v] * (solid.surface().vertices[v].z - before[v].z);
    EXPECT_NEAR(mean, sum * flexibility, 1e-8 * mean);
  }
}

// A pad is one more way to say two layers, to the last bit.
TEST(platen_layers, a_pad_is_two_layers) {
  for (const int degree : {1, 2}) {
    PlatenTestSettings pad = layered(4e-3), layers = pad;
    pad.platens.elastic->degree = layers.platens.elastic->degree = degree;
    pad.platens.elastic->pad_thickness = 1e-3;
    pad.platens.elastic->pad = {1200, 1e9, 0.3};
    layers.platens.elastic->layers = {{1e-3, {1200, 1e9, 0.3}}, {3e-3, plain}};
    PlatenTest one(cylinder(), pad), other(cylinder(), layers);
    one.advance(200), other.advance(200);
    EXPECT_TRUE(same_state(one, other)) << degree;
  }
}

// A grid of one's own that is the plate which would have been made presses as that does, wherever it lay, but
// for the last bits of its nodes' places, by which friction chooses among paths. Physical volumes are the
// layers in their order, of which the names alone count.
TEST(platen_layers, a_given_mesh_of_the_same_plate_presses_alike) {
  const fem::Material hard{1200, 1e9, 0.3};
  PlatenTestSettings rigid = layered(4e-3), yields = rigid, of_layers = rigid;
  rigid.platens.elastic.reset();
  of_layers.platens.elastic->layers = {{1e-3, hard}, {1e-3, lead}, {2e-3, plain}};
  const double radius = rigid.platens.overhang * cylinder().shape.radius;
  for (const PlatenTestSettings &made : {rigid, yields, of_layers}) {
    PlatenTestSettings given = made;
    const bool has_layers = made.platens.elastic && !made.platens.elastic->layers.empty();
    const fem::CylinderPlate plate{radius, 4e-3, has_layers ? 14e-3 : 3, made.platens.elements_across, 2};
    // Material 0 at the low end, which faces the specimen.
    given.platens.top.grid = made.platens.elastic
                                 ? fem::make_grid(plate, elements_of_layers(made.platens, Side::top, radius))
                                 : fem::make_grid(plate);
    if (has_layers)
      given.platens.top.layers = {{0, hard}, {0, lead}, {0, plain}};
    else
      given.platens.bottom.grid = given.platens.top.grid;
    PlatenTest one(cylinder(), made), other(cylinder(), given);
    advance_to(one, 1500), advance_to(other, 1500);
    ASSERT_GT(one.stress_top(), 1e4);
    EXPECT_NEAR(other.stress_top() / one.stress_top(), 1, has_layers ? 1e-6 : 1e-4);
    EXPECT_NEAR(other.stress_bottom() / one.stress_bottom(), 1, 1e-4);
    EXPECT_NEAR(other.closure_strain() / one.closure_strain(), 1, 1e-4);
    EXPECT_NEAR(one.top().body().mass(), other.top().body().mass(), 1e-9 * one.top().body().mass());
    if (!has_layers) continue;
    EXPECT_EQ(one.top().body().mass(), other.top().body().mass());
    given.platens.top.layers.pop_back();
    expect_refused(cylinder(), given, "platens.top.grid",
                   "has 3 physical volumes: there are 2 layers in `platens.top.layers`");
    given.platens.top.layers.clear(), given.platens.elastic->layers.clear();
    expect_refused(cylinder(), given, "platens.top.grid", "the second needs `platens.elastic.pad_modulus`");
  }
}

} // namespace
} // namespace platen::coupling::elastic_platens_test
