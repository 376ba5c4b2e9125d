// Entries that were set and have no effect: as declared, then what several entries or the app decide.
#include "apps/scene/scene_check.h"

namespace platen::apps {

void SceneCheck::note(const std::string &path, const std::string &why) {
  const Entry &entry = parameters_.at(path);
  if (!entry.changed() || entry.origin.file.empty()) return;
  scene_.notes.push_back(entry.origin.text() + ": note: " + path + " = " + entry.text +
                         " has no effect: " + why + ".");
}

void SceneCheck::notes_of_declarations() {
  for (const Entry &entry : parameters_.entries())
    for (const auto &idle : entry.idle) {
      const std::string why = idle({scene_, parameters_, app_});
      if (why.empty()) continue;
      note(entry.path, why);
      break;
    }
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
    if (scene_.effects.contact) note("Effects/Contact", "Bar test/Method = static");
  }
  if (scene_.bar_test.load != BarLoad::bending && scene_.bar_test.load != BarLoad::all)
    note("Bar test/Bent along", "nothing is bent");
}

void SceneCheck::pair_notes() {
  if (!scene_.bond.remembers()) {
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
  notes_of_declarations();
  loading_notes();
  bar_notes();
  if (app_ == AppKind::calibrate && !given(scene_.calibrate.triaxial_strength))
    note("Calibrate/Confining pressure", "Calibrate/Triaxial strength is not set");
  if (app_ == AppKind::bonds && scene_.pair_test.particles == 2)
    for (const char *key : {"Pair test/Plate", "Pair test/Base bond"})
      note(key, "Pair test/Particles = 2");
  if (app_ == AppKind::bonds) pair_notes();
}

} // namespace platen::apps
