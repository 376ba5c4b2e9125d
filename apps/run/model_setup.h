// From a scene to the settings of a particle model.
#pragma once

#include "apps/scene/settings.h"
#include "dem/model.h"

namespace platen::apps {

// With the files that the scene names. Throws InputError for one that cannot be read.
dem::ModelSettings model_settings(const Scene &scene);

} // namespace platen::apps
