#include "apps/calibrate/target.h"

#include <fmt/format.h>

#include <algorithm>

#include "apps/run/figures.h"
#include "apps/scene/texts.h"
#include "apps/scene/units.h"
#include "apps/scene/values.h"

namespace platen::apps {

const char *const target_allowed =
    "FIGURE [at Section/Key = value, ...] [over Section/Key = value, ...]: VALUE [+- TOLERANCE]; FIGURE: "
    "young modulus, poisson ratio, tension, splitting, curve 1, or a number of summary.json";

namespace {

// In tension and in splitting specimens fail at smaller strains, and splitting is slower.
constexpr double tension_strain = 0.25, splitting_strain = 0.5, splitting_rate = 0.25;
// Mean radii of a disc's ends that are ground off; of strips in the diameter.
constexpr double disc_end_layer = 1, strips_across = 10;

// What a line wants by its first words, of which tests, and how it is called. Any other figure is so by its
// own name.
struct Wanted {
  const char *word;
  TargetKind kind;
  const char *figure, *program, *key, *name;
};
constexpr const char *of_a_curve = "curve ", *pressure_entry = "Loading/Confining pressure = ";
constexpr Wanted all_wanted[] = {
    {"young modulus", TargetKind::young_modulus, "youngs_modulus_gauge_pa", "", "youngs_modulus_gauge_pa",
     "Young's modulus"},
    {"poisson ratio", TargetKind::poisson_ratio, "poisson_ratio", "", "poisson_ratio", "Poisson's ratio"},
    {"strength_pa", TargetKind::strength, "strength_pa", "compress", "compressive_strength_pa",
     "compressive strength"},
    {"tension", TargetKind::tension, "strength_pa", "compress", "tensile_strength_pa", "tensile strength"},
    {"splitting", TargetKind::tension, "strength_pa", "brazilian", "splitting_strength_pa",
     "splitting strength"},
    {"strain_at_peak_platen", TargetKind::strain_at_peak, "strain_at_peak_platen", "compress",
     "strain_at_peak_platen", "strain at peak"},
    {"poisson_ratio", TargetKind::secant_ratio, "poisson_ratio", "compress", "secant_poisson_ratio",
     "secant Poisson's ratio"},
    {of_a_curve, TargetKind::curve, "", "compress", "curve_miss", "miss of the curve"}};

// What stands in front of `mark`, which both lose; all of it where there is no mark.
std::string before(std::string &text, const std::string &mark) {
  const std::size_t place = text.find(mark);
  const std::string first = tidy(text.substr(0, place));
  text = place == std::string::npos ? "" : tidy(text.substr(place + mark.size()));
  return first;
}

std::string unit_of_figure(const std::string &key) {
  std::vector<std::string> keys;
  for (const Figure &figure : figures())
    if (figure.is_number() && (figure.needs & of_machine) == 0) {
      if (figure.key == key) return figure.unit;
      keys.push_back(figure.key);
    }
  throw ValueError("names no figure, \"" + key + "\"." + did_you_mean(key, keys));
}

// The first ones but for paths that the others set too, then these.
std::vector<std::string> replaced(const std::vector<std::string> &entries,
                                  const std::vector<std::string> &by) {
  std::vector<std::string> all;
  for (const std::string &one : entries)
    if (!sets(by, one.substr(0, one.find(" =")))) all.push_back(one);
  all.insert(all.end(), by.begin(), by.end());
  return all;
}

// Entries that `others` do not have, without their sections: "Friction static = 0".
std::string changes_of(const std::vector<std::string> &entries, const std::vector<std::string> &others) {
  std::string text;
  for (const std::string &one : entries)
    if (std::find(others.begin(), others.end(), one) == others.end())
      text += (text.empty() ? "" : ", ") + one.substr(one.rfind('/', one.find(" =")) + 1);
  return text;
}

// Absolute, in the unit of the value, or relative: "5 %", "0.05".
double read_tolerance(const std::string &text, const std::string &unit, double value) {
  double tolerance = 0;
  try {
    tolerance = read_quantity(text, "1", above_up_to(0, 0.5));
  } catch (const ValueError &) {
    if (unit.empty() || unit == "1" || text.find('%') != std::string::npos) throw;
    tolerance = read_quantity(text, unit, above(0)) / std::abs(value);
  }
  if (!(tolerance <= 0.5)) throw ValueError("has a tolerance above half of the value");
  return tolerance;
}

} // namespace

bool sets(const std::vector<std::string> &entries, const std::string &path) {
  return std::any_of(entries.begin(), entries.end(),
                     [&](const std::string &one) { return one.rfind(path + " =", 0) == 0; });
}

Target target_of(const std::string &what) {
  Target to;
  std::string word = what;
  if (what.rfind(of_a_curve, 0) == 0) {
    word = of_a_curve;
    to.curve_file = static_cast<int>(read_integer(what.substr(word.size()), between(1, most_curves)));
  }
  for (const Wanted &one : all_wanted)
    if (word == one.word) {
      to.kind = one.kind, to.figure = one.figure, to.program = one.program;
      to.key = one.key, to.name = one.name;
      return to;
    }
  to.kind = TargetKind::other;
  to.figure = to.key = to.name = what;
  return to;
}

Target read_target(const std::string &line) {
  if (line.empty()) return {};
  std::string rest = tidy(line);
  std::string test = before(rest, ":"), value = before(rest, "+-"), tolerance = rest;
  std::string over = test;
  std::string at = before(over, " over "); // `over` keeps what follows
  Target to = target_of(before(at, " at "));
  const bool curve = to.kind == TargetKind::curve;
  std::string unit = curve ? "" : unit_of_figure(to.figure);
  to.entries = read_assignments(at, true);
  if (!over.empty()) to.over = replaced(to.entries, read_assignments(over, true));
  if (to.is_elastic() && !(at.empty() && over.empty()))
    throw ValueError(
        "sets entries of a static solve, which has none. Allowed: at and over with other figures");
  if (to.kind == TargetKind::tension && !over.empty())
    throw ValueError(
        "divides tension or splitting by another test. Allowed: strength_pa at Loading/Test = tension, "
        "... over ...");
  if (curve && !(value.empty() && to.over.empty()))
    throw ValueError(
        "gives a curve one value, or something that it is over. Allowed: curve 1 at ...: +- 5 %");
  if (!to.over.empty()) {
    to.kind = TargetKind::ratio, unit = "1", to.key = to.figure + "_ratio";
    to.name =
        (to.figure == "strength_pa" ? "strength" : to.figure) + " over " + changes_of(to.over, to.entries);
  }
  for (const std::string &one : to.entries)
    if (to.kind == TargetKind::strength && one.rfind(pressure_entry, 0) == 0) {
      to.kind = TargetKind::strength_at_pressure, to.key = "triaxial_strength_pa";
      to.name = "strength at " + one.substr(std::string(pressure_entry).size());
    }
  if (!curve) {
    if (value.empty()) throw ValueError("has no value");
    const bool poisson = to.figure == "poisson_ratio" && to.over.empty();
    to.value = Quantity(to.figure, unit, poisson ? between_open(to.is_elastic() ? -1 : 0, 0.5) : above(0))
                   .read(value);
  }
  if (!tolerance.empty()) to.tolerance = read_tolerance(tolerance, unit, to.value);
  to.text = tidy(line);
  return to;
}

void complete_test(Target &to, const Scene &scene, double tension_rate) {
  if (to.kind != TargetKind::tension) return;
  const SpecimenSection &s = scene.specimen;
  const Loading &l = scene.loading;
  const auto add = [&](const std::string &path, const std::string &value) {
    if (!sets(to.entries, path)) to.entries.push_back(path + " = " + value);
  };
  const auto add_number = [&](const std::string &path, double value, const char *unit) {
    if (given(value)) add(path, shortest_text(value) + unit); // else its reader says that it is missing
  };
  if (to.program == "compress") {
    add("Loading/Test", "tension");
    add("Platens/Attachment", "glued");
    add_number("Loading/Axial rate", tension_rate, " m/s");
    add_number("Loading/Target strain", tension_strain * l.target_strain, "");
    return;
  }
  add("Specimen/Shape", "disc");
  add_number("Specimen/Height", s.radius, " m");
  if (are_ground(s.ends)) add_number("Specimen/End layer", disc_end_layer, "");
  add_number("Loading/Axial rate", l.rate * splitting_rate * s.width() / s.height, " m/s");
  add_number("Loading/Target strain", splitting_strain * l.target_strain, "");
  if (!(scene.platens.strip_width > 0)) add_number("Platens/Strip width", s.width() / strips_across, " m");
}

double Target::unit() const {
  if (kind == TargetKind::ratio || kind == TargetKind::curve) return 1;
  if (figure.rfind("strain", 0) == 0) return 1e-3;
  if (figure.rfind("youngs_modulus", 0) == 0) return 1e9;
  const std::string pascal = "_pa";
  return figure.size() > pascal.size() && figure.substr(figure.size() - pascal.size()) == pascal ? 1e6 : 1;
}

std::string Target::words() const {
  const char *units = unit() == 1e9 ? ", GPa" : unit() == 1e6 ? ", MPa" : unit() == 1e-3 ? ", mm/m" : "";
  return (number > 0 ? fmt::format("({}) ", number) : "") + name + units;
}

} // namespace platen::apps
