// Static equilibrium against strength of materials, symmetry, and the law of the bonds.
#include "dem/equilibrium.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/parallel.h"
#include "dem/measure/bond_network.h"
#include "tests/dem/examples.h"
#include "tests/dem/sparse_equilibrium.h"

namespace platen::dem::equilibrium_test {
namespace {

using namespace examples;

constexpr double young = 40e9, poisson = .2, slender = .7;

ModelSettings beams() {
  return bonded_by_beams(young, poisson, slender);
}
StaticSettings exact() {
  StaticSettings s;
  s.tolerance = 1e-14;
  return s;
}
StaticCase clamped_at(std::size_t row) {
  StaticCase load;
  load.prescribed.push_back({static_cast<int>(row), {}, {}});
  return load;
}

// By the law of its bonds: what a chain of n of them, each of the length d, is as a beam.
struct Section {
  const char *name;
  ModelSettings settings;
  double bending, axial, torsion; // E I, E A, G J
  double links;                   // 1: rigid links between bonds that bend in their middle, 0: bent all along
  double shear;                   // r G_b A; infinite of beams
};
std::vector<Section> sections() {
  const double r = slender * radius, beam = pi * r * r, ei = young * beam * r * r / 4;
  return {
      {"beams", beams(), ei, young * beam, ei / (1 + poisson), 0, std::numeric_limits<double>::infinity()},
      {"parallel_bonds", bonded(), modulus * second_moment, modulus * area,
       stiffness_ratio * modulus * polar_moment, 1, stiffness_ratio * modulus * area}};
}

// Whatever its direction and its number of bonds: exact at the node at its tip, under a force across and one
// along, a moment that bends and one that twists.
TEST(equilibrium, of_a_chain_is_that_of_a_beam) {
  for (const Section &of : sections())
    for (const Vector3 &along : {Vector3{1, 0, 0}, Vector3{0, 0, -1}, Vector3{1, -2, .7}})
      for (const int n : {1, 2, 3, 7}) {
        const Vector3 axis = along / norm(along), any = cross(axis, Vector3{.3, -.5, .81}),
                      side = any / norm(any), about = cross(axis, side);
        const double l = 2 * radius * n, p = 3, f = 5, m = 3e-3, t = 2e-3; // m, N, N m
        Model model(row(n, axis), of.settings);
        const std::size_t tip = row_of(model.particles, n);
        StaticCase load = clamped_at(row_of(model.particles, 0));
        load.force.resize(model.particles.size());
        load.torque.resize(model.particles.size());
        load.force[tip] = p * side + f * axis;
        load.torque[tip] = m * about + t * axis;
        const StaticState s = solve_static(model.particles, *model.bonds, load, exact());
        const double ei = of.bending,
                     across = p * (l * l * l / (3 * ei) * (1 - of.links / (4. * n * n)) + l / of.shear) +
                              m * l * l / (2 * ei);
        const Vector3 moved = across * side + f * l / of.axial * axis;
        const Vector3 turned = (p * l * l / (2 * ei) + m * l / ei) * about + t * l / of.torsion * axis;
        EXPECT_LT(norm(s.displacement[tip] - moved), 1e-9 * norm(moved)) << of.name << ' ' << n;
        EXPECT_LT(norm(s.turn[tip] - turned), 1e-9 * norm(turned)) << of.name << ' ' << n;
        EXPECT_LT(s.residual, 1e-14);
      }
}

// Loads and prescribed particles ask for the same: what a load does, that displacement gives the load back.
TEST(equilibrium, prescribed_particles_feel_what_loads_would_do) {
  Model model(packed_box(9, 9, 9), bonded());
  const Particles &p = model.particles;
  const std::size_t low = 0, high = p.size() - 1;
  StaticCase load = clamped_at(low);
  load.force.resize(p.size());
  load.force[high] = {3, -2, 5};
  const StaticState free = solve_static(p, *model.bonds, load, exact());
  StaticCase prescribed = clamped_at(low);
  prescribed.prescribed.push_back({static_cast<int>(high), free.displacement[high], free.turn[high]});
  const StaticState same = solve_static(p, *model.bonds, prescribed, exact());
  double largest = 0, difference = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    largest = std::max(largest, norm(free.displacement[i]));
    difference = std::max(difference, norm(free.displacement[i] - same.displacement[i]));
  }
  EXPECT_GT(largest, 0);
  EXPECT_LT(difference, 1e-9 * largest);
}

// A rigid motion of the supports carries the network along and strains nothing.
TEST(equilibrium, a_moved_support_carries_the_network) {
  for (const bool rotation : {true, false}) {
    ModelSettings settings = bonded();
    settings.rotation = rotation;
    Model model(packed_box(7, 7, 7), settings);
    const Particles &p = model.particles;
    const Vector3 moved{1e-6, -2e-6, 3e-6};
    StaticCase load;
    for (std::size_t i = 0; i < p.size(); i += 5)
      load.supports.push_back({{static_cast<int>(i), {0, 0, 1}, {0, 0, -radius}, 1e7, 4e6, 2.}, moved});
    const StaticState s = solve_static(p, *model.bonds, load, exact());
    for (std::size_t i = 0; i < p.size(); ++i) {
      ASSERT_LT(norm(s.displacement[i] - moved), 1e-9 * norm(moved)) << i << rotation;
      ASSERT_LT(norm(s.turn[i]) * radius, 1e-9 * norm(moved)) << i << rotation;
    }
  }
}

// What the bonds' own law says of the displaced state balances the loads, to the square of the strain.
TEST(equilibrium, bonds_of_the_displaced_state_balance_the_loads) {
  for (ModelSettings settings : {bonded(), beams()}) {
    Model model(packed_box(9, 9, 9), settings);
    Particles &p = model.particles;
    StaticCase load = clamped_at(0);
    load.force.assign(p.size(), {});
    load.force[p.size() - 1] = {2e-3, 3e-3, -4e-3};
    load.torque.assign(p.size(), {});
    load.torque[p.size() / 2] = {1e-6, 0, 2e-6};
    const StaticState s = solve_static(p, *model.bonds, load, exact());
    double largest = 0;
    for (std::size_t i = 0; i < p.size(); ++i) {
      largest = std::max(largest, norm(s.displacement[i]) / radius);
      p.position[i] += s.displacement[i];
      (*p.orientation)[i] = rotation_quaternion(s.turn[i]);
    }
    EXPECT_LT(largest, 1e-4);
    const Loads answer = bond_loads(p, *model.bonds);
    for (std::size_t i = 1; i < p.size(); ++i) {
      ASSERT_LT(norm(answer.force[i] + load.force[i]), 1e-4 * 5e-3) << i;
      ASSERT_LT(norm(answer.torque[i] + load.torque[i]), 1e-4 * 5e-3 * radius) << i;
    }
  }
}

// Some thousand spheres on springs below, prescribed above, with a few loads: three levels of the multigrid.
StaticCase pressed(const Particles &p, double height) {
  StaticCase load;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const int row = static_cast<int>(i);
    if (p.position[i].z < 2 * radius)
      load.supports.push_back({{row, {0, 0, 1}, {0, 0, -radius}, 1e7, 0, 0.}, {}});
    if (p.position[i].z > height - 2 * radius)
      load.prescribed.push_back({row, {1e-6, 0, -2e-6}, {0, p.has_rotation() ? 1e-5 : 0, 0}});
  }
  load.force.assign(p.size(), {0, 0, -1e-2});
  load.torque.assign(p.size(), {});
  load.torque[p.size() / 2] = {1e-5, 0, 2e-5};
  return load;
}
double largest_difference(const Particles &p, const StaticState &a, const StaticState &b) {
  double largest = 0, difference = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    largest = std::max({largest, norm(a.displacement[i]), radius * norm(a.turn[i])});
    difference = std::max(
        {difference, norm(a.displacement[i] - b.displacement[i]), radius * norm(a.turn[i] - b.turn[i])});
  }
  return difference / largest;
}

// Of bonds by their own law, from a little to either side: of one level of the multigrid and of several.
TEST(equilibrium, bonds_and_springs_balance_the_loads) {
  ModelSettings still = bonded();
  still.rotation = false;
  for (const ModelSettings &settings : {bonded(), beams(), still})
    for (const double height : {9., 30.}) {
      const double wide = height > 10 ? 20 : 9;
      Model model(packed_box(wide, wide, height), settings);
      Particles &p = model.particles;
      ASSERT_EQ(p.size() > 1000, height > 10);
      const StaticCase load = pressed(p, height * radius);
      StaticSettings fine;
      fine.tolerance = 1e-12;
      const StaticState s = solve_static(p, *model.bonds, load, fine);
      EXPECT_LT(s.iterations, 80);
      // Off by the square of the strain, and by round-off of positions.
      constexpr double little = .03;
      const auto displaced = [&](double by) {
        for (std::size_t i = 0; i < p.size(); ++i) {
          p.position[i] = p.reference_position[i] + by * s.displacement[i];
          if (p.has_rotation()) (*p.orientation)[i] = rotation_quaternion(by * s.turn[i]);
        }
        return bond_loads(p, *model.bonds);
      };
      const Loads on = displaced(little), back = displaced(-little);
      std::vector<Vector3> force = load.force, torque = load.torque;
      double largest = 0;
      for (std::size_t i = 0; i < p.size(); ++i) {
        const Vector3 by_bonds = (on.force[i] - back.force[i]) / (2 * little);
        largest = std::max(largest, norm(by_bonds));
        force[i] += by_bonds, torque[i] += (on.torque[i] - back.torque[i]) / (2 * little);
      }
      for (const Support &support : load.supports) {
        const auto i = static_cast<std::size_t>(support.spring.particle);
        force[i].z -= support.spring.normal_stiffness * s.displacement[i].z;
      }
      for (const auto &prescribed : load.prescribed)
        force[prescribed.particle] = torque[prescribed.particle] = {};
      for (std::size_t i = 0; i < p.size(); ++i) {
        ASSERT_LT(norm(force[i]), 1e-7 * largest) << i;
        if (p.has_rotation()) {
          ASSERT_LT(norm(torque[i]), 1e-7 * largest * radius) << i;
        }
      }
    }
}

TEST(equilibrium, clusters_do_not_change_the_answer) {
  ModelSettings still = bonded();
  still.rotation = false;
  for (const ModelSettings &settings : {bonded(), beams(), still}) {
    Model model(packed_box(20, 20, 30), settings);
    const Particles &p = model.particles;
    ASSERT_GT(p.size(), 1000u);
    const StaticCase load = pressed(p, 30 * radius);
    StaticSettings fine;
    fine.tolerance = 1e-12;
    const StaticState s = solve_static(p, *model.bonds, load, fine);
    EXPECT_LT(largest_difference(p, s, solve_sparse(p, *model.bonds, load, fine)), 1e-8);
    EXPECT_LT(s.iterations, 80);
  }
}

TEST(equilibrium, any_number_of_threads_gives_the_same_bits) {
  Model model(packed_box(20, 20, 30), bonded());
  const Particles &p = model.particles;
  const StaticCase load = pressed(p, 30 * radius);
  StaticState one;
  for (const int threads : {1, 2, 4}) {
    const ThreadLimit limit(threads);
    const StaticState s = solve_static(p, *model.bonds, load);
    if (threads == 1) one = s;
    EXPECT_EQ(s.iterations, one.iterations);
    EXPECT_EQ(largest_difference(p, s, one), 0) << threads;
  }
}

// What was found before is no more than a beginning: supports come and go.
TEST(equilibrium, a_start_saves_iterations_and_nothing_else) {
  Model model(packed_box(20, 20, 30), bonded());
  const Particles &p = model.particles;
  StaticCase load = pressed(p, 30 * radius);
  EquilibriumSolver solver(p, *model.bonds);
  StaticSettings fine;
  fine.tolerance = 1e-11;
  const StaticState all = solver.solve(load, fine);
  load.supports.pop_back();
  const StaticState fewer = solver.solve(load, fine, &all), anew = solve_static(p, *model.bonds, load, fine);
  EXPECT_GT(largest_difference(p, all, anew), 1e-5);
  EXPECT_LT(largest_difference(p, fewer, anew), 1e-8);
  EXPECT_LT(fewer.iterations, anew.iterations);
  EXPECT_EQ(solver.solve(load, fine, &fewer).iterations, 0);
}

TEST(equilibrium, loads_without_an_answer_are_told) {
  Model model(row(2, {1, 0, 0}), bonded());
  StaticCase load;
  load.force.assign(model.particles.size(), {1, 0, 0}); // nothing holds it
  StaticSettings few;
  few.most_iterations = 50;
  EXPECT_THROW(solve_static(model.particles, *model.bonds, load, few), NoEquilibrium);
  load.force.resize(1);
  EXPECT_THROW(solve_static(model.particles, *model.bonds, load), std::invalid_argument);
}

// Spheres without a bond stay, unless a load would carry them away.
TEST(equilibrium, loose_spheres_stay_where_they_are) {
  Model model(spheres({{0, 0, 0}, {2 * radius, 0, 0}, {9 * radius, 0, 0}}), bonded());
  StaticCase load = clamped_at(row_of(model.particles, 0));
  load.force.resize(3);
  load.force[row_of(model.particles, 1)] = {1, 0, 0};
  const StaticState s = solve_static(model.particles, *model.bonds, load, exact());
  EXPECT_EQ(norm(s.displacement[row_of(model.particles, 2)]), 0);
  EXPECT_NEAR(s.displacement[row_of(model.particles, 1)].x, 1 / (normal_stiffness * area),
              1e-9 / (normal_stiffness * area));
  load.force[row_of(model.particles, 2)] = {1, 0, 0};
  EXPECT_THROW(solve_static(model.particles, *model.bonds, load), NoEquilibrium);
}

TEST(equilibrium, a_particle_is_prescribed_once) {
  Model model(row(3, {1, 0, 0}), bonded());
  StaticCase load = clamped_at(0);
  load.prescribed.push_back({0, {1e-6, 0, 0}, {}});
  EquilibriumSolver solver(model.particles, *model.bonds);
  for (int way = 0; way < 2; ++way)
    try {
      way == 0 ? solver.solve(load) : solve_static(model.particles, *model.bonds, load);
      FAIL();
    } catch (const std::invalid_argument &e) {
      EXPECT_NE(std::string(e.what()).find("particle " + std::to_string(model.particles.id[0]) +
                                           " is prescribed twice"),
                std::string::npos)
          << e.what();
    }
  for (const int none : {-1, 4}) {
    load.prescribed = {{none, {}, {}}};
    EXPECT_THROW(solver.solve(load), std::invalid_argument);
    load.prescribed.clear();
    load.supports = {{{none, {0, 0, 1}, {0, 0, -radius}, 1e7, 0, 0.}, {}}};
    EXPECT_THROW(solver.solve(load), std::invalid_argument);
    load.supports.clear();
  }
}

// Whatever spring it has too, a prescribed particle is where it was moved to.
TEST(equilibrium, a_prescribed_particle_does_not_feel_its_support) {
  Model model(row(3, {1, 0, 0}), bonded());
  const Particles &p = model.particles;
  const std::size_t low = row_of(p, 0), high = row_of(p, 3);
  StaticCase load = clamped_at(low);
  load.prescribed.push_back({static_cast<int>(high), {2e-6, 0, 0}, {}});
  const StaticState without = solve_static(p, *model.bonds, load, exact());
  load.supports.push_back(
      {{static_cast<int>(high), {1, 0, 0}, {-radius, 0, 0}, 1e9, 1e8, 0.}, {-1e-3, 0, 0}});
  const StaticState with = solve_static(p, *model.bonds, load, exact());
  EXPECT_EQ(largest_difference(p, without, with), 0);
  EXPECT_EQ(with.displacement[high].x, 2e-6);
  EXPECT_NEAR(with.displacement[row_of(p, 1)].x, 2e-6 / 3, 1e-17);
}

// A box beside another one, in one network, small enough for one level and large enough for several.
TEST(equilibrium, a_piece_that_nothing_holds_stays_where_it_is) {
  for (const double height : {6., 30.}) {
    const double wide = height > 10 ? 20 : 6;
    const Specimen one = packed_box(wide, wide, height);
    Specimen both = one;
    for (std::size_t i = 0; i < one.size(); ++i) {
      both.centre.push_back(one.centre[i] + Vector3{2 * wide * radius, 0, 0});
      both.radius.push_back(one.radius[i]);
    }
    both.centre.push_back({0, 4 * wide * radius, 0}); // and a sphere
    both.radius.push_back(radius);
    Model model(both, bonded()), alone(one, bonded());
    const auto fixed = [&](const Particles &p) {
      StaticCase load;
      for (std::size_t i = 0; i < p.size(); ++i) {
        if (p.position[i].x > wide * radius || p.position[i].y > 2 * wide * radius) continue;
        const int row = static_cast<int>(i);
        if (p.position[i].z < 2 * radius)
          load.supports.push_back({{row, {0, 0, 1}, {0, 0, -radius}, 1e7, 1e6, 0.}, {}});
        if (p.position[i].z > (height - 2) * radius) load.prescribed.push_back({row, {1e-6, 0, -2e-6}, {}});
      }
      return load;
    };
    StaticSettings fine;
    fine.tolerance = 1e-12;
    const Particles &p = model.particles;
    StaticCase load = fixed(p);
    ASSERT_FALSE(load.prescribed.empty());
    const StaticState s = solve_static(p, *model.bonds, load, fine),
                      expected = solve_static(alone.particles, *alone.bonds, fixed(alone.particles), fine);
    std::vector<std::size_t> at(both.size());
    for (std::size_t i = 0; i < p.size(); ++i)
      at[p.id[i]] = i;
    std::size_t stray = p.size();
    for (std::size_t i = 0; i < p.size(); ++i)
      if (p.position[i].x > wide * radius || p.position[i].y > 2 * wide * radius) {
        stray = i;
        ASSERT_LT(norm(s.displacement[i]), 1e-16) << i; // of 2e-6
      }
    for (std::size_t i = 0; i < alone.particles.size(); ++i)
      ASSERT_LT(norm(s.displacement[at[alone.particles.id[i]]] - expected.displacement[i]), 1e-8 * 2e-6);
    // Loaded, it is refused by name, at once.
    load.force.assign(p.size(), {});
    load.force[stray] = {0, 0, 1};
    try {
      solve_static(p, *model.bonds, load, fine);
      FAIL();
    } catch (const NoEquilibrium &e) {
      EXPECT_NE(std::string(e.what()).find("nothing holds"), std::string::npos) << e.what();
    }
  }
}

} // namespace
} // namespace platen::dem::equilibrium_test
