// What a number of a scene may be: its unit, the range that is declared of it (base/describe.h), and what is
// physical of that dimension between nanometres and a mountain: what lies outside is a slip.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "apps/scene/units.h"
#include "base/range.h"

namespace platen::apps {

class Quantity {
public:
  // `path` is the entry's: moduli and displacements have other bounds than stresses and lengths. Ends that
  // `declared` states stay.
  Quantity(const std::string &path, const std::string &unit, const Range &declared);

  // "1.25 mm" in SI; "" is NaN. Throws ValueError for what is no number of this unit, out of range, or bare
  // and of a size that another unit was meant.
  double read(const std::string &text) const;
  bool holds(double value) const { return range_.holds(value) || (or_zero_ && value == 0); }
  // Throws ValueError for a bare number in SI that no test has: 5 for a pressure of 5 MPa, 100 for a height
  // of 100 mm. It names the unit that was perhaps meant.
  void require_meant(const NumberWithUnit &number) const;
  std::string allowed() const { return (or_zero_ ? "0, or " : "") + range_.text(); } // "0, or 1e-10 ... 1e5"

private:
  std::string unit_;
  Range range_;
  bool or_zero_ = false; // where an entry means "none" or "by itself" by it
  // Of a number without a unit, zero aside: beyond it one of these was meant.
  double bare_low_ = 0, bare_high_ = std::numeric_limits<double>::infinity();
  std::vector<std::string> meant_;
};

} // namespace platen::apps
