// The program of a test from its settings: the stages of the loading, or those that its other members define.
#pragma once

#include <memory>

#include "coupling/platen_test.h"

namespace platen::coupling {

// The stages that the settings of a cell and of the axial loading define: all sides alike, then the platens
// at a rate, with unloading in between, or by a stress.
std::vector<StageSettings> stages_of_members(const PlatenTest &test);

// The axis along which a test loads its specimen, 0 x, 1 y, 2 z: axial, except where stages drive only
// platens of other sides at a rate; then the first driven axis.
int loaded_axis(const PlatenTest &test);

// Throws BadSetup where the stages are not valid.
std::unique_ptr<Program> make_program(const PlatenTest &test);

} // namespace platen::coupling
