// Widths of cracks: planes that are opened by hand, turns that open nothing, what leads through and what
// flows.
#include "dem/measure/openings.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/dem/examples.h"

namespace platen::dem::openings_test {
namespace {

using namespace examples;

constexpr int nx = 5, ny = 6, nz = 8;
constexpr double width = 120e-6; // m

// A cubic lattice of touching spheres, whose bonds across z = `cut` spheres are broken by hand.
class OpenedLattice : public ::testing::Test {
protected:
  OpenedLattice() : specimen_(cubic(nx, ny, nz)), model_(specimen_, bonded()) {}

  bool is_above(std::size_t i, int cut) const {
    return model_.particles.reference_position[i].z > 2 * cut * radius;
  }
  // Moves what lies above and marks the bonds between.
  void part(int cut, const Vector3 &by) {
    Particles &p = model_.particles;
    for (std::size_t i = 0; i < p.size(); ++i)
      if (is_above(i, cut)) p.position[i] += by;
    Bonds &b = *model_.bonds;
    for (std::size_t k = 0; k < b.initial_count(); ++k)
      if (is_above(static_cast<std::size_t>(b.record_first[k]), cut) !=
          is_above(static_cast<std::size_t>(b.record_second[k]), cut))
        b.state[k] = static_cast<int>(BondState::broken_in_tension);
  }
  std::vector<Opening> found() const { return openings(model_.particles, *model_.bonds); }
  CrackWidths widths(double roughness = 1) const {
    return crack_widths(found(), model_.particles, *model_.bonds, bonded().bond_layout, specimen_.shape,
                        roughness);
  }

  Specimen specimen_;
  Model model_;
};

// Snow 1969: a plane of width b opened by w lets b w^3/12 through for each unit of gradient over viscosity.
TEST_F(OpenedLattice, a_plane_lets_through_w_cubed_over_twelve) {
  part(4, {0, 0, width});
  const Shape &shape = specimen_.shape;
  const CrackWidths w = widths();
  EXPECT_EQ(w.open, nx * ny);
  EXPECT_NEAR(w.largest / width, 1, 1e-12);
  EXPECT_NEAR(w.mean / width, 1, 1e-12);
  EXPECT_NEAR(w.volume / (shape.width_x * shape.width_y * width), 1, 1e-12);
  const double cube = width * width * width / 12;
  EXPECT_NEAR(w.permeability[0] * shape.height / cube, 1, 1e-11); // times the section over the width
  EXPECT_NEAR(w.permeability[1] * shape.height / cube, 1, 1e-11);
  EXPECT_NEAR(widths(0.3).permeability[0] / w.permeability[0], 0.3, 1e-12);
  EXPECT_EQ(w.permeability[2], 0); // the plane does not lead from bottom to top
  EXPECT_TRUE(std::isnan(w.through[2]));
  EXPECT_NEAR(w.through[0] / width, 1, 1e-12);
  EXPECT_NEAR(w.through[1] / width, 1, 1e-12);
  EXPECT_EQ(w.wider[0], 1);
  EXPECT_EQ(w.wider[1], 1);
  EXPECT_EQ(w.wider[2], 0);
}

TEST_F(OpenedLattice, opening_and_slip_are_along_and_across_the_normal) {
  part(4, {3e-5, -4e-5, 7e-5});
  for (const Opening &o : found()) {
    EXPECT_NEAR(o.opening, 7e-5, 1e-17);
    EXPECT_NEAR(o.slip, 5e-5, 1e-17);
    EXPECT_NEAR(o.place.z, 8 * radius, 1e-15);
    const Bonds &b = *model_.bonds;
    EXPECT_EQ(o.second_moves, is_above(static_cast<std::size_t>(b.record_second[o.record]), 4));
  }
  part(4, {0, 0, -9e-5}); // pressed together again
  const CrackWidths w = widths();
  EXPECT_NEAR(found().front().opening, -2e-5, 1e-17);
  EXPECT_EQ(w.open, 0);
  EXPECT_EQ(w.volume, 0);
  EXPECT_TRUE(std::isnan(w.largest) && std::isnan(w.mean) && std::isnan(w.through[0]));
  EXPECT_EQ(w.permeability[0], 0);
  EXPECT_EQ(w.wider[0], 0);
}

// Both halves turn as one body by a large angle: the crack between them stays as wide as it was.
TEST_F(OpenedLattice, a_common_turn_opens_nothing) {
  part(4, {3e-5, 0, width});
  const Quaternion turn = rotation_quaternion({0.9, -0.4, 1.1});
  Particles &p = model_.particles;
  for (std::size_t i = 0; i < p.size(); ++i) {
    p.position[i] = rotate(turn, p.position[i]) + Vector3{.2, .1, -.3};
    (*p.orientation)[i] = turn;
  }
  const Vector3 up = rotate(turn, {0, 0, 1});
  for (const Opening &o : found()) {
    EXPECT_NEAR(o.opening, width, 1e-15);
    EXPECT_NEAR(o.slip, 3e-5, 1e-15);
    EXPECT_NEAR(std::abs(dot(o.normal, up)), 1, 1e-14);
  }
}

// The upper half turns about an edge of its lower face by a small angle: a wedge, wider with the distance
// from it.
TEST_F(OpenedLattice, a_wedge_is_as_wide_as_its_angle_times_the_distance) {
  part(4, {});
  constexpr double angle = 1e-3;
  const Vector3 edge{-nx * radius, 0, 8 * radius};
  const Quaternion turn = rotation_quaternion({0, -angle, 0});
  Particles &p = model_.particles;
  for (std::size_t i = 0; i < p.size(); ++i)
    if (is_above(i, 4)) {
      p.position[i] = edge + rotate(turn, p.reference_position[i] - edge);
      (*p.orientation)[i] = turn;
    }
  for (const Opening &o : found()) {
    const double expected = angle * (o.place.x - edge.x);
    EXPECT_NEAR(o.opening, expected, 2e-3 * expected);
  }
}

// Two planes: the way along an axis is that of the plane whose narrowest facet on it is the widest.
TEST_F(OpenedLattice, the_widest_way_is_as_wide_as_its_narrowest_facet) {
  // Two horizontal planes; the lower one is narrower, and closed in one row along y: no way along x there.
  part(2, {0, 0, 0.5 * width});
  part(5, {0, 0, width});
  Particles &p = model_.particles;
  Bonds &b = *model_.bonds;
  const double of_row = -nx * radius + 3 * radius; // x of the second row
  for (std::size_t i = 0; i < p.size(); ++i)
    if (is_above(i, 5) && std::abs(p.reference_position[i].x - of_row) < 0.1 * radius)
      p.position[i].z -= 0.25 * width; // the upper plane is narrower there
  CrackWidths w = widths();
  EXPECT_NEAR(w.through[0] / width, 0.75, 1e-9); // the way along x passes that row
  EXPECT_NEAR(w.through[1] / width, 1, 1e-9);    // along y it does not
  EXPECT_NEAR(w.largest / width, 1, 1e-9);
  // Healed in two rows: farther apart than cracks are joined.
  for (std::size_t k = 0; k < b.initial_count(); ++k) {
    const Vector3 m = reference_midpoint(p, b, k);
    if (m.z > 8 * radius &&
        (std::abs(m.x - of_row) < 0.1 * radius || std::abs(m.x - of_row - 2 * radius) < 0.1 * radius))
      b.state[k] = static_cast<int>(BondState::intact);
  }
  w = widths();
  EXPECT_NEAR(w.through[0] / width, 0.5, 1e-9); // now by the lower plane
}

// A plane that ends in the middle leads along itself alone; one across the way lets nothing through it.
TEST_F(OpenedLattice, facets_let_through_along_themselves_and_from_face_to_face) {
  part(4, {0, 0, width});
  const double whole = widths().permeability[0];
  Particles &p = model_.particles;
  Bonds &b = *model_.bonds;
  const double middle = -nx * radius + 4 * radius; // between the second and the third row
  for (std::size_t k = 0; k < b.initial_count(); ++k) {
    const auto i = static_cast<std::size_t>(b.record_first[k]),
               j = static_cast<std::size_t>(b.record_second[k]);
    if (is_above(i, 4) && is_above(j, 4) &&
        (p.reference_position[i].x < middle) != (p.reference_position[j].x < middle))
      b.state[k] = static_cast<int>(BondState::broken_in_tension);
  }
  for (std::size_t i = 0; i < p.size(); ++i)
    if (is_above(i, 4) && p.reference_position[i].x > middle) p.position[i].x += width;
  const CrackWidths branched = widths();
  EXPECT_EQ(branched.open, nx * ny + ny * (nz - 4));
  EXPECT_NEAR(branched.permeability[0] / whole, 1, 1e-9);
  EXPECT_NEAR(branched.permeability[1] / whole, 1 + (nz - 4.) / nx, 1e-9);
  EXPECT_TRUE(std::isnan(branched.through[2])); // from the middle to the top
  for (std::size_t k = 0; k < b.initial_count(); ++k)
    if (reference_midpoint(p, b, k).x > middle) b.state[k] = static_cast<int>(BondState::intact);
  const CrackWidths half = widths();
  EXPECT_TRUE(std::isnan(half.through[0]));
  EXPECT_EQ(half.permeability[0], 0);
  EXPECT_NEAR(half.through[1] / width, 1, 1e-9);
  EXPECT_NEAR(half.permeability[1] / whole, (2. + nz - 4) / nx, 1e-9);
}

// A sphere that turns alone by a small angle moves its face by the angle times its own radius.
TEST(openings, unequal_spheres_meet_at_their_radii) {
  constexpr double angle = 1e-6;
  Model model(pair_of(radius, 3 * radius), bonded());
  Particles &p = model.particles;
  model.bonds->state[0] = static_cast<int>(BondState::broken_in_shear);
  for (const std::size_t i : {0, 1}) {
    (*p.orientation)[0] = (*p.orientation)[1] = Quaternion{};
    (*p.orientation)[i] = rotation_quaternion({0, 0, angle});
    const Opening o = opening_of(p, *model.bonds, 0);
    EXPECT_NEAR(o.slip / (angle * p.radius[i]), 1, 1e-5);
    EXPECT_NEAR(o.opening, 0, 2 * angle * angle * radius * 3);
  }
}

TEST_F(OpenedLattice, the_largest_openings_are_kept) {
  LargestOpenings largest;
  const auto look = [&] {
    largest.follow(model_.particles, *model_.bonds);
    return found().front();
  };
  part(4, {2e-5, 0, 0.4 * width});
  EXPECT_NEAR(largest.opening(found().front()), 0.4 * width, 1e-15); // not followed yet
  part(4, {0, 0, 0.6 * width});
  look();
  part(4, {0, 0, -0.7 * width});
  Opening now = look();
  EXPECT_NEAR(now.opening, 0.3 * width, 1e-15);
  EXPECT_NEAR(largest.opening(now), width, 1e-15);
  EXPECT_NEAR(largest.slip(now), 2e-5, 1e-15);
  const double z = now.opening;
  part(4, {0, 0, std::numeric_limits<double>::quiet_NaN()});
  look();
  now.opening = z;
  EXPECT_TRUE(std::isnan(largest.opening(now))); // from then on
}

TEST_F(OpenedLattice, one_opening_that_is_not_finite_leaves_no_figure) {
  part(4, {0, 0, width});
  model_.particles.position[static_cast<std::size_t>(model_.bonds->record_second[found().back().record])].z =
      std::numeric_limits<double>::quiet_NaN();
  const CrackWidths w = widths();
  for (const double figure : {w.open, w.largest, w.mean, w.volume, w.wider[0], w.wider[2], w.through[0],
                              w.permeability[0], w.permeability[2]})
    EXPECT_TRUE(std::isnan(figure));
}

// In a packing the projected areas of the bonds that a plane cuts sum up to the plane's on the mean.
TEST(openings, facets_stand_for_the_area_of_planes) {
  const Specimen specimen = packed_box(24, 24, 24);
  Model model(specimen, bonded());
  const Particles &p = model.particles;
  const Bonds &b = *model.bonds;
  const double factor = area_factor(p, b, bonded().bond_layout, specimen.shape);
  double sum = 0, planes = 0;
  const BoundingBox box = bounding_box(specimen.shape);
  const double margin = 4 * radius;
  for (double z = box.low.z + margin; z < box.high.z - margin; z += 0.5 * radius, ++planes)
    for (std::size_t k = 0; k < b.initial_count(); ++k) {
      const Vector3 a = p.reference_position[static_cast<std::size_t>(b.record_first[k])],
                    c = p.reference_position[static_cast<std::size_t>(b.record_second[k])];
      const Vector3 m = 0.5 * (a + c);
      const bool inside = std::abs(m.x) < 8 * radius && std::abs(m.y) < 8 * radius;
      if (inside && (a.z < z) != (c.z < z)) sum += factor * area * std::abs(c.z - a.z) / norm(c - a);
    }
  EXPECT_NEAR(sum / planes / std::pow(16 * radius, 2), 1, 0.05);
}

TEST(openings, a_cylinder_is_crossed_along_its_axis_alone) {
  const Specimen specimen = advancing_front(cylinder(8 * radius, 20 * radius), equal_radii(radius), 3);
  Model model(specimen, bonded());
  const CrackWidths w = crack_widths({}, model.particles, *model.bonds, bonded().bond_layout, specimen.shape);
  EXPECT_TRUE(std::isnan(w.permeability[0]) && std::isnan(w.permeability[1]));
  EXPECT_EQ(w.permeability[2], 0);
  const Specimen lying = laid_down(specimen);
  Model disc(lying, bonded());
  const CrackWidths across = crack_widths({}, disc.particles, *disc.bonds, bonded().bond_layout, lying.shape);
  EXPECT_TRUE(std::isnan(across.permeability[0]) && std::isnan(across.permeability[2]));
  EXPECT_EQ(across.permeability[1], 0);
}

} // namespace
} // namespace platen::dem::openings_test
