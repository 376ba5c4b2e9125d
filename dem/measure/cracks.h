// Which directions cracks face, and where broken bonds lie in one plane.
#pragma once

#include <array>
#include <vector>

#include "base/archive.h"
#include "base/vector3.h"
#include "dem/bonds.h"
#include "dem/particles.h"

namespace platen::dem {

// Area of broken bonds by the angle of their normals to the axis z, in nine bins of ten degrees from along it
// (cracks across the specimen) to across it (cracks along the specimen).
struct CrackRose {
  static constexpr int bins = 9;
  std::array<double, bins> area{}; // m^2

  // A unit normal, of either sense; m^2.
  void add(const Vector3 &normal, double crack_area);
  // Share of the area over the bin's share of all directions: 1 everywhere where cracks face all directions
  // alike. NaN without cracks.
  std::array<double, bins> over_isotropic() const;
};

// Lengths in mean sphere radii.
struct CrackPlaneRules {
  double reach = 2.5; // broken bonds with midpoints this close are of one crack
  int least_bonds = 30;
  double least_flatness = 0.5;
};

// Broken bonds that lie together, and the plane through them by principal axes.
struct CrackPlane {
  double bonds = 0;
  Vector3 centre, normal; // m, 1; of reference midpoints
  double flatness = 0;    // 1 less scatter across the plane over the smaller one along it: 1 flat, 0 a ball
  double inclination = 0; // rad, of the plane to the specimen's axis: 0 splits it along, pi/2 cuts it across
  double extent = 0;      // m, sqrt(12) times the larger scatter along the plane: length of an even strip
};

// Clusters of broken bonds by single linkage of their reference midpoints, of those that are flat; the
// largest first. Where much is broken all of it hangs together, and cracks show as sheets in which more is
// broken than beside them. So a cluster that is not flat is checked again without the bonds around which
// less than half (then 0.6, 0.7, 0.8) of the bonds within `reach` are broken, until its parts are flat or
// small. Planes that cross are one cluster that is not flat, and are not found; a small cluster may look flat
// by chance.
std::vector<CrackPlane> find_crack_planes(const Particles &particles, const Bonds &bonds,
                                          const CrackPlaneRules &rules = {});

// All of them in a few numbers.
struct CrackPlanes {
  static constexpr double steep = 0.26; // rad: 15 degrees
  double count = 0;
  double broken = 0;           // all broken bonds
  double share = 0;            // of them, in planes; NaN where none is broken
  double steep_share = 0;      // of them, in planes within `steep` of the axis
  double mean_inclination = 0; // rad, weighed by bonds; NaN without planes
  CrackPlane largest;
  void describe(Archive &archive);
};
CrackPlanes sum_up(const std::vector<CrackPlane> &planes, const Bonds &bonds);

} // namespace platen::dem
