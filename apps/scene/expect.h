// The numbers and words that a scene expects of itself.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "apps/scene/scene.h"

namespace platen::apps {

struct ExpectationCheck {
  // One line for each expectation that does not hold, e.g. "case.prm:31: strength_pa = 5.2e7 is not in 35 MPa
  // ... 50 MPa".
  std::vector<std::string> failed;
  std::vector<std::string> unchecked; // keys that this app's summary does not have: another app measures them
  // As summary.json has them, in the order of the scene: `entry` ("Expect/strength_pa"), `range` (as it
  // stands in the scene), `value` (SI, or a word; null where none was measured), `met` (null where it was not
  // checked), `reason` (why it is not met, or was not checked; null where it is met).
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
};
// Checks a whole summary. A key that the summary has and that is null was not measured: it fails.
ExpectationCheck check_expectations(const Scene &scene, const nlohmann::ordered_json &summary);

// The same list of a test that has not come to its end: nothing is checked, for this reason.
nlohmann::ordered_json unchecked_expectations(const Scene &scene, const std::string &reason);

} // namespace platen::apps
