// Fields on a regular grid from what spheres carry.
#pragma once

#include <array>
#include <vector>

#include "base/vector3.h"

namespace platen::dem {

struct RegularGrid {
  Vector3 origin;                    // m, the first node
  double spacing = 0;                // m
  std::array<int, 3> nodes{1, 1, 1}; // along x, y, z; x runs fastest

  std::size_t size() const { return static_cast<std::size_t>(nodes[0]) * nodes[1] * nodes[2]; }
  Vector3 place(std::size_t node) const;
};

// One row a sphere; columns that are empty give no field.
struct SphereColumns {
  std::vector<Vector3> position;             // m
  std::vector<double> radius;                // m
  std::vector<std::array<double, 9>> stress; // Pa, row by row
  std::vector<Vector3> displacement;         // m
  std::vector<double> damage;                // 1
};

// One entry a node; not a number where no sphere reaches.
struct CoarseFields {
  std::vector<double> solid_share; // 1, sum of V W: about the packing fraction within, half of it at
                                   // a flat surface, 0 where no sphere reaches
  std::vector<std::array<double, 9>> stress; // Pa
  std::vector<double> damage;                // 1
  std::vector<Vector3> displacement;         // m
  std::vector<std::array<double, 9>> strain; // 1, symmetric, tension positive
};

// Kernel of Wendland (1995), C2, in three dimensions: 21 / (2 pi h^3) (1 - r/h)^4 (1 + 4 r/h) for r < h, else
// 0; 1/m^3. Its integral over space is 1.
double wendland(double distance, double reach);

// Each sphere counts at a node by its volume V times the kernel W of their distance, which ends at `reach`
// (m; three or four mean radii smooth over the spheres). Stress and damage are means with these weights
// (Shepard 1968): they keep constants, never leave the range of what they average, and weighed by the solid
// share they have the spheres' integral. Displacement and its gradient are those of the linear field that
// comes nearest to the spheres' by the same weights (moving least squares, Lancaster and Salkauskas 1981):
// linear fields come out as they are, up to the skin. Strain is the gradient's symmetric part, of small
// displacements; not a number where the spheres in reach lie in a plane.
CoarseFields coarse_grain(const SphereColumns &spheres, const RegularGrid &grid, double reach);

} // namespace platen::dem
