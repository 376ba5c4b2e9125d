#include "apps/scene/units.h"

#include <locale.h>
#include <udunits2.h>
#include <clocale>

#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <memory>
#include <string_view>
#include <vector>

#include "apps/scene/parameters.h"
#include "base/characters.h"

namespace platen::apps {
namespace {

struct FreeUnit {
  void operator()(ut_unit *unit) const { ut_free(unit); }
};
struct FreeConverter {
  void operator()(cv_converter *converter) const { cv_free(converter); }
};
using Unit = std::unique_ptr<ut_unit, FreeUnit>;
using Converter = std::unique_ptr<cv_converter, FreeConverter>;

// UDUNITS reads decimal numbers with strtod, in its data file and in units: a comma locale would misread
// them.
class PlainNumbers {
public:
  PlainNumbers() : plain_(newlocale(LC_NUMERIC_MASK, "C", nullptr)), former_(uselocale(plain_)) {}
  ~PlainNumbers() {
    uselocale(former_);
    freelocale(plain_);
  }
  PlainNumbers(const PlainNumbers &) = delete;
  PlainNumbers &operator=(const PlainNumbers &) = delete;

private:
  locale_t plain_, former_;
};

ut_system *unit_system() {
  static ut_system *const system = [] {
    ut_set_error_message_handler(ut_ignore);
    ut_system *read = ut_read_xml(nullptr);
    if (read == nullptr) throw std::runtime_error("the data of UDUNITS-2 (udunits2.xml) cannot be read");
    const Unit degree(ut_get_unit_by_name(read, "degree"));
    ut_map_name_to_unit("deg", UT_ASCII, degree.get()); // usual, and unknown to UDUNITS
    return read;
  }();
  return system;
}

bool known_name(const std::string &name) {
  return Unit(ut_get_unit_by_name(unit_system(), name.c_str())) ||
         Unit(ut_get_unit_by_symbol(unit_system(), name.c_str()));
}

// UDUNITS takes any number of prefixes, so that a slip such as "mmm" would be a micrometre: one is the limit.
bool one_prefix_at_most(const std::string &name) {
  if (known_name(name)) return true;
  static constexpr std::string_view prefixes[] = {
      "tera", "giga", "mega", "kilo", "hecto", "deca", "deci", "centi", "milli", "micro", "nano",
      "pico", "T",    "G",    "M",    "k",     "h",    "da",   "d",     "c",     "m",     "u",
      "µ",    "n",    "p",    "f",    "femto", "E",    "P",    "peta",  "exa",   "a"};
  for (const std::string_view prefix : prefixes)
    if (name.size() > prefix.size() && name.compare(0, prefix.size(), prefix) == 0 &&
        known_name(name.substr(prefix.size())))
      return true;
  return false;
}

bool part_of_name(char c) {
  return std::string_view("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_%'\"").find(c) !=
             std::string_view::npos ||
         (static_cast<unsigned char>(c) & 0x80) != 0; // beyond ASCII: micro sign, degree sign
}

// A unit is made of names, powers and the signs between them; digits stand only as powers, because "m 5"
// would be five metres to UDUNITS.
bool well_formed(const std::string &unit) {
  std::string name;
  char before = ' ';
  for (std::size_t k = 0; k <= unit.size(); ++k) {
    const char c = k < unit.size() ? unit[k] : ' ';
    if (part_of_name(c)) {
      if (before >= '0' && before <= '9') return false;
      name += c;
    } else {
      if (!name.empty() && !one_prefix_at_most(name)) return false;
      name.clear();
      const bool digit = c >= '0' && c <= '9';
      if (digit && !part_of_name(before) &&
          std::string_view("^-+0123456789").find(before) == std::string_view::npos)
        return false;
      if (!digit && std::string_view(" */.^()-+").find(c) == std::string_view::npos) return false;
    }
    before = c;
  }
  return true;
}

Unit parse_unit(const std::string &unit) {
  if (!well_formed(unit)) return nullptr;
  return Unit(ut_parse(unit_system(), unit.c_str(), UT_UTF8));
}

// UDUNITS treats the radian as a plain number; its definition still names it.
bool is_angle(const ut_unit *unit) {
  std::array<char, 256> text{};
  const int length = ut_format(unit, text.data(), text.size(), UT_ASCII | UT_DEFINITION);
  return length > 0 && std::string_view(text.data()).find("rad") != std::string_view::npos;
}

struct Dimension {
  const char *name, *example;
};

const Dimension &dimension(const std::string &si_unit) {
  static const std::map<std::string, Dimension> dimensions = {{"1", {"a plain number", "0.5"}},
                                                              {"m", {"a length", "1.25 mm"}},
                                                              {"m2", {"an area", "4 mm2"}},
                                                              {"m/s", {"a speed", "0.03 mm/ms"}},
                                                              {"s", {"a time", "0.1 ms"}},
                                                              {"Pa", {"a pressure", "8.9 MPa"}},
                                                              {"kg/m3", {"a density", "2400 kg/m3"}},
                                                              {"N", {"a force", "1.5 kN"}},
                                                              {"N/m", {"a stiffness", "50 kN/m"}},
                                                              {"rad", {"an angle", "30 degree"}},
                                                              {"degree", {"an angle", "30 degree"}},
                                                              {"J", {"an energy", "1 J"}}};
  static const Dimension other = {"a quantity", ""};
  const auto found = dimensions.find(si_unit);
  return found == dimensions.end() ? other : found->second;
}

// The usual unit of a dimension that is written alike, capitals aside: "GPa" of "Gpa"; "" where none is.
std::string nearest_unit(const std::string &unit, const std::string &si_unit) {
  static const std::map<std::string, std::vector<std::string>> usual = {
      {"1", {"%", "percent"}},
      {"m", {"mm", "m", "cm", "km", "um", "nm", "inch"}},
      {"m2", {"mm2", "cm2", "m2"}},
      {"m/s", {"mm/s", "m/s", "mm/ms", "um/s", "mm/min", "km/h"}},
      {"s", {"ms", "s", "us", "ns", "min", "h"}},
      {"Pa", {"MPa", "GPa", "kPa", "Pa", "TPa", "N/mm2", "kN/m2", "bar", "psi"}},
      {"kg/m3", {"kg/m3", "g/cm3", "t/m3"}},
      {"N", {"kN", "N", "MN"}},
      {"N/m", {"N/m", "kN/m", "MN/m", "N/mm", "kN/mm"}},
      {"kg", {"kg", "g", "t"}},
      {"J/m2", {"J/m2", "N/m", "N/mm"}},
      {"rad", {"degree", "rad"}},
      {"degree", {"degree", "rad"}}};
  const auto found = usual.find(si_unit);
  return found == usual.end() ? "" : nearest_word(unit, found->second);
}

// In words, for messages: "a pressure (Pa)".
std::string name_of_dimension(const std::string &si_unit) {
  return std::string(dimension(si_unit).name) + (si_unit == "1" ? "" : " (" + si_unit + ")");
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
  const PlainNumbers guard;
  const Unit wanted(ut_parse(unit_system(), si_unit.c_str(), UT_UTF8)), given = parse_unit(number.unit);
  if (!wanted) throw std::logic_error("unknown unit in the table of parameters: " + si_unit);
  if (!given) {
    const std::string near = nearest_unit(number.unit, si_unit);
    throw ValueError("has the unit \"" + number.unit + "\", which is not known" +
                     (near.empty() ? "" : ". Did you mean \"" + near + "\"?"));
  }
  if (!ut_are_convertible(given.get(), wanted.get()) || is_angle(given.get()) != is_angle(wanted.get())) {
    const std::string example = dimension(si_unit).example;
    throw ValueError("has the unit \"" + number.unit + "\", which is not that of " +
                     name_of_dimension(si_unit) + (example.empty() ? "" : ", e.g. " + example));
  }
  const Converter converter(ut_get_converter(given.get(), wanted.get()));
  const double converted = cv_convert_double(converter.get(), number.value);
  if (!std::isfinite(converted)) throw ValueError("is not a finite number");
  return converted;
}

double to_si(const std::string &text, const std::string &si_unit) {
  return to_si(split_number(text), si_unit);
}

} // namespace platen::apps
