// Damage and opening of a specimen: measures that distinguish ends with friction from ends without, and the
// failure of discs and bars.
#pragma once

#include <cmath>
#include <vector>

#include "dem/bonds.h"
#include "dem/packing/specimen.h"
#include "dem/particles.h"

namespace platen::dem {

bool is_broken(int state); // of Bonds::state
// Midpoint of the bond of a record, m.
Vector3 reference_midpoint(const Particles &particles, const Bonds &bonds, std::size_t record);

// Loss of each initial bond: 0 intact, 1 broken; with laws that damage many bonds long before they fail
// (damaged_rows_separate), its damage. For the rows of this rank; Model::bond_losses() returns all losses.
std::vector<double> bond_losses(const Bonds &bonds);

// Mean loss of the initial bonds with their reference midpoint in a region; NaN if the region has no bond.
struct DamageByRegion {
  double end_top = 0, end_bottom = 0; // r < R_c/2 and within R_c/2 of the end plane
  double middle = 0;                  // r < R_c/2 and |z - H/2| < R_c/4
  double worse_end() const { return std::fmax(end_top, end_bottom); } // NaN is ignored
};
DamageByRegion damage_by_region(const Particles &particles, const Bonds &bonds, const Shape &shape,
                                const std::vector<double> &losses);

// Mean outward displacement of the skin (reference r > 0.8 R_c, at least one intact bond) in ten slices of
// equal height from bottom to top, m; NaN for a slice without skin.
std::vector<double> skin_opening(const Particles &particles, const Bonds &bonds, const Shape &shape);
// The same for any displacements (m), over the counted spheres; empty: over all.
std::vector<double> skin_opening(const std::vector<Vector3> &centre, const std::vector<Vector3> &displacement,
                                 const Shape &shape, const std::vector<char> &counted = {});
// Larger of the two end slices over the largest slice.
double end_spread(const std::vector<double> &opening);
// Mean of the two end slices over the mean of the two middle ones.
double barrel(const std::vector<double> &opening);

// Initial and broken bonds of each particle.
struct BondCounts {
  std::vector<int> intact, broken;
};
BondCounts bond_counts(const Particles &particles, const Bonds &bonds);

// Places of broken bonds by reference midpoint, as fractions of broken bonds; NaN without any. The loaded
// diameter is the band |x| < R/4, its middle half |z - R| < R/2.
struct SplitPattern {
  double on_diameter = 0;     // of all broken bonds, in the band
  double in_middle = 0;       // of all broken bonds, in its middle half
  double first_in_middle = 0; // of the first twenty, in its middle half
};
SplitPattern split_pattern(const Particles &particles, const Bonds &bonds, const Shape &shape);

// Fraction of the broken bonds with reference midpoints within half a depth of mid-span; NaN without any.
double broken_near_midspan(const Particles &particles, const Bonds &bonds, double depth);

} // namespace platen::dem
