#include "apps/bonds/closed_forms.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "apps/bonds/pair_section.h"
#include "base/pi.h"

namespace platen::apps {

double pair_stiffness(const BondSection &bond, PairPath path) {
  if (path == PairPath::shear) return bond.shear_stiffness();
  if (path == PairPath::bending) return bond.bending_stiffness();
  if (path == PairPath::twisting) return bond.twisting_stiffness();
  return bond.axial_stiffness();
}

double pair_strength(const BondSection &bond, PairPath path) {
  const double tension = bond.tensile_strength * bond.area(), shear = bond.shear_strength * bond.area();
  if (path == PairPath::shear && bond.beam) // spheres held upright bend a beam: at each end P l / 2
    return std::min(shear, tension * bond.bond_radius / (2 * bond.moment_contribution * bond.length()));
  if (path == PairPath::shear) return shear;
  if (path == PairPath::bending) // sigma_c I / (beta R_b)
    return tension * bond.bond_radius / (4 * bond.moment_contribution);
  if (path == PairPath::twisting) // tau_c J / (beta R_b)
    return shear * bond.bond_radius / (2 * bond.moment_contribution);
  return path == PairPath::compression ? std::numeric_limits<double>::infinity() : tension;
}

// Base sphere at (R, 0), top sphere at (0, sqrt(3) R); the base sphere moves out by u and rolls outwards by
// theta = t / R, the top one moves down by w = 1. Inclined bond: stretch u/2 - sqrt(3)/2, slip
// sqrt(3)/2 u + 1/2 + t, relative rotation theta; the base bond stretches by 2u and bends by 2 theta, half of
// it for each half.
PyramidResponse pyramid_response(const Pyramid &pyramid) {
  const BondSection &b = pyramid.bond;
  const double root3 = std::sqrt(3.0);
  const double k = b.shear_ratio();
  const double bending = b.bending_stiffness() / (b.axial_stiffness() * b.sphere_radius * b.sphere_radius);
  // Energy / (k_n A) = 1/2 (u a11 u + 2 u a12 t + t a22 t) + f1 u + f2 t + 1/2 c.
  double a11 = .25 + .75 * k, a12 = root3 / 2 * k, a22 = k + bending;
  const double f1 = -root3 / 4 + root3 / 4 * k, f2 = k / 2, c = .75 + .25 * k;
  if (pyramid.base_bond) a11 += 2, a22 += 2 * bending;
  double u = 0, t = 0;
  if (pyramid.plate == PairPlate::frictionless && pyramid.rotation) {
    const double determinant = a11 * a22 - a12 * a12;
    u = (-f1 * a22 + f2 * a12) / determinant;
    t = (-f2 * a11 + f1 * a12) / determinant;
  } else if (pyramid.plate == PairPlate::frictionless) {
    u = -f1 / a11;
  } else if (pyramid.plate == PairPlate::rolling) { // t = u
    u = t = -(f1 + f2) / (a11 + 2 * a12 + a22);
  } // sticking: neither moves nor turns
  const double energy = .5 * (a11 * u * u + 2 * a12 * u * t + a22 * t * t) + f1 * u + f2 * t + .5 * c;
  return {2 * 2 * energy * b.axial_stiffness(), root3 * u}; // two halves; F = 2 E / w
}

} // namespace platen::apps
