// The last word of a run: did the numbers come out that its scene expects?
#pragma once

#include <nlohmann/json.hpp>

#include "apps/io/run_log.h"
#include "apps/scene/scene.h"

namespace platen::apps {

// Tells each expectation that does not hold, and those that another app would have to check. Returns the
// app's exit status, status_done or status_check_failed.
int tell_expectations(const Scene &scene, const nlohmann::ordered_json &summary, RunLog &log);

} // namespace platen::apps
