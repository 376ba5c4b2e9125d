// A solid at finite strain and at rest, against closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numeric>
#include <string>

#include "base/pi.h"
#include "tests/fem/neo_hookean_point.h"
#include "tests/fem/newton.h"
#include "tests/fem/rubber_sleeve.h"
#include "tests/measured.h"
#include "tests/same_state.h"

namespace platen::fem::hyperelastic_statics_test {
namespace {

std::vector<int> nodes_where(const HyperelasticSolid &solid,
                             const std::function<bool(const Vector3 &)> &holds) {
  std::vector<int> found;
  for (std::size_t n = 0; n < solid.mesh().nodes.size(); ++n)
    if (holds(solid.mesh().nodes[n])) found.push_back(static_cast<int>(n));
  return found;
}

// All nodes of the outside follow an affine map: so do those inside, and the stress is that of the law. The
// cells of a round plate are of many shapes.
TEST(hyperelastic_statics, an_even_finite_strain_is_kept_by_cells_of_any_shape) {
  const NeoHookean law = NeoHookean::from_young(3e6, 0.4995);
  HyperelasticSolid solid(make_grid(CylinderPlate{0.05, 0.04, 0, 8, 4}), {1100, law});
  Newton newton(solid);
  const Tensor f = {1.15, 0.3, -0.05, 0.02, 0.9, 0.1, -0.1, 0.05, 0.97};
  std::vector<int> outside;
  std::vector<Vector3> all;
  for (const Vector3 &x : solid.mesh().nodes)
    all.push_back(Vector3{f[0] * x[0] + f[1] * x[1] + f[2] * x[2], f[3] * x[0] + f[4] * x[1] + f[5] * x[2],
                          f[6] * x[0] + f[7] * x[1] + f[8] * x[2]} -
                  x);
  for (std::size_t v = 0; v < solid.surface().vertices.size(); ++v)
    outside.push_back(solid.surface_node(static_cast<int>(v)));
  ASSERT_LT(outside.size(), all.size());
  newton.prescribe(outside, {true, true, true});
  for (const int n : outside)
    newton.place({n}, all[static_cast<std::size_t>(n)]);
  newton.solve();
  for (std::size_t n = 0; n < all.size(); ++n)
    EXPECT_LT(norm(solid.displacement()[n] - all[n]), 1e-10 * 0.05);
  const Tensor tau = kirchhoff(law, f);
  for (const CellStress &cell : solid.cell_stresses())
    for (std::size_t k = 0; k < 9; ++k)
      EXPECT_NEAR(cell.cauchy[k], tau[k] / determinant(f), 1e-9 * law.bulk_modulus);
}

struct Block {
  HyperelasticSolid solid{make_grid(BoxPlate{{0, 0, 0}, {0.03, 0.03, 0.03}, {4, 4, 4}}),
                          {1100, NeoHookean::from_young(3e6, 0.4)}};
  Newton newton{solid};
  Block() {
    newton.prescribe(solid.nodes_of(low_end_tag), {true, true, true});
    newton.prescribe(solid.nodes_of(high_end_tag), {true, true, true});
  }
};

// Each residual near the end is about the square of the one before: the tangent is that of the forces, with
// the pressure's share.
TEST(hyperelastic_statics, newton_converges_with_order_two) {
  Block block;
  block.solid.set_pressure(0, 3e5);
  std::vector<double> r = block.newton.solve(1e-13);
  while (!r.empty() && r.back() < 1e-12)
    r.pop_back(); // round-off
  ASSERT_GE(r.size(), 3u);
  const std::size_t k = r.size() - 1;
  const double order = std::log(r[k] / r[k - 1]) / std::log(r[k - 1] / r[k - 2]);
  measured::note_figure(27, "order_of_newtons_method", order, "> 1.8");
  EXPECT_GT(order, 1.8) << r[k - 2] << ' ' << r[k - 1] << ' ' << r[k];
}

// The prescribed ends carry what the pressure does not.
TEST(hyperelastic_statics, leads_balance_the_pressure) {
  HyperelasticSolid solid(make_grid(Tube{0.05, 0.005, 0.0, 0.06, 16, 6, 2}),
                          {1100, NeoHookean::from_young(3e6, 0.45)});
  Newton newton(solid);
  const std::vector<int> above = solid.nodes_of(high_end_tag);
  const int low = newton.prescribe(solid.nodes_of(low_end_tag), {true, true, true});
  const int high = newton.prescribe(above, {true, true, true});
  solid.set_pressure(inner_tag, 3e4);
  newton.place(above, {0.002, 0, -0.004});
  newton.solve();
  Vector3 sum = solid.prescribed_force(low) + solid.prescribed_force(high);
  for (const Vector3 &f : solid.pressure_forces())
    sum = sum + f;
  EXPECT_GT(norm(solid.prescribed_force(high)), 1);
  EXPECT_LT(norm(sum), 1e-7 * norm(solid.prescribed_force(high)));
}

// ---- the tube of physics: inner and outer radius 1 and 1.3, plane strain
double closed_form(double a) { // pressure over shear modulus at the inner radius a
  const double A = 1, B = 1.3, c = A * A - a * a, b = std::sqrt(B * B - c);
  return std::log(B / A) - std::log(b / a) + 0.5 * c * (1 / (b * b) - 1 / (a * a));
}

struct PlaneTube {
  HyperelasticSolid solid;
  Newton newton{solid};
  PlaneTube(double thickness, int around, int through, const NeoHookean &law)
      : solid(make_grid(Tube{1, thickness, 0, 0.1, around, 1, through}), {1100, law}) {
    const auto lead = [&](std::size_t axis, const std::function<bool(const Vector3 &)> &holds) {
      newton.prescribe(nodes_where(solid, holds), {axis == 0, axis == 1, axis == 2});
    };
    lead(2, [](const Vector3 &) { return true; });
    lead(0, [](const Vector3 &x) { return std::abs(x[0]) < 1e-9; });
    lead(1, [](const Vector3 &x) { return std::abs(x[1]) < 1e-9; });
  }
  void inflate(double pressure) {
    solid.set_pressure(inner_tag, pressure);
    newton.solve();
  }
};

double inner_radius(const HyperelasticSolid &solid) {
  double sum = 0;
  const std::vector<int> nodes = solid.nodes_of(inner_tag);
  for (const int n : nodes)
    sum += std::hypot(solid.node_place(n)[0], solid.node_place(n)[1]);
  return sum / static_cast<double>(nodes.size());
}

TEST(hyperelastic_statics, a_tube_is_inflated_as_the_closed_form_says) {
  EXPECT_NEAR(closed_form(1.25), 0.134626, 1e-6);
  const NeoHookean law = NeoHookean::from_young(2 * (1 + 0.499), 0.499); // shear modulus 1
  double error[3];
  int k = 0;
  for (const int through : {1, 2, 4}) {
    PlaneTube tube(0.3, 16 * through, through, law);
    for (const double share : {0.5, 1.0})
      tube.inflate(share * 0.134626);
    error[k++] = std::abs(0.134626 / closed_form(inner_radius(tube.solid)) - 1);
  }
  measured::expect_below(26, "pressure_of_an_inflated_tube_4_through", error[2], 0.005);
  measured::expect_below(26, "pressure_of_an_inflated_tube_2_through", error[1], 0.03);
  for (k = 1; k < 3; ++k)
    EXPECT_GT(error[k - 1] / error[k], 3.5); // second order
}

// p = mu t0/R0 (1 - lambda^-4), with radii of the wall's middle: the first order in t0/R0.
TEST(hyperelastic_statics, a_thin_sleeve_softens_as_it_is_stretched) {
  const NeoHookean law = NeoHookean::from_young(2 * (1 + 0.499), 0.499);
  const double t0 = 0.02, R0 = 1.01;
  PlaneTube tube(t0, 64, 1, law);
  for (const double share : {0.3, 0.5, 0.7}) { // of the pressure that it never reaches
    const double p = share * t0 / R0;
    tube.inflate(p);
    const double a = inner_radius(tube.solid), b = std::sqrt(a * a + 1.02 * 1.02 - 1);
    const double stretch = 0.5 * (a + b) / R0;
    EXPECT_NEAR(p, t0 / R0 * (1 - std::pow(stretch, -4)), 0.02 * p);
  }
}

// A strip of a 3 mm sleeve bent by an end force, against Euler and Bernoulli with shear: the figure for how
// long an element may be beside its thickness.
double bending_share(double element_length, int through, double poisson) {
  const double t = 0.003, length = 0.06, young = 3e6, force = 1e-4;
  const int along = static_cast<int>(std::lround(length / element_length));
  HyperelasticSolid solid(make_grid(BoxPlate{{0, 0, 0}, {length, t, t}, {along, 1, through}}),
                          {1100, NeoHookean::from_young(young, poisson)});
  Newton newton(solid);
  newton.prescribe(nodes_where(solid, [](const Vector3 &x) { return x[0] < 1e-9; }), {true, true, true});
  const std::vector<int> tip = nodes_where(solid, [&](const Vector3 &x) { return x[0] > length - 1e-9; });
  double sum = 0;
  for (std::size_t v = 0; v < solid.surface().vertices.size(); ++v)
    if (solid.surface().vertices[v][0] > length - 1e-9) sum += 1;
  for (std::size_t v = 0; v < solid.surface().vertices.size(); ++v)
    if (solid.surface().vertices[v][0] > length - 1e-9)
      solid.add_surface_force(static_cast<int>(v), {0, 0, force / sum});
  newton.solve(1e-6); // of small forces beside the bulk modulus
  double sag = 0;
  for (const int n : tip)
    sag += solid.displacement()[static_cast<std::size_t>(n)][2] / static_cast<double>(tip.size());
  const double inertia = t * t * t * t / 12, shear = young / (2 * (1 + poisson));
  return sag / (force * length * length * length / (3 * young * inertia) +
                force * length / (5.0 / 6 * shear * t * t));
}

// Linear elements lock: what stays of the deflection falls with their length over the thickness and, from two
// through it on, hardly depends on how many these are or on Poisson's ratio. The table of docs/theory.md, 11.
TEST(hyperelastic_statics, bending_of_a_thin_strip_is_too_stiff_by_the_known_share) {
  constexpr double lengths[] = {0.003, 0.006, 0.012};
  constexpr double shares[][3] = {{1.39, .58, .17}, {.75, .42, .16}, {.73, .42, .15}};
  for (int through = 1; through <= 3; ++through)
    for (int k = 0; k < 3; ++k) {
      const double share = bending_share(lengths[k], through, 0.499);
      RecordProperty(std::to_string(through) + "_through_" + std::to_string(1 << k) + "_long",
                     std::to_string(share));
      EXPECT_NEAR(share, shares[through - 1][k], 0.01) << through << ' ' << lengths[k];
      if (through > 1) {
        EXPECT_NEAR(bending_share(lengths[k], through, 0.3), share, 0.03) << through;
      }
    }
}

TEST(hyperelastic_statics, what_cannot_be_reached_is_named_and_leaves_the_solid_as_it_was) {
  Block block;
  block.solid.set_pressure(0, 1e5);
  block.newton.place(block.solid.nodes_of(high_end_tag), {0, 0, -0.002});
  block.newton.solve();
  const State before = state_of(block.solid);
  block.newton.place(block.solid.nodes_of(high_end_tag), {0, 0, -0.04});
  try {
    block.newton.solve();
    FAIL() << "a block was pushed through itself";
  } catch (const InvertedElement &error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("cell " + std::to_string(error.cell) + " at ("), std::string::npos) << text;
    EXPECT_NE(text.find("pressure 100000 Pa on side 0"), std::string::npos) << text;
    EXPECT_LT(error.volume_ratio, 0);
  }
  EXPECT_TRUE(same_state(before, block.solid));
}

// Loads and a pressure on a side indent it, and the prescribed ends bear them; taken off, the solid is where
// it was.
TEST(hyperelastic_statics, contact_loads_come_and_go) {
  Block block;
  HyperelasticSolid &solid = block.solid;
  solid.set_pressure(0, 1e4);
  const int middle = 2 + 5 * 2; // a vertex of the low end, prescribed; and one of a side
  solid.add_surface_force(middle, {1, 2, 3});
  int side = 0;
  for (std::size_t v = 0; v < solid.surface().vertices.size(); ++v) {
    const Vector3 &x = solid.surface().vertices[v];
    if (x[0] > 0.0299 && std::abs(x[1] - 0.015) < 1e-9 && std::abs(x[2] - 0.015) < 1e-9)
      side = static_cast<int>(v);
  }
  solid.add_surface_force(side, {-20, 0, 0});
  block.newton.solve();
  const double indentation = solid.displacement()[static_cast<std::size_t>(solid.surface_node(side))][0];
  EXPECT_LT(indentation, -1e-4);
  const std::vector<Vector3> &pressed = solid.pressure_forces();
  const Vector3 pressure = std::accumulate(pressed.begin(), pressed.end(), Vector3{});
  EXPECT_GT(norm(pressure), 5);
  EXPECT_NEAR(norm(solid.prescribed_force(0) + solid.prescribed_force(1) + solid.total_force() + pressure), 0,
              1e-7);
  solid.clear_loads(), solid.set_pressure(0, 0);
  block.newton.solve();
  EXPECT_LT(largest(solid.displacement()), 1e-9 * 0.03);
}

} // namespace
} // namespace platen::fem::hyperelastic_statics_test
