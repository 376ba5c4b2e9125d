// Bonds of unlike strength: the distribution, who breaks first, and what does not change. Aggregates in a
// matrix: who is what, springs in series, and where cracks begin.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <ostream>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

#include "base/random.h"
#include "dem/heterogeneity.h"
#include "dem/measure/bond_network.h"
#include "tests/dem/examples.h"

namespace platen::dem::strength_scatter_test {
namespace {

using namespace examples;

ModelSettings scattered(double modulus_of_weibull, std::uint64_t seed = 1) {
  ModelSettings settings = breakable();
  settings.strength_scatter = StrengthScatter{modulus_of_weibull, seed};
  return settings;
}

// Kolmogorov's largest distance D between the drawn and the wanted distribution: sqrt(n) D stays below 1.63
// in 99 of 100 draws; the seed is fixed.
TEST(strength_scatter, follows_the_distribution) {
  for (const double m : {.8, 2.0, 8.0, 30.0}) {
    std::vector<double> s = weibull_factors(100000, {m, 7});
    const double n = static_cast<double>(s.size()), scale = 1 / std::tgamma(1 + 1 / m);
    const double mean = std::accumulate(s.begin(), s.end(), 0.0) / n;
    const double variance = std::tgamma(1 + 2 / m) * scale * scale - 1;
    EXPECT_NEAR(mean, 1, 3 * std::sqrt(variance / n)) << m;
    std::sort(s.begin(), s.end());
    EXPECT_GT(s.front(), 0);
    double most = 0;
    for (std::size_t k = 0; k < s.size(); ++k) {
      const double wanted = 1 - std::exp(-std::pow(s[k] / scale, m));
      most = std::max({most, wanted - static_cast<double>(k) / n, static_cast<double>(k + 1) / n - wanted});
    }
    EXPECT_LT(std::sqrt(n) * most, 1.63) << m;
  }
}

TEST(strength_scatter, gives_the_same_numbers_for_a_seed_and_others_for_another) {
  const std::vector<double> many = weibull_factors(1000, {8, 3}), few = weibull_factors(10, {8, 3});
  EXPECT_TRUE(std::equal(few.begin(), few.end(), many.begin()));
  EXPECT_NE(weibull_factors(10, {8, 4}), few);
  for (const double m : {0.0, -1.0, std::numeric_limits<double>::infinity(), std::nan("")})
    EXPECT_THROW(weibull_factors(1, {m, 1}), std::invalid_argument);
}

// Whatever the processor: three of a seed, to the bit, each step of the formula rounded once.
TEST(strength_scatter, gives_the_same_bits_everywhere) {
  const std::vector<double> of = weibull_factors(1000, {8, 3});
  EXPECT_EQ(of[0], 0x1.0e0a51933e3bdp+0);
  EXPECT_EQ(of[2], 0x1.d22cf41ffdd7ep-1);
  EXPECT_EQ(of[999], 0x1.c9e4850c1c4aap-1);
}

TEST(strength_scatter, that_is_off_has_no_column) {
  EXPECT_EQ(Model(row(3, {1, 0, 0}), breakable()).bonds->strength_factor, nullptr);
}

// A chain stretched evenly: all bonds bear the same stress, E times the strain.
TEST(strength_scatter, a_chain_breaks_at_its_smallest_factor) {
  Model model(row(37, {1, 2, -1}), scattered(6));
  Particles &p = model.particles;
  const Column<double> &factor = *model.bonds->strength_factor;
  const auto weakest = std::min_element(factor.begin(), factor.end());
  for (const InstructionSet set : instruction_sets_here())
    for (const double share :
         {1 - 1e-9, 1 + 1e-9}) { // of what it bears; strains of 1e-4 in positions of 1e-16
      for (std::size_t i = 0; i < p.size(); ++i)
        p.position[i] = (1 + share * *weakest * tensile_strength / modulus) * p.reference_position[i];
      std::vector<BondBreak> breaks;
      kernel_loads(p, *model.bonds, set, breaks);
      ASSERT_EQ(breaks.size(), share > 1 ? 1u : 0u) << name(set);
      if (share < 1) continue;
      EXPECT_EQ(breaks[0].row, weakest - factor.begin());
      EXPECT_EQ(breaks[0].mode, BondState::broken_in_tension);
    }
}

struct Law {
  const char *name;
  bool beams, rotation, moments;
  double strain; // at which some bonds of a block break and most do not
};
void PrintTo(const Law &law, std::ostream *to) {
  *to << law.name;
}

class ScatteredBonds : public testing::TestWithParam<Law> {
protected:
  static ModelSettings settings(double m) {
    const Law law = GetParam();
    ModelSettings s = scattered(m);
    if (law.beams) {
      CohesiveBeam::Parameters beam;
      beam.tensile_strength = tensile_strength, beam.shear_strength = shear_strength;
      s.bond = beam;
      return s;
    }
    s.rotation = law.rotation;
    parallel_bond(s).moments = law.moments;
    return s;
  }
};

// A chain stretched evenly: all bonds bear the same stress, E times the strain.
TEST_P(ScatteredBonds, of_a_chain_break_at_the_smallest_factor) {
  Model model(row(37, {1, 2, -1}), settings(6));
  Particles &p = model.particles;
  const Column<double> &factor = *model.bonds->strength_factor;
  const auto weakest = std::min_element(factor.begin(), factor.end());
  const auto stretch_to = [&](double share) { // of what the weakest bond bears
    for (std::size_t i = 0; i < p.size(); ++i)
      p.position[i] = (1 + share * *weakest * tensile_strength / modulus) * p.reference_position[i];
  };
  for (const InstructionSet set : instruction_sets_here()) {
    std::vector<BondBreak> breaks;
    stretch_to(1 - 1e-9); // strains of 1e-4 in positions of 1e-16
    kernel_loads(p, *model.bonds, set, breaks);
    EXPECT_TRUE(breaks.empty()) << name(set);
    stretch_to(1 + 1e-9);
    kernel_loads(p, *model.bonds, set, breaks);
    ASSERT_EQ(breaks.size(), 1u) << name(set);
    EXPECT_EQ(breaks[0].row, weakest - factor.begin());
    EXPECT_EQ(breaks[0].mode, BondState::broken_in_tension);
  }
}

// Loops and law agree on a block in which every kind of load is mixed, and forces know nothing of strengths.
TEST_P(ScatteredBonds, break_where_the_law_says) {
  Model model(packed_box(12, 12, 12), settings(3)), alike(packed_box(12, 12, 12), settings(3));
  std::fill(alike.bonds->strength_factor->begin(), alike.bonds->strength_factor->end(), 1.0);
  for (Model *one : {&model, &alike}) {
    Random random(3);
    for (std::size_t i = 0; i < one->particles.size(); ++i) {
      one->particles.position[i] += GetParam().strain * radius * random.direction();
      if (one->particles.has_rotation())
        (*one->particles.orientation)[i] = rotation_quaternion(GetParam().strain * random.direction());
    }
  }
  std::set<int> expected;
  for (std::size_t k = 0; k < model.bonds->size(); ++k) {
    const BondResponse<double> r = model.bonds->response(k, model.particles);
    if (r.tension_ratio >= 1 || r.shear_ratio >= 1) expected.insert(static_cast<int>(k));
  }
  EXPECT_GT(expected.size(), 20u);
  EXPECT_LT(expected.size(), model.bonds->size() / 2);
  for (const InstructionSet set : instruction_sets_here()) {
    std::vector<BondBreak> breaks, of_alike;
    const Loads loads = kernel_loads(model.particles, *model.bonds, set, breaks);
    std::set<int> found;
    for (const BondBreak &b : breaks)
      found.insert(b.row);
    EXPECT_EQ(found, expected) << name(set);
    const Loads plain = kernel_loads(alike.particles, *alike.bonds, set, of_alike);
    EXPECT_NE(of_alike.size(), breaks.size());
    for (std::size_t i = 0; i < loads.force.size(); ++i)
      ASSERT_EQ(norm(loads.force[i] - plain.force[i]), 0) << name(set);
  }
}

INSTANTIATE_TEST_SUITE_P(strength_scatter, ScatteredBonds,
                         testing::Values(Law{"parallel_bonds", false, true, true, 2e-4},
                                         Law{"without_moments", false, true, false, 4e-4},
                                         Law{"without_rotation", false, false, false, 6e-4},
                                         Law{"beams", true, true, true, .5e-4}),
                         [](const auto &of) { return std::string(of.param.name); });

// The weakest of n factors has the mean n^(-1/m) (Weibull 1951); the spread of the mean of 400 chains is a
// twentieth of that of one.
TEST(strength_scatter, weakens_chains_by_the_root_of_their_length) {
  const double m = 5;
  const int chains = 400;
  for (const int n : {1, 4, 16, 64}) {
    std::vector<Vector3> centres;
    for (int c = 0; c < chains; ++c)
      for (int k = 0; k <= n; ++k)
        centres.push_back(2 * radius * Vector3{1.0 * k, 2.0 * (c % 20), 2.0 * (c / 20)});
    Model model(spheres(centres), scattered(m));
    Particles &p = model.particles;
    ASSERT_EQ(model.bonds->size(), static_cast<std::size_t>(chains * n));
    const double strain = tensile_strength / modulus; // at which a bond of factor 1 breaks
    for (std::size_t i = 0; i < p.size(); ++i)
      p.position[i].x *= 1 + strain;
    std::map<int, double> largest; // ratio in each chain
    for (std::size_t k = 0; k < model.bonds->size(); ++k) {
      double &ratio = largest[p.id[model.bonds->first[k]] / (n + 1)];
      ratio = std::max(ratio, model.bonds->response(k, p).tension_ratio);
    }
    double sum = 0;
    for (const auto &[chain, ratio] : largest)
      sum += 1 / ratio;
    const double expected = std::pow(n, -1 / m);
    const double spread = std::sqrt(std::tgamma(1 + 2 / m) / std::pow(std::tgamma(1 + 1 / m), 2) - 1);
    EXPECT_NEAR(sum / chains, expected, 3 * expected * spread / std::sqrt(chains)) << n;
  }
}

// tau / (s c + tan(phi) p): cohesion is scattered, friction is not.
TEST(strength_scatter, leaves_friction_alone) {
  ModelSettings settings = scattered(4);
  settings.rotation = false;
  parallel_bond(settings).friction_angle = std::atan(.7);
  Model model(row(1, {1, 0, 0}), settings);
  const double s = (*model.bonds->strength_factor)[0], press = 1e-3 * radius, slide = 2e-3 * radius;
  ASSERT_GT(std::abs(s - 1), .02);
  Particles &p = model.particles;
  p.position[row_of(p, 1)] += Vector3{-press, slide, 0};
  const double length = std::hypot(2 * radius - press, slide), shortening = 2 * radius - length;
  const double pressure = normal_stiffness * shortening;
  const double slip = 2 * radius * slide / length; // what of d - D is across d
  const double expected = shear_stiffness * slip / (s * shear_strength + .7 * pressure);
  EXPECT_NEAR(model.bonds->response(0, p).shear_ratio, expected, 1e-9 * expected);
}

// Bonds are drawn in the order of their places, not in that in which a file names the spheres.
TEST(strength_scatter, does_not_depend_on_the_order_of_the_spheres) {
  const Specimen packed = packed_box(10, 10, 10);
  std::vector<std::size_t> order(packed.size());
  std::iota(order.begin(), order.end(), 0);
  Random random(5);
  random.shuffle(order);
  Specimen shuffled = packed;
  for (std::size_t k = 0; k < order.size(); ++k)
    shuffled.centre[k] = packed.centre[order[k]], shuffled.radius[k] = packed.radius[order[k]];
  const Model one(packed, scattered(8)), other(shuffled, scattered(8));
  ASSERT_EQ(one.bonds->size(), other.bonds->size());
  for (std::size_t k = 0; k < one.bonds->size(); ++k) {
    EXPECT_EQ((*one.bonds->strength_factor)[k], (*other.bonds->strength_factor)[k]);
    EXPECT_EQ(norm(one.bonds->reference[k] - other.bonds->reference[k]), 0);
  }
}

// Four spheres in a row: two of the aggregate, two of the matrix.
ModelSettings two_phases() {
  ModelSettings settings = breakable();
  Phases phases;
  phases.aggregate_ids = {1, 0};
  phases.aggregate = {3, 2};
  phases.interface = {.5, .25};
  settings.phases = phases;
  return settings;
}

std::size_t bond_between(const Model &model, int a, int b) {
  const Bonds &bonds = *model.bonds;
  for (std::size_t k = 0; k < bonds.size(); ++k) {
    const int i = model.particles.id[bonds.first[k]], j = model.particles.id[bonds.second[k]];
    if (std::pair(std::min(i, j), std::max(i, j)) == std::pair(a, b)) return k;
  }
  throw std::out_of_range("no such bond");
}

TEST(phases, are_told_by_radius_or_by_list) {
  Specimen s = row(3, {1, 0, 0});
  s.radius[2] *= 1.2, s.radius[3] *= .9;
  ModelSettings settings = bonded();
  settings.bond_layout.gap.value = .3;
  settings.phases = Phases{};
  settings.phases->radius_above = 1.1 * radius;
  const Model by_radius(s, settings);
  settings.phases->radius_above = radius; // those of just this radius are of the matrix
  const Model at_the_radius(s, settings);
  settings.phases = Phases{};
  settings.phases->aggregate_ids = {3, 0};
  const Model by_list(s, settings);
  for (int id = 0; id < 4; ++id) {
    const auto phase = [&](const Model &m) { return (*m.particles.phase)[row_of(m.particles, id)]; };
    EXPECT_EQ(phase(by_radius), id == 2) << id;
    EXPECT_EQ(phase(at_the_radius), id == 2) << id;
    EXPECT_EQ(phase(by_list), id == 3 || id == 0) << id;
  }
  EXPECT_EQ(Model(s, bonded()).particles.phase, nullptr);
  EXPECT_EQ(by_list.bonds->strength_factor, nullptr); // all factors are 1
}

TEST(phases, know_every_particle_that_a_list_names) {
  ModelSettings settings = bonded();
  for (const int id : {-1, 4}) {
    settings.phases = Phases{};
    settings.phases->aggregate_ids = {0, id};
    EXPECT_THROW(Model(row(3, {1, 0, 0}), settings), std::invalid_argument) << id;
  }
}

TEST(phases, give_each_kind_of_bond_its_factors) {
  const Model model(row(3, {1, 0, 0}), two_phases());
  const Bonds &b = *model.bonds;
  const struct {
    int i, j;
    double modulus, strength;
  } wanted[] = {{0, 1, 3, 2}, {1, 2, .5, .25}, {2, 3, 1, 1}};
  for (const auto &w : wanted) {
    const std::size_t k = bond_between(model, w.i, w.j);
    EXPECT_DOUBLE_EQ(b.normal_stiffness[k], w.modulus * normal_stiffness);
    EXPECT_DOUBLE_EQ((*b.strength_factor)[k], w.strength);
  }
}

// Pulled to one force, the three springs stretch by F/K each: inner spheres are at rest there, and the row is
// as stiff as 1 / (1/K_1 + 1/K_2 + 1/K_3). At a quarter of the matrix' strength the interface alone is at its
// own.
TEST(phases, in_series_share_the_force_and_break_first_at_the_interface) {
  for (const double share : {.1, .25 - 1e-6, .25 + 1e-6}) {
    Model model(row(3, {1, 0, 0}), two_phases());
    Particles &p = model.particles;
    const double K = normal_stiffness * area, force = share * tensile_strength * area;
    const double stretch[] = {force / (3 * K), force / (.5 * K), force / K};
    double moved = 0;
    for (int id = 1; id < 4; ++id) {
      moved += stretch[id - 1];
      p.position[row_of(p, id)].x += moved;
    }
    EXPECT_NEAR(force / moved, K / (1 / 3.0 + 1 / .5 + 1), 1e-12 * K);
    std::vector<BondBreak> breaks;
    const Loads loads = kernel_loads(p, *model.bonds, best_instruction_set(), breaks);
    for (int id = 0; id < 4; ++id)
      EXPECT_NEAR(loads.force[row_of(p, id)].x, id == 0 ? force : id == 3 ? -force : 0, 1e-9 * force);
    ASSERT_EQ(breaks.size(), share > .25 ? 1u : 0u);
    for (const BondBreak &b : breaks)
      EXPECT_EQ(b.row, static_cast<int>(bond_between(model, 1, 2)));
  }
}

// A block torn apart with large spheres in it: the first cracks are all around them.
TEST(phases, of_a_block_crack_at_the_interface) {
  Specimen specimen = packed_box(14, 14, 14);
  ModelSettings settings = breakable();
  Phases phases;
  for (int id = 0; id < static_cast<int>(specimen.size()); id += 4)
    phases.aggregate_ids.push_back(id);
  phases.aggregate = {2, 3};
  phases.interface = {1, .3};
  settings.phases = phases;
  Model model(specimen, settings);
  Particles &p = model.particles;
  for (std::size_t i = 0; i < p.size(); ++i)
    p.velocity[i] = .05 * p.position[i] / radius;
  const double dt = .8 * model.stable_step({}, 0).limit;
  for (int s = 0; s < 5000 && model.cracks.size() < 20; ++s)
    step(model, dt);
  ASSERT_GE(model.cracks.size(), 20u);
  for (const Crack &c : model.cracks)
    EXPECT_EQ(aggregates_of_pair(p, static_cast<int>(row_of(p, c.particle_a)),
                                 static_cast<int>(row_of(p, c.particle_b))),
              1);
}

// All of one phase: the specimen is as if its bonds had that modulus and those strengths.
TEST(phases, of_one_kind_alone_are_one_material) {
  Specimen specimen = packed_box(8, 8, 8);
  ModelSettings one = breakable(), other = breakable();
  one.phases = Phases{};
  one.phases->radius_above = 1e-9; // all of them
  one.phases->aggregate = {2, 4};
  other.bond_layout.modulus *= 2;
  parallel_bond(other).tensile_strength *= 4, parallel_bond(other).shear_strength *= 4;
  Model a(specimen, one), b(specimen, other);
  EXPECT_EQ(a.stable_step({}, 0).limit, b.stable_step({}, 0).limit);
  EXPECT_DOUBLE_EQ(network_moduli(*a.bonds, 1).young_voigt, network_moduli(*b.bonds, 1).young_voigt);
  for (Model *m : {&a, &b})
    for (std::size_t i = 0; i < m->particles.size(); ++i)
      m->particles.velocity[i] = 2 * m->particles.position[i] / radius;
  const double dt = .5 * b.stable_step({}, 0).limit;
  for (int s = 0; s < 300; ++s)
    step(a, dt), step(b, dt);
  EXPECT_GT(b.broken_tension, 20);
  EXPECT_EQ(a.broken_tension, b.broken_tension);
  EXPECT_EQ(a.broken_shear, b.broken_shear);
  double most = 0, apart = 0;
  for (std::size_t i = 0; i < a.particles.size(); ++i) {
    most = std::max(most, norm(a.particles.position[i] - a.particles.reference_position[i]));
    apart = std::max(apart, norm(a.particles.position[i] - b.particles.position[i]));
  }
  EXPECT_LT(apart, 1e-9 * most); // powers of two: products round alike
}

// A broken pair touches with the stiffness of the bond that it had.
TEST(phases, have_contacts_as_stiff_as_their_bonds) {
  Model model(row(3, {1, 0, 0}), two_phases());
  Particles &p = model.particles;
  const double K = normal_stiffness * area;
  const auto bound = [&](int a, int b) {
    return model.contacts
        ->stiffness_bound(p, static_cast<int>(row_of(p, a)), static_cast<int>(row_of(p, b)), 0)
        .normal;
  };
  EXPECT_DOUBLE_EQ(bound(0, 1), 3 * K);
  EXPECT_DOUBLE_EQ(bound(1, 2), .5 * K);
  EXPECT_DOUBLE_EQ(bound(2, 3), K);
  const std::size_t k = bond_between(model, 0, 1);
  const BrokenBond broken =
      model.bonds->break_rows({{static_cast<int>(k), BondState::broken_in_tension}}, p, 0).front();
  std::vector<BrokenBond> all{broken};
  model.contacts->take_over(p, *model.bonds, all, 1e-9);
  ASSERT_EQ(model.contacts->table.size(), 1u);
  EXPECT_DOUBLE_EQ(model.contacts->coefficient[0], 3 * K);
}

} // namespace
} // namespace platen::dem::strength_scatter_test
