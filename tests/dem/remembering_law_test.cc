// What every law of a bond that remembers has to be: one bond with prescribed motion. How a displacement in
// the plane of a contact goes along with it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/pi.h"
#include "base/random.h"
#include "dem/laws/cohesive_form.h"
#include "dem/laws/rotating_plane.h"
#include "tests/dem/examples.h"
#include "tests/dem/one_yielding_bond.h"

namespace platen::dem::remembering_law_test {
namespace {

using namespace examples;

constexpr double young = one_yielding_bond::modulus, length = one_yielding_bond::length;
constexpr double stiffness = young / length; // k_n, Pa/m

// `stronger`: strengths are multiplied by it, energies of fracture are not.
struct Interface {
  static constexpr bool brittle = false;
  static constexpr double closes = 1e-4; // what the energy balance may miss of the largest energy
  static ElastoDamagePlastic::Parameters parameters(double stronger) {
    ElastoDamagePlastic::Parameters p = cohesive_bond_of_concrete();
    p.fracture_energy_tension = 2, p.fracture_energy_shear = 20;
    p.tensile_strength *= stronger, p.shear_strength *= stronger;
    return p;
  }
  struct Bond : OneBond<ElastoDamagePlastic> {
    explicit Bond(const ElastoDamagePlastic::Parameters &p) : OneBond(p, young, length, 1.4e-3) {}
  };
};
struct BendingInterface : Interface {
  static ElastoDamagePlastic::Parameters parameters(double stronger) {
    ElastoDamagePlastic::Parameters p = Interface::parameters(stronger);
    p.moments = true, p.moment_contribution = .5;
    return p;
  }
};
struct Yielding {
  static constexpr bool brittle = true;
  static constexpr double closes = 4e-9;
  static YieldingParallelBond::Parameters parameters(double stronger) {
    YieldingParallelBond::Parameters p = one_yielding_bond::concrete();
    p.tensile_strength *= stronger, p.shear_strength *= stronger;
    return p;
  }
  using Bond = one_yielding_bond::Bond;
};
struct Facet {
  static constexpr bool brittle = false;
  static constexpr double closes = 2e-5;
  static FacetBond::Parameters parameters(double stronger) {
    FacetBond::Parameters p = std::get<FacetBond::Parameters>(*facets().bond);
    p.fracture_energy = 3, p.moment_stiffness = .1;
    p.tensile_strength *= stronger, p.shear_strength *= stronger;
    return p;
  }
  struct Bond : OneBond<FacetBond> {
    explicit Bond(const FacetBond::Parameters &p) : OneBond(FacetBond(p), young, length, 1.4e-3) {}
  };
};

template <class Of>
class RememberingLaw : public testing::Test {
protected:
  using Bond = typename Of::Bond;
  Random random{11};
  static Bond bond(double stronger = 1) {
    Bond made(Of::parameters(stronger));
    made.geometry.lever = .4;
    return made;
  }
  // Pulled by so much of what its strength is reached at, then pressed, sheared, bent and twisted a little.
  static Bond loaded(double pulled) {
    Bond made = bond();
    const double limit = made.law.parameters.tensile_strength / stiffness;
    made.move({0, 0, pulled * limit}, {}, {}, 400);
    made.move({0, 0, -(pulled + 3) * limit}, {}, {}, 400);
    made.move({.5 * limit, -.3 * limit, 0}, {1e-4, 2e-5, -3e-5}, {-2e-5, 1e-4, 2e-5}, 50);
    return made;
  }
  Triple<double> any(double size) {
    return {random.uniform(-size, size), random.uniform(-size, size), random.uniform(-size, size)};
  }
  // Some times the way to the strength in any direction, and turned.
  void move_somewhere(Bond &of, double wide, int steps) {
    const double way = wide * of.law.parameters.tensile_strength / stiffness;
    const Triple<double> by = any(way), turn_i = any(way / length), turn_j = any(way / length);
    of.move(by, turn_i, turn_j, steps);
  }
};
struct LawNames {
  template <class Of>
  static std::string GetName(int) {
    return std::is_same_v<Of, Interface>          ? "interface"
           : std::is_same_v<Of, BendingInterface> ? "bending_interface"
           : std::is_same_v<Of, Yielding>         ? "yielding_parallel_bond"
                                                  : "facet";
  }
};
using RememberingLaws = testing::Types<Interface, BendingInterface, Yielding, Facet>;
TYPED_TEST_SUITE(RememberingLaw, RememberingLaws, LawNames);

void expect_near(const Triple<double> &found, const Vector3 &wanted, double within) {
  EXPECT_LT(norm(vector(found) - wanted), within) << norm(wanted);
}

// Intact, damaged or broken, and failed.
TYPED_TEST(RememberingLaw, turned_as_one_keeps_its_energy_and_its_forces_turn_along) {
  for (const double pulled : {.5, 1.1, 300.}) {
    SCOPED_TRACE(pulled);
    auto bond = this->loaded(pulled);
    EXPECT_EQ(bond.law.damage_of(bond.state) > 0, pulled > 1);
    EXPECT_EQ(bond.law.damage_of(bond.state) == 1, pulled > (TypeParam::brittle ? 1 : 2));
    const auto before = bond.now;
    const double normal = bond.normal(), shear = bond.shear(), lost = bond.state.dissipated;
    ASSERT_GT(shear, 1e-2 * std::abs(normal));
    const Vector3 turn{3, -2, 2.5}; // rad
    bond.turn_rigidly(turn, 10000);
    EXPECT_NEAR(bond.normal(), normal, 1e-9 * std::abs(normal));
    EXPECT_NEAR(bond.shear(), shear, 1e-9 * std::abs(normal));
    EXPECT_NEAR(bond.now.energy, before.energy, 1e-9 * before.energy);
    EXPECT_NEAR(bond.state.dissipated, lost, 1e-9 * before.energy);
    const Quaternion whole = rotation_quaternion(turn);
    const double force = norm(vector(before.force));
    expect_near(bond.now.force, rotate(whole, vector(before.force)), 1e-6 * force);
    expect_near(bond.now.torque_i, rotate(whole, vector(before.torque_i)), 1e-6 * force * length);
    expect_near(bond.now.torque_j, rotate(whole, vector(before.torque_j)), 1e-6 * force * length);
  }
}

TYPED_TEST(RememberingLaw, that_has_failed_acts_at_the_point_of_contact_alone) {
  const auto bond = this->loaded(300);
  const Vector3 moment = cross(vector(bond.pose.distance), vector(bond.now.force));
  ASSERT_GT(norm(moment), 0);
  expect_near(bond.now.torque_i, .4 * moment, 1e-12 * norm(moment));
  expect_near(bond.now.torque_j, .6 * moment, 1e-12 * norm(moment));
}

// Through yield, damage, failure, slip and separation: moments balance, what is told is what acts, and what
// goes in is stored or lost, but for third powers of a step.
TYPED_TEST(RememberingLaw, balances_forces_and_energy_on_any_path) {
  double worst[2] = {0, 0};
  for (const int fine : {0, 1}) {
    this->random = Random(7);
    int failed = 0, damaged = 0;
    for (int run = 0; run < 40; ++run) {
      auto bond = this->bond();
      double largest = 0;
      for (int k = 0; k < 60; ++k) {
        const double yielded = bond.plastic();
        this->move_somewhere(bond, run % 2 ? 1 : 5, fine ? 1000 : 100);
        EXPECT_GE(bond.plastic(), yielded);
        largest = std::max({largest, bond.now.energy, std::abs(bond.whole_work())});
        const Triple<double> lever = cross(bond.pose.distance, bond.now.force);
        const double force = norm(vector(bond.now.force)) +
                             bond.law.parameters.tensile_strength * bond.geometry.area,
                     torque =
                         norm(vector(bond.now.torque_i)) + norm(vector(bond.now.torque_j)) + force * length;
        expect_near(bond.now.torque_i + bond.now.torque_j, vector(lever), 1e-12 * torque);
        const BondResponse<double> told = bond.law.bond_response(bond.state, bond.geometry, bond.pose);
        const ForceAndEnergy<double> held = examples::force_and_energy(
            bond.law, bond.state, bond.geometry, {bond.pose.distance, bond.pose.turn_i, bond.pose.turn_j});
        expect_near(told.force, vector(bond.now.force), 1e-10 * force);
        expect_near(held.force, vector(bond.now.force), 1e-10 * force);
        expect_near(told.torque_i, vector(bond.now.torque_i), 1e-10 * torque);
        expect_near(told.torque_j, vector(bond.now.torque_j), 1e-10 * torque);
        EXPECT_NEAR(told.normal_force, bond.now.normal, 1e-10 * force);
        EXPECT_NEAR(told.energy, bond.now.energy, 1e-10 * largest);
        EXPECT_NEAR(held.energy, bond.now.energy, 1e-10 * largest);
        ASSERT_FALSE(testing::Test::HasFailure()) << run << ", " << k;
      }
      worst[fine] = std::max(worst[fine], std::abs(bond.whole_work() - bond.balance()) / largest);
      failed += bond.law.damage_of(bond.state) == 1, damaged += bond.law.damage_of(bond.state) > 0;
    }
    EXPECT_GT(failed, 3);
    EXPECT_GT(damaged, 5);
  }
  EXPECT_LT(worst[1], TypeParam::closes);
  EXPECT_LT(worst[1], .3 * worst[0]);
}

// Of both strengths; energies of fracture and friction stay.
TYPED_TEST(RememberingLaw, a_strength_factor_is_that_of_a_stronger_bond) {
  double most = 0;
  for (int run = 0; run < 20; ++run) {
    auto factored = this->bond(), stronger = this->bond(1.5);
    factored.geometry.strength_factor = 1.5;
    for (int k = 0; k < 30; ++k) {
      this->random = Random(static_cast<std::uint64_t>(100 * run + k));
      this->move_somewhere(factored, run % 2 ? 1.5 : 6, 20);
      this->random = Random(static_cast<std::uint64_t>(100 * run + k));
      this->move_somewhere(stronger, run % 2 ? 1 : 4, 20);
      const double force = norm(vector(stronger.now.force)) +
                           stronger.law.parameters.tensile_strength * stronger.geometry.area;
      ASSERT_LE(norm(vector(factored.now.force - stronger.now.force)), 1e-9 * force) << run << ", " << k;
      ASSERT_NEAR(factored.balance(), stronger.balance(), 1e-9 * stronger.balance()) << run << ", " << k;
    }
    most = std::max(most, factored.law.damage_of(factored.state));
  }
  EXPECT_EQ(most, 1);
}

// Stresses and the work that yield takes, by hand.
TYPED_TEST(RememberingLaw, closing_yields_along_three_branches_and_opens_with_the_modulus) {
  auto bond = this->bond();
  const std::vector<double> &limits = bond.law.parameters.compression_limits,
                            &slopes = bond.law.parameters.compression_slopes;
  ASSERT_EQ(limits.size(), 3u);
  double stress = 0, work = 0;                      // Pa, J
  const auto close = [&](double by, double slope) { // Pa, along a branch
    bond.move({0, 0, -by * slope / stiffness}, {}, {}, 7);
    work += bond.geometry.area / stiffness * (stress + .5 * by) * by * slope;
    stress += by;
    EXPECT_NEAR(bond.normal(), -stress, 1e-9 * limits[0]);
    EXPECT_NEAR(bond.work, work, 1e-9 * work);
    EXPECT_NEAR(bond.balance(), work, 1e-9 * work);
    EXPECT_NEAR(bond.now.energy, .5 * bond.geometry.area * stress * stress / stiffness, 1e-9 * work);
  };
  close(.5 * limits[0], 1), close(.5 * limits[0], 1);
  EXPECT_LT(bond.plastic(), 1e-12 * work);
  close(.5 * (limits[1] - limits[0]), slopes[0]), close(.5 * (limits[1] - limits[0]), slopes[0]);
  close(limits[2] - limits[1], slopes[1]);
  close(20e6, slopes[2]);
  const double taken = bond.plastic();
  close(-30e6, 1), close(30e6, 1); // and back
  EXPECT_NEAR(bond.plastic(), taken, 1e-12 * taken);
  close(10e6, slopes[2]);
  close(-stress, 1);
  const double pulled = .5 * bond.law.parameters.tensile_strength; // from the shifted zero
  bond.move({0, 0, pulled / stiffness});
  EXPECT_NEAR(bond.normal(), pulled, 1e-6 * pulled);
  EXPECT_EQ(bond.law.damage_of(bond.state), 0);
  EXPECT_EQ(bond.state.dissipated, 0);
}

using examples::vector;

// A pair that turns by up to 150 degrees and grows or shrinks by up to a third in one step, spins by up to a
// radian, and slips: what was in its plane turns by the least rotation, spins by the angle of Cayley's form,
// and gets of the slip what lies in the plane of now.
TEST(cohesive_plane, what_lies_in_it_turns_and_spins_along_and_slips_within_it) {
  Random random(11);
  const auto any = [&random] {
    return Vector3{random.uniform() - 0.5, random.uniform() - 0.5, random.uniform() - 0.5};
  };
  for (int n = 0; n < 3000; ++n) {
    Vector3 before, normal;
    do {
      before = any(), normal = any();
      before = before / norm(before), normal = normal / norm(normal);
    } while (dot(before, normal) < std::cos(150.0 / 180 * pi));
    const double distance = 3e-3 * (1 + (random.uniform() - 0.5) / 1.5),
                 spin = n % 3 ? random.uniform(-1, 1) : 0;
    const Vector3 v = any(), in_plane = 1e-6 * (v - dot(v, before) * before),
                  slip = n % 2 ? 1e-6 * any() : Vector3{};
    CohesiveMotion<double> m{};
    m.distance = triple(distance * normal), m.travelled = triple(distance * normal - 3e-3 * before);
    m.spun_along = spin * distance, m.moved = triple(slip);
    const PlaneMotion<double> plane(m, distance);
    EXPECT_LT(norm(vector(plane.n) - normal), 1e-14) << "turn " << n;
    const Vector3 turned = carry_with_plane(in_plane, before, normal);
    const double angle = 2 * std::atan(0.5 * spin);
    const Vector3 expected = std::cos(angle) * turned + std::sin(angle) * cross(normal, turned) + slip -
                             dot(slip, normal) * normal;
    EXPECT_LT(norm(vector(plane.carried(triple(in_plane))) - expected), 1e-13 * (norm(in_plane) + norm(slip)))
        << "turn " << n;
    // Of a move as far as the pair travels, too.
    m.moved = m.travelled;
    const Vector3 travelled = vector(m.travelled),
                  added = vector(PlaneMotion<double>(m, distance).carried(triple(Vector3{})));
    EXPECT_LT(norm(added - (travelled - dot(travelled, normal) * normal)), 1e-14 * 3e-3) << "turn " << n;
  }
}

// However far the plane turns in one go: by a right angle about the line that both planes share.
TEST(cohesive_plane, a_right_angle_turns_a_vector_of_it_exactly) {
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

} // namespace
} // namespace platen::dem::remembering_law_test
