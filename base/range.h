// The allowed range of a parameter.
#pragma once

#include <cmath>
#include <limits>
#include <string>

#include "base/shortest_text.h"

namespace platen {

struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_included = true, high_included = true;

  bool holds(double value) const {
    return (low_included ? value >= low : value > low) && (high_included ? value <= high : value < high);
  }
  // "0 ... 5", "> 0", ">= 0", "above 0 ... 1"; "" for all numbers
  std::string text() const {
    const bool from = std::isfinite(low), to = std::isfinite(high);
    if (from && to)
      return (low_included ? "" : "above ") + shortest_text(low) + " ... " + (high_included ? "" : "below ") +
             shortest_text(high);
    if (from) return (low_included ? ">= " : "> ") + shortest_text(low);
    if (to) return (high_included ? "<= " : "< ") + shortest_text(high);
    return "";
  }
};

inline Range any_number() {
  return {};
}
inline Range above(double low) {
  return {low, std::numeric_limits<double>::infinity(), false, true};
}
inline Range at_least(double low) {
  return {low, std::numeric_limits<double>::infinity(), true, true};
}
inline Range between(double low, double high) {
  return {low, high, true, true};
}
inline Range above_up_to(double low, double high) {
  return {low, high, false, true};
}
inline Range from_to_below(double low, double high) {
  return {low, high, true, false};
}
inline Range between_open(double low, double high) {
  return {low, high, false, false};
}

} // namespace platen
