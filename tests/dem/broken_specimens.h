// Specimens that are cut and crushed by hand, and their motions after the peak, for the measures of how they
// have failed.
#pragma once

#include <cmath>
#include <functional>
#include <vector>

#include "dem/bonds.h"
#include "dem/measure/dead_zone.h"
#include "dem/measure/failure_pattern.h"
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

// A displacement by place. Places in `radius`, displacements in units of about what the skin opens by; the
// bottom platen stands, the top one comes down by `closing`.
using Field = std::function<Vector3(const Vector3 &)>;
constexpr double closing = 0.3;
const Vector3 of_bottom{}, of_top{0, 0, -closing}, half_way{0, 0, -0.5 * closing};

inline Vector3 outwards(const Vector3 &x) {
  const double r = std::hypot(x.x, x.y);
  return r > 0 ? Vector3{x.x / r, x.y / r, 0} : Vector3{};
}

inline MotionAfterPeak motion_of(const Specimen &specimen, const Field &field, const Vector3 &top = of_top) {
  constexpr double opening = 0.1 * radius; // m
  MotionAfterPeak m;
  for (const Vector3 &x : specimen.centre)
    m.displacement.push_back(opening * field(x / radius));
  m.platens[top_end].displacement = opening * top;
  return m;
}

// Two planes that cross in the middle at this angle to the axis (rad), `thick` wide: the parts below (1) and
// above (2) go with the platens, those beside them (3, 4) give way along x.
inline int part_of_cross(const Vector3 &x, double angle, double thick) {
  const double z = x.z - Cylinder::length / 2,
               beside = std::abs(x.x) * std::cos(angle) - std::abs(z) * std::sin(angle);
  if (std::abs(beside) < thick / 2) return Cylinder::crumbs;
  return beside < 0 ? (z < 0 ? 1 : 2) : (x.x < 0 ? 3 : 4);
}
inline Field crossing_planes(double angle, double thick) {
  return [=](const Vector3 &x) {
    const int part = part_of_cross(x, angle, thick);
    return part == 1 ? of_bottom : part == 2 ? of_top : Vector3{x.x < 0 ? -1. : 1., 0, 0} + half_way;
  };
}

} // namespace platen::dem::examples
