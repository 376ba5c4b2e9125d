// Entries that were set and have no effect, in the order of the sections.
#include "apps/scene/scene_check.h"

namespace platen::apps {

void SceneCheck::note(const std::string &path, const std::string &why) {
  const Entry &entry = parameters_.at(path);
  if (!entry.changed() || entry.origin.file.empty()) return;
  scene_.notes.push_back(entry.origin.text() + ": note: " + path + " = " + entry.text +
                         " has no effect: " + why + ".");
}

void SceneCheck::specimen_notes() {
  const SpecimenSection &specimen = scene_.specimen;
  if (specimen.packing != PackingKind::file) note("Specimen/File", "Specimen/Packing is not file");
  if (specimen.radius_distribution != RadiusDistribution::two_sizes)
    for (const char *key : {"Specimen/Second radius ratio", "Specimen/Second fraction"})
      note(key, "Specimen/Radius distribution is not two sizes");
  if (specimen.ends == EndsKind::as_packed) note("Specimen/End layer", "Specimen/Ends = as packed");
}

void SceneCheck::bond_notes() {
  if (scene_.bond.radius_rule != RadiusRule::given) note("Bond/Radius", "Bond/Radius rule is not given");
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

void SceneCheck::phases_notes() {
  if (scene_.phases.by != PhasesBy::radius) note("Phases/Radius above", "Phases/By is not radius");
  if (scene_.phases.by != PhasesBy::file) note("Phases/File", "Phases/By is not file");
  if (scene_.phases.by == PhasesBy::none)
    for (const char *key : {"Phases/Aggregate modulus factor", "Phases/Aggregate strength factor",
                            "Phases/Interface modulus factor", "Phases/Interface strength factor"})
      note(key, "Phases/By = none");
}

void SceneCheck::strength_notes() {
  if (scene_.bond.strength_scatter == StrengthScatter::none)
    note("Bond/Weibull modulus", "Bond/Strength scatter = none");
  else if (scene_.bond.tensile_strength == 0 && scene_.bond.shear_strength == 0)
    note("Bond/Strength scatter", "both strengths are infinite");
}

void SceneCheck::contact_notes() {
  const Effects &effects = scene_.effects;
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
}

void SceneCheck::friction_notes() {
  const auto none = [&](FrictionLaw law) {
    return scene_.platens.top.friction_law != law && scene_.platens.bottom.friction_law != law;
  };
  for (const char *side : {"Platens/", "Platens/Top/", "Platens/Bottom/"}) {
    if (none(FrictionLaw::slip_weakening))
      note(std::string(side) + "Slip length", "no Friction law is slip weakening");
    if (none(FrictionLaw::velocity_weakening))
      note(std::string(side) + "Slip velocity", "no Friction law is velocity weakening");
  }
}

void SceneCheck::loading_notes() {
  if (given(scene_.loading.axial_rate)) note("Loading/Wave crossings", "Loading/Axial rate is set");
  friction_notes();
  if (scene_.platens.kind == PlatenKind::rigid)
    for (const char *key :
         {"Platens/Young modulus", "Platens/Poisson ratio", "Platens/Motion", "Platens/Degree",
          "Platens/Body damping", "Platens/Steps per solve", "Platens/Pad thickness"})
      note(key, "Platens/Kind = rigid");
  else if (scene_.platens.motion == PlatenMotion::quasi_static)
    note("Platens/Body damping", "Platens/Motion = quasi-static");
  else
    note("Platens/Steps per solve", "Platens/Motion = explicit");
  const bool meshed = !scene_.platens.top.mesh_file.empty() || !scene_.platens.bottom.mesh_file.empty();
  if (!meshed) note("Platens/Mesh unit", "no platen has a Mesh file");
  if (scene_.platens.kind == PlatenKind::rigid || (scene_.platens.pad_thickness == 0 && !meshed))
    for (const char *key : {"Platens/Pad modulus", "Platens/Pad Poisson ratio", "Platens/Pad density"})
      note(key, "platens have no pad");
  if (scene_.platens.top_control == PlatenControl::stress)
    note("Loading/Hurry", "Platens/Top/Control = stress");
  else {
    note("Platens/Top/Stress", "Platens/Top/Control = motion");
    if (!scene_.loading.cell()) note("Loading/Hold", "Platens/Top/Control = motion");
  }
  if (!scene_.loading.cell())
    for (const char *key : {"Loading/Confining pressure", "Loading/Confining ramp", "Loading/Pressure path"})
      note(key, "Loading/Confinement = none");
  if (scene_.loading.hydrostatic()) note("Loading/Pressure path", "Loading/Test = hydrostatic");
  if (scene_.platens.top_control == PlatenControl::motion && !scene_.loading.cell())
    note("Loading/Servo gain", "Platens/Top/Control = motion");
  if (scene_.loading.confinement != ConfinementKind::particles)
    note("Loading/Confinement area", "Loading/Confinement is not particles");
  if (!scene_.loading.sleeved())
    for (const char *key :
         {"Thickness", "Modulus", "Poisson ratio", "Density", "Rims", "Elements around", "Elements through",
          "Friction", "Stiffness", "Seat depth", "Contact damping", "Damping", "Mass scaling"})
      note(std::string("Sleeve/") + key, "Loading/Confinement is not sleeve");
  if (!scene_.loading.bending()) note("Platens/Span", "Loading/Test is not three point bending");
  if (app_ != AppKind::brazilian && !scene_.loading.bending())
    note("Platens/Strip width", "only platen-brazilian and three point bending have strips");
  if (!scene_.loading.walled()) note("Loading/Wall stiffness", "Loading/Test is not uniaxial strain");
  if (scene_.loading.unload_at.empty()) note("Loading/Unload to", "Loading/Unload at is empty");
  if (scene_.loading.hydrostatic())
    for (const char *key :
         {"Loading/Axial rate", "Loading/Hurry", "Loading/Target strain", "Loading/Stop at residual"})
      note(key, "Loading/Test = hydrostatic");
}

void SceneCheck::bar_notes() {
  if (app_ != AppKind::bar) return;
  for (const char *key : {"Specimen/Ends", "Specimen/Seat"})
    note(key, "a bar is held by the spheres of its end");
  for (const char *key : {"Loading/Axial rate", "Loading/Target strain", "Platens/Friction static"})
    note(key, "a bar meets no platens");
  note("Output/Fields every", "platen-bar writes no frames");
  note("Checkpoint/Every", "platen-bar writes no checkpoints");
  if (scene_.bar_test.method == BarMethod::at_rest) {
    note("Bar test/Periods", "Bar test/Method = static");
    if (scene_.effects.contact != ContactKind::none) note("Effects/Contact", "Bar test/Method = static");
  }
  if (scene_.bar_test.load != BarLoad::bending && scene_.bar_test.load != BarLoad::all)
    note("Bar test/Bent along", "nothing is bent");
}

void SceneCheck::pair_notes() {
  if (scene_.effects.bond != BondKind::elasto_damage_plastic) {
    for (const char *key : {"Pair test/Turns", "Pair test/Pressure", "Pair test/Slip ratio"})
      note(key, "Effects/Bond is not elasto damage plastic");
    return;
  }
  for (const char *key :
       {"Integration/Damping", "Integration/Damping form", "Integration/Time step", "Bond/Damping"})
    note(key, "an elasto damage plastic bond is led without inertia");
  if (scene_.pair_test.path != PairPath::shear) note("Pair test/Pressure", "Pair test/Path is not shear");
  if (scene_.pair_test.path != PairPath::combined)
    note("Pair test/Slip ratio", "Pair test/Path is not combined");
}

void SceneCheck::notes() {
  specimen_notes();
  bond_notes();
  phases_notes();
  strength_notes();
  contact_notes();
  loading_notes();
  if (scene_.integration.damping == 0) note("Integration/Damping form", "Integration/Damping = 0");
  if (scene_.integration.scheme != Scheme::tchamwa_wielgosz)
    note("Integration/Dissipation", "Integration/Scheme is not tchamwa wielgosz");
  if (!scene_.output.fields) note("Output/Fields every", "Output/Fields = off");
  bar_notes();
  if (app_ == AppKind::calibrate && !given(scene_.calibrate.triaxial_strength))
    note("Calibrate/Confining pressure", "Calibrate/Triaxial strength is not set");
  if (app_ == AppKind::bonds && scene_.pair_test.particles == 2)
    for (const char *key : {"Pair test/Plate", "Pair test/Base bond"})
      note(key, "Pair test/Particles = 2");
  if (app_ == AppKind::bonds) pair_notes();
}

} // namespace platen::apps
