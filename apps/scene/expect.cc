#include "apps/scene/expect.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "apps/scene/units.h"

namespace platen::apps {
namespace {

using Json = nlohmann::ordered_json;

// With the reasons that the summary has against it.
std::string not_measured(const Expectation &expected, const Json &summary) {
  std::string reasons;
  const Json::json_pointer place("/validity/" + expected.key.substr(0, expected.key.find('/')));
  if (summary.contains(place) && summary.at(place).is_array())
    for (const Json &reason : summary.at(place))
      reasons += (reasons.empty() ? " (" : "; ") + reason.get<std::string>();
  return expected.origin + ": " + expected.key + " was not measured" +
         (reasons.empty() ? "" : reasons + ")") + ", expected " + expected.text;
}

// In the unit of the range, with four digits, or as many as it takes to stand outside of it: "38.55 MPa".
std::string in_unit_of(const Expectation &expected, double value) {
  constexpr int usual_digits = 4, all_digits = 17;
  std::string text;
  for (int digits = usual_digits; digits <= all_digits; ++digits) {
    text = fmt::format("{:.{}g}", value / expected.of_unit, digits);
    const double shown = to_si(text, "1") * expected.of_unit;
    if (shown < expected.low || shown > expected.high) break;
  }
  return text + (expected.unit.empty() ? "" : " " + expected.unit);
}

// Empty where it holds.
std::string fault_of_number(const Expectation &expected, double value, const Json &summary) {
  if (std::isnan(value)) return not_measured(expected, summary);
  if (value >= expected.low && value <= expected.high) return "";
  return expected.origin + ": " + expected.key + " = " + in_unit_of(expected, value) + " is not in " +
         expected.text;
}

std::string fault_of_word(const Expectation &expected, const Json &found, const Json &summary) {
  if (!found.is_string()) return not_measured(expected, summary);
  const std::string word = found.get<std::string>();
  if (std::find(expected.words.begin(), expected.words.end(), word) != expected.words.end()) return "";
  return expected.origin + ": " + expected.key + " = " + word + " is not " +
         (expected.words.size() > 1 ? "one of " : "") + expected.text;
}

Json listed(const Expectation &expected, const Json &value, const Json &met, const std::string &reason) {
  return {{"entry", "Expect/" + expected.key},
          {"range", expected.text},
          {"value", value},
          {"met", met},
          {"reason", reason.empty() ? Json() : Json(reason)}};
}

} // namespace

Json check_expectations(const Scene &scene, const Json &summary) {
  Json list = Json::array();
  for (const Expectation &expected : scene.expect) {
    if (!summary.contains(expected.key.substr(0, expected.key.find('/')))) {
      list.push_back(listed(expected, nullptr, nullptr, "measured by another app"));
      continue;
    }
    const Json::json_pointer path("/" + expected.key);
    const Json found = summary.contains(path) ? summary.at(path) : Json();
    const double number = found.is_number() ? found.get<double>() : std::numeric_limits<double>::quiet_NaN();
    const std::string fault = expected.words.empty() ? fault_of_number(expected, number, summary)
                                                     : fault_of_word(expected, found, summary);
    list.push_back(listed(expected, found, fault.empty(), fault));
  }
  return list;
}

Json unchecked_expectations(const Scene &scene, const std::string &reason) {
  Json list = Json::array();
  for (const Expectation &expected : scene.expect)
    list.push_back(listed(expected, nullptr, nullptr, reason));
  return list;
}

} // namespace platen::apps
