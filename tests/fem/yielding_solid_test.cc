// Bodies at small strain whose material yields: cells against closed forms, and the explicit motion.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "base/pi.h"
#include "fem/elastic_solid.h"
#include "tests/fem/elastic_plate.h"
#include "tests/fem/metal.h"
#include "tests/fem/rubber_sleeve.h"
#include "tests/measured.h"

namespace platen::fem::yielding_solid_test {
namespace {

using Gradient = std::array<double, 9>; // of a displacement, row by row

Material ductile(const Hardening &hardening) {
  return {7850, 210e9, 0.3, hardening};
}
constexpr double young = 210e9, poisson = 0.3, shear = young / 2.6;

// The cells of a block whose nodes all follow one gradient.
struct Patch {
  ElasticModel model;
  YieldingCells cells;
  std::vector<Vector3> u, force; // m, N
  double stored = 0;             // J

  explicit Patch(int degree)
      : model(make_elastic_model(distorted_grid(), degree, {ductile(curved)})), cells(model) {}
  void deform(const Gradient &g) {
    std::vector<Vector3> field;
    for (const Vector3 &x : model.nodes)
      field.push_back({dot({g[0], g[1], g[2]}, x), dot({g[3], g[4], g[5]}, x), dot({g[6], g[7], g[8]}, x)});
    move_to(field);
  }
  void move_to(const std::vector<Vector3> &field) {
    u = field;
    cells.yield(u);
    multiply(model.stiffness, u, force);
    stored = 0.5 * dot(u, force) - dot(u, cells.forces()) + cells.energy_of_plastic_strain();
    for (std::size_t n = 0; n < force.size(); ++n)
      force[n] = force[n] - cells.forces()[n];
  }
  // N, on the nodes of the face x, y or z = high.
  Vector3 face(std::size_t axis) const {
    const double high = axis == 2 ? 0.03 : 0.015;
    Vector3 sum{};
    for (std::size_t n = 0; n < force.size(); ++n)
      if (model.nodes[n][axis] > high - 1e-9) sum = sum + force[n];
    return sum;
  }
  double largest_inner() const {
    double most = 0;
    for (std::size_t n = 0; n < force.size(); ++n) {
      const Vector3 &x = model.nodes[n];
      const bool inner = std::abs(x.x) < 0.0149 && std::abs(x.y) < 0.0149 && x.z > 1e-4 && x.z < 0.0299;
      if (inner) most = std::max(most, norm(force[n]));
    }
    return most;
  }
};

constexpr double area = 9e-4, volume = 2.7e-5; // m^2, m^3, of the block

// Tension along an axis: e = s/E + a along it, -nu s/E - a/2 across; its path is straight, so that one step
// is exact. Then half of the stress is taken off, and the bar is pressed until it yields again.
TEST(yielding_solid, a_bar_flows_at_its_flow_stress_and_unloads_elastically) {
  for (const int degree : {1, 2})
    for (const std::size_t axis : {0u, 1u, 2u}) {
      Patch patch(degree);
      const auto pull = [&](double stress, double plastic, double flowed) {
        Gradient g{};
        for (std::size_t k = 0; k < 3; ++k)
          g[4 * k] = k == axis ? stress / young + plastic : -poisson * stress / young - 0.5 * plastic;
        patch.deform(g);
        Vector3 expected{};
        expected[axis] = stress * area;
        const double size = curved.at(flowed).stress * area;
        EXPECT_LT(norm(patch.face(axis) - expected), 1e-10 * size) << degree << ' ' << axis;
        EXPECT_LT(norm(patch.face((axis + 1) % 3)), 1e-10 * size) << degree << ' ' << axis;
        EXPECT_LT(patch.largest_inner(), 1e-10 * size) << degree << ' ' << axis;
        EXPECT_NEAR(patch.stored / (volume * stress * stress / (2 * young)), 1, 1e-8);
        for (const double strain : patch.cells.strains())
          EXPECT_NEAR(strain, flowed, 1e-14);
        EXPECT_NEAR(patch.cells.plastic_work(), volume * curved.at(flowed).work,
                    1e-10 * volume * size / area);
      };
      pull(200e6, 0, 0);
      for (const double a : {0.002, 0.011, 0.03})
        pull(curved.at(a).stress, a, a);
      pull(0.5 * curved.at(0.03).stress, 0.03, 0.03);
      pull(-curved.at(0.036).stress, 0.024, 0.036);
    }
}

// g = t/mu + sqrt(3) a at the shear stress t = k(a)/sqrt(3).
TEST(yielding_solid, shear_flows_at_the_flow_stress_over_root_three) {
  for (const int degree : {1, 2})
    for (const std::size_t i : {0u, 1u, 2u}) {
      const std::size_t k = (i + 1) % 3;
      Patch patch(degree);
      for (const double a : {0.001, 0.02}) {
        Gradient g{};
        const double stress = curved.at(a).stress / std::sqrt(3.0);
        const double angle = stress / shear + std::sqrt(3.0) * a;
        g[3 * i + k] = 0.8 * angle, g[3 * k + i] = 0.2 * angle; // turned on the way
        patch.deform(g);
        Vector3 expected{};
        expected[i] = stress * area;
        EXPECT_LT(norm(patch.face(k) - expected), 1e-10 * stress * area) << degree << ' ' << i;
        EXPECT_LT(patch.largest_inner(), 1e-10 * stress * area);
      }
    }
}

// Between walls the deviator flows at q = k and the pressure stays elastic: e - (1 - 2 nu)/E ... in closed
// form sigma = kappa e + 2/3 k(a), e = 3/2 (a + k/(3 mu)).
TEST(yielding_solid, a_layer_between_walls_stays_elastic_in_volume) {
  const double bulk = young / (3 * (1 - 2 * poisson));
  for (const int degree : {1, 2}) {
    Patch patch(degree);
    const double a = 0.015, flow = curved.at(a).stress, e = 1.5 * (a + flow / (3 * shear));
    Gradient g{};
    g[8] = -e;
    patch.deform(g);
    const double along = -bulk * e - 2.0 / 3 * flow, across = -bulk * e + flow / 3;
    EXPECT_LT(norm(patch.face(2) - area * Vector3{0, 0, along}), 1e-10 * area * std::abs(along));
    EXPECT_LT(norm(patch.face(0) - area * Vector3{across, 0, 0}), 1e-10 * area * std::abs(along));
  }
}

// On a path without pattern, where some points of a cell have yielded and others have not: what the forces do
// is stored or lost, to second order in the steps.
TEST(yielding_solid, work_is_stored_or_lost) {
  for (const int degree : {1, 2}) {
    double off[2], lost = 0;
    for (const int fine : {0, 1}) {
      Patch patch(degree);
      const std::vector<Vector3> end = random_field(patch.model.nodes.size(), 8e-6 / degree, 3);
      std::vector<Vector3> field(end.size()), before(end.size()), forces(end.size());
      const int steps = 50 * (1 + fine);
      double work = 0;
      for (int k = 1; k <= steps; ++k) {
        for (std::size_t n = 0; n < end.size(); ++n)
          field[n] = std::sin(1.5 * pi * k / steps) * end[n]; // there, back, and to the other side
        patch.move_to(field);
        for (std::size_t n = 0; n < end.size(); ++n)
          work += 0.5 * dot(forces[n] + patch.force[n], field[n] - before[n]);
        before = field, forces = patch.force;
      }
      lost = patch.cells.plastic_work();
      off[fine] = std::abs(work - patch.stored - lost);
    }
    EXPECT_LT(off[1], 1e-3 * lost) << degree;
    EXPECT_LT(off[1], 0.4 * off[0]) << degree;
  }
}

// Cells that are brought to rest by damping while some of their nodes are moved.
struct Relaxed {
  ElasticModel model;
  YieldingCells cells;
  Fixed held;
  std::vector<Vector3> u, v, given, force;

  Relaxed(const Grid &grid, int degree, const Material &material)
      : model(make_elastic_model(grid, degree, {material})), cells(model) {
    held.assign(model.nodes.size(), {0, 0, 0});
    for (std::vector<Vector3> *column : {&u, &v, &given, &force})
      column->assign(model.nodes.size(), Vector3{});
  }
  // Over a time (s) at the given velocities and as long at rest; `damping`: 1/s.
  void move(double time, double damping) {
    const double dt =
        0.9 * 2 / std::sqrt(largest_eigenvalue(model.stiffness, model.mass, held, model.cell_bound));
    const int steps = static_cast<int>(time / dt) + 1;
    for (int s = 0; s < 2 * steps; ++s) {
      const double speed = s < steps ? 1 - std::cos(2 * pi * (s + 0.5) / steps) : 0,
                   drag = 0.5 * dt * damping;
      for (std::size_t n = 0; n < u.size(); ++n)
        for (std::size_t k = 0; k < 3; ++k)
          v[n][k] = held[n][k] ? speed * time / (steps * dt) * given[n][k]
                               : ((1 - drag) * v[n][k] + dt / model.mass[n] * force[n][k]) / (1 + drag);
      for (std::size_t n = 0; n < u.size(); ++n)
        u[n] = u[n] + dt * v[n];
      cells.yield(u);
      multiply(model.stiffness, u, force);
      for (std::size_t n = 0; n < u.size(); ++n)
        force[n] = cells.forces()[n] - force[n];
    }
  }
};

// A quarter of a thick tube (b = 2 a) in plane strain whose inner face is moved outward, over its limit
// pressure 2/sqrt(3) k ln(b/a) at small strain (Hill: The Mathematical Theory of Plasticity, 1950, chapter
// 5).
double pressure_over_limit(int degree, int through) {
  const double a = 0.1, yield = 240e6;
  const Grid bent =
      moved_grid(make_grid(BoxPlate{{0, 0, 0}, {1, 1, 1}, {through, 4 * through, 1}}), [&](const Vector3 &x) {
        const double r = a * (1 + x.x), turn = 0.5 * pi * x.y;
        return Vector3{r * std::cos(turn), r * std::sin(turn), a * x.z / through};
      });
  Relaxed ring(bent, degree, ductile(lines({{0, yield}})));
  const std::vector<int> inner = nodes_on(ring.model, 0);
  for (std::size_t n = 0; n < ring.u.size(); ++n) {
    const Vector3 &x = ring.model.nodes[n];
    ring.held[n] = {x.x < 1e-9, x.y < 1e-9, 1};
  }
  const double time = 1e-3, moved = 1e-3;
  for (const int i : inner) {
    const auto n = static_cast<std::size_t>(i);
    ring.held[n] = {1, 1, 1};
    const Vector3 &x = ring.model.nodes[n];
    ring.given[n] = (moved / (time * a)) * Vector3{x.x, x.y, 0}; // its chords stay straight
  }
  ring.move(time, 5e4);
  double work = 0; // J, of a widening of the inner radius by 1 m
  for (const int i : inner) {
    const auto n = static_cast<std::size_t>(i);
    work += time / moved * dot(ring.force[n], ring.given[n]);
  }
  const double sector = 0.5 * pi / (4 * through),
               swept = 4 * through * std::sin(sector) * a * a / through; // m^3
  for (const double strain : ring.cells.strains())
    EXPECT_GT(strain, 0);
  return -work / swept / (2 / std::sqrt(3.0) * yield * std::log(2.0));
}

// With the volume held at all points degree 1 would be 61, 18 and 5 % off, degree 2 4 and .4 %.
TEST(yielding_solid, a_thick_tube_yields_through_at_its_limit_pressure) {
  std::vector<double> errors;
  for (const int through : {1, 2, 4})
    errors.push_back(pressure_over_limit(1, through) - 1);
  for (std::size_t k = 1; k < errors.size(); ++k)
    EXPECT_NEAR(std::log2(errors[k - 1] / errors[k]), 2, 0.15) << k;
  measured::expect_below(70, "thick_tube_at_small_strain", std::abs(errors.back()), 0.01);
  EXPECT_LT(std::abs(pressure_over_limit(2, 1) - 1), 4e-3);
  EXPECT_LT(std::abs(pressure_over_limit(2, 2) - 1), 1e-3);
}

// A strip of half-width 1 pressed into a half space in plane strain: (2 + pi) k/sqrt(3) (Prandtl 1920).
double punch_over_limit(int degree, int across) {
  const double b = 0.01, yield = 240e6, h = b / across;
  const int wide = 4 * across, deep = 3 * across;
  Relaxed block(make_grid(BoxPlate{{0, 0, 0}, {wide * h, h, deep * h}, {wide, 1, deep}}), degree,
                ductile(lines({{0, yield}})));
  const double time = 1.5e-4, moved = 4e-4;
  double force = 0;
  for (std::size_t n = 0; n < block.u.size(); ++n) {
    const Vector3 &x = block.model.nodes[n];
    block.held[n] = {x.x < 1e-9 || x.x > wide * h - 1e-9 || x.z < 1e-9, 1, x.z < 1e-9};
    if (x.z > deep * h - 1e-9 && x.x < b + 1e-9)
      block.held[n] = {1, 1, 1}, block.given[n] = {0, 0, -moved / time};
  }
  block.move(time, 1e5);
  for (std::size_t n = 0; n < block.u.size(); ++n)
    if (block.given[n].z != 0) force += block.force[n].z;
  return force / (b * h) / ((2 + pi) * yield / std::sqrt(3.0));
}

// The edge of the strip cuts an element, so that the load falls to the limit with the size of elements. With
// the volume held at all points degree 1 would be 79 and 43 % above it, degree 2 23 and 12 %.
TEST(yielding_solid, a_strip_sinks_in_at_prandtls_load) {
  for (const int degree : {1, 2}) {
    const double coarse = punch_over_limit(degree, 2) - 1, fine = punch_over_limit(degree, 4) - 1;
    measured::expect_below(70, degree == 1 ? "strip_over_Prandtl_degree_1" : "strip_over_Prandtl_degree_2",
                           fine, degree == 1 ? 0.12 : 0.045);
    EXPECT_GT(fine, 0);
    EXPECT_NEAR(std::log2(coarse / fine), 1, 0.2) << degree;
  }
}

// A free bar of two cells whose ends are pulled, in explicit steps. Mass damping is critical for its lowest
// mode, so that a load that rises is met from below.
class Bar {
public:
  explicit Bar(const Hardening &hardening)
      : solid_(make_grid(BoxPlate{{0, 0, 0}, {0.01, 0.01, 0.02}, {1, 1, 2}}), {ductile(hardening)},
               Clamp{no_clamp}, options()) {}
  static ElasticOptions options() {
    ElasticOptions options;
    options.mass_damping = 2 * pi * std::sqrt(young / 7850) / 0.02;
    return options;
  }
  // From the present stress to another (Pa), and to rest.
  void pull(double stress) {
    const double dt = 0.5 * solid_.stable_step();
    const int rising = 2000, resting = 20000;
    for (int k = 0; k < rising + resting; ++k) {
      solid_.kick(0.5 * dt);
      solid_.drift(dt);
      const double part = k < rising ? 0.5 * (1 - std::cos(pi * (k + 1) / rising)) : 1;
      load(stress_ + part * (stress - stress_));
      solid_.kick(0.5 * dt);
    }
    stress_ = stress;
  }
  double length() const { // m, gained
    double low = 0, high = 0;
    for (std::size_t n = 0; n < solid_.model().nodes.size(); ++n)
      (solid_.model().nodes[n].z > 0.01 ? high : low) += 0.25 * solid_.deformation()[n].z * at_end(n);
    return high - low;
  }
  ElasticSolid &solid() { return solid_; }

private:
  bool at_end(std::size_t n) const { return std::abs(solid_.model().nodes[n].z - 0.01) > 0.009; }
  void load(double stress) {
    solid_.clear_loads();
    for (std::size_t v = 0; v < solid_.surface().vertices.size(); ++v) {
      const double z = solid_.surface().vertices[v].z - 0.01;
      if (std::abs(z) > 0.005)
        solid_.add_surface_force(static_cast<int>(v), {0, 0, std::copysign(0.25 * 1e-4 * stress, z)});
    }
  }
  ElasticSolid solid_;
  double stress_ = 0; // Pa
};

TEST(yielding_solid, a_pulled_bar_comes_to_rest_on_its_hardening) {
  const double hard = 21e9, yield = 250e6, stress = 400e6, a = (stress - yield) / hard;
  Bar bar(lines({{0, yield}, {1, yield + hard}}));
  const auto at_rest = [&](double now) {
    EXPECT_NEAR(bar.length() / (0.02 * (now / young + a)), 1, 1e-8) << now;
    for (const double strain : bar.solid().plastic_strains())
      EXPECT_NEAR(strain / a, 1, 1e-8) << now;
    const EnergyBalance e = bar.solid().energy_balance();
    EXPECT_NEAR(e.plastic / (2e-6 * 0.5 * (yield + stress) * a), 1, 1e-8);
    EXPECT_NEAR(e.strain / (2e-6 * now * now / (2 * young)), 1, 1e-7);
    EXPECT_LT(std::abs(total(e)), 1e-4 * e.plastic);
  };
  bar.pull(200e6);
  EXPECT_EQ(bar.solid().energy_balance().plastic, 0);
  bar.pull(stress);
  at_rest(stress);
  const Picture picture = bar.solid().picture();
  for (const double mises : picture.of_points.back().values)
    EXPECT_NEAR(mises / stress, 1, 1e-8);
  ASSERT_EQ(picture.of_cells.at(0).name, "plastic_strain");
  EXPECT_EQ(picture.of_cells[0].values, bar.solid().plastic_strains());
  bar.pull(100e6);
  at_rest(100e6);
}

// Kicked and turned on its seat: the work of loads is kept, in the limit of small steps.
TEST(yielding_solid, an_explicit_path_closes_its_energy_balance) {
  for (const int degree : {1, 2}) {
    double residual[2];
    for (const int fine : {0, 1}) {
      ElasticOptions options{degree};
      options.fastest_damping = 0.05;
      Clamp clamp;
      clamp.turns = true, clamp.seat = {0.01, 0, 0.02};
      ElasticSolid solid(plate(), {ductile(lines({{0, 5e6}}, 5e6, 50))}, clamp, options);
      const double dt = 0.8 * solid.stable_step() / (1 + fine);
      const int steps = 400 * (1 + fine);
      double worst = 0;
      for (int k = 0; k < steps; ++k) {
        solid.kick(0.5 * dt), solid.drift(dt);
        put(solid, uneven_loads(solid, 2e3 * std::sin(4 * pi * (k + 1) / steps)));
        solid.kick(0.5 * dt);
        worst = std::max(worst, std::abs(total(solid.energy_balance())));
      }
      const EnergyBalance e = solid.energy_balance();
      EXPECT_GT(e.plastic, 0.15 * e.load_work) << degree;
      residual[fine] = worst / e.plastic;
    }
    measured::expect_below(70, "energy_residual_of_yielding_platens", residual[0], 1e-3);
    EXPECT_LT(residual[1], 0.6 * residual[0]) << degree;
  }
}

// A pad on a plate: the pad is elastic, and its cells have no plastic strain.
TEST(yielding_solid, other_materials_beside_it_stay_elastic) {
  const Grid grid =
      make_grid(BoxPlate{{0, 0, 0}, {0.02, 0.02, 0.02}, {2, 2, 2}}, std::vector<Layer>{{0.01, 1}, {0.01, 1}});
  ElasticSolid solid(grid, {pad, ductile(lines({{0, 1e6}}))}, Clamp{});
  const double dt = 0.5 * solid.stable_step();
  for (int k = 0; k < 2000; ++k) {
    solid.kick(0.5 * dt), solid.drift(dt);
    put(solid, uneven_loads(solid, 1e-2 * k));
    solid.kick(0.5 * dt);
  }
  const std::vector<double> strains = solid.plastic_strains();
  for (std::size_t c = 0; c < strains.size(); ++c)
    if (solid.model().cell_material[c] == 0)
      EXPECT_EQ(strains[c], 0);
    else
      EXPECT_GT(strains[c], 0);
  // Pictures have the mean stress of each cell that yields, which is nowhere above the flow stress.
  const Picture picture = solid.picture();
  double least = 1e9, most = 0;
  for (std::size_t n = 0; n < picture.points.size(); ++n)
    if (solid.model().cell_material[n / 8] == 1) {
      const double mises = picture.of_points.back().values[n];
      least = std::min(least, mises), most = std::max(most, mises);
    }
  EXPECT_LT(most, (1 + 1e-9) * 1e6);
  EXPECT_GT(least, 0.2e6);
  EXPECT_GT(most - least, 1e4);
  ElasticSolid without(grid, {pad, steel}, Clamp{});
  EXPECT_TRUE(without.plastic_strains().empty());
}

TEST(yielding_solid, what_does_not_yield_is_refused) {
  const Material metal = ductile(lines({{0, 250e6}}));
  const ElasticOptions still{1, ElasticMotion::quasi_static};
  EXPECT_THROW(ElasticSolid(plate(), {metal}, Clamp{}, still), std::invalid_argument);
  EXPECT_THROW(ElasticSolid(plate(), {ductile({})}, Clamp{}), std::invalid_argument);
  EXPECT_NO_THROW(ElasticSolid(plate(), {metal}, Clamp{}));
}

} // namespace
} // namespace platen::fem::yielding_solid_test
