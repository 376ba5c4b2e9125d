#include "apps/scene/physical.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "apps/scene/units.h"

namespace platen::apps {
namespace {

struct OfUnit {
  std::string unit;
  double low, high; // of what is not zero
};

// Grains from atoms' size to a metre in specimens up to a mountain; from gels to beyond diamond; densities
// with what scaling makes of them; speeds from creep to impact. Forces, stiffnesses and masses are what these
// make together.
const std::vector<OfUnit> &by_unit() {
  static const std::vector<OfUnit> all{
      {"m", 1e-10, 1e5},  {"Pa", 1e-3, 1e13},   {"kg/m3", 1e-3, 1e8}, {"m/s", 1e-12, 1e4},  {"s", 1e-18, 1e9},
      {"N", 1e-18, 1e12}, {"N/m", 1e-10, 1e17}, {"kg", 1e-30, 1e12},  {"J/m2", 1e-12, 1e9}, {"1", 1e-9, 1e9}};
  return all;
}

struct OfKey {
  std::string key; // the last name of the path, or that of a list of such
  std::string unit;
  double low, high;
};

const std::vector<OfKey> &by_key() {
  static const std::vector<OfKey> all{{"Modulus", "Pa", 1, 1e13},         {"Young modulus", "Pa", 1, 1e13},
                                      {"Contact modulus", "Pa", 1, 1e13}, {"Pad modulus", "Pa", 1, 1e13},
                                      {"Slip length", "m", 1e-15, 1e3},   {"Displacement", "m", 1e-15, 1e3},
                                      {"Turns", "m", 1e-15, 1e3},         {"Edge gap", "m", 1e-15, 1e3},
                                      {"Radius multiplier", "1", 0.1, 3}, {"Wave crossings", "1", 0.01, 1e6},
                                      {"Wall stiffness", "1", 0.1, 1e3}};
  return all;
}

// Of numbers without a unit. Loads and strengths begin with the kilopascals of soils, moduli with those of
// foams; a metre is a large specimen, a sphere or a sheet of that size is none. Who means it writes the unit.
void add_bare(const std::string &path, const std::string &unit, Allowed &to) {
  constexpr double least_stress = 1e3, least_modulus = 1e5, most_length = 1; // Pa, Pa, m
  const std::string key = path.substr(path.rfind('/') + 1);
  if (unit == "Pa" && key.find("odulus") != std::string::npos)
    to.bare_low = least_modulus, to.meant = {"MPa", "GPa"};
  else if (unit == "Pa")
    to.bare_low = least_stress, to.meant = {"MPa"};
  else if (unit == "m" && key != "Mesh unit")
    to.bare_high = most_length, to.meant = {"mm"};
}

// Null where nothing is known of the dimension.
const OfUnit *bounds(const std::string &path, const std::string &unit, OfUnit &own) {
  const std::string key = path.substr(path.rfind('/') + 1);
  for (const OfKey &one : by_key())
    if (one.unit == unit && (key == one.key || key == one.key + " list")) {
      own = {unit, one.low, one.high};
      return &own;
    }
  for (const OfUnit &one : by_unit())
    if (one.unit == unit) return &one;
  return nullptr;
}

Allowed bounded(const std::string &path, const std::string &unit, const Range &declared) {
  OfUnit own;
  const OfUnit *of = bounds(path, unit, own);
  if (of == nullptr) return declared;
  Range range = declared;
  if (!std::isfinite(range.high) || (of == &own && own.high < range.high))
    range.high = of->high, range.high_included = true;
  if (!std::isfinite(range.low)) return {{-of->high, range.high, true, range.high_included}, false};
  const bool from_zero = range.low == 0 && of->low < range.high;
  // Of plain numbers a small one is as good as a large one, but for those that have no end above.
  const bool plain = unit == "1" && of != &own && std::isfinite(declared.high);
  if (!from_zero || plain || (unit == "1" && range.low_included)) return range;
  const bool or_zero = range.low_included;
  range.low = of->low, range.low_included = true;
  return {range, or_zero};
}

} // namespace

Allowed physical(const std::string &path, const std::string &unit, const Range &declared) {
  Allowed allowed = bounded(path, unit, declared);
  add_bare(path, unit, allowed);
  return allowed;
}

void require_meant(double value, const std::string &si_unit, const Allowed &allowed) {
  const double size = std::abs(value);
  if (size == 0 || (size >= allowed.bare_low && size < allowed.bare_high)) return;
  const std::string number = shortest_text(value);
  std::string units;
  for (const std::string &unit : allowed.meant)
    units += (units.empty() ? "\"" : " or \"") + number + " " + unit + "\"";
  throw ValueError("is a bare number, which is in " + si_unit + ". Did you mean " + units +
                   "? If not, write \"" + number + " " + si_unit + "\".");
}

} // namespace platen::apps
