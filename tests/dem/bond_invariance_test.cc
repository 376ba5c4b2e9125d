// What must not change a bond's force: rigid motion, the frame, the order of particles, units and origin.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/random.h"
#include "tests/dem/examples.h"
#include "tests/measured.h"

namespace platen::dem::bond_invariance_test {
namespace {

using namespace examples;
using measured::expect_below;

const Vector3 skew_axis = Vector3{.3, -.5, .8} / std::sqrt(.98);

// Imposed through 10 turns in steps of .05 rad; orientations are carried on from step to step as in a run.
TEST(bond_invariance, ten_rigid_turns_break_nothing_and_store_nothing) {
  ModelSettings settings = breakable();
  settings.contact.reset();
  Model model(packed_box(12, 12, 12), settings);
  ASSERT_GT(model.bonds->size(), 200u);
  std::vector<BondBreak> breaks;
  const Quaternion turn = rotation_quaternion(.05 * skew_axis);
  const Vector3 centre = 6 * radius * Vector3{0, 0, 1};
  Particles &p = model.particles;
  Quaternion whole;
  double largest = 0;
  for (int s = 0; s < 1257; ++s) {
    turn_rigidly(p, turn, centre);
    whole = normalised(turn * whole);
    if (s % 16 != 0) continue;
    for (std::size_t i = 0; i < p.size(); ++i) // without the round-off of a thousand small moves
      p.position[i] = centre + rotate(whole, p.reference_position[i] - centre);
    for (const Vector3 &f : kernel_loads(p, *model.bonds, model.settings().instruction_set, breaks).force)
      largest = std::max(largest, norm(f));
  }
  EXPECT_TRUE(breaks.empty());
  expect_below(8, "force_over_strength_after_turns", largest / (tensile_strength * area), 1e-10);
  // Energy is of second order in the same round-off: 1e-20 of what all bonds hold at their strength.
  const double at_strength = tensile_strength * tensile_strength / modulus * area * radius;
  EXPECT_LT(bond_energy(p, *model.bonds), 1e-20 * at_strength * static_cast<double>(model.bonds->size()));
}

// A cluster that spins freely stretches under its own weight; the bond forces then rotate with it.
TEST(bond_invariance, a_preloaded_bond_keeps_its_force_in_the_turning_frame) {
  Model model(row(1, {.2, .5, -.4}), bonded());
  Particles &p = model.particles;
  const Vector3 n = (p.position[1] - p.position[0]) / (2 * radius);
  const Vector3 side = cross(n, Vector3{1, 0, 0}) / norm(cross(n, Vector3{1, 0, 0}));
  const double strain = .5 * tensile_strength / modulus; // half the strength
  p.position[1] += 2 * radius * strain * (n + .7 * side);
  (*p.orientation)[1] = rotation_quaternion(strain * (n + side));
  std::vector<BondBreak> breaks;
  const Loads before = kernel_loads(p, *model.bonds, InstructionSet::baseline, breaks);
  const Vector3 force = before.force[0], torque = before.torque[0];
  ASSERT_NEAR(dot(force, n), .5 * tensile_strength * area, 1e-3 * tensile_strength * area);
  const Quaternion turn = rotation_quaternion(.01 * skew_axis);
  Quaternion whole;
  for (int s = 0; s < 6283; ++s) {
    turn_rigidly(p, turn, {});
    whole = normalised(turn * whole);
  }
  const Loads after = kernel_loads(p, *model.bonds, InstructionSet::baseline, breaks);
  // The law is exact; the tolerance is for 6000 roundings of a strain of 1e-4.
  EXPECT_LT(norm(after.force[0] - rotate(whole, force)), 1e-6 * norm(force));
  EXPECT_LT(norm(after.torque[0] - rotate(whole, torque)), 1e-6 * norm(torque));
}

// A free pair spinning about a skew axis, started at its own stretched equilibrium: it spins on without
// sound.
TEST(bond_invariance, a_freely_spinning_pair_keeps_its_stretch) {
  Model model(row(1, {1, 0, 0}), bonded());
  Particles &p = model.particles;
  const double mass = p.mass[0], k = modulus * area / (2 * radius), spin = 1e-3 * std::sqrt(2 * k / mass);
  // k e = m w^2 (R + e/2)
  const double stretch = mass * spin * spin * radius / (k - .5 * mass * spin * spin);
  const Vector3 middle = .5 * (p.position[0] + p.position[1]), w{0, 0, spin};
  for (std::size_t i = 0; i < 2; ++i) {
    p.position[i] = middle + (1 + stretch / (2 * radius)) * (p.position[i] - middle);
    p.velocity[i] = cross(w, p.position[i] - middle);
    (*p.angular_velocity)[i] = w;
  }
  const double dt = .05 / std::sqrt(2 * k / mass);
  const int steps = static_cast<int>(20 * pi / (spin * dt)); // 10 turns
  // The drift needs half-step velocities: take half a kick back.
  for (std::size_t i = 0; i < 2; ++i)
    p.force[i] = -mass * spin * spin * (p.position[i] - middle);
  double least = 1, most = 0;
  for (int s = 0; s < steps; ++s) {
    step(model, dt);
    const double now = norm(p.position[1] - p.position[0]) / (2 * radius) - 1;
    least = std::min(least, now), most = std::max(most, now);
  }
  // Leapfrog runs on a polygon: its stretch differs by (w dt)^2 of itself and by 1e-16 / stretch of
  // round-off.
  EXPECT_NEAR(least * 2 * radius, stretch, 1e-4 * stretch);
  EXPECT_NEAR(most * 2 * radius, stretch, 1e-4 * stretch);
}

struct Course {
  std::vector<Vector3> position; // by input id
  std::vector<Vector3> start;
};

// Steps a bonded cluster, input numbers shuffled by `order`, frame turned by `turn`; never breaks.
Course course(const std::vector<int> &order, const Quaternion &turn, int steps) {
  Specimen specimen = packed_box(10, 10, 10), shuffled = specimen;
  for (std::size_t k = 0; k < order.size(); ++k) {
    shuffled.centre[k] = rotate(turn, specimen.centre[order[k]]);
    shuffled.radius[k] = specimen.radius[order[k]];
  }
  Model model(shuffled, breakable());
  Particles &p = model.particles;
  for (std::size_t k = 0; k < p.size(); ++k) {
    Random random(static_cast<std::uint64_t>(order[p.id[k]]));
    p.velocity[k] = rotate(turn, .05 * random.direction());
    (*p.angular_velocity)[k] = rotate(turn, (.01 / radius) * random.direction());
  }
  Course c;
  c.position.resize(p.size()), c.start.resize(p.size());
  step(model, 1e-7, steps);
  EXPECT_EQ(model.broken_tension + model.broken_shear, 0);
  for (std::size_t k = 0; k < p.size(); ++k) {
    const std::size_t id = static_cast<std::size_t>(order[p.id[k]]);
    c.position[id] = rotate(conjugate(turn), p.position[k]);
    c.start[id] = rotate(conjugate(turn), p.reference_position[k]);
  }
  return c;
}

std::vector<int> counting(std::size_t n) {
  std::vector<int> order(n);
  std::iota(order.begin(), order.end(), 0);
  return order;
}

double difference(const Course &a, const Course &b) {
  double most = 0, displacement = 0;
  for (std::size_t k = 0; k < a.position.size(); ++k) {
    most = std::max(most, norm(a.position[k] - b.position[k]));
    displacement = std::max(displacement, norm(a.position[k] - a.start[k]));
  }
  return most / displacement;
}

TEST(bond_invariance, the_numbering_of_particles_does_not_matter) {
  const std::size_t n = packed_box(10, 10, 10).size();
  std::vector<int> order = counting(n);
  const Course straight = course(order, {}, 1000);
  Random(5).shuffle(order);
  expect_below(3, "difference_of_places", difference(straight, course(order, {}, 1000)), 1e-10);
}

// Another frame is another spatial order too: sums run in another order, numbers round differently.
TEST(bond_invariance, the_frame_does_not_matter) {
  const std::vector<int> order = counting(packed_box(10, 10, 10).size());
  const Course straight = course(order, {}, 1000);
  expect_below(9, "difference_of_places_in_a_turned_frame",
               difference(straight, course(order, rotation_quaternion(1.1 * skew_axis), 1000)), 1e-9);
}

// What the bonds of a free block in motion store, J, with the origin moved by `shift` and computed in units
// of which a metre has `length` and a kilogram `mass`: mm-t-s has 1e3 and 1e-3.
double energy_of_block(const Vector3 &shift, double length, double mass) {
  Specimen specimen = packed_box(8, 8, 8);
  for (std::size_t i = 0; i < specimen.size(); ++i) {
    specimen.centre[i] = length * specimen.centre[i] + shift;
    specimen.radius[i] *= length;
  }
  ModelSettings settings = bonded();
  settings.density *= mass / (length * length * length);
  settings.bond_layout.modulus *= mass / length; // per s^2
  Model model(specimen, settings);
  Particles &p = model.particles;
  for (std::size_t i = 0; i < p.size(); ++i) {
    Random random(static_cast<std::uint64_t>(p.id[i]));
    p.velocity[i] = length * .05 * random.direction();
  }
  step(model, 1e-7, 500);
  return model.energy().bonds / (mass * length * length); // J
}

TEST(bond_invariance, units_and_the_place_of_the_origin_do_not_matter) {
  const double here = energy_of_block({}, 1, 1);
  ASSERT_GT(here, 0);
  const double away = 1e3 * 8 * radius; // a thousand times the block
  const auto differs = [&](const Vector3 &shift, double length, double mass) {
    return std::abs(energy_of_block(shift, length, mass) / here - 1);
  };
  expect_below(9, "energy_in_mm_t_s", differs({}, 1e3, 1e-3), 1e-9);
  expect_below(9, "energy_a_thousand_sizes_away", differs({away, -away, away}, 1, 1), 1e-6);
}

} // namespace
} // namespace platen::dem::bond_invariance_test
