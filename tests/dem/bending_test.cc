// A bar on two supports: what is read off it, and how it is laid down.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "dem/measure/damage.h"
#include "dem/measure/gauge.h"
#include "dem/packing/advancing_front.h"
#include "tests/dem/examples.h"

namespace platen::dem::bending_test {
namespace {

using namespace examples;

Specimen standing_bar() {
  return advancing_front(box(8 * radius, 6 * radius, 40 * radius), uniform_radii_of_spread(radius, .25), 4);
}

TEST(bending, a_bar_laid_down_is_the_same_bar) {
  const Specimen standing = standing_bar(), lying = laid_along_x(standing);
  EXPECT_EQ(lying.shape.width_x, 40 * radius);
  EXPECT_EQ(lying.shape.width_y, 6 * radius);
  EXPECT_EQ(lying.shape.height, 8 * radius);
  EXPECT_TRUE(check_specimen(lying).empty()); // every sphere within the shape
  for (std::size_t i = 0; i < lying.size(); i += 7)
    for (std::size_t j = i % 5; j < i; j += 11)
      // Round-off of sums of lengths as large as the bar.
      EXPECT_NEAR(norm(lying.centre[i] - lying.centre[j]), norm(standing.centre[i] - standing.centre[j]),
                  1e-13 * radius * 40);
  // Not its mirror image: the turn keeps the sense of three edges.
  const auto sense = [](const Specimen &s) {
    return dot(s.centre[1] - s.centre[0], cross(s.centre[2] - s.centre[0], s.centre[3] - s.centre[0]));
  };
  EXPECT_NEAR(sense(lying) / sense(standing), 1, 1e-9);
  const Specimen round = advancing_front(cylinder(6 * radius, 20 * radius), equal_radii(radius), 1);
  EXPECT_EQ(laid_along_x(round).centre[5].z, round.centre[5].z);
}

TEST(bending, deflection_sees_sag_alone) {
  const Specimen specimen = laid_along_x(standing_bar());
  Model model(specimen, bonded());
  Particles &p = model.particles;
  const double span = 30 * radius, sag = 0.01 * radius;
  const Deflection deflection(p, specimen.shape, span);
  EXPECT_EQ(deflection(p), 0);
  const auto move = [&](const auto &displacement) {
    for (std::size_t i = 0; i < p.size(); ++i)
      p.position[i] = p.reference_position[i] + displacement(p.reference_position[i]);
  };
  // A shift, a tilt, and a stretch along x: nothing sags. The mean places of the three windows differ from
  // the nominal ones by a fraction of a radius, which a tilt shows.
  move([&](const Vector3 &x) { return Vector3{.1 * x.x, .3, -.2}; });
  EXPECT_NEAR(deflection(p), 0, 1e-15);
  move([&](const Vector3 &x) { return Vector3{0, 0, 1e-3 * x.x}; });
  EXPECT_NEAR(deflection(p), 0, 1.5e-3 * radius);
  // The elastic line of a slender beam under a load in the middle. The window in the middle is four radii
  // wide: it reads h^2 / L^2 x 2 = 0.9 % less than the middle itself, those of the supports scatter
  // by a third of a radius, of 1.5 / 15 sag each.
  move([&](const Vector3 &x) {
    const double s = std::abs(x.x) / (0.5 * span), w = 1 - 1.5 * s * s + 0.5 * s * s * s;
    return Vector3{0, 0, -sag * w};
  });
  EXPECT_NEAR(deflection(p) / sag, 1, 0.08);
  EXPECT_THROW(Deflection(p, specimen.shape, 40 * radius), std::invalid_argument);
}

// Three-point bending of a slender beam, and a deep one of concrete: d / L = 1/3, nu = 0.2 has 28 % to 32 %
// of shear in every handbook, depending on the shear factor.
TEST(bending, the_formulas_are_those_of_beams) {
  const ThreePoints beam{0.3, 0.02, 0.03};
  const double load = 500, e = 30e9, inertia = 0.02 * std::pow(0.03, 3) / 12;
  const double stress = load / beam.nominal_area();
  EXPECT_NEAR(stress / (0.25 * load * 0.3 * 0.015 / inertia), 1, 1e-12); // M / W
  EXPECT_NEAR(beam.deflection(stress, e, 0.2) / (1 + beam.shear_fraction(0.2)) /
                  (load * std::pow(0.3, 3) / (48 * e * inertia)),
              1, 1e-12);
  // P L / (4 kappa G A), kappa = 10 (1 + nu) / (12 + 11 nu).
  const double kappa = 10 * 1.2 / 14.2, g = e / 2.4;
  EXPECT_NEAR(beam.shear_fraction(0.2) * load * std::pow(0.3, 3) / (48 * e * inertia) /
                  (load * 0.3 / (4 * kappa * g * 0.02 * 0.03)),
              1, 1e-12);
  EXPECT_NEAR((ThreePoints{0.075, 0.025, 0.025}.shear_fraction(0.2)), 0.3, 0.02);
}

// Of the ligament above a notch: EN 14651.
TEST(bending, the_ligament_of_a_notched_beam_is_a_beam_of_its_depth) {
  const ThreePoints beam{0.14, 0.02, 0.04, 0.015};
  EXPECT_DOUBLE_EQ(beam.ligament(), 0.025);
  EXPECT_DOUBLE_EQ(beam.ligament_area(), 5e-4);
  EXPECT_DOUBLE_EQ(beam.net_area(), (ThreePoints{0.14, 0.02, 0.025}.nominal_area()));
  EXPECT_DOUBLE_EQ(beam.nominal_area(), (ThreePoints{0.14, 0.02, 0.04}.nominal_area()));
}

// A simple cubic lattice of 12 x 4 x 4 spheres that touch; columns lie at one radius from mid-span, three,
// ...
Specimen lattice_beam() {
  return cubic(12, 4, 4);
}

std::size_t bonds_across_the_middle(const Model &model, double below) {
  std::size_t count = 0;
  for (std::size_t k = 0; k < model.bonds->size(); ++k) {
    const Vector3 &a = model.particles.position[model.bonds->first[k]],
                  &b = model.particles.position[model.bonds->second[k]];
    count += (a.x < 0) != (b.x < 0) && std::min(a.z, b.z) < below;
  }
  return count;
}

TEST(bending, a_notch_takes_away_spheres_and_bonds) {
  const Specimen whole = lattice_beam(), slotted = notched(whole, {4 * radius, 4 * radius});
  EXPECT_EQ(whole.size(), 192u);
  EXPECT_EQ(slotted.size(), 192u - 16); // two columns, four across, two layers
  EXPECT_NEAR(slotted.shape.volume() / std::pow(radius, 3), 24 * 8 * 8 - 4 * 4 * 8, 1e-9);
  for (const Vector3 &c : slotted.centre)
    EXPECT_FALSE(c.z < 4 * radius && std::abs(c.x) < 2 * radius);
  const Model model(slotted, bonded()), before(whole, bonded());
  EXPECT_EQ(before.bonds->size(), 464u);
  EXPECT_EQ(model.bonds->size(), 464u - 52); // 24 along x, 12 across, 16 upright
  EXPECT_EQ(bonds_across_the_middle(model, 8 * radius), 8u);
  EXPECT_EQ(bonds_across_the_middle(model, 4 * radius), 0u);
  // Once more, and of a bar without one.
  EXPECT_EQ(notched(slotted, slotted.shape.notch).size(), slotted.size());
  EXPECT_EQ(notched(whole, {}).size(), whole.size());
  EXPECT_FALSE(notched(whole, {0, radius}).shape.notch.is_there());
}

TEST(bending, a_notch_thinner_than_a_sphere_cuts_bonds_alone) {
  for (const double width : {0.0, radius}) {
    const Specimen cut = notched(lattice_beam(), {4 * radius, width});
    EXPECT_EQ(cut.size(), 192u);
    const Model model(cut, bonded());
    EXPECT_EQ(model.bonds->size(), 464u - 8);
    EXPECT_EQ(bonds_across_the_middle(model, 4 * radius), 0u);
    EXPECT_EQ(bonds_across_the_middle(model, 8 * radius), 8u);
  }
  // A bond that slopes counts where it passes the middle.
  const Notch notch{1, 0};
  EXPECT_TRUE(notch.parts({-1, 0, 0}, {1, 0, 1.9}));
  EXPECT_FALSE(notch.parts({-1, 0, 0}, {1, 0, 2.1}));
  EXPECT_TRUE(notch.parts({3, 0, 3.9}, {-1, 0, 0}));
  EXPECT_FALSE(notch.parts({3, 0, 4.1}, {-1, 0, 0}));
  EXPECT_FALSE(notch.parts({1, 0, 0}, {2, 0, 0}));
}

TEST(bending, what_is_no_notch_is_refused) {
  const Specimen whole = lattice_beam();
  for (const Notch &notch : {Notch{-1e-3, 0}, Notch{1e-3, -1e-3}, Notch{std::nan(""), 0},
                             Notch{1e-3, std::numeric_limits<double>::infinity()}})
    EXPECT_THROW(notched(whole, notch), std::invalid_argument);
  Specimen round;
  round.shape = cylinder(radius, radius);
  EXPECT_THROW(notched(round, {radius, 0}), std::invalid_argument);
  EXPECT_EQ(notched(round, {}).size(), 0u);
}

// Two halves that turn about the upper face by phi: those beside the mouth lie three radii from mid-span and
// one above the lower face.
TEST(bending, a_mouth_opens_as_its_halves_turn) {
  const Specimen specimen = notched(lattice_beam(), {4 * radius, 4 * radius});
  Model model(specimen, bonded());
  Particles &p = model.particles;
  const MouthOpening mouth(p, specimen.shape.notch, model.bonds.get());
  const std::vector<int> rows = mouth.rows();
  EXPECT_EQ(rows.size(), 8u);
  EXPECT_TRUE(std::is_sorted(rows.begin(), rows.end()));
  EXPECT_EQ(mouth(p), 0);
  const double phi = 2e-3, depth = 8 * radius;
  const auto turn = [&](double shift) {
    for (std::size_t i = 0; i < p.size(); ++i) {
      const Vector3 &x = p.reference_position[i];
      const double to = x.x < 0 ? -phi : phi, down = depth - x.z;
      p.position[i] = {x.x * std::cos(to) + down * std::sin(to) + shift, x.y,
                       depth + x.x * std::sin(to) - down * std::cos(to)};
    }
  };
  // Positions of 1e-2 m to 1e-18 m.
  const double opening = 2 * (7 * radius * std::sin(phi) - 3 * radius * (1 - std::cos(phi)));
  turn(0);
  EXPECT_NEAR(mouth(p), opening, 1e-16);
  turn(5 * radius); // as a whole
  EXPECT_NEAR(mouth(p), opening, 1e-16);
  EXPECT_THROW(MouthOpening(p, {1.9 * radius, 4 * radius}, nullptr), std::invalid_argument);
}

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
} // namespace platen::dem::bending_test
