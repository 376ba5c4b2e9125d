// A whole platen that falls on a bonded block and is thrown back, and the wave that a blow sends through a
// bar. In the program a machine leads every platen. Here nothing does: the elastic one has no clamp, and the
// rigid one moves by Newton's law, without turning.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "coupling/contact/contact_layer.h"
#include "fem/elastic_solid.h"
#include "fem/grids.h"
#include "fem/rigid_body.h"
#include "tests/dem/examples.h"
#include "tests/elastic_nodes.h"
#include "tests/measured.h"

namespace platen::coupling::falling_platen_test {
namespace {

using namespace dem::examples;
using measured::expect_below;

constexpr fem::Material steel{7850, 210e9, 0.3};
constexpr double edge = 10; // radii, of the block

fem::Grid falling_grid() {
  const double low = -1.5 * radius, high = (edge + 1.5) * radius, z = (edge + 0.001) * radius;
  return fem::make_grid(fem::BoxPlate{{low, low, z}, {high, high, z + 3 * radius}, {4, 4, 2}});
}

struct RigidPlaten {
  fem::RigidBody body{falling_grid(), steel};
  Vector3 speed{};

  explicit RigidPlaten(double v) : speed{0, 0, -v} { body.set_velocity(speed); }
  void kick(double dt) {
    speed = speed + (dt / body.mass()) * body.total_force();
    body.set_velocity(speed);
  }
  Vector3 momentum() const { return body.mass() * speed; }
  double energy() const { return body.kinetic_energy(); }
};

struct ElasticPlaten {
  fem::ElasticSolid body{falling_grid(), {steel}, fem::Clamp{fem::no_clamp}};

  explicit ElasticPlaten(double v) {
    const std::size_t nodes = body.model().nodes.size();
    fem::set_deformation(body, std::vector<Vector3>(nodes, Vector3{}),
                         std::vector<Vector3>(nodes, Vector3{0, 0, -v}));
  }
  void kick(double dt) { body.kick(dt); }
  Vector3 momentum() const { return fem::momenta(body).linear; }
  double energy() const { return body.energy_balance().kinetic + body.energy_balance().strain; }
};

template <class Platen>
void fall(double speed, const std::string &which) {
  dem::ModelSettings settings = bonded();
  settings.bond_layout.gap.value = 0.05;
  dem::Model model(packed_box(edge, edge, edge), settings);
  dem::Particles &p = model.particles;
  Platen platen(speed);
  SurfaceContact contact;
  contact.particle_stiffness = normal_stiffness * area;
  contact.friction_static = contact.friction_dynamic = 0.3;
  contact.skin = 0.3 * radius;
  ContactLayer layer(p, platen.body, contact);
  layer.make_list(p, platen.body);
  const double dt = 0.4 * std::min(model.stable_step(layer.ground_springs(p, platen.body), 0).limit,
                                   platen.body.stable_step(layer.vertex_springs(p, platen.body)));
  const auto energy = [&] {
    return model.energy().stored() + layer.elastic_energy() + layer.friction_work + platen.energy();
  };
  const double start = energy(), thrown = norm(platen.momentum());
  const Vector3 before = platen.momentum();
  double momentum_off = 0, energy_off = 0, pressed = 0;
  int apart = 0; // looks since they last touched
  for (int n = 0; n < 200000; ++n) {
    model.begin_step(dt);
    platen.kick(0.5 * dt);
    platen.body.drift(dt);
    platen.body.clear_loads();
    layer.moved(model.last_motion().fastest * dt + platen.body.last_move());
    model.compute_forces(dt);
    layer.add_forces(p, platen.body, dt);
    platen.kick(0.5 * dt);
    model.end_step(dt);
    pressed = std::max(pressed, layer.elastic_energy());
    if (n % 10 != 0) continue;
    const Vector3 block = momentum(p).linear;
    const Vector3 now = platen.momentum();
    momentum_off = std::max(momentum_off, norm(now + block - before));
    energy_off = std::max(energy_off, std::abs(energy() / start - 1));
    if (pressed > 0 && layer.closed == 0 && ++apart == 100) break; // thrown back
    if (layer.closed > 0) apart = 0;
  }
  EXPECT_GT(pressed, 1e-3 * start);
  EXPECT_EQ(apart, 100) << "still in touch";
  expect_below(24, "drift_of_momentum_of_" + which, momentum_off / thrown, 1e-10);
  expect_below(24, "drift_of_energy_of_" + which, energy_off, 0.01);
}

TEST(falling_platen, a_rigid_one_is_thrown_back_with_all_momentum_and_energy) {
  for (const auto &[speed, name] : {std::pair{0.1, "0.1"}, {1.0, "1"}, {10.0, "10"}})
    fall<RigidPlaten>(speed, std::string("a_rigid_platen_at_") + name + "_m_per_s");
}

TEST(falling_platen, an_elastic_one_is_thrown_back_with_all_momentum_and_energy) {
  for (const auto &[speed, name] : {std::pair{0.1, "0.1"}, {1.0, "1"}, {10.0, "10"}})
    fall<ElasticPlaten>(speed, std::string("an_elastic_platen_at_") + name + "_m_per_s");
}

// The end layer of a bar of 3 x 3 x 160 spheres moves on at one speed. Of the front that a row of masses and
// springs k = k_n A carries, a third of that speed arrives with the wave of the long ones, c = 2 R sqrt(k /
// m) (its head is an Airy function, of which a third lies beyond 0), however much it has spread on the way.
TEST(falling_platen, a_wave_arrives_at_its_time) {
  std::vector<Vector3> centres;
  constexpr int layers = 160;
  for (int z = 0; z < layers; ++z)
    for (int y = 0; y < 3; ++y)
      for (int x = 0; x < 3; ++x)
        centres.push_back(2 * radius * Vector3{1.0 * x, 1.0 * y, 1.0 * z});
  dem::Model model(spheres(centres), bonded());
  dem::Particles &p = model.particles;
  const double speed = 1e-3, c = 2 * radius * std::sqrt(normal_stiffness * area / p.mass[0]);
  const double dt = 0.2 * model.stable_step({}, 0).limit;
  const auto rows_of_layer = [&](int z) {
    std::vector<std::size_t> rows;
    for (std::size_t i = 0; i < p.size(); ++i)
      if (std::lround(p.position[i].z / (2 * radius)) == z) rows.push_back(i);
    return rows;
  };
  const auto led = rows_of_layer(0);
  const auto lead = [&] {
    for (const std::size_t i : led)
      p.velocity[i] = {0, 0, speed};
  };
  double worst = 0;
  const std::vector<int> listened{60, 100, 140};
  std::vector<double> arrived(listened.size(), 0), last(listened.size(), 0);
  std::vector<std::vector<std::size_t>> rows;
  for (const int z : listened)
    rows.push_back(rows_of_layer(z));
  while (arrived.back() == 0 && model.time < 2 * layers * 2 * radius / c) {
    lead();
    step(model, dt, [&](dem::Particles &q) {
      for (const std::size_t i : led)
        q.force[i] = {};
    });
    lead();
    for (std::size_t k = 0; k < listened.size(); ++k) {
      double now = 0;
      for (const std::size_t i : rows[k])
        now += p.velocity[i].z / static_cast<double>(rows[k].size());
      if (arrived[k] == 0 && now > speed / 3)
        arrived[k] = model.time - dt * (now - speed / 3) / (now - last[k]);
      last[k] = now;
    }
  }
  for (std::size_t k = 0; k < listened.size(); ++k)
    worst = std::max(worst, std::abs(arrived[k] * c / (2 * radius * listened[k]) - 1));
  expect_below(24, "time_of_a_wave_in_a_bar_over_closed_form_less_one", worst, 0.02);
}

} // namespace
} // namespace platen::coupling::falling_platen_test
