#include "apps/scene/quantity.h"

#include <cmath>

#include "apps/scene/texts.h"

namespace platen::apps {
namespace {

struct Bounds {
  std::string key; // the last name of a path, or that of a list of such; "" any other
  std::string unit;
  double low, high; // of what is not zero
};

// Grains from atoms' size to a metre in specimens up to a mountain; from gels to beyond diamond; densities
// with what scaling makes of them; speeds from creep to impact. Forces, stiffnesses and masses are what these
// make together.
const std::vector<Bounds> &physical_bounds() {
  static const std::vector<Bounds> all{{"Modulus", "Pa", 1, 1e13},
                                       {"Young modulus", "Pa", 1, 1e13},
                                       {"Contact modulus", "Pa", 1, 1e13},
                                       {"Pad modulus", "Pa", 1, 1e13},
                                       {"Slip length", "m", 1e-15, 1e3},
                                       {"Displacement", "m", 1e-15, 1e3},
                                       {"Turns", "m", 1e-15, 1e3},
                                       {"Edge gap", "m", 1e-15, 1e3},
                                       {"Radius multiplier", "1", 0.1, 3},
                                       {"Wave crossings", "1", 0.01, 1e6},
                                       {"Wall stiffness", "1", 0.1, 1e3},
                                       {"", "m", 1e-10, 1e5},
                                       {"", "Pa", 1e-3, 1e13},
                                       {"", "kg/m3", 1e-3, 1e8},
                                       {"", "m/s", 1e-12, 1e4},
                                       {"", "s", 1e-18, 1e9},
                                       {"", "N", 1e-18, 1e12},
                                       {"", "N/m", 1e-10, 1e17},
                                       {"", "kg", 1e-30, 1e12},
                                       {"", "J/m2", 1e-12, 1e9},
                                       {"", "1", 1e-9, 1e9}};
  return all;
}

// Null where nothing is known of the dimension.
const Bounds *bounds_of(const std::string &key, const std::string &unit) {
  for (const Bounds &one : physical_bounds())
    if (one.unit == unit && (one.key.empty() || key == one.key || key == one.key + " list")) return &one;
  return nullptr;
}

} // namespace

Quantity::Quantity(const std::string &path, const std::string &unit, const Range &declared)
    : unit_(unit), range_(declared) {
  const std::string key = last_name(path);
  // Loads and strengths begin with the kilopascals of soils, moduli with those of foams; a metre is a large
  // specimen, a sphere or a sheet of that size is none. Who means it writes the unit.
  constexpr double least_stress = 1e3, least_modulus = 1e5, most_length = 1; // Pa, Pa, m
  if (unit == "Pa" && key.find("odulus") != std::string::npos)
    bare_low_ = least_modulus, meant_ = {"MPa", "GPa"};
  else if (unit == "Pa")
    bare_low_ = least_stress, meant_ = {"MPa"};
  else if (unit == "m" && key != "Mesh unit")
    bare_high_ = most_length, meant_ = {"mm"};

  const Bounds *of = bounds_of(key, unit);
  if (of == nullptr) return;
  const bool own = !of->key.empty();
  if (!std::isfinite(range_.high) || (own && of->high < range_.high))
    range_.high = of->high, range_.high_included = true;
  if (!std::isfinite(range_.low)) {
    range_.low = -of->high, range_.low_included = true;
    return;
  }
  // Of plain numbers a small one is as good as a large one, but for those that have no end above.
  const bool plain = unit == "1" && ((!own && std::isfinite(declared.high)) || range_.low_included);
  if (range_.low != 0 || of->low >= range_.high || plain) return;
  or_zero_ = range_.low_included;
  range_.low = of->low, range_.low_included = true;
}

double Quantity::read(const std::string &text) const {
  if (text.empty()) return std::numeric_limits<double>::quiet_NaN();
  const NumberWithUnit number = split_number(text);
  const double value = to_si(number, unit_);
  if (!holds(value)) throw ValueError("is out of range");
  require_meant(number);
  return value;
}

void Quantity::require_meant(const NumberWithUnit &number) const {
  const double size = std::abs(number.value);
  if (!number.unit.empty() || size == 0 || (size >= bare_low_ && size < bare_high_)) return;
  const std::string text = shortest_text(number.value);
  std::string units;
  for (const std::string &unit : meant_)
    units += (units.empty() ? "\"" : " or \"") + text + " " + unit + "\"";
  throw ValueError("is a bare number, which is in " + unit_ + ". Did you mean " + units +
                   "? If not, write \"" + text + " " + unit_ + "\".");
}

} // namespace platen::apps
