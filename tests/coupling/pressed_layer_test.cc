// A layer of spheres on a block that yields: a uniform pressure, cell by cell.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "coupling/contact/contact_layer.h"
#include "dem/packing/specimen.h"
#include "fem/elastic_solid.h"
#include "fem/grids.h"
#include "tests/measured.h"

namespace platen::coupling {
namespace {

constexpr int across = 8;
constexpr double radius = 1e-3, edge = 2 * radius; // m, of a sphere and of an element: one above each face
constexpr fem::Material steel{7850, 200e9, 0};     // that does not widen: its clamp bears nothing sideways
constexpr double stiffness = 5e7;                  // N/m, of a contact

fem::ElasticSolid block_on_its_clamp() {
  constexpr double half = 0.5 * across * edge;
  fem::ElasticOptions options;
  options.motion = fem::ElasticMotion::quasi_static;
  return fem::ElasticSolid(
      fem::make_grid(fem::BoxPlate{{-half, -half, -2 * half}, {half, half, 0}, {across, across, across}}),
      {steel}, fem::Clamp{fem::low_end_tag}, options);
}

dem::Specimen layer_of_spheres(double approach) {
  dem::Specimen s;
  for (int i = 0; i < across * across; ++i) {
    s.centre.push_back({((i % across) + 0.5 - 0.5 * across) * edge,
                        ((i / across) + 0.5 - 0.5 * across) * edge, radius - approach});
    s.radius.push_back(radius);
  }
  return s;
}

struct Transmitted {
  double worst = 0;    // largest difference of a cell's stress along z from the mean pressure, over that
  double reaction = 0; // of clamp and loads together, over the loads
};

// Looks at cells whose middle lies `inside` elements or more from the sides and three below the spheres.
// `once`: with indentations taken out of the springs, as platens have it.
Transmitted transmitted(bool once, int inside) {
  fem::ElasticSolid block = block_on_its_clamp();
  dem::Particles spheres(layer_of_spheres(0.01 * radius), 2500, false);
  SurfaceContact contact;
  contact.particle_stiffness = stiffness;
  if (once) contact.face_compliance = block.face_compliance();
  contact.skin = 0.3 * radius;
  ContactLayer layer(spheres, block, contact);
  std::vector<Vector3> load(block.surface().vertices.size(), Vector3{});
  for (int round = 0; round < 40; ++round) { // half of the way at a time
    block.aim(load, 0);
    block.clear_loads();
    layer.make_list(spheres, block);
    layer.add_forces(spheres, block, 0);
    for (std::size_t v = 0; v < load.size(); ++v)
      load[v] = 0.5 * (load[v] + block.contact_load(static_cast<int>(v)));
  }
  block.aim(load, 0);
  Vector3 sum{}, reaction{};
  for (const Vector3 &f : load)
    sum = sum + f;
  const fem::ElasticModel &model = block.model();
  std::vector<Vector3> force;
  fem::multiply(model.stiffness, block.deformation(), force);
  for (const int node : block.clamped_nodes())
    reaction = reaction + force[static_cast<std::size_t>(node)];
  Transmitted result;
  result.reaction = norm(reaction + sum) / norm(sum);
  const double pressure = norm(sum) / (across * across * edge * edge);
  const std::vector<fem::Stress> stress = cell_stress(block.model(), block.deformation());
  for (std::size_t c = 0; c < stress.size(); ++c) {
    Vector3 middle{};
    for (std::size_t k = 0; k < 8; ++k)
      middle = middle + 0.125 * model.nodes[static_cast<std::size_t>(model.cell_nodes[8 * c + k])];
    const double from_side = 0.5 * across * edge - std::max(std::abs(middle[0]), std::abs(middle[1]));
    if (from_side < inside * edge || middle[2] > -3 * edge) continue;
    result.worst = std::max(result.worst, std::abs(-stress[c][2] / pressure - 1));
  }
  return result;
}

// Spheres alike and a block that does not widen: every cell bears the mean.
TEST(pressed_layer, puts_the_same_pressure_into_every_cell) {
  const Transmitted plain = transmitted(false, 0);
  EXPECT_LT(plain.worst, 1e-12);
  EXPECT_LT(plain.reaction, 1e-12);
}

// At the rim a face alone gives way more, so that more of its own indentation is taken out and its sphere
// bears more; inside that is gone within elements.
TEST(pressed_layer, puts_the_pressure_into_the_inside_where_indentations_are_taken_out) {
  const Transmitted taken = transmitted(true, 2);
  measured::expect_below(25, "stress_against_pressure", taken.worst, 0.01);
  measured::expect_below(25, "reactions_and_loads", taken.reaction, 1e-12);
}

} // namespace
} // namespace platen::coupling
