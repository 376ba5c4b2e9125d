// Tubes of steel that are blown up from inside, in explicit steps, against closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "base/pi.h"
#include "tests/fem/metal.h"
#include "tests/fem/rubber_sleeve.h"
#include "tests/measured.h"
#include "tests/same_state.h"

namespace platen::fem::yielding_tube_test {
namespace {

constexpr double inner = 0.1; // m

// A ring whose inner nodes move outward alike; ends held along the axis, or free.
class Ring {
public:
  Ring(double thickness, int through, int around, bool held, double yield)
      : height_(0.02),
        solid_(make_grid(Tube{inner, thickness, 0.0, height_, around, 1, through}),
               {ductile_steel.density, ductile_steel.law, lines({{0, yield}})}) {
    nodes_ = solid_.nodes_of(inner_tag);
    motion_ = solid_.prescribe(nodes_, {true, true, false});
    solid_.prescribe_each(motion_);
    solid_.set_node_velocities(motion_, std::vector<Vector3>(nodes_.size()));
    if (held)
      for (const int tag : {low_end_tag, high_end_tag})
        solid_.prescribe(solid_.nodes_of(tag), {false, false, true});
    else // against drift along the axis
      solid_.prescribe(solid_.nodes_of(low_end_tag), {false, false, true});
    solid_.update_forces();
  }

  // By `displacement` (m), smoothly, and then to rest.
  void widen(double displacement) {
    const double dt = 0.8 * solid_.stable_step(), period = 2 * pi * inner / 5000;
    const int moving = static_cast<int>(10 * period / dt), resting = moving;
    solid_.set_damping(2 / period);
    for (int k = 0; k < moving + resting; ++k) {
      const double speed =
          k < moving ? displacement / (moving * dt) * (1 - std::cos(2 * pi * (k + 0.5) / moving)) : 0.0;
      std::vector<Vector3> velocities;
      for (const int n : nodes_) {
        const Vector3 &x = solid_.mesh().nodes[static_cast<std::size_t>(n)];
        velocities.push_back(speed / inner * Vector3{x.x, x.y, 0});
      }
      solid_.set_node_velocities(motion_, velocities);
      step(solid_, dt, 1);
    }
  }

  // Pa, of what moves the inner face: its virtual work in a widening over the change of the volume within.
  double pressure() const {
    double work = 0; // J, of a widening by all of the radius
    for (const int n : nodes_) {
      const Vector3 at = solid_.node_place(n);
      const Vector3 &f = solid_.internal_forces()[static_cast<std::size_t>(n)];
      work += f.x * at.x + f.y * at.y;
    }
    return work / (2 * solid_.enclosed_volume(inner_tag));
  }
  HyperelasticSolid &solid() { return solid_; }

private:
  double height_;
  HyperelasticSolid solid_;
  std::vector<int> nodes_;
  int motion_ = 0;
};

// Pressure at a displacement u of the inner radius, plane strain: u = (1 + nu)/E p a ((1 - 2 nu) + b^2/a^2) /
// (b^2/a^2 - 1) (Lame; Timoshenko, Goodier: Theory of Elasticity, section 28).
double lame_pressure(double u, double ratio) {
  const double young = 210e9, nu = 0.3, square = ratio * ratio;
  return u * young / ((1 + nu) * inner) * (square - 1) / (1 - 2 * nu + square);
}

TEST(yielding_tube, a_thick_elastic_tube_agrees_with_lame_at_second_order) {
  const double u = 1e-6; // of 100 mm
  std::vector<double> errors;
  for (const int through : {1, 2, 4, 8}) {
    Ring ring(inner, through, 8 * through, true, 240e6);
    ring.widen(u);
    errors.push_back(std::abs(ring.pressure() / lame_pressure(u, 2) - 1));
    EXPECT_EQ(ring.solid().plastic_work(), 0);
  }
  measured::expect_below(70, "thick_tube_over_Lame", errors.back(), 2e-3);
  for (std::size_t k = 1; k < errors.size(); ++k)
    EXPECT_NEAR(std::log2(errors[k - 1] / errors[k]), 2, 0.15) << k;
}

// p = 2/sqrt(3) k ln(b/a) (Hill: The Mathematical Theory of Plasticity, 1950, chapter 5), with the radii as
// they are then.
TEST(yielding_tube, a_thick_tube_yields_through_at_its_limit_pressure) {
  const double yield = 240e6;
  std::vector<double> errors;
  for (const int through : {1, 2, 4, 8}) {
    Ring ring(inner, through, 8 * through, true, yield);
    ring.widen(1e-3);
    const double a = inner + 1e-3, b = std::sqrt(a * a + 3 * inner * inner); // the volume does not change
    errors.push_back(ring.pressure() / (2 / std::sqrt(3.0) * yield * std::log(b / a)) - 1);
    for (const double strain : ring.solid().plastic_strains())
      EXPECT_GT(strain, 0);
  }
  measured::expect_below(70, "thick_tube_at_its_limit_pressure", std::abs(errors.back()), 0.01);
  for (std::size_t k = 1; k < errors.size(); ++k)
    EXPECT_NEAR(std::log2(errors[k - 1] / errors[k]), 2, 0.25) << k;
}

// By von Mises with the mean radial stress -p/2 in the wall: p R = 2/sqrt(3) k t at its middle where the ends
// are held, and p R = k t at a quarter of the wall where they are free.
TEST(yielding_tube, a_thin_tube_yields_at_its_hoop_stress) {
  const double yield = 300e6, wall = inner / 50, u = 1e-3;
  for (const bool held : {false, true}) {
    Ring ring(wall, 2, 64, held, yield);
    ring.widen(u);
    const double hoop = std::log(1 + u / (inner + 0.5 * wall));
    const double thickness = wall * std::exp(held ? -hoop : -0.5 * hoop); // a free ring shortens as it thins
    const double expected = held ? 2 / std::sqrt(3.0) * yield * thickness / (inner + u + 0.5 * thickness)
                                 : yield * thickness / (inner + u + 0.25 * thickness);
    measured::expect_below(70, held ? "thin_tube_held" : "thin_tube_free",
                           std::abs(ring.pressure() / expected - 1), 1e-3);
  }
}

TEST(yielding_tube, an_explicit_path_closes_its_energy_balance) {
  double worst[2] = {0, 0}, work = 0;
  for (const int fine : {0, 1}) {
    HyperelasticSolid solid(make_grid(Tube{0.05, 0.003, 0.0, 0.05, 24, 6, 2}),
                            {ductile_steel.density, ductile_steel.law, curved});
    solid.prescribe(solid.nodes_of(low_end_tag), {true, true, true});
    const int top = solid.prescribe(solid.nodes_of(high_end_tag), {true, true, true});
    solid.update_forces();
    solid.set_damping(200);
    const double dt = 0.5 * solid.stable_step() / (1 + fine);
    const int steps = 800 * (1 + fine);
    for (int k = 0; k < steps; ++k) {
      const double turn = 2 * pi * k / steps;
      solid.set_prescribed_velocity(top, {0, 0, -20 * std::sin(turn)}, {0, 0, 140 * std::sin(2 * turn)});
      solid.set_pressure(inner_tag, 6e6 * k / steps);
      step(solid, dt, 1);
      worst[fine] = std::max(worst[fine], std::abs(imbalance(solid) + solid.plastic_work()));
    }
    work = solid.plastic_work();
    EXPECT_GT(work, 0.3 * (solid.prescribed_work() + solid.pressure_work()));
  }
  measured::expect_below(70, "energy_residual_over_plastic_work", worst[0] / work, 1e-3);
  EXPECT_LT(worst[1], 0.6 * worst[0]);
}

TEST(yielding_tube, goes_on_from_a_stored_state_with_the_same_bits) {
  const auto tube = [] {
    HyperelasticSolid solid(make_grid(Tube{0.05, 0.003, 0.0, 0.05, 16, 4, 2}),
                            {ductile_steel.density, ductile_steel.law, curved});
    solid.prescribe(solid.nodes_of(low_end_tag), {true, true, true});
    solid.prescribe(solid.nodes_of(high_end_tag), {true, true, true});
    solid.set_prescribed_velocity(1, {0, 0, -8});
    solid.update_forces();
    return solid;
  };
  HyperelasticSolid one = tube();
  const double dt = 0.5 * one.stable_step();
  step(one, dt, 700);
  EXPECT_GT(one.plastic_work(), 0);
  HyperelasticSolid other = tube();
  set_state(other, state_of(one));
  EXPECT_EQ(other.plastic_work(), one.plastic_work());
  EXPECT_EQ(other.stable_step(), one.stable_step());
  step(one, dt, 50);
  step(other, dt, 50);
  EXPECT_TRUE(same_state(state_of(one), other));
  EXPECT_EQ(other.plastic_work(), one.plastic_work());
}

} // namespace
} // namespace platen::fem::yielding_tube_test
