// Structs of parameters that describe themselves, each member once. Such a struct has
//   static constexpr const char *name = "ParallelBond";
//   template <class Visitor, class Self>
//   static void describe(Visitor &&v, Self &p) {
//     v("stiffness_ratio", p.stiffness_ratio, "1", between(0, 5), "Shear over normal stiffness, k_s / k_n.");
//   }
// After the name of a member and the member itself follow, for a number or a list of numbers: unit, range and
// a sentence; for an integer: range and a sentence; for an enum: its words and a sentence; for a flag, or any
// other type: a sentence. These define what the library refuses and what a scene may contain.
#pragma once

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "base/range.h"

namespace platen {

// A number that has no default, or follows from other members.
constexpr double not_given = std::numeric_limits<double>::quiet_NaN();

template <class Enum>
using Words = std::vector<std::pair<std::string, Enum>>;

// A member of a struct of parameters has a wrong value: "ParallelBond: stiffness_ratio = -1 is out of range.
// Allowed: 0 ... 5." `reason` follows the value.
class BadParameter : public std::invalid_argument {
public:
  BadParameter(std::string in, std::string of, const std::string &value, const std::string &why)
      : std::invalid_argument(in + ": " + of + (value.empty() ? " " : " = " + value + " ") + why),
        owner(std::move(in)),
        member(std::move(of)),
        reason(why) {}
  std::string owner, member, reason;
};

inline std::string allowed_text(const Range &range, const std::string &unit) {
  return range.text() + (unit == "1" ? "" : " " + unit);
}

// A visitor that throws BadParameter for a number out of its range; it skips what is not given (NaN).
class RangeCheck {
public:
  explicit RangeCheck(std::string owner) : owner_(std::move(owner)) {}

  void operator()(const char *member, double value, const std::string &unit, const Range &range,
                  const char * /*sentence*/) const {
    if (std::isnan(value) || range.holds(value)) return;
    throw BadParameter(owner_, member, shortest_text(value),
                       "is out of range. Allowed: " + allowed_text(range, unit) + ".");
  }
  void operator()(const char *member, const std::vector<double> &values, const std::string &unit,
                  const Range &range, const char *sentence) const {
    for (const double value : values)
      (*this)(member, value, unit, range, sentence);
  }
  void operator()(const char *member, int value, const Range &range, const char *sentence) const {
    (*this)(member, value, "1", range, sentence);
  }
  template <class Enum>
  void operator()(const char * /*member*/, const Enum & /*value*/, const Words<Enum> & /*words*/,
                  const char * /*sentence*/) const {}
  template <class Other>
  void operator()(const char * /*member*/, const Other & /*value*/, const char * /*sentence*/) const {}

private:
  std::string owner_;
};

template <class Described>
void require_in_range(const Described &parameters) {
  Described::describe(RangeCheck(Described::name), parameters);
}

// Throws BadParameter for a member that is not given (NaN).
template <class Described>
void require_given(const Described & /*in*/, const char *member, double value) {
  if (std::isnan(value)) throw BadParameter(Described::name, member, "", "is not set.");
}

} // namespace platen
