// From a scene to a specimen between platens.
#pragma once

#include "apps/scene/scene.h"
#include "coupling/platen_test.h"

namespace platen::apps {

coupling::PlatenTestSettings problem_settings(const Scene &scene);

// Words of the effects that a scene has on, and of those it has off, of what a program reads, for --dry-run
// and summary.json.
std::vector<std::string> effects_on(const Scene &scene);
std::vector<std::string> effects_off(const Scene &scene);

} // namespace platen::apps
