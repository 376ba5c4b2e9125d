// How the two end faces of a specimen meet flat platens. SI units.
#pragma once

#include <vector>

#include "dem/packing/specimen.h"

namespace platen::dem {

enum class EndPreparation {
  as_packed, // nothing is done: a platen meets spheres where they are
  ground     // as if sawn flush: every sphere near an end is met at once, each from its own zero gap
};

// Spheres seated on one end plane, in order of their number.
struct EndSeats {
  std::vector<int> particle;
  std::vector<double>
      offset; // m, gap at rest between the sphere's surface and the end plane; may be a little < 0
};

struct SpecimenEnds {
  EndSeats bottom, top; // at z = 0 and z = height of the shape
};

// The seats of both ends. Ground: all spheres whose surface lies within end_layer mean radii of the plane, z
// - R for the bottom, height - z - R for the top; the layer decides how many spheres carry the platen, and
// below about one mean radius the few that remain are crushed (docs/theory.md). As packed: none. A sphere may
// be seated on both ends. Throws std::invalid_argument unless end_layer is finite and not negative.
SpecimenEnds seat_ends(const Specimen &specimen, EndPreparation preparation, double end_layer);

} // namespace platen::dem
