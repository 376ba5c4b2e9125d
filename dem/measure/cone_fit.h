// The circular cone that a piece comes nearest to.
#pragma once

#include <vector>

#include "base/vector3.h"

namespace platen::dem {

// A cone that stands on the plane z = 0 with its apex above.
struct Cone {
  Vector3 apex;           // m
  Vector3 axis{0, 0, -1}; // 1, from the apex towards the base
  double half_angle = 0;  // rad, axis to flank
  // m, to the flank of the unbounded cone, positive outside; of a point beyond the apex too.
  double distance(const Vector3 &point) const;
};

// A sphere of the specimen, z >= 0 from the plane up, and whether it is of the piece.
struct LabelledPoint {
  Vector3 x;         // m
  double weight = 0; // its volume
  bool inside = false;
};

struct ConeFit {
  double thickness = 0; // m, of the horizontal slices
  double grain = 0;     // m, what a flank is rough by
  double width = 0;     // m, radius of a circle as large as the specimen's section
};

// Least squares over slices, by Levenberg and Marquardt from `start` on: of the equivalent radii (width times
// the root of the share of the slice's volume) and of the centres, of piece against cone, both counted over
// the same points. What is past the rim of the specimen is not there for either, so a cone whose base is cut
// off by it is found as the whole one is; so is one without its tip, where points above the cut are left out.
// Crumbs in and out of a flank cancel. Residuals are taken in grains and weighed by Cauchy's
// 1 / (1 + (r/2)^2), so that a few slices of a finger or a notch do not bend the fit. A point within a grain
// of the flank counts by 1 / (1 + exp(2 distance / grain)). Returns the last improvement where it does not
// settle.
Cone fit_cone(const std::vector<LabelledPoint> &points, const Cone &start, const ConeFit &fit);

} // namespace platen::dem
