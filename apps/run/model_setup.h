// From a scene to the settings of a particle model.
#pragma once

#include "apps/scene/scene.h"
#include "dem/model.h"

namespace platen::apps {

// What the scene leaves out is no part of the settings; the rest is the scene's as it is.
dem::ModelSettings model_settings(const Scene &scene);
std::optional<dem::ContactSettings> contact_settings(const Scene &scene);

} // namespace platen::apps
