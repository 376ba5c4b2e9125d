// What numbers of a dimension can be of a specimen between nanometres and a mountain: what lies outside is a
// slip, whatever else an entry allows.
#pragma once

#include <string>

#include "base/range.h"

namespace platen::apps {

// A range, and zero beside it where an entry means "none" or "by itself" by it.
struct Allowed {
  Range range;
  bool or_zero = false;

  Allowed(const Range &of) : range(of) {}
  Allowed(const Range &of, bool zero) : range(of), or_zero(zero) {}
  bool holds(double value) const { return range.holds(value) || (or_zero && value == 0); }
  std::string text() const { return (or_zero ? "0, or " : "") + range.text(); } // "0, or 1e-10 ... 1e5"
};

// What is declared of a number with this unit (base/describe.h), narrowed to what is physical; ends that the
// declaration states stay. `path` is the entry's: displacements may be smaller than specimens are.
Allowed physical(const std::string &path, const std::string &unit, const Range &declared);

} // namespace platen::apps
