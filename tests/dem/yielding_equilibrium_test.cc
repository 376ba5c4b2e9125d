// Rest of networks whose bonds yield: the tangent against differences of the law, and blocks against slow
// explicit runs.
#include "dem/yielding_equilibrium.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <string>

#include "tests/dem/examples.h"
#include "tests/dem/one_yielding_bond.h"
#include "tests/measured.h"

namespace platen::dem::yielding_equilibrium_test {
namespace {

using one_yielding_bond::Bond;
using one_yielding_bond::concrete;
using one_yielding_bond::length;

// A bond is closed, slides, and then makes the step whose tangent is asked for. Closing in Pa of an elastic
// bond, sliding in rad.
struct Regime {
  const char *name;
  double close, slide;          // first
  double along, slides;         // in the step
  double axial, shear, moments; // the tangent, over the stiffness at rest
};

class YieldingTangent : public testing::TestWithParam<Regime> {};

// What acts at the end of a step that is longer or shorter by a little: central differences.
TEST_P(YieldingTangent, is_the_derivative_of_what_acts) {
  const Regime &regime = GetParam();
  SCOPED_TRACE(regime.name);
  YieldingParallelBond::Parameters p = concrete();
  p.tensile_strength = 0; // pulled without end
  Bond pair(p);
  const double kn = pair.geometry.normal_stiffness;
  pair.move({0, 0, -regime.close / kn});
  if (regime.slide != 0) {
    pair.move({}, {0, regime.slide, 0}, {0, regime.slide, 0});
    ASSERT_EQ(pair.state.broken, 2);
  }
  const double slide = regime.slides, pa = 1e3, h = 1e-6; // rad, Pa, rad
  const auto after = [&](double closing, double more, double bend, double twist) {
    Bond next = pair;
    next.move({0, 0, -(regime.along + closing) / kn}, {bend, slide + more, -twist},
              {-bend, slide + more, twist});
    return next;
  };
  const Bond here = after(0, 0, 0, 0);
  const BondStiffness tangent = here.law.tangent(pair.state, here.geometry, here.pose);
  const BondStiffness rest =
      pair.law.stiffness({pair.geometry.reference, length, 0.5, kn, pair.geometry.radius});
  const auto expect = [](double value, double wanted, double difference, double share, double of_rest) {
    EXPECT_NEAR(value, wanted * of_rest, 1e-12 * of_rest);
    EXPECT_NEAR(value, difference, share * of_rest);
  };
  const double normal = after(-pa, 0, 0, 0).now.normal - after(pa, 0, 0, 0).now.normal;
  expect(tangent.axial, regime.axial, normal / (2 * pa / kn), 1e-8, rest.axial);
  // A whole bond slides by the turns of what was the distance at first, a contact by that in mid-step.
  const double arm = pair.state.broken > 0 ? here.pose.distance.z + 0.5 * regime.along / kn : length;
  const double shear = after(0, h, 0, 0).now.shear.x - after(0, -h, 0, 0).now.shear.x;
  expect(tangent.shear, regime.shear, std::abs(shear) / (2 * h * arm), 1e-6, rest.shear);
  const double bending = after(0, 0, h, 0).now.torque_i.x - after(0, 0, -h, 0).now.torque_i.x;
  expect(tangent.bending, regime.moments, std::abs(bending) / (4 * h), 1e-6, rest.bending);
  const double twisting = after(0, 0, 0, h).now.torque_i.z - after(0, 0, 0, -h).now.torque_i.z;
  expect(tangent.twisting, regime.moments, std::abs(twisting) / (4 * h), 1e-6, rest.twisting);
}

INSTANTIATE_TEST_SUITE_P(
    yielding, YieldingTangent,
    testing::Values(Regime{"elastic", 20e6, 0, 10e6, 0, 1, 1, 1}, Regime{"pulled", 0, 0, -5e6, 0, 1, 1, 1},
                    Regime{"first branch", 100e6, 0, 20e6, 0, 1. / 3, 1, 1},
                    Regime{"second branch", 300e6, 0, 20e6, 0, 1. / 12, 1, 1},
                    Regime{"third branch", 900e6, 0, 20e6, 0, 1. / 22, 1, 1},
                    Regime{"unloaded", 300e6, 0, -40e6, 0, 1, 1, 1},
                    Regime{"broken, sticking and yielding", 100e6, 0.02, 10e6, 0, 1. / 3, 1, 0},
                    Regime{"broken, sliding and yielding", 300e6, 0.02, 10e6, 1e-3, 1. / 12, 0, 0},
                    Regime{"broken, sliding, unloaded", 300e6, 0.02, -10e6, 1e-3, 1, 0, 0},
                    Regime{"broken, apart", 50e6, 0.02, -60e6, 0, 0, 0, 0}),
    [](const testing::TestParamInfo<Regime> &regime) {
      std::string name = regime.param.name;
      std::replace_if(
          name.begin(), name.end(), [](char c) { return std::isalpha(c) == 0; }, '_');
      return name;
    });

// A block whose bonds yield, between layers that are moved.
ModelSettings yielding() {
  ModelSettings s = examples::bonded();
  YieldingParallelBond::Parameters law = concrete();
  law.tensile_strength = law.shear_strength = 0; // yields, and never breaks
  s.bond = law;
  s.bond_layout.modulus = 48e9;
  return s;
}
constexpr double high = 12 * examples::radius;
Specimen block() {
  return examples::packed_box(9, 9, 12);
}

enum class Layer { free, bottom, top };
Layer layer(const Particles &p, std::size_t i) {
  const double z = p.reference_position[i].z;
  return z < 2 * examples::radius          ? Layer::bottom
         : z > high - 2 * examples::radius ? Layer::top
                                           : Layer::free;
}
StaticCase top_moves(const Particles &p, const Vector3 &by) {
  StaticCase load;
  for (std::size_t i = 0; i < p.size(); ++i)
    if (layer(p, i) != Layer::free)
      load.prescribed.push_back({static_cast<int>(i), layer(p, i) == Layer::top ? by : Vector3{}, {}});
  return load;
}
// N, by the bonds on the top layer.
Vector3 on_top(const Particles &p, const Bonds &b) {
  Vector3 sum;
  for (std::size_t k = 0; k < b.size(); ++k) {
    const Triple<double> f = b.response(k, p).force;
    if (layer(p, static_cast<std::size_t>(b.first[k])) == Layer::top) sum += Vector3{f.x, f.y, f.z};
    if (layer(p, static_cast<std::size_t>(b.second[k])) == Layer::top) sum -= Vector3{f.x, f.y, f.z};
  }
  return sum;
}
// The same motion of the layers, slowly and with inertia: starts and ends at rest.
void press_slowly(Model &model, const Vector3 &by, int steps) {
  Particles &p = model.particles;
  const double dt = 0.8 * model.stable_step({}, 0).limit;
  for (int s = 0; s < steps; ++s) {
    const double rate = (1 - std::cos(2 * pi * (s + 0.5) / steps)) / (steps * dt);
    for (std::size_t i = 0; i < p.size(); ++i)
      if (layer(p, i) != Layer::free) p.velocity[i] = layer(p, i) == Layer::top ? rate * by : Vector3{};
    examples::step(model, dt, [](Particles &all) {
      for (std::size_t i = 0; i < all.size(); ++i)
        if (layer(all, i) != Layer::free) all.force[i] = (*all.torque)[i] = {};
    });
  }
}

// Pressed and sheared until two fifths of the bonds yield, then unloaded by a fifth: forces, motion and what
// yield keeps are those of a run with inertia, to a millionth of the largest.
TEST(YieldingEquilibrium, is_where_a_slow_explicit_run_comes_to_rest) {
  Model still(block(), yielding());
  ModelSettings damped = yielding();
  damped.local_damping = 0.5;
  Model slow(block(), damped);
  ASSERT_LT(slow.particles.size(), block_rows); // no forces wait in ghosts
  const Vector3 down{0.1e-3 * high, 0, -5e-3 * high}, up{0, 0, 1e-3 * high};
  for (const auto &[by, increments] : {std::pair{down, 20}, std::pair{up, 1}}) {
    for (int k = 0; k < increments; ++k) {
      const YieldingStep s =
          settle(still.particles, *still.bonds, top_moves(still.particles, by / double(increments)));
      EXPECT_LT(s.solves, 20);
      EXPECT_LE(s.residual, 1e-8);
    }
    press_slowly(slow, by, 10000);
    const Bonds &a = *still.bonds, &b = *slow.bonds;
    const Vector3 force = on_top(still.particles, a), same = on_top(slow.particles, b);
    EXPECT_GT(norm(force), 0);
    measured::expect_below(52, "force_off", norm(force - same) / norm(force), 1e-6);
    double way = 0, off = 0, plastic = 0, plastic_off = 0;
    for (std::size_t i = 0; i < slow.particles.size(); ++i) {
      const Vector3 u = still.particles.position[i] - still.particles.reference_position[i];
      way = std::fmax(way, norm(u));
      off = std::fmax(off, norm(still.particles.position[i] - slow.particles.position[i]));
    }
    std::size_t yielded = 0;
    for (std::size_t k = 0; k < a.size(); ++k) {
      const double qa = a.memory<YieldingParallelBond::State<double>>(k).plastic,
                   qb = b.memory<YieldingParallelBond::State<double>>(k).plastic;
      plastic = std::fmax(plastic, qa), plastic_off = std::fmax(plastic_off, std::abs(qa - qb));
      yielded += qa > 0;
    }
    EXPECT_GT(3 * yielded, a.size());
    measured::expect_below(52, "displacement_off", off / way, 1e-6);
    measured::expect_below(52, "plastic_closing_off", plastic_off / plastic, 1e-6);
  }
}

// Back within what has yielded the work comes back, and a path that closes ends where it began.
TEST(YieldingEquilibrium, unloads_and_loads_again_elastically) {
  Model model(block(), yielding());
  Particles &p = model.particles;
  for (int k = 0; k < 10; ++k)
    settle(p, *model.bonds, top_moves(p, {0, 0, -4e-4 * high}));
  const Vector3 force = on_top(p, *model.bonds);
  const BondTotals before = bond_totals(p, *model.bonds);
  EXPECT_GT(before.plastic, 0.1 * before.energy);
  for (const double by : {4e-4, 4e-4, -5e-4, -3e-4})
    settle(p, *model.bonds, top_moves(p, {0, 0, by * high}));
  const BondTotals after = bond_totals(p, *model.bonds);
  EXPECT_NEAR(after.plastic, before.plastic, 1e-6 * before.plastic);
  EXPECT_NEAR(after.energy, before.energy, 1e-6 * before.energy);
  EXPECT_LT(norm(on_top(p, *model.bonds) - force), 1e-6 * norm(force));
}

TEST(YieldingEquilibrium, what_would_break_or_is_no_yielding_bond_is_refused_and_changes_nothing) {
  ModelSettings weak = yielding();
  std::get<YieldingParallelBond::Parameters>(*weak.bond).tensile_strength = 9e6;
  Model model(block(), weak);
  Particles &p = model.particles;
  const std::vector<Vector3> at(p.position.begin(), p.position.end());
  EXPECT_THROW(settle(p, *model.bonds, top_moves(p, {0, 0, 2e-3 * high})), NoEquilibrium);
  for (std::size_t i = 0; i < p.size(); ++i)
    ASSERT_EQ(norm(p.position[i] - at[i]), 0);
  StaticCase supported = top_moves(p, {});
  supported.supports.push_back({});
  EXPECT_THROW(settle(p, *model.bonds, supported), std::invalid_argument);
  StaticCase none = top_moves(p, {});
  none.prescribed.push_back({-1, {}, {}});
  EXPECT_THROW(settle(p, *model.bonds, none), std::invalid_argument);
  Model elastic(block(), examples::bonded());
  EXPECT_THROW(settle(elastic.particles, *elastic.bonds, top_moves(elastic.particles, {})),
               std::invalid_argument);
}

} // namespace
} // namespace platen::dem::yielding_equilibrium_test
