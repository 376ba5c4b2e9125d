#include "apps/study/study_section.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

#include "apps/scene/members.h"
#include "apps/scene/parameters.h"
#include "apps/scene/scene_check.h"
#include "apps/scene/units.h"
#include "apps/scene/values.h"

namespace platen::apps {
namespace {

// "72 mm x 22.5 mm, 65 mm x 20 mm": heights and radii; "" is none.
std::vector<DomainSize> read_domains(const std::string &text) {
  return read_items<DomainSize>(text, [](const std::string &item) -> DomainSize {
    const std::string between_both = " x ";
    const std::size_t sign = item.find(between_both);
    if (sign == std::string::npos) throw ValueError("is no pair: \"height x radius\" is");
    const std::string height = item.substr(0, sign), radius = item.substr(sign + between_both.size());
    if (height.empty() || radius.empty()) throw ValueError("is half a pair");
    return {read_quantity(height, "m", above(0)), read_quantity(radius, "m", above(0))};
  });
}

// "0.05 R_min, 0.1 mm"; "" is no gap.
std::vector<Gap> read_gaps(const std::string &text) {
  return read_items<Gap>(text, read_gap);
}

// "fast, standard": words of Scene/Quality; "" is none.
std::vector<Quality> read_qualities(const std::string &text) {
  std::vector<std::string> words;
  for (const QualityWord &one : quality_words())
    words.push_back(one.word);
  return read_items<Quality>(
      text, [&](const std::string &item) { return quality_words()[read_word(item, words)].kind; });
}

// "20 mm & 60 mm": values of entries that go together.
std::vector<std::string> together(const std::string &text) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, '&');)
    parts.push_back(tidy(part));
  return parts;
}

// "Platens/Friction static: 0, 0.1, 0.3", "Specimen/Height & Platens/Span: 20 mm & 60 mm, 40 mm & 120 mm"; ""
// varies nothing.
Varied read_varied(const std::string &text) {
  if (text.empty()) return {};
  const std::size_t colon = text.find(':');
  Varied varied{together(text.substr(0, colon)), {}};
  for (const std::string &path : varied.paths) {
    if (colon == std::string::npos || path.find('/') == std::string::npos)
      throw ValueError("varies no entry: \"Section/Key: value, value\" does");
    if (path.rfind("Study/", 0) == 0 || path == "Scene/Seed")
      throw ValueError("varies " + path + ", which is of the study itself");
  }
  varied.values = read_items<std::vector<std::string>>(tidy(text.substr(colon + 1)), together);
  if (varied.values.empty()) throw ValueError("has no value");
  for (const std::vector<std::string> &values : varied.values)
    if (values.size() != varied.paths.size())
      throw ValueError("holds a case that has not one value for each of its " +
                       std::to_string(varied.paths.size()) + " entries");
  return varied;
}

// What trades accuracy for time: each list is run alone, all else as the scene has it.
void declare_accuracy_lists(Section &section, Study &study) {
  section.entry(
      "Safety list", study.safeties, "1", above_up_to(0, 1),
      "Study of accuracy, in place of Integration/Safety. All lists of such a study go from coarse to "
      "fine; the last value is the reference of the others.");
  section.entry(
      "Wave crossings list", study.wave_transits, "1", above(0),
      "Studies of accuracy and of a target, in place of Loading/Wave crossings. Target: speeds from which it "
      "chooses, empty: 15, 30, 60, 120.");
  section.entry("Hurry list", study.rate_multipliers, "1", between(1, 100),
                "Study of accuracy, in place of Loading/Hurry.");
  section.entry("Mass scaling list", study.mass_scalings, "1", range_of<dem::ModelSettings>("mass_scaling"),
                "Study of accuracy, in place of Integration/Mass scaling.");
  section.entry("Platen mesh list", study.platen_elements, "1", between(1, 1000),
                "Study of accuracy, in place of Platens/Elements across (Kind = deformable).");
  section.entry("Steps per solve list", study.steps_per_solve, "1", between(1, 100000),
                "Study of accuracy, in place of Platens/Steps per solve (Motion = quasi-static).");
  section.entry("Sleeve mesh list", study.sleeve_elements, "1", between(8, 10000),
                "Study of accuracy, in place of Sleeve/Elements around.");
  section.entry("Sleeve mass scaling list", study.sleeve_mass_scalings, "1", at_least(1),
                "Study of accuracy, in place of Sleeve/Mass scaling: how seldom the sleeve is stepped.");
  section.value("Quality list", study.qualities, "", "words of Scene/Quality with commas between them",
                read_qualities,
                "Study of accuracy, in place of Scene/Quality; the scene leaves open what it stands for.");
  section.value("Effects list", study.changes, "",
                "\"Effects/Rotation = off\" with commas between them; no value may hold a comma",
                read_assignments,
                "Study of accuracy: entries of the scene, each set alone and compared with the scene as "
                "it is.");
}

void declare_target(Parameters &parameters, StudyTarget &target) {
  Section section(parameters, "Study/Target");
  section.entry("Figure", target.figure, target_figures,
                "Study of a target: what is to be known. Gain: strength over that of Over scene or Over.");
  section.number("Accuracy", target.accuracy, between(0.001, 0.5),
                 "Half of the interval over the figure: where it is reached, the study ends.");
  section.number("Confidence", target.confidence, between(0.5, 0.99),
                 "How often the interval holds the figure of slow loading.");
  section.file("Over scene", target.over_scene,
               "Gain: the scene whose strength stands below; both are run on the same seeds.");
  section.value("Over", target.over, "",
                "\"Platens/Friction static = 0\" with commas between them; no value may hold a comma",
                read_assignments, "Gain: or the entries that make that scene of this one.");
  section.integer(
      "Pilot seeds", target.pilot_seeds, 3, 100,
      "Packings of the first batch at each of its two speeds, at most; a coarse accuracy asks for fewer.");
  section.integer("Most runs", target.most_runs, 1, 100000,
                  "Where the accuracy is not reached with so many, the study ends and says what was.");
  section.number(
      "Step allowance", target.step_allowance, between(0, 0.1),
      "What the time step adds to the error (docs/accuracy.md: 0.2 % of the modulus at most, of the "
      "strength nothing that chaos would show).");
  section.integer("Step seeds", target.step_seeds, 0, 100,
                  "Packings that are run with half the step too: what differs for sure counts in place of a "
                  "smaller allowance; 0: none.");
  section.integer(
      "Coarser seeds", target.coarser_seeds, 0, 100,
      "Packings of spheres 1.25 times as large that are run beside the others, for what one size of "
      "spheres means; 0: the law of bench/results/sizes.md tells it.");
}

void declare_study(Parameters &parameters, Scene &scene) {
  Study &study = scene.own<Study>();
  Section section(parameters, "Study");
  section.integer("Seeds", study.seeds, 1, 1000, "Runs of each case: Scene/Seed and those after it.");
  section.value("Surface list", study.surfaces, "",
                "words of Platens/Surface and coefficients of friction (0 ... 5) with commas between them",
                read_surfaces,
                "Study of friction: platens, in place of all that Platens says of friction; "
                "custom: what the scene says. A number: constant friction of that coefficient.");
  section.entry("Slenderness list", study.slendernesses, "1", between(0.1, 20),
                "Studies of friction and slenderness: heights over the width, in place of Specimen/Height.");
  section.entry("Confining pressure list", study.pressures, "Pa", at_least(0),
                "Studies of friction and slenderness, in place of Loading/Confining pressure; 0: no cell.");
  section.entry(
      "Sphere radius list", study.sphere_radii, "m", above(0),
      "Studies of size, friction, slenderness and accuracy: mean radii, in place of Specimen/Sphere radius. "
      "Study of size with Domain list empty too: 0.5, 0.75, 1 and 1.25 mm (Tannu 2017).");
  section.value("Domain list", study.domains, "m", "pairs with commas between them, each \"72 mm x 22.5 mm\"",
                read_domains,
                "Study of size: further cylinders, height x radius, at Specimen/Sphere radius.");
  section.value("Gap list", study.gaps, "", std::string("gaps with commas between them, each ") + gap_allowed,
                read_gaps, "Study of the packing, in place of Bond/Gap.");
  section.entry("Radius multiplier list", study.radius_multipliers, "1",
                range_of<dem::BondLayout>("radius_multiplier"),
                "Study of the packing, in place of Bond/Radius multiplier; each with every gap and spread.");
  section.entry("Radius spread list", study.radius_spreads, "1", between(0, 1.5),
                "Study of the packing, in place of Specimen/Radius spread.");
  section.entry("Axial rate list", study.axial_rates, "m/s", above(0),
                "Studies of rate and accuracy, in place of Loading/Axial rate.");
  declare_accuracy_lists(section, study);
  for (std::size_t k = 0; k < study.vary.size(); ++k)
    section.value(
        "Vary " + std::to_string(k + 1), study.vary[k], "",
        "\"Section/Key: value, value\", or entries that go together, \"Section/Key & Section/Key: value & "
        "value, value & value\"; no value may hold a comma",
        read_varied, "Study vary: entries and their values; each case of one with each of the others.");
  declare_target(parameters, study.target);
}

void complete_study(Parameters &parameters, Scene &scene) {
  scene.own<Study>().target.over_scene = resolved_path(parameters.at("Study/Target/Over scene"));
}

// Whether a kind of study reads the list is found when its cases are read.
bool study_gives(const Scene &scene, const Parameters &parameters, const std::string &path) {
  const Study &study = study_of(scene);
  const auto set = [](const Entry &entry) {
    return entry.path.rfind("Study/Target/", 0) == 0 && entry.changed();
  };
  const bool targets = std::any_of(parameters.entries().begin(), parameters.entries().end(), set);
  if (path == "Platens/Surface") return true;
  for (const Varied &one : study.vary)
    if (std::find(one.paths.begin(), one.paths.end(), path) != one.paths.end()) return true;
  if (path == "Loading/Axial rate")
    return !study.axial_rates.empty() || !study.wave_transits.empty() || !study.qualities.empty() || targets;
  if (path == "Loading/Confining pressure") return !study.pressures.empty();
  if (path == "Specimen/Sphere radius") return !study.sphere_radii.empty() && study.domains.empty();
  // Elastic platens as thick as a tenth of the height have to know it.
  if (path == "Specimen/Height")
    return !study.slendernesses.empty() && (!scene.platens.deformable || scene.platens.thickness > 0);
  return false;
}

// What a list of the study stands for must be there to be varied, and vary: each value once.
void check_study(const SceneCheck &check) {
  const Study &study = study_of(check.scene());
  const auto words_once = [&](const std::string &path, std::vector<std::string> words) {
    std::sort(words.begin(), words.end());
    const auto twice = std::adjacent_find(words.begin(), words.end());
    if (twice != words.end()) check.refuse(path, "holds " + *twice + " twice. Allowed: each once.");
  };
  const auto once = [&](const std::string &path, const std::vector<double> &values) {
    std::vector<std::string> words;
    for (const double value : values)
      words.push_back(shortest_text(value));
    words_once(path, std::move(words));
  };
  std::vector<std::string> platens;
  for (const StudySurface &one : study.surfaces)
    platens.push_back(text_of(one));
  words_once("Study/Surface list", std::move(platens));
  once("Study/Slenderness list", study.slendernesses);
  once("Study/Confining pressure list", study.pressures);
  once("Study/Sphere radius list", study.sphere_radii);
  once("Study/Radius multiplier list", study.radius_multipliers);
  once("Study/Radius spread list", study.radius_spreads);
  once("Study/Axial rate list", study.axial_rates);
  once("Study/Safety list", study.safeties);
  once("Study/Wave crossings list", study.wave_transits);
  once("Study/Hurry list", study.rate_multipliers);
  once("Study/Mass scaling list", study.mass_scalings);
  once("Study/Platen mesh list", study.platen_elements);
  once("Study/Steps per solve list", study.steps_per_solve);
  once("Study/Sleeve mesh list", study.sleeve_elements);
  once("Study/Sleeve mass scaling list", study.sleeve_mass_scalings);
  words_once("Study/Effects list", study.changes);
  std::set<std::string> varied;
  for (std::size_t k = 0; k < study.vary.size(); ++k) {
    const std::string entry = "Study/Vary " + std::to_string(k + 1);
    std::vector<std::string> cases;
    for (const std::vector<std::string> &values : study.vary[k].values)
      cases.push_back(fmt::format("{}", fmt::join(values, " & ")));
    words_once(entry, std::move(cases));
    for (const std::string &path : study.vary[k].paths) {
      if (check.parameters().find(path) == nullptr) {
        std::vector<std::string> known;
        for (const Entry &one : check.parameters().entries())
          known.push_back(one.path);
        check.refuse(entry,
                     "names " + path + ", which is no entry of this scene." + did_you_mean(path, known));
      }
      if (!varied.insert(path).second)
        check.refuse(entry, "varies " + path + " a second time. Allowed: each entry once.");
    }
  }
  for (const bool relative : {true, false}) {
    std::vector<double> gaps;
    for (const Gap &gap : study.gaps)
      if (gap.relative == relative) gaps.push_back(gap.value);
    once("Study/Gap list", gaps);
  }
  if (!study.domains.empty() && check.scene().specimen.shape != SpecimenShape::cylinder)
    check.refuse("Study/Domain list",
                 "holds cylinders, but Specimen/Shape = " + check.parameters().at("Specimen/Shape").text +
                     ". Allowed: Shape = cylinder.");
  if (study.seeds > 1 && check.scene().specimen.packing == PackingKind::file && !check.scene().bond.scattered)
    check.refuse(
        "Study/Seeds",
        "would repeat one run: with Specimen/Packing = file and Bond/Strength scatter = none nothing is "
        "drawn. Allowed: 1.");
}

} // namespace

Program study_program() {
  Program p;
  p.name = "platen-study";
  p.purpose =
      "Runs platen-compress over platens, slendernesses, sizes, packings, rates, any entries (vary) or what "
      "trades "
      "accuracy for time, each on several seeds, and tables the results; or finds the cheapest runs for an "
      "accuracy that "
      "is ordered (target).";
  p.kinds = {study_words.begin(), study_words.end()};
  p.section = "Study";
  p.declare = declare_study;
  p.complete = complete_study;
  p.check = check_study;
  p.gives = study_gives;
  return p;
}

} // namespace platen::apps
