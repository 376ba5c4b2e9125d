// A grid from elsewhere as a platen: laid against the specimen, its ends found.
#pragma once

#include "fem/grids.h"

namespace platen::fem {

// The grid shifted along z so that its extreme plane on the specimen's side, the highest of a platen that
// faces up and the lowest of one that faces down, lies at z = `plane` (m); x and y stay. Tags are made anew:
// faces in the plane of the other end, where the machine holds it, and on the specimen's side those in the
// extreme plane; where none lies there (a convex platen), all whose normals are within 60 degrees of the
// axis. As low_end_tag and high_end_tag; every other face gets mantle_tag. Throws std::invalid_argument where
// no face lies in the plane of the machine's end.
Grid laid_platen(const Grid &grid, bool faces_up, double plane);

// Materials are counted from 0; how many a grid has.
int materials_of(const Grid &grid);

} // namespace platen::fem
