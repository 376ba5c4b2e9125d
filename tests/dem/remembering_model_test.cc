// Specimens of bonds that remember, by every such law: the kernels and the ledger's sums against the law, and
// the energy balance.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "base/parallel.h"
#include "base/state.h"
#include "dem/packing/advancing_front.h"
#include "tests/dem/broken_specimens.h"
#include "tests/dem/one_bond.h"

namespace platen::dem::remembering_model_test {
namespace {

using namespace examples;

struct LawCase {
  const char *name;
  ModelSettings (*settings)();
  double speed, rate;  // m/s, 1/s: of what shakes it to pieces
  double coarse, fine; // share of what a block has at first that its energy balance may miss
  double plastic;      // share of it, at least, that yield takes
  double weibull = 3;  // modulus of scattered strengths; facets must stay ductile
};
void PrintTo(const LawCase &law, std::ostream *out) {
  *out << law.name;
}
const LawCase laws[] = {{"interfaces", interfaces, 2, 600, 2e-2, 1.5e-3, .01},
                        {"bending_interfaces", bending_interfaces, 1.5, 600, 2e-2, 2e-3, 0},
                        {"yielding_parallel_bonds", yielding_bonds, 2, 900, 2e-2, 1.5e-3, .001},
                        {"facets", facets, 2, 900, 2e-2, 2e-3, .001, 60}};

bool needs_orientations(const ElastoDamagePlastic &law) {
  return law.parameters.moments;
}
template <class Law>
bool needs_orientations(const Law &) {
  return Law::needs_orientations;
}
CohesiveGeometry<double> geometry(const Bonds &b, std::size_t k) {
  return {b.rest_length[k],
          b.lever[k],
          b.normal_stiffness[k],
          pi * b.bond_radius[k] * b.bond_radius[k],
          1.0,
          triple(b.reference[k]),
          b.bond_radius[k]};
}
// With the arms in the middle of the step, where the law needs orientations.
CohesiveMotion<double> motion(const Particles &p, const Bonds &b, std::size_t k, double dt, bool in_middle) {
  const auto i = static_cast<std::size_t>(b.first[k]), j = static_cast<std::size_t>(b.second[k]);
  const Vector3 d = p.position[j] - p.position[i], v = p.velocity[j] - p.velocity[i];
  CohesiveMotion<double> m{triple(d), triple(dt * v), triple(dt * v), 0, {1, 0, 0, 0}, {1, 0, 0, 0}, {}, {}};
  if (!p.has_rotation()) return m;
  const Vector3 wi = (*p.angular_velocity)[i], wj = (*p.angular_velocity)[j];
  const Vector3 arm = in_middle ? d - 0.5 * dt * v : d;
  m.moved = triple(dt * (v + cross(wj, (b.lever[k] - 1) * arm) - cross(wi, b.lever[k] * arm)));
  m.spun_along = 0.5 * dt * dot(wi + wj, d);
  m.turn_i = rotation((*p.orientation)[i]), m.turn_j = rotation((*p.orientation)[j]);
  m.turned_i = triple(dt * wi), m.turned_j = triple(dt * wj);
  return m;
}

// In every block fewer than eight of `these` rows stand before others.
template <class These>
void expect_last_in_blocks(const Bonds &b, const These &these) {
  for (std::size_t block = 0; block < b.blocks.blocks(); ++block) {
    int before_others = 0, all = 0;
    for (std::size_t k = b.blocks.first_pair[block]; k < b.blocks.first_pair[block + 1]; ++k)
      if (these(k))
        ++all;
      else
        before_others = all;
    EXPECT_LT(before_others, 8) << "block " << block << ", of " << all;
  }
}

// As soon as they have failed or are damaged: in every block all but a few of those that failed stand behind
// all others, and of facets those that are damaged behind all that are sound; no bond was lost.
void expect_rows_in_order(const Bonds &b) {
  std::vector<int> seen(b.initial_count(), 0);
  for (std::size_t k = 0; k < b.size(); ++k) {
    const int record = b.record[k];
    ++seen[record];
    ASSERT_EQ(b.first[k], b.record_first[record]) << "row " << k;
    ASSERT_EQ(b.second[k], b.record_second[record]) << "row " << k;
  }
  EXPECT_EQ(std::count(seen.begin(), seen.end(), 1), static_cast<std::ptrdiff_t>(seen.size()));
  expect_last_in_blocks(b, [&b](std::size_t k) { return b.has_failed(k); });
  if (std::holds_alternative<FacetBond>(b.law))
    expect_last_in_blocks(b, [&b](std::size_t k) { return b.damage(k) > 0; });
}

// Row by row, from what each remembers.
BondTotals by_rows(const Particles &p, const Bonds &b) {
  BondTotals sum;
  for (std::size_t k = 0; k < b.size(); ++k) {
    const BondResponse<double> r = b.response(k, p);
    sum.energy += r.energy;
    sum.force += root(dot(r.force, r.force));
    of_remembering(b.law, [&](const auto &law) {
      const auto s = b.memory<typename std::decay_t<decltype(law)>::template State<double>>(k);
      CohesiveGeometry<double> g{b.rest_length[k], b.lever[k], b.normal_stiffness[k],
                                 pi * b.bond_radius[k] * b.bond_radius[k]};
      (law.damage_of(s) >= 1 ? sum.friction : sum.damage) += s.dissipated;
      sum.plastic += law.plastic_work(s, g);
    });
  }
  return sum;
}

// Rows of the first block in their order, by record.
std::vector<int> first_block(const Bonds &b) {
  return {b.record.begin(), b.record.begin() + static_cast<std::ptrdiff_t>(b.blocks.first_pair[1])};
}
void set_damage(Bonds &b, std::size_t row, double damage) {
  auto remembered = b.memory<FacetBond::State<double>>(row);
  remembered.damage = damage;
  b.set_memory(row, remembered);
}

TEST(row_order, a_block_is_sorted_when_eight_rows_stand_before_those_of_another_kind) {
  Cylinder c(*facets().bond);
  Bonds &b = c.bonds;
  std::vector<int> expected = first_block(b);
  ASSERT_GT(expected.size(), 60u);
  for (const double damage : {.5, 1.}) { // damaged rows go behind sound ones, failed rows behind both
    for (std::size_t n = 0; n < 7; ++n)
      set_damage(b, 2 * n, damage);
    b.look_at_order(0), b.order_rows();
    EXPECT_EQ(first_block(b), expected) << damage;
    set_damage(b, 14, damage);
    for (std::size_t n = 8; n-- > 0;)
      expected.erase(expected.begin() + 2 * static_cast<std::ptrdiff_t>(n));
    for (std::size_t n = 0; n < 8; ++n)
      expected.push_back(b.record[2 * n]);
    b.look_at_order(0), b.order_rows();
    EXPECT_EQ(first_block(b), expected) << damage;
    for (std::size_t n = 0; n < 8; ++n)
      EXPECT_EQ(b.damage(expected.size() - 8 + n), damage);
  }
  b.count_and_cut(); // as after a restart: nothing is in disorder
  b.order_rows();
  EXPECT_EQ(first_block(b), expected);
  for (const std::size_t row : {0u, 1u}) // two more of each kind before others: too few
    set_damage(b, row, row == 0 ? .5 : 1);
  b.count_and_cut(), b.order_rows();
  EXPECT_EQ(first_block(b), expected);
}

// Stretched until facets soften; none fails.
TEST(row_order, rows_are_sorted_as_soon_as_they_are_damaged) {
  ModelSettings tough = facets();
  std::get<FacetBond::Parameters>(*tough.bond).fracture_energy = 20;
  Model model(packed_box(12, 12, 12), tough);
  Particles &p = model.particles;
  const double dt = .3 * model.stable_step({}, 0).limit;
  for (std::size_t i = 0; i < p.size(); ++i)
    p.velocity[i] = (2.5e-4 / (20 * dt)) * p.position[i];
  step(model, dt, 21);
  const Bonds &b = *model.bonds;
  std::size_t damaged = 0;
  for (std::size_t k = 0; k < b.size(); ++k)
    damaged += b.damage(k) > 0;
  EXPECT_EQ(b.failed_rows, 0u);
  EXPECT_GT(damaged, 100u);
  EXPECT_LT(damaged, b.size() - 100);
  model.begin_step(dt);
  expect_last_in_blocks(b, [&b](std::size_t k) { return b.damage(k) > 0; });
}

// By law; with rotation; with strengths of their own.
class RememberingKernels : public testing::TestWithParam<std::tuple<LawCase, bool, bool>> {
protected:
  // 60 steps, beside them each bond by the law alone; what the model remembers then is what the law does.
  // Round-off of positions, eps times some centimetres, over limits of some micrometres: 1e-11.
  template <class Law>
  static void follow(Model &model, const Law &law, double dt) {
    using State = typename Law::template State<double>;
    const Bonds &b = *model.bonds;
    const bool scattered = std::get<2>(GetParam());
    std::vector<State> states(b.size(), State{});
    for (int s = 0; s < 60; ++s) {
      model.begin_step(dt);
      for (std::size_t k = 0; k < b.size() && !scattered; ++k)
        act(law, states[b.record[k]], geometry(b, k),
            motion(model.particles, b, k, dt, needs_orientations(law)));
      model.compute_forces(dt);
      model.end_step(dt);
    }
    std::size_t yielded = 0, damaged = 0, failed = 0;
    for (std::size_t k = 0; k < b.size(); ++k) {
      const State own = b.memory<State>(k), &s = scattered ? own : states[b.record[k]];
      ASSERT_NEAR(law.damage_of(own), law.damage_of(s), 1e-8) << "row " << k;
      ASSERT_NEAR(own.plastic, s.plastic, 1e-8 * 20e6) << "row " << k;
      ASSERT_LE(norm(vector(own.slider - s.slider)), 1e-9 * radius) << "row " << k;
      ASSERT_LE(norm(vector(shear_of(own) - shear_of(s))), 1e-9 * radius) << "row " << k;
      yielded += s.plastic > 0;
      damaged += law.damage_of(s) > 0 && law.damage_of(s) < 1;
      failed += law.damage_of(s) >= 1;
    }
    EXPECT_EQ(b.failed_rows, failed); // none is missed in the step in which it fails, wherever it stands
    EXPECT_GT(failed, 20u);
    EXPECT_GT(yielded, 20u);
    if constexpr (std::is_same_v<Law, YieldingParallelBond>) {
      EXPECT_GT(model.broken_tension, 50);
      EXPECT_GT(model.broken_shear, 5);
    } else {
      EXPECT_GT(damaged, 1u);
    }
  }

private:
  static Triple<double> shear_of(const CohesiveState<double> &s) { return s.shear; }
  static Triple<double> shear_of(const YieldingParallelBond::State<double> &s) { return s.slider; }
  static Triple<double> shear_of(const FacetBond::State<double> &s) { return s.slip; }
};

TEST_P(RememberingKernels, and_sums_follow_the_law_on_every_instruction_set_and_any_threads) {
  const auto &[of, rotation, scattered] = GetParam();
  for (const InstructionSet set : instruction_sets_here()) {
    SCOPED_TRACE(name(set));
    ModelSettings settings = of.settings();
    settings.rotation = rotation;
    settings.instruction_set = set;
    if (scattered) settings.strength_scatter = StrengthScatter{of.weibull, 1};
    // Of unequal spheres, so that both ends of a bond differ.
    Model model(
        advancing_front(box(15 * radius, 15 * radius, 15 * radius), two_radii(.8 * radius, radius, .5), 1),
        settings);
    Particles &p = model.particles;
    Bonds &b = *model.bonds;
    ASSERT_NE(b.size() % 8, 0u); // a last pack that is not full
    shake(p, 2.0, of.rate);
    const double dt = .3 * model.stable_step({}, 0).limit;
    of_remembering(b.law, [&](const auto &law) { follow(model, law, dt); });

    const BondTotals rows = by_rows(p, b);
    EXPECT_GT(rows.friction, 0);
    EXPECT_GT(rows.plastic, 0);
    using Sum = double BondTotals::*;
    const BondTotals totals = bond_totals(p, b, set);
    for (const Sum sum : {&BondTotals::energy, &BondTotals::force, &BondTotals::damage, &BondTotals::friction,
                          &BondTotals::plastic}) {
      EXPECT_NEAR(totals.*sum, rows.*sum, 1e-11 * rows.*sum);
      for (const int threads : {1, 2, 4}) {
        const ThreadLimit limit(threads);
        EXPECT_EQ(bond_totals(p, b, set).*sum, totals.*sum) << threads;
      }
    }
    // The next forces, sphere by sphere.
    model.begin_step(dt); // sorts rows too
    if (!std::holds_alternative<ElastoDamagePlastic>(b.law)) expect_rows_in_order(b);
    std::vector<BondBreak> breaks;
    compute_cohesive_forces(p, b, set, {}, dt, breaks);
    for (std::size_t block = 0; block < b.blocks.blocks(); ++block)
      return_ghosts(p, b.blocks, block);
    const Loads by_law = bond_loads(p, b);
    double force = 0;
    for (const Vector3 &f : by_law.force)
      force = std::max(force, norm(f));
    for (std::size_t i = 0; i < p.size(); ++i) {
      ASSERT_LT(norm(p.force[i] - by_law.force[i]), 1e-10 * force) << i;
      if (rotation) {
        ASSERT_LT(norm((*p.torque)[i] - by_law.torque[i]), 1e-10 * force * radius) << i;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(laws, RememberingKernels,
                         testing::Combine(testing::ValuesIn(laws), testing::Bool(), testing::Bool()));

class RememberingModel : public testing::TestWithParam<LawCase> {};

// A free block shakes itself to pieces, at a quarter and at a sixteenth of the largest step. What it had at
// first is stored, or counted as loss.
TEST_P(RememberingModel, the_energy_balance_of_a_breaking_block_closes) {
  const LawCase &law = GetParam();
  for (const int finer : {1, 4}) {
    SCOPED_TRACE(finer);
    Model model(packed_box(16, 16, 16), law.settings());
    shake(model.particles, law.speed, law.rate);
    const double start = model.energy().stored(), dt = .25 / finer * model.stable_step({}, 0).limit;
    step(model, dt, 400 * finer);
    const std::size_t failed = model.bonds->failed_rows;
    EXPECT_GT(failed, 20u);
    EXPECT_EQ(model.broken_tension + model.broken_shear, static_cast<long>(failed));
    EXPECT_EQ(model.intact_bonds() + failed, model.bonds->initial_count());
    const EnergyLedger energy = model.energy();
    EXPECT_GT(energy.fracture, .01 * start);
    EXPECT_GT(energy.friction, 0);
    EXPECT_GE(energy.plastic, law.plastic * energy.residual());
    // Of random motion, whose kinetic energy at whole steps is off by the square of the step.
    EXPECT_LT(std::abs(energy.residual() - start), (finer == 1 ? law.coarse : law.fine) * start);
  }
}

INSTANTIATE_TEST_SUITE_P(laws, RememberingModel, testing::ValuesIn(laws),
                         [](const testing::TestParamInfo<LawCase> &law) { return law.param.name; });

// sigma_t^2 L/(2 E) is what the bond of two touching spheres holds at its strength: 0.743 J/m2.
TEST(FacetModel, a_bond_that_would_be_brittle_is_refused_by_name_with_the_size_that_would_do) {
  ModelSettings settings = facets();
  const auto refusal = [&](double energy) {
    std::get<FacetBond::Parameters>(*settings.bond).fracture_energy = energy;
    try {
      const Model model(spheres({{0, 0, 0}, {0, 0, 2 * radius}}), settings);
    } catch (const BadParameter &e) {
      return std::string(e.what());
    }
    return std::string();
  };
  const double held = 4e6 * 4e6 * 2 * radius / (2 * 28e9);
  EXPECT_EQ(refusal(1.001 * held), "");
  EXPECT_EQ(refusal(0), ""); // brittle as it is asked
  const std::string told = refusal(0.5 * held);
  EXPECT_NE(told.find("of the bond between spheres 0 and 1, 0.0026 m long"), std::string::npos) << told;
  EXPECT_NE(told.find("Allowed: > " + text_of(held) + " J/m2, or spheres of a mean radius below 0.00065 m."),
            std::string::npos)
      << told;
}

// Shaken until some bonds have failed.
TEST(CohesiveModel, interfaces_that_bend_differ_from_those_that_do_not) {
  const auto shaken_to_pieces = [](ModelSettings settings) {
    settings.bond_dashpot = .1;
    Model model(packed_box(26, 26, 26), settings);
    shake(model.particles, 1.5);
    step(model, .5 * model.stable_step({}, 0).limit, 120);
    EXPECT_GT(model.bonds->failed_rows, 50u);
    EXPECT_GT(model.bonds->blocks.blocks(), 3u);
    std::vector<double> places;
    for (const Vector3 &x : model.particles.position)
      places.insert(places.end(), {x.x, x.y, x.z});
    return places;
  };
  EXPECT_NE(shaken_to_pieces(interfaces()), shaken_to_pieces(bending_interfaces()));
}

// Broken rows that stand apart are passed over, those that touch are not: the same specimen with its rows as
// they were bonded feels the same forces but for the order of sums.
TEST(YieldingModel, the_order_of_rows_changes_forces_by_round_off_alone) {
  Model model(packed_box(15, 15, 15), yielding_bonds());
  shake(model.particles, 2.0, 900);
  const double dt = .3 * model.stable_step({}, 0).limit;
  step(model, dt, 60);
  ASSERT_GT(model.bonds->failed_rows, 200u);
  const auto forces = [&](bool as_bonded) {
    Model copy(packed_box(15, 15, 15), yielding_bonds());
    set_state(copy, state_of(model));
    if (as_bonded) {
      std::vector<int> order(copy.bonds->size());
      for (std::size_t k = 0; k < order.size(); ++k)
        order[static_cast<std::size_t>(copy.bonds->record[k])] = static_cast<int>(k);
      copy.bonds->table.permute(order);
      copy.bonds->count_and_cut();
    }
    std::vector<BondBreak> breaks;
    compute_cohesive_forces(copy.particles, *copy.bonds, InstructionSet::baseline, {}, dt, breaks);
    return std::vector<Vector3>(copy.particles.force.begin(), copy.particles.force.end());
  };
  const std::vector<Vector3> ordered = forces(false), as_bonded = forces(true);
  double largest = 0;
  for (const Vector3 &f : as_bonded)
    largest = std::max(largest, norm(f));
  ASSERT_GT(largest, 0);
  for (std::size_t i = 0; i < ordered.size(); ++i)
    ASSERT_LE(norm(ordered[i] - as_bonded[i]), 1e-12 * largest) << "particle " << i;
}

TEST(CohesiveModel, the_interaction_range_bonds_across_gaps) {
  const double reach = 2 * radius * 1.1;
  const Specimen pair = spheres({{0, 0, 0}, {0, 0, reach * (1 - 1e-9)}, {0, reach * (1 + 1e-9), 0}});
  Model model(pair, interfaces());
  ASSERT_EQ(model.bonds->size(), 1u);
  EXPECT_DOUBLE_EQ(model.bonds->normal_stiffness[0], 28e9 / model.bonds->rest_length[0]);
  EXPECT_NEAR(model.bonds->rest_length[0], reach, 1e-8 * reach);
}

// A spinning body stores nothing and loses nothing.
TEST(CohesiveModel, a_spinning_block_stores_no_energy) {
  ModelSettings settings = interfaces();
  settings.contact.reset();
  Model model(packed_box(8, 8, 8), settings);
  Particles &p = model.particles;
  const Vector3 spin{120, -80, 200};
  Vector3 centre;
  for (std::size_t i = 0; i < p.size(); ++i)
    centre += p.position[i] / static_cast<double>(p.size());
  const double dt = .05 * model.stable_step({}, 0).limit;
  for (std::size_t i = 0; i < p.size(); ++i) {
    p.velocity[i] = cross(spin, p.position[i] - centre);
    (*p.angular_velocity)[i] = spin;
  }
  step(model, dt, 20000);
  const EnergyLedger e = model.energy();
  EXPECT_LT(e.bonds, 1e-3 * e.kinetic); // the stretch of a spinning body, (w r)^2 rho / E
  double shear = 0;
  for (std::size_t k = 0; k < model.bonds->size(); ++k) {
    const Triple<double> u = model.bonds->memory<CohesiveState<double>>(k).shear;
    shear = std::max(shear, root(dot(u, u)));
  }
  EXPECT_LT(shear, 1e-5 * radius);
  EXPECT_EQ(model.bonds->failed_rows, 0u);
}

} // namespace
} // namespace platen::dem::remembering_model_test
