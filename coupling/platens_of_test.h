// The platens of a test: their grids by the specimen and the settings, rigid or elastic, and their contacts.
#pragma once

#include "coupling/platen_test.h"

namespace platen::coupling {

struct PlatenOfTest {
  std::unique_ptr<Platen> platen;
  const ElasticPlaten *elastic = nullptr; // the same, where it yields
};

// Throws BadSetup where the settings do not go together.
PlatenOfTest make_platen(const dem::Specimen &specimen, const PlatenTestSettings &settings, Side side,
                         const dem::Model &model);

// Finite elements of the platen that make_platen would make of a specimen of this shape; 0 of a given mesh,
// which is not counted.
double cells_of_platen(const dem::Shape &shape, const PlatenTestSettings &settings, Side side);

// Where a platen's face is at the start, along the axis of its side (m): as packed it meets the outermost
// sphere, ground it lies in the end plane.
double platen_plane(const dem::Specimen &specimen, Side side, Ends ends);

// Throws BadSetup if the gaps at the edges of platens leave too little of one.
void require_edge_gaps(const dem::Shape &shape, const PlatenSettings &settings);

// Whether platens press sides beside this one.
bool has_neighbours(const PlatenSettings &settings, Side side);

// m, by how much a platen's edges lie short of the planes of its neighbours along an axis.
double edge_gap(const dem::Shape &shape, const PlatenSettings &settings, int axis);

// A platen of a given mesh ends short of its neighbours too; `surface` is it where it lies. Throws BadSetup.
void require_short_of_neighbours(const dem::Specimen &specimen, const PlatenTestSettings &settings, Side side,
                                 const fem::SurfaceMesh &surface);

// Of a bar that is bent: each strip has a sphere within `depth` (m) of its face. Throws BadSetup.
void require_strips_to_meet(const dem::Specimen &specimen, const PlatenTestSettings &settings, double depth);

// N/m, of the bonds; without bonds of those that the pairs of the packing would have.
double mean_bond_stiffness(const dem::Model &model);

} // namespace platen::coupling
