#include "apps/report/specimen_view.h"

#include <gtest/gtest.h>

#include <cmath>

namespace platen::apps::report {
namespace {

// One sphere at p0 before the test and at p now.
void add_sphere(Spheres &spheres, const std::array<double, 3> &p0, const std::array<double, 3> &p) {
  spheres.initial.push_back(p0);
  spheres.position.push_back(p);
  spheres.radius.push_back(0.001);
  spheres.intact_bonds.push_back(0);
  spheres.broken_bonds.push_back(0);
  spheres.id.push_back(static_cast<long long>(spheres.id.size()));
}

TEST(ReportSpecimen, a_sphere_does_not_come_or_go_as_it_crosses_the_cut) {
  Spheres spheres;
  add_sphere(spheres, {0, -0.001, 0}, {0, 0.002, 0});
  add_sphere(spheres, {0, 0.001, 0}, {0, -0.002, 0});
  EXPECT_EQ(rows_shown(spheres, false), std::vector<std::size_t>{0});
}

TEST(ReportSpecimen, outward_displacement_is_radial_and_turning_about_the_axis_gives_none) {
  Spheres spheres;
  add_sphere(spheres, {0.003, 0.004, 0.01}, {0.006, 0.008, 0.02});
  add_sphere(spheres, {0.003, 0.004, 0.01}, {-0.004, 0.003, 0.01});
  EXPECT_NEAR(spheres.outward_displacement(0), 0.005, 1e-15);
  EXPECT_NEAR(spheres.outward_displacement(1), 0, 1e-15);
  EXPECT_NEAR(spheres.displacement(0), std::hypot(0.005, 0.01), 1e-15);
}

TEST(ReportSpecimen, damage_is_the_broken_share_and_a_sphere_without_bonds_has_none) {
  Spheres spheres;
  add_sphere(spheres, {}, {});
  EXPECT_EQ(spheres.damage(0), 0);
  spheres.intact_bonds[0] = 1;
  spheres.broken_bonds[0] = 3;
  EXPECT_EQ(spheres.damage(0), 0.75);
}

TEST(ReportSpecimen, a_cylinder_is_told_from_a_box_by_its_corners) {
  Spheres cylinder, box;
  for (int i = -10; i <= 10; ++i)
    for (int j = -10; j <= 10; ++j) {
      const double x = 0.002 * i, y = 0.002 * j;
      add_sphere(box, {x, y, 0.05}, {x, y, 0.05});
      if (std::hypot(x, y) <= 0.02) add_sphere(cylinder, {x, y, 0.05}, {x, y, 0.05});
    }
  EXPECT_EQ(extent_of(cylinder).form, Extent::Form::cylinder);
  EXPECT_EQ(extent_of(box).form, Extent::Form::box);
  EXPECT_FALSE(extent_of(box).is_plane());
  EXPECT_NEAR(extent_of(box).half_width, 0.021, 1e-12); // centres reach to 0.02, skins one radius further
  EXPECT_NEAR(extent_of(box).height(), 0.002, 1e-12);
}

// The window is never drawn: what stands where must not hang on what it says of itself before.
TEST(ReportSpecimen, a_wide_extent_fills_the_width_of_its_part_and_a_high_one_the_height) {
  Canvas canvas(1500, 1000);
  vtkRenderer *left = canvas.add_renderer({0, 0, 0.5, 1}), *right = canvas.add_renderer({0.5, 0.2, 1, 1});
  EXPECT_DOUBLE_EQ(canvas.aspect(left), 0.75);
  Extent wide, high;
  wide.bottom = high.bottom = 0;
  wide.top = 0.01, wide.half_width = 0.02, wide.half_depth = 0.02;
  high.top = 0.1, high.half_width = 0.02, high.half_depth = 0.02;
  look_at_cut(canvas, left, wide, 0);
  look_at_cut(canvas, right, high, 0);
  EXPECT_NEAR(canvas.on_window(left, {0, 0, 0.005})[0], 0.25, 1e-12);
  EXPECT_NEAR(canvas.on_window(left, {0, 0, 0.005})[1], 0.5, 1e-12);
  const double one_side = canvas.on_window(left, {0.02, 0, 0.005})[0],
               other = canvas.on_window(left, {-0.02, 0, 0.005})[0];
  EXPECT_NEAR(std::abs(one_side - other), 0.5, 1e-12);
  EXPECT_NEAR(canvas.on_window(right, {0, 0, 0.05})[1], 0.6, 1e-12);
  const double seen = canvas.on_window(right, {0, 0, 0.1})[1] - canvas.on_window(right, {0, 0, 0})[1];
  EXPECT_GT(seen, 0.79); // of 0.8, from a little above
  EXPECT_LE(seen, 0.8);
}

TEST(ReportSpecimen, a_disc_lies_on_its_rim_and_a_bar_is_longer_than_deep) {
  Spheres disc, bar;
  for (int i = -10; i <= 10; ++i)
    for (int j = -10; j <= 10; ++j)
      for (int k = -2; k <= 2; ++k) {
        const double x = 0.002 * i, z = 0.002 * j, y = 0.002 * k;
        if (std::hypot(x, z) <= 0.02) add_sphere(disc, {x, y, 0.02 + z}, {x, y, 0.02 + z});
        if (std::abs(j) <= 2) add_sphere(bar, {x, y, 0.004 + z}, {x, y, 0.004 + z});
      }
  EXPECT_EQ(extent_of(disc).form, Extent::Form::disc);
  EXPECT_NEAR(extent_of(disc).half_depth, 0.005, 1e-12);
  EXPECT_TRUE(extent_of(disc).is_plane());
  EXPECT_EQ(extent_of(bar).form, Extent::Form::box);
  EXPECT_TRUE(extent_of(bar).is_plane());
}

TEST(ReportSpecimen, one_splinter_does_not_take_the_colours_from_the_rest) {
  CutView view;
  for (int k = 0; k < 100; ++k) {
    add_sphere(view.spheres, {0, -1, 0}, {0, -1, 0});
    view.values.push_back(k == 99 ? 1e3 : 0.4);
  }
  const std::vector<double> ticks = ticks_for({view});
  EXPECT_EQ(ticks.front(), 0);
  EXPECT_GE(ticks.back(), 0.4);
  EXPECT_LT(ticks.back(), 1);
}

} // namespace
} // namespace platen::apps::report
