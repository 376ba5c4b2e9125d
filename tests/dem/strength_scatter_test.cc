// Bonds of unlike strength: the distribution, who breaks first, and what does not change.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <ostream>
#include <set>
#include <utility>

#include "base/random.h"
#include "tests/dem/examples.h"

namespace platen::dem {
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
  static std::vector<InstructionSet> sets() {
    std::vector<InstructionSet> all{InstructionSet::baseline};
    if (best_instruction_set() >= InstructionSet::avx2) all.push_back(InstructionSet::avx2);
    if (best_instruction_set() >= InstructionSet::avx512) all.push_back(InstructionSet::avx512);
    return all;
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
  for (const InstructionSet set : sets()) {
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
  for (const InstructionSet set : sets()) {
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
      double &ratio = largest[p.id[static_cast<std::size_t>(model.bonds->first[k])] / (n + 1)];
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

} // namespace
} // namespace platen::dem
