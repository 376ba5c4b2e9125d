// Specimens that are cut and crushed by hand, for the measures of how they have failed.
#pragma once

#include <functional>
#include <vector>

#include "dem/bonds.h"
#include "dem/packing/specimen.h"
#include "dem/particles.h"
#include "tests/dem/examples.h"

namespace platen::dem::examples {

// A cylinder along z, packed and bonded anew with the same spheres each time.
struct Cylinder {
  static constexpr double width = 21, length = 76; // radius and height of the specimen, in `radius`
  Shape shape;
  Particles particles;
  Bonds bonds;
  explicit Cylinder(const BondParameters &of_bonds = *bonded().bond);
  // Breaks bonds between spheres with different labels, and all of spheres labelled `crumbs`.
  static constexpr int crumbs = -1;
  void cut(const std::function<int(const Vector3 &centre)> &label);
  // The same by row.
  void cut_rows(const std::function<int(std::size_t row)> &label);
  double height() const { return shape.height; }
};

} // namespace platen::dem::examples
