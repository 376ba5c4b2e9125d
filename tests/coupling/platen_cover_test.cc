// What a platen covers of a specimen's end: areas of plates, punches, pins and meshes in another unit.
#include "coupling/platen_cover.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/pi.h"
#include "fem/grids.h"

namespace platen::coupling::platen_cover_test {
namespace {

// Of a plate below a specimen, its upper face at z = 0 m or below.
fem::SurfaceMesh plate(double low_x, double high_x, double low_y, double high_y, double top = 0) {
  return fem::extract_surface(
             fem::make_grid(fem::BoxPlate{{low_x, low_y, top - 0.01}, {high_x, high_y, top}, {4, 4, 2}}))
      .surface;
}

constexpr double depth = 2e-3; // m
const dem::Shape cube = dem::box(0.02, 0.04, 0.05), cylinder = dem::cylinder(0.01, 0.03);

TEST(PlatenCover, of_a_wide_plate_is_all) {
  for (const dem::Shape &shape : {cube, cylinder}) {
    const PlatenCover cover = cover_of(shape, plate(-0.03, 0.03, -0.025, 0.025), Side::bottom, 0, depth);
    EXPECT_EQ(cover.facing, 1);
    EXPECT_EQ(cover.within_reach, 1);
    EXPECT_NEAR(cover.extent[0], 0.06, 1e-12);
    EXPECT_NEAR(cover.extent[1], 0.05, 1e-12);
  }
}

TEST(PlatenCover, of_a_punch_is_its_share_of_the_end) {
  // x from -5 mm on: three quarters of a box; of a circle 1/2 + (sqrt(3)/4 + pi/6) / pi.
  const fem::SurfaceMesh punch = plate(-0.005, 0.03, -0.03, 0.03);
  const PlatenCover of_box = cover_of(cube, punch, Side::bottom, 0, depth);
  EXPECT_NEAR(of_box.facing, 0.75, 1e-12);
  EXPECT_NEAR(of_box.within_reach, 0.75, 1e-12);
  const double segment = 0.5 + (std::sqrt(3.0) / 4 + pi / 6) / pi;
  EXPECT_NEAR(cover_of(cylinder, punch, Side::bottom, 0, depth).facing, segment, 2e-3);
}

TEST(PlatenCover, gaps_between_pins_are_not_faced_but_within_reach) {
  const std::vector<fem::BoxPlate> pins{{{-0.02, -0.03, -0.01}, {-0.002, 0.03, 0}, {2, 2, 2}},
                                        {{0.002, -0.03, -0.01}, {0.02, 0.03, 0}, {2, 2, 2}}};
  const PlatenCover cover =
      cover_of(cube, fem::extract_surface(fem::make_grid(pins)).surface, Side::bottom, 0, depth);
  EXPECT_NEAR(cover.facing, 0.8, 0.01); // 4 of 20 mm are open
  EXPECT_EQ(cover.within_reach, 1);
}

TEST(PlatenCover, faces_that_look_away_or_lie_deep_do_not_count) {
  const fem::SurfaceMesh below = plate(-0.03, 0.03, -0.03, 0.03);
  EXPECT_EQ(cover_of(cube, below, Side::top, 0, depth).facing,
            0); // its face looks up, out of a specimen below
  EXPECT_EQ(cover_of(cube, plate(-0.03, 0.03, -0.03, 0.03, -0.0021), Side::bottom, 0, depth).facing, 0);
  EXPECT_EQ(cover_of(cube, plate(-0.03, 0.03, -0.03, 0.03, -0.0019), Side::bottom, 0, depth).facing, 1);
}

TEST(PlatenCover, an_edge_that_neighbours_need_is_no_gap) {
  const fem::SurfaceMesh short_of_edges = plate(-0.0098, 0.0098, -0.03, 0.03);
  EXPECT_LT(cover_of(cube, short_of_edges, Side::bottom, 0, depth).within_reach, 0.99);
  const PlatenCover cover = cover_of(cube, short_of_edges, Side::bottom, 0, depth, 2.1e-4);
  EXPECT_EQ(cover.within_reach, 1);
  EXPECT_LT(cover.facing, 0.99);
}

TEST(PlatenCover, of_a_side_is_seen_along_its_axis) {
  // A plate upright at x = -10 mm that faces +x and ends at y = 0: half of the side.
  const fem::Grid grid = fem::make_grid(fem::BoxPlate{{-0.03, -0.05, -0.02}, {0, 0.1, -0.01}, {2, 2, 2}});
  const fem::Grid upright =
      fem::moved_grid(grid, [](const Vector3 &x) { return from_upright(Side::left, x); });
  const PlatenCover cover = cover_of(cube, fem::extract_surface(upright).surface, Side::left, -0.01, depth);
  EXPECT_NEAR(cover.facing, 0.5, 1e-12);
}

} // namespace
} // namespace platen::coupling::platen_cover_test
