// One yielding parallel bond with prescribed motion, for tests of the law. SI units.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/pi.h"
#include "base/vector3.h"
#include "dem/laws/yielding_parallel_bond.h"

namespace platen::dem::one_yielding_bond {

constexpr double modulus = 48e9, length = 3e-3, radius = 1.4e-3; // Pa, m, m

inline YieldingParallelBond::Parameters concrete() {
  YieldingParallelBond::Parameters p;
  p.stiffness_ratio = 0.25;
  p.tensile_strength = 9e6;
  p.shear_strength = 36e6;
  p.friction_angle = std::atan(0.5);
  p.moment_contribution = 0.22;
  p.compression_limits = {60e6, 110e6, 160e6};
  p.compression_slopes = {3, 12, 22};
  return p;
}

// Two spheres along z that are placed and turned by hand; the first stays where it is.
struct Bond {
  YieldingParallelBond law;
  InterfaceGeometry<double> geometry{length,         0.5,   modulus / length, pi *radius *radius, 1.0,
                                     {0, 0, length}, radius};
  YieldingParallelBond::State<double> state{};
  InterfaceMotion<double> pose{{0, 0, length}, {}, {}, 0, {1, 0, 0, 0}, {1, 0, 0, 0}, {}, {}};
  InterfaceResponse<double> now{};
  double work = 0;       // J, by the trapezoid over each step
  double kinks_work = 0; // J, what the trapezoid misses of the normal force where a step crosses its kinks

  explicit Bond(const YieldingParallelBond::Parameters &p, double friction = 0.35) : law(p) {
    law.grain_friction = friction;
    now = law(state, geometry, pose);
  }
  // The second sphere moves by this and both turn by these (rad, small), in so many steps.
  void move(const Triple<double> &by, const Triple<double> &turn_i = {}, const Triple<double> &turn_j = {},
            int steps = 1) {
    const auto share = [&](const Triple<double> &v) { return scale(1.0 / steps, v); };
    for (int k = 0; k < steps; ++k) {
      const InterfaceResponse<double> before = now;
      const YieldingParallelBond::State<double> last = state;
      const double was = elastic();
      pose.travelled = share(by), pose.turned_i = share(turn_i), pose.turned_j = share(turn_j);
      pose.distance = pose.distance + pose.travelled;
      pose.turn_i = turned_by(pose.turn_i, pose.turned_i);
      pose.turn_j = turned_by(pose.turn_j, pose.turned_j);
      const Triple<double> arms =
          scale(geometry.lever, pose.turned_i) + scale(1 - geometry.lever, pose.turned_j);
      pose.moved = pose.travelled + cross(pose.distance - scale(0.5, pose.travelled), arms);
      pose.spun_along = 0.5 * dot(pose.turned_i + pose.turned_j, pose.distance);
      now = law(state, geometry, pose);
      work += 0.5 * (dot(before.force + now.force, pose.travelled) -
                     dot(before.torque_i + now.torque_i, pose.turned_i) -
                     dot(before.torque_j + now.torque_j, pose.turned_j));
      kinks_work += missed(last, was, elastic());
    }
  }
  static Rotation<double> turned_by(const Rotation<double> &q, const Triple<double> &angle) {
    const Quaternion to = rotation_quaternion({angle.x, angle.y, angle.z}) * Quaternion{q.w, q.x, q.y, q.z};
    return {to.w, to.x, to.y, to.z};
  }
  // Pa, of closing without yield.
  double elastic() const {
    return geometry.normal_stiffness * (length - root(dot(pose.distance, pose.distance)));
  }
  // Compression, by hand: along the branches of concrete() on closing, elastic on opening, none of a broken
  // one that is apart. Its integral between two places less the trapezoid, J; exact for straight pieces.
  double missed(const YieldingParallelBond::State<double> &from, double a, double b) const;
  double stress() const { return now.normal / geometry.area; } // Pa
  double shear() const { return root(dot(now.shear, now.shear)) / geometry.area; }
  double plastic() const { return law.plastic_work(state, geometry); }
  double balance() const { return now.energy + plastic() + state.dissipated; }
  double closing(double elastic) const { return elastic / geometry.normal_stiffness; } // m, for a stress
};

inline double Bond::missed(const YieldingParallelBond::State<double> &from, double a, double b) const {
  constexpr double limits[] = {60e6, 110e6, 160e6}, slopes[] = {3, 12, 22};
  const double begins[] = {60e6, 60e6 + 3 * 50e6, 60e6 + 3 * 50e6 + 12 * 50e6};
  const auto branches = [&](double e) {
    if (e <= begins[0]) return e;
    const int k = e > begins[2] ? 2 : e > begins[1] ? 1 : 0;
    return limits[k] + (e - begins[k]) / slopes[k];
  };
  const auto compression = [&](double e) {
    double stress = e - from.plastic;
    if (b > a) stress = std::min(stress, branches(e));
    return from.broken > 0 ? std::max(stress, 0.0) : stress;
  };
  std::vector<double> at{a, b, begins[0], begins[1], begins[2], from.plastic};
  double yields = begins[2] + (from.plastic - (begins[2] - limits[2])) / (1 - 1 / slopes[2]);
  for (const int k : {1, 0})
    if (from.plastic < begins[k + 1] - limits[k + 1])
      yields = begins[k] + (from.plastic - (begins[k] - limits[k])) / (1 - 1 / slopes[k]);
  at.push_back(yields); // where what has yielded so far goes on to
  std::sort(at.begin(), at.end());
  if (b < a) std::reverse(at.begin(), at.end());
  double sum = 0, last = a;
  for (const double e : at) {
    if ((e - a) * (e - b) > 0) continue; // outside
    sum += 0.5 * (compression(last) + compression(e)) * (e - last);
    last = e;
  }
  sum -= 0.5 * (compression(a) + compression(b)) * (b - a);
  return geometry.area / geometry.normal_stiffness * sum;
}

} // namespace platen::dem::one_yielding_bond
