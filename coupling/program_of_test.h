// The program of a test by its settings: scenes' stages, or those that the other members of the loading stand
// for.
#pragma once

#include <memory>

#include "coupling/platen_test.h"

namespace platen::coupling {

// What settings of a cell and of the axial loading mean, as stages: all sides alike, then the platens at a
// rate, with unloading in between, or by a stress.
std::vector<StageSettings> stages_of_members(const PlatenTest &test);

// The axis along which a test loads its specimen, 0 x, 1 y, 2 z: axial, but where stages drive platens of
// other sides alone at a rate; then the first that is driven.
int loaded_axis(const PlatenTest &test);

// Throws BadSetup where the stages cannot be.
std::unique_ptr<Program> make_program(const PlatenTest &test);

} // namespace platen::coupling
