// One yielding parallel bond with prescribed motion, for tests of the law. SI units.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/dem/one_bond.h"

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

struct Bond : examples::OneBond<YieldingParallelBond> {
  using State = YieldingParallelBond::State<double>;

  explicit Bond(const YieldingParallelBond::Parameters &p, double friction = 0.35)
      : OneBond(of(p, friction), modulus, length, radius) {}
  // Pa, of closing without yield.
  double elastic() const {
    return geometry.normal_stiffness * (length - root(dot(pose.distance, pose.distance)));
  }
  // Compression, by hand: along the branches of concrete() on closing, elastic on opening, none of a broken
  // one that is apart. Its integral between two places less the trapezoid, J; exact for straight pieces.
  double missed(const State &from, double a, double b) const;
  double stress() const { return normal(); }                                           // Pa
  double closing(double elastic) const { return elastic / geometry.normal_stiffness; } // m, for a stress

private:
  State last_{};
  double was_ = 0;
  void begin_step() override { last_ = state, was_ = elastic(); }
  void end_step() override { kinks_work += missed(last_, was_, elastic()); }
  static YieldingParallelBond of(const YieldingParallelBond::Parameters &p, double friction) {
    YieldingParallelBond law(p);
    law.grain_friction = friction;
    return law;
  }
};

inline double Bond::missed(const State &from, double a, double b) const {
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
