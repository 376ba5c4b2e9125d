#include "fem/grids.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "fem/elastic_model.h"

namespace platen::fem {
namespace {

constexpr Material steel{7830, 200e9, 0.3};

Grid block() {
  return make_grid(BoxPlate{{-0.02, -0.02, 1}, {0.02, 0.02, 1.01}, {4, 4, 2}});
}

// Area of the faces of a tag, and the sum of their outward normals times area (m^2).
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
    const ElasticModel model = make_elastic_model(laid, 1, {steel});
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

TEST(platen_mesh, materials_are_counted) {
  EXPECT_EQ(materials_of(block()), 1);
  const BoxPlate plate{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}};
  EXPECT_EQ(materials_of(make_grid(plate, {{0.5, 1}, {0.5, 1}})), 2);
}

} // namespace
} // namespace platen::fem
