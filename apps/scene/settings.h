// What a scene asks of the library: its settings, without what stands in files that the scene names.
#pragma once

#include <optional>

#include "apps/scene/scene.h"
#include "dem/packing/specimen.h"

namespace platen::apps {

// The shape that Specimen/Shape, Radius, Height and Width x, y describe. A bar is round where Radius is
// given.
dem::Shape specimen_shape(const Scene &scene);

std::optional<dem::ContactSettings> contact_settings(const Scene &scene);
// What the scene leaves out is no part of the settings; the rest is the scene's as it is. Ids of an aggregate
// are missing.
dem::ModelSettings model_without_files(const Scene &scene);
// Of a test between platens; the grids of platens are null.
coupling::PlatenTestSettings settings_without_files(const Scene &scene);

} // namespace platen::apps
