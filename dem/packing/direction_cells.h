// Cells of nearly equal size on the sphere of directions, to tell whether contacts prefer any.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "dem/vector3.h"

namespace platen::dem {

// The 320 faces of a twice-subdivided icosahedron. They are not equal (solid angles differ by a
// factor 1.275), so each cell carries its weight.
class DirectionCells {
public:
  static constexpr std::size_t count = 320;
  DirectionCells();
  // The cell that a direction (any length but zero) points into.
  std::size_t cell_of(const Vector3 &direction) const;
  // Solid angle over 4 pi; the weights add up to 1.
  double weight(std::size_t cell) const { return weight_[cell]; }
  // The cell on the other side of the sphere.
  std::size_t opposite(std::size_t cell) const { return opposite_[cell]; }

private:
  struct Triangle {
    Vector3 corner[3];
  };
  static void split(const Triangle &parent, Triangle child[4]);
  std::array<Triangle, 20> face_;
  std::array<double, count> weight_;
  std::array<std::size_t, count> opposite_;
};

// How far a set of axes (contact normals, sign without meaning) is from isotropy: opposite cells are merged
// into 160, chi^2 = n sum (f - w)^2 / w / 159 with f the part of the n axes in a merged cell and w its
// weight. Expect 1 with a standard deviation of .11 for independent axes; 0 for none. (The measure sum (f -
// w)^2 / 320 that is found in print is below any bound set on it whatever the packing.)
double isotropy_chi_squared(const std::vector<Vector3> &axes);

} // namespace platen::dem
