// Spheres on a block that yields: what gives way near a contact is counted once, wherever on whatever mesh it
// lies, and a layer of them is a uniform pressure.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <random>
#include <utility>
#include <vector>

#include "coupling/contact/contact_layer.h"
#include "dem/packing/specimen.h"
#include "fem/elastic_solid.h"
#include "fem/grids.h"
#include "tests/elastic_nodes.h"
#include "tests/measured.h"

namespace platen::coupling::pressed_block_test {
namespace {

constexpr double radius = 1e-3;                // m, of the sphere
constexpr fem::Material rock{2600, 50e9, 0.3}; // of the block
const double plane_modulus = rock.young_modulus / (1 - rock.poisson_ratio * rock.poisson_ratio);

// Hertz 1882, with a the radius of the contact.
double hertz_approach(double a) {
  return a * a / radius;
}
double hertz_force(double a) {
  return 4.0 / 3.0 * plane_modulus * a * a * a / radius;
}
// A block below z = 0 with cubes of edge h where the sphere presses and longer ones towards its sides and its
// held lower end, at least `reach` away.
fem::Grid graded_block(double h, double reach) {
  constexpr int even = 3; // cubes on each side
  constexpr double growth = 1.7;
  std::vector<double> place = {0};
  double step = h;
  while (place.back() < reach || place.size() <= even) {
    if (place.size() > even) step *= growth;
    place.push_back(place.back() + step);
  }
  const int n = static_cast<int>(place.size()) - 1;
  const double whole = n;
  const fem::Grid numbers =
      fem::make_grid(fem::BoxPlate{{-whole, -whole, -whole}, {whole, whole, 0}, {2 * n, 2 * n, n}});
  const auto graded = [&place](double x) {
    return std::copysign(place[static_cast<std::size_t>(std::lround(std::abs(x)))], x);
  };
  return fem::moved_grid(numbers, [&](const Vector3 &p) {
    return Vector3{graded(p[0]), graded(p[1]), graded(p[2])};
  });
}

// Spheres that stand still on a block on its lower end, in equilibrium with the contact layer between them.
struct PressedBlock {
  dem::Particles particles;
  fem::ElasticSolid block;
  ContactLayer layer;
  std::vector<Vector3> load; // N, of each vertex

  // `stiffness` (N/m) is that of the whole contact; `once`: without the indentation of the mesh coming on
  // top.
  PressedBlock(fem::Grid grid, int degree, double stiffness, bool once, const fem::Material &material = rock,
               const dem::Specimen &spheres = one_sphere())
      : particles(spheres, 2500, false),
        block(std::move(grid), {material}, fem::Clamp{fem::low_end_tag}, options(degree)),
        layer(particles, block,
              contact(stiffness, once ? block.face_compliance() : std::vector<fem::FaceCompliance>{})),
        load(block.surface().vertices.size(), Vector3{}) {}

  // Forces of the contacts as the block now is.
  void push() {
    block.clear_loads();
    for (Vector3 &force : particles.force)
      force = {};
    layer.make_list(particles, block);
    layer.add_forces(particles, block, 0);
  }
  // Force (N) between both at rest. The load goes a part of the way to the force that its own indentation
  // leaves, until that is so near to it. In the valley of its indentation the closest point of a sphere
  // changes sides, and only the size of the force comes to rest.
  double settle(double near) {
    constexpr double part = 0.6;
    for (int round = 0; round < 60; ++round) {
      block.solve_for(load, 0);
      push();
      const double force = norm(std::accumulate(particles.force.begin(), particles.force.end(), Vector3{}));
      if (std::abs(force - norm(std::accumulate(load.begin(), load.end(), Vector3{}))) < near * force)
        return force;
      for (std::size_t v = 0; v < load.size(); ++v)
        load[v] = load[v] + part * (block.contact_load(static_cast<int>(v)) - load[v]);
    }
    ADD_FAILURE() << "no equilibrium";
    return 0;
  }
  // With the sphere `approach` (m) deep at (x, y), measured from the block's face without load.
  double press(double x, double y, double approach) {
    SCOPED_TRACE(testing::Message() << "at " << x << ", " << y);
    particles.position[0] = {x, y, radius - approach};
    return settle(1e-4);
  }

  static dem::Specimen one_sphere() {
    dem::Specimen s;
    s.centre = {{0, 0, radius}};
    s.radius = {radius};
    return s;
  }
  static fem::ElasticOptions options(int degree) {
    fem::ElasticOptions o;
    o.degree = degree;
    o.motion = fem::ElasticMotion::quasi_static;
    o.solver = fem::LinearSolver::direct; // many loads, few nodes
    return o;
  }
  static SurfaceContact contact(double stiffness, std::vector<fem::FaceCompliance> compliance) {
    SurfaceContact c;
    c.particle_stiffness = stiffness;
    c.face_compliance = std::move(compliance);
    c.skin = 0.3 * radius;
    return c;
  }
};

double hertz_secant(double a) {
  return hertz_force(a) / hertz_approach(a);
}

// Places in a face, as shares of its edge.
const std::vector<std::array<double, 2>> places = {{0, 0}, {0.5, 0}, {0.5, 0.5}, {0.1, 0.3}};

// Approach under Hertz's force over Hertz's approach. The contact is the secant of Hertz at that force (a
// linear spring can be Hertz at one force only), so that this is 1 if no compliance is missing or counted
// twice.
double share_of_hertz(PressedBlock &pressed, double h, double a, const std::array<double, 2> &place) {
  return hertz_force(a) / pressed.press(place[0] * h, place[1] * h, hertz_approach(a));
}

// 5 % are asked for, 1 % is reached, half of which is the end of the block 10 radii away.
TEST(pressed_block, yields_as_hertz_says_at_any_element_size_and_degree) {
  for (const auto &[degree, h] :
       {std::pair{1, 4 * radius}, {1, 2 * radius}, {1, radius}, {1, 0.5 * radius}, {2, 4 * radius}})
    for (const double a : {0.05 * radius, 0.1 * radius}) {
      if (degree == 2 && a < 0.1 * radius) continue;
      PressedBlock pressed(graded_block(h, 10 * radius), degree, hertz_secant(a), true);
      for (const auto &place : places)
        EXPECT_NEAR(share_of_hertz(pressed, h, a, place), 1, 0.02)
            << degree << ' ' << h / radius << ' ' << a / radius << ' ' << place[0] << ' ' << place[1];
    }
}

// Where the mesh alone gives way more than the contact should, nothing can be taken out; on the way there a
// spring is made stiffer by 1.85 at most. What the stable step is told covers any place in the face; an
// equilibrium is told of the whole contact.
TEST(pressed_block, makes_a_spring_stiffer_within_bounds) {
  constexpr double h = 0.5 * radius, overlap = 0.01 * radius;
  for (const double a : {0.05 * radius, 0.2 * radius}) {
    const double k = hertz_secant(a);
    PressedBlock pressed(graded_block(h, 4 * radius), 1, k, true);
    double largest = 0, smallest = std::numeric_limits<double>::infinity();
    for (const auto &place : places) {
      pressed.particles.position[0] = {place[0] * h, place[1] * h, radius - overlap};
      pressed.push();
      const double spring = pressed.particles.force[0].z / overlap;
      largest = std::max(largest, spring), smallest = std::min(smallest, spring);
      const auto bound = pressed.layer.ground_springs(pressed.particles, pressed.block);
      ASSERT_EQ(bound.size(), 1u);
      EXPECT_LE(spring, bound[0].normal_stiffness * (1 + 1e-12));
      const fem::VertexSprings vertices = pressed.layer.vertex_springs(pressed.particles, pressed.block);
      double sum = 0;
      for (const double stiffness : vertices.stiffness)
        sum += stiffness;
      EXPECT_LE(spring, sum * (1 + 1e-12));
      EXPECT_EQ(pressed.layer.ground_springs(pressed.particles, pressed.block, true)[0].normal_stiffness, k);
    }
    if (a < 0.1 * radius) {
      EXPECT_GT(smallest, 1.05 * k);
      EXPECT_LT(largest, 1.5 * k);
    } else { // on a vertex the indentation is .9 of the whole, in the middle of the face a third
      EXPECT_NEAR(smallest, k, 1e-9 * k);
      EXPECT_GT(largest, 1.4 * k);
      EXPECT_LE(largest, 1.85 * k);
    }
  }
}

// In-plane the vertices lie anywhere within a fifth of an edge of where they belong.
fem::Grid irregular_block(double h) {
  std::mt19937 engine(5);
  std::uniform_real_distribution<double> draw(-0.2 * h, 0.2 * h);
  return fem::moved_grid(graded_block(h, 6 * radius), [&](const Vector3 &p) {
    const Vector3 shift = {draw(engine), draw(engine), draw(engine)};
    const double inside = 3.01 * h;
    if (std::abs(p[0]) > inside || std::abs(p[1]) > inside || p[2] < -inside) return p;
    return p + Vector3{shift[0], shift[1], p[2] < 0 ? shift[2] : 0.0};
  });
}

// Dragged at a constant approach over edges and past vertices, in its own indentation all the way. Without
// the compliance taken out the force oscillates by 5 %.
TEST(pressed_block, feels_no_mesh_under_a_dragged_sphere) {
  constexpr double h = radius, a = 0.1 * radius;
  PressedBlock pressed(irregular_block(h), 1, hertz_secant(a), true);
  for (const double slope : {0.3, 1.0}) {
    double least = std::numeric_limits<double>::infinity(), most = 0;
    for (int n = 0; n <= 24; ++n) {
      const double x = (n / 12.0 - 1) * 1.2 * h;
      const double force = pressed.press(x, slope * x + 1e-5, hertz_approach(a));
      least = std::min(least, force), most = std::max(most, force);
      ASSERT_EQ(pressed.layer.contacts().size(), 1u) << x;
      // Along the face there is none but that of an indentation which the mesh cannot round.
      const Vector3 f = pressed.particles.force[0];
      ASSERT_LT(std::hypot(f.x, f.y), 0.005 * f.z) << x;
    }
    EXPECT_LT(most - least, 0.01 * most) << slope;
  }
}

// A strain that is the same everywhere leaves the face a plane, though no longer z = 0: force and normal are
// those of the plane to the round-off of places (1e-18 m) against the overlap (1e-5 m).
TEST(pressed_block, is_a_plane_to_a_sphere_where_it_is_evenly_strained) {
  PressedBlock pressed(graded_block(radius, 6 * radius), 1, 1e6, false);
  const auto strained = [](const Vector3 &p) {
    return Vector3{0.01 * p[0] + 0.02 * p[1], -0.01 * p[1], 0.02 * p[0] - 0.01 * p[1] + 0.03 * p[2]};
  };
  std::vector<Vector3> u;
  for (const Vector3 &node : pressed.block.model().nodes)
    u.push_back(strained(node));
  fem::set_deformation(pressed.block, u, {});
  // Normal of the plane that the face is in, from where it goes along x and y.
  const Vector3 along_x{1.01, 0, 0.02}, along_y{0.02, 0.99, -0.01};
  const Vector3 n = cross(along_x, along_y) / norm(cross(along_x, along_y));
  const double overlap = 0.01 * radius;
  for (int k = 0; k <= 600; ++k) {
    const double s = (k / 300.0 - 1) * 2.5 * radius;
    // Through vertices, then along an edge.
    const Vector3 closest = k % 2 == 0 ? s * along_x + s * along_y : s * along_x;
    pressed.particles.position[0] = closest + (radius - overlap) * n;
    pressed.push();
    ASSERT_EQ(pressed.layer.contacts().size(), 1u) << k;
    ASSERT_LT(norm(pressed.particles.force[0] - 1e6 * overlap * n), 1e-11 * 1e6 * overlap) << k;
  }
}

// A layer of 8 x 8 spheres on a block of as many elements: a uniform pressure, cell by cell. Looks at cells
// whose middle lies `inside` elements or more from the sides and three below the spheres.
struct Transmitted {
  double worst = 0;    // largest difference of a cell's stress along z from the mean pressure, over that
  double reaction = 0; // of clamp and loads together, over the loads
};
Transmitted transmitted(bool once, int inside) {
  constexpr int across = 8;
  constexpr double edge = 2 * radius, half = 0.5 * across * edge;
  dem::Specimen spheres;
  for (int i = 0; i < across * across; ++i) {
    spheres.centre.push_back(
        {((i % across) + 0.5) * edge - half, ((i / across) + 0.5) * edge - half, 0.99 * radius});
    spheres.radius.push_back(radius);
  }
  // That does not widen: its clamp bears nothing sideways.
  PressedBlock pressed(
      fem::make_grid(fem::BoxPlate{{-half, -half, -2 * half}, {half, half, 0}, {across, across, across}}), 1,
      5e7, once, {7850, 200e9, 0}, spheres);
  pressed.settle(1e-9);
  const fem::ElasticModel &model = pressed.block.model();
  std::vector<Vector3> force;
  fem::multiply(model.stiffness, pressed.block.deformation(), force);
  const Vector3 sum = std::accumulate(pressed.load.begin(), pressed.load.end(), Vector3{});
  Vector3 reaction{};
  for (const int node : pressed.block.clamped_nodes())
    reaction += force[static_cast<std::size_t>(node)];
  Transmitted result;
  result.reaction = norm(reaction + sum) / norm(sum);
  const double pressure = norm(sum) / (across * across * edge * edge);
  const std::vector<fem::Stress> stress = cell_stress(model, pressed.block.deformation());
  for (std::size_t c = 0; c < stress.size(); ++c) {
    Vector3 middle{};
    for (std::size_t k = 0; k < 8; ++k)
      middle += 0.125 * model.nodes[static_cast<std::size_t>(model.cell_nodes[8 * c + k])];
    const double from_side = half - std::max(std::abs(middle[0]), std::abs(middle[1]));
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
} // namespace platen::coupling::pressed_block_test
