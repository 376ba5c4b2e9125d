// Stresses over what a specimen fills of its shape.
#include <gtest/gtest.h>

#include <functional>

#include "coupling/static_press.h"
#include "tests/coupling/set_ups.h"

namespace platen::coupling::net_section_test {
namespace {

constexpr double radius = 1e-3; // m
constexpr int wide = 8, high = 12;

// Columns of a simple cubic lattice in the box that it fills, without places of the inner 4 x 4.
dem::Specimen lattice(const std::function<bool(int)> &hollow_at) {
  dem::Specimen s;
  s.shape = dem::box(2 * radius * wide, 2 * radius * wide, 2 * radius * high);
  for (int z = 0; z < high; ++z)
    for (int y = 0; y < wide; ++y)
      for (int x = 0; x < wide; ++x) {
        const bool inner = x > 1 && x < 6 && y > 1 && y < 6;
        if (inner && hollow_at(z)) continue;
        s.centre.push_back({(2 * x + 1 - wide) * radius, (2 * y + 1 - wide) * radius, (2 * z + 1) * radius});
        s.radius.push_back(radius);
      }
  return s;
}
bool everywhere(int) {
  return true;
}
bool nowhere(int) {
  return false;
}
bool in_the_middle(int z) {
  return z > 3 && z < 8;
}

PlatenTestSettings settings(bool net) {
  PlatenTestSettings s = elastic_settings(0.5, unbreakable_bond());
  s.platens.top = s.platens.bottom = {0, 0};
  s.net_section = net;
  return s;
}

TEST(net_section, makes_the_modulus_of_a_hollow_lattice_that_of_a_whole_one) {
  PlatenTest whole(lattice(nowhere), settings(false)), nominal(lattice(everywhere), settings(false)),
      net(lattice(everywhere), settings(true));
  const double right = press_statically(whole, 1e-5).youngs_modulus();
  EXPECT_NEAR(press_statically(net, 1e-5).youngs_modulus() / right, 1, 1e-6);
  EXPECT_NEAR(press_statically(nominal, 1e-5).youngs_modulus() / right, 0.75, 1e-6);
  EXPECT_NEAR(net.nominal_area() / whole.nominal_area(), 0.75, 1e-12);
  EXPECT_EQ(nominal.nominal_area(), whole.nominal_area());
  // Of what bears; a wave runs through the same.
  EXPECT_NEAR(net.facts().voigt_modulus * 0.75 / nominal.facts().voigt_modulus, 1, 1e-12);
  for (std::size_t axis = 0; axis < 3; ++axis)
    EXPECT_NEAR(net.facts().affine_moduli[axis] * 0.75 / nominal.facts().affine_moduli[axis], 1, 1e-12);
  EXPECT_EQ(net.facts().wave_transit, nominal.facts().wave_transit);
}

TEST(net_section, of_a_specimen_that_fills_its_shape_is_the_nominal_one) {
  const PlatenTest whole(lattice(nowhere), settings(true));
  EXPECT_TRUE(whole.section().fills());
  EXPECT_EQ(whole.section_fraction(), 1);
  EXPECT_EQ(whole.nominal_area(), whole.shape().cross_section());
}

TEST(net_section, that_changes_with_height_is_refused) {
  const dem::Specimen cave = lattice(in_the_middle);
  const PlatenTest nominal(cave, settings(false));
  EXPECT_NEAR(nominal.section().least, 0.75, 0.01);
  EXPECT_NEAR(nominal.section().largest, 1, 0.01);
  EXPECT_EQ(nominal.section_fraction(), 1);
  expect_refused(cave, settings(true), "net_section", "fill 75 to 100 % of the shape's section by height");
}

} // namespace
} // namespace platen::coupling::net_section_test
