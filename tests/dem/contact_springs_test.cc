// Springs of contacts by hand: Mindlin's stiffness, what unloading takes, what a broken bond hands over.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "dem/laws/rotating_plane.h"
#include "tests/dem/examples.h"

namespace platen::dem {
namespace {

using namespace examples;

constexpr double young = 70e9, poisson = .25, other = 2.5 * radius;

// Moves one of the spheres by hand, all at rest before and after.
void move_by(Model &model, std::size_t i, const Vector3 &by) {
  Particles &p = model.particles;
  for (std::size_t k = 0; k < p.size(); ++k)
    p.velocity[k] = p.force[k] = (*p.torque)[k] = (*p.angular_velocity)[k] = {};
  p.velocity[i] = by;
  model.begin_step(1);
  model.compute_forces(1);
}

// A grain pressed on a larger one, the second moved by hand, at rest between moves.
struct Grains {
  Model model;
  explicit Grains(const ModelSettings &settings) : model(specimen(), settings) {}
  static Specimen specimen() {
    Specimen s = spheres({{0, 0, 0}, {radius + other, 0, 0}});
    s.radius = {radius, other};
    return s;
  }
  static ModelSettings hertz() {
    ModelSettings s;
    s.density = 2400;
    s.local_damping = 0;
    s.contact = ContactSettings{};
    s.contact->normal = NormalContact::hertz;
    s.contact->young_modulus = young, s.contact->poisson_ratio = poisson;
    s.contact->friction = 5; // nothing slips
    return s;
  }
  static ModelSettings of(NormalContact normal) {
    ModelSettings s = hertz();
    s.contact->normal = normal;
    s.contact->stiffness = {Stiffness::Kind::absolute, 1e7};
    s.contact->damping = 0;
    return s;
  }
  void move(const Vector3 &by) { move_by(model, 1, by); }
  Vector3 spring() const { return (*model.contacts->spring)[0]; }
  double stiffness() const { return (*model.contacts->tangential_stiffness)[0]; }
};

// Mindlin 1949: F_t = 8 G* a u, 1/G* = 2 (2 - nu)/G, a = sqrt(R* delta).
TEST(contact_springs, hertz_grains_shear_as_mindlin_says) {
  Grains grains(Grains::hertz());
  const double pressed = 1e-3 * radius, aside = 1e-6 * radius;
  grains.move({-pressed, 0, 0});
  ASSERT_EQ(grains.model.contacts->touching_count(), 1u);
  grains.move({0, aside, 0});
  const double shear_modulus = young / (2 * (1 + poisson)), effective = shear_modulus / (2 * (2 - poisson)),
               contact_radius = std::sqrt(pressed * radius * other / (radius + other));
  const double wanted = 8 * effective * contact_radius * aside;
  EXPECT_NEAR(grains.spring().y, wanted, 1e-5 * wanted); // the plane turns by 3e-7
  EXPECT_NEAR(grains.model.particles.force[0].y, wanted, 1e-2 * wanted);
}

// At a quarter of the overlap Mindlin's spring is half as stiff: it keeps its stretch and half of its force,
// and the ledger gets the half of its energy that is gone. Pressed again it keeps the force.
TEST(contact_springs, unloading_takes_force_and_energy_from_hertz_springs) {
  Grains grains(Grains::hertz());
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
  Grains grains(Grains::hertz());
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
    const ModelSettings settings = Grains::of(normal);
    Grains grains(settings);
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

// However far the plane turns in one go: by a right angle about the line that both planes share.
TEST(contact_springs, a_right_angle_turns_a_vector_of_the_plane_exactly) {
  const Vector3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
  const auto expect = [](const Vector3 &found, const Vector3 &wanted) {
    EXPECT_LT(norm(found - wanted), 1e-15);
  };
  expect(carry_with_plane(x, z, x), -z);
  expect(carry_with_plane(y, z, x), y);
  expect(carry_with_plane(2 * x + 3 * y, z, x), 3 * y - 2 * z);
  expect(spin_in_plane(x, z, .5 * pi), y);
  expect(spin_in_plane(x, z, -.5 * pi), -y);
}

// A bonded pair that overlaps by a tenth, moved by hand.
struct Bonded {
  static constexpr double length = 1.9 * radius;
  Model model;
  explicit Bonded(const ModelSettings &settings) : model(spheres({{0, 0, 0}, {length, 0, 0}}), settings) {}
  void place(double stretch, double aside) {
    Particles &p = model.particles;
    p.position[1] = {length + stretch, aside, 0};
    p.force[0] = p.force[1] = (*p.torque)[0] = (*p.torque)[1] = {};
    model.compute_forces(1e-9);
  }
};

TEST(contact_springs, after_a_bond_of_overlapping_spheres_contact_begins_at_its_length) {
  Bonded pair(breakable());
  ASSERT_EQ(pair.model.intact_bonds(), 1u);
  pair.place(1.1 * Bonded::length * tensile_strength / modulus, 0);
  ASSERT_EQ(pair.model.intact_bonds(), 0u);
  const double k = pair.model.contacts->coefficient[0];
  for (const double stretch : {1e-3, 1e-5, -1e-5, -1e-3}) {
    pair.place(stretch * radius, 0);
    EXPECT_NEAR(pair.model.particles.force[0].x, std::min(0., k * stretch * radius), 1e-12 * k * radius)
        << stretch;
  }
}

// Shear beyond the limit of friction goes with the bond, at once: friction has done no work yet.
TEST(contact_springs, a_broken_bond_hands_over_no_more_than_friction_holds) {
  ModelSettings settings = breakable();
  settings.contact->tangential_ratio = stiffness_ratio;
  Bonded pair(settings);
  const double pressed = 2e-4 * radius,
               slip = 1.1 * Bonded::length * shear_strength / (stiffness_ratio * modulus);
  pair.place(-pressed, slip);
  ASSERT_EQ(pair.model.broken_shear, 1);
  const Contacts &c = *pair.model.contacts;
  const double pressing = c.coefficient[0] * c.overlap[0], held = norm((*c.spring)[0]);
  EXPECT_NEAR(held, settings.contact->friction * pressing, 1e-9 * pressing);
  EXPECT_LT(c.friction_work, 1e-9 * pair.model.works.fracture);
}

// A contact much stiffer than the bond would hold more energy at the overlap that there is: it begins from
// the overlap at which it holds what the bond did, and nothing is released.
TEST(contact_springs, a_stiff_contact_holds_what_the_bond_held) {
  for (const NormalContact normal : {NormalContact::linear, NormalContact::hertz}) {
    ModelSettings settings = breakable();
    settings.contact->normal = normal;
    settings.contact->stiffness.value = 1000;
    settings.contact->young_modulus = 1000 * modulus, settings.contact->poisson_ratio = .2;
    Bonded pair(settings);
    const double pressed = 4e-3 * radius,
                 slip = 1.1 * Bonded::length * shear_strength / (stiffness_ratio * modulus);
    // The law is elastic: what it stores beyond its strength is told by an unbreakable pair at the same
    // place.
    ModelSettings unbreakable = settings;
    parallel_bond(unbreakable).tensile_strength = parallel_bond(unbreakable).shear_strength = 0;
    Bonded whole(unbreakable);
    whole.place(-pressed, 3 * slip);
    pair.place(-pressed, 3 * slip);
    ASSERT_EQ(pair.model.broken_shear, 1);
    const double held = bond_energy(whole.model.particles, *whole.model.bonds);
    EXPECT_NEAR(pair.model.contacts->energy(), held, 1e-6 * held);
    EXPECT_LT(pair.model.works.fracture, 1e-6 * held);
  }
}

// Two grains that hold by friction do not notice that a third has come near.
TEST(contact_springs, a_new_pair_leaves_those_that_are_there_alone) {
  for (const NormalContact normal : {NormalContact::linear, NormalContact::hertz}) {
    const ModelSettings settings = Grains::of(normal);
    Model model(spheres({{0, 0, 0}, {2 * radius, 0, 0}, {0, 9 * radius, 0}}), settings);
    move_by(model, 1, {-1e-3 * radius, 0, 0});
    move_by(model, 1, {0, 1e-6 * radius, 0});
    ASSERT_EQ(model.contacts->table.size(), 1u);
    const Vector3 held = (*model.contacts->spring)[0];
    ASSERT_GT(norm(held), 0);
    for (int k = 0; k < 20; ++k)
      move_by(model, 2, {0, -.35 * radius, 0});
    ASSERT_GT(model.contacts->table.size(), 1u);
    EXPECT_LT(norm((*model.contacts->spring)[0] - held), 1e-9 * norm(held));
    EXPECT_LT(std::abs(model.contacts->friction_work), 1e-6 * model.contacts->energy());
  }
}

// Both strengths are passed in one step: the crack is of the kind that is passed by more.
TEST(contact_springs, the_strength_that_is_passed_by_more_says_how_a_bond_broke) {
  for (const auto &[tension, shear] : {std::pair{1.1, 1.4}, std::pair{1.4, 1.1}, std::pair{1.1, .9}}) {
    ModelSettings settings = breakable();
    parallel_bond(settings).moment_contribution = 0;
    Bonded pair(settings);
    const double aside = shear * Bonded::length * shear_strength / (stiffness_ratio * modulus);
    // The pair grows longer by aside^2 / 2L too.
    pair.place(tension * Bonded::length * tensile_strength / modulus - .5 * aside * aside / Bonded::length,
               aside);
    ASSERT_EQ(pair.model.intact_bonds(), 0u) << tension;
    EXPECT_EQ(pair.model.broken_shear, shear > tension) << tension;
    EXPECT_EQ(pair.model.broken_tension, shear < tension) << tension;
  }
}

} // namespace
} // namespace platen::dem
