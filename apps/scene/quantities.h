// Values of a scene that a number alone does not state.
#pragma once

#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/describe.h"
#include "dem/laws/contact_settings.h"

namespace platen::apps {

// How often: a count of steps, a time (simulated seconds; wall clock for checkpoints), or none of both.
struct Interval {
  enum class Kind { none, steps, time }; // none: the app chooses, or the thing is off (see the member)
  Kind kind = Kind::none;
  double value = 0; // steps or s
};

using dem::Gap;
using dem::Stiffness;

// One expected number: low <= summary.json's key <= high; the open side of a one-sided range is infinite. Or
// an expected word: one of `words`.
struct Expectation {
  std::string key;                // a key of summary.json; `cone_top/height_m` is a member of an object
  std::vector<std::string> words; // empty of a number
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  std::string text;   // range or words as they stand in the scene
  std::string unit;   // of the range, "MPa"; "" where it is in SI
  double of_unit = 1; // of one of that unit, SI
  std::string origin; // "case.prm:31"
};

// The first word of a value. Throws std::logic_error for one that has none.
template <class Enum>
const std::string &word_of(const Words<Enum> &words, Enum value) {
  for (const auto &[word, meant] : words)
    if (meant == value) return word;
  throw std::logic_error("a value without a word");
}

// The list, or the one value that the scene has.
template <class Value>
std::vector<Value> or_own(const std::vector<Value> &list, const Value &own) {
  return list.empty() ? std::vector<Value>{own} : list;
}

} // namespace platen::apps
