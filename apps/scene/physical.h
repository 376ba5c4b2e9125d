// What numbers of a dimension can be of a specimen between nanometres and a mountain: what lies outside is a
// slip, whatever else an entry allows.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "base/range.h"

namespace platen::apps {

// A range, and zero beside it where an entry means "none" or "by itself" by it.
struct Allowed {
  Range range;
  bool or_zero = false;
  // What a number without a unit may be, zero aside: beyond it another unit was meant, one of these.
  double bare_low = 0, bare_high = std::numeric_limits<double>::infinity();
  std::vector<std::string> meant;

  Allowed(const Range &of) : range(of) {}
  Allowed(const Range &of, bool zero) : range(of), or_zero(zero) {}
  bool holds(double value) const { return range.holds(value) || (or_zero && value == 0); }
  std::string text() const { return (or_zero ? "0, or " : "") + range.text(); } // "0, or 1e-10 ... 1e5"
};

// Throws ValueError for a bare number in SI that no test has: 5 for a pressure of 5 MPa, 100 for a height of
// 100 mm. It names the unit that was perhaps meant.
void require_meant(double value, const std::string &si_unit, const Allowed &allowed);

// What is declared of a number with this unit (base/describe.h), narrowed to what is physical; ends that the
// declaration states stay. `path` is the entry's: displacements may be smaller than specimens are.
Allowed physical(const std::string &path, const std::string &unit, const Range &declared);

} // namespace platen::apps
