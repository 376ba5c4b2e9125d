// How wide cracks are: opening and slip of broken bonds, what leads through the specimen, and what flows
// there.
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <vector>

#include "base/archive.h"
#include "base/vector3.h"
#include "dem/bonds.h"
#include "dem/laws/bond_layout.h"
#include "dem/packing/specimen.h"
#include "dem/particles.h"

namespace platen::dem {

// A broken bond as a facet that two spheres carry with them: relative motion of its two faces since the
// start. A common rigid motion of both spheres, turns included, opens nothing. Without rotation spheres keep
// their directions, so that this holds for small turns alone.
struct Opening {
  std::size_t record = 0;
  Vector3 place;             // m, reference midpoint of its spheres
  Vector3 normal;            // 1, from the first sphere to the second, turned with both
  Vector3 jump;              // m, of the second face against the first
  double opening = 0;        // m, along the normal; negative: pressed together
  double slip = 0;           // m, across it
  bool second_moves = false; // the second sphere is farther from where it began than the first one
};
Opening opening_of(const Particles &particles, const Bonds &bonds, std::size_t record);
std::vector<Opening> openings(const Particles &particles, const Bonds &bonds); // of all broken bonds

// Largest opening and slip of each initial bond so far, m; 0 while it is whole. Not finite once one was not.
class LargestOpenings {
public:
  void follow(const Particles &particles, const Bonds &bonds);
  double opening(const Opening &now) const; // m, with that of now
  double slip(const Opening &now) const;
  void describe(Archive &archive);

private:
  std::vector<double> opening_, slip_; // m, of each record
};

// m^2 that a facet stands for over the section of its bond: one factor, with which sum A l of the bonds in
// the specimen is three times its volume; of the spheres farther than a mean diameter from the walls, which
// have bonds on all sides, if there are any, and without a notch. The facets that a plane cuts, projected
// onto it, then have its area: exactly on a cubic lattice, on the mean in a packing that is alike in all
// directions.
double area_factor(const Particles &particles, const Bonds &bonds, const BondLayout &layout,
                   const Shape &shape);

// Widths that concrete structures are designed for, m.
constexpr std::array<double, 3> crack_width_limits{50e-6, 100e-6, 200e-6};

// What the openings of a specimen are together. Cracks are joined where midpoints of facets lie within 2.5
// mean radii, as for find_crack_planes, and lead through along an axis if they come as near to both of its
// ends.
struct CrackWidths {
  static constexpr double none = std::numeric_limits<double>::quiet_NaN();
  double open = 0;               // facets that are open
  double largest = none;         // m
  double mean = none;            // m, of open facets by area
  std::array<double, 3> wider{}; // share of the area of all facets that is wider than crack_width_limits
  double volume = 0;             // m^3, of all open facets
  // Along x, y, z, NaN along an axis that does not cross the specimen from one flat face to the other: widest
  // limit (m) of which the cracks that are at least as wide still lead through; m^2, permeability by the
  // cubic law, sum A w^3 (1 - n^2)/(12 V) over facets that lead through (Snow 1969), 0 without any.
  std::array<double, 3> through{none, none, none}, permeability{none, none, none};
};
// `roughness`: what a rough crack lets through over one with smooth walls, 0 ... 1.
CrackWidths crack_widths(const std::vector<Opening> &openings, const Particles &particles, const Bonds &bonds,
                         const BondLayout &layout, const Shape &shape, double roughness = 1);

} // namespace platen::dem
