// A number that is none stops the run within steps, by name, and before it can be kept.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>

#include "coupling/platen_test.h"
#include "tests/coupling/set_ups.h"
#include "tests/measured.h"

namespace platen::coupling::not_finite_test {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

PlatenTestSettings pressed() {
  PlatenTestSettings s = crushing();
  s.model.bond = dem::ParallelBond::Parameters{0.4, 2e9, 6e9, 0.7853981633974483, 0.3};
  s.model.contact->friction = 0;
  s.model.local_damping = 0;
  s.loading.rate = 0.3;
  s.loading.ramp = PlatenTestSettings{}.loading.ramp;
  return s;
}

// One bonded cylinder, and a sphere that lies beside it and touches nothing.
dem::Specimen with_a_loose_sphere() {
  dem::Specimen s = small_cylinder();
  s.centre.push_back({20e-3, 0, 7e-3});
  s.radius.push_back(1e-3);
  return s;
}

struct Stopped {
  long steps = -1; // until it stopped; -1: it did not
  std::string message;
};

Stopped run(PlatenTest &problem, long most) {
  const long start = problem.steps();
  try {
    while (problem.steps() < start + most)
      problem.advance(start + most - problem.steps());
  } catch (const NumericsStopped &e) {
    return {problem.steps() - start, e.what()};
  }
  return {};
}

std::size_t row_of(const dem::Particles &p, int id) {
  std::size_t row = 0;
  while (p.id[row] != id)
    ++row;
  return row;
}

using Spoil = std::function<void(dem::Particles &, std::size_t, double)>;
const std::vector<std::pair<std::string, Spoil>> columns{
    {"position", [](auto &p, std::size_t i, double x) { p.position[i].y = x; }},
    {"velocity", [](auto &p, std::size_t i, double x) { p.velocity[i].x = x; }},
    {"force", [](auto &p, std::size_t i, double x) { p.force[i].z = x; }},
    {"orientation", [](auto &p, std::size_t i, double x) { (*p.orientation)[i].w = x; }},
    {"angular_velocity", [](auto &p, std::size_t i, double x) { (*p.angular_velocity)[i].y = x; }},
    {"torque", [](auto &p, std::size_t i, double x) { (*p.torque)[i].y = x; }},
    {"mass", [](auto &p, std::size_t i, double x) { p.mass[i] = x; }},
    {"inertia", [](auto &p, std::size_t i, double x) { (*p.inertia)[i] = x; }}};

// Of a bonded sphere within ten steps, of one that touches nothing within a hundred.
TEST(not_finite, in_any_column_is_found_within_steps_and_named) {
  long slowest = 0;
  for (const auto &[name, spoil] : columns)
    for (const bool loose : {false, true}) {
      PlatenTest problem(with_a_loose_sphere(), pressed());
      problem.advance(137);
      const int id = loose ? static_cast<int>(problem.model.particles.size()) - 1 : 41;
      spoil(problem.model.particles, row_of(problem.model.particles, id), none);
      const Stopped s = run(problem, 300);
      ASSERT_GE(s.steps, 0) << name;
      EXPECT_LE(s.steps, loose ? 100 : 10) << name;
      EXPECT_NE(s.message.find(loose ? " of particle " + std::to_string(id) + " " : "41"), std::string::npos)
          << name << ": " << s.message;
      EXPECT_NE(s.message.find(" of particle"), std::string::npos) << name << ": " << s.message;
      if (!loose) slowest = std::max(slowest, s.steps);
    }
  measured::note_figure(18, "steps_until_found", static_cast<double>(slowest), "<= 10");
}

// It would be past a platen before the search looks again.
TEST(escape, of_a_sphere_is_stopped_at_once_and_named) {
  PlatenTest problem(with_a_loose_sphere(), pressed());
  problem.advance(137);
  const int id = static_cast<int>(problem.model.particles.size()) - 1;
  problem.model.particles.velocity[row_of(problem.model.particles, id)] = {1e5, 0, 0};
  const Stopped s = run(problem, 100);
  EXPECT_GE(s.steps, 0);
  EXPECT_LE(s.steps, 1);
  EXPECT_NE(s.message.find("the fastest is particle " + std::to_string(id)), std::string::npos) << s.message;
}

// A sphere that leaves at a speed that can be followed stays in the run and in its count.
TEST(escape, of_a_slow_sphere_is_followed) {
  PlatenTest problem(with_a_loose_sphere(), pressed());
  const int id = static_cast<int>(problem.model.particles.size()) - 1;
  const std::size_t row = row_of(problem.model.particles, id);
  problem.model.particles.velocity[row] = {100, 0, 0};
  const std::size_t before = problem.model.particles.size();
  EXPECT_EQ(run(problem, 500).steps, -1);
  EXPECT_EQ(problem.model.particles.size(), before);
  EXPECT_NEAR(problem.model.particles.position[row].x, 20e-3 + 100 * problem.time(), 1e-12);
}

// Put one on the other in a run: what they are pushed apart with can be no physics.
TEST(coincident, spheres_in_a_run_stop_it_and_are_named) {
  PlatenTest problem(with_a_loose_sphere(), pressed());
  problem.advance(137);
  dem::Particles &p = problem.model.particles;
  const int id = static_cast<int>(p.size()) - 1;
  const std::size_t loose = row_of(p, id), other = row_of(p, 41);
  p.position[loose] = p.position[other];
  p.velocity[loose] = p.velocity[other];
  p.force[loose] = p.force[other] = {};
  problem.model.contacts->search(p, problem.model.bonds.get(), 1); // it has come from afar
  const Stopped s = run(problem, 100);
  ASSERT_GE(s.steps, 0);
  EXPECT_LE(s.steps, 10);
  EXPECT_NE(s.message.find("41"), std::string::npos) << s.message;
  EXPECT_NE(s.message.find(std::to_string(id)), std::string::npos) << s.message;
}

TEST(not_finite, is_refused_before_a_checkpoint) {
  PlatenTest problem(with_a_loose_sphere(), pressed());
  problem.advance(30);
  EXPECT_NO_THROW(problem.require_finite());
  problem.model.particles.position[5].x = std::numeric_limits<double>::infinity();
  EXPECT_THROW(problem.require_finite(), NumericsStopped);
}

} // namespace
} // namespace platen::coupling::not_finite_test
