// A tube of metal around a bonded cylinder, which confines it because it is pressed by it.
#include <gtest/gtest.h>

#include <cmath>

#include "base/pi.h"
#include "coupling/faults.h"
#include "dem/measure/gauge.h"
#include "tests/coupling/set_ups.h"
#include "tests/same_state.h"

namespace platen::coupling::tube_test {
namespace {

PlatenTestSettings lubricated() {
  PlatenTestSettings s = elastic_settings(0.5);
  s.ends = Ends::ground;
  s.model.local_damping = 0.3;
  s.platens.top = s.platens.bottom = {0.0, 0.0};
  s.loading.rate = 0.1;
  return s;
}

SleeveSettings tube_of(double thickness, double young_modulus, double yield_strength) {
  SleeveSettings tube;
  tube.thickness = thickness;
  tube.young_modulus = young_modulus, tube.poisson_ratio = 0.3, tube.density = 7850;
  tube.metal.emplace().yield_strength = yield_strength;
  tube.bonded_rims = false;
  tube.elements_around = 16, tube.elements_through = 2;
  tube.mass_scaling = 1; // these tests are fast: inertia would confine
  tube.contact.friction_static = 0;
  tube.mass_damping = 100;
  return tube;
}

struct Answer {
  double stress = 0, load = 0; // Pa, N
  dem::GaugeStrain strain;
};

Answer pressed(PlatenTest &test, double closure) {
  const dem::Gauge gauge(test.model.particles, test.shape(), test.model.bonds.get());
  while (test.closure_strain() < closure)
    test.step();
  return {mean_stress(test), test.tube() != nullptr ? test.tube_load() : 0,
          gauge.strain(test.model.particles)};
}

TEST(tube, a_rigid_one_gives_the_constrained_modulus) {
  PlatenTestSettings walled = lubricated(), tubed = walled;
  walled.loading.wall = true;
  walled.loading.wall_stiffness = 10, walled.loading.wall_layer = 1;
  tubed.loading.tube = tube_of(4e-3, 1e13, 1e12);
  tubed.loading.tube->stiffness = 10, tubed.loading.tube->seat_layer = 1;
  tubed.loading.tube->clearance = 1e-3; // so that it bears nothing along the axis
  PlatenTest wall(packed_cylinder(), walled), tube(packed_cylinder(), tubed);
  const Answer a = pressed(wall, 2e-4), b = pressed(tube, 2e-4);
  EXPECT_NEAR(b.stress / b.strain.axial / (a.stress / a.strain.axial), 1, 0.01);
  EXPECT_LT(std::abs(b.strain.lateral()), 0.03 * std::abs(b.strain.axial));
}

TEST(tube, one_of_vanishing_thickness_is_none) {
  PlatenTestSettings bare = lubricated(), tubed = bare;
  tubed.loading.tube = tube_of(1e-4, 210e9, 1e5);
  PlatenTest none(packed_cylinder(), bare), thin(packed_cylinder(), tubed);
  const Answer a = pressed(none, 2e-4), b = pressed(thin, 2e-4);
  EXPECT_NEAR(b.stress / a.stress, 1, 2e-3);
  EXPECT_NEAR(b.strain.lateral() / a.strain.lateral(), 1, 0.01);
  EXPECT_LT(std::abs(b.load), 1e-3 * a.stress * none.nominal_area());
  EXPECT_EQ(none.tube(), nullptr);
  EXPECT_TRUE(std::isnan(none.tube_load()));
}

// Of its section alone: what concrete and tube bear together is the sum of both.
TEST(tube, platens_press_an_empty_section_to_its_yield) {
  PlatenTestSettings tubed = lubricated();
  tubed.loading.tube = tube_of(1e-3, 210e9, 50e6);
  tubed.loading.tube->gap = 1e-3; // the specimen does not reach it
  PlatenTest test(packed_cylinder(), tubed);
  const Answer now = pressed(test, 1e-3);
  const double a = test.shape().radius + 1e-3, section = pi * ((a + 1e-3) * (a + 1e-3) - a * a);
  EXPECT_NEAR(now.load / (50e6 * section), 1, 0.02); // its section is a polygon
  const Sleeve::WallState wall = test.tube()->wall_state();
  EXPECT_NEAR(wall.axial / 50e6, 1, 0.01);
  EXPECT_LT(std::abs(wall.hoop), 0.01 * 50e6);
  EXPECT_NEAR(wall.force / now.load, 1, 0.01);
  EXPECT_EQ(wall.yielded, 1);
  EXPECT_EQ(test.tube()->specimen_pressure(), 0);
  EXPECT_LT(std::abs(test.energy().residual()), 1e-3 * test.energy().boundary);
  EXPECT_GT(test.energy().plastic, 0.5 * 50e6 * section * test.shape().height * 0.7e-3);
}

// Loaded on the specimen alone and without friction: a ring that bears p R / t.
TEST(tube, a_greased_one_beside_the_load_is_a_ring) {
  PlatenTestSettings tubed = lubricated();
  tubed.loading.tube = tube_of(1e-3, 210e9, 5e6);
  tubed.loading.tube->clearance = 1e-3;
  tubed.loading.tube->seat_layer = 1;
  PlatenTest test(packed_cylinder(), tubed);
  pressed(test, 1.5e-3);
  const Sleeve::WallState wall = test.tube()->wall_state();
  EXPECT_EQ(test.tube_load(), 0);
  EXPECT_LT(std::abs(wall.axial), 0.01 * 5e6);
  EXPECT_GT(wall.yielded, 0.9);
  // The radial stress takes a quarter of the pressure, and faces between corners bend.
  EXPECT_NEAR(wall.hoop / 5e6, 1, 0.06);
  EXPECT_NEAR(test.tube()->specimen_pressure() * (test.shape().radius + 0.5e-3) / (wall.hoop * 1e-3), 1,
              0.05);
  EXPECT_GT(wall.bulge, 0);
  EXPECT_LT(std::abs(test.energy().residual()), 1e-3 * test.energy().boundary);
}

TEST(tube, friction_loads_it_along_the_axis) {
  double axial[2];
  for (const int rough : {0, 1}) {
    PlatenTestSettings tubed = lubricated();
    tubed.loading.tube = tube_of(1e-3, 210e9, 1e9);
    tubed.loading.tube->clearance = 1e-3;
    tubed.loading.tube->contact.friction_static = 0.6 * rough;
    PlatenTest test(packed_cylinder(), tubed);
    pressed(test, 1e-3);
    axial[rough] = test.tube()->wall_state().axial;
    const double way = 0.5 * 1e-3 * test.shape().height; // m, of a platen
    EXPECT_EQ(test.tube()->slip() > 0.01 * way, rough == 1);
    EXPECT_LT(test.tube()->slip(), way);
  }
  EXPECT_LT(std::abs(axial[0]), 0.05 * axial[1]);
  EXPECT_GT(axial[1], 0);
}

// Layers of elements around a specimen that does not matter.
struct Wall {
  dem::Model model{coarse_cylinder(), lubricated().model};
  double height = coarse_cylinder().shape.height;
  Sleeve sleeve;

  Wall(double yield_strength, int layers)
      : sleeve(model.particles, coarse_cylinder().shape, 0, height, settings(yield_strength, layers)) {}
  static SleeveSettings settings(double yield_strength, int layers) {
    SleeveSettings tube = tube_of(1e-3, 210e9, yield_strength);
    tube.metal->ultimate_strength = 1.25 * yield_strength;
    tube.elements_along = layers;
    tube.contact.particle_stiffness = 1e6, tube.contact.skin = 3e-4;
    return tube;
  }
  template <class Field>
  void move(const Field &field) {
    std::vector<Vector3> all;
    for (const Vector3 &x : sleeve.solid().mesh().nodes)
      all.push_back(field(x));
    sleeve.solid().set_displacement(all);
  }
};

TEST(tube, its_wall_tells_of_the_middle_half_alone) {
  Wall wall(1e6, 8);
  wall.move([&](const Vector3 &x) { // strains the second layer from each end, in which yielding is found
    const double z = x.z / wall.height - 0.5;
    return Vector3{0, 0, z > 0.37 ? 1e-5 : z < -0.37 ? -1e-5 : 0};
  });
  const Sleeve::WallState state = wall.sleeve.wall_state();
  EXPECT_LT(std::abs(state.axial) + std::abs(state.hoop), 1);
  EXPECT_LT(std::abs(state.force), 1e-4);
  EXPECT_EQ(state.yielded, 0.25);
  EXPECT_GT(state.plastic_strain, 0);
}

// Widened alike everywhere and not along the axis: hoop = E w/((1 + nu)(1 - 2 nu)), along the axis 2 nu of
// it.
TEST(tube, a_wall_that_is_widened_bears_what_hooke_says) {
  Wall wall(400e6, 5);
  const double wide = 1e-6;
  wall.move([&](const Vector3 &x) { return wide * Vector3{x.x, x.y, 0}; });
  const Sleeve::WallState state = wall.sleeve.wall_state();
  const double hoop = 210e9 * wide / (1.3 * 0.4);
  EXPECT_NEAR(state.hoop / hoop, 1, 1e-4);
  EXPECT_NEAR(state.axial / (-2 * 0.3 * hoop), 1, 1e-4);
  const double section = (1 + wide) * (1 + wide) * wall.sleeve.solid().volume() / wall.height;
  EXPECT_NEAR(state.force / (state.axial * section), 1, 1e-8);
  const double outer = (coarse_cylinder().shape.radius) / std::cos(pi / 16) + 1e-3;
  EXPECT_NEAR(state.bulge / (wide * outer), 1, 1e-6);
  EXPECT_EQ(state.yielded, 0);
  EXPECT_NEAR(wall.sleeve.solid().material().hardening->points[1].strain,
              std::log(1.025) - 1.025 * 400e6 / 210e9, 1e-9);
}

TEST(tube, hardens_as_its_settings_say) {
  const auto at = [](double strain, const auto &change) {
    MetalSettings metal;
    metal.yield_strength = 400e6;
    change(metal);
    return metal.hardening(210e9).at(strain).stress;
  };
  using M = MetalSettings;
  EXPECT_EQ(at(0.5, [](M &) {}), 400e6);
  EXPECT_NEAR(at(0.1, [](M &m) { m.saturation = 50e6, m.saturation_rate = 20; }),
              400e6 + 50e6 * (1 - std::exp(-2.0)), 1);
  EXPECT_NEAR(at(0.05, [](M &m) { m.points = {{0.1, 440e6}}; }), 420e6, 1);
  EXPECT_NEAR(at(0.5, [](M &m) { m.ultimate_strength = 500e6; }), 560e6, 1); // true stress at e_u = .12
  const auto many = [](std::size_t count) {
    return [count](M &m) {
      for (std::size_t k = 1; k <= count; ++k)
        m.points.push_back({0.01 * static_cast<double>(k), 400e6});
    };
  };
  EXPECT_EQ(at(0.5, many(31)), 400e6);
  const auto refused = [&](const char *says, const auto &change) {
    try {
      at(0, change);
      FAIL() << says;
    } catch (const std::invalid_argument &wrong) {
      EXPECT_STREQ(wrong.what(), says);
    }
  };
  refused("metal: at most 31 points after the yield strength", many(32));
  refused("metal: its ultimate strength is below its yield strength",
          [](M &m) { m.ultimate_strength = 399e6; });
  refused("metal: an ultimate strength or points, not both", [](M &m) {
    m.ultimate_strength = 500e6, m.points = {{0.5, 600e6}};
  });
  refused("metal: its yield strength must be positive", [](M &m) { m.yield_strength = not_given; });
}

// Its mass is made such that it is stepped once in four steps, however thin its elements are.
TEST(tube, one_that_nothing_touches_is_stepped_once_in_four_steps) {
  PlatenTestSettings tubed = lubricated();
  SleeveSettings &tube = tubed.loading.tube.emplace(tube_of(1e-3, 210e9, 50e6));
  tube.mass_scaling = 0, tube.gap = 1e-4, tube.seat_layer = 0;
  PlatenTest test(coarse_cylinder(), tubed);
  EXPECT_GT(test.tube()->mass_scaling(), 1);
  EXPECT_NEAR(test.tube()->known_limit() * tube.safety / test.time_step(), 4, 0.05);
}

TEST(tube, a_gap_has_to_close_before_it_confines) {
  double widened[2]; // m, at the same pressure
  for (const int gaps : {1, 2}) {
    PlatenTestSettings tubed = lubricated();
    tubed.loading.tube = tube_of(1e-3, 210e9, 1e9);
    tubed.loading.tube->gap = gaps * 1e-6;
    tubed.loading.tube->clearance = 1e-3;
    PlatenTest test(packed_cylinder(), tubed);
    const dem::Gauge gauge(test.model.particles, test.shape(), test.model.bonds.get());
    while (test.tube()->specimen_pressure() < 3e5 && test.closure_strain() < 5e-3)
      test.advance(4);
    widened[gaps - 1] = gauge.strain(test.model.particles).lateral() * test.shape().radius;
  }
  EXPECT_NEAR((widened[1] - widened[0]) / 1e-6, 1, 0.1);
}

TEST(tube, seats_spheres_across_its_gap) {
  int seats[2];
  for (const int gap : {0, 1}) {
    PlatenTestSettings tubed = lubricated();
    tubed.loading.tube = tube_of(1e-3, 210e9, 1e9);
    tubed.loading.tube->seat_layer = 0.2;
    tubed.loading.tube->gap = 0.5e-3 * gap; // more than the layer is deep
    PlatenTest test(coarse_cylinder(), tubed);
    seats[gap] = test.tube()->layer().seats();
  }
  EXPECT_GT(seats[0], 10);
  EXPECT_NEAR(seats[1], seats[0], 0.1 * seats[0]);
}

TEST(tube, a_platen_that_comes_to_the_end_of_a_free_tube_stops_the_run) {
  PlatenTestSettings tubed = lubricated();
  tubed.loading.tube = tube_of(1e-3, 210e9, 1e9);
  tubed.loading.tube->clearance = 2e-6;
  PlatenTest test(packed_cylinder(), tubed);
  try {
    pressed(test, 1e-3);
    FAIL() << "the platen went through the tube";
  } catch (const NumericsStopped &stopped) {
    EXPECT_NE(std::string(stopped.what()).find("`sleeve.clearance`"), std::string::npos) << stopped.what();
  }
  EXPECT_NEAR(test.closure_strain() * test.shape().height / 4e-6, 1, 0.1); // the tube moves a little
}

TEST(tube, each_of_its_free_ends_is_looked_at) {
  for (const double sense : {-1.0, 1.0}) {
    PlatenTestSettings tubed = lubricated();
    tubed.loading.tube = tube_of(1e-3, 210e9, 1e9);
    tubed.loading.tube->clearance = 4e-6;
    PlatenTest test(packed_cylinder(), tubed);
    fem::HyperelasticSolid &solid = test.sleeve()->solid();
    EXPECT_NEAR(solid.mesh().nodes[static_cast<std::size_t>(solid.nodes_of(fem::low_end_tag)[0])].z, 4e-6,
                1e-9);
    EXPECT_NEAR(test.shape().height -
                    solid.mesh().nodes[static_cast<std::size_t>(solid.nodes_of(fem::high_end_tag)[0])].z,
                4e-6, 1e-9);
    // Moved towards one platen.
    solid.set_displacement(std::vector<Vector3>(solid.mesh().nodes.size(), {0, 0, 3e-6 * sense}));
    EXPECT_THROW(pressed(test, 1e-3), NumericsStopped);
    EXPECT_NEAR(test.closure_strain() * test.shape().height / 2e-6, 1, 0.2) << sense;
  }
}

TEST(tube, what_cannot_be_one_is_refused) {
  const auto refused = [](const char *member, const auto &change) {
    PlatenTestSettings s = lubricated();
    s.loading.tube = tube_of(1e-3, 210e9, 250e6);
    change(s, *s.loading.tube);
    try {
      PlatenTest test(coarse_cylinder(), s);
      FAIL() << member;
    } catch (const BadSetup &bad) {
      EXPECT_EQ(bad.member(), member) << bad.what();
    }
  };
  using S = PlatenTestSettings;
  using T = SleeveSettings;
  refused("sleeve.thickness", [](S &, T &t) { t.thickness = 7e-3; });
  refused("sleeve.clearance", [](S &, T &t) { t.clearance = 4e-3; });
  refused("sleeve.gap", [](S &, T &t) { t.gap = 1e-3; });
  refused("loading.cell", [](S &s, T &) { press(s, 1e6); });
  refused("loading.wall", [](S &s, T &) { s.loading.wall = true; });
  refused("sleeve.metal.yield_strength", [](S &, T &t) { t.metal->yield_strength = not_given; });
  refused("sleeve.metal.ultimate_strength", [](S &, T &t) { t.metal->ultimate_strength = 200e6; });
  refused("sleeve.metal.ultimate_strength", [](S &, T &t) {
    t.metal->ultimate_strength = 300e6, t.metal->points = {{0.1, 300e6}};
  });
  refused("sleeve.metal.saturation_rate", [](S &, T &t) { t.metal->saturation = 1e6; });
  refused("sleeve.metal.saturation_rate", [](S &, T &t) { t.metal->saturation_rate = 10; });
  refused("sleeve.thickness", [](S &, T &t) { t.thickness = 6.01e-3; });
  refused("sleeve.clearance", [](S &, T &t) { t.clearance = 3.01e-3; });
  refused("sleeve.gap", [](S &, T &t) { t.gap = 0.601e-3; });
  refused("sleeve.elements_around", [](S &, T &t) { t.elements_around = 7; });
  refused("sleeve.metal.yield_strength", [](S &, T &t) { t.young_modulus = 2.49e9; });
  refused("sleeve.young_modulus",
          [](S &, T &t) { t.metal->ultimate_strength = 360e6, t.young_modulus = 24.9e9; });
  refused("loading.tension", [](S &s, T &) { s.loading.tension = s.platens.glued = true; });
  PlatenTestSettings most = lubricated();
  SleeveSettings &tube = most.loading.tube.emplace(tube_of(5.99e-3, 210e9, 250e6));
  tube.clearance = 2.99e-3, tube.gap = 0.599e-3, tube.metal->ultimate_strength = 360e6;
  tube.young_modulus = 25.1e9;
  EXPECT_NO_THROW(tube.metal->hardening(tube.young_modulus));
  EXPECT_EQ(faults(most, &coarse_cylinder().shape).size(), 0u);
}

} // namespace
} // namespace platen::coupling::tube_test
