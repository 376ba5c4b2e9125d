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

bool has_entry(const std::vector<std::string> &entries, const std::string &path) {
  return std::any_of(entries.begin(), entries.end(),
                     [&](const std::string &one) { return one.rfind(path + " =", 0) == 0; });
}

// The first ones but for paths that the others set too, then these.
std::vector<std::string> replaced(const std::vector<std::string> &entries,
                                  const std::vector<std::string> &by) {
  std::vector<std::string> all;
  for (const std::string &one : entries)
    if (!has_entry(by, one.substr(0, one.find(" =")))) all.push_back(one);
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

// What is measured: the figure, its test, its unit.
std::string read_figure(const std::string &what, Target &to) {
  if (what == "young modulus" || what == "poisson ratio") {
    const bool young = what == "young modulus";
    to = elastic_target(young ? TargetKind::young_modulus : TargetKind::poisson_ratio, not_given);
    return young ? "Pa" : "1";
  }
  if (what == "tension" || what == "splitting") {
    to.kind = TargetKind::tension;
    if (what == "splitting") to.program = "brazilian";
    return "Pa";
  }
  if (what.rfind("curve ", 0) == 0) {
    to.kind = TargetKind::curve, to.figure = "";
    to.curve = static_cast<int>(read_integer(what.substr(6), between(1, most_curves)));
    return "";
  }
  to.figure = what;
  const std::string unit = unit_of_figure(what);
  if (what == "strain_at_peak_platen")
    to.kind = TargetKind::strain_at_peak;
  else if (what == "poisson_ratio")
    to.kind = TargetKind::secant_ratio;
  else if (what != "strength_pa")
    to.kind = TargetKind::other;
  return unit;
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

Target elastic_target(TargetKind kind, double value) {
  Target to;
  to.kind = kind, to.value = value, to.program = "";
  to.figure = kind == TargetKind::young_modulus ? "youngs_modulus_gauge_pa" : "poisson_ratio";
  return to;
}

Target strength_target(double value, double pressure) {
  Target to;
  to.value = value;
  if (!given(pressure)) return to;
  to.kind = TargetKind::strength_at_pressure;
  to.entries = {"Loading/Confinement = particles",
                "Loading/Confining pressure = " + in_usual_unit(pressure, "Pa")};
  return to;
}

Target tension_target(double value) {
  Target to;
  to.kind = TargetKind::tension, to.value = value;
  return to;
}

Target read_target(const std::string &text) {
  Target to;
  if (text.empty()) return to;
  std::string rest = tidy(text);
  std::string test = before(rest, ":"), value = before(rest, "+-"), tolerance = rest;
  std::string over = test;
  test = before(over, " over "); // `over` keeps what follows
  std::string at = test;
  const std::string what = before(at, " at ");
  const std::string unit = read_figure(what, to);
  to.entries = read_assignments(at, true);
  if (!over.empty()) to.over = replaced(to.entries, read_assignments(over, true));
  if (to.is_elastic() && !(at.empty() && over.empty()))
    throw ValueError(
        "sets entries of a static solve, which has none. Allowed: at and over with other figures");
  if (to.kind == TargetKind::tension && !over.empty())
    throw ValueError(
        "divides tension or splitting by another test. Allowed: strength_pa at Loading/Test = tension, "
        "... over ...");
  if (!to.over.empty())
    to.kind = TargetKind::ratio;
  else if (to.kind == TargetKind::strength && has_entry(to.entries, "Loading/Confining pressure"))
    to.kind = TargetKind::strength_at_pressure;
  const bool curve = to.kind == TargetKind::curve || to.figure.empty();
  if (curve && !(value.empty() && to.over.empty()))
    throw ValueError(
        "gives a curve one value, or something that it is over. Allowed: curve 1 at ...: +- 5 %");
  const bool poisson = to.figure == "poisson_ratio" && to.over.empty();
  const std::string of_value = to.over.empty() ? unit : "1";
  if (!curve) {
    if (value.empty()) throw ValueError("has no value");
    to.value = Quantity(to.figure, of_value, poisson ? between_open(to.is_elastic() ? -1 : 0, 0.5) : above(0))
                   .read(value);
  }
  if (!tolerance.empty()) to.tolerance = read_tolerance(tolerance, of_value, to.value);
  to.text = tidy(text);
  return to;
}

void complete_test(Target &to, const Scene &scene, double tension_rate) {
  if (to.kind != TargetKind::tension) return;
  const SpecimenSection &s = scene.specimen;
  const Loading &l = scene.loading;
  const auto add = [&](const std::string &path, const std::string &value) {
    if (!has_entry(to.entries, path)) to.entries.push_back(path + " = " + value);
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
  if (s.ends == dem::EndPreparation::ground) add_number("Specimen/End layer", disc_end_layer, "");
  add_number("Loading/Axial rate", l.rate * splitting_rate * s.width() / s.height, " m/s");
  add_number("Loading/Target strain", splitting_strain * l.target_strain, "");
  if (!(scene.platens.strip_width > 0)) add_number("Platens/Strip width", s.width() / strips_across, " m");
}

std::string Target::key() const {
  switch (kind) {
    case TargetKind::strength:
      return "compressive_strength_pa";
    case TargetKind::tension:
      return program == "brazilian" ? "splitting_strength_pa" : "tensile_strength_pa";
    case TargetKind::strength_at_pressure:
      return "triaxial_strength_pa";
    case TargetKind::ratio:
      return figure + "_ratio";
    case TargetKind::secant_ratio:
      return "secant_poisson_ratio";
    case TargetKind::curve:
      return "curve_miss";
    default:
      return figure;
  }
}

double Target::unit() const {
  if (kind == TargetKind::ratio || kind == TargetKind::curve) return 1;
  if (figure.rfind("strain", 0) == 0) return 1e-3;
  if (figure.rfind("youngs_modulus", 0) == 0) return 1e9;
  const std::string pascal = "_pa";
  return figure.size() > pascal.size() && figure.substr(figure.size() - pascal.size()) == pascal ? 1e6 : 1;
}

std::string Target::name() const {
  const std::string pressure = "Loading/Confining pressure = ";
  switch (kind) {
    case TargetKind::young_modulus:
      return "Young's modulus";
    case TargetKind::poisson_ratio:
      return "Poisson's ratio";
    case TargetKind::strength:
      return "compressive strength";
    case TargetKind::tension:
      return program == "brazilian" ? "splitting strength" : "tensile strength";
    case TargetKind::strength_at_pressure:
      for (const std::string &one : entries)
        if (one.rfind(pressure, 0) == 0) return "strength at " + one.substr(pressure.size());
      return "triaxial strength";
    case TargetKind::strain_at_peak:
      return "strain at peak";
    case TargetKind::secant_ratio:
      return "secant Poisson's ratio";
    case TargetKind::curve:
      return "miss of the curve";
    default:
      break;
  }
  const std::string what = figure == "strength_pa" ? "strength" : figure;
  return kind == TargetKind::ratio ? what + " over " + changes_of(over, entries) : what;
}

std::string Target::words() const {
  const char *units = unit() == 1e9 ? ", GPa" : unit() == 1e6 ? ", MPa" : unit() == 1e-3 ? ", mm/m" : "";
  return (number > 0 ? fmt::format("({}) ", number) : "") + name() + units;
}

} // namespace platen::apps
