// Random close packing by growth: jammed, hardly overlapping, dense, at the wanted size, repeatable.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <tuple>

#include "dem/packing/growth.h"
#include "dem/packing/quality.h"

namespace platen::dem::packing_growth_test {
namespace {

// About 900 spheres in a cylinder of ten mean radii; made once.
struct Jammed {
  GrowthReport report;
  Specimen specimen;
  PackingQuality quality;
};
const Jammed &jammed() {
  static const Jammed made = [] {
    Jammed j;
    j.specimen = random_close_packing(cylinder(10e-3, 20e-3), 1e-3, 0.25, 4, &j.report);
    j.quality = judge_packing(j.specimen);
    return j;
  }();
  return made;
}

TEST(GrowthPacking, meets_the_wanted_mean_radius) {
  EXPECT_NEAR(mean_radius(jammed().specimen), 1e-3, 1e-5);
  EXPECT_EQ(jammed().report.spheres, jammed().specimen.size());
  EXPECT_DOUBLE_EQ(jammed().report.mean_radius, mean_radius(jammed().specimen));
}

TEST(GrowthPacking, hardly_overlaps_and_stays_inside) {
  // Brute force over all pairs, against the figures of the report.
  const Specimen &s = jammed().specimen;
  const double mean = mean_radius(s);
  double largest = 0;
  for (std::size_t i = 0; i < s.size(); ++i) {
    largest = std::max(largest, s.radius[i] - wall_clearance(s.shape, s.centre[i]));
    for (std::size_t j = 0; j < i; ++j)
      largest = std::max(largest, s.radius[i] + s.radius[j] - norm(s.centre[i] - s.centre[j]));
  }
  EXPECT_LT(largest, 8e-4 * mean);
  EXPECT_NEAR(jammed().report.max_overlap, largest / mean, 1e-9);
  EXPECT_LT(jammed().report.mean_overlap, 1e-4);
  EXPECT_TRUE(check_specimen(s).empty());
}

TEST(GrowthPacking, is_at_rest_under_its_contact_forces) {
  EXPECT_LT(jammed().report.residual_force, 5e-3);
  EXPECT_GT(jammed().report.mean_overlap, 1e-6); // it presses: not a loose heap that touches nowhere
}

TEST(GrowthPacking, is_close_packed_in_its_core) {
  // Jammed soft spheres lie at .635 to .645 with six contacts (O'Hern et al. 2003); 150 core spheres scatter
  // by .01.
  EXPECT_GT(jammed().quality.core_packing_fraction, 0.625);
  EXPECT_LT(jammed().quality.core_packing_fraction, 0.67);
  EXPECT_NEAR(jammed().quality.core_coordination_number, 6.0, 0.25);
}

TEST(GrowthPacking, is_nearly_isostatic) {
  // A frictionless jammed packing has three contacts, walls included, per sphere: fewer cannot hold it, and
  // pressing adds more only with the square root of the overlap. Seated rattlers have three as well.
  const Specimen &s = jammed().specimen;
  std::size_t contacts = touching_pairs(s, 0).size();
  for (std::size_t i = 0; i < s.size(); ++i) {
    const double r = s.radius[i];
    const Vector3 &c = s.centre[i];
    contacts += (c.z <= r) + (s.shape.height - c.z <= r) + (s.shape.radius - std::hypot(c.x, c.y) <= r);
  }
  const double per_sphere = static_cast<double>(contacts) / static_cast<double>(s.size());
  EXPECT_GT(per_sphere, 2.9);
  EXPECT_LT(per_sphere, 3.15);
}

TEST(GrowthPacking, meets_flat_ends_with_many_spheres) {
  // Grown against the ends, spheres cover about .65 of each; a packing cut from a larger one covers almost
  // nothing.
  EXPECT_GT(jammed().quality.cover_bottom, 0.5);
  EXPECT_GT(jammed().quality.cover_top, 0.5);
}

TEST(GrowthPacking, spreads_radii_evenly) {
  const Specimen &s = jammed().specimen;
  const double mean = mean_radius(s);
  EXPECT_NEAR(smallest_radius(s) / mean, 1 - 0.125, 1e-3);
  EXPECT_NEAR(largest_radius(s) / mean, 1 + 0.125, 1e-3);
  double square = 0;
  for (const double r : s.radius)
    square += (r / mean - 1) * (r / mean - 1);
  EXPECT_NEAR(std::sqrt(square / static_cast<double>(s.size())), 0.25 / std::sqrt(12.0), 1e-4);
}

TEST(GrowthPacking, fills_boxes_and_equal_spheres) {
  GrowthReport report;
  const Specimen s = random_close_packing_of(box(10, 12, 8), 250, 0, 2, &report);
  EXPECT_EQ(s.size(), 250u);
  EXPECT_EQ(smallest_radius(s), largest_radius(s));
  EXPECT_LT(report.max_overlap, 1e-3);
  EXPECT_TRUE(check_specimen(s).empty());
  EXPECT_GT(report.packing_fraction, 0.53); // .64 less the loss at walls of a small box
  const PackingQuality q = judge_packing(s);
  EXPECT_GT(q.touching_bottom, 10u);
  EXPECT_GT(q.touching_top, 10u);
}

TEST(GrowthPacking, grows_one_sphere_to_fill_its_box_or_cylinder) {
  for (const Shape &shape : {box(2, 3, 4), cylinder(1, 4)}) {
    const Specimen s = random_close_packing_of(shape, 1, 0.25, 1);
    EXPECT_NEAR(s.radius[0], 1.0, 1e-3);
    EXPECT_NEAR(s.centre[0].x, 0.0, 1e-3);
    if (shape.radius > 0) {
      EXPECT_NEAR(std::hypot(s.centre[0].x, s.centre[0].y), 0.0, 1e-3);
    }
  }
}

TEST(GrowthPacking, keeps_its_form_in_any_unit_of_length) {
  const Specimen m = random_close_packing_of(cylinder(5e-3, 10e-3), 60, 0.25, 3),
                 mm = random_close_packing_of(cylinder(5, 10), 60, 0.25, 3);
  for (std::size_t i = 0; i < m.size(); ++i)
    EXPECT_NEAR(1e3 * m.centre[i].z, mm.centre[i].z,
                1e-2); // round-off may pick other contacts, not other places
  EXPECT_NEAR(1e3 * m.radius[0], mm.radius[0], 1e-3 * mm.radius[0]);
}

TEST(GrowthPacking, refuses_what_cannot_be_packed) {
  const double nan = std::nan("");
  for (const auto &[shape, radius, spread] : {std::tuple{cylinder(1, 1), 0.6, 0.25},
                                              {disc(1, 0.5), 0.1, 0.25},
                                              {cylinder(1, 0), 0.1, 0.25},
                                              {cylinder(1, 1), -0.1, 0.25},
                                              {cylinder(1, 1), nan, 0.25},
                                              {cylinder(1, 1), 0.1, -0.25},
                                              {cylinder(1, 1), 0.1, 2.5},
                                              {cylinder(1, 1), 1e-4, 0.25}}) // too many
    EXPECT_THROW(random_close_packing(shape, radius, spread, 1), std::invalid_argument) << radius << spread;
  EXPECT_THROW(random_close_packing_of(disc(1, 0.5), 50, 0.25, 1), std::invalid_argument);
  EXPECT_THROW(random_close_packing_of(cylinder(1, 1), 0, 0.25, 1), std::invalid_argument);
}

} // namespace
} // namespace platen::dem::packing_growth_test
