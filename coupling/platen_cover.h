// What of a specimen's end, or side, its platen covers.
#pragma once

#include <array>

#include "coupling/side.h"
#include "dem/packing/specimen.h"
#include "fem/surface.h"

namespace platen::coupling {

// m, of a specimen across its end or side, along an axis in it.
inline double width_of_end(const dem::Shape &shape, int axis) {
  return shape.kind == dem::ShapeKind::cylinder && axis != 2 ? 2 * shape.radius : length(shape, axis);
}

struct PlatenCover {
  // Share of the specimen's end that lies under a face of the platen, no more than `depth` behind the end.
  double facing = 0;
  // Share within the rectangle around these faces: without what gaps between them leave.
  double within_reach = 0;
  std::array<double, 2> extent{}; // m, of that rectangle, along the next two axes after that of the side
};

// `plane`: m, of the specimen's end along the axis of the side. The rectangle is taken wider by `edge` (m) at
// each side, which neighbours may need. Found at points of a fine grid: shares to half a hundredth.
PlatenCover cover_of(const dem::Shape &shape, const fem::SurfaceMesh &surface, Side side, double plane,
                     double depth, double edge = 0);

} // namespace platen::coupling
