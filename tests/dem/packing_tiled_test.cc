// Packings that repeat themselves, and large ones laid out of them without seams.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <stdexcept>
#include <vector>

#include "base/random.h"
#include "dem/packing/direction_cells.h"
#include "dem/packing/periodic_growth.h"
#include "dem/packing/quality.h"
#include "dem/packing/tiled.h"

namespace platen::dem::packing_tiled_test {
namespace {

struct Contact {
  Vector3 axis;
  double gap;
  bool through_a_face; // with an image
};

// All pairs of a packing that repeats itself, each at its nearest images, by brute force.
std::vector<Contact> contacts_of(const Specimen &s, double gap) {
  const Vector3 period = periods(s.shape);
  std::vector<Contact> contacts;
  for (std::size_t i = 0; i < s.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      Vector3 d = s.centre[i] - s.centre[j], shift;
      for (int k = 0; k < 3; ++k)
        shift[k] = period[k] * std::round(d[k] / period[k]), d[k] -= shift[k];
      const double between = norm(d) - s.radius[i] - s.radius[j];
      if (between <= gap) contacts.push_back({d, between, !(shift == Vector3{})});
    }
  return contacts;
}

constexpr int seeds = 5;
const std::vector<Specimen> &periodic_packings() {
  static const std::vector<Specimen> made = [] {
    std::vector<Specimen> all;
    for (int seed = 1; seed <= seeds; ++seed)
      all.push_back(periodic_close_packing(box(1, 1, 1.25), 900, 0.3, static_cast<std::uint64_t>(seed)));
    return all;
  }();
  return made;
}

TEST(PeriodicPacking, touches_through_its_faces_and_overlaps_nowhere) {
  for (const Specimen &s : periodic_packings()) {
    const double mean = mean_radius(s);
    double deepest = 0;
    std::size_t through = 0;
    for (const Contact &c : contacts_of(s, 0))
      deepest = std::max(deepest, -c.gap / mean), through += c.through_a_face ? 1 : 0;
    EXPECT_LT(deepest, 8e-4);
    // As many go through the faces as through any three planes: those of a layer as deep as |normal| of the
    // contact, 2 R / 2 in the mean, on either side of half a contact: area times contacts over volume times
    // 2 R / 2.
    const Vector3 p = periods(s.shape);
    const double area = p.x * p.y + p.y * p.z + p.z * p.x;
    const double contacts = static_cast<double>(contacts_of(s, 0).size());
    EXPECT_NEAR(static_cast<double>(through) / (contacts * area * mean / s.shape.volume()), 1.0, 0.12);
  }
}

TEST(PeriodicPacking, is_isostatic_as_packings_between_walls_are) {
  // Three contacts a sphere hold it; walls take none here. Seated loose spheres have three as well.
  for (const Specimen &s : periodic_packings())
    EXPECT_NEAR(static_cast<double>(contacts_of(s, 0).size()) / static_cast<double>(s.size()), 3.0, 0.08);
}

TEST(PeriodicPacking, is_as_dense_as_the_inside_of_packings_between_walls) {
  // .635 to .65 (O'Hern et al. 2003), and more by a hundredth with spread radii; 900 spheres scatter by .003.
  double sum = 0;
  for (const Specimen &s : periodic_packings()) {
    const double fraction = volume_of_spheres(s) / s.shape.volume();
    EXPECT_NEAR(fraction, 0.643, 0.01);
    sum += fraction / seeds;
  }
  EXPECT_NEAR(sum, 0.643, 0.005);
}

TEST(PeriodicPacking, prefers_no_direction) {
  std::vector<Vector3> axes;
  for (const Specimen &s : periodic_packings())
    for (const Contact &c : contacts_of(s, 0))
      axes.push_back(c.axis);
  // 13 000 axes; 1 +- .11 for independent ones.
  EXPECT_NEAR(isotropy_chi_squared(count_axes(axes)), 1.0, 0.45);
  Matrix3 fabric{};
  for (const Vector3 &a : axes)
    for (int k = 0; k < 3; ++k)
      fabric[k] += a[k] * a[k] / norm_squared(a) / static_cast<double>(axes.size());
  for (int k = 0; k < 3; ++k) // standard deviation sqrt(4 / 45 / n) = .0026
    EXPECT_NEAR(fabric[k], 1.0 / 3, 0.011) << "axis " << k;
}

TEST(PeriodicPacking, moves_along_where_its_seeds_are_shifted) {
  const Shape cube = box(1, 1, 1);
  const Vector3 shift{0.375, -0.25, 1.625}; // some of the spheres go through faces
  Random random(4);
  std::vector<Vector3> here, there;
  for (int i = 0; i < 200; ++i) {
    here.push_back({random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5), random.uniform()});
    there.push_back(here.back() + shift);
  }
  const std::vector<double> factors(200, 1.0);
  GrowthReport a, b;
  const Specimen first = periodic_close_packing_from(cube, here, factors, 1, &a);
  const Specimen second = periodic_close_packing_from(cube, there, factors, 1, &b);
  // Which of the two orders round-off may add in another order, so only places are compared, to a hundredth.
  EXPECT_NEAR(a.packing_fraction, b.packing_fraction, 1e-4);
  std::size_t found = 0;
  for (const Vector3 &c : first.centre)
    for (const Vector3 &d : second.centre) {
      Vector3 off = d - c - shift;
      for (int k = 0; k < 3; ++k)
        off[k] -= std::round(off[k]);
      found += norm(off) < 0.02 * a.mean_radius ? 1 : 0;
    }
  EXPECT_GE(found, 190u); // loose spheres are seated in directions of their own
}

TEST(PeriodicPacking, refuses_what_would_meet_itself) {
  EXPECT_THROW(periodic_close_packing(cylinder(1, 1), 500, 0, 1), std::invalid_argument);
  EXPECT_THROW(periodic_close_packing(box(1, 1, 2.1), 500, 0, 1), std::invalid_argument);
  EXPECT_THROW(periodic_close_packing(box(1, 1, 1), 100, 0, 1), std::invalid_argument);
  EXPECT_THROW(periodic_close_packing(box(1, 1, 1), 500, 2, 1), std::invalid_argument);
}

// Some 4 500 spheres, fifteen tiles of 300.
struct Tiled {
  TilingReport report;
  Specimen specimen;
  PackingQuality quality;
};
const Tiled &tiled() {
  static const Tiled made = [] {
    Tiled t;
    t.specimen = tiled_close_packing(box(28e-3, 28e-3, 40e-3), 1e-3, 0.3, 300, 2, &t.report);
    t.quality = judge_packing(t.specimen);
    return t;
  }();
  return made;
}

TEST(TiledPacking, tells_its_tiles_and_their_period) {
  const TilingReport &r = tiled().report;
  EXPECT_NEAR(r.tiles, tiles_in(tiled().specimen.shape, 1e-3, 0.3, 300), 0.02 * r.tiles);
  EXPECT_NEAR(std::pow(r.period, 3) * r.tiles, tiled().specimen.shape.volume(), 1e-14);
  EXPECT_EQ(r.tile.spheres, 300u);
  EXPECT_EQ(r.specimen.spheres, tiled().specimen.size());
}

TEST(TiledPacking, is_packed_like_one_that_was_grown_between_its_walls) {
  const Shape &shape = tiled().specimen.shape;
  const PackingQuality &q = tiled().quality;
  GrowthReport report;
  const Specimen grown = random_close_packing(shape, 1e-3, 0.3, 2, &report);
  const PackingQuality direct = judge_packing(grown);
  EXPECT_NEAR(q.mean_radius, 1e-3, 1e-5);
  EXPECT_NEAR(q.packing_fraction, direct.packing_fraction, 0.006);
  EXPECT_NEAR(q.core_packing_fraction, direct.core_packing_fraction, 0.01);
  EXPECT_NEAR(q.core_coordination_number, direct.core_coordination_number, 0.15);
  EXPECT_NEAR(q.cover_bottom, direct.cover_bottom, 0.1);
  EXPECT_NEAR(q.cover_top, direct.cover_top, 0.1);
  EXPECT_LT(q.max_overlap, 1.2e-3);
  EXPECT_LT(q.max_wall_overlap, 1.2e-3);
  EXPECT_TRUE(check_specimen(tiled().specimen, 2e-3).empty());
}

// Contacts through planes across the axis, one a period and at the given place in it, over the length inside.
double contacts_through(const Specimen &s, double period, double place) {
  const double margin = 6e-3; // from the ends
  std::size_t crossing = 0;
  int planes = 0;
  const std::vector<TouchingPair> pairs = touching_pairs(s, 1e-6);
  for (int k = -50; k < 50; ++k) {
    const double z = (k + place) * period;
    if (z < margin || z > s.shape.height - margin) continue;
    ++planes;
    for (const TouchingPair &p : pairs) {
      const double a = s.centre[p.first].z - z, b = s.centre[p.second].z - z;
      crossing += a * b < 0 ? 1 : 0;
    }
  }
  return static_cast<double>(crossing) / planes;
}

TEST(TiledPacking, is_held_across_the_borders_of_tiles_as_within_them) {
  // The tile begins at z = 0. Some 700 contacts cross a plane; a border without images would have none.
  const Specimen &s = tiled().specimen;
  const double period = tiled().report.period;
  std::vector<double> inside;
  for (int k = 1; k < 8; ++k)
    inside.push_back(contacts_through(s, period, 0.125 * k));
  const double mean = std::accumulate(inside.begin(), inside.end(), 0.0) / static_cast<double>(inside.size());
  double square = 0;
  for (const double n : inside)
    square += (n - mean) * (n - mean) / static_cast<double>(inside.size() - 1);
  EXPECT_GT(mean, 300);
  EXPECT_NEAR(contacts_through(s, period, 0), mean, 3 * std::sqrt(square) + 0.02 * mean);
}

TEST(TiledPacking, refuses_shapes_that_are_hardly_a_tile) {
  EXPECT_THROW(tiled_close_packing(box(10, 10, 10), 1, 0, 500, 1), std::invalid_argument);
  EXPECT_THROW(tiled_close_packing(disc(10, 10), 1, 0, 200, 1), std::invalid_argument);
  EXPECT_THROW(tiled_close_packing(box(20, 20, 20), 1, 0, 20, 1), std::invalid_argument);
  EXPECT_THROW(tiled_close_packing(box(20, 20, 20), -1, 0, 300, 1), std::invalid_argument);
  EXPECT_THROW(tiled_close_packing(box(20, 20, 20), 1, 0, 300, 1, nullptr, 0), std::invalid_argument);
  EXPECT_THROW(tiled_close_packing(box(2e4, 2e4, 2e4), 1, 0, 300, 1), std::invalid_argument); // too many
}

} // namespace
} // namespace platen::dem::packing_tiled_test
