// Specimen and effects.
#include "apps/scene/scene_check.h"
#include "apps/scene/units.h"

namespace platen::apps {

void SceneCheck::cross_section() const {
  const SpecimenSection &specimen = scene_.specimen;
  const bool width = given(specimen.width_x) || given(specimen.width_y);
  const bool disc = specimen.shape == SpecimenShape::disc;
  const bool stated = specimen.packing != PackingKind::file || parameters_.at("Specimen/Shape").changed();
  if (stated && disc && program_.presses != Presses::discs && program_.bonds)
    refuse("Specimen/Shape", "lies on its rim, for platen-brazilian. Allowed: cylinder, box, bar.");
  if (stated && program_.presses == Presses::discs && !disc && specimen.shape != SpecimenShape::cylinder)
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
  if (specimen.packing == PackingKind::file) return; // its spheres are where they are
  const bool uniform = specimen.radius_distribution == RadiusKind::uniform;
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
  if (!program_.packs) need("Specimen/Sphere radius", specimen.sphere_radius, "the test needs a grain.");
  if (!program_.packs && scene_.model.density_of == dem::DensityOf::solid)
    refuse("Material/Density of",
           "needs a packed specimen, of which platen-bonds has none. Allowed: grains.");
  if (specimen.radius_spread > 0 && specimen.radius_distribution != RadiusKind::uniform)
    refuse("Specimen/Radius spread", "needs Specimen/Radius distribution = uniform.");
  if (specimen.seat && !are_ground(specimen.ends))
    refuse("Specimen/Seat", "needs Specimen/Ends = ground: only a ground sphere has a flat face.");
  if (specimen.seat && !scene_.model.rotation)
    refuse("Specimen/Seat", "needs Effects/Rotation = on: a seat resists rocking.");
  if (!program_.packs) return;
  if (program_.presses_specimens() && specimen.notch.is_there() && scene_.phases.by == PhasesBy::file)
    refuse("Phases/By", "numbers spheres of which a notch takes some away. Allowed: none, radius.");
  if (program_.presses_specimens() && specimen.notch.is_there() && !specimen.bond_file.empty())
    refuse("Specimen/Bond file",
           "names spheres of which a notch takes some away. Allowed: a Specimen/Flaw 1 that cuts.");
  cross_section();
  if (specimen.packing == PackingKind::file) {
    readable("Specimen/File", specimen.file, "Packing = file takes the spheres from it.");
    if (!specimen.bond_file.empty()) readable("Specimen/Bond file", specimen.bond_file, "");
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
  const bool rim = program_.presses == Presses::discs;
  const double extent = rim ? 2 * specimen.radius : specimen.height;
  const double layer = specimen.end_layer * specimen.sphere_radius;
  if (specimen.ends > dem::EndPreparation::ground && specimen.end_height > layer)
    refuse("Specimen/End height",
           "is deeper than the layer of spheres that are cut. Allowed: up to " + shortest_text(layer) +
               " m, Specimen/End layer times Specimen/Sphere radius, or a deeper layer.");
  if (are_ground(specimen.ends) && given(extent) && 2 * specimen.end_layer * specimen.sphere_radius > extent)
    refuse("Specimen/End layer", "is too deep: the two layers overlap in Specimen/" +
                                     std::string(rim ? "Radius" : "Height") + " = " +
                                     parameters_.at(rim ? "Specimen/Radius" : "Specimen/Height").text + ".");
}

void SceneCheck::effects() const {
  const Bond &bond = scene_.bond;
  const bool rotation = scene_.model.rotation, touching = scene_.effects.contact.has_value();
  if (scene_.contact.tangential == dem::TangentialContact::coulomb_with_rolling) {
    if (!rotation) refuse("Effects/Tangential", "needs Effects/Rotation = on.");
    if (!touching)
      refuse("Effects/Tangential", "needs a contact to roll on. Allowed: Effects/Contact = linear, hertz.");
  }
  if (bond.is<dem::CohesiveBeam>()) {
    const std::string with =
        "does not go with Effects/Bond = cohesive beam: beams bend and twist. Allowed: "
        "on, or Effects/Bond = parallel bond.";
    if (!rotation) refuse("Effects/Rotation", with);
    if (!std::get<dem::ParallelBond::Parameters>(bond.laws).moments) refuse("Effects/Bond moments", with);
  }
  if (!bond.bonded() && !touching && program_.bonds)
    refuse("Effects/Contact", "leaves nothing that acts between grains, because Effects/Bond = none too.");
}

} // namespace platen::apps
