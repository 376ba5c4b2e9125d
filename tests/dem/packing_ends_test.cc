// Seats of a specimen's ends, and the plain-word check of a specimen.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "base/pi.h"
#include "dem/packing/specimen.h"

namespace platen::dem::packing_ends_test {
namespace {

// Unit spheres with gaps of 0, .4, .6 and 1.5 to z = 0, and of 0, .2 to z = 20; mean radius 1.
Specimen column() {
  Specimen s;
  s.shape = box(20, 4, 20);
  s.centre = {{-8, 0, 1}, {-5, 0, 1.4}, {-2, 0, 1.6}, {1, 0, 2.5}, {4, 0, 19}, {7, 0, 18.8}};
  s.radius.assign(6, 1.0);
  return s;
}

TEST(SpecimenEnds, seat_the_spheres_of_the_end_layer_at_their_own_gap) {
  const SpecimenEnds ends = seat_ends(column(), EndPreparation::ground, 0.5);
  EXPECT_EQ(ends.bottom.particle, (std::vector<int>{0, 1}));
  EXPECT_EQ(ends.top.particle, (std::vector<int>{4, 5}));
  EXPECT_NEAR(ends.bottom.offset[0], 0.0, 1e-15);
  EXPECT_NEAR(ends.bottom.offset[1], 0.4, 1e-15);
  EXPECT_NEAR(ends.top.offset[1], 0.2, 1e-14);
}

TEST(SpecimenEnds, seat_more_spheres_in_a_thicker_layer) {
  EXPECT_EQ(seat_ends(column(), EndPreparation::ground, 0).bottom.particle.size(), 1u);
  EXPECT_EQ(seat_ends(column(), EndPreparation::ground, 1).bottom.particle.size(), 3u);
  EXPECT_EQ(seat_ends(column(), EndPreparation::ground, 2).bottom.particle.size(), 4u);
}

TEST(SpecimenEnds, measure_the_layer_in_mean_radii) {
  Specimen s = column();
  s.radius[3] = 4.0; // mean radius 1.5, and this sphere reaches below the plane: offset -1.5
  const SpecimenEnds ends = seat_ends(s, EndPreparation::ground, 0.5);
  EXPECT_EQ(ends.bottom.particle, (std::vector<int>{0, 1, 2, 3}));
  EXPECT_NEAR(ends.bottom.offset[3], -1.5, 1e-15);
}

TEST(SpecimenEnds, seat_nothing_as_packed) {
  const SpecimenEnds ends = seat_ends(column(), EndPreparation::as_packed, 1);
  EXPECT_TRUE(ends.bottom.particle.empty());
  EXPECT_TRUE(ends.top.particle.empty());
}

TEST(SpecimenEnds, refuse_a_layer_that_is_none) {
  EXPECT_THROW(seat_ends(column(), EndPreparation::ground, -0.1), std::invalid_argument);
  EXPECT_THROW(seat_ends(column(), EndPreparation::ground, std::nan("")), std::invalid_argument);
}

// Of a cylinder of radius 2 and of a box, whose rim are its corners.
TEST(SpecimenEnds, have_faces_of_a_height_from_their_highest_point) {
  const Shape round = cylinder(2, 5), square = box(6, 8, 5);
  const auto depth = [](EndPreparation form, const Shape &shape, double x, double y) {
    return depth_of_face(form, 0.1, shape, {x, y, 5});
  };
  EXPECT_EQ(depth(EndPreparation::ground, round, 1, 1), 0);
  EXPECT_EQ(depth(EndPreparation::convex, round, 0, 0), 0);
  EXPECT_NEAR(depth(EndPreparation::convex, round, 1, 0), 0.025, 1e-15);
  EXPECT_NEAR(depth(EndPreparation::convex, round, 0, -2), 0.1, 1e-15);
  EXPECT_NEAR(depth(EndPreparation::concave, round, 0, 0), 0.1, 1e-15);
  EXPECT_NEAR(depth(EndPreparation::concave, round, 0, 2), 0, 1e-15);
  EXPECT_NEAR(depth(EndPreparation::not_parallel, round, -2, 1), 0, 1e-15);
  EXPECT_NEAR(depth(EndPreparation::not_parallel, round, 1, 1), 0.075, 1e-15);
  EXPECT_NEAR(depth(EndPreparation::convex, square, 3, -4), 0.1, 1e-15);
  EXPECT_NEAR(depth(EndPreparation::convex, square, 3, 0), 0.036, 1e-15);
  EXPECT_NEAR(depth(EndPreparation::not_parallel, square, 3, 0), 0.1, 1e-15);
}

TEST(SpecimenEnds, are_rough_by_chance_by_place_and_seed) {
  const Shape round = cylinder(2, 5);
  double sum = 0, squares = 0;
  constexpr int count = 10000;
  for (int k = 0; k < count; ++k) {
    const double depth = depth_of_face(EndPreparation::rough, 0.1, round, {1e-4 * k, 0, 5}, 3);
    EXPECT_GE(depth, 0);
    EXPECT_LT(depth, 0.1);
    sum += depth, squares += depth * depth;
  }
  const double mean = sum / count;
  EXPECT_NEAR(mean, 0.05, 4 * 0.1 / std::sqrt(12.0 * count));
  EXPECT_NEAR(squares / count - mean * mean, 0.01 / 12, 1e-5);
  const Vector3 place{0.5, 1, 5};
  EXPECT_EQ(depth_of_face(EndPreparation::rough, 0.1, round, place, 3),
            depth_of_face(EndPreparation::rough, 0.1, round, place, 3));
  EXPECT_NE(depth_of_face(EndPreparation::rough, 0.1, round, place, 3),
            depth_of_face(EndPreparation::rough, 0.1, round, place, 4));
  EXPECT_NE(depth_of_face(EndPreparation::rough, 0.1, round, {0.5, 1, 4}, 3),
            depth_of_face(EndPreparation::rough, 0.1, round, place, 3));
}

TEST(SpecimenCheck, finds_nothing_wrong_with_a_good_specimen) {
  EXPECT_TRUE(check_specimen(column()).empty());
}

void expect_one_problem(const Specimen &s, const std::string &words) {
  const std::vector<std::string> problems = check_specimen(s);
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_NE(problems[0].find(words), std::string::npos) << problems[0];
}

TEST(SpecimenCheck, names_the_sphere_and_what_is_wrong_with_it) {
  Specimen s = column();
  s.radius[2] = -1;
  expect_one_problem(s, "sphere 2 has radius -1 m");
  s.radius[2] = std::numeric_limits<double>::infinity();
  expect_one_problem(s, "sphere 2");
  s = column();
  s.centre[4].y = std::nan("");
  expect_one_problem(s, "sphere 4 has a centre that is not finite");
  s = column();
  s.centre[1].z = 0.9;
  expect_one_problem(s, "sphere 1 reaches 0.1 m out of the shape");
  s = column();
  s.radius.pop_back();
  expect_one_problem(s, "6 centres but 5 radii");
  expect_one_problem(Specimen{box(1, 1, 1), {}, {}}, "no spheres");
}

TEST(SpecimenCheck, names_both_of_two_coincident_spheres) {
  for (const double apart : {0.0, 1e-300, 1e-16}) {
    Specimen s = column();
    s.centre[5] = s.centre[1] + Vector3{apart, 0, 0};
    expect_one_problem(s, "spheres 1 and 5 have the same centre");
  }
}

TEST(SpecimenCheck, counts_problems_beyond_the_first_ten) {
  Specimen s;
  s.shape = box(1, 1, 1);
  s.centre.assign(25, Vector3{});
  s.radius.assign(25, -1.0);
  const std::vector<std::string> problems = check_specimen(s);
  ASSERT_EQ(problems.size(), 11u);
  EXPECT_EQ(problems.back(), "and 15 more");
}

TEST(SpecimenMeasures, agree_with_plain_geometry) {
  const Specimen s = column();
  const BoundingBox bounds = bounding_box(s);
  EXPECT_DOUBLE_EQ(bounds.low.x, -9.0);
  EXPECT_DOUBLE_EQ(bounds.high.z, 20.0);
  EXPECT_DOUBLE_EQ(mean_radius(s), 1.0);
  EXPECT_NEAR(surface_area(cylinder(2, 3)), 2 * pi * 2 * 5, 1e-12);
  EXPECT_DOUBLE_EQ(surface_area(box(1, 2, 3)), 22.0);
  EXPECT_DOUBLE_EQ(smallest_width(cylinder(2, 3)), 3.0);
  EXPECT_DOUBLE_EQ(wall_clearance(cylinder(2, 3), {1, 0, 1.5}), 1.0);
  EXPECT_DOUBLE_EQ(wall_clearance(box(2, 4, 6), {0, 2.5, 3}), -0.5);
}

} // namespace
} // namespace platen::dem::packing_ends_test
