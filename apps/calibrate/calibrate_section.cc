// What platen-calibrate looks for: keys for the common numbers, and lines for all others.
#include "apps/calibrate/calibrate_section.h"

#include <algorithm>
#include <cmath>

#include "apps/calibrate/choice.h"
#include "apps/scene/members.h"
#include "apps/scene/scene_check.h"
#include "apps/scene/units.h"
#include "apps/scene/values.h"

namespace platen::apps {
namespace {

// "tensile strength, friction angle": words of free_parameters, each once; "" is none.
std::vector<FreeParameter> read_free_parameters(const std::string &text) {
  std::vector<std::string> words;
  for (const auto &one : free_parameters)
    words.push_back(one.first);
  std::vector<FreeParameter> free;
  return read_items<FreeParameter>(text, [&](const std::string &item) {
    const FreeParameter parameter = free_parameters[read_word(item, words)].second;
    if (std::find(free.begin(), free.end(), parameter) != free.end()) throw ValueError("is there twice");
    free.push_back(parameter);
    return parameter;
  });
}

// "Contact/Rolling friction: 0.01 ... 0.5"; "" frees nothing. Its numbers are read when all is.
FreedEntry read_freed(const std::string &text) {
  if (text.empty()) return {};
  const std::size_t colon = text.find(':'), dots = text.find("...");
  const std::string path = tidy(text.substr(0, colon));
  if (colon == std::string::npos || dots == std::string::npos || path.find('/') == std::string::npos)
    throw ValueError("frees no entry: \"Section/Key: low ... high\" does");
  FreedEntry freed;
  freed.path = path, freed.from = tidy(text.substr(colon + 1, dots - colon - 1));
  freed.to = tidy(text.substr(dots + 3));
  if (freed.from.empty() || freed.to.empty()) throw ValueError("has no bound on one side");
  return freed;
}

void declare_lines(Section &section, Calibrate &c) {
  for (std::size_t k = 0; k < c.lines.size(); ++k)
    section.value("Target " + std::to_string(k + 1), c.lines[k], "", target_allowed, read_target,
                  "A figure of a test and what it is to be; at: what its test sets in this scene; over: what "
                  "another one sets, by whose figure it is divided. Tolerance: relative, or in the figure's "
                  "unit; Calibrate/Tolerance where it is left out.");
  for (std::size_t k = 0; k < c.curves.size(); ++k)
    section.file(
        "Curve " + std::to_string(k + 1), c.curves[k],
        "Of a target \"curve " + std::to_string(k + 1) +
            "\": CSV with a header, strain_platen or strain_gauge and stress_pa or stress_mpa, a row a "
            "point, from small strains to large, compression positive.");
  for (std::size_t k = 0; k < c.entries.size(); ++k)
    section.value("Parameter " + std::to_string(k + 1), c.entries[k], "", "Section/Key: low ... high",
                  read_freed,
                  "A number of the scene that the search may change, and its bounds; it begins with that of "
                  "the scene.");
}

void declare_calibrate(Parameters &parameters, Scene &scene) {
  Calibrate &c = scene.own<Calibrate>();
  Section section(parameters, "Calibrate");
  auto &parallel = range_of<dem::ParallelBond::Parameters>;
  const Range multipliers = range_of<dem::BondLayout>("radius_multiplier");
  section.entry("Mode", c.mode, calibrate_modes,
                "Estimates at once, a table of elastic moduli, or parameters that meet targets.");
  section.entry("Young modulus", c.young_modulus, "Pa", above(0),
                "Wanted of the specimen's middle; may be left out.");
  section.number("Poisson ratio", c.poisson_ratio, between_open(-1, 0.5),
                 "Wanted of the specimen's middle; may be left out.");
  section.entry("Compressive strength", c.compressive_strength, "Pa", above(0),
                "Wanted between the platens of the scene; may be left out.");
  section.entry("Tensile strength", c.tensile_strength, "Pa", above(0),
                "Wanted between glued ends; may be left out.");
  section.entry("Triaxial strength", c.triaxial_strength, "Pa", above(0),
                "Wanted at the confining pressure, as largest axial stress (the pressure included); may be "
                "left out.");
  section.entry("Confining pressure", c.confining_pressure, "Pa", above(0),
                "Of the triaxial strength; it acts as Loading/Confinement = particles.");
  section.integer("Seeds", c.seeds, 1, 1000, "Packings to calibrate on: Scene/Seed and those after it.");
  section.integer("Verification seeds", c.verification_seeds, 0, 1000,
                  "Packings after those, on which what was found is judged.");
  section.number("Strain", c.strain, above_up_to(0, 0.01), "Closure over height in the static solves.");
  section.entry("Tension rate", c.tension_rate, "m/s", above(0),
                "Speed of opening in tension tests; where not given, Loading/Axial rate times the target of "
                "tensile over that of compressive strength (a tenth where one is missing).");
  std::string words;
  for (const auto &one : free_parameters)
    words += (words.empty() ? "" : ", ") + one.first;
  section.value("Free", c.free, "", "with commas between them, any of " + words, read_free_parameters,
                "What the search may change; empty: what the targets need. The tensile strength carries a "
                "shear strength along that is not named; the compression limits have one factor.");
  section.entry("Differences", c.differences,
                "Before the search, one trial for each parameter that it may change: sensitivities are "
                "measured, not begun from those of one concrete.");
  section.integer("Most trials", c.most_trials, 1, 1000, "Sets of parameters that are tried.");
  section.number("Tolerance", c.tolerance, above_up_to(0, 0.5),
                 "Relative difference that is near enough, of targets that say nothing else; all within "
                 "theirs end the search.");
  section.entry("Modulus list", c.moduli, "Pa", above(0), "Abacus; empty: Bond/Modulus.");
  section.entry("Stiffness ratio list", c.stiffness_ratios, "1", parallel("stiffness_ratio"),
                "Abacus; empty: Bond/Stiffness ratio (parallel bond).");
  section.entry("Radius multiplier list", c.radius_multipliers, "1", multipliers,
                "Abacus; empty: Bond/Radius multiplier.");
  section.entry("Poisson ratio list", c.poisson_ratios, "1",
                range_of<dem::CohesiveBeam::Parameters>("poisson_ratio"),
                "Abacus; empty: Bond/Poisson ratio (cohesive beam).");
  section.number("Smallest stiffness ratio", c.ratio_low, above_up_to(0, 5),
                 "Search for Poisson's ratio (parallel bond).");
  section.number("Largest stiffness ratio", c.ratio_high, above_up_to(0, 5),
                 "Search for Poisson's ratio (parallel bond).");
  section.number("Smallest radius multiplier", c.multiplier_low, multipliers,
                 "Search for Poisson's ratio (cohesive beam).");
  section.number("Largest radius multiplier", c.multiplier_high, multipliers,
                 "Search for Poisson's ratio (cohesive beam).");
  section.number("Smallest moment contribution", c.moments_low, parallel("moment_contribution"),
                 "Search for strengths (parallel bond, cohesive beam).");
  section.number("Largest moment contribution", c.moments_high, parallel("moment_contribution"),
                 "Search for strengths; where not given, the bond's own.");
  section.number("Smallest shear over tensile strength", c.strengths_low, above_up_to(0, 1000),
                 "Search for compressive over tensile strength.");
  section.number("Largest shear over tensile strength", c.strengths_high, above_up_to(0, 1000),
                 "Search for compressive over tensile strength.");
  section.entry(
      "Smallest friction angle", c.friction_low, "rad", parallel("friction_angle"),
      "Search for strengths (parallel bond, cohesive beam); where not given, the bond's own, or 0 if "
      "a triaxial strength is a target.");
  section.entry("Largest friction angle", c.friction_high, "rad", parallel("friction_angle"),
                "Search for strengths (parallel bond, cohesive beam); where not given, the bond's own, or 60 "
                "degree if a triaxial strength is a target.");
  section.number("Smallest factor of compression limits", c.limits_low, above_up_to(0, 100),
                 "Search, where Calibrate/Free has compression limits: against those of the scene.");
  section.number("Largest factor of compression limits", c.limits_high, above_up_to(0, 100),
                 "Search, where Calibrate/Free has compression limits: against those of the scene.");
  section.number("Smallest contact friction", c.contact_friction_low, between(0, 5),
                 "Search, where Calibrate/Free has contact friction.");
  section.number("Largest contact friction", c.contact_friction_high, between(0, 5),
                 "Search, where Calibrate/Free has contact friction.");
  declare_lines(section, c);
}

// Of the wanted tensile over compressive strength where both are wanted of the scene.
double tension_rate(const Scene &scene, const std::vector<Target> &targets) {
  const Calibrate &c = calibrate_of(scene);
  if (given(c.tension_rate)) return c.tension_rate;
  double compressive = not_given, tensile = not_given;
  for (const Target &target : targets) {
    if (target.kind == TargetKind::strength && std::isnan(compressive)) compressive = target.value;
    if (target.key() == "tensile_strength_pa" && std::isnan(tensile)) tensile = target.value;
  }
  const double ratio = tensile / compressive;
  return scene.loading.rate * (std::isnan(ratio) ? 0.1 : ratio);
}

// The keys of Calibrate as targets, then the lines in their order.
std::vector<Target> targets_of(Parameters &parameters, const Scene &scene) {
  const Calibrate &c = calibrate_of(scene);
  std::vector<Target> all;
  const auto add = [&](Target target, const std::string &key) {
    target.entry = "Calibrate/" + key;
    if (std::isnan(target.tolerance)) target.tolerance = c.tolerance;
    all.push_back(std::move(target));
  };
  if (given(c.young_modulus))
    add(elastic_target(TargetKind::young_modulus, c.young_modulus), "Young modulus");
  if (given(c.poisson_ratio))
    add(elastic_target(TargetKind::poisson_ratio, c.poisson_ratio), "Poisson ratio");
  if (given(c.compressive_strength)) add(strength_target(c.compressive_strength), "Compressive strength");
  if (given(c.tensile_strength)) add(tension_target(c.tensile_strength), "Tensile strength");
  if (given(c.triaxial_strength))
    add(strength_target(c.triaxial_strength, c.confining_pressure), "Triaxial strength");
  for (std::size_t k = 0; k < c.lines.size(); ++k) {
    if (c.lines[k].text.empty()) continue;
    Target target = c.lines[k];
    target.number = static_cast<int>(k + 1);
    if (target.curve > 0)
      target.file = resolved_path(parameters.at("Calibrate/Curve " + std::to_string(target.curve)));
    add(target, "Target " + std::to_string(k + 1));
  }
  for (Target &target : all)
    complete_test(target, scene, tension_rate(scene, all));
  return all;
}

// Its bounds and what it begins with, in the unit of the entry.
FreedEntry completed(Parameters &parameters, FreedEntry freed, const std::string &key) {
  const Entry *entry = parameters.find(freed.path);
  if (entry == nullptr || entry->is_text || entry->is_file || !entry->words.empty() ||
      entry->allowed.rfind("whole", 0) == 0 || freed.path.rfind("Calibrate/", 0) == 0)
    parameters.refuse(key,
                      "frees " + freed.path + ", which is no number of this scene that may take any value.");
  for (const auto &[word, parameter] : free_parameters)
    if (facts_of(Calibrate(), parameter).entry == freed.path)
      parameters.refuse(key, "is what Calibrate/Free = " + word + " names.");
  freed.unit = entry->unit.empty() ? "1" : entry->unit;
  const auto read = [&](const std::string &text, const std::string &what) {
    try {
      return read_quantity(text, freed.unit, Range());
    } catch (const ValueError &error) {
      parameters.refuse(key, "has " + what + ", \"" + text + "\", that " + error.what() + ".");
    }
  };
  for (const std::string &bound : {freed.from, freed.to, entry->text})
    try {
      entry->read(bound); // the last one is what the scene has
    } catch (const ValueError &error) {
      entry->read(entry->text);
      parameters.refuse(key,
                        "has a bound, \"" + bound + "\", that " + error.what() + " of " + freed.path + ".");
    }
  freed.low = read(freed.from, "a bound"), freed.high = read(freed.to, "a bound");
  freed.own = read(entry->text, "an entry to begin with");
  if (!(freed.low < freed.high)) parameters.refuse(key, "has a low bound that is not below the high one.");
  if (!(freed.own >= freed.low && freed.own <= freed.high))
    parameters.refuse(key,
                      "does not hold what the scene begins with, " + freed.path + " = " + entry->text + ".");
  return freed;
}

void complete(Parameters &parameters, Scene &scene) {
  Calibrate &c = scene.own<Calibrate>();
  c.targets = targets_of(parameters, scene);
  for (std::size_t k = 0; k < c.entries.size(); ++k)
    if (!c.entries[k].path.empty())
      parameters.attempt([&] {
        c.freed.push_back(
            completed(parameters, c.entries[k], "Calibrate/Parameter " + std::to_string(k + 1)));
      });
  double &modulus = scene.model.bond_layout.modulus;
  if (c.mode == CalibrateMode::abacus && std::isnan(modulus) && !c.moduli.empty()) modulus = c.moduli.front();
}

// A search for strengths begins with those of the scene; static solves break no bond. Targets have rates of
// their own, or are checked for it.
bool gives(const Scene &scene, const Parameters & /*parameters*/, const std::string &path) {
  const Calibrate &c = calibrate_of(scene);
  if (path == "Bond/Tensile strength") return !c.searches_strengths();
  if (path == "Bond/Modulus") return c.mode == CalibrateMode::abacus && !c.moduli.empty();
  return false;
}

bool uses(const Scene &scene, const std::string &) {
  return calibrate_of(scene).searches_strengths();
}

} // namespace

Program calibrate_program() {
  Program p;
  p.name = "platen-calibrate";
  p.purpose = "Calibrates bonds and other parameters on figures of any tests.";
  p.section = "Calibrate";
  p.declare = declare_calibrate;
  p.complete = complete;
  p.check = check_calibrate;
  p.gives = gives;
  p.uses = uses;
  return p;
}

} // namespace platen::apps
