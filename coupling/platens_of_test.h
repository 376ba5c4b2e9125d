// The platens of a test: their grids by the specimen and the settings, rigid or elastic, and their contacts.
#pragma once

#include "coupling/platen_test.h"

namespace platen::coupling {

struct PlatenOfTest {
  std::unique_ptr<Platen> platen;
  const ElasticPlaten *elastic = nullptr; // the same, where it yields
};

// Throws BadSetup where the settings do not go together.
PlatenOfTest make_platen(const dem::Specimen &specimen, const PlatenTestSettings &settings, bool above,
                         const dem::Model &model);

// z of a platen's face at the start (m): as packed it meets the outermost sphere, ground it lies in the end
// plane.
double platen_plane(const dem::Specimen &specimen, bool above, Ends ends);

// Of a bar that is bent: each strip has a sphere within `depth` (m) of its face. Throws BadSetup.
void require_strips_to_meet(const dem::Specimen &specimen, const PlatenTestSettings &settings, double depth);

// N/m, of the bonds; without bonds of those that the pairs of the packing would have.
double mean_bond_stiffness(const dem::Model &model);

} // namespace platen::coupling
