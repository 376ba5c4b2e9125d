// Dashpots act in the pass that computes the bonds: the same as one by one by hand, and once a step.
#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"
#include "tests/dem/examples.h"

namespace platen::dem::bond_dashpots_test {
namespace {

using namespace examples;

constexpr double dt = 1e-8; // s

struct Case {
  const char *name;
  bool rotation, moments, interfaces;
};
class BondDashpots : public testing::TestWithParam<Case> {
protected:
  static ModelSettings settings(double fraction) {
    ModelSettings s = bonded();
    s.rotation = GetParam().rotation;
    if (GetParam().interfaces) {
      ElastoDamagePlastic::Parameters p;
      p.moments = GetParam().moments;
      s.bond = p;
    } else {
      parallel_bond(s).moments = GetParam().moments;
    }
    s.bond_dashpot = fraction;
    return s;
  }
  static void set_in_motion(Particles &p) {
    Random random(7);
    for (std::size_t i = 0; i < p.size(); ++i) {
      p.velocity[i] = random.direction();
      if (p.has_rotation()) (*p.angular_velocity)[i] = (1 / radius) * random.direction();
    }
  }
  static Loads forces(Model &model, ExactSum *work = nullptr) {
    Particles &p = model.particles;
    Bonds &b = *model.bonds;
    std::vector<BondBreak> breaks;
    const InstructionSet set = best_instruction_set();
    const ExactSum by_dashpots = GetParam().interfaces ? compute_cohesive_forces(p, b, set, {}, dt, breaks)
                                                       : compute_bond_forces(p, b, set, {}, dt, breaks);
    if (work != nullptr) *work = by_dashpots;
    for (std::size_t block = 0; block < b.blocks.blocks(); ++block)
      return_ghosts(p, b.blocks, block);
    Loads loads{{p.force.begin(), p.force.end()}, std::vector<Vector3>(p.size())};
    if (p.has_rotation()) loads.torque.assign(p.torque->begin(), p.torque->end());
    return loads;
  }
  // Adds a dashpot to the loads; returns its power, W.
  static double add_dashpot(const Particles &p, const Bonds &b, std::size_t k, Loads &loads) {
    const auto i = static_cast<std::size_t>(b.first[k]), j = static_cast<std::size_t>(b.second[k]);
    const Vector3 d = p.position[j] - p.position[i], n = d / norm(d);
    const Vector3 ri = b.lever[k] * d, rj = ri - d;
    Vector3 v = p.velocity[j] - p.velocity[i], w;
    if (p.has_rotation()) {
      const Vector3 wi = (*p.angular_velocity)[i], wj = (*p.angular_velocity)[j];
      v += cross(wj, rj) - cross(wi, ri), w = wj - wi;
    }
    const Vector3 along = dot(v, n) * n, twisting = dot(w, n) * n;
    const Vector3 force = (*b.dashpot)[k] * (along + b.dashpot_shear_ratio * (v - along));
    Vector3 moment;
    if (b.dashpot_bending != nullptr)
      moment = (*b.dashpot_bending)[k] * ((w - twisting) + b.dashpot_twist_ratio * twisting);
    loads.force[i] += force, loads.force[j] -= force;
    loads.torque[i] += cross(ri, force) + moment, loads.torque[j] += cross(force, rj) - moment;
    return dot(force, v) + dot(moment, w);
  }
};

TEST_P(BondDashpots, are_those_of_their_formula_in_every_row) {
  Model with(packed_box(14, 14, 14), settings(.1)), without(packed_box(14, 14, 14), settings(0));
  set_in_motion(with.particles), set_in_motion(without.particles);
  ExactSum work, again;
  const Loads loads = forces(with, &work);
  Loads expected = forces(without);
  double power = 0, force = 0;
  for (std::size_t k = 0; k < with.bonds->size(); ++k) {
    power += add_dashpot(with.particles, *with.bonds, k, expected);
    force = std::max(force, norm((*with.bonds->dashpot_force)[k]));
  }
  for (const Vector3 &f : expected.force)
    force = std::max(force, norm(f));
  EXPECT_GT(power, 0);
  const bool turning = GetParam().rotation;
  for (std::size_t i = 0; i < with.particles.size(); ++i) {
    ASSERT_LE(norm(loads.force[i] - expected.force[i]), 1e-12 * force) << "row " << i;
    if (turning) {
      ASSERT_LE(norm(loads.torque[i] - expected.torque[i]), 1e-12 * radius * force) << "row " << i;
    }
  }
  // Half of it where no force was before, all of it from the second step on.
  EXPECT_NEAR(work.value(), .5 * dt * power, 1e-12 * dt * power);
  forces(with, &again);
  EXPECT_NEAR(again.value(), dt * power, 1e-12 * dt * power);
}

// The block of a break is computed twice in a step: forces of the others stay as they are to the bit, and
// what the first pass counted of the broken one is taken back.
class DashpotsOfBreaks : public BondDashpots {}; // interfaces are computed once
TEST_P(DashpotsOfBreaks, count_a_block_with_a_break_once) {
  Model model(packed_box(14, 14, 14), settings(.1));
  Particles &p = model.particles;
  Bonds &b = *model.bonds;
  set_in_motion(p);
  forces(model);
  const std::vector<Vector3> before(b.dashpot_force->begin(), b.dashpot_force->end());
  constexpr int broken = 100;
  Loads none{std::vector<Vector3>(p.size()), std::vector<Vector3>(p.size())};
  const double power = add_dashpot(p, b, broken, none);
  const std::vector<BondBreak> breaks{{broken, BondState::broken_in_tension}};
  b.break_rows(breaks, p, 0);
  const ExactSum work = undone_work_of_dashpots(p, b, dt, breaks);
  compute_bond_forces_again(p, b, best_instruction_set(), {},
                            static_cast<std::size_t>(b.first[broken]) / block_rows);
  EXPECT_NEAR(work.value(), -.5 * dt * power, 1e-12 * dt * power);
  for (int k = 0; k < static_cast<int>(b.size()); ++k) {
    const Vector3 expected = k == broken ? Vector3{} : before[k], now = (*b.dashpot_force)[k];
    ASSERT_TRUE(now.x == expected.x && now.y == expected.y && now.z == expected.z) << "row " << k;
  }
}

const auto name_of = [](const auto &one) { return std::string(one.param.name); };
const Case whole[] = {
    {"parallel_bonds", false, false, false}, {"turning", true, false, false}, {"bending", true, true, false}};
INSTANTIATE_TEST_SUITE_P(bonds, DashpotsOfBreaks, testing::ValuesIn(whole), name_of);
INSTANTIATE_TEST_SUITE_P(bonds, BondDashpots, testing::ValuesIn(whole), name_of);
INSTANTIATE_TEST_SUITE_P(interfaces, BondDashpots,
                         testing::Values(Case{"interfaces", false, false, true},
                                         Case{"turning_interfaces", true, false, true},
                                         Case{"bending_cohesive", true, true, true}),
                         name_of);

// Onate's dashpot: 2 gamma alpha r_c / |D| of critical, alpha r_c^2 the square of the bond's radius, along
// the normal alone; other bonds take gamma itself.
TEST(bond_history, dashpots_are_the_share_of_critical_that_their_law_says) {
  constexpr double gamma = .3, large = 2 * radius;
  for (const bool by_range : {true, false}) {
    ModelSettings settings = by_range ? interfaces() : bonded();
    settings.bond_dashpot = gamma;
    const double distance = (by_range ? 1.05 : 1.) * (radius + large);
    Specimen s = spheres({{0, 0, 0}, {distance, 0, 0}});
    s.radius = {radius, large};
    const Model model(s, settings);
    const Particles &p = model.particles;
    const Bonds &b = *model.bonds;
    ASSERT_EQ(b.size(), 1u);
    const double section = pi * b.bond_radius[0] * b.bond_radius[0],
                 critical = 2 * std::sqrt(b.normal_stiffness[0] * section * p.mass[0] * p.mass[1] /
                                          (p.mass[0] + p.mass[1])),
                 share = by_range ? gamma * b.bond_radius[0] * b.bond_radius[0] / (radius * distance) : gamma;
    EXPECT_NEAR((*b.dashpot)[0], share * critical, 1e-12 * critical) << by_range;
    EXPECT_NEAR(b.dashpot_shear_ratio, by_range ? 0 : std::sqrt(stiffness_ratio), 1e-12) << by_range;
  }
}

// Memory that a model says it takes, by what it has.
TEST(bond_history, memory_is_that_of_spheres_bonds_and_contacts) {
  const Specimen specimen = row(9, {1, 0, 0});
  ModelSettings neither = breakable();
  neither.contact.reset();
  const ModelSettings with_bonds = neither, with_both = breakable();
  neither.bond.reset();
  const Model alone(specimen, neither), bonds(specimen, with_bonds), both(specimen, with_both);
  EXPECT_GE(alone.bytes(), 10 * 9 * sizeof(double)); // places, velocities, forces
  EXPECT_EQ(bonds.bytes() - alone.bytes(), bonds.bonds->bytes());
  EXPECT_GE(bonds.bonds->bytes(), 9 * 8 * sizeof(double));
  EXPECT_EQ(both.bytes() - bonds.bytes(), both.contacts->table.size() * both.contacts->table.bytes_per_row() +
                                              both.contacts->search_state().bytes());
}

// The pair spins about its line by a radian, as one: shear goes round with it, the right way.
TEST(bond_history, shear_of_a_cohesive_bond_spins_with_the_pair) {
  ElastoDamagePlastic::Parameters p;
  p.poisson_ratio = .2;
  const ElastoDamagePlastic law(p); // never breaks
  const double length = .01, aside = 1e-6;
  const CohesiveGeometry<double> geometry{length, .5, 28e9 / length, 5e-5};
  const Triple<double> distance{0, 0, length}, none{0, 0, 0};
  for (const double angle : {1., -1., 2.}) {
    CohesiveState<double> state{0, 0, 0, {aside, 0, 0}, {0, 0, 0}, 0};
    const double before = law.response(state, geometry, distance).shear.x;
    CohesiveResponse<double> now{};
    constexpr int steps = 1000; // Cayley's form is off by a twelfth of the cube of an angle
    for (int k = 0; k < steps; ++k)
      now = law(state, geometry, {distance, none, none, angle / steps * length});
    EXPECT_NEAR(now.shear.x / before, std::cos(angle), 1e-6) << angle;
    EXPECT_NEAR(now.shear.y / before, std::sin(angle), 1e-6) << angle; // from x to y about z
  }
}

// Bonds that carry forces alone store nothing where a sphere turns on the spot but what their shear takes:
// the loop that sums them up says the same as the law.
TEST(bond_history, bonds_without_moments_store_no_bending) {
  ModelSettings settings = bonded();
  parallel_bond(settings).moments = false;
  Model model(row(6, {1, 0, 0}), settings);
  Particles &p = model.particles;
  for (std::size_t i = 0; i < p.size(); ++i) // a twist that grows along the row: no contact point moves
    (*p.orientation)[i] = rotation_quaternion({1e-3 * p.reference_position[i].x / radius, 0, 0});
  EXPECT_LT(bond_energy(p, *model.bonds), 1e-12 * modulus * radius * radius * radius * 1e-6);
  for (std::size_t i = 0; i < p.size(); ++i)
    p.position[i].y = 1e-3 * radius * std::sin(static_cast<double>(i));
  double sum = 0;
  for (std::size_t k = 0; k < model.bonds->size(); ++k)
    sum += model.bonds->response(k, p).energy;
  EXPECT_NEAR(bond_energy(p, *model.bonds), sum, 1e-12 * sum);
}

} // namespace
} // namespace platen::dem::bond_dashpots_test
