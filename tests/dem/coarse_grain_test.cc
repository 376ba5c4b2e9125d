// Fields from spheres: what comes out is what was put in, whatever the grid and the frame.
#include "dem/measure/coarse_grain.h"
#include "base/pi.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace platen::dem {
namespace {

constexpr double reach = 3.5; // lengths in mean radii

double volume(double r) {
  return 4.0 / 3 * pi * r * r * r;
}

// A shaken lattice of unequal spheres in a box of side 2 n about the origin.
SphereColumns shaken(int n, unsigned seed = 5) {
  std::mt19937 random(seed);
  const auto draw = [&random] { return 2 * static_cast<double>(random()) / 4294967296.0 - 1; };
  SphereColumns s;
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        const auto place = [n, &draw](int m) { return 2.0 * m - (n - 1) + .4 * draw(); };
        const double x = place(i), y = place(j), z = place(k);
        s.position.push_back({x, y, z});
        s.radius.push_back(.9 + .1 * draw());
      }
  return s;
}

void give(SphereColumns &s, const std::array<double, 9> &gradient, const Vector3 &shift) {
  for (const Vector3 &x : s.position) {
    Vector3 u = shift;
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c)
        u[r] += gradient[static_cast<std::size_t>(3 * r + c)] * x[c];
    s.displacement.push_back(u);
  }
}

TEST(coarse_grain, the_kernel_has_the_integral_one_and_a_smooth_end) {
  double integral = 0;
  constexpr int shells = 2000;
  for (int k = 0; k < shells; ++k) {
    const double r = reach * (k + .5) / shells;
    integral += 4 * pi * r * r * wendland(r, reach) * reach / shells;
  }
  EXPECT_NEAR(integral, 1, 1e-6);
  EXPECT_EQ(wendland(reach, reach), 0);
  EXPECT_LT(wendland(.99 * reach, reach), 1e-6 * wendland(0, reach));
}

TEST(coarse_grain, what_is_the_same_everywhere_stays_so_and_outside_is_empty) {
  SphereColumns s = shaken(8);
  const std::array<double, 9> stress{-1, .2, .3, .2, -5, .4, .3, .4, -30};
  s.stress.assign(s.position.size(), stress);
  s.damage.assign(s.position.size(), .25);
  const RegularGrid grid{{-14, -14, -14}, 2, {15, 15, 15}};
  const CoarseFields f = coarse_grain(s, grid, reach);
  for (std::size_t node = 0; node < grid.size(); ++node) {
    const Vector3 x = grid.place(node);
    const double out = std::max({std::abs(x.x), std::abs(x.y), std::abs(x.z)});
    if (f.solid_share[node] == 0) {
      EXPECT_GT(out, 8);
      EXPECT_TRUE(std::isnan(f.damage[node]));
      continue;
    }
    EXPECT_LT(out, 7.4 + reach);
    EXPECT_NEAR(f.damage[node], .25, 1e-14);
    for (std::size_t c = 0; c < 9; ++c)
      EXPECT_NEAR(f.stress[node][c], stress[c], 1e-12);
  }
}

// At the skin and in the corners too: this is what a mean alone would not give.
TEST(coarse_grain, a_linear_displacement_and_its_strain_come_out_as_they_are) {
  SphereColumns s = shaken(8);
  const std::array<double, 9> g{1e-3, 2e-4, -3e-4, 4e-4, 5e-4, 0, 7e-4, -1e-4, -2e-3};
  const Vector3 shift{.01, -.02, .03};
  give(s, g, shift);
  const RegularGrid grid{{-7, -7, -7}, 1.4, {11, 11, 11}};
  const CoarseFields f = coarse_grain(s, grid, reach);
  for (std::size_t node = 0; node < grid.size(); ++node) {
    const Vector3 x = grid.place(node);
    for (int r = 0; r < 3; ++r) {
      double u = shift[r];
      for (int c = 0; c < 3; ++c) {
        const auto at = [&g](int a, int b) { return g[static_cast<std::size_t>(3 * a + b)]; };
        u += at(r, c) * x[c];
        EXPECT_NEAR(f.strain[node][static_cast<std::size_t>(3 * r + c)], .5 * (at(r, c) + at(c, r)), 1e-12);
      }
      EXPECT_NEAR(f.displacement[node][r], u, 1e-12);
    }
  }
}

TEST(coarse_grain, turning_as_a_whole_strains_nothing) {
  SphereColumns s = shaken(6);
  give(s, {0, -1e-3, 2e-3, 1e-3, 0, 5e-4, -2e-3, -5e-4, 0}, {});
  const RegularGrid grid{{-5, -5, -5}, 2.5, {5, 5, 5}};
  const CoarseFields f = coarse_grain(s, grid, reach);
  for (const auto &strain : f.strain)
    for (const double e : strain)
      EXPECT_NEAR(e, 0, 1e-14);
}

// Weighed by the solid share, the field holds as much as the spheres do.
TEST(coarse_grain, integrals_are_kept) {
  SphereColumns s = shaken(6);
  double solid = 0, damaged = 0;
  for (std::size_t i = 0; i < s.position.size(); ++i) {
    s.damage.push_back(std::abs(std::sin(s.position[i].x + 2 * s.position[i].z)));
    solid += volume(s.radius[i]);
    damaged += volume(s.radius[i]) * s.damage[i];
  }
  const RegularGrid grid{{-10.2, -10.2, -10.2}, .6, {35, 35, 35}};
  const CoarseFields f = coarse_grain(s, grid, reach);
  double field_solid = 0, field_damaged = 0;
  for (std::size_t node = 0; node < grid.size(); ++node) {
    field_solid += f.solid_share[node] * std::pow(grid.spacing, 3);
    if (f.solid_share[node] > 0)
      field_damaged += f.solid_share[node] * f.damage[node] * std::pow(grid.spacing, 3);
  }
  EXPECT_NEAR(field_solid / solid, 1, 1e-3);
  EXPECT_NEAR(field_damaged / damaged, 1, 1e-3);
}

TEST(coarse_grain, a_node_does_not_know_the_rest_of_its_grid) {
  SphereColumns s = shaken(6);
  give(s, {1e-3, 0, 0, 0, 0, 0, 0, 0, -1e-3}, {});
  for (std::size_t i = 0; i < s.position.size(); ++i)
    s.damage.push_back(.5 + .05 * s.position[i].y);
  const CoarseFields fine = coarse_grain(s, {{-4, -4, -4}, 1, {9, 9, 9}}, reach),
                     coarse = coarse_grain(s, {{-4, -4, -4}, 4, {3, 3, 3}}, reach);
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t j = 0; j < 3; ++j)
      for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t a = 4 * i + 9 * (4 * j + 9 * 4 * k), b = i + 3 * (j + 3 * k);
        EXPECT_EQ(fine.solid_share[a], coarse.solid_share[b]);
        EXPECT_EQ(fine.damage[a], coarse.damage[b]);
        EXPECT_EQ(fine.strain[a], coarse.strain[b]);
      }
}

TEST(coarse_grain, in_a_turned_frame_everything_is_turned) {
  SphereColumns s = shaken(6), turned;
  const double c = std::cos(.7), d = std::sin(.7);
  const std::array<double, 9> q{c, -d, 0, .6 * d, .6 * c, -.8, .8 * d, .8 * c, .6}; // proper, orthogonal
  const auto turn = [&q](const Vector3 &x) {
    return Vector3{q[0] * x.x + q[1] * x.y + q[2] * x.z, q[3] * x.x + q[4] * x.y + q[5] * x.z,
                   q[6] * x.x + q[7] * x.y + q[8] * x.z};
  };
  const auto turn_tensor = [&q](const std::array<double, 9> &t) {
    std::array<double, 9> out{};
    for (std::size_t r = 0; r < 3; ++r)
      for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t m = 0; m < 3; ++m)
          for (std::size_t n = 0; n < 3; ++n)
            out[3 * r + k] += q[3 * r + m] * t[3 * m + n] * q[3 * k + n];
    return out;
  };
  for (std::size_t i = 0; i < s.position.size(); ++i) {
    const Vector3 &x = s.position[i];
    s.displacement.push_back({std::sin(x.y), x.x * x.z, std::cos(x.x)});
    s.stress.push_back({x.x, x.y, 0, x.y, x.z, 1, 0, 1, -x.x});
    turned.position.push_back(turn(x));
    turned.displacement.push_back(turn(s.displacement[i]));
    turned.stress.push_back(turn_tensor(s.stress[i]));
  }
  turned.radius = s.radius;
  const Vector3 place{1.3, -.4, 2.1};
  const CoarseFields before = coarse_grain(s, {place, 1, {1, 1, 1}}, reach),
                     after = coarse_grain(turned, {turn(place), 1, {1, 1, 1}}, reach);
  const auto stress = turn_tensor(before.stress[0]), strain = turn_tensor(before.strain[0]);
  const Vector3 moved = turn(before.displacement[0]);
  EXPECT_NEAR(after.solid_share[0], before.solid_share[0], 1e-13);
  for (std::size_t k = 0; k < 9; ++k) {
    EXPECT_NEAR(after.stress[0][k], stress[k], 1e-12);
    EXPECT_NEAR(after.strain[0][k], strain[k], 1e-12);
  }
  for (int k = 0; k < 3; ++k)
    EXPECT_NEAR(after.displacement[0][k], moved[k], 1e-12);
}

TEST(coarse_grain, spheres_in_a_plane_have_a_displacement_but_no_strain) {
  SphereColumns s;
  for (int i = -3; i <= 3; ++i)
    for (int j = -3; j <= 3; ++j) {
      s.position.push_back({1.0 * i, 1.0 * j, 0});
      s.radius.push_back(.5);
      s.displacement.push_back({.1, 0, 0});
    }
  const CoarseFields f = coarse_grain(s, {{0, 0, 0}, 1, {1, 1, 1}}, reach);
  EXPECT_NEAR(f.displacement[0].x, .1, 1e-14);
  EXPECT_TRUE(std::isnan(f.strain[0][0]));
}

} // namespace
} // namespace platen::dem
