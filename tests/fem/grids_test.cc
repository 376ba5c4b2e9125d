#include "fem/grids.h"
#include "base/pi.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>

#include "fem/elastic_model.h"
#include "tests/surface_sums.h"

namespace platen::fem::grids_test {
namespace {

std::vector<std::pair<const char *, Grid>> plates() {
  return {{"box", make_grid(BoxPlate{{-1, -2, 0.5}, {3, 1, 0.75}, {4, 3, 2}})},
          {"strips", make_grid(std::vector<BoxPlate>{{{-3, -2, 0.5}, {-2, 1, 0.75}, {2, 3, 2}},
                                                     {{2.1, -2, 0.5}, {3, 1, 0.75}, {1, 3, 2}}})},
          {"small disc", make_grid(CylinderPlate{0.03, 0.01, -0.01, 3, 1})},
          {"disc", make_grid(CylinderPlate{0.03, 0.01, -0.01, 14, 3})},
          {"tube", make_grid(Tube{0.05, 0.003, -0.01, 0.2, 20, 6, 2})}};
}

// m^2, of the faces of each tag.
std::map<int, double> areas_by_tag(const SurfaceMesh &surface) {
  std::map<int, double> area;
  for (std::size_t f = 0; f < surface.faces.size(); ++f)
    area[surface.face_tags[f]] += norm(face_area_vector(surface, f));
  return area;
}
void expect_areas(const Grid &grid, const std::map<int, double> &expected, double within) { // m^2
  const std::map<int, double> area = areas_by_tag(extract_surface(grid).surface);
  ASSERT_EQ(area.size(), expected.size());
  for (const auto &[tag, size] : expected)
    EXPECT_NEAR(area.at(tag), size, within) << tag;
}

// The sum of area vectors of a closed surface is zero; the tolerance is round-off of its area. Two integrals
// of the volume, one over cells and one over faces, agree because all faces are flat.
TEST(grids, the_surface_of_a_plate_is_closed_and_holds_its_cells) {
  for (const auto &[name, grid] : plates()) {
    const SurfaceMesh surface = extract_surface(grid).surface;
    double area = 0;
    for (const auto &[tag, size] : areas_by_tag(surface))
      area += size;
    EXPECT_LT(norm(total_area_vector(surface)), 1e-14 * area) << name;
    std::map<std::pair<int, int>, int> edges; // every edge is walked once each way
    for (const auto &face : surface.faces)
      for (std::size_t k = 0; k < 4; ++k)
        ++edges[{face[k], face[(k + 1) % 4]}];
    for (const auto &[edge, count] : edges) {
      EXPECT_EQ(count, 1) << name;
      EXPECT_EQ(edges.count({edge.second, edge.first}), 1u) << name;
    }
    const double volume = volume_moments(grid).volume;
    EXPECT_NEAR(enclosed_volume(surface), volume, 1e-13 * volume) << name;
  }
}

TEST(grids, faces_name_their_cell_and_its_corners) {
  for (const auto &[name, grid] : plates())
    for (const BoundaryFace &face : grid->faces)
      for (std::size_t k = 0; k < 4; ++k)
        EXPECT_EQ(
            face.nodes[k],
            grid->cells.at(static_cast<std::size_t>(face.cell))[static_cast<std::size_t>(face.corners[k])])
            << name;
}

// Plates are convex, and so is each strip; the inside of a tube points to its axis.
TEST(grids, faces_point_out_of_the_solid) {
  for (const auto &[name, grid] : plates()) {
    const SurfaceMesh surface = extract_surface(grid).surface;
    const Vector3 whole = volume_moments(grid).centroid;
    const bool strips = std::string(name) == "strips";
    for (std::size_t f = 0; f < surface.faces.size(); ++f) {
      const Vector3 corner = surface.vertices[static_cast<std::size_t>(surface.faces[f][0])],
                    area = face_area_vector(surface, f);
      Vector3 middle = whole;
      if (strips) middle[0] = corner[0] < 0 ? -2.5 : 2.55;
      if (surface.face_tags[f] == inner_tag)
        EXPECT_LT(area[0] * corner[0] + area[1] * corner[1], 0) << name;
      else
        EXPECT_GT(dot(corner - middle, area), 0) << name;
    }
  }
}

TEST(grids, ends_are_flat_to_the_last_bit_and_tagged) {
  for (const auto &[name, grid] : plates()) {
    const SurfaceMesh surface = extract_surface(grid).surface;
    double low = 1e300, high = -1e300;
    for (const Vector3 &v : surface.vertices)
      low = std::min(low, v[2]), high = std::max(high, v[2]);
    int ends[2] = {0, 0};
    for (std::size_t f = 0; f < surface.faces.size(); ++f) {
      const bool top = surface.face_tags[f] == high_end_tag;
      if (!top && surface.face_tags[f] != low_end_tag) continue;
      ++ends[top];
      for (const int v : surface.faces[f])
        EXPECT_EQ(surface.vertices[static_cast<std::size_t>(v)][2], top ? high : low) << name;
      EXPECT_EQ(face_area_vector(surface, f)[2] > 0, top) << name;
    }
    EXPECT_EQ(ends[0], ends[1]) << name;
    EXPECT_GT(ends[0], 0) << name;
  }
}

// The polygon with 4 n sides inscribed in the circle has the area R^2 2 n sin(pi / (2 n)): the grid fills
// exactly it.
TEST(grids, a_disc_fills_its_inscribed_polygon) {
  const double radius = 0.03, thickness = 0.01;
  for (const int across : {3, 8, 14, 21}) {
    const int n = across - 2 * std::max(1, across / 4);
    const double area = radius * radius * 2 * n * std::sin(pi / (2 * n));
    const VolumeMoments m = volume_moments(make_grid(CylinderPlate{radius, thickness, 0, across, 2}));
    EXPECT_NEAR(m.volume, area * thickness, 1e-13 * area * thickness) << across;
    EXPECT_LT(std::abs(m.centroid[0]) + std::abs(m.centroid[1]), 1e-14) << across;
    EXPECT_NEAR(m.centroid[2], 0.5 * thickness, 1e-14) << across;
  }
}

// Length of each element against the mean: no slivers, whatever the count.
TEST(grids, elements_of_a_disc_are_of_one_size) {
  for (const int across : {3, 5, 8, 16, 33}) {
    const SurfaceMesh surface = extract_surface(make_grid(CylinderPlate{1, 0.2, 0, across, 1})).surface;
    double smallest = 1e300, largest = 0;
    for (std::size_t f = 0; f < surface.faces.size(); ++f) {
      if (surface.face_tags[f] != high_end_tag) continue;
      const double area = norm(face_area_vector(surface, f));
      smallest = std::min(smallest, area), largest = std::max(largest, area);
    }
    EXPECT_GT(smallest, 0.15 * largest) << across;
  }
}

// Prisms over chords: volume n/2 sin(2 pi/n) (B^2 - A^2) h.
TEST(grids, a_tube_has_four_sides_and_the_volume_of_its_prisms) {
  const Grid grid = make_grid(Tube{0.05, 0.003, -0.01, 0.2, 20, 6, 2});
  const double a = 0.05, b = 0.053, ring = 10 * std::sin(pi / 10) * (b * b - a * a),
               chord = 40 * std::sin(pi / 20) * 0.2;
  EXPECT_NEAR(volume_moments(grid).volume, ring * 0.2, 1e-15);
  const SurfaceMesh surface = extract_surface(grid).surface;
  EXPECT_NEAR(enclosed_volume(surface), ring * 0.2, 1e-15);
  EXPECT_LT(norm(total_area_vector(surface)), 1e-15);
  expect_areas(grid,
               {{mantle_tag, chord * b}, {low_end_tag, ring}, {high_end_tag, ring}, {inner_tag, chord * a}},
               1e-14);
}

TEST(grids, sizes_that_make_no_plate_are_refused) {
  EXPECT_THROW(make_grid(CylinderPlate{0, 0.1, 0, 8, 2}), std::invalid_argument);
  EXPECT_THROW(make_grid(CylinderPlate{1, -0.1, 0, 8, 2}), std::invalid_argument);
  EXPECT_THROW(make_grid(CylinderPlate{1, 0.1, 0, 2, 2}), std::invalid_argument);
  EXPECT_THROW(make_grid(CylinderPlate{1, 0.1, 0, 8, 0}), std::invalid_argument);
  EXPECT_THROW(make_grid(Tube{0, 1, 0, 1, 8, 1, 1}), std::invalid_argument);
  EXPECT_THROW(make_grid(Tube{1, 1, 0, 1, 2, 1, 1}), std::invalid_argument);
  EXPECT_THROW(make_grid(Tube{1, 1, 0, -1, 8, 1, 1}), std::invalid_argument);
  EXPECT_THROW(make_grid(BoxPlate{{0, 0, 0}, {1, 0, 1}, {1, 1, 1}}), std::invalid_argument);
  EXPECT_THROW(make_grid(BoxPlate{{0, 0, 0}, {1, 1, 1}, {1, 0, 1}}), std::invalid_argument);
}

// Each strip keeps the area and the numbers of all of its sides.
TEST(grids, strips_in_one_grid_have_the_sides_of_each) {
  const std::vector<BoxPlate> boxes{{{-3.1, -1, 0.1}, {-2.7, 1, 0.3}, {3, 4, 2}},
                                    {{2.7, -1, 0.1}, {3.1, 1, 0.3}, {3, 4, 2}}};
  const Grid grid = make_grid(boxes);
  expect_areas(grid, {{0, 0.8}, {1, 0.8}, {2, 0.16}, {3, 0.16}, {low_end_tag, 1.6}, {high_end_tag, 1.6}},
               1e-12);
  const VolumeMoments m = volume_moments(grid);
  EXPECT_NEAR(m.volume, 2 * 0.4 * 2 * 0.2, 1e-12);
  EXPECT_NEAR(m.centroid[0], 0, 1e-12);
  // Steiner: two boxes of .16 m^3 at 2.9 m, and their own width^2 / 12.
  EXPECT_NEAR(m.second[0], 0.32 * (2.9 * 2.9 + 0.4 * 0.4 / 12), 1e-12);
  EXPECT_THROW(make_grid(std::vector<BoxPlate>{}), std::invalid_argument);
  EXPECT_THROW(make_grid(std::vector<BoxPlate>{boxes[0], boxes[0]}), std::invalid_argument);
}

Grid block() {
  return make_grid(BoxPlate{{-0.02, -0.02, 1}, {0.02, 0.02, 1.01}, {4, 4, 2}});
}

// Of the faces of a tag, the sum of areas times outward normal (m^2).
Vector3 area_of(const Grid &grid, int tag) {
  const SurfaceMesh surface = extract_surface(grid).surface;
  Vector3 sum{};
  for (std::size_t f = 0; f < surface.faces.size(); ++f)
    if (surface.face_tags[f] == tag) sum = sum + face_area_vector(surface, f);
  return sum;
}

TEST(platen_mesh, the_end_towards_the_specimen_lies_in_its_plane) {
  for (const bool up : {true, false}) {
    const Grid laid = laid_platen(block(), up, 0.3);
    const ElasticModel model = make_elastic_model(laid, 1, {{7830, 200e9, 0.3}});
    for (const int node : nodes_on(model, up ? high_end_tag : low_end_tag))
      EXPECT_EQ(model.nodes[static_cast<std::size_t>(node)][2], 0.3);
    for (const int node : nodes_on(model, up ? low_end_tag : high_end_tag))
      EXPECT_NEAR(model.nodes[static_cast<std::size_t>(node)][2], up ? 0.29 : 0.31, 1e-15);
    EXPECT_NEAR(area_of(laid, high_end_tag)[2], 1.6e-3, 1e-12);
    EXPECT_NEAR(area_of(laid, low_end_tag)[2], -1.6e-3, 1e-12);
  }
}

TEST(platen_mesh, all_that_looks_to_the_specimen_is_the_face_of_a_convex_one) {
  const auto dished = [](const Vector3 &p) {
    const double share = (p[2] - 1) / 0.01;
    return Vector3{p[0], p[1], p[2] - 4 * share * (p[0] * p[0] + p[1] * p[1])};
  };
  // Without a node on the axis no face lies in the highest plane.
  const Grid convex =
      moved_grid(make_grid(BoxPlate{{-0.02, -0.02, 1}, {0.02, 0.02, 1.01}, {5, 5, 2}}), dished);
  const Grid laid = laid_platen(convex, true, 0);
  // Seen from above it covers the block, however it is curved; the middle face lies in the highest plane.
  const Grid shifted =
      laid_platen(moved_grid(convex,
                             [](const Vector3 &p) {
                               return Vector3{p[0], p[1], p[2] + (p[2] > 1.005 ? 1e-3 * p[0] : 0)};
                             }),
                  true, 0);
  EXPECT_NEAR(area_of(laid, high_end_tag)[2], 0.008 * 0.008, 1e-12);
  EXPECT_NEAR(area_of(shifted, high_end_tag)[2], 1.6e-3, 1e-12);
  EXPECT_NEAR(area_of(shifted, low_end_tag)[2], -1.6e-3, 1e-12);
}

TEST(platen_mesh, a_platen_that_cannot_be_held_is_refused) {
  const Grid slant = moved_grid(block(), [](const Vector3 &p) {
    return Vector3{p[0], p[1], p[2] + 0.1 * p[0]};
  });
  EXPECT_THROW(laid_platen(slant, true, 0), std::invalid_argument);
}

TEST(grids, materials_are_counted) {
  EXPECT_EQ(materials_of(block()), 1);
  const BoxPlate plate{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}};
  EXPECT_EQ(materials_of(make_grid(plate, {{0.5, 1}, {0.5, 1}})), 2);
}

TEST(surface_mesh, a_face_without_area_is_named) {
  SurfaceMesh surface;
  surface.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0},    {0, 1, 0},
                      {2, 0, 0}, {3, 0, 0}, {1, 1e-9, 0}, {0, 1e-9, 0}};
  surface.faces = {{0, 1, 2, 3}, {0, 1, 4, 5}, {0, 1, 6, 7}, {2, 2, 2, 2}}; // square, line, needle, point
  EXPECT_EQ(zero_area_faces(surface), (std::vector<int>{1, 3}));
}

} // namespace
} // namespace platen::fem::grids_test
