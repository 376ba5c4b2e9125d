#include "fem/elastic_model.h"
#include "base/pi.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string>

#include "fem/static_equations.h"
#include "tests/fem/quadrature.h"
#include "tests/surface_sums.h"

namespace platen::fem::elastic_model_test {
namespace {

constexpr Material steel{7850, 210e9, 0.3};
constexpr Material rubber{1200, 10e6, 0.45};

// The unit cube with its inside pushed about: no cell is a parallelepiped, the faces stay where they are.
Grid distorted_cube(int n) {
  return moved_grid(make_grid(BoxPlate{{0, 0, 0}, {1, 1, 1}, {n, n, n}}), [](const Vector3 &p) {
    const double s = std::sin(pi * p[0]) * std::sin(pi * p[1]) * std::sin(pi * p[2]);
    return p + s * Vector3{0.08 * std::cos(2 * p[1]), -0.09 * p[2], 0.1 * std::sin(3 * p[0])};
  });
}

Fixed held_on(const ElasticModel &model, const std::vector<int> &tags) {
  Fixed fixed(model.nodes.size(), {0, 0, 0});
  for (const int tag : tags)
    for (const int i : nodes_on(model, tag))
      fixed[static_cast<std::size_t>(i)] = {1, 1, 1};
  return fixed;
}

// A displacement that is zero on the faces of the unit cube, and the force per volume that goes with it.
struct Wave {
  Vector3 direction{1, 0.5, -0.7};
  double bump(const Vector3 &p, const std::array<int, 3> &slopes = {0, 0, 0}) const {
    double product = 1;
    for (std::size_t k = 0; k < 3; ++k)
      product *= slopes[k] ? pi * std::cos(pi * p[k]) : std::sin(pi * p[k]);
    return product;
  }
  Vector3 displacement(const Vector3 &p) const { return bump(p) * direction; }
  Vector3 force(const Vector3 &p, const Material &material) const {
    const Lame c = lame(material);
    Vector3 f{};
    for (std::size_t i = 0; i < 3; ++i) {
      double gradient = 0;
      for (std::size_t j = 0; j < 3; ++j) {
        std::array<int, 3> slopes = {0, 0, 0};
        slopes[i] = slopes[j] = 1;
        gradient += direction[j] * (i == j ? -pi * pi * bump(p) : bump(p, slopes));
      }
      f[i] = -(c.lambda + c.mu) * gradient + 3 * pi * pi * c.mu * direction[i] * bump(p);
    }
    return f;
  }
};

double error_of_wave(int degree, int n) {
  const Wave wave;
  const ElasticModel model = make_elastic_model(distorted_cube(n), degree, {steel});
  std::vector<Vector3> x(model.nodes.size(), Vector3{});
  const auto load = body_load(model, [&](const Vector3 &p) { return wave.force(p, steel); });
  StaticEquations(model.stiffness, model.nodes, held_on(model, {0, 1, 2, 3, 4, 5}))
      .solve(model.stiffness, load, x);
  return std::sqrt(integral(model, x, [&](const Vector3 &p, const Vector3 &u) {
    const Vector3 d = u - wave.displacement(p);
    return dot(d, d);
  }));
}

// Error in L2 falls as h^(degree + 1) on distorted cells.
TEST(elastic_model, linear_and_quadratic_elements_are_of_second_and_third_order) {
  for (const int degree : {1, 2}) {
    const int finest = degree == 1 ? 24 : 8;
    const double order = std::log2(error_of_wave(degree, finest / 2) / error_of_wave(degree, finest));
    EXPECT_NEAR(order, degree + 1, 0.1) << degree;
  }
}

// A linear displacement on the boundary is taken up exactly inside, and its stress is even.
TEST(elastic_model, passes_the_patch_test_on_distorted_cells) {
  const auto linear = [](const Vector3 &p) {
    return Vector3{1e-3 * p[0] + 2e-3 * p[1] - 5e-4 * p[2], -3e-4 * p[0] + 1e-3 * p[2],
                   7e-4 * p[1] - 2e-3 * p[2]};
  };
  for (const int degree : {1, 2})
    for (const LinearSolver kind : {LinearSolver::direct, LinearSolver::multigrid}) {
      const ElasticModel model = make_elastic_model(distorted_cube(4), degree, {steel});
      const Fixed fixed = held_on(model, {0, 1, 2, 3, 4, 5});
      std::vector<Vector3> x(model.nodes.size(), Vector3{});
      for (std::size_t i = 0; i < x.size(); ++i)
        if (fixed[i][0]) x[i] = linear(model.nodes[i]);
      const std::vector<Vector3> none(x.size(), Vector3{});
      StaticEquations(model.stiffness, model.nodes, fixed, kind).solve(model.stiffness, none, x);
      double worst = 0;
      for (std::size_t i = 0; i < x.size(); ++i)
        worst = std::max(worst, norm(x[i] - linear(model.nodes[i])));
      EXPECT_LT(worst, 1e-10 * 2e-3) << degree;
      const Lame c = lame(steel);
      for (const Stress &s : nodal_stress(model, x)) {
        EXPECT_NEAR(s[0], c.lambda * (1e-3 - 2e-3) + 2 * c.mu * 1e-3, 1e-9 * c.mu);
        EXPECT_NEAR(s[3], c.mu * (1e-3 + 7e-4), 1e-9 * c.mu);
        EXPECT_NEAR(s[5], c.mu * (2e-3 - 3e-4), 1e-9 * c.mu);
      }
    }
}

// Quarter of a thick tube in plane strain under pressure from inside (Lame 1852): u_r = (1 + nu) / E
// (A (1 - 2 nu) r + B / r), A = p a^2 / (b^2 - a^2), B = p a^2 b^2 / (b^2 - a^2), sigma_theta = A + B / r^2.
TEST(elastic_model, a_thick_tube_widens_and_bears_as_lame_says) {
  const double a = 1, b = 2, p = 1e6;
  for (const int degree : {1, 2}) {
    const int n = degree == 1 ? 16 : 8;
    const Grid grid =
        moved_grid(make_grid(BoxPlate{{a, 0, 0}, {b, 0.5 * pi, 0.2}, {n, 2 * n, 1}}), [](const Vector3 &q) {
          return Vector3{q[0] * std::cos(q[1]), q[0] * std::sin(q[1]), q[2]};
        });
    const ElasticModel model = make_elastic_model(grid, degree, {steel});
    Fixed fixed(model.nodes.size(), {0, 0, 0});
    const auto hold = [&](int tag, std::size_t k) {
      for (const int i : nodes_on(model, tag))
        fixed[static_cast<std::size_t>(i)][k] = 1;
    };
    hold(2, 1), hold(3, 0), hold(4, 2), hold(5, 2);
    const auto load =
        face_load(model, 0, [&](const Vector3 &, const Vector3 &normal) { return -p * normal; });
    std::vector<Vector3> x(load.size(), Vector3{});
    StaticEquations(model.stiffness, model.nodes, fixed).solve(model.stiffness, load, x);
    const double A = p * a * a / (b * b - a * a), B = A * b * b, e = steel.young_modulus,
                 nu = steel.poisson_ratio;
    const auto stress = nodal_stress(model, x);
    std::vector<Stress> at_node(x.size());
    for (std::size_t k = 0; k < stress.size(); ++k)
      at_node[static_cast<std::size_t>(model.cell_nodes[k])] = stress[k];
    for (std::size_t i = 0; i < x.size(); ++i) {
      const Vector3 &q = model.nodes[i];
      const double r = std::hypot(q[0], q[1]);
      const double expected = (1 + nu) / e * (A * (1 - 2 * nu) * r + B / r);
      EXPECT_NEAR((x[i][0] * q[0] + x[i][1] * q[1]) / r, expected, 0.005 * expected) << degree;
      // On the axis of y the hoop runs along x; in the middle of the wall the nodal mean has both sides.
      if (degree == 2 && std::abs(q[0]) < 1e-9 && std::abs(r - 1.5) < 0.2) {
        EXPECT_NEAR(at_node[i][0], A + B / (r * r), 0.02 * (A + B / (r * r)));
      }
    }
  }
}

// Pressed from below, free at the sides: stress is even, and the pressure is the closure over the sum of
// thickness over modulus. Without sideways strain that is exact.
TEST(elastic_model, sheets_in_series_add_their_compliances) {
  const Material pad{1200, 10e6, 0}, teflon{2200, 0.5e9, 0}, metal{7850, 210e9, 0};
  const std::vector<Layer> layers = {{0.001, 2}, {0.002, 1}, {0.017, 3}};
  for (const int degree : {1, 2})
    for (const char *shape : {"round", "box", "two strips"}) {
      const BoxPlate box{{0, 0, -0.01}, {0.05, 0.04, 0.01}, {3, 2, 9}},
          strip{{0.07, 0, -0.01}, {0.08, 0.04, 0.01}, {1, 2, 9}};
      const Grid grid = shape[0] == 'r'   ? make_grid(CylinderPlate{0.03, 0.02, -0.01, 4, 1}, layers)
                        : shape[0] == 'b' ? make_grid(box, layers)
                                          : make_grid(std::vector<BoxPlate>{box, strip}, layers);
      const ElasticModel model = make_elastic_model(grid, degree, {pad, teflon, metal});
      const double p = 1e6, area = model.volume / 0.02;
      const double closure = p * (0.001 / 10e6 + 0.002 / 0.5e9 + 0.017 / 210e9);
      Fixed fixed = held_on(model, {high_end_tag});
      std::vector<Vector3> x(model.nodes.size(), Vector3{}), force;
      for (const int i : nodes_on(model, low_end_tag)) {
        fixed[static_cast<std::size_t>(i)][2] = 1;
        x[static_cast<std::size_t>(i)][2] = closure;
      }
      const std::vector<Vector3> none(x.size(), Vector3{});
      StaticEquations(model.stiffness, model.nodes, fixed).solve(model.stiffness, none, x);
      multiply(model.stiffness, x, force);
      double reaction = 0;
      for (const int i : nodes_on(model, low_end_tag))
        reaction += force[static_cast<std::size_t>(i)][2];
      EXPECT_NEAR(reaction, p * area, 1e-9 * p * area) << degree << shape;
      for (const Stress &s : cell_stress(model, x))
        EXPECT_NEAR(s[2], -p, 1e-8 * p);
      // The first sheet lies at the low end.
      const std::size_t per_cell = model.cell_nodes.size() / model.cell_material.size();
      for (std::size_t c = 0; c < model.cell_material.size(); ++c)
        for (std::size_t k = 0; k < per_cell; ++k) {
          const double z = model.nodes[static_cast<std::size_t>(model.cell_nodes[per_cell * c + k])][2];
          EXPECT_TRUE(model.cell_material[c] == 0 ? z < -0.009 + 1e-9 : z > -0.009 - 1e-9) << shape << z;
        }
    }
}

TEST(elastic_model, lumped_masses_are_positive_and_weigh_what_the_solid_does) {
  const auto bent = [](const Vector3 &p) {
    return Vector3{p[0] + 0.3 * p[1] * p[2], p[1] - 0.2 * p[0] * p[2], p[2]};
  };
  for (const int degree : {1, 2}) {
    const Grid grid =
        moved_grid(make_grid(BoxPlate{{0, 0, 0}, {1, 1, 1}, {2, 3, 4}}, {{0.25, 2}, {0.75, 2}}), bent);
    const ElasticModel model = make_elastic_model(grid, degree, {rubber, steel});
    const VolumeMoments whole = volume_moments(grid);
    const ElasticModel even = make_elastic_model(grid, degree, {steel, steel});
    double sum = 0, even_sum = 0;
    Vector3 first{};
    for (std::size_t i = 0; i < model.mass.size(); ++i) {
      EXPECT_GT(model.mass[i], 0);
      sum += model.mass[i], even_sum += even.mass[i];
      first = first + even.mass[i] * model.nodes[i];
    }
    EXPECT_NEAR(model.volume, whole.volume, 1e-13 * whole.volume);
    EXPECT_NEAR(even_sum, steel.density * whole.volume, 1e-12 * even_sum);
    EXPECT_LT(sum, even_sum);
    // Quadrature at the nodes has the right centre, too.
    if (degree == 2) {
      EXPECT_LT(norm((1 / even_sum) * first - whole.centroid), 1e-13);
    }
  }
}

TEST(elastic_model, stiffness_is_symmetric_and_blind_to_rigid_motions) {
  for (const int degree : {1, 2}) {
    ElasticModel model = make_elastic_model(distorted_cube(3), degree, {steel});
    NodeMatrix &k = model.stiffness;
    for (std::size_t i = 0; i < k.rows(); ++i)
      for (std::size_t b = k.begin[i]; b < k.begin[i + 1]; ++b) {
        const double *mirror = k.find(static_cast<std::size_t>(k.column[b]), static_cast<int>(i));
        for (std::size_t r = 0; r < 3; ++r)
          for (std::size_t c = 0; c < 3; ++c)
            ASSERT_EQ(k.at(b)[r + 3 * c], mirror[c + 3 * r]);
      }
    std::vector<Vector3> motion(model.nodes.size()), force;
    for (std::size_t i = 0; i < motion.size(); ++i)
      motion[i] = Vector3{1, -2, 3} + cross(Vector3{3, 1, -2}, model.nodes[i]);
    multiply(k, motion, force);
    for (const Vector3 &f : force)
      EXPECT_LT(norm(f), 1e-13 * steel.young_modulus * 10);
  }
}

TEST(elastic_model, every_node_of_the_boundary_is_a_vertex) {
  for (const int degree : {1, 2}) {
    const Grid grid = make_grid(CylinderPlate{0.03, 0.01, -0.01, 8, 2});
    const ElasticModel model = make_elastic_model(grid, degree, {steel});
    const NodeSurface s = node_surface(model);
    double area = 0;
    for (std::size_t f = 0; f < s.surface.faces.size(); ++f)
      area += norm(face_area_vector(s.surface, f));
    EXPECT_LT(norm(total_area_vector(s.surface)), 1e-14 * area);
    EXPECT_NEAR(enclosed_volume(s.surface), model.volume, 1e-12 * model.volume);
    const auto plain = extract_surface(grid).surface;
    EXPECT_EQ(s.surface.faces.size(), plain.faces.size() * static_cast<std::size_t>(degree * degree));
    for (std::size_t v = 0; v < s.node.size(); ++v)
      EXPECT_EQ(s.surface.vertices[v], model.nodes[static_cast<std::size_t>(s.node[v])]);
    std::size_t low = 0;
    for (const Vector3 &p : model.nodes)
      low += p[2] == -0.01;
    EXPECT_EQ(nodes_on(model, low_end_tag).size(), low);
  }
}

TEST(elastic_model, multigrid_and_factors_agree) {
  for (const int degree : {1, 2}) {
    const ElasticModel model = make_elastic_model(
        make_grid(CylinderPlate{0.03, 0.02, 0, 8, 1}, {{0.002, 1}, {0.018, 2}}), degree, {rubber, steel});
    const auto load = body_load(model, [](const Vector3 &p) { return Vector3{1e6 * p[1], 2e5, 3e7 * p[0]}; });
    const Fixed fixed = held_on(model, {high_end_tag});
    std::vector<Vector3> by_factors(load.size(), Vector3{}), by_multigrid = by_factors;
    StaticEquations(model.stiffness, model.nodes, fixed, LinearSolver::direct)
        .solve(model.stiffness, load, by_factors);
    const StaticEquations multigrid(model.stiffness, model.nodes, fixed, LinearSolver::multigrid);
    multigrid.solve(model.stiffness, load, by_multigrid);
    EXPECT_GT(multigrid.iterations(), 1);
    double size = 0, difference = 0;
    for (std::size_t i = 0; i < load.size(); ++i) {
      size = std::max(size, norm(by_factors[i]));
      difference = std::max(difference, norm(by_factors[i] - by_multigrid[i]));
    }
    EXPECT_LT(difference, 1e-10 * size) << degree;
    EXPECT_GT(size, 0);
  }
}

TEST(elastic_model, what_no_solid_can_be_is_refused) {
  const Grid grid = make_grid(BoxPlate{{0, 0, 0}, {1, 1, 1}, {2, 1, 1}});
  EXPECT_THROW(make_elastic_model(grid, 3, {steel}), std::invalid_argument);
  EXPECT_THROW(make_elastic_model(grid, 1, {}), std::invalid_argument);
  EXPECT_THROW(make_elastic_model(grid, 1, {{7850, -1, 0.3}}), std::invalid_argument);
  EXPECT_THROW(make_elastic_model(make_grid(BoxPlate{{0, 0, 0}, {1, 1, 1}, {1, 1, 1}}, {{0.5, 1}, {0.5, 1}}),
                                  1, {steel}),
               std::invalid_argument);
  const Grid turned = moved_grid(grid, [](const Vector3 &p) { // the last corner pushed through its cell
    return p == Vector3{1, 1, 1} ? Vector3{0.4, 0.4, 0.4} : p;
  });
  for (const int degree : {1, 2})
    try {
      make_elastic_model(turned, degree, {steel});
      ADD_FAILURE() << "taken";
    } catch (const std::invalid_argument &refusal) {
      EXPECT_NE(std::string(refusal.what()).find("cell 1 at"), std::string::npos) << refusal.what();
    }
  EXPECT_THROW(make_grid(BoxPlate{{0, 0, 0}, {1, 1, 1}, {1, 1, 1}}, {{0.5, 1}, {0.4, 1}}),
               std::invalid_argument);
  EXPECT_THROW(make_grid(BoxPlate{{0, 0, 0}, {1, 1, 1}, {1, 1, 1}}, {{1.5, 1}, {-0.5, 1}}),
               std::invalid_argument);
  const ElasticModel model = make_elastic_model(grid, 1, {steel});
  EXPECT_THROW(StaticEquations(model.stiffness, model.nodes, Fixed(model.nodes.size(), {0, 0, 0})),
               std::invalid_argument);
}

} // namespace
} // namespace platen::fem::elastic_model_test
