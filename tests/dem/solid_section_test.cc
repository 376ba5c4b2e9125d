// Specimens whose filled section is known.
#include "dem/measure/solid_section.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "dem/packing/advancing_front.h"
#include "dem/packing/growth.h"

namespace platen::dem::solid_section_test {
namespace {

constexpr double radius = 1e-3; // m

using Kept = std::function<bool(int, int, int)>;

// A simple cubic lattice in the box that it fills, without some of its places.
Specimen lattice(int along_x, int along_y, int along_z, const Kept &kept) {
  Specimen s;
  s.shape = box(2 * radius * along_x, 2 * radius * along_y, 2 * radius * along_z);
  for (int z = 0; z < along_z; ++z)
    for (int y = 0; y < along_y; ++y)
      for (int x = 0; x < along_x; ++x)
        if (kept(x, y, z)) {
          s.centre.push_back(
              {(2 * x + 1 - along_x) * radius, (2 * y + 1 - along_y) * radius, (2 * z + 1) * radius});
          s.radius.push_back(radius);
        }
  return s;
}
bool all(int, int, int) {
  return true;
}
bool hollow(int x, int y, int) {
  return x < 2 || x > 5 || y < 2 || y > 5;
}
Specimen without(const Specimen &whole, const std::function<bool(const Vector3 &)> &removed) {
  Specimen s;
  s.shape = whole.shape;
  for (std::size_t i = 0; i < whole.size(); ++i)
    if (!removed(whole.centre[i])) s.centre.push_back(whole.centre[i]), s.radius.push_back(whole.radius[i]);
  return s;
}
void expect_even(const SolidSection &section, double share, double within) {
  EXPECT_NEAR(section.mean, share, within);
  EXPECT_NEAR(section.least, share, within);
  EXPECT_NEAR(section.largest, share, within);
  EXPECT_TRUE(section.same_at_all_heights());
}

TEST(solid_section, a_lattice_fills_its_box_whatever_its_pores) {
  const SolidSection section = solid_section(lattice(8, 8, 16, all), 2);
  expect_even(section, 1, 1e-9);
  EXPECT_TRUE(section.fills());
}

TEST(solid_section, is_exact_of_hollow_lattices) {
  const SolidSection section = solid_section(lattice(8, 8, 16, hollow), 2);
  expect_even(section, 48. / 64, 1e-9);
  EXPECT_FALSE(section.fills());
  // No sphere is away from the hole.
  const Kept shell = [](int x, int y, int) { return x == 0 || x == 7 || y == 0 || y == 7; };
  expect_even(solid_section(lattice(8, 8, 16, shell), 2), 28. / 64, 1e-9);
  // At the wall; along another axis.
  expect_even(solid_section(lattice(10, 4, 20, [](int x, int, int) { return x < 5; }), 2), 0.5, 1e-9);
  expect_even(solid_section(lattice(20, 4, 6, [](int, int, int z) { return z < 4; }), 0), 4. / 6, 1e-9);
}

// What a notch has taken away belongs to the shape.
TEST(solid_section, a_notched_lattice_fills_what_is_left) {
  Specimen s = notched(lattice(12, 4, 6, all), {4 * radius, 4 * radius});
  expect_even(solid_section(s, 0), 1, 1e-9);
  s.shape.notch = {};
  EXPECT_LT(solid_section(s, 0).least, 0.8);
}

TEST(solid_section, is_the_same_of_any_size) {
  Specimen s = lattice(8, 8, 16, hollow);
  s.shape = scaled(s.shape, 50);
  for (std::size_t i = 0; i < s.size(); ++i)
    s.centre[i] *= 50, s.radius[i] *= 50;
  expect_even(solid_section(s, 2), 0.75, 1e-9);
}

TEST(solid_section, one_missing_column_is_seen) {
  const Kept kept = [](int x, int y, int) { return x != 3 || y != 3; };
  expect_even(solid_section(lattice(8, 8, 16, kept), 2), 63. / 64, 0.005);
  expect_even(solid_section(lattice(4, 4, 12, [](int x, int y, int) { return x != 1 || y != 1; }), 2),
              15. / 16, 0.015);
}

TEST(solid_section, a_shape_that_is_wider_than_the_specimen_is_not_filled) {
  Specimen s = lattice(8, 8, 16, all);
  s.shape = box(17.8e-3, 16e-3, 32e-3); // less than a sphere of room on either side
  expect_even(solid_section(s, 2), 16 / 17.8, 1e-6);
  s.shape = box(16e-3, 17e-3, 32e-3);
  expect_even(solid_section(s, 2), 16. / 17, 1e-6);
}

TEST(solid_section, a_notch_and_a_neck_have_their_range) {
  const SolidSection notch =
      solid_section(lattice(10, 4, 20, [](int x, int, int z) { return x > 2 || z < 9 || z > 10; }), 2);
  EXPECT_NEAR(notch.least, 0.7, 1e-9);
  EXPECT_NEAR(notch.largest, 1, 1e-9);
  const SolidSection thin =
      solid_section(lattice(10, 4, 20, [](int x, int, int z) { return x > 2 || z != 10; }), 2);
  EXPECT_NEAR(thin.least, 0.7, 0.05); // no higher than a slice
  const SolidSection neck = solid_section(
      lattice(10, 4, 20, [](int x, int, int z) { return (x > 1 && x < 8) || z < 6 || z > 13; }), 2);
  EXPECT_NEAR(neck.least, 0.6, 1e-9);
  EXPECT_NEAR(neck.largest, 1, 1e-9);
  for (const SolidSection &section : {notch, thin, neck}) {
    EXPECT_FALSE(section.same_at_all_heights());
    EXPECT_FALSE(section.fills());
  }
}

TEST(solid_section, packings_fill_their_shape) {
  for (const double spread : {0.0, 0.25, 0.5}) {
    const Specimen round = random_close_packing(cylinder(10e-3, 20e-3), radius, spread, 1);
    const Specimen packings[] = {
        round,
        laid_down(round),
        random_close_packing(box(10e-3, 10e-3, 20e-3), 0.8e-3, spread, 2),
        random_close_packing(cylinder(5e-3, 10e-3), 0.9e-3, spread, 2),
        advancing_front(cylinder(10e-3, 20e-3), uniform_radii_of_spread(0.85e-3, spread), 3),
        advancing_front(box(10e-3, 10e-3, 20e-3), uniform_radii_of_spread(0.85e-3, spread), 3)};
    for (const Specimen &packing : packings) {
      const SolidSection section = solid_section(packing, 2);
      EXPECT_TRUE(section.fills()) << packing.size() << " " << section.mean << " " << section.least;
      EXPECT_TRUE(section.same_at_all_heights());
      EXPECT_LE(section.largest, 1);
    }
    EXPECT_GT(solid_section(round, 2).least, 0.999);
  }
  EXPECT_TRUE(
      solid_section(advancing_front(cylinder(10e-3, 20e-3), two_radii(0.5e-3, 1.2e-3, 0.3), 3), 2).fills());
}

// Half of the radius is bored out, or a waist of .7 of it turned: ragged by half a sphere.
TEST(solid_section, a_bored_and_a_turned_packing_are_within_its_accuracy) {
  const Specimen whole = random_close_packing(cylinder(10e-3, 20e-3), 0.8e-3, 0.25, 1);
  const auto from_axis = [](const Vector3 &c) { return std::sqrt(c.x * c.x + c.y * c.y); };
  const SolidSection bored =
      solid_section(without(whole, [&](const Vector3 &c) { return from_axis(c) < 5e-3; }), 2);
  expect_even(bored, 0.75, 0.03);
  const SolidSection turned = solid_section(
      without(whole, [&](const Vector3 &c) { return from_axis(c) > 7e-3 && c.z > 6e-3 && c.z < 14e-3; }), 2);
  EXPECT_NEAR(turned.least, 0.49, 0.05);
  EXPECT_GT(turned.largest, 0.98);
  EXPECT_FALSE(turned.same_at_all_heights());
}

TEST(solid_section, of_nothing_is_not_a_number) {
  Specimen nothing;
  nothing.shape = box(1, 1, 1);
  EXPECT_TRUE(std::isnan(solid_section(nothing, 2).mean));
  EXPECT_FALSE(SolidSection{}.fills());
}

} // namespace
} // namespace platen::dem::solid_section_test
