// Springs of contacts by hand: Mindlin's stiffness, what unloading takes, what a broken bond hands over.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/dem/examples.h"

namespace platen::dem::contact_springs_test {
namespace {

using namespace examples;

constexpr double other = 2.5 * radius;

// A grain pressed on a larger one without slip, the second moved by hand, at rest between moves.
struct Grains {
  Model model;
  explicit Grains(NormalContact normal = NormalContact::hertz)
      : model(pair_of(radius, other, 0), of(normal)) {}
  static ModelSettings of(NormalContact normal) {
    ModelSettings s = unbonded(normal, TangentialContact::coulomb, 1e7);
    s.contact->friction = 5; // nothing slips
    return s;
  }
  void move(const Vector3 &by) { move_pair(model, by); }
  Vector3 spring() const { return (*model.contacts->spring)[0]; }
  double stiffness() const { return (*model.contacts->tangential_stiffness)[0]; }
};

// Mindlin 1949: F_t = 8 G* a u, 1/G* = 2 (2 - nu)/G, a = sqrt(R* delta).
TEST(contact_springs, hertz_grains_shear_as_mindlin_says) {
  Grains grains;
  const double pressed = 1e-3 * radius, aside = 1e-6 * radius;
  grains.move({-pressed, 0, 0});
  ASSERT_EQ(grains.model.contacts->touching_count(), 1u);
  grains.move({0, aside, 0});
  const double poisson = .25, shear_modulus = 70e9 / (2 * (1 + poisson)),
               effective = shear_modulus / (2 * (2 - poisson)),
               contact_radius = std::sqrt(pressed * radius * other / (radius + other));
  const double wanted = 8 * effective * contact_radius * aside;
  EXPECT_NEAR(grains.spring().y, wanted, 1e-5 * wanted); // the plane turns by 3e-7
  EXPECT_NEAR(grains.model.particles.force[0].y, wanted, 1e-2 * wanted);
}

// At a quarter of the overlap Mindlin's spring is half as stiff: it keeps its stretch and half of its force,
// and the ledger gets the half of its energy that is gone. Pressed again it keeps the force.
TEST(contact_springs, unloading_takes_force_and_energy_from_hertz_springs) {
  Grains grains;
  const Contacts &c = *grains.model.contacts;
  const double pressed = 1e-3 * radius;
  grains.move({-pressed, 0, 0});
  grains.move({0, 1e-7 * radius, 0});
  const double force = norm(grains.spring()), stiffness = grains.stiffness(),
               energy = .5 * force * force / stiffness;
  EXPECT_NEAR(c.friction_work, 0, 1e-6 * energy);
  grains.move({.75 * pressed, 0, 0});
  EXPECT_NEAR(grains.stiffness(), .5 * stiffness, 1e-6 * stiffness);
  EXPECT_NEAR(norm(grains.spring()), .5 * force, 1e-3 * force); // what the plane has turned by
  EXPECT_NEAR(c.friction_work, .5 * energy, 1e-3 * energy);
  grains.move({-.75 * pressed, 0, 0});
  EXPECT_NEAR(norm(grains.spring()), .5 * force, 1e-3 * force);
  EXPECT_NEAR(c.friction_work, .75 * energy, 1e-3 * energy);
}

// Drawn back and sheared in one step, a spring loses by the mean of its forces before and after.
TEST(contact_springs, hertz_springs_that_soften_while_they_shear_close_the_balance) {
  Grains grains;
  const double pressed = 1e-3 * radius, aside = 1e-7 * radius;
  grains.move({-pressed, 0, 0});
  grains.move({0, aside, 0});
  const auto stored = [&] { return .5 * norm_squared(grains.spring()) / grains.stiffness(); };
  const double energy = stored(), force = norm(grains.spring()), lost = grains.model.contacts->friction_work;
  grains.move({.75 * pressed, aside, 0});
  const double work = .5 * (force + norm(grains.spring())) * aside;
  EXPECT_NEAR(grains.model.contacts->friction_work - lost, energy + work - stored(), 3e-3 * energy);
  EXPECT_GT(work, energy);
}

// Parted, a contact forgets: what its springs held is lost, and nothing of it acts when they meet again.
TEST(contact_springs, a_contact_that_opens_loses_what_it_held) {
  for (const NormalContact normal : {NormalContact::linear, NormalContact::hertz}) {
    Grains grains(normal);
    const Contacts &c = *grains.model.contacts;
    const double pressed = 1e-3 * radius;
    grains.move({-pressed, 0, 0});
    grains.move({0, 1e-7 * radius, 0});
    const double held = norm(grains.spring()), energy = .5 * held * held / grains.stiffness();
    ASSERT_GT(energy, 0);
    grains.move({2 * pressed, 0, 0});
    EXPECT_EQ(c.touching_count(), 0u);
    EXPECT_NEAR(c.friction_work, energy, 1e-3 * energy);
    EXPECT_EQ(c.energy(), 0);
    grains.move({-2 * pressed, 0, 0});
    EXPECT_LT(norm(grains.spring()), 1e-2 * held); // the line of centres has turned a little
  }
}

// Two grains that hold by friction do not notice that a third has come near.
TEST(contact_springs, a_new_pair_leaves_those_that_are_there_alone) {
  for (const NormalContact normal : {NormalContact::linear, NormalContact::hertz}) {
    Model model(spheres({{0, 0, 0}, {2 * radius, 0, 0}, {0, 9 * radius, 0}}), Grains::of(normal));
    move_pair(model, {-1e-3 * radius, 0, 0});
    move_pair(model, {0, 1e-6 * radius, 0});
    ASSERT_EQ(model.contacts->table.size(), 1u);
    const Vector3 held = (*model.contacts->spring)[0];
    ASSERT_GT(norm(held), 0);
    model.particles.velocity[2] = {0, -.35 * radius, 0};
    for (int k = 0; k < 20; ++k)
      move_pair(model, {});
    ASSERT_GT(model.contacts->table.size(), 1u);
    EXPECT_LT(norm((*model.contacts->spring)[0] - held), 1e-9 * norm(held));
    EXPECT_LT(std::abs(model.contacts->friction_work), 1e-6 * model.contacts->energy());
  }
}

} // namespace
} // namespace platen::dem::contact_springs_test
