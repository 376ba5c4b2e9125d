#include "apps/scene/units.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <map>
#include <optional>
#include <vector>

#include "apps/scene/texts.h"
#include "base/characters.h"
#include "base/pi.h"

namespace platen::apps {
namespace {

// How much of SI one of it is, and its powers of m, kg, s and rad.
struct Unit {
  double si = 1;
  std::array<int, 4> of{};
};

const std::map<std::string, Unit> &units() {
  static const std::map<std::string, Unit> all = [] {
    const Unit metre{1, {1}}, gram{1e-3, {0, 1}}, second{1, {0, 0, 1}}, newton{1, {1, 1, -2}},
        pascal{1, {-1, 1, -2}}, bar{1e5, {-1, 1, -2}}, joule{1, {2, 1, -2}}, radian{1, {0, 0, 0, 1}};
    const auto times = [](double factor, Unit unit) {
      unit.si *= factor;
      return unit;
    };
    const Unit degrees = times(degree, radian), inch = times(0.0254, metre), hour = times(3600, second);
    std::map<std::string, Unit> table{{"%", {0.01, {}}},
                                      {"percent", {0.01, {}}},
                                      {"min", times(60, second)},
                                      {"h", hour},
                                      {"hour", hour},
                                      {"day", times(24, hour)},
                                      {"t", times(1e6, gram)},
                                      {"psi", times(6894.757293168361, pascal)},
                                      {"in", inch},
                                      {"inch", inch},
                                      {"inches", inch},
                                      {"ft", times(12, inch)},
                                      {"Hz", {1, {0, 0, -1}}},
                                      {"°", degrees},
                                      {"deg", degrees},
                                      {"degree", degrees},
                                      {"degrees", degrees}};
    const std::pair<const char *, double> prefixes[] = {
        {"", 1},     {"p", 1e-12}, {"n", 1e-9}, {"u", 1e-6}, {"µ", 1e-6}, {"m", 1e-3}, {"c", 1e-2},
        {"d", 1e-1}, {"h", 1e2},   {"k", 1e3},  {"M", 1e6},  {"G", 1e9},  {"T", 1e12}};
    const std::pair<const char *, Unit> metric[] = {{"m", metre},  {"g", gram},    {"s", second},
                                                    {"N", newton}, {"Pa", pascal}, {"bar", bar},
                                                    {"J", joule},  {"rad", radian}};
    for (const auto &[prefix, factor] : prefixes)
      for (const auto &[name, unit] : metric)
        table.emplace(std::string(prefix) + name, times(factor, unit));
    return table;
  }();
  return all;
}

// One name with its power: "mm", "m3", "s^-1"; none where it is not known.
std::optional<Unit> factor_of(std::string name) {
  int power = 1;
  if (name.size() > 1 && name.back() >= '0' && name.back() <= '9') {
    power = name.back() - '0';
    name.pop_back();
    if (name.back() == '-') power = -power, name.pop_back();
    if (!name.empty() && name.back() == '^') name.pop_back();
  }
  const auto found = units().find(name);
  if (found == units().end()) return std::nullopt;
  Unit unit = found->second;
  unit.si = std::pow(unit.si, power);
  for (int &exponent : unit.of)
    exponent *= power;
  return unit;
}

// Names with signs between them: "kg/m3", "kg m-3", "1/s"; none where one is not known.
std::optional<Unit> unit_of(const std::string &text) {
  Unit whole;
  for (std::size_t at = text.compare(0, 2, "1/") == 0 ? 1 : 0; at < text.size();) {
    const std::size_t begin = std::min(text.find_first_not_of("/*. ", at), text.size()),
                      end = std::min(text.find_first_of("/*. ", begin), text.size());
    const std::string sign = trimmed(text.substr(at, begin - at));
    const std::optional<Unit> factor = factor_of(text.substr(begin, end - begin));
    if (!factor || sign.size() > 1) return std::nullopt;
    const bool divides = sign == "/";
    whole.si = divides ? whole.si / factor->si : whole.si * factor->si;
    for (std::size_t k = 0; k < whole.of.size(); ++k)
      whole.of[k] += divides ? -factor->of[k] : factor->of[k];
    at = end;
  }
  return whole;
}

// What a unit measures, in words, with an example and what is usual.
struct Dimension {
  std::string si_unit, name, example;
  std::vector<std::string> usual;
};

const Dimension &dimension(const std::string &si_unit) {
  static const std::vector<Dimension> known{
      {"1", "a plain number", "0.5", {"%", "percent"}},
      {"m", "a length", "1.25 mm", {"mm", "m", "cm", "km", "um", "nm", "inch"}},
      {"m/s", "a speed", "0.03 mm/ms", {"mm/s", "m/s", "mm/ms", "um/s", "mm/min", "km/h"}},
      {"s", "a time", "0.1 ms", {"ms", "s", "us", "ns", "min", "h"}},
      {"Pa", "a pressure", "8.9 MPa", {"MPa", "GPa", "kPa", "Pa", "TPa", "N/mm2", "kN/m2", "bar", "psi"}},
      {"kg/m3", "a density", "2400 kg/m3", {"kg/m3", "g/cm3", "t/m3"}},
      {"N", "a force", "1.5 kN", {"kN", "N", "MN"}},
      {"N/m", "a stiffness", "50 kN/m", {"N/m", "kN/m", "MN/m", "N/mm", "kN/mm"}},
      {"kg", "a mass", "2 kg", {"kg", "g", "t"}},
      {"J/m2", "a fracture energy", "50 J/m2", {"J/m2", "N/m", "N/mm"}},
      {"rad", "an angle", "30 degree", {"degree", "rad"}},
      {"degree", "an angle", "30 degree", {"degree", "rad"}}};
  static const Dimension other{"", "a quantity", "", {}};
  for (const Dimension &one : known)
    if (one.si_unit == si_unit) return one;
  return other;
}

} // namespace

NumberWithUnit split_number(const std::string &text) {
  const std::string stripped = trimmed(text);
  if (stripped.empty()) throw ValueError("has no value");
  const bool plus = stripped[0] == '+' && stripped.size() > 1 && stripped[1] != '-';
  const char *first = stripped.data() + (plus ? 1 : 0), *last = stripped.data() + stripped.size();
  NumberWithUnit number;
  const auto [end, failure] = std::from_chars(first, last, number.value);
  if (failure == std::errc::result_out_of_range) throw ValueError("is too large or too small for a number");
  if (failure != std::errc()) throw ValueError("is not a number");
  if (!std::isfinite(number.value)) throw ValueError("is not a finite number");
  if (end != last && *end == ',')
    throw ValueError("is not a number: the decimal sign is a point, not a comma");
  number.unit = with_micro_sign(trimmed(std::string(end, last)));
  return number;
}

double to_si(const NumberWithUnit &number, const std::string &si_unit) {
  if (number.unit.empty()) return number.value;
  const std::optional<Unit> given = unit_of(number.unit), wanted = si_unit == "1" ? Unit() : unit_of(si_unit);
  if (!wanted) throw std::logic_error("unknown unit in the table of parameters: " + si_unit);
  const Dimension &meant = dimension(si_unit);
  if (!given) {
    const std::string near = nearest_word(number.unit, meant.usual);
    throw ValueError("has the unit \"" + number.unit + "\", which is not known" +
                     (near.empty() ? "" : ". Did you mean \"" + near + "\"?"));
  }
  if (given->of != wanted->of)
    throw ValueError("has the unit \"" + number.unit + "\", which is not that of " + meant.name +
                     (si_unit == "1" ? "" : " (" + si_unit + ")") +
                     (meant.example.empty() ? "" : ", e.g. " + meant.example));
  const double converted = number.value * (given->si / wanted->si);
  if (!std::isfinite(converted)) throw ValueError("is not a finite number");
  return converted;
}

double to_si(const std::string &text, const std::string &si_unit) {
  return to_si(split_number(text), si_unit);
}

std::string in_usual_unit(double value, const std::string &si_unit, const std::string &between) {
  const bool pressure = si_unit == "Pa", length = si_unit == "m";
  const std::string unit = pressure ? "MPa" : length ? "mm" : si_unit;
  std::array<char, 40> number{};
  std::snprintf(number.data(), number.size(), "%.12g", value * (pressure ? 1e-6 : length ? 1e3 : 1));
  return number.data() + (unit.empty() ? "" : between + unit);
}

} // namespace platen::apps
