// Numbers with units: "1.25 mm" is 0.00125 where a length is meant. A bare number is SI. Independent of the
// locale.
#pragma once

#include <string>

#include "apps/scene/errors.h"
#include "base/shortest_text.h"

namespace platen::apps {

// A number and what follows it, e.g. {0.05, "R_min"}; unit is empty for a bare number.
struct NumberWithUnit {
  double value = 0;
  std::string unit;
};

// Splits "0.05 R_min" into number and unit. Throws ValueError for text that does not begin with a finite
// decimal number in the C notation (inf, nan, decimal commas and numbers beyond the range of double are
// refused).
NumberWithUnit split_number(const std::string &text);

// Converts to `si_unit` ("m", "Pa", "kg/m3", "rad", "1" for a plain number). Units are names of a table with
// a metric prefix, their powers ("mm2", "s^-1"), products (blank, "*", ".") and quotients ("/"). Throws
// ValueError for an unknown unit or one of another dimension. An angle is no plain number; a percentage is
// one.
double to_si(const NumberWithUnit &number, const std::string &si_unit);
double to_si(const std::string &text, const std::string &si_unit);

// "1.4 mm" of 0.0014 m: a number of an SI unit as engineers name it, stresses in MPa, lengths in mm, others
// as they are; without the last bit that a conversion may leave. `between` parts number and unit.
std::string in_usual_unit(double value, const std::string &si_unit, const std::string &between = " ");

} // namespace platen::apps
