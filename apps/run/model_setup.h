// From a scene to the settings of a particle model.
#pragma once

#include "apps/scene/scene.h"
#include "dem/model.h"

namespace platen::apps {

// Effects, Bond, Contact, Material and Integration as the particle model takes them. A strength of 0 becomes
// infinite. The bond layout is set without bonds too: it gives unbonded pairs their stiffness.
dem::ModelSettings model_settings(const Scene &scene);
dem::DensityOf density_of(const Scene &scene);

} // namespace platen::apps
