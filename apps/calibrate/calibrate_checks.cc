// What platen-calibrate is asked for: whether it can be measured, and whether it is enough.
#include "apps/calibrate/calibrate_section.h"

#include <algorithm>

#include "apps/calibrate/choice.h"
#include "apps/scene/scene_check.h"
#include "apps/scene/units.h"
#include "apps/scene/values.h"

namespace platen::apps {
namespace {

bool has_parameter(const Scene &scene, FreeParameter parameter) {
  switch (parameter) {
    case FreeParameter::tensile_strength:
    case FreeParameter::shear_strength:
    case FreeParameter::modulus:
    case FreeParameter::radius_multiplier:
      return true;
    case FreeParameter::stiffness_ratio:
      return scene.bond.has("stiffness_ratio");
    case FreeParameter::poisson_ratio:
      return scene.bond.has("poisson_ratio");
    case FreeParameter::moment_contribution:
      return scene.bond.has("moment_contribution");
    case FreeParameter::friction_angle:
      return scene.bond.has("friction_angle");
    case FreeParameter::compression_limits:
      return !scene.bond.list("compression_limits").empty();
    case FreeParameter::contact_friction:
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
                     std::find(c.free.begin(), c.free.end(), FreeParameter::friction_angle) != c.free.end();
  const double own = freed ? not_given : check.scene().bond.number("friction_angle");
  if ((given(c.friction_low) ? c.friction_low : own) > (given(c.friction_high) ? c.friction_high : own))
    check.refuse(
        given(c.friction_low) ? "Calibrate/Smallest friction angle" : "Calibrate/Largest friction angle",
        given(c.friction_low) ? "is above the largest, or the bond's own where none is given."
                              : "is below the bond's own, which is the smallest where none is given.");
}

// What a test of it cannot be is found when its scene is read (require_tests).
void check_target(const SceneCheck &check, const Target &target) {
  if (target.is_elastic()) return;
  for (const char *strength : {"tensile_strength", "shear_strength"})
    if (check.scene().bond.number(strength) == 0)
      check.refuse(std::string("Bond/") + (strength[0] == 't' ? "Tensile strength" : "Shear strength"),
                   "is no number that the search for strengths could begin with. Allowed: > 0 Pa.");
  if (target.curve > 0)
    check.readable("Calibrate/Curve " + std::to_string(target.curve), target.file,
                   target.entry + " has its points there.");
}

void check_free_parameters(const SceneCheck &check) {
  const Calibrate &c = calibrate_of(check.scene());
  std::size_t count = 0;
  for (const Target &target : c.targets)
    count += target.kind == TargetKind::curve ? counts_of_a_curve : 1;
  if (c.free.size() + c.freed.size() > count)
    check.refuse(
        c.free.empty() ? "Calibrate/Parameter 1" : "Calibrate/Free",
        "frees more parameters than the targets can tell: " + std::to_string(c.free.size() + c.freed.size()) +
            " for " + std::to_string(count) + ". Allowed: as many as targets; a curve counts for three.");
  for (const FreeParameter parameter : c.free)
    if (!has_parameter(check.scene(), parameter))
      check.refuse("Calibrate/Free", "holds " + word_of(free_parameters, parameter) +
                                         ", which Effects/Bond = " + check.scene().bond.word() +
                                         " does not have here.");
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
    check.refuse("Calibrate/Mode",
                 "has nothing to search for. Allowed: bounds, abacus, or a Young modulus, Poisson ratio or "
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
