// What acts between grains.
#include <fmt/format.h>

#include "apps/scene/scene_check.h"

#include "apps/scene/units.h"

namespace platen::apps {

void SceneCheck::bond() const {
  const Gap &gap = scene_.model.bond_layout.gap;
  const double radius = scene_.specimen.sphere_radius;
  if (program_.bonds && !gap.relative && given(radius) && gap.value >= radius)
    refuse("Bond/Gap",
           "is as large as Specimen/Sphere radius = " + parameters_.at("Specimen/Sphere radius").text +
               ": a bare number is metres. Did you mean \"" + shortest_text(gap.value) + " R_min\"?");
  if (scene_.bond.scattered && !program_.packs)
    refuse("Bond/Strength scatter", "leaves no bond of a known strength to test. Allowed: none.");
  size_correction();
  calibrated_packing();
  if (!scene_.bond.bonded()) return;
  try {
    dem::bond_law(*scene_.bond.parameters());
  } catch (const BadParameter &e) {
    const std::string entry = parameters_.entry_of(e.owner + "." + e.member);
    if (parameters_.find(entry) == nullptr) throw;
    refuse(entry, e.reason);
  }
}

void SceneCheck::size_correction() const {
  const SizeCorrection &size = scene_.bond.size;
  const double radius = scene_.specimen.sphere_radius;
  if (!(size.reference > 0)) return;
  if (program_.presses == Presses::nothing && program_.bonds)
    refuse("Bond/Calibrated radius", "is of specimens between platens. Allowed: 0.");
  if (!given(radius))
    refuse("Bond/Calibrated radius", "needs the mean radius: Specimen/Sphere radius is not set.");
  const double width = scene_.specimen.width();
  if (size.by_width() && !given(width))
    return refuse("Bond/Calibrated width", "needs the specimen's own: Specimen/Radius is not set.");
  const double share = size.share(scene_.specimen);
  if (share >= SizeCorrection::least_share && share <= SizeCorrection::most_share) return;
  if (size.by_width()) {
    const double across = size.reference_width / (2 * size.reference);
    return refuse(
        "Bond/Calibrated width",
        fmt::format("with Calibrated radius = {} is for {:.3g} spheres across, and the specimen has "
                    "{:.3g} across its least width. Allowed: {:.3g} to {:.3g}.",
                    parameters_.at("Bond/Calibrated radius").text, across, width / (2 * radius),
                    across / SizeCorrection::most_share, across / SizeCorrection::least_share));
  }
  refuse("Bond/Calibrated radius",
         "is too far from Specimen/Sphere radius = " + parameters_.at("Specimen/Sphere radius").text +
             fmt::format(". Allowed: {:.2g} to {:.2g} times that; with Bond/Calibrated width spheres across "
                         "decide.",
                         1 / SizeCorrection::most_share, 1 / SizeCorrection::least_share));
}

void SceneCheck::calibrated_packing() const {
  const std::optional<PackingKind> wanted = scene_.bond.calibrated.packing;
  const PackingKind packing = scene_.specimen.packing;
  if (!wanted || packing == *wanted || packing == PackingKind::file) return;
  if (!program_.packs || !program_.bonds) return; // no packing, no bonds
  refuse("Specimen/Packing",
         "is not what the bonds are calibrated for, " + set_to("Bond/Calibrated packing") +
             ": with it they are another material. Allowed: " +
             parameters_.at("Bond/Calibrated packing").text + ", file, or Bond/Calibrated packing = any.");
}

void SceneCheck::phases() const {
  const PhasesSection &phases = scene_.phases;
  if (phases.by == PhasesBy::none) return;
  if (!program_.packs)
    refuse("Phases/By", "needs a packed specimen, of which platen-bonds has none. Allowed: none.");
  if (!scene_.bond.bonded())
    refuse("Phases/By", "tells bonds apart, but Effects/Bond = none. Allowed: none.");
  if (phases.by == PhasesBy::file)
    readable("Phases/File", phases.file, "Phases/By = file takes the ids from it.");
}

void SceneCheck::contact() const {
  const bool no_bond = !scene_.bond.bonded() && !given(scene_.model.bond_layout.modulus);
  const auto check = [&](const std::string &path, const Stiffness &stiffness, const std::string &instead) {
    if (no_bond && stiffness.kind == Stiffness::Kind::of_bond)
      refuse(path, "is a multiple of the bond's, but Effects/Bond = none. Allowed: " + instead + ".");
  };
  if (scene_.effects.contact == dem::NormalContact::linear && program_.bonds)
    check("Contact/Stiffness", scene_.contact.stiffness, "\"4e5 N/m\", \"0.01 bulk\"");
  if (loads() && !scene_.hertz_on_platens())
    check("Platens/Stiffness", scene_.platens.stiffness, "\"4e5 N/m\"");
  if (scene_.contact.rolling_friction > 0 && scene_.contact.tangential == dem::TangentialContact::none)
    refuse("Contact/Rolling friction", "needs Effects/Tangential = coulomb with rolling resistance.");
}

} // namespace platen::apps
