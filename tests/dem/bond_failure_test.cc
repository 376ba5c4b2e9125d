// How bonds are laid, how they break and what takes their place.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "base/random.h"
#include "tests/dem/examples.h"
#include "tests/measured.h"

namespace platen::dem::bond_failure_test {
namespace {

using namespace examples;
using measured::expect_below;

constexpr double breaking_strain = tensile_strength / modulus;

std::size_t bonds_at_gap(double gap, double ri, double rj, double allowed, bool relative) {
  Specimen s = spheres({{0, 0, 0}, {ri + rj + gap, 0, 0}});
  s.radius = {ri, rj};
  ModelSettings settings = bonded();
  settings.bond_layout.gap.value = allowed;
  settings.bond_layout.gap.relative = relative;
  return Model(s, settings).bonds->size();
}

TEST(bond_failure, the_gap_decides_who_is_bonded) {
  const double small = radius, large = 3 * radius;
  for (const auto &[ri, rj] : {std::pair{small, large}, std::pair{large, small}}) {
    EXPECT_EQ(bonds_at_gap(.0499 * small, ri, rj, .05, true), 1u); // of the smaller radius
    EXPECT_EQ(bonds_at_gap(.0501 * small, ri, rj, .05, true), 0u);
    EXPECT_EQ(bonds_at_gap(.99e-5, ri, rj, 1e-5, false), 1u); // m
    EXPECT_EQ(bonds_at_gap(1.01e-5, ri, rj, 1e-5, false), 0u);
    EXPECT_EQ(bonds_at_gap(-.3 * small, ri, rj, 0, true), 1u); // overlapping
  }
}

TEST(bond_failure, the_rule_decides_the_radius) {
  BondLayout layout;
  layout.radius_multiplier = .8;
  layout.radius = 7e-4;
  const auto radius_by = [&](RadiusRule rule) {
    layout.radius_rule = rule;
    return layout.bond_radius(1e-3, 3e-3);
  };
  EXPECT_DOUBLE_EQ(radius_by(RadiusRule::minimum), .8e-3);
  EXPECT_DOUBLE_EQ(radius_by(RadiusRule::mean), 1.6e-3);
  EXPECT_DOUBLE_EQ(radius_by(RadiusRule::harmonic), 1.2e-3);
  EXPECT_DOUBLE_EQ(radius_by(RadiusRule::given), 5.6e-4);
}

// Three spheres in a row have two pairs, so that each has 4/3 neighbours. Without pairs or porosity there is
// none.
TEST(bond_failure, the_packing_factor_is_forty_porosities_over_the_neighbours_of_a_sphere) {
  BondLayout layout;
  layout.gap.value = 0.01;
  const auto factor = [&](double apart, const Shape &shape) { // in radii
    Specimen s = spheres({{0, 0, 0}, {apart * radius, 0, 0}, {2 * apart * radius, 0, 0}});
    s.shape = scaled(shape, radius);
    return packing_factor(s, layout);
  };
  const double porosity = 1 - 3 * 4. / 3 * pi / (10 * 6 * 8);
  EXPECT_NEAR(factor(2, box(10, 6, 8)), 40 * porosity / (4. / 3), 1e-12);
  EXPECT_THROW(factor(3, box(10, 6, 8)), BadParameter);
  EXPECT_THROW(factor(2, box(2, 3, 2)), BadParameter); // 12 R^3 for 12.6 R^3 of spheres
}

TEST(bond_failure, spheres_with_one_centre_cannot_be_bonded) {
  EXPECT_THROW(Model(spheres({{1, 2, 3}, {1, 2, 3}}), bonded()), std::invalid_argument);
}

// A pair of this length moved by hand: no step, so no inertia.
class Pair {
public:
  explicit Pair(const ModelSettings &settings, double length = 2 * radius)
      : model(spheres({{0, 0, 0}, {length, 0, 0}}), settings) {
    if (model.contacts)
      model.contacts->search(model.particles, model.bonds.get(), .2 * radius); // beyond all moves
  }
  void place(const Vector3 &displacement, const Vector3 &turn = {}) {
    Particles &p = model.particles;
    p.position[1] = p.reference_position[1] + displacement;
    if (p.has_rotation()) (*p.orientation)[1] = rotation_quaternion(turn);
    for (std::size_t i = 0; i < 2; ++i)
      p.force[i] = (*p.torque)[i] = {};
    model.compute_forces(1e-9);
  }
  // On the first sphere, by bond and contact.
  Vector3 force() const { return model.particles.force[0]; }
  bool intact() const { return model.intact_bonds() == 1; }

  Model model;
};

TEST(bond_failure, tension_breaks_brittly_at_the_strength) {
  Pair pair(breakable());
  double most = 0;
  for (int s = 1; s <= 1100; ++s) {
    pair.place({2 * radius * breaking_strain * s / 1000, 0, 0});
    if (!pair.intact()) {
      EXPECT_GE(s, 1000); // round-off may bring 1000 itself to either side
      EXPECT_LE(s, 1001);
      break;
    }
    most = std::max(most, pair.force().x);
  }
  EXPECT_FALSE(pair.intact());
  EXPECT_EQ(norm(pair.force()), 0);
  EXPECT_NEAR(most, tensile_strength * area, 2e-3 * tensile_strength * area); // load steps of a thousandth
  EXPECT_EQ(pair.model.broken_tension, 1);
  // The fracture work is what the bond held: F^2 / (2 k).
  const double held = .5 * tensile_strength * area * 2 * radius * breaking_strain;
  EXPECT_NEAR(pair.model.works.fracture, held, 3e-3 * held);
}

TEST(bond_failure, a_crack_is_logged_where_and_when_it_opens) {
  Pair pair(breakable());
  pair.model.time = 3.5;
  pair.place({2 * radius * 1.2 * breaking_strain, 0, 0});
  const std::vector<Crack> cracks = pair.model.take_cracks();
  ASSERT_EQ(cracks.size(), 1u);
  EXPECT_EQ(cracks[0].mode, BondState::broken_in_tension);
  EXPECT_EQ(cracks[0].time, 3.5);
  EXPECT_NEAR(cracks[0].point.x, radius, 1e-3 * radius);
  EXPECT_NEAR(std::abs(cracks[0].normal.x), 1, 1e-12);
  EXPECT_DOUBLE_EQ(cracks[0].area, area);
  EXPECT_EQ(cracks[0].energy, pair.model.works.fracture);
  EXPECT_TRUE(pair.model.take_cracks().empty());
  EXPECT_EQ(pair.model.bonds->state[0], static_cast<int>(BondState::broken_in_tension));
  EXPECT_EQ(pair.model.bonds->break_time[0], 3.5);
}

// A load put on at once doubles the force in an undamped system.
TEST(bond_failure, a_sudden_load_breaks_at_half_the_strength) {
  for (const auto &[share, holds] : {std::pair{.495, true}, std::pair{.505, false}}) {
    Model model(row(1, {1, 0, 0}), breakable());
    const double load = share * tensile_strength * area;
    const double dt = .02 / std::sqrt(2 * normal_stiffness * area / model.particles.mass[0]);
    model.particles.force[0].x = -load, model.particles.force[1].x = load; // from t = 0 on
    for (int s = 0; s < 1000 && model.intact_bonds() == 1; ++s)            // three periods
      step(model, dt, [&](Particles &p) { p.force[0].x -= load, p.force[1].x += load; });
    EXPECT_EQ(model.intact_bonds() == 1, holds) << share;
  }
}

// From the length of the bond on where spheres overlapped, from where they touch where they had a gap.
TEST(bond_failure, a_broken_bond_never_pulls_again_and_pushes_from_where_it_was) {
  for (const double length : {1.9 * radius, 2 * radius, 2.05 * radius}) {
    ModelSettings settings = breakable();
    settings.bond_layout.gap.value = .1;
    Pair pair(settings, length);
    ASSERT_TRUE(pair.intact());
    pair.place({1.1 * length * breaking_strain, 0, 0});
    ASSERT_FALSE(pair.intact());
    const double k = pair.model.contacts->coefficient[0], rest = std::min(length, 2 * radius);
    EXPECT_NEAR(k, normal_stiffness * area, 1e-12 * k); // as a bond of touching spheres
    for (int cycle = 0; cycle < 3; ++cycle)
      for (const double strain : {1e-3, 1e-4, 0.0, -1e-4, -1e-3, -1e-5, 1e-6, 5e-3}) {
        const double e = 2 * radius * strain;
        pair.place({rest - length + e, 0, 0});
        // Pushing is negative on the first.
        EXPECT_NEAR(pair.force().x, strain < 0 ? k * e : 0, 1e-12 * k * radius) << length << ' ' << strain;
        EXPECT_EQ(pair.force().y, 0);
        EXPECT_FALSE(pair.intact());
      }
  }
}

// The dashpot of a bond acts until the bond breaks, the half step before it included.
TEST(bond_failure, the_dashpot_of_a_breaking_bond_is_in_the_balance) {
  ModelSettings settings = breakable();
  settings.bond_dashpot = .3;
  Model model(row(1, {1, 0, 0}), settings);
  Particles &p = model.particles;
  const double omega = std::sqrt(2 * normal_stiffness * area / p.mass[0]);
  p.velocity[1].x = 10 * breaking_strain * 2 * radius * omega; // breaks in the first oscillation
  const double energy = kinetic_energy(p), dt = .02 / omega;
  step(model, dt, 100);
  ASSERT_EQ(model.intact_bonds(), 0u);
  EXPECT_GT(model.energy().damping, .01 * energy);
  EXPECT_NEAR(model.energy().stored() + model.energy().lost(), energy, 1e-4 * energy);
}

TEST(bond_failure, compression_alone_breaks_nothing) {
  Pair pair(breakable());
  for (double strain = 0; strain < .05; strain += 1e-3) // 200 times the tensile strength
    pair.place({-2 * radius * strain, 0, 0});
  EXPECT_TRUE(pair.intact());
}

TEST(bond_failure, a_gap_that_was_bonded_pushes_only_once_it_is_closed) {
  ModelSettings settings = breakable();
  settings.bond_layout.gap.value = .1;
  Model model(spheres({{0, 0, 0}, {2.05 * radius, 0, 0}}), settings);
  ASSERT_EQ(model.intact_bonds(), 1u);
  Particles &p = model.particles;
  const auto place = [&](double distance) {
    p.position[1].x = distance;
    p.force[0] = p.force[1] = {};
    model.contacts->search(p, model.bonds.get(), .2 * radius); // further than any move below
    model.compute_forces(1e-9);
    return p.force[0].x;
  };
  place(2.1 * radius); // breaks
  ASSERT_EQ(model.intact_bonds(), 0u);
  EXPECT_EQ(place(2.001 * radius), 0);
  EXPECT_LT(place(1.999 * radius), 0);
}

// Shear under compression, for contacts softer and stiffer than the bond: what the bond held and the contact
// does not is released, and never negative.
TEST(bond_failure, handing_over_to_a_contact_never_makes_energy) {
  for (const double multiple : {1e-4, .1, 1.0, 3.0, 100.0})
    for (const NormalContact normal : {NormalContact::linear, NormalContact::hertz})
      for (const double strain : {-1e-6, -1e-4, -2e-3}) {
        ModelSettings settings = breakable();
        settings.contact->normal = normal;
        settings.contact->stiffness.value = multiple;
        settings.contact->young_modulus = multiple * modulus;
        settings.contact->poisson_ratio = .2;
        Pair pair(settings);
        const double slip = .99 * 2 * radius * shear_strength / (stiffness_ratio * modulus);
        pair.place({2 * radius * strain, slip, 0});
        ASSERT_TRUE(pair.intact());
        const double held = pair.model.energy().stored();
        pair.place({2 * radius * strain, 1.01 * slip / .99, 0});
        ASSERT_FALSE(pair.intact());
        EXPECT_EQ(pair.model.broken_shear, 1);
        const EnergyLedger after = pair.model.energy();
        EXPECT_GE(after.fracture, 0);
        // The move itself adds up to 4 % of the shear energy; friction takes at once what is above its limit.
        EXPECT_NEAR(after.contacts + after.fracture + after.friction, 1.02 * held, .025 * held)
            << multiple << " " << strain;
        EXPECT_LE(after.contacts, 1.05 * held);
      }
}

TEST(bond_failure, compression_does_not_jump_at_equal_stiffness) {
  Pair pair(breakable());
  const double slip = 2 * radius * shear_strength / (stiffness_ratio * modulus), strain = -1e-3;
  // On the circle of constant distance, so that the compression is the same on both sides of the break.
  const double length = 2 * radius * (1 + strain);
  const auto at = [&](double share) {
    const double angle = std::asin(share * slip / (2 * radius));
    pair.place({length * std::cos(angle) - 2 * radius, length * std::sin(angle), 0});
    return angle;
  };
  at(.999);
  ASSERT_TRUE(pair.intact());
  const double before = pair.model.bonds->response(0, pair.model.particles).normal_force;
  const double angle = at(1.001);
  ASSERT_FALSE(pair.intact());
  const Vector3 n{std::cos(angle), std::sin(angle), 0};
  expect_below(16, "jump_of_compression", std::abs(dot(pair.force(), n) / before - 1), 1e-12);
}

// What friction does not hold goes with the bond, at once: friction has done no work yet.
TEST(bond_failure, shear_force_is_kept_up_to_the_coulomb_limit) {
  for (const double strain : {-2e-4, -4e-3}) {
    ModelSettings settings = breakable();
    settings.contact->tangential_ratio = stiffness_ratio; // so that the contact can hold the bond's energy
    Pair pair(settings);
    const double slip = 2 * radius * shear_strength / (stiffness_ratio * modulus);
    pair.place({2 * radius * strain, 1.001 * slip, 0});
    ASSERT_EQ(pair.model.broken_shear, 1);
    const Contacts &c = *pair.model.contacts;
    const double limit = .5 * c.coefficient[0] * c.overlap[0], held = norm((*c.spring)[0]);
    EXPECT_LE(held, limit * (1 + 1e-9));
    const double kept = std::min(1.001 * shear_strength * area, limit);
    EXPECT_NEAR(pair.force().y, kept, .02 * kept); // the plane has turned by slip / length
    EXPECT_LE(c.friction_work, 1e-9 * pair.model.works.fracture);
  }
}

// Shear beyond the limit of friction goes with the bond of overlapping spheres, at once: friction has done no
// work yet.
TEST(bond_failure, a_bond_hands_over_no_more_than_friction_holds) {
  constexpr double length = 1.9 * radius;
  ModelSettings settings = breakable();
  settings.contact->tangential_ratio = stiffness_ratio;
  Pair pair(settings, length);
  pair.place({-2e-4 * radius, 1.1 * length * shear_strength / (stiffness_ratio * modulus), 0});
  ASSERT_EQ(pair.model.broken_shear, 1);
  const Contacts &c = *pair.model.contacts;
  const double pressing = c.coefficient[0] * c.overlap[0], held = norm((*c.spring)[0]);
  EXPECT_NEAR(held, settings.contact->friction * pressing, 1e-9 * pressing);
  EXPECT_LT(c.friction_work, 1e-9 * pair.model.works.fracture);
}

// A contact much stiffer than the bond would hold more energy at the overlap that there is: it begins from
// the overlap at which it holds what the bond did, and nothing is released.
TEST(bond_failure, a_stiff_contact_holds_what_the_bond_held) {
  constexpr double length = 1.9 * radius;
  for (const NormalContact normal : {NormalContact::linear, NormalContact::hertz}) {
    ModelSettings settings = breakable();
    settings.contact->normal = normal;
    settings.contact->stiffness.value = 1000;
    settings.contact->young_modulus = 1000 * modulus, settings.contact->poisson_ratio = .2;
    // The law is elastic: what it stores beyond its strength is told by an unbreakable pair at the same
    // place.
    ModelSettings unbreakable = settings;
    parallel_bond(unbreakable).tensile_strength = parallel_bond(unbreakable).shear_strength = 0;
    Pair pair(settings, length), whole(unbreakable, length);
    for (Pair *one : {&pair, &whole})
      one->place({-4e-3 * radius, 3.3 * length * shear_strength / (stiffness_ratio * modulus), 0});
    ASSERT_EQ(pair.model.broken_shear, 1);
    const double held = bond_energy(whole.model.particles, *whole.model.bonds);
    EXPECT_NEAR(pair.model.contacts->energy(), held, 1e-6 * held);
    EXPECT_LT(pair.model.works.fracture, 1e-6 * held);
  }
}

// Both strengths are passed in one step: the crack is of the kind that is passed by more.
TEST(bond_failure, the_strength_that_is_passed_by_more_says_how_a_bond_broke) {
  constexpr double length = 2 * radius;
  for (const auto &[tension, shear] : {std::pair{1.1, 1.4}, std::pair{1.4, 1.1}, std::pair{1.1, .9}}) {
    ModelSettings settings = breakable();
    parallel_bond(settings).moment_contribution = 0;
    Pair pair(settings);
    const double aside = shear * length * shear_strength / (stiffness_ratio * modulus);
    // The pair grows longer by aside^2 / 2L too.
    pair.place({tension * length * breaking_strain - .5 * aside * aside / length, aside, 0});
    ASSERT_FALSE(pair.intact()) << tension;
    EXPECT_EQ(pair.model.broken_shear, shear > tension) << tension;
    EXPECT_EQ(pair.model.broken_tension, shear < tension) << tension;
  }
}

TEST(bond_failure, a_bond_broken_in_tension_hands_over_no_shear) {
  ModelSettings settings = breakable();
  parallel_bond(settings).moment_contribution = 1;
  Pair pair(settings);
  // Compressed, bent far beyond the tensile strength, and sheared a little.
  pair.place({-2 * radius * 1e-4, 1e-3 * radius, 0}, {0, 0, .01});
  ASSERT_EQ(pair.model.broken_tension, 1);
  EXPECT_LT(std::abs(dot(pair.force(), Vector3{0, 1, 0})), 1e-2 * norm(pair.force()));
}

// Whole packing beyond its strength at once: every bond's energy is in the balance, to round-off.
TEST(bond_failure, a_burst_releases_what_was_stored) {
  ModelSettings settings = breakable();
  settings.contact.reset();
  Model model(packed_box(14, 14, 14), settings);
  Particles &p = model.particles;
  for (std::size_t i = 0; i < p.size(); ++i)
    p.position[i] = (1 + 1.005 * breaking_strain) * p.position[i];
  const double stored = bond_energy(p, *model.bonds);
  const std::size_t bonds = model.intact_bonds();
  model.compute_forces(1e-9);
  EXPECT_EQ(model.intact_bonds(), 0u);
  EXPECT_EQ(model.broken_tension, static_cast<long>(bonds));
  expect_below(15, "released_over_stored_less_one", std::abs(model.works.fracture / stored - 1), 1e-10);
}

// A free block flies apart, cracks and collides with itself; of contacts the damping, where there are any,
// else broken bonds leave nothing behind. What it is off by, over its kinetic energy at first.
double residual_of_burst(double step_over_limit, std::optional<double> damping) {
  ModelSettings settings = breakable();
  if (damping)
    settings.contact->damping = *damping;
  else
    settings.contact.reset();
  Model model(packed_box(16, 16, 16), settings);
  Particles &p = model.particles;
  Random random(3);
  const Vector3 middle = 8 * radius * Vector3{0, 0, 1};
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Vector3 x = (p.position[i] - middle) / radius;
    p.velocity[i] = .1 * x + 2 * random.direction() + cross(Vector3{.02, .01, -.03}, x) + Vector3{1, 2, -1};
    (*p.angular_velocity)[i] = (.2 / radius) * random.direction();
  }
  const double dt = step_over_limit * model.stable_step({}, 0).limit;
  const EnergyLedger start = model.energy();
  std::size_t most = 0;
  for (int s = 0; s < static_cast<int>(800 / step_over_limit); ++s) {
    step(model, dt);
    if (model.contacts) most = std::max(most, model.contacts->touching_count());
  }
  EXPECT_EQ(most > 10, damping.has_value());
  EXPECT_GT(model.broken_tension + model.broken_shear, 100);
  return std::abs(model.energy().residual() - start.residual()) / start.kinetic;
}

TEST(bond_failure, the_energy_balance_of_a_cracking_body_closes) {
  for (const auto &[damping, what] : {std::pair<std::optional<double>, std::string>{0.0, ""},
                                      {.2, "_with_dashpots"},
                                      {std::nullopt, "_without_contacts"}}) {
    expect_below(5, "residual_at_0.8_of_the_limit" + what, residual_of_burst(.8, damping), 1e-2);
    expect_below(5, "residual_at_0.2_of_the_limit" + what, residual_of_burst(.2, damping), 1e-3);
  }
}

} // namespace
} // namespace platen::dem::bond_failure_test
