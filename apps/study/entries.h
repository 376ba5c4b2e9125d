// Entries and names of cases, as the plans of all kinds of study write them.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "apps/scene/units.h"
#include "apps/study/cases.h"

namespace platen::apps {

// "Section/Key = value unit".
inline std::string set(const std::string &path, double value, const std::string &unit) {
  return path + " = " + shortest_text(value) + (unit.empty() ? "" : " " + unit);
}

// For a name: without the last bit that a unit's conversion may leave (0.9 mm is 0.0009000000000000001 m).
inline std::string in_name(double value) {
  return fmt::format("{:.12g}", value);
}

// The list, or the one value that the scene has.
template <class Value>
std::vector<Value> or_own(const std::vector<Value> &list, const Value &own) {
  return list.empty() ? std::vector<Value>{own} : list;
}

inline void add(StudyPlan &plan, StudyCase one) {
  const bool known = std::any_of(plan.cases.begin(), plan.cases.end(),
                                 [&](const StudyCase &other) { return other.name == one.name; });
  if (!known) plan.cases.push_back(std::move(one)); // the same by two lists: runs once
}

} // namespace platen::apps
