#include "apps/scene/checks.h"

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "apps/scene/units.h"

namespace platen::apps {
namespace {

bool given(double value) {
  return !std::isnan(value);
}

class SceneCheck {
public:
  SceneCheck(Scene &scene, const Parameters &parameters, AppKind app)
      : scene_(scene), parameters_(parameters), app_(app) {}

  void specimen() const;
  void effects() const;
  void bond() const;
  void compression() const;
  void phases() const;
  void contact() const;
  void platens() const;
  void loading() const;
  void splitting() const;
  void bending() const;
  void cycles() const;
  void cell() const;
  void pair_test() const;
  void calibrate() const;
  void bar_test() const;
  void study() const;
  void notes();

private:
  bool packs() const { return app_ != AppKind::bonds && app_ != AppKind::report; }
  bool loads() const {
    return app_ == AppKind::compress || app_ == AppKind::brazilian || app_ == AppKind::calibrate ||
           app_ == AppKind::study;
  }
  [[noreturn]] void refuse(const std::string &path, const std::string &reason) const {
    parameters_.refuse(path, reason);
  }
  void need(const std::string &path, double value, const std::string &why) const {
    if (!given(value)) refuse(path, "is not set: " + why + " Allowed: " + limits(parameters_.at(path)) + ".");
  }
  void readable(const std::string &path, const std::string &file, const std::string &why) const;
  void cross_section() const;
  void spheres_fit() const;
  void friction(const std::string &name, const PlatenSide &side) const;
  void note(const std::string &path, const std::string &why);
  void bond_notes();

  Scene &scene_;
  const Parameters &parameters_;
  AppKind app_;
};

void SceneCheck::readable(const std::string &path, const std::string &file, const std::string &why) const {
  if (file.empty()) refuse(path, "is not set: " + why);
  std::error_code failure;
  if (std::filesystem::is_directory(file, failure) || !std::ifstream(file))
    refuse(path, "cannot be read (looked for " + file + ").");
}

void SceneCheck::cross_section() const {
  const SpecimenSection &specimen = scene_.specimen;
  const bool width = given(specimen.width_x) || given(specimen.width_y);
  const bool disc = specimen.shape == SpecimenShape::disc;
  if (disc && app_ != AppKind::brazilian && app_ != AppKind::pack)
    refuse("Specimen/Shape", "lies on its rim, for platen-brazilian. Allowed: cylinder, box, bar.");
  if (app_ == AppKind::brazilian && !disc && specimen.shape != SpecimenShape::cylinder)
    refuse("Specimen/Shape", "cannot be laid on its rim. Allowed: disc, cylinder.");
  const std::string which = given(specimen.width_x) ? "Specimen/Width x" : "Specimen/Width y";
  if ((disc || specimen.shape == SpecimenShape::cylinder) && width)
    refuse(which, "contradicts Specimen/Shape = " + parameters_.at("Specimen/Shape").text + ".");
  if (specimen.shape == SpecimenShape::box && specimen.round())
    refuse("Specimen/Radius", "contradicts Specimen/Shape = box. Allowed: Width x and Width y.");
  if (specimen.shape == SpecimenShape::bar && specimen.round() && width)
    refuse(which, "contradicts Specimen/Radius: a bar is round or rectangular. Allowed: one of them.");
}

void SceneCheck::spheres_fit() const {
  const SpecimenSection &specimen = scene_.specimen;
  const bool uniform = specimen.radius_distribution == RadiusDistribution::uniform;
  const double largest = specimen.sphere_radius * (1 + (uniform ? 0.5 * specimen.radius_spread : 0));
  const auto check = [&](double extent, const std::string &path) {
    if (2 * largest > extent)
      refuse("Specimen/Sphere radius", "is too large: spheres of up to " + shortest_text(2 * largest) +
                                           " m across do not fit into " + path + " = " +
                                           parameters_.at(path).text + ".");
  };
  if (specimen.round()) check(2 * specimen.radius, "Specimen/Radius");
  if (given(specimen.width_x)) check(specimen.width_x, "Specimen/Width x");
  if (given(specimen.width_y)) check(specimen.width_y, "Specimen/Width y");
  if (given(specimen.height)) check(specimen.height, "Specimen/Height");
}

void SceneCheck::specimen() const {
  const SpecimenSection &specimen = scene_.specimen;
  if (app_ == AppKind::bonds)
    need("Specimen/Sphere radius", specimen.sphere_radius, "the test needs a grain.");
  if (app_ == AppKind::bonds && scene_.material.density_of == DensityOf::solid)
    refuse("Material/Density of",
           "needs a packed specimen, of which platen-bonds has none. Allowed: grains.");
  if (specimen.radius_spread > 0 && specimen.radius_distribution != RadiusDistribution::uniform)
    refuse("Specimen/Radius spread", "needs Specimen/Radius distribution = uniform.");
  if (specimen.seat && specimen.ends != EndsKind::ground)
    refuse("Specimen/Seat", "needs Specimen/Ends = ground: only a ground sphere has a flat face.");
  if (specimen.seat && !scene_.effects.rotation)
    refuse("Specimen/Seat", "needs Effects/Rotation = on: a seat resists rocking.");
  if (!packs()) return;
  cross_section();
  if (specimen.packing == PackingKind::file) {
    readable("Specimen/File", specimen.file, "Packing = file takes the spheres from it.");
  } else {
    const std::string why = "the specimen is to be packed.";
    const bool rectangular =
        specimen.shape == SpecimenShape::box ||
        (specimen.shape == SpecimenShape::bar && !specimen.round() && given(specimen.width_x));
    if (rectangular || given(specimen.width_y)) {
      need("Specimen/Width x", specimen.width_x, why);
      need("Specimen/Width y", specimen.width_y, why);
    } else {
      need("Specimen/Radius", specimen.radius, why);
    }
    need("Specimen/Height", specimen.height, why);
    need("Specimen/Sphere radius", specimen.sphere_radius, why);
  }
  if (!given(specimen.sphere_radius)) return;
  spheres_fit();
  const bool rim = app_ == AppKind::brazilian;
  const double extent = rim ? 2 * specimen.radius : specimen.height;
  if (specimen.ends == EndsKind::ground && given(extent) &&
      2 * specimen.end_layer * specimen.sphere_radius > extent)
    refuse("Specimen/End layer", "is too deep: the two layers overlap in Specimen/" +
                                     std::string(rim ? "Radius" : "Height") + " = " +
                                     parameters_.at(rim ? "Specimen/Radius" : "Specimen/Height").text + ".");
}

void SceneCheck::effects() const {
  const Effects &effects = scene_.effects;
  const bool rolling = effects.tangential == TangentialKind::coulomb_with_rolling_resistance;
  if (rolling && !effects.rotation) refuse("Effects/Tangential", "needs Effects/Rotation = on.");
  if (rolling && effects.contact == ContactKind::none)
    refuse("Effects/Tangential", "needs a contact to roll on. Allowed: Effects/Contact = linear, hertz.");
  if (effects.bond == BondKind::cohesive_beam) {
    const std::string instead = "beams bend and twist. Allowed: on, or Effects/Bond = parallel bond.";
    if (!effects.rotation)
      refuse("Effects/Rotation", "does not go with Effects/Bond = cohesive beam: " + instead);
    if (!effects.bond_moments)
      refuse("Effects/Bond moments", "does not go with Effects/Bond = cohesive beam: " + instead);
  }
  if (effects.bond == BondKind::none && effects.contact == ContactKind::none && app_ != AppKind::pack)
    refuse("Effects/Contact", "leaves nothing that acts between grains, because Effects/Bond = none too.");
}

void SceneCheck::bond() const {
  const Bond &bond = scene_.bond;
  if (bond.radius_rule == RadiusRule::given)
    need("Bond/Radius", bond.radius, "Bond/Radius rule = given takes it.");
  const double radius = scene_.specimen.sphere_radius;
  if (!bond.gap.relative && given(radius) && bond.gap.value >= radius)
    refuse("Bond/Gap",
           "is as large as Specimen/Sphere radius = " + parameters_.at("Specimen/Sphere radius").text +
               ": a bare number is metres. Did you mean \"" + shortest_text(bond.gap.value) + " R_min\"?");
  compression();
  if (bond.strength_scatter != StrengthScatter::none && app_ == AppKind::bonds)
    refuse("Bond/Strength scatter", "leaves no bond of a known strength to test. Allowed: none.");
  if (bond.strength_scatter == StrengthScatter::weibull)
    need("Bond/Weibull modulus", bond.weibull_modulus, "Bond/Strength scatter = weibull takes it.");
  const bool needed = scene_.effects.bond != BondKind::none && app_ != AppKind::pack &&
                      app_ != AppKind::report &&
                      !(app_ == AppKind::bonds && !scene_.pair_test.moduli.empty());
  if (needed)
    need("Bond/Modulus", bond.modulus, "Effects/Bond is " + parameters_.at("Effects/Bond").text + ".");
}

void SceneCheck::compression() const {
  const std::vector<double> &limits = scene_.bond.compression_limits,
                            &slopes = scene_.bond.compression_slopes;
  const std::string count = std::to_string(limits.size());
  if (limits.size() > 3) refuse("Bond/Compression limits", "has " + count + " stresses. Allowed: up to 3.");
  if (slopes.size() != limits.size())
    refuse("Bond/Compression slopes", "has " + std::to_string(slopes.size()) +
                                          " numbers. Allowed: as many as Bond/Compression limits, " + count +
                                          ".");
  if (!std::is_sorted(limits.begin(), limits.end()))
    refuse("Bond/Compression limits", "descends. Allowed: ascending stresses.");
  if (!std::is_sorted(slopes.begin(), slopes.end()))
    refuse("Bond/Compression slopes",
           "descends: compression would grow stiffer again. Allowed: ascending numbers.");
}

void SceneCheck::phases() const {
  const PhasesSection &phases = scene_.phases;
  if (phases.by == PhasesBy::none) return;
  if (app_ == AppKind::bonds)
    refuse("Phases/By", "needs a packed specimen, of which platen-bonds has none. Allowed: none.");
  if (scene_.effects.bond == BondKind::none)
    refuse("Phases/By", "tells bonds apart, but Effects/Bond = none. Allowed: none.");
  if (phases.by == PhasesBy::radius)
    need("Phases/Radius above", phases.radius_above, "Phases/By = radius takes it.");
  if (phases.by == PhasesBy::file)
    readable("Phases/File", phases.file, "Phases/By = file takes the ids from it.");
}

void SceneCheck::contact() const {
  const bool no_bond = scene_.effects.bond == BondKind::none && !given(scene_.bond.modulus);
  const auto check = [&](const std::string &path, const Stiffness &stiffness, const std::string &instead) {
    if (no_bond && stiffness.kind == Stiffness::Kind::of_bond)
      refuse(path, "is a multiple of the bond's, but Effects/Bond = none. Allowed: " + instead + ".");
  };
  if (scene_.effects.contact == ContactKind::linear && app_ != AppKind::pack)
    check("Contact/Stiffness", scene_.contact.stiffness, "\"4e5 N/m\", \"0.01 bulk\"");
  if (loads()) check("Platens/Stiffness", scene_.platens.stiffness, "\"4e5 N/m\"");
  if (scene_.contact.rolling_friction > 0 && scene_.effects.tangential == TangentialKind::none)
    refuse("Contact/Rolling friction", "needs Effects/Tangential = coulomb with rolling resistance.");
}

void SceneCheck::friction(const std::string &name, const PlatenSide &side) const {
  if (side.friction_dynamic <= side.friction_static) return;
  const std::string own = "Platens/" + name + "/Friction dynamic", common = "Platens/Friction dynamic";
  const std::string blamed = parameters_.at(own).changed() ? own : common;
  refuse(blamed, "is above the static friction, " + shortest_text(side.friction_static) + ", of the " +
                     (name == "Top" ? "top" : "bottom") + " platen. Allowed: 0 ... " +
                     shortest_text(side.friction_static) + ".");
}

void SceneCheck::platens() const {
  const Platens &platens = scene_.platens;
  friction("Top", platens.top);
  friction("Bottom", platens.bottom);
  const bool tension = scene_.loading.test == LoadingTest::tension,
             glued = platens.attachment == Attachment::glued;
  if (loads() && tension && !glued)
    refuse("Loading/Test", "needs Platens/Attachment = glued: a platen in contact cannot pull.");
  const bool stress = platens.top_control == PlatenControl::stress;
  if (stress && platens.top_stress == 0) refuse("Platens/Top/Control", "needs Platens/Top/Stress > 0.");
  if (stress && scene_.loading.ramp == 0)
    refuse("Platens/Top/Control", "needs Loading/Ramp > 0: the time to the full stress.");
  if (stress && tension)
    refuse("Platens/Top/Control", "presses, but Loading/Test = tension. Allowed: motion.");
}

void SceneCheck::loading() const {
  const Loading &loading = scene_.loading;
  if (loads() && app_ != AppKind::calibrate && !loading.hydrostatic())
    need("Loading/Axial rate", loading.axial_rate, "the platens have to move.");
  if (loading.confining_pressure > 0 && loading.confinement == ConfinementKind::none)
    refuse("Loading/Confining pressure", "needs Loading/Confinement other than none.");
  for (const char *key : {"Sleeve/Thickness", "Sleeve/Modulus", "Sleeve/Poisson ratio"})
    if (parameters_.at(key).changed() && loading.confinement != ConfinementKind::sleeve)
      refuse(key, "needs Loading/Confinement = sleeve, which is not available in this version.");
}

void SceneCheck::splitting() const {
  if (app_ != AppKind::brazilian) return;
  if (scene_.loading.test != LoadingTest::compression)
    refuse("Loading/Test", "does not go with platen-brazilian. Allowed: compression.");
  if (scene_.loading.confinement != ConfinementKind::none)
    refuse("Loading/Confinement", "does not go with platen-brazilian. Allowed: none.");
}

// What of it the packed shape decides, a file's too, is left to the problem.
void SceneCheck::bending() const {
  if (!loads() || !scene_.loading.bending()) return;
  const Platens &platens = scene_.platens;
  const SpecimenSection &specimen = scene_.specimen;
  const std::string with = "does not go with Loading/Test = three point bending. Allowed: ";
  if (app_ != AppKind::compress && app_ != AppKind::study)
    refuse("Loading/Test", "bends bars: for platen-compress.");
  const bool round = specimen.shape == SpecimenShape::cylinder || specimen.round();
  if (round && specimen.packing != PackingKind::file)
    refuse("Specimen/Shape", with + "box, rectangular bar.");
  if (specimen.ends != EndsKind::ground) refuse("Specimen/Ends", with + "ground.");
  need("Platens/Span", platens.span, "a bar needs its supports.");
  if (platens.strip_width == 0)
    refuse("Platens/Strip width", "is not set: a bar is bent by strips. Allowed: > 0 m.");
  if (platens.attachment == Attachment::glued) refuse("Platens/Attachment", with + "contact.");
  if (platens.top_control == PlatenControl::stress) refuse("Platens/Top/Control", with + "motion.");
  if (scene_.loading.confinement != ConfinementKind::none) refuse("Loading/Confinement", with + "none.");
  if (scene_.effects.bond == BondKind::none)
    refuse("Effects/Bond", "leaves a heap of grains, no bar to bend. Allowed: any other.");
}

void SceneCheck::cycles() const {
  const Loading &loading = scene_.loading;
  if (loading.unload_at.empty()) return;
  if (!std::is_sorted(loading.unload_at.begin(), loading.unload_at.end()))
    refuse("Loading/Unload at", "does not ascend.");
  if (loading.unload_at.back() >= loading.target_strain)
    refuse("Loading/Unload at",
           "goes beyond Loading/Target strain = " + parameters_.at("Loading/Target strain").text + ".");
  if (loading.hydrostatic() || scene_.platens.top_control == PlatenControl::stress)
    refuse("Loading/Unload at", "needs platens that are driven by motion.");
}

void SceneCheck::cell() const {
  const Loading &loading = scene_.loading;
  if (loading.walled() && loading.confinement != ConfinementKind::none)
    refuse("Loading/Confinement", "does not go with Loading/Test = uniaxial strain. Allowed: none.");
  if (loading.hydrostatic() && !loading.cell())
    refuse("Loading/Test", "needs Loading/Confinement = particles: the lateral surface is pressed too.");
  if (!loading.cell()) return;
  if (loads() && !(loading.confining_pressure > 0))
    refuse("Loading/Confinement", "needs Loading/Confining pressure > 0.");
  if (loads() && scene_.effects.bond == BondKind::none)
    refuse("Loading/Confinement",
           "needs bonds: they tell the specimen from what has come loose. Allowed: none.");
  if (scene_.platens.top_control == PlatenControl::stress)
    refuse("Platens/Top/Control",
           "does not go with Loading/Confinement = particles: the pressure holds the "
           "platen at first, then it moves. Allowed: motion.");
}

void SceneCheck::pair_test() const {
  if (app_ != AppKind::bonds) return;
  if (scene_.effects.bond == BondKind::none)
    refuse("Effects/Bond", "leaves platen-bonds without a bond to test.");
  if (scene_.effects.bond == BondKind::elasto_damage_plastic)
    refuse("Effects/Bond",
           "yields and softens: platen-bonds brings bonds to rest by swinging, which such a "
           "bond would remember. Allowed: parallel bond, cohesive beam.");
  if (!given(scene_.pair_test.force) && !given(scene_.pair_test.displacement))
    refuse("Pair test/Force", "is not set, nor is Pair test/Displacement. Allowed: at least one of them.");
}

void SceneCheck::calibrate() const {
  if (app_ != AppKind::calibrate) return;
  const Calibrate &c = scene_.calibrate;
  if (scene_.effects.bond == BondKind::none)
    refuse("Effects/Bond", "leaves platen-calibrate without a bond to find.");
  if (scene_.platens.top_control == PlatenControl::stress)
    refuse("Platens/Top/Control", "is not for calibration: platens are moved. Allowed: motion.");
  const auto ascending = [&](double low, double high, const std::string &path) {
    if (low >= high)
      refuse("Calibrate/Smallest " + path,
             "is not below Calibrate/Largest " + path + ", " + shortest_text(high) + ".");
  };
  ascending(c.ratio_low, c.ratio_high, "stiffness ratio");
  ascending(c.multiplier_low, c.multiplier_high, "radius multiplier");
  ascending(c.strengths_low, c.strengths_high, "shear over tensile strength");
  const bool beam = scene_.effects.bond == BondKind::cohesive_beam;
  if (beam && !c.stiffness_ratios.empty())
    refuse("Calibrate/Stiffness ratio list", "is for parallel bonds: a beam has the ratio of its section.");
  if (!beam && !c.poisson_ratios.empty())
    refuse("Calibrate/Poisson ratio list", "is for beams: Effects/Bond = parallel bond has none.");
  if (c.mode != CalibrateMode::search) return;
  const bool strengths = given(c.compressive_strength) || given(c.tensile_strength);
  if (!strengths && !given(c.young_modulus) && !given(c.poisson_ratio))
    refuse("Calibrate/Mode",
           "has nothing to search for. Allowed: bounds, abacus, or a wanted Young modulus, Poisson ratio or "
           "strength.");
  if (!strengths) return;
  need("Loading/Axial rate", scene_.loading.axial_rate, "the platens have to move.");
  if (scene_.bond.tensile_strength == 0)
    refuse("Bond/Tensile strength", "is infinite: the search for strengths begins with it. Allowed: > 0 Pa.");
  if (scene_.bond.shear_strength == 0)
    refuse("Bond/Shear strength", "is infinite: the search for strengths begins with it. Allowed: > 0 Pa.");
  if (given(c.compressive_strength) && given(c.tensile_strength) &&
      c.compressive_strength <= c.tensile_strength)
    refuse("Calibrate/Tensile strength", "is not below Calibrate/Compressive strength = " +
                                             parameters_.at("Calibrate/Compressive strength").text + ".");
}

void SceneCheck::bar_test() const {
  if (app_ != AppKind::bar) return;
  const BarTest &bar = scene_.bar_test;
  if (scene_.effects.bond == BondKind::none)
    refuse("Effects/Bond", "leaves a heap of grains, no bar. Allowed: parallel bond, cohesive beam.");
  if (scene_.effects.gravity)
    refuse("Effects/Gravity", "would load the bar before the test does. Allowed: off.");
  const bool swings = bar.method != BarMethod::at_rest && bar.load != BarLoad::none;
  const std::string damps = "would damp what is to swing freely. Allowed: 0, or Bar test/Method = static.";
  if (swings && scene_.integration.damping > 0) refuse("Integration/Damping", damps);
  if (swings && scene_.bond.damping > 0) refuse("Bond/Damping", damps);
  if (bar.load == BarLoad::impact && bar.method == BarMethod::at_rest)
    refuse("Bar test/Method", "leaves nothing of Bar test/Load = impact. Allowed: both, dynamic.");
  const SpecimenSection &specimen = scene_.specimen;
  if (given(specimen.sphere_radius) && given(specimen.height) &&
      2 * (bar.end_depth + 2) * specimen.sphere_radius > specimen.height)
    refuse("Bar test/End depth", "is too deep: the two ends leave no bar between them in Specimen/Height = " +
                                     parameters_.at("Specimen/Height").text + ".");
}

// What a list of the study stands for must be there to be varied, and vary: each value once.
void SceneCheck::study() const {
  if (app_ != AppKind::study) return;
  const Study &study = scene_.study;
  const auto once = [&](const std::string &path, std::vector<double> values) {
    std::sort(values.begin(), values.end());
    const auto twice = std::adjacent_find(values.begin(), values.end());
    if (twice != values.end()) refuse(path, "holds " + shortest_text(*twice) + " twice. Allowed: each once.");
  };
  once("Study/Sphere radius list", study.sphere_radii);
  once("Study/Radius multiplier list", study.radius_multipliers);
  once("Study/Radius spread list", study.radius_spreads);
  once("Study/Axial rate list", study.axial_rates);
  for (const bool relative : {true, false}) {
    std::vector<double> gaps;
    for (const Gap &gap : study.gaps)
      if (gap.relative == relative) gaps.push_back(gap.value);
    once("Study/Gap list", gaps);
  }
  if (!study.domains.empty() && scene_.specimen.shape != SpecimenShape::cylinder)
    refuse("Study/Domain list", "holds cylinders, but Specimen/Shape = " +
                                    parameters_.at("Specimen/Shape").text + ". Allowed: Shape = cylinder.");
  if (study.seeds > 1 && scene_.specimen.packing == PackingKind::file &&
      scene_.bond.strength_scatter == StrengthScatter::none)
    refuse("Study/Seeds",
           "would repeat one run: with Specimen/Packing = file and Bond/Strength scatter = none nothing is "
           "drawn. Allowed: 1.");
}

void SceneCheck::note(const std::string &path, const std::string &why) {
  const Entry &entry = parameters_.at(path);
  if (!entry.changed()) return;
  scene_.notes.push_back(entry.origin.text() + ": note: " + path + " = " + entry.text +
                         " has no effect: " + why + ".");
}

void SceneCheck::bond_notes() {
  const BondKind kind = scene_.effects.bond;
  if (kind == BondKind::cohesive_beam)
    note("Bond/Stiffness ratio", "a cohesive beam has that of its section");
  if (kind == BondKind::parallel_bond)
    note("Bond/Poisson ratio", "Effects/Bond is not cohesive beam or elasto damage plastic");
  if (scene_.bond.shear_strength == 0) note("Bond/Friction angle", "Bond/Shear strength is infinite");
  if (kind == BondKind::elasto_damage_plastic) {
    for (const char *key : {"Bond/Stiffness ratio", "Bond/Friction angle", "Bond/Moment contribution",
                            "Bond/Gap", "Effects/Bond moments"})
      note(key, "Effects/Bond = elasto damage plastic, which has its own or none");
    if (scene_.bond.fracture_energy_tension > 0)
      note("Bond/Softening tension", "Bond/Fracture energy tension takes its place");
    if (scene_.bond.fracture_energy_shear > 0)
      note("Bond/Softening shear", "Bond/Fracture energy shear takes its place");
    return;
  }
  for (const char *key :
       {"Bond/Interaction range", "Bond/Friction static", "Bond/Friction dynamic", "Bond/Softening tension",
        "Bond/Softening shear", "Bond/Fracture energy tension", "Bond/Fracture energy shear",
        "Bond/Compression limits", "Bond/Compression slopes", "Bond/Failure line"})
    note(key, "Effects/Bond is not elasto damage plastic");
}

void SceneCheck::notes() {
  const SpecimenSection &specimen = scene_.specimen;
  const Effects &effects = scene_.effects;
  if (specimen.packing != PackingKind::file) note("Specimen/File", "Specimen/Packing is not file");
  if (specimen.radius_distribution != RadiusDistribution::two_sizes)
    for (const char *key : {"Specimen/Second radius ratio", "Specimen/Second fraction"})
      note(key, "Specimen/Radius distribution is not two sizes");
  if (specimen.ends == EndsKind::as_packed) note("Specimen/End layer", "Specimen/Ends = as packed");
  if (scene_.bond.radius_rule != RadiusRule::given) note("Bond/Radius", "Bond/Radius rule is not given");
  bond_notes();
  if (scene_.phases.by != PhasesBy::radius) note("Phases/Radius above", "Phases/By is not radius");
  if (scene_.phases.by != PhasesBy::file) note("Phases/File", "Phases/By is not file");
  if (scene_.phases.by == PhasesBy::none)
    for (const char *key : {"Phases/Aggregate modulus factor", "Phases/Aggregate strength factor",
                            "Phases/Interface modulus factor", "Phases/Interface strength factor"})
      note(key, "Phases/By = none");
  if (scene_.bond.strength_scatter == StrengthScatter::none)
    note("Bond/Weibull modulus", "Bond/Strength scatter = none");
  else if (scene_.bond.tensile_strength == 0 && scene_.bond.shear_strength == 0)
    note("Bond/Strength scatter", "both strengths are infinite");
  if (effects.contact != ContactKind::linear)
    for (const char *key : {"Contact/Stiffness", "Contact/Tangential ratio", "Contact/Damping"})
      note(key, "Effects/Contact is not linear");
  if (effects.contact != ContactKind::hertz) note("Contact/Restitution", "Effects/Contact is not hertz");
  if (effects.contact != ContactKind::hertz && scene_.contact.stiffness.kind != Stiffness::Kind::of_bulk)
    for (const char *key : {"Material/Young modulus", "Material/Poisson ratio"})
      note(key, "no contact law takes it");
  if (effects.tangential == TangentialKind::none) note("Contact/Friction", "Effects/Tangential = none");
  if (effects.tangential != TangentialKind::coulomb_with_rolling_resistance)
    note("Contact/Rolling friction", "Effects/Tangential is not coulomb with rolling resistance");
  if (scene_.platens.kind == PlatenKind::rigid)
    for (const char *key : {"Platens/Young modulus", "Platens/Poisson ratio"})
      note(key, "Platens/Kind = rigid");
  if (scene_.platens.top_control == PlatenControl::motion) {
    note("Platens/Top/Stress", "Platens/Top/Control = motion");
    if (!scene_.loading.cell()) note("Loading/Hold", "Platens/Top/Control = motion");
  }
  if (!scene_.loading.cell())
    for (const char *key : {"Loading/Confining ramp", "Loading/Confinement area"})
      note(key, "Loading/Confinement is not particles");
  if (!scene_.loading.bending()) note("Platens/Span", "Loading/Test is not three point bending");
  if (app_ != AppKind::brazilian && !scene_.loading.bending())
    note("Platens/Strip width", "only platen-brazilian and three point bending have strips");
  if (!scene_.loading.walled()) note("Loading/Wall stiffness", "Loading/Test is not uniaxial strain");
  if (scene_.loading.unload_at.empty()) note("Loading/Unload to", "Loading/Unload at is empty");
  if (scene_.loading.hydrostatic())
    for (const char *key : {"Loading/Axial rate", "Loading/Target strain", "Loading/Stop at residual"})
      note(key, "Loading/Test = hydrostatic");
  if (scene_.integration.scheme != Scheme::tchamwa_wielgosz)
    note("Integration/Dissipation", "Integration/Scheme is not tchamwa wielgosz");
  if (!scene_.output.fields) note("Output/Fields every", "Output/Fields = off");
  if (app_ == AppKind::bar) {
    for (const char *key : {"Specimen/Ends", "Specimen/Seat"})
      note(key, "a bar is held by the spheres of its end");
    for (const char *key : {"Loading/Axial rate", "Loading/Target strain", "Platens/Friction static"})
      note(key, "a bar meets no platens");
    note("Output/Fields every", "platen-bar writes no frames");
    note("Checkpoint/Every", "platen-bar writes no checkpoints");
    if (scene_.bar_test.method == BarMethod::at_rest) {
      note("Bar test/Periods", "Bar test/Method = static");
      if (effects.contact != ContactKind::none) note("Effects/Contact", "Bar test/Method = static");
    }
    if (scene_.bar_test.load != BarLoad::bending && scene_.bar_test.load != BarLoad::all)
      note("Bar test/Bent along", "nothing is bent");
  }
  if (app_ == AppKind::bonds && scene_.pair_test.particles == 2)
    for (const char *key : {"Pair test/Plate", "Pair test/Base bond"})
      note(key, "Pair test/Particles = 2");
}

} // namespace

std::string resolved_path(const Entry &entry) {
  if (entry.text.empty() || entry.origin.line == 0) return entry.text;
  return (std::filesystem::path(entry.origin.file).parent_path() / entry.text).string();
}

void check_scene(Scene &scene, const Parameters &parameters, AppKind app) {
  SceneCheck check(scene, parameters, app);
  check.specimen();
  check.effects();
  check.bond();
  check.phases();
  check.contact();
  check.splitting();
  check.bending();
  check.platens();
  check.loading();
  check.cycles();
  check.cell();
  check.pair_test();
  check.calibrate();
  check.bar_test();
  check.study();
  check.notes();
}

} // namespace platen::apps
