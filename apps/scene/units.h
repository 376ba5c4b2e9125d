// Numbers with units: "1.25 mm" is 0.00125 where a length is meant. A bare number is SI. Independent of the
// locale.
#pragma once

#include <stdexcept>
#include <string>

#include "base/shortest_text.h"

namespace platen::apps {

// Why a text is no value: a predicate that goes after the text, e.g. `is not a number`.
class ValueError : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

// A number and what follows it, e.g. {0.05, "R_min"}; unit is empty for a bare number.
struct NumberWithUnit {
  double value = 0;
  std::string unit;
};

// Splits "0.05 R_min" into number and unit. Throws ValueError for text that does not begin with a finite
// decimal number in the C notation (inf, nan, decimal commas and numbers beyond the range of double are
// refused).
NumberWithUnit split_number(const std::string &text);

// Converts to `si_unit`, which is a unit of UDUNITS-2 ("m", "Pa", "kg/m3", "rad", "1" for a plain number).
// Throws ValueError for an unknown unit or one of another dimension. Angles and plain numbers are told apart,
// although UDUNITS-2 converts them into each other; a percentage is a plain number.
double to_si(const NumberWithUnit &number, const std::string &si_unit);
double to_si(const std::string &text, const std::string &si_unit);

} // namespace platen::apps
