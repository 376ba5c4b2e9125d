// A sphere pressed on a plane by Hertz, with Mindlin's tangential stiffness (no slip): N = 4/3 E* sqrt(R)
// d^1.5, k_n = 2 E* sqrt(R d), k_t = 8 G* sqrt(R d), with 1/E* = (1 - nu^2)/E and 1/G* = (2 - nu)/G summed
// over both sides (Johnson 1985, Contact Mechanics, 4.2.4 and 7.2.3). Valid while the contact radius, sqrt(R
// d), is small against R.
#pragma once

#include <cmath>
#include <limits>

namespace platen::dem {

struct HertzOnPlane {
  struct Side {
    double young_modulus = std::numeric_limits<double>::infinity(); // Pa, > 0; infinite: rigid
    double poisson_ratio = 0;                                       // 1, in (-1, 1/2)
    double normal_compliance() const { return (1 - poisson_ratio * poisson_ratio) / young_modulus; } // 1/Pa
    double tangential_compliance() const { // 1/Pa, (2 - nu)/G
      return (2 - poisson_ratio) * 2 * (1 + poisson_ratio) / young_modulus;
    }
  };
  struct Response {
    double force = 0;     // N
    double stiffness = 0; // N/m, tangent
    double energy = 0;    // J
  };

  double modulus = 0;          // Pa, E*
  double tangential_ratio = 0; // k_t / k_n = 4 G*/E*, whatever the overlap

  static HertzOnPlane between(const Side &sphere, const Side &plane) {
    const double modulus = 1 / (sphere.normal_compliance() + plane.normal_compliance());
    const double shear = 1 / (sphere.tangential_compliance() + plane.tangential_compliance()); // G*
    return {modulus, 4 * shear / modulus};
  }

  // Up to this value of k_n c the indentation is subtracted, see below: the result is then no stiffer than
  // twice the law.
  static constexpr double most_indentation = 0.46;

  // Response to the overlap (m) of a sphere of that radius (m), both > 0. indentation (m/N): c N is the
  // displacement of the plane elsewhere, already part of the approach w of the law; the overlap is the rest,
  // w - c N(w). It is subtracted only up to the force at which k_n c is the value above.
  Response operator()(double overlap, double radius, double indentation = 0) const {
    const double coefficient = 4.0 / 3.0 * modulus * std::sqrt(radius); // N/m^1.5
    if (!(indentation > 0)) return alone(coefficient, overlap);
    const double root = most_indentation / (1.5 * coefficient * indentation);    // of the w at that limit
    const double last = root * root, most = 2.0 / 3.0 * most_indentation * last; // m; c N there
    Response r;
    if (overlap < last - most) {
      r = alone(coefficient, own_approach(coefficient * indentation, overlap));
      r.stiffness /= 1 - r.stiffness * indentation;
      r.energy -= 0.5 * indentation * r.force * r.force;
    } else {
      r = alone(coefficient, overlap + most);
      r.energy -= 0.5 * most * most / indentation;
    }
    return r;
  }

private:
  static Response alone(double coefficient, double w) {
    const double root = std::sqrt(w), force = coefficient * w * root;
    return {force, 1.5 * coefficient * root, 0.4 * force * w};
  }
  // m, the w of w - a w^1.5 = overlap (a in m^-1/2) with 1.5 a sqrt(w) < 1: Newton's method from below, which
  // converges from one side.
  static double own_approach(double a, double overlap) {
    constexpr int most_steps = 40;
    constexpr double enough = 4e-16;
    double w = overlap;
    for (int n = 0; n < most_steps; ++n) {
      const double root = std::sqrt(w), step = (overlap - w + a * w * root) / (1 - 1.5 * a * root);
      w += step;
      if (!(step > enough * w)) break;
    }
    return w;
  }
};

} // namespace platen::dem
