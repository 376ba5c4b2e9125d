// The materials of platens: one material, a sheet on it, or any number of layers.
#pragma once

#include <vector>

#include "coupling/platen_test_settings.h"
#include "fem/grids.h"

namespace platen::coupling {

// m, of the platen of a side, for a plate.
double thickness_of(const PlatenSettings &settings, Side side);

// The platens' own material, with its hardening where it yields.
fem::Material own_material(const PlatenSettings &settings);

// Layers of an elastic platen, from the specimen outward; its own material fills the rest of the thickness.
// Throws BadSetup where the layers are thicker than that, or a layer is not valid.
std::vector<PlatenLayer> layers_of(const PlatenSettings &settings, Side side);

// The same from the low end, for a plate of this half-width (m): elements are about as thick as wide.
std::vector<fem::Layer> elements_of_layers(const PlatenSettings &settings, Side side, double half_width);

// By material id, of a plate from the low end. For a given grid in the order of its physical volumes: those
// of the layers in their order, else platen and pad. Throws std::invalid_argument where the numbers differ.
std::vector<fem::Material> materials_of(const PlatenSettings &settings, Side side);

} // namespace platen::coupling
