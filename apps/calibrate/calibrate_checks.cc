// What platen-calibrate is asked for: whether it can be measured, and whether it is enough.
#include "apps/calibrate/calibrate_section.h"

#include <algorithm>

#include "apps/calibrate/targets.h"
#include "apps/scene/scene_check.h"
#include "apps/scene/units.h"
#include "apps/scene/values.h"

namespace platen::apps {
namespace {

bool has_knob(const Scene &scene, Knob knob) {
  switch (knob) {
    case Knob::tensile_strength:
    case Knob::shear_strength:
    case Knob::modulus:
    case Knob::radius_multiplier:
      return true;
    case Knob::stiffness_ratio:
      return scene.bond.has("stiffness_ratio");
    case Knob::poisson_ratio:
      return scene.bond.has("poisson_ratio");
    case Knob::moment_contribution:
      return scene.bond.has("moment_contribution");
    case Knob::friction_angle:
      return scene.bond.has("friction_angle");
    case Knob::compression_limits:
      return !scene.bond.list("compression_limits").empty();
    case Knob::contact_friction:
      return scene.contact.tangential != dem::TangentialContact::none;
  }
  return false;
}

// Slope, height and what follows the peak.
constexpr std::size_t counts_of_a_curve = 3;

void check_calibrate_bounds(const SceneCheck &check) {
  const Calibrate &c = calibrate_of(check.scene());
  const auto ascending = [&](double low, double high, const std::string &path) {
    if (low >= high)
      check.refuse("Calibrate/Smallest " + path,
                   "is not below Calibrate/Largest " + path + ", " + shortest_text(high) + ".");
  };
  ascending(c.ratio_low, c.ratio_high, "stiffness ratio");
  ascending(c.multiplier_low, c.multiplier_high, "radius multiplier");
  ascending(c.strengths_low, c.strengths_high, "shear over tensile strength");
  ascending(c.moments_low, c.moments_high, "moment contribution"); // the largest may be left out
  const char *const moments = "Calibrate/Smallest moment contribution";
  if (!given(c.moments_high) && check.parameters().at(moments).changed() &&
      c.moments_low > check.scene().bond.number("moment_contribution"))
    check.refuse(moments, "is above the bond's own, which is the largest where none is given.");
  ascending(c.limits_low, c.limits_high, "factor of compression limits");
  ascending(c.contact_friction_low, c.contact_friction_high, "contact friction");
  for (const char *key : {"Calibrate/Smallest friction angle", "Calibrate/Largest friction angle",
                          "Calibrate/Triaxial strength"})
    if (check.parameters().at(key).changed() && !check.scene().bond.has("friction_angle"))
      check.refuse(
          key,
          "needs a bond with a friction angle. Allowed: Effects/Bond = parallel bond, cohesive beam, "
          "yielding parallel bond.");
  const bool freed = given(c.triaxial_strength) ||
                     std::find(c.free.begin(), c.free.end(), Knob::friction_angle) != c.free.end();
  const double own = freed ? not_given : check.scene().bond.number("friction_angle");
  if ((given(c.friction_low) ? c.friction_low : own) > (given(c.friction_high) ? c.friction_high : own))
    check.refuse(
        given(c.friction_low) ? "Calibrate/Smallest friction angle" : "Calibrate/Largest friction angle",
        given(c.friction_low) ? "is above the largest, or the bond's own where none is given."
                              : "is below the bond's own, which is the smallest where none is given.");
}

void check_target(const SceneCheck &check, const Target &target) {
  if (target.is_elastic()) return;
  const bool own = given(target.rate) ||
                   (target.kind == TargetKind::tension && given(calibrate_of(check.scene()).tension_rate));
  if (!own) check.need("Loading/Axial rate", check.scene().loading.rate, "the platens have to move.");
  for (const char *strength : {"tensile_strength", "shear_strength"})
    if (check.scene().bond.number(strength) == 0)
      check.refuse(std::string("Bond/") + (strength[0] == 't' ? "Tensile strength" : "Shear strength"),
                   "is no number that the search for strengths could begin with. Allowed: > 0 Pa.");
  const SpecimenSection &specimen = check.scene().specimen;
  const bool cylinder = specimen.shape == SpecimenShape::cylinder,
             other = given(target.slenderness) || target.kind == TargetKind::splitting ||
                     target.kind == TargetKind::cube_over_prism || target.kind == TargetKind::slenderness;
  if (!cylinder && specimen.shape != SpecimenShape::box)
    check.refuse("Specimen/Shape", "is not crushed by platen-calibrate. Allowed: cylinder, box.");
  if (other && specimen.packing == PackingKind::file)
    check.refuse(target.entry,
                 "needs a specimen of another shape than Specimen/File has. Allowed: Specimen/Packing "
                 "= advancing front, random close.");
  if (target.kind == TargetKind::splitting && !cylinder)
    check.refuse(target.entry,
                 "is of a disc as wide as the scene's cylinder. Allowed: Specimen/Shape = cylinder.");
  if (target.sleeve && (target.box || !cylinder))
    check.refuse(target.entry, "wants a sleeve around a box. Allowed: Cell = particles, or Form = cylinder.");
  if (target.kind == TargetKind::gain_by_friction && target.friction <= target.other_friction)
    check.refuse(
        target.entry.substr(0, target.entry.rfind('/')) + "/Platens",
        "has no more friction than the other platens, " + shortest_text(target.other_friction) + ".");
  if (target.kind == TargetKind::slenderness && target.slenderness == 2)
    check.refuse(target.entry.substr(0, target.entry.rfind('/')) + "/Slenderness",
                 "is that of the specimen that it is compared with. Allowed: any other.");
  if (target.kind == TargetKind::strength_at_pressure &&
      check.scene().loading.confinement != ConfinementKind::none)
    check.refuse("Loading/Confinement", "would act on the compressive strength too; " + target.entry +
                                            " brings its own. Allowed: none.");
  if (target.kind == TargetKind::curve)
    check.readable(target.entry.substr(0, target.entry.rfind('/')) + "/File", target.file,
                   "Kind = curve has its points there.");
}

void check_free_parameters(const SceneCheck &check) {
  const Calibrate &c = calibrate_of(check.scene());
  if (c.free.empty()) return;
  std::size_t count = 0;
  for (const Target &target : c.targets)
    count += target.kind == TargetKind::curve ? counts_of_a_curve : 1;
  if (c.free.size() > count)
    check.refuse("Calibrate/Free", "frees more parameters than the targets can tell: " +
                                       std::to_string(c.free.size()) + " for " + std::to_string(count) +
                                       ". Allowed: as many as targets; a curve counts for three.");
  for (const Knob knob : c.free)
    if (!has_knob(check.scene(), knob))
      check.refuse("Calibrate/Free", "holds " + word_of(free_knobs, knob) + ", which Effects/Bond = " +
                                         check.scene().bond.word() + " does not have here.");
}

void check_triaxial_strength(const SceneCheck &check) {
  const Calibrate &c = calibrate_of(check.scene());
  check.need("Calibrate/Confining pressure", c.confining_pressure, "a triaxial strength has one.");
  if (!given(c.compressive_strength))
    check.refuse("Calibrate/Triaxial strength",
                 "needs Calibrate/Compressive strength: both tell how strength grows with pressure.");
  if (c.triaxial_strength <= c.compressive_strength)
    check.refuse("Calibrate/Triaxial strength",
                 "is not above Calibrate/Compressive strength = " +
                     check.parameters().at("Calibrate/Compressive strength").text + ".");
}

} // namespace

void check_calibrate(const SceneCheck &check) {
  const Calibrate &c = calibrate_of(check.scene());
  if (!given(c.triaxial_strength))
    check.note("Calibrate/Confining pressure", "Calibrate/Triaxial strength is not set");
  if (!check.scene().bond.bonded())
    return check.refuse("Effects/Bond", "leaves platen-calibrate without a bond to find.");
  if (check.scene().loading.servo)
    check.refuse("Platens/Top/Control", "is not for calibration: platens are moved. Allowed: motion.");
  check_calibrate_bounds(check);
  const bool beam = check.scene().bond.is<dem::CohesiveBeam>();
  if (beam && !c.stiffness_ratios.empty())
    check.refuse("Calibrate/Stiffness ratio list",
                 "is for parallel bonds: a beam has the ratio of its section.");
  if (!beam && !c.poisson_ratios.empty())
    check.refuse("Calibrate/Poisson ratio list", "is for beams: Effects/Bond = parallel bond has none.");
  if (c.mode != CalibrateMode::search) return;
  if (given(c.triaxial_strength)) check_triaxial_strength(check);
  if (c.targets.empty() && !check.parameters().faults().any_in("Calibrate"))
    check.refuse(
        "Calibrate/Mode",
        "has nothing to search for. Allowed: bounds, abacus, or a wanted Young modulus, Poisson ratio or "
        "strength, or a Calibrate/Target 1.");
  for (const Target &target : c.targets)
    check_target(check, target);
  check_free_parameters(check);
  if (given(c.compressive_strength) && given(c.tensile_strength) &&
      c.compressive_strength <= c.tensile_strength)
    check.refuse("Calibrate/Tensile strength",
                 "is not below Calibrate/Compressive strength = " +
                     check.parameters().at("Calibrate/Compressive strength").text + ".");
}

} // namespace platen::apps
