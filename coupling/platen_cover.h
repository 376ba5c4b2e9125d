// The part of a specimen's end, or side, that its platen covers.
#pragma once

#include <array>

#include "coupling/side.h"
#include "dem/packing/specimen.h"
#include "fem/surface.h"

namespace platen::coupling {

// m, width of a specimen's end or side, along an axis in it.
inline double width_of_end(const dem::Shape &shape, int axis) {
  return shape.kind == dem::ShapeKind::cylinder && axis != 2 ? 2 * shape.radius : length(shape, axis);
}

struct PlatenCover {
  // Fraction of the specimen's end that lies under a face of the platen, no more than `depth` behind the end.
  double facing = 0;
  // Fraction within the rectangle around these faces, gaps between them included.
  double within_reach = 0;
  std::array<double, 2> extent{}; // m, of that rectangle, along the next two axes after that of the side
};

// `plane`: m, of the specimen's end along the axis of the side. The rectangle is extended by `edge` (m) at
// each side, which neighbours may need. Computed on a fine grid of points: fractions to 0.005.
PlatenCover cover_of(const dem::Shape &shape, const fem::SurfaceMesh &surface, Side side, double plane,
                     double depth, double edge = 0);

} // namespace platen::coupling
