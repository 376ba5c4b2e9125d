// What a run says of its loading stages.
#pragma once

#include <nlohmann/json.hpp>

#include "apps/run/results.h"
#include "apps/scene/scene.h"
#include "coupling/platen_test.h"

namespace platen::apps {

// Adds `stages`, of those that the scene writes: where each ended, by what, and what it asked and reached.
// The one that a run was in when it stopped ended by "stopped", or by "stop at residual".
void add_stages(nlohmann::ordered_json &to, const Scene &scene, const coupling::PlatenTest &problem,
                const Results &results);

} // namespace platen::apps
