// What platen-calibrate looks for: targets, a line each, and what it may change.
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

std::vector<std::string> words_that_free() {
  std::vector<std::string> words;
  for (const auto &[word, parameter] : free_words())
    words.push_back(word);
  return words;
}

// "tensile strength, friction angle": words of free_words(), each once; "" is none.
std::vector<FreeParameter> read_free_parameters(const std::string &text) {
  const Words<FreeParameter> words = free_words();
  std::vector<FreeParameter> free;
  return read_items<FreeParameter>(text, [&](const std::string &item) {
    const FreeParameter parameter = words[read_word(item, words_that_free())].second;
    if (holds(free, parameter)) throw ValueError("is there twice");
    free.push_back(parameter);
    return parameter;
  });
}

// "Contact/Rolling friction: 0.01 ... 0.5"; "" frees nothing. Its numbers are read when all is.
FreedEntry read_freed(const std::string &text) {
  if (text.empty()) return {};
  const std::size_t colon = text.find(':'), dots = text.find("...");
  FreedEntry freed;
  freed.path = tidy(text.substr(0, colon));
  if (colon == std::string::npos || dots == std::string::npos || freed.path.find('/') == std::string::npos)
    throw ValueError("frees no entry: \"Section/Key: low ... high\" does");
  freed.from = tidy(text.substr(colon + 1, dots - colon - 1)), freed.to = tidy(text.substr(dots + 3));
  if (freed.from.empty() || freed.to.empty()) throw ValueError("has no bound on one side");
  return freed;
}

std::string numbered(const std::string &key, std::size_t k) {
  return key + " " + std::to_string(k + 1);
}

void declare_lines(Section &section, Calibrate &c) {
  for (std::size_t k = 0; k < c.lines.size(); ++k)
    section.value(numbered("Target", k), c.lines[k], "", target_allowed, read_target,
                  "A figure of a test and what it is to be; at: what its test sets in this scene; over: what "
                  "another one sets, by whose figure it is divided. Tolerance: relative, or in the figure's "
                  "unit; Calibrate/Tolerance where it is left out.");
  for (std::size_t k = 0; k < c.curves.size(); ++k)
    section.file(numbered("Curve", k), c.curves[k],
                 "Of a target \"" + numbered("curve", k) +
                     "\": CSV with a header, strain_platen or strain_gauge and stress_pa or stress_mpa, a "
                     "row a point, from small strains to large, compression positive.");
  for (std::size_t k = 0; k < c.entries.size(); ++k)
    section.value(numbered("Parameter", k), c.entries[k], "", "Section/Key: low ... high", read_freed,
                  "A number of the scene that the search may change, and its bounds; it begins with that of "
                  "the scene.");
}

// Smallest and Largest of what is bounded.
void declare_bounds(Section &section, Calibrate &c) {
  const auto pair = [&](FreeParameter parameter, const char *unit, const Range &range, const char *about) {
    Bounds &bounds = c.bounds.at(parameter);
    const std::string key = facts_of(c, parameter).bounded();
    section.entry("Smallest " + key, bounds.low, unit, range, about);
    section.entry("Largest " + key, bounds.high, unit, range, about);
  };
  auto &parallel = range_of<dem::ParallelBond::Parameters>;
  pair(FreeParameter::stiffness_ratio, "1", above_up_to(0, 5), "Search for Poisson's ratio (parallel bond).");
  pair(FreeParameter::radius_multiplier, "1", range_of<dem::BondLayout>("radius_multiplier"),
       "Search for Poisson's ratio (cohesive beam).");
  pair(FreeParameter::moment_contribution, "1", parallel("moment_contribution"),
       "Search for strengths (parallel bond, cohesive beam); largest where not given: the bond's own.");
  pair(FreeParameter::shear_strength, "1", above_up_to(0, 1000),
       "Search for compressive over tensile strength.");
  pair(FreeParameter::friction_angle, "rad", parallel("friction_angle"),
       "Search for strengths (parallel bond, cohesive beam); where not given, the bond's own, or 0 to 60 "
       "degree if a strength at a pressure is a target or Calibrate/Free is set.");
  pair(FreeParameter::compression_limits, "1", above_up_to(0, 100),
       "Search, where Calibrate/Free has compression limits: against those of the scene.");
  pair(FreeParameter::contact_friction, "1", between(0, 5),
       "Search, where Calibrate/Free has contact friction.");
}

void declare_calibrate(Parameters &parameters, Scene &scene) {
  Calibrate &c = scene.own<Calibrate>();
  Section section(parameters, "Calibrate");
  section.entry("Mode", c.mode, calibrate_modes,
                "Estimates at once, a table of elastic moduli, or parameters that meet targets.");
  section.integer("Seeds", c.seeds, 1, 1000, "Packings to calibrate on: Scene/Seed and those after it.");
  section.integer("Verification seeds", c.verification_seeds, 0, 1000,
                  "Packings after those, on which what was found is judged.");
  section.number("Strain", c.strain, above_up_to(0, 0.01), "Closure over height in the static solves.");
  section.entry("Tension rate", c.tension_rate, "m/s", above(0),
                "Speed of opening in tension tests; where not given, Loading/Axial rate times the target of "
                "tensile over that of compressive strength (a tenth where one is missing).");
  section.value("Free", c.free, "", "with commas between them, any of " + joined(words_that_free()),
                read_free_parameters,
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
  section.entry("Stiffness ratio list", c.stiffness_ratios, "1",
                range_of<dem::ParallelBond::Parameters>("stiffness_ratio"),
                "Abacus; empty: Bond/Stiffness ratio (parallel bond).");
  section.entry("Radius multiplier list", c.radius_multipliers, "1",
                range_of<dem::BondLayout>("radius_multiplier"), "Abacus; empty: Bond/Radius multiplier.");
  section.entry("Poisson ratio list", c.poisson_ratios, "1",
                range_of<dem::CohesiveBeam::Parameters>("poisson_ratio"),
                "Abacus; empty: Bond/Poisson ratio (cohesive beam).");
  declare_bounds(section, c);
  declare_lines(section, c);
}

// Of the wanted tensile over compressive strength where both are wanted of the scene.
double tension_rate(const Scene &scene) {
  const Calibrate &c = calibrate_of(scene);
  if (given(c.tension_rate)) return c.tension_rate;
  const auto first = [&](const char *key) {
    const auto found =
        std::find_if(c.targets.begin(), c.targets.end(), [&](const Target &t) { return t.key == key; });
    return found == c.targets.end() ? not_given : found->value;
  };
  const double ratio = first("tensile_strength_pa") / first("compressive_strength_pa");
  return scene.loading.rate * (std::isnan(ratio) ? 0.1 : ratio);
}

void complete_targets(Parameters &parameters, Scene &scene) {
  Calibrate &c = scene.own<Calibrate>();
  for (std::size_t k = 0; k < c.lines.size(); ++k) {
    Target target = c.lines[k];
    if (target.text.empty()) continue;
    target.number = static_cast<int>(k + 1);
    target.entry = "Calibrate/" + numbered("Target", k);
    if (target.curve_file > 0)
      target.file = resolved_path(parameters.at("Calibrate/Curve " + std::to_string(target.curve_file)));
    if (!given(target.tolerance)) target.tolerance = c.tolerance;
    c.targets.push_back(target);
  }
  for (Target &target : c.targets)
    complete_test(target, scene, tension_rate(scene));
}

// Its bounds and what it begins with, in the unit of the entry.
FreedEntry completed(Parameters &parameters, FreedEntry freed, const std::string &key) {
  const Entry *entry = parameters.find(freed.path);
  if (entry == nullptr || entry->is_text || entry->is_file || !entry->words.empty() ||
      entry->allowed.rfind("whole", 0) == 0 || freed.path.rfind("Calibrate/", 0) == 0)
    parameters.refuse(key,
                      "frees " + freed.path + ", which is no number of this scene that may take any value.");
  for (const auto &[word, parameter] : free_words())
    if (facts_of(Calibrate(), parameter).entry == freed.path)
      parameters.refuse(key, "is what Calibrate/Free = " + word + " names.");
  freed.unit = entry->unit.empty() ? "1" : entry->unit;
  const auto read = [&](const std::string &text, const std::string &what) {
    try {
      entry->read(text);
      return read_quantity(text, freed.unit, Range());
    } catch (const ValueError &error) {
      entry->read(entry->text);
      parameters.refuse(
          key, "has " + what + ", \"" + text + "\", that " + error.what() + " of " + freed.path + ".");
    }
  };
  freed.bounds = {read(freed.from, "a bound"), read(freed.to, "a bound")};
  freed.own = read(entry->text, "an entry to begin with"); // what the scene has is read last
  const auto [low, high] = freed.bounds;
  if (!(low < high)) parameters.refuse(key, "has a low bound that is not below the high one.");
  if (!(freed.own >= low && freed.own <= high))
    parameters.refuse(key,
                      "does not hold what the scene begins with, " + freed.path + " = " + entry->text + ".");
  return freed;
}

void complete_calibrate(Parameters &parameters, Scene &scene) {
  Calibrate &c = scene.own<Calibrate>();
  complete_targets(parameters, scene);
  for (std::size_t k = 0; k < c.entries.size(); ++k)
    if (!c.entries[k].path.empty())
      parameters.attempt([&] {
        c.freed.push_back(completed(parameters, c.entries[k], "Calibrate/" + numbered("Parameter", k)));
      });
  double &modulus = scene.model.bond_layout.modulus;
  if (c.mode == CalibrateMode::abacus && std::isnan(modulus) && !c.moduli.empty()) modulus = c.moduli.front();
}

// Slope, height and what follows the peak.
constexpr std::size_t counts_of_a_curve = 3;

void check_bounds(const SceneCheck &check) {
  const Scene &scene = check.scene();
  const Choice own = choice_of(scene);
  for (const auto &[parameter, asked] : calibrate_of(scene).bounds) {
    const std::string key = facts_of(calibrate_of(scene), parameter).bounded(),
                      smallest = "Calibrate/Smallest " + key, largest = "Calibrate/Largest " + key;
    const bool angle = parameter == FreeParameter::friction_angle;
    for (const std::string &one : {smallest, largest})
      if (angle && check.parameters().at(one).changed() && !has_parameter(scene, parameter))
        check.refuse(one,
                     "needs a bond with a friction angle. Allowed: Effects/Bond = parallel bond, cohesive "
                     "beam, yielding parallel bond.");
    const Bounds all = bounds_of(scene, parameter, own[parameter]);
    if (given(asked.low) && given(asked.high)) {
      if (angle ? asked.low > asked.high : asked.low >= asked.high)
        check.refuse(smallest, "is not below " + largest + ", " + shortest_text(asked.high) + ".");
    } else if (all.low > all.high && given(asked.low)) {
      check.refuse(smallest, "is above the bond's own, which is the largest where none is given.");
    } else if (all.low > all.high) {
      check.refuse(largest, "is below the bond's own, which is the smallest where none is given.");
    }
  }
}

// What a test of it cannot be is found when its scene is read (expected_tests.h).
void check_target(const SceneCheck &check, const Target &target) {
  if (target.is_elastic()) return;
  for (const FreeParameter strength : {FreeParameter::tensile_strength, FreeParameter::shear_strength})
    if (choice_of(check.scene())[strength] == 0)
      check.refuse(facts_of(calibrate_of(check.scene()), strength).entry,
                   "is no number that the search for strengths could begin with. Allowed: > 0 Pa.");
  for (const Target &other : calibrate_of(check.scene()).targets) // of the scene as it is
    if (target.kind == TargetKind::tension && other.kind == TargetKind::strength && other.entries.empty() &&
        target.value >= other.value)
      check.refuse(target.entry, "is not below " + other.entry + " = " + other.text + ".");
  if (target.curve_file > 0)
    check.readable("Calibrate/Curve " + std::to_string(target.curve_file), target.file,
                   target.entry + " has its points there.");
}

void check_free_parameters(const SceneCheck &check) {
  const Calibrate &c = calibrate_of(check.scene());
  const std::size_t freed = c.free.size() + c.freed.size();
  std::size_t count = 0;
  for (const Target &target : c.targets)
    count += target.kind == TargetKind::curve ? counts_of_a_curve : 1;
  if (freed > count)
    check.refuse(c.free.empty() ? "Calibrate/Parameter 1" : "Calibrate/Free",
                 "frees more parameters than the targets can tell: " + std::to_string(freed) + " for " +
                     std::to_string(count) + ". Allowed: as many as targets; a curve counts for three.");
  for (const FreeParameter parameter : c.free)
    if (!has_parameter(check.scene(), parameter))
      check.refuse("Calibrate/Free", "holds " + facts_of(c, parameter).word + ", which Effects/Bond = " +
                                         check.scene().bond.word() + " does not have here.");
}

void check_calibrate(const SceneCheck &check) {
  const Calibrate &c = calibrate_of(check.scene());
  if (!check.scene().bond.bonded())
    return check.refuse("Effects/Bond", "leaves platen-calibrate without a bond to find.");
  if (check.scene().loading.servo)
    check.refuse("Platens/Top/Control", "is not for calibration: platens are moved. Allowed: motion.");
  check_bounds(check);
  const bool beam = check.scene().bond.is<dem::CohesiveBeam>();
  if (beam && !c.stiffness_ratios.empty())
    check.refuse("Calibrate/Stiffness ratio list",
                 "is for parallel bonds: a beam has the ratio of its section.");
  if (!beam && !c.poisson_ratios.empty())
    check.refuse("Calibrate/Poisson ratio list", "is for beams: Effects/Bond = parallel bond has none.");
  if (c.mode != CalibrateMode::search) return;
  if (c.targets.empty() && !check.parameters().faults().any_in("Calibrate"))
    check.refuse("Calibrate/Mode",
                 "has nothing to search for. Allowed: bounds, abacus, or a Calibrate/Target 1, as \"young "
                 "modulus: 25 GPa\" or \"strength_pa: 40 MPa\".");
  for (const Target &target : c.targets)
    check_target(check, target);
  check_free_parameters(check);
}

// A search for strengths begins with those of the scene; static solves break no bond. Targets have rates of
// their own, or are checked for it.
bool calibrate_gives(const Scene &scene, const Parameters & /*parameters*/, const std::string &path) {
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
  p.complete = complete_calibrate;
  p.check = check_calibrate;
  p.gives = calibrate_gives;
  p.uses = uses;
  return p;
}

} // namespace platen::apps
