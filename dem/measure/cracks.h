// Directions of cracks, and planes of broken bonds.
#pragma once

#include <array>
#include <vector>

#include "base/archive.h"
#include "base/vector3.h"
#include "dem/bonds.h"
#include "dem/particles.h"

namespace platen::dem {

// Area of broken bonds by the angle between their normals and the axis z, in nine bins of ten degrees from
// along the axis (cracks across the specimen) to across it (cracks along the specimen).
struct CrackRose {
  static constexpr int bins = 9;
  std::array<double, bins> area{}; // m^2

  // A unit normal, of either sign; m^2.
  void add(const Vector3 &normal, double crack_area);
  // Fraction of the area in a bin over the fraction of all directions in it: 1 everywhere for cracks without
  // a preferred direction. NaN without cracks.
  std::array<double, bins> over_isotropic() const;
};

// Lengths in mean sphere radii.
struct CrackPlaneRules {
  double reach = 2.5; // broken bonds with midpoints this close belong to one crack
  int least_bonds = 30;
  double least_flatness = 0.5;
};

// A cluster of broken bonds, and the plane through it by principal axes.
struct CrackPlane {
  double bonds = 0;
  Vector3 centre, normal; // m, 1; of reference midpoints
  double flatness = 0;    // 1 - scatter across the plane / smaller scatter along it: 1 flat, 0 a ball
  double inclination = 0; // rad, of the plane to the specimen's axis: 0 along the axis, pi/2 across it
  double extent = 0;      // m, sqrt(12) times the larger scatter along the plane: length of a uniform strip
};

// Flat clusters of broken bonds, by single linkage of their reference midpoints; the largest first. Where
// many bonds are broken all of them are connected, and cracks appear as sheets with more broken bonds than
// around them. So a cluster that is not flat is checked again without the bonds around which less than half
// (then 0.6, 0.7, 0.8) of the bonds within `reach` are broken, until its parts are flat or small. Planes that
// cross are one cluster that is not flat, and are not found; a small cluster may be flat by chance.
std::vector<CrackPlane> find_crack_planes(const Particles &particles, const Bonds &bonds,
                                          const CrackPlaneRules &rules = {});

// Summary of all crack planes.
struct CrackPlanes {
  static constexpr double steep = 0.26; // rad: 15 degrees
  double count = 0;
  double broken = 0;           // all broken bonds
  double fraction = 0;         // fraction of them in planes; NaN without broken bonds
  double steep_fraction = 0;   // fraction of them in planes within `steep` of the axis
  double mean_inclination = 0; // rad, weighted by bonds; NaN without planes
  CrackPlane largest;
  void describe(Archive &archive);
};
CrackPlanes sum_up(const std::vector<CrackPlane> &planes, const Bonds &bonds);

} // namespace platen::dem
