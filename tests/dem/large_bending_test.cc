// Chains of beams that a damped explicit run bends far, against the elastica.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/dem/examples.h"

namespace platen::dem::large_bending_test {
namespace {

using namespace examples;

constexpr double young = 40e9, slender = .3;
// Bending stiffness of the beams, N m^2.
const double ei = young * pi * std::pow(slender * radius, 4) / 4;

// A chain along x, clamped at its first sphere.
class Chain {
public:
  explicit Chain(int beams) : model(row(beams, {1, 0, 0}), settings()), beams_(beams) {
    const std::size_t clamp = row_of(model.particles, 0);
    model.particles.mass[clamp] = (*model.particles.inertia)[clamp] = 1e30; // kg, kg m^2: does not move
  }
  // Until damping has left some 1e-9 of the oscillations, whose period grows as the square of the length.
  void bend(const Vector3 &force, const Vector3 &torque) {
    const std::size_t tip = row_of(model.particles, beams_);
    const double dt = .5 * model.stable_step({}, 0).limit;
    const auto load = [&](Particles &p) {
      p.force[tip] += force;
      (*p.torque)[tip] += torque;
    };
    for (int s = 0; s < 800 * beams_ * beams_; ++s)
      step(model, dt, load);
  }
  const Vector3 &at(int k) const { return model.particles.position[row_of(model.particles, k)]; }
  Model model;

private:
  static ModelSettings settings() {
    ModelSettings s = bonded_by_beams(young, .2, slender);
    s.local_damping = .5;
    return s;
  }
  int beams_;
};

// Tip of an inextensible cantilever along x of length l under a load across, along z: EI theta'' =
// -p cos(theta), theta(0) = 0, theta'(l) = 0, by shooting with the root curvature and Runge-Kutta steps.
Vector3 elastica(double l, double p) {
  constexpr int steps = 4000;
  const double h = l / steps;
  struct State {
    double theta, curvature, x, z;
  };
  const auto slope = [&](const State &s) {
    return State{s.curvature, -p * std::cos(s.theta) / ei, std::cos(s.theta), std::sin(s.theta)};
  };
  const auto at = [](const State &s, const State &d, double by) {
    return State{s.theta + by * d.theta, s.curvature + by * d.curvature, s.x + by * d.x, s.z + by * d.z};
  };
  const auto end = [&](double curvature) {
    State s{0, curvature, 0, 0};
    for (int k = 0; k < steps; ++k) {
      const State a = slope(s), b = slope(at(s, a, .5 * h)), c = slope(at(s, b, .5 * h)),
                  d = slope(at(s, c, h));
      s = at(at(at(at(s, a, h / 6), b, h / 3), c, h / 3), d, h / 6);
    }
    return s;
  };
  double low = 0, high = p * l / ei;
  for (int k = 0; k < 60; ++k) {
    const double middle = .5 * (low + high);
    (end(middle).curvature > 0 ? high : low) = middle;
  }
  const State tip = end(.5 * (low + high));
  return {tip.x, 0, tip.z};
}

double error_of_the_tip(int beams, double load) {
  const double l = 2 * radius * beams, p = load * ei / (l * l);
  Chain chain(beams);
  chain.bend({0, 0, p}, {});
  return norm(chain.at(beams) - elastica(l, p)) / l;
}

// At P l^2/EI = 3 the tip has gone .60 of the length across (Bisshopp and Drucker 1945). Beams that turn
// against each other by some hundredths of a radian are 1e-4 too soft, the square of the angle over 6.
TEST(large_bending, a_cantilever_bends_as_the_elastica) {
  const double l = 80 * radius;
  EXPECT_NEAR(elastica(l, 3 * ei / (l * l)).z / l, .6033, 1e-3);
  for (const double load : {1.0, 3.0, 10.0}) {
    const double coarse = error_of_the_tip(5, load), fine = error_of_the_tip(24, load);
    EXPECT_LT(fine, 1e-3) << load;
    EXPECT_LT(fine, .1 * coarse) << load; // second order: a twentieth
  }
}

} // namespace
} // namespace platen::dem::large_bending_test
