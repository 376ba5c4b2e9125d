// The numbers and words that a scene expects of itself.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "apps/scene/scene.h"

namespace platen::apps {

// One line for each expectation that does not hold, e.g. "case.prm:31: strength_pa = 5.2e7 is not in 35 MPa
// ... 50 MPa". value_of gives the number of a key of summary.json ("cone_top/height_m" for a member of an
// object) in its unit, NaN where the run did not measure it: what was expected and not measured does not
// hold. No number is an expected word.
std::vector<std::string> failed_expectations(const Scene &scene,
                                             const std::function<double(const std::string &)> &value_of);

struct ExpectationCheck {
  std::vector<std::string> failed;    // as above
  std::vector<std::string> unchecked; // keys that this app's summary does not have: another app measures them
};
// Checks a whole summary. A key that the summary has and that is null was not measured: it fails.
ExpectationCheck check_expectations(const Scene &scene, const nlohmann::ordered_json &summary);

} // namespace platen::apps
