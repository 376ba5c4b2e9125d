#include "apps/scene/expect.h"

#include <cmath>
#include <limits>

#include "apps/scene/units.h"

namespace platen::apps {

std::vector<std::string> failed_expectations(const Scene &scene,
                                             const std::function<double(const std::string &)> &value_of) {
  std::vector<std::string> failed;
  for (const Expectation &expected : scene.expect) {
    const double value = value_of(expected.key);
    if (value >= expected.low && value <= expected.high) continue; // false for NaN
    const std::string found =
        std::isnan(value) ? " was not measured, expected " : " = " + shortest_text(value) + " is not in ";
    failed.push_back(expected.origin + ": " + expected.key + found + expected.text);
  }
  return failed;
}

ExpectationCheck check_expectations(const Scene &scene, const nlohmann::ordered_json &summary) {
  Scene of_this_app;
  ExpectationCheck check;
  for (const Expectation &expected : scene.expect)
    if (summary.contains(expected.key.substr(0, expected.key.find('/'))))
      of_this_app.expect.push_back(expected);
    else
      check.unchecked.push_back(expected.key);
  check.failed = failed_expectations(of_this_app, [&](const std::string &key) {
    const nlohmann::ordered_json::json_pointer path("/" + key);
    const bool measured = summary.contains(path) && summary.at(path).is_number();
    return measured ? summary.at(path).get<double>() : std::numeric_limits<double>::quiet_NaN();
  });
  return check;
}

} // namespace platen::apps
