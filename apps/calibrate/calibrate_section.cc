// What platen-calibrate looks for: keys for the common numbers, and targets, sections alike.
#include "apps/calibrate/calibrate_section.h"

#include "apps/calibrate/targets.h"
#include "apps/scene/members.h"
#include "apps/scene/scene_check.h"

namespace platen::apps {
namespace {

void declare_test_of_target(Section &section, TargetSection &to, const std::string &kind) {
  Section in_cell = section.only_if(kind, {"strength at pressure"});
  in_cell
      .entry("Pressure", to.pressure, "Pa", above(0),
             "Of the cell; the strength is the largest axial stress, the pressure included.")
      .needed_if(kind, {"strength at pressure"});
  in_cell.entry<ConfinementKind>(
      "Cell", to.cell, {{"particles", ConfinementKind::particles}, {"sleeve", ConfinementKind::sleeve}},
      "How the pressure acts: as Loading/Confinement; particles are cheaper.");
  Section broken = section.unless(kind, {"young modulus", "poisson ratio"}),
          pressed = broken.unless(kind, {"tension"}), upright = pressed.unless(kind, {"splitting"});
  upright
      .entry<TargetForm>(
          "Form", to.form,
          {{"scene", TargetForm::scene}, {"cylinder", TargetForm::cylinder}, {"box", TargetForm::box}},
          "Of the specimen; a box is as wide as the scene's cylinder, a cylinder as its box. Cube over prism "
          "has boxes.")
      .unless(kind, {"cube over prism"});
  upright.number("Slenderness", to.slenderness, between(0.1, 20),
                 "Height over width of the specimen; where not given, the scene's. Cube over prism: of the "
                 "prism, 2.4 where not given. Kind = slenderness: of the short specimen, 1 where not given.");
  const char *faces = "dry steel, thesis, teflon, grease, or a coefficient of friction (0 ... 5)";
  pressed.value("Platens", to.platens, "", faces, read_platens_of_target,
                "What the specimen stands between; where not given, the scene's platens.");
  section
      .value("Other platens", to.other_platens, "", faces, read_platens_of_target,
             "That the gain is over; where not given, without friction.")
      .only_if(kind, {"gain by friction"});
  broken.entry(
      "Rate", to.rate, "m/s", above(0),
      "Speed of its tests; where not given, Loading/Axial rate for the scene's height, in proportion "
      "for other ones; in tension Calibrate/Tension rate, in splitting a quarter.");
  broken.number("Largest strain", to.strain, above_up_to(0, 1),
                "Where its tests end without a peak; where not given, Loading/Target strain, more for "
                "specimens of a slenderness below 2, a quarter in tension, half in splitting.");
}

void declare_target(Parameters &parameters, TargetSection &to, std::size_t number) {
  Section section(parameters, section_of_target(number));
  const std::string kind = section.name() + "/Kind";
  section.entry(
      "Kind", to.kind, target_kinds,
      "What is wanted. Young modulus and Poisson's ratio of the specimen's middle; tension between "
      "glued ends; splitting of a disc as thick as its radius; gain by friction: strength over that "
      "between the other platens; slenderness: strength over that of a specimen twice as high as wide, "
      "between the same platens; secant ratio: Poisson's ratio to 40 % of the strength; curve: "
      "stresses of a test of the user's own.");
  section.text("Value", to.value, "The number wanted, with its unit.");
  parameters.declared(section.name() + "/Value").is_text = false; // read as a number when its kind is known
  section
      .file(
          "File", to.file,
          "Of a curve: CSV with a header, strain_platen or strain_gauge and stress_pa or stress_mpa, a row a "
          "point, from small strains to large, compression positive.")
      .only_if(kind, {"curve"});
  section.number("Weight", to.weight, above(0),
                 "Of the square of its miss over its tolerance, among others.");
  section.number("Tolerance", to.tolerance, above_up_to(0, 0.5),
                 "Relative difference that is near enough; of a curve the root mean square over its largest "
                 "stress. Where not given, Calibrate/Tolerance.");
  declare_test_of_target(section, to, kind);
}

void declare_calibrate(Parameters &parameters, Scene &scene) {
  Calibrate &c = scene.own<Calibrate>();
  Section section(parameters, "Calibrate");
  auto &parallel = range_of<dem::ParallelBond::Parameters>;
  const Range multipliers = range_of<dem::BondLayout>("radius_multiplier");
  section.entry("Mode", c.mode, calibrate_modes,
                "Estimates at once, a table of elastic moduli, or bonds for a wanted material.");
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
                "Speed of opening in tension tests; where not given, Loading/Axial rate times the wanted "
                "tensile over compressive strength (a tenth where one is not wanted).");
  std::string words;
  for (const auto &one : free_knobs)
    words += (words.empty() ? "" : ", ") + one.first;
  section.value("Free", c.free, "", "with commas between them, any of " + words, read_knobs,
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
      "a triaxial strength is wanted.");
  section.entry("Largest friction angle", c.friction_high, "rad", parallel("friction_angle"),
                "Search for strengths (parallel bond, cohesive beam); where not given, the bond's own, or 60 "
                "degree if a triaxial strength is wanted.");
  section.number("Smallest factor of compression limits", c.limits_low, above_up_to(0, 100),
                 "Search, where Calibrate/Free has compression limits: against those of the scene.");
  section.number("Largest factor of compression limits", c.limits_high, above_up_to(0, 100),
                 "Search, where Calibrate/Free has compression limits: against those of the scene.");
  section.number("Smallest contact friction", c.contact_friction_low, between(0, 5),
                 "Search, where Calibrate/Free has contact friction.");
  section.number("Largest contact friction", c.contact_friction_high, between(0, 5),
                 "Search, where Calibrate/Free has contact friction.");
  parameters.declare_series(section_of_target(1), most_targets,
                            [&sections = c.target_sections](Parameters &to, std::size_t number) {
                              declare_target(to, sections[number - 1], number);
                            });
}

void complete(Parameters &parameters, Scene &scene) {
  Calibrate &c = scene.own<Calibrate>();
  c.targets = targets_of(parameters, c);
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

bool uses(const Scene &scene, const std::string &part) {
  const std::vector<Target> &targets = calibrate_of(scene).targets;
  return std::any_of(targets.begin(), targets.end(), [&](const Target &target) {
    return part == "Sleeve" ? target.sleeve : target.kind == TargetKind::splitting;
  });
}

} // namespace

Program calibrate_program() {
  Program p;
  p.name = "platen-calibrate";
  p.purpose = "Finds bonds that give a wanted E, nu, compressive and tensile strength.";
  p.section = "Calibrate";
  p.declare = declare_calibrate;
  p.complete = complete;
  p.check = check_calibrate;
  p.gives = gives;
  p.uses = uses;
  return p;
}

} // namespace platen::apps
