// The numbers and words that a scene expects of itself.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "apps/scene/scene.h"

namespace platen::apps {

// Checks a whole summary: a list, as summary.json has it, in the order of the scene. `entry`
// ("Expect/strength_pa"), `range` (as it stands in the scene), `value` (SI, or a word; null where none was
// measured: then the expectation is not met), `met` (null where it was not checked, for another app measures
// it), `reason` (why it is not met, e.g. "case.prm:31: strength_pa = 52 MPa is not in 35 MPa ... 50 MPa", or
// was not checked; null where it is met).
nlohmann::ordered_json check_expectations(const Scene &scene, const nlohmann::ordered_json &summary);

// The same list of a test that has not come to its end: nothing is checked, for this reason.
nlohmann::ordered_json unchecked_expectations(const Scene &scene, const std::string &reason);

} // namespace platen::apps
