// Cells of nearly equal size on the sphere of directions, to test whether contacts prefer any.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "base/vector3.h"

namespace platen::dem {

// The 320 faces of a twice-subdivided icosahedron. They are not equal (solid angles differ by a factor
// 1.275), so each cell has a weight.
class DirectionCells {
public:
  static constexpr std::size_t count = 320;
  DirectionCells();
  // The cell that contains a direction (of any length except zero).
  std::size_t cell_of(const Vector3 &direction) const;
  // Solid angle over 4 pi; the weights add up to 1.
  double weight(std::size_t cell) const { return weight_[cell]; }
  const Vector3 &middle(std::size_t cell) const { return middle_[cell]; } // unit vector
  // The cell on the other side of the sphere.
  std::size_t opposite(std::size_t cell) const { return opposite_[cell]; }

private:
  struct Triangle {
    Vector3 corner[3];
  };
  static void split(const Triangle &parent, Triangle child[4]);
  std::array<Triangle, 20> face_;
  std::array<double, count> weight_;
  std::array<Vector3, count> middle_;
  std::array<std::size_t, count> opposite_;
};

// A cell and its opposite combined, for axes (contact normals), whose sign has no meaning.
struct AxisCell {
  Vector3 middle;       // unit vector, upward
  double weight = 0;    // solid angle of the two over 4 pi; the weights of all 160 add up to 1
  std::size_t axes = 0; // number of axes in it
};
std::vector<AxisCell> count_axes(const std::vector<Vector3> &axes); // any lengths except zero

// Deviation of counted axes from isotropy: chi^2 = n sum (f - w)^2 / w / 159 with f the fraction of the n
// axes in a merged cell and w its weight. Expect 1 with a standard deviation of .11 for independent axes; 0
// without axes. (The published measure sum (f - w)^2 / 320 is below any bound set on it, for every packing.)
double isotropy_chi_squared(const std::vector<AxisCell> &cells);

} // namespace platen::dem
