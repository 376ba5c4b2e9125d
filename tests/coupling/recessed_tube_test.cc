// A tube whose specimen ends short of the platens: they load the steel alone, and what holds the specimen in
// it loads the specimen.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "base/pi.h"
#include "coupling/faults.h"
#include "dem/measure/stress.h"
#include "tests/coupling/set_ups.h"

namespace platen::coupling::recessed_tube_test {
namespace {

PlatenTestSettings recessed(double recess, double friction = 0) {
  PlatenTestSettings s = elastic_settings(0.5);
  s.model.local_damping = 0.3;
  s.platens.top = s.platens.bottom = {0.0, 0.0};
  s.loading.rate = 0.1;
  SleeveSettings &tube = s.loading.tube.emplace();
  tube.thickness = 1e-3;
  tube.young_modulus = 210e9, tube.poisson_ratio = 0.3, tube.density = 7850;
  tube.metal.emplace().yield_strength = 50e6;
  tube.bonded_rims = false;
  tube.elements_around = 16, tube.elements_through = 2;
  tube.mass_scaling = 1, tube.mass_damping = 100; // inertia would confine
  tube.contact.friction_static = friction;
  tube.recess = recess;
  return s;
}

void close(PlatenTest &test, double closure) { // m
  while (test.closure_strain() * test.shape().height < closure)
    test.step();
}

double section_of(const PlatenTest &test) { // m^2
  const std::vector<Vector3> &nodes = test.tube()->solid().mesh().nodes;
  double low = 1, high = -1;
  for (const Vector3 &x : nodes)
    low = std::min(low, x.z), high = std::max(high, x.z);
  EXPECT_NEAR(low, -test.settings().loading.tube->recess, 1e-12);
  return test.tube()->solid().volume() / (high - low);
}

TEST(recessed_tube, is_loaded_alone_as_its_section_says) {
  const double recess = 0.5e-3;
  PlatenTest test(packed_cylinder(), recessed(recess));
  const double length = test.shape().height + 2 * recess, section = section_of(test);
  EXPECT_NEAR(section / (2 * pi * 11.5e-3 * 1e-3), 1, 0.02); // its section is a polygon
  for (const double strain : {1e-4, 2e-4}) {
    close(test, strain * length);
    const double closed = test.closure_strain() * test.shape().height / length;
    EXPECT_NEAR(test.tube_load() / (210e9 * closed * section), 1, 3e-3);
    EXPECT_EQ(test.stress_top(), 0);
    EXPECT_EQ(test.stress_bottom(), 0);
    EXPECT_EQ(test.tube()->specimen_pressure(), 0);
  }
  close(test, 1e-3 * length);
  EXPECT_NEAR(test.tube_load() / (50e6 * section), 1, 0.01);
  EXPECT_EQ(test.stress_top(), 0);
  EXPECT_LT(test.model.bond_totals().force, 1e-5); // N: nor has the specimen felt anything
  EXPECT_LT(std::abs(test.energy().residual()), 1e-3 * test.energy().boundary);
}

// N along the axis, compression positive, within [low, high] (m): of the wall by its elements, of the
// specimen by the springs of its bonds. Neither reads a contact of the tube.
double in_wall(const PlatenTest &test, double low, double high) {
  const fem::HyperelasticSolid &solid = test.tube()->solid();
  const std::vector<fem::CellStress> stresses = solid.cell_stresses();
  double sum = 0; // N m
  for (std::size_t c = 0; c < stresses.size(); ++c) {
    double z = 0;
    for (const Vector3 &corner : solid.mesh().gather(c, solid.mesh().nodes))
      z += 0.125 * corner.z;
    if (z > low && z < high) sum -= solid.mesh().cells[c].volume * stresses[c].cauchy[8];
  }
  return sum / (high - low);
}
double in_specimen(const PlatenTest &test, double low, double high) {
  const dem::Particles &p = test.model.particles;
  std::vector<Vector3> moved(p.size()), turned(p.size());
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Quaternion &q = (*p.orientation)[i];
    moved[i] = p.position[i] - p.reference_position[i];
    turned[i] = 2 * Vector3{q.x, q.y, q.z};
  }
  const dem::Region slab{dem::cylinder(test.shape().radius, high - low), low};
  return -dem::mean_stress(slab, p, *test.model.bonds, moved, turned)[2][2] * test.nominal_area();
}

TEST(recessed_tube, its_load_passes_over_to_the_specimen_and_is_the_same_at_all_heights) {
  PlatenTestSettings s = recessed(0.5e-3);
  s.loading.tube->metal->yield_strength = 1e9;
  s.loading.tube->contact.bond = {100e6, not_given, 1};
  s.loading.rate = 0.02;
  PlatenTest test(packed_cylinder(), s);
  close(test, 2e-4 * test.shape().height);
  const double load = test.tube_load();
  std::set<double> levels; // m, between layers of elements
  for (const Vector3 &x : test.tube()->solid().mesh().nodes)
    levels.insert(1e-9 * static_cast<double>(std::lround(x.z * 1e9)));
  const std::vector<double> z(levels.begin(), levels.end());
  ASSERT_GE(z.size(), 5u);
  std::vector<double> share;
  for (std::size_t k = 1; k + 2 < z.size(); ++k) { // the outermost reach beyond the specimen
    const double wall = in_wall(test, z[k], z[k + 1]), core = in_specimen(test, z[k], z[k + 1]);
    share.push_back(core / load);
    EXPECT_NEAR((wall + core) / load, 1, 0.02) << z[k];
  }
  const double middle = share[share.size() / 2];
  EXPECT_EQ(test.stress_top(), 0);
  EXPECT_GT(middle, 0.2);
  EXPECT_LT(share.front(), 0.9 * middle);
  EXPECT_LT(share.back(), 0.9 * middle);
}

// Flush as between platens without a recess, which they meet where it has closed.
TEST(recessed_tube, meets_the_platens_where_its_recess_has_closed) {
  const double recess = 2e-6;
  PlatenTest test(packed_cylinder(), recessed(recess));
  const int seats = test.top().layer().seats();
  for (const double other : {0.0, 0.5e-3, 2e-3}) {
    const PlatenTest flush(packed_cylinder(), recessed(other));
    EXPECT_EQ(flush.top().layer().seats(), seats);
    EXPECT_EQ(flush.bottom().layer().seats(), test.bottom().layer().seats());
  }
  EXPECT_GT(seats, 20);
  while (!(test.stress_top() > 0))
    test.step();
  EXPECT_NEAR(test.top().closure() / recess, 1, 0.02);
  EXPECT_GT(test.top().layer().closed, 0.9 * seats);
}

// The lower end of the specimen hangs free and so does the upper rim of the tube.
TEST(recessed_tube, with_a_clearance_too_its_specimen_is_pushed_out) {
  const auto pushed = [](double friction, const SurfaceBond &bond, double closure) {
    PlatenTestSettings s = recessed(0.5e-3, friction);
    s.loading.tube->clearance = 1e-3, s.loading.tube->contact.bond = bond;
    s.loading.rate = 0.02; // or its mass bears some of the load
    s.model.local_damping = 0.7;
    PlatenTest test(packed_cylinder(), s);
    double largest = 0; // N
    while (test.closure_strain() * test.shape().height < closure) {
      test.advance(8);
      largest = std::max(largest, test.stress_top() * test.nominal_area());
      EXPECT_EQ(test.stress_bottom(), 0);
    }
    EXPECT_LT(std::abs(test.energy().residual()), 1e-3 * test.energy().boundary);
    return std::array{largest, test.stress_top() * test.nominal_area(), 2 * test.tube_load(),
                      test.tube()->layer().bonded_share()};
  };
  const double area = 2 * pi * 11e-3 * (26e-3 + 0.5e-3 - 1e-3); // m^2, of the tube's inner face
  const auto held = pushed(0, {0.55e6, not_given, 1e-3}, 12e-6);
  EXPECT_NEAR(held[0] / (0.55e6 * area), 1, 0.04);
  EXPECT_NEAR(held[2] / held[1], 1, 0.05); // the platen below bears it all, on the tube
  EXPECT_EQ(held[3], 1);
  const auto slides = pushed(0, {}, 4e-6);
  EXPECT_LT(slides[0], 0.05 * held[0]); // it has mass
  const auto lost = pushed(0, {0.55e6, not_given, 2e-6}, 12e-6);
  EXPECT_EQ(lost[3], 0);
  EXPECT_LT(std::abs(lost[1]), 0.05 * held[0]);
}

// The upper rim turns with the platen where it is held, and the lower one is held in a push-out too.
TEST(recessed_tube, goes_under_a_platen_on_a_seat) {
  for (const double clearance : {0.0, 1e-3}) {
    PlatenTestSettings s = recessed(0.5e-3);
    s.platens.spherical_seat = true, s.loading.tube->clearance = clearance;
    PlatenTest test(coarse_cylinder(), s);
    const auto lowest_and_highest = [&] {
      const fem::HyperelasticSolid &solid = test.tube()->solid();
      return std::array{solid.node_place(solid.nodes_of(fem::low_end_tag)[0]).z,
                        solid.node_place(solid.nodes_of(fem::high_end_tag)[0]).z};
    };
    const auto before = lowest_and_highest();
    EXPECT_NEAR(before[0], -0.5e-3, 1e-12);
    EXPECT_NEAR(before[1], 12e-3 + (clearance > 0 ? -1e-3 : 0.5e-3), 1e-12);
    close(test, 2e-6);
    EXPECT_NEAR(lowest_and_highest()[0] - before[0], test.bottom().closure(), 1e-9);
    if (clearance > 0) continue;
    EXPECT_NEAR(before[1] - lowest_and_highest()[1], test.top().closure(), 1e-9);
  }
}

TEST(recessed_tube, what_makes_no_sense_is_refused) {
  const auto refused = [](const char *member, const auto &change) {
    PlatenTestSettings s = recessed(0.5e-3);
    change(s);
    const std::vector<Fault> found = faults(s, &coarse_cylinder().shape);
    ASSERT_EQ(found.size(), *member == '\0' ? 0u : 1u) << member;
    for (const Fault &fault : found)
      EXPECT_EQ(fault.member, member);
  };
  using S = PlatenTestSettings;
  refused("", [](S &) {});
  refused("sleeve.recess", [](S &s) { s.loading.tube->recess = 3.01e-3; });
  refused("", [](S &s) { s.loading.tube->recess = 2.99e-3; });
  refused("", [](S &s) { s.loading.tube->clearance = 1e-3; });
  refused("sleeve.recess", [](S &s) { s.loading.servo = true, s.loading.top_stress = 1e6; });
  refused("platens.glued", [](S &s) { s.platens.glued = true; });
  refused("loading.unload_at", [](S &s) { s.loading.unload_at = {1e-4}, s.loading.target_strain = 1; });
}

} // namespace
} // namespace platen::coupling::recessed_tube_test
