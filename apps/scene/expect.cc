#include "apps/scene/expect.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "apps/scene/units.h"

namespace platen::apps {
namespace {

using Json = nlohmann::ordered_json;

std::string not_measured(const Expectation &expected) {
  return expected.origin + ": " + expected.key + " was not measured, expected " + expected.text;
}

// Empty where it holds.
std::string fault_of_number(const Expectation &expected, double value) {
  if (std::isnan(value)) return not_measured(expected);
  if (value >= expected.low && value <= expected.high) return "";
  return expected.origin + ": " + expected.key + " = " + shortest_text(value) + " is not in " + expected.text;
}

std::string fault_of_word(const Expectation &expected, const Json &found) {
  if (!found.is_string()) return not_measured(expected);
  const std::string word = found.get<std::string>();
  if (std::find(expected.words.begin(), expected.words.end(), word) != expected.words.end()) return "";
  return expected.origin + ": " + expected.key + " = " + word + " is not " +
         (expected.words.size() > 1 ? "one of " : "") + expected.text;
}

} // namespace

ExpectationCheck check_expectations(const Scene &scene, const Json &summary) {
  ExpectationCheck check;
  for (const Expectation &expected : scene.expect) {
    if (!summary.contains(expected.key.substr(0, expected.key.find('/')))) {
      check.unchecked.push_back(expected.key);
      continue;
    }
    const Json::json_pointer path("/" + expected.key);
    const Json found = summary.contains(path) ? summary.at(path) : Json();
    const double number = found.is_number() ? found.get<double>() : std::numeric_limits<double>::quiet_NaN();
    const std::string fault =
        expected.words.empty() ? fault_of_number(expected, number) : fault_of_word(expected, found);
    if (!fault.empty()) check.failed.push_back(fault);
  }
  return check;
}

} // namespace platen::apps
