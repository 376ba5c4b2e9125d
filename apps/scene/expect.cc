#include "apps/scene/expect.h"

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

} // namespace platen::apps
