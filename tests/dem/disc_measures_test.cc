// What is read off a disc between platens, and off a bent bar, by places and times that are set by hand.
#include <gtest/gtest.h>

#include <cmath>

#include "dem/measure/damage.h"
#include "dem/measure/gauge.h"
#include "tests/dem/examples.h"

namespace platen::dem {
namespace {

using namespace examples;

constexpr double wide = 40; // radius of the disc, in `radius`; its middle is at x = 0, z = 40

// Bonded pairs one above the other, each with its bond in the middle of where it is asked for.
struct Pairs {
  Shape shape = disc(wide * radius, 10 * radius);
  std::vector<Vector3> centres;
  void add(double x, double z, int count) { // apart from each other along y
    for (int k = 0; k < count; ++k)
      for (const double up : {-1., 1.})
        centres.push_back(
            {x * radius, 5 * (static_cast<double>(centres.size() / 2)) * radius, (z + up) * radius});
  }
};

// Breaks the bonds between x and z, lower to upper (in `radius`), `count` of them that are whole.
void break_some(Model &model, double x, double z, int count, double time) {
  std::vector<BondBreak> breaks;
  Bonds &b = *model.bonds;
  for (std::size_t k = 0; k < b.size() && static_cast<int>(breaks.size()) < count; ++k) {
    const Vector3 at = reference_midpoint(model.particles, b, b.record[k]) / radius;
    if (!is_broken(b.state[b.record[k]]) && std::abs(at.x - x) < 1 && std::abs(at.z - z) < 1)
      breaks.push_back({static_cast<int>(k), BondState::broken_in_tension});
  }
  b.break_rows(breaks, model.particles, time);
}

TEST(disc_measures, a_disc_splits_where_and_when_its_bonds_say) {
  Pairs pairs;
  pairs.add(3, 45, 6);
  pairs.add(-4, 70, 4);
  pairs.add(20, 40, 20);
  pairs.add(0, 20, 3);
  Specimen s = spheres(pairs.centres);
  s.shape = pairs.shape;
  Model model(s, bonded());
  ASSERT_EQ(model.intact_bonds(), 33u);
  const auto pattern = [&] { return split_pattern(model.particles, *model.bonds, s.shape); };
  EXPECT_TRUE(std::isnan(pattern().on_diameter));
  break_some(model, 3, 45, 3, 1);
  EXPECT_EQ(pattern().first_in_middle, 1); // of the three that there are
  EXPECT_EQ(pattern().on_diameter, 1);
  break_some(model, -4, 70, 4, 4); // told before those that broke earlier
  break_some(model, 20, 40, 20, 2);
  break_some(model, 3, 45, 3, 3);
  const SplitPattern p = pattern();
  EXPECT_DOUBLE_EQ(p.on_diameter, 10 / 30.);
  EXPECT_DOUBLE_EQ(p.in_middle, 6 / 30.);
  EXPECT_DOUBLE_EQ(p.first_in_middle, 3 / 20.);
  EXPECT_DOUBLE_EQ(broken_near_midspan(model.particles, *model.bonds, 10 * radius), 10 / 30.);
  EXPECT_DOUBLE_EQ(broken_near_midspan(model.particles, *model.bonds, 41 * radius), 1);
}

// Spheres near the ends of the horizontal diameter alone say how it opens.
TEST(disc_measures, a_disc_opens_by_what_its_sides_move_apart) {
  Specimen s;
  for (const double x : {-39., -35., -30., -26., -10., 0., 10., 26., 30., 35., 39.})
    for (const double z : {28., 32., 40., 48., 52.})
      s.centre.push_back({x * radius, 0, z * radius});
  s.radius.assign(s.centre.size(), radius);
  s.shape = disc(wide * radius, 10 * radius);
  Model model(s, bonded());
  Particles &p = model.particles;
  const DiscOpening opening(p, s.shape);
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Vector3 at = p.reference_position[i] / radius;
    const bool seen = std::abs(at.x) > 28 && std::abs(at.z - 40) < 10;
    p.position[i].x += seen ? 1e-4 * (at.x + 100) * radius : radius * std::copysign(1, at.x);
  }
  EXPECT_NEAR(opening(p), 1e-4 * 2 * (39 + 35 + 30) / 3 * radius, 1e-12 * radius);
}

// Supports are looked at no further out than the bar reaches.
TEST(disc_measures, a_deflection_looks_at_its_supports_and_between_them) {
  Specimen s;
  for (double x = -40; x <= 40; x += 2)
    for (const double z : {2., 10., 18.})
      s.centre.push_back({x * radius, 0, z * radius});
  for (const double x : {-36.8, 36.8}) // within a window, but not within what is left of the bar beyond
    s.centre.push_back({x * radius, 5 * radius, 10 * radius});
  s.radius.assign(s.centre.size(), radius);
  s.shape = box(82 * radius, 2 * radius, 20 * radius);
  Model model(s, bonded());
  Particles &p = model.particles;
  const double span = 78;
  const Deflection deflection(p, s.shape, span * radius);
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Vector3 at = p.reference_position[i] / radius;
    const bool seen = std::abs(at.z - 10) < 3;
    const double sag = std::abs(at.x) < 3 ? 1e-3 : std::abs(std::abs(at.x) - span / 2) < 2 ? 2e-4 : .5;
    p.position[i].z -= (seen ? sag : .1) * radius;
  }
  EXPECT_NEAR(deflection(p), 8e-4 * radius, 1e-12 * radius);
}

} // namespace
} // namespace platen::dem
