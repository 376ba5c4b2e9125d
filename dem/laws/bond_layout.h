// Which pairs of a packing are bonded, and the stiffness and radius of their bonds.
#pragma once

#include <limits>

#include "base/describe.h"

namespace platen::dem {

enum class RadiusRule { minimum, mean, harmonic, given };

// A length, absolute or as a multiple of the smaller radius of a pair.
struct Gap {
  bool relative = true;
  double value = 0.05; // of the smaller radius, or m
  double length(double smaller_radius) const { return relative ? value * smaller_radius : value; } // m
};

// How bonds are created between the spheres of a packing.
struct BondLayout {
  double modulus = std::numeric_limits<double>::quiet_NaN(); // G_b, Pa
  double radius_multiplier = 1;                              // lambda
  RadiusRule radius_rule = RadiusRule::minimum;
  double radius = std::numeric_limits<double>::quiet_NaN(); // m, for RadiusRule::given
  Gap gap;                                                  // largest distance of the surfaces of a pair
  bool by_range = false; // instead of the gap: | |d|/(R_i + R_j) - 1 | <= interaction_range
  double interaction_range = 0.1;
  // Factor on the bond area besides lambda^2. 0: Model sets 40 P / N_c of the specimen (Onate et al. 2015).
  double area_factor = 1;

  static constexpr const char *name = "BondLayout";
  template <class Visitor, class Self>
  static void describe(Visitor &&v, Self &p);

  double bond_radius(double ri, double rj) const;                                     // R_b, m
  double normal_stiffness(double ri, double rj) const { return modulus / (ri + rj); } // k_n, Pa/m (T-24)
  // k_n A of a pair, whether it is bonded or not; N/m.
  double axial_stiffness(double ri, double rj) const;
  double reach(double ri, double rj) const;           // largest gap of a bonded pair, m
  double largest_overlap(double ri, double rj) const; // of a bonded pair, m
};

template <class Visitor, class Self>
void BondLayout::describe(Visitor &&v, Self &p) {
  v("modulus", p.modulus, "Pa", above(0), "Young modulus of the bond.");
  v("radius_multiplier", p.radius_multiplier, "1", above_up_to(0, 10),
    "Bond radius over the radius that the rule gives.");
  v("radius_rule", p.radius_rule,
    Words<RadiusRule>{{"minimum", RadiusRule::minimum},
                      {"mean", RadiusRule::mean},
                      {"harmonic", RadiusRule::harmonic},
                      {"given", RadiusRule::given}},
    "Bond radius from the radii of the pair, or given.");
  v("radius", p.radius, "m", above(0), "Bond radius.");
  v("gap", p.gap,
    "Pairs with at most this distance between their surfaces are bonded; R_min is the smaller radius.");
  v("interaction_range", p.interaction_range, "1", between(0, 1),
    "Pairs whose distance differs from the sum of their radii by at most this share of it are bonded, "
    "instead "
    "of by their gap.");
  v("area_factor", p.area_factor, "1", between(0, 10),
    "Alpha, on the area of the bond; 0: 40 times porosity over mean number of bonds of a sphere.");
}

} // namespace platen::dem
