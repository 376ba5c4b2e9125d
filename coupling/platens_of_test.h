// The platens of a test: grids from the specimen and the settings, rigid or elastic, and their contacts.
#pragma once

#include "coupling/platen_test.h"

namespace platen::coupling {

struct PlatenOfTest {
  std::unique_ptr<Platen> platen;
  const ElasticPlaten *elastic = nullptr; // the same, if it is elastic
};

// Throws BadSetup where the settings are inconsistent.
PlatenOfTest make_platen(const dem::Specimen &specimen, const PlatenTestSettings &settings, Side side,
                         const dem::Model &model);

// Finite elements of the platen that make_platen would make for a specimen of this shape; 0 for a given mesh,
// which is not counted.
double cells_of_platen(const dem::Shape &shape, const PlatenTestSettings &settings, Side side);

// Position of a platen's face at the start, along the axis of its side (m): with ends as packed it touches
// the outermost sphere, with ground ends it lies in the end plane, from which it stands off by a tube's
// recess.
double platen_plane(const dem::Specimen &specimen, const PlatenTestSettings &settings, Side side);
// m, of a tube, at this side.
double recess_of(const PlatenTestSettings &settings, Side side);
inline double half_width(const dem::Shape &shape) { // m, along x
  return shape.kind == dem::ShapeKind::box ? 0.5 * shape.width_x : shape.radius;
}
// Along which a tilted platen rises: x, and of a disc its axis, y, so that it meets one end of the rim first.
inline int tilted_along(const dem::Shape &shape) {
  return shape.kind == dem::ShapeKind::disc ? 1 : 0;
}
// m, that a seated sphere at this place lies farther from the platen than its end plane: by the form of the
// end face, and by the tilt of the top platen.
double depth_of_end(const dem::Shape &shape, const PlatenTestSettings &settings, Side side,
                    const Vector3 &centre);

// Throws BadSetup if the gaps at the edges of a platen leave too little of it.
void require_edge_gaps(const dem::Shape &shape, const PlatenSettings &settings);

// Whether platens press the sides next to this one.
bool has_neighbours(const PlatenSettings &settings, Side side);

// m, distance between a platen's edges and the planes of its neighbours along an axis.
double edge_gap(const dem::Shape &shape, const PlatenSettings &settings, int axis);

// A platen of a given mesh also ends short of its neighbours; `surface`: its final place. Throws BadSetup.
void require_short_of_neighbours(const dem::Specimen &specimen, const PlatenTestSettings &settings, Side side,
                                 const fem::SurfaceMesh &surface);

// For a bar in bending: each strip has a sphere within `depth` (m) of its face. Throws BadSetup.
void require_strips_to_meet(const dem::Specimen &specimen, const PlatenTestSettings &settings, double depth);

// N/m, of the bonds; without bonds, of the bonds that the pairs of the packing would have.
double mean_bond_stiffness(const dem::Model &model);

} // namespace platen::coupling
