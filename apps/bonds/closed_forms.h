// What two and three bonded spheres of equal radius do under load, by hand: what platen-bonds compares with.
#pragma once

#include "apps/bonds/pair_section.h"
#include "base/pi.h"

namespace platen::apps {

// A bond between two touching spheres. SI units.
struct BondSection {
  double sphere_radius = 0;                        // R, m
  double bond_radius = 0;                          // R_b, m
  double modulus = 0;                              // G_b, Pa
  double stiffness_ratio = 0;                      // of a parallel bond
  bool beam = false;                               // from centre to centre; with
  double poisson_ratio = 0;                        // its own
  double tensile_strength = 0, shear_strength = 0; // Pa; infinite where the bond never breaks
  double moment_contribution = 1;

  double length() const { return 2 * sphere_radius; }                    // m
  double area() const { return pi * bond_radius * bond_radius; }         // m^2
  double axial_stiffness() const { return modulus * area() / length(); } // k_n A, N/m
  double shear_ratio() const { // K_s / (k_n A); of a beam 12 I / (A l^2)
    return beam ? 3 * bond_radius * bond_radius / (length() * length()) : stiffness_ratio;
  }
  double shear_stiffness() const { return shear_ratio() * axial_stiffness(); }
  double bending_stiffness() const { // k_n I, N m; I = A R_b^2 / 4
    return modulus / length() * area() * bond_radius * bond_radius / 4;
  }
  double twisting_stiffness() const { // k_s J, N m; of a beam G I_o / l; J = A R_b^2 / 2
    if (beam) return bending_stiffness() / (1 + poisson_ratio);
    return stiffness_ratio * modulus / length() * area() * bond_radius * bond_radius / 2;
  }
};

// Two spheres, the first held. Stiffness of the path (N/m; N m for bending and twisting).
double pair_stiffness(const BondSection &bond, PairPath path);
// Load at which the bond breaks: N, or N m for bending and twisting; infinite where it does not.
double pair_strength(const BondSection &bond, PairPath path);

// Three spheres, two on a plate and one on top of them, all touching; small displacements, no contact forces.
struct Pyramid {
  BondSection bond;
  PairPlate plate = PairPlate::frictionless;
  bool base_bond = true; // between the two on the plate
  bool rotation = true;
};
struct PyramidResponse {
  double stiffness = 0;    // N/m, load on the top sphere over its path down
  double strain_ratio = 0; // sqrt(3) u / w: lateral strain of the base over the vertical strain
};
// Minimum of the elastic energy of the three bonds over the spread u of each base sphere and its rotation,
// for the top sphere pressed down by w (Tannu 2017's arrangement; the strain ratio falls as k_s / k_n grows).
PyramidResponse pyramid_response(const Pyramid &pyramid);

} // namespace platen::apps
