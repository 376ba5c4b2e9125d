// A bar on two supports: what is read off it, and how it is laid down.
#include <gtest/gtest.h>

#include <cmath>

#include "dem/measure/gauge.h"
#include "dem/packing/advancing_front.h"
#include "tests/dem/examples.h"

namespace platen::dem {
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
  EXPECT_NEAR(beam.deflection(stress, e, 0.2) / (1 + beam.shear_share(0.2)) /
                  (load * std::pow(0.3, 3) / (48 * e * inertia)),
              1, 1e-12);
  // P L / (4 kappa G A), kappa = 10 (1 + nu) / (12 + 11 nu).
  const double kappa = 10 * 1.2 / 14.2, g = e / 2.4;
  EXPECT_NEAR(beam.shear_share(0.2) * load * std::pow(0.3, 3) / (48 * e * inertia) /
                  (load * 0.3 / (4 * kappa * g * 0.02 * 0.03)),
              1, 1e-12);
  EXPECT_NEAR((ThreePoints{0.075, 0.025, 0.025}.shear_share(0.2)), 0.3, 0.02);
}

} // namespace
} // namespace platen::dem
