// The specimen, its grains, and which effects act between them.
#include "apps/scene/sections.h"

namespace platen::apps {

void declare_specimen(Parameters &parameters, SpecimenSection &specimen) {
  Section section(parameters, "Specimen");
  section.word<SpecimenShape>(
      "Shape", specimen.shape,
      {{"cylinder", SpecimenShape::cylinder},
       {"box", SpecimenShape::box},
       {"bar", SpecimenShape::bar},
       {"disc", SpecimenShape::disc}},
      "Shape of the specimen; its axis is z. A bar is round (Radius) or rectangular; a disc (Radius, Height) "
      "is laid on its rim by platen-brazilian. Test = three point bending bends a box that is long along x, "
      "or lays a rectangular bar down along x with its x up.");
  section.quantity("Radius", specimen.radius, "m", above(0), "Radius of a cylinder or round bar.");
  section.quantity("Height", specimen.height, "m", above(0), "Extent along z.");
  section.quantity("Width x", specimen.width_x, "m", above(0), "Width of a box or rectangular bar along x.");
  section.quantity("Width y", specimen.width_y, "m", above(0), "Width of a box or rectangular bar along y.");
  section.quantity("Sphere radius", specimen.sphere_radius, "m", above(0), "Mean radius of the spheres.");
  section.number("Radius spread", specimen.radius_spread, between(0, 1.5),
                 "Kappa, largest minus smallest radius over the mean (Radius distribution = uniform).");
  section.word<RadiusDistribution>("Radius distribution", specimen.radius_distribution,
                                   {{"equal", RadiusDistribution::equal},
                                    {"two sizes", RadiusDistribution::two_sizes},
                                    {"uniform", RadiusDistribution::uniform}},
                                   "How radii are drawn; uniform with a spread of 0 is equal spheres.");
  section.number("Second radius ratio", specimen.second_radius_ratio, above_up_to(0, 1),
                 "Two sizes: smaller radius over the larger one.");
  section.number("Second fraction", specimen.second_fraction, between(0, 1),
                 "Two sizes: share of the number of spheres that has the smaller radius.");
  section.word<PackingKind>("Packing", specimen.packing,
                            {{"advancing front", PackingKind::advancing_front},
                             {"random close", PackingKind::random_close},
                             {"file", PackingKind::file}},
                            "How the spheres are placed; file takes them from File.");
  section.file("File", specimen.file, "A specimen.csv to load (Packing = file).");
  section.word<EndsKind>(
      "Ends", specimen.ends, {{"as packed", EndsKind::as_packed}, {"ground", EndsKind::ground}},
      "As packed: the platens meet spheres where they are. Ground: spheres of the end layer are "
      "seated flush, as if sawn.");
  section.number("End layer", specimen.end_layer, between(0.05, 10),
                 "Depth of the ground layer in mean sphere radii; it decides the strength below 1.");
  section.flag("Seat", specimen.seat, "Ground spheres resist rocking on the platen by their flat face.");
}

void declare_material(Parameters &parameters, Material &material) {
  Section section(parameters, "Material");
  section.quantity("Density", material.density, "kg/m3", above(0), "Density of the grains, or of the solid.");
  section.word<DensityOf>("Density of", material.density_of,
                          {{"grains", DensityOf::grains}, {"solid", DensityOf::solid}},
                          "Solid: grains are heavier, so that the specimen with its voids has that density.");
  section.quantity("Young modulus", material.young_modulus, "Pa", above(0),
                   "Young modulus of the grains (hertz contact; bulk stiffness of linear contact).");
  section.number("Poisson ratio", material.poisson_ratio, between_open(-1, 0.5),
                 "Poisson ratio of the grains.");
}

void declare_effects(Parameters &parameters, Effects &effects) {
  Section section(parameters, "Effects");
  section.word<BondKind>("Bond", effects.bond,
                         {{"none", BondKind::none},
                          {"parallel bond", BondKind::parallel_bond},
                          {"cohesive beam", BondKind::cohesive_beam},
                          {"elasto damage plastic", BondKind::elasto_damage_plastic}},
                         "What holds the grains together.");
  section.word<ContactKind>(
      "Contact", effects.contact,
      {{"none", ContactKind::none}, {"linear", ContactKind::linear}, {"hertz", ContactKind::hertz}},
      "Normal force between grains that touch without a bond.");
  section.word<TangentialKind>(
      "Tangential", effects.tangential,
      {{"none", TangentialKind::none},
       {"coulomb", TangentialKind::coulomb},
       {"coulomb with rolling resistance", TangentialKind::coulomb_with_rolling_resistance}},
      "Friction between grains that touch without a bond.");
  section.flag("Rotation", effects.rotation, "Grains turn; without it bonds and contacts carry no moments.");
  section.flag("Bond moments", effects.bond_moments,
               "Bonds resist bending and twisting; without it they carry forces alone (needs Rotation).");
  section.flag("Gravity", effects.gravity, "9.80665 m/s2 along -z.");
  section.flag("Energy ledger", effects.energy_ledger,
               "Energies and works in history.csv; without it their columns are nan.");
  section.flag("Crack log", effects.crack_log, "cracks.csv; without it broken bonds are counted alone.");
}

void declare_contact(Parameters &parameters, Contact &contact) {
  Section section(parameters, "Contact");
  section.number("Friction", contact.friction, between(0, 5), "Coefficient of friction between grains.");
  section.stiffness(
      "Stiffness", contact.stiffness, true,
      "Normal stiffness of linear contact; \"bulk\" is a multiple of what the bulk modulus of the grains "
      "gives (NormK of LS-DYNA).");
  section.number("Tangential ratio", contact.tangential_ratio, between(0, 5),
                 "Tangential over normal stiffness of linear contact.");
  section.number("Damping", contact.damping, between(0, 1), "Linear contact: fraction of critical damping.");
  section.number("Restitution", contact.restitution, above_up_to(0, 1),
                 "Hertz contact: coefficient of restitution.");
  section.number("Rolling friction", contact.rolling_friction, between(0, 5),
                 "Largest rolling moment over normal force and effective radius.");
}

} // namespace platen::apps
