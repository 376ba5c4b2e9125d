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
};
// Checks a whole summary. A key that the summary has and that is null was not measured: it fails.
ExpectationCheck check_expectations(const Scene &scene, const nlohmann::ordered_json &summary);

} // namespace platen::apps
