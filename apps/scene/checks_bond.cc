// What acts between grains.
#include "apps/scene/scene_check.h"

#include <algorithm>

#include "apps/scene/units.h"

namespace platen::apps {

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

} // namespace platen::apps
