// A packed specimen before it is bonded: sphere centres and radii inside a shape. SI units, axis along z.
#pragma once

#include <cstddef>
#include <vector>

#include "dem/vector3.h"

namespace platen::dem {

enum class ShapeKind { cylinder, box };

// A cylinder of radius r and height h on 0 <= z <= h, axis x = y = 0; or a box [-lx/2, lx/2] x [-ly/2, ly/2] x
// [0, h]. (A bar is a box or cylinder that is long along z.)
struct Shape {
  ShapeKind kind = ShapeKind::cylinder;
  double radius = 0;             // m, cylinder
  double width_x = 0, width_y = 0; // m, box
  double height = 0;             // m

  double cross_section() const { // m^2
    return kind == ShapeKind::cylinder ? 3.14159265358979323846 * radius * radius : width_x * width_y;
  }
  double volume() const { return cross_section() * height; } // m^3
};

struct Specimen {
  Shape shape;
  std::vector<Vector3> centre; // m
  std::vector<double> radius;  // m

  std::size_t size() const { return centre.size(); }
};

} // namespace platen::dem
