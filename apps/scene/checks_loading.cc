// Platens, and what is done with them.
#include "apps/scene/scene_check.h"

#include <algorithm>

#include "apps/scene/units.h"

namespace platen::apps {

using By = dem::Weakening::By;

void SceneCheck::friction(coupling::Side of) const {
  const dem::SurfaceFriction &side = scene_.platens.at(of);
  if (side.friction_dynamic <= side.friction_static) return;
  const std::string own = section_of(of) + "/Friction dynamic", common = "Platens/Friction dynamic";
  const std::string blamed = parameters_.at(own).changed() ? own : common;
  refuse(blamed, "is above the static friction, " + shortest_text(side.friction_static) + ", of the " +
                     coupling::name_of(of) + " platen. Allowed: 0 ... " +
                     shortest_text(side.friction_static) + ".");
}

void SceneCheck::weakening(coupling::Side of) const {
  const dem::SurfaceFriction &side = scene_.platens.at(of);
  if (side.weakening.by == By::nothing) return;
  const bool by_slip = side.weakening.by == By::slip;
  const std::string own = section_of(of) + "/Friction law",
                    blamed = parameters_.at(own).changed() ? own : "Platens/Friction law";
  if (!given(by_slip ? side.weakening.slip_length : side.weakening.slip_velocity))
    refuse(blamed, std::string("needs Platens/Slip ") + (by_slip ? "length > 0 m." : "velocity > 0 m/s."));
  if (side.friction_dynamic == side.friction_static)
    refuse(blamed, "has nothing to fall to. Allowed: a Friction dynamic below the static one, " +
                       shortest_text(side.friction_static) + ".");
}

void SceneCheck::platens() const {
  const Platens &platens = scene_.platens;
  if (loads() && !situation().given_by_program("Platens/Surface")) surfaces();
  for (const coupling::Side side : sides_of_scene)
    if (platens.has(side)) friction(side), weakening(side);
  const bool tension = scene_.loading.test == LoadingTest::tension, stress = scene_.loading.servo;
  if (loads() && tension && !platens.glued)
    refuse("Loading/Test", "needs Platens/Attachment = glued: a platen in contact cannot pull.");
  if (stress && scene_.loading.top_stress == 0)
    refuse("Platens/Top/Control", "needs Platens/Top/Stress > 0.");
  if (stress && scene_.loading.ramp == 0)
    refuse("Platens/Top/Control", "needs Loading/Ramp > 0: the time to the full stress.");
  if (stress && tension)
    refuse("Platens/Top/Control", "presses, but Loading/Test = tension. Allowed: motion.");
  if (loads() && platens.deformable) deformable_platens();
  if (loads() && platens.machine.yields()) machine();
  if (loads() && platens.deformable) layers();
  if (loads() && platens.spherical_seat) seat();
  if (loads()) meshes();
}

void SceneCheck::machine() const {
  const auto refuse_spring = [&](const std::string &why) { refuse("Platens/Machine stiffness", why); };
  if (program_.presses == Presses::trials)
    refuse_spring(
        "is not for platen-calibrate: it looks for what holds under any machine. Allowed: not set.");
  if (scene_.loading.start_strain > 0)
    refuse_spring("is not carried to a start without inertia. Allowed: Loading/Start strain = 0.");
  if (scene_.platens.machine.damping > 0) return;
  const std::string swings = "lets a servo swing on the spring. Allowed: above 0, or ";
  if (scene_.loading.servo) refuse("Platens/Machine damping", swings + "Platens/Top/Control = motion.");
  if (scene_.loading.confined()) refuse("Platens/Machine damping", swings + "Loading/Confinement = none.");
}

// What a word needs besides the entries that it stands for.
void SceneCheck::surfaces() const {
  const Platens &platens = scene_.platens;
  const bool rubber = platens.surface == SurfaceKind::rubber_sheet,
             brush = platens.surface == SurfaceKind::brush;
  if ((rubber || brush) && !platens.deformable)
    refuse("Platens/Surface", "yields, but Platens/Kind = rigid. Allowed: deformable.");
  if (rubber && platens.elastic->pad_thickness == 0 && platens.layers.empty())
    refuse("Platens/Surface",
           "needs the sheet: Platens/Pad thickness, Pad modulus, Pad Poisson ratio and Pad "
           "density, or Layers, which have no defaults.");
  std::string brushes; // of all sides, where one lacks its own
  for (const coupling::Side side : sides_of_scene)
    if (platens.has(side)) brushes += (brushes.empty() ? "" : " and ") + section_of(side) + "/Mesh file";
  if (brush && platens.any_of([&](coupling::Side side) { return platens.face(side).mesh_file.empty(); }))
    refuse("Platens/Surface", "needs the brushes: " + brushes + ", as scripts/brush_platen.py writes them.");
  if (platens.surface == SurfaceKind::glued && !platens.glued)
    refuse("Platens/Surface", "ties the ends, but Platens/Attachment = contact. Allowed: glued.");
}

void SceneCheck::deformable_platens() const {
  const Loading &loading = scene_.loading;
  const auto refuse_kind = [&](const std::string &why) { refuse("Platens/Kind", why + " Allowed: rigid."); };
  if (program_.presses == Presses::trials) refuse_kind("is for platen-compress and platen-brazilian.");
  if (scene_.model.scheme != dem::Scheme::velocity_verlet)
    refuse_kind("needs Integration/Scheme = velocity verlet.");
  if (loading.start_strain > 0)
    refuse_kind("needs Loading/Start strain = 0: the static solve is between rigid ends.");
  const double pad = scene_.platens.elastic->pad_thickness;
  const bool plates = scene_.platens.any_of([&](coupling::Side side) {
    return scene_.platens.face(side).mesh_file.empty();
  }); // which have the thickness
  if (pad > 0 && plates && pad >= scene_.platens.thickness)
    refuse("Platens/Pad thickness", "leaves nothing of the platen. Allowed: 0 ... " +
                                        shortest_text(scene_.platens.thickness) + " m, Platens/Thickness.");
}

void SceneCheck::meshes() const {
  for (const coupling::Side side : sides_of_scene) {
    const std::string &file = scene_.platens.face(side).mesh_file, path = section_of(side) + "/Mesh file";
    if (file.empty() || !scene_.platens.has(side)) continue;
    readable(path, file, "");
    if (scene_.loading.bending()) refuse(path, "does not go with Loading/Test = three point bending.");
    if (scene_.platens.strip_width > 0) refuse(path, "does not go with Platens/Strip width. Allowed: 0.");
  }
}

void SceneCheck::loading() const {
  if (situation().rate_by_transits()) wave_transits();
  if (scene_.loading.rate_multiplier > 1 && !scene_.bond.bonded())
    refuse("Loading/Hurry", "needs bonds: they tell when the specimen fails. Allowed: 1.");
}

// What breaks at a tenth of the strain, or oscillates, would be struck at a speed that suits compression.
void SceneCheck::wave_transits() const {
  const LoadingTest test = scene_.loading.test;
  if (scene_.loading.hydrostatic()) return;
  const auto refuse_rate = [&](const std::string &why) {
    refuse("Loading/Wave crossings", why + " Allowed: an Axial rate.");
  };
  if (test != LoadingTest::compression && test != LoadingTest::uniaxial_strain)
    refuse_rate("sets no speed but of Loading/Test = compression, uniaxial strain.");
  if (!scene_.bond.bonded()) refuse_rate("needs bonds: they carry the wave.");
}

void SceneCheck::start() const {
  const Loading &loading = scene_.loading;
  if (!(loading.start_strain > 0)) return;
  const auto refuse_start = [&](const std::string &why) { refuse("Loading/Start strain", why); };
  if (!program_.presses_specimens()) refuse_start("is for platen-compress. Allowed: 0.");
  if (loading.test != LoadingTest::compression)
    refuse_start("needs Loading/Test = compression: the solve presses. Allowed: 0.");
  if (loading.confinement != ConfinementKind::none)
    refuse_start("does not go with Loading/Confinement. Allowed: 0.");
  if (scene_.loading.servo) refuse_start("needs Platens/Top/Control = motion. Allowed: 0.");
  if (!scene_.bond.bonded()) refuse_start("needs bonds to solve for. Allowed: 0.");
  if (scene_.bond.remembers())
    refuse_start("needs bonds without a memory: Effects/Bond = " + std::string(scene_.bond.word()) +
                 " answers to its whole path. Allowed: 0.");
  if (scene_.effects.gravity) refuse_start("does not go with Effects/Gravity = on. Allowed: 0.");
  if (loading.start_strain >= loading.target_strain)
    refuse_start("is not below Loading/Target strain = " + parameters_.at("Loading/Target strain").text +
                 ".");
  if (!loading.unload_at.empty() && loading.start_strain >= loading.unload_at.front())
    refuse_start("is not below the first of Loading/Unload at.");
}

void SceneCheck::splitting() const {
  if (program_.presses != Presses::discs) return;
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
  if (!program_.presses_specimens()) refuse("Loading/Test", "bends bars: for platen-compress.");
  const bool round = specimen.shape == SpecimenShape::cylinder || specimen.round();
  if (round && specimen.packing != PackingKind::file)
    refuse("Specimen/Shape", with + "box, rectangular bar.");
  if (specimen.ends != dem::EndPreparation::ground) refuse("Specimen/Ends", with + "ground.");
  need("Platens/Span", platens.span, "a bar needs its supports.");
  if (platens.strip_width == 0)
    refuse("Platens/Strip width", "is not set: a bar is bent by strips. Allowed: > 0 m.");
  if (platens.glued) refuse("Platens/Attachment", with + "contact.");
  if (scene_.loading.servo) refuse("Platens/Top/Control", with + "motion.");
  if (scene_.loading.confinement != ConfinementKind::none) refuse("Loading/Confinement", with + "none.");
  if (!scene_.bond.bonded())
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
  if (loading.hydrostatic() || scene_.loading.servo)
    refuse("Loading/Unload at", "needs platens that are driven by motion.");
}

void SceneCheck::cell() const {
  const Loading &loading = scene_.loading;
  if (loading.servo_gain > 0 && loading.servo_gain < 0.1)
    refuse("Loading/Servo gain", "is too slow to hold anything. Allowed: 0, or 0.1 ... 10.");
  if (loading.walled() && loading.confinement != ConfinementKind::none)
    refuse("Loading/Confinement", "does not go with Loading/Test = uniaxial strain. Allowed: none.");
  if (loading.hydrostatic() && !loading.confined())
    refuse("Loading/Test",
           "needs Loading/Confinement = particles, sleeve: the lateral surface is pressed too.");
  if (!loading.confined()) return;
  const bool varied = situation().given_by_program("Loading/Confining pressure");
  if (loads() && !loading.staged() && !varied && !(loading.cell->pressure > 0))
    refuse("Loading/Confinement", "needs Loading/Confining pressure > 0.");
  if (loads() && !scene_.bond.bonded())
    refuse("Loading/Confinement",
           "needs bonds: they tell the specimen from what has come loose. Allowed: none.");
  if (scene_.loading.servo)
    refuse("Platens/Top/Control",
           "does not go with Loading/Confinement: the pressure holds the platen at first, then it moves. "
           "Allowed: motion.");
  if (!loading.sleeved()) return;
  if (!program_.presses_specimens())
    refuse("Loading/Confinement", "is for platen-compress. Allowed: none, particles.");
  if (scene_.specimen.packing != PackingKind::file && scene_.specimen.shape != SpecimenShape::cylinder)
    refuse("Loading/Confinement", "goes around a cylinder. Allowed: none, particles.");
  if (scene_.model.scheme != dem::Scheme::velocity_verlet)
    refuse("Integration/Scheme", "does not go with Loading/Confinement = sleeve. Allowed: velocity verlet.");
  if (loading.cell->sleeve->mass_scaling > 0 && loading.cell->sleeve->mass_scaling < 1)
    refuse("Sleeve/Mass scaling", "makes the sleeve lighter. Allowed: 0, or 1 and more.");
  if (loading.cell->sleeve->elements_around > 0 && loading.cell->sleeve->elements_around < 8)
    refuse("Sleeve/Elements around", "is too few for a tube. Allowed: 0, or 8 and more.");
}

} // namespace platen::apps
