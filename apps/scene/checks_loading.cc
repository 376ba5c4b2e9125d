// Platens and what is done with them: what the library refuses of the settings (coupling/faults.h), by the
// entries that set them, and what only a scene can ask.
#include "apps/scene/scene_check.h"
#include "apps/scene/tubes.h"

#include <algorithm>

#include <fmt/format.h>

#include "apps/scene/settings.h"
#include "apps/scene/units.h"
#include "coupling/faults.h"

namespace platen::apps {
namespace {

// The first entry of a stage that the scene sets: messages about what lacks stand at its line.
std::string first_entry(const Parameters &parameters, const std::string &section) {
  for (const Entry &entry : parameters.entries())
    if (entry.path.rfind(section + "/", 0) == 0 && entry.changed()) return entry.path;
  return section + "/Until";
}

// A platen that says nothing itself takes what stands for all.
std::string blamed(const Parameters &parameters, const std::string &entry) {
  const std::string common = "Platens/" + last_name(entry);
  const bool of_side = entry.rfind("Platens/", 0) == 0 && std::count(entry.begin(), entry.end(), '/') == 2;
  return of_side && !parameters.at(entry).changed() && parameters.find(common) != nullptr ? common : entry;
}

} // namespace

void SceneCheck::test() const {
  if (!loads()) return;
  const SpecimenSection &specimen = scene_.specimen;
  const bool lies = scene_.loading.bending() && specimen.shape == SpecimenShape::bar && !specimen.round(),
             discs = program_.presses == Presses::discs;
  dem::Shape shape = specimen_shape(scene_);
  if (discs && shape.kind == dem::ShapeKind::cylinder) shape = dem::disc(shape.radius, shape.height);
  const bool known =
      specimen.packing != PackingKind::file && !lies && (!discs || shape.kind == dem::ShapeKind::disc);
  if (program_.presses_specimens()) shape.notch = specimen.notch;
  for (const coupling::Fault &fault :
       coupling::faults(settings_without_files(scene_), known ? &shape : nullptr)) {
    const std::string entry = blamed(parameters_, parameters_.entry_of(fault.member)),
                      section = section_of(entry), reason = parameters_.with_entries(fault.reason);
    const bool of_stage = section.rfind("Loading/Stage ", 0) == 0;
    if (of_stage && !parameters_.at(entry).changed())
      refuse(first_entry(parameters_, section), "is of a stage whose " + entry + " " + reason);
    else
      refuse(entry, reason);
  }
}

// What only some programs do, and what they need for it.
void SceneCheck::asked_of_program() const {
  if (!loads()) return;
  const Loading &loading = scene_.loading;
  const Platens &platens = scene_.platens;
  const auto only = [&](bool asked, const std::string &path, const std::string &allowed) {
    if (asked && !program_.presses_specimens())
      refuse(path, "is for platen-compress. Allowed: " + allowed + ".");
  };
  only(platens.sides != PlatenSides::two, "Platens/Sides", "two");
  if (program_.presses != Presses::discs) { // of discs the library says which have no meaning
    only(platens.spherical_seat, "Platens/Top/Seat", "fixed");
    only(platens.seat_friction_arm != 0, "Platens/Top/Seat friction arm", "0");
    only(platens.eccentricity != 0, "Platens/Top/Eccentricity", "0");
    only(platens.tilt != 0, "Platens/Top/Tilt", "0");
  }
  only(loading.start_strain > 0, "Loading/Start strain", "0");
  only(loading.bending(), "Loading/Test", "compression");
  only(loading.sleeved(), "Loading/Confinement", "none, particles");
  if (loading.staged()) only(true, first_entry(parameters_, section_of_stage(1)), "no stages");
  if (program_.presses == Presses::trials && platens.deformable)
    refuse("Platens/Kind", "is for platen-compress and platen-brazilian. Allowed: rigid.");
  if (program_.presses == Presses::trials && platens.machine.yields())
    refuse("Platens/Machine stiffness",
           "is not for platen-calibrate: it looks for what holds under any machine. Allowed: not set.");
  if (program_.presses == Presses::discs && loading.test != LoadingTest::compression)
    refuse("Loading/Test", "does not go with platen-brazilian. Allowed: compression.");
  if (program_.presses == Presses::discs && loading.confined())
    refuse("Loading/Confinement", "does not go with platen-brazilian. Allowed: none.");
}

void SceneCheck::platens() const {
  if (!loads()) return;
  if (!situation().given_by_program("Platens/Surface")) surfaces();
  if (scene_.platens.deformable)
    layers();
  else if (scene_.platens.yielding)
    refuse("Platens/Material law",
           "yields, but Platens/Kind = rigid. Allowed: elastic, or deformable platens.");
  meshes();
}

void SceneCheck::loading() const {
  if (!loads()) return;
  const Loading &loading = scene_.loading;
  if (loading.servo && loading.ramp == 0)
    refuse("Platens/Top/Control", "needs Loading/Ramp > 0: the time to the full stress.");
  if (loading.bending()) need("Platens/Span", scene_.platens.span, "a bar needs its supports.");
  if (loading.tubed()) tube();
  if (loading.hydrostatic() && loading.confinement == ConfinementKind::none)
    refuse("Loading/Test",
           "needs Loading/Confinement = particles, sleeve: the lateral surface is pressed too.");
  const bool varied = situation().given_by_program("Loading/Confining pressure");
  if (loading.confined() && !loading.staged() && !varied && !(loading.cell->pressure > 0))
    refuse("Loading/Confinement", "needs Loading/Confining pressure > 0.");
  for (std::size_t k = 0; k < loading.stages.size(); ++k)
    if (!loading.stage_sections[k].given())
      for (std::size_t later = k; later < most_stages; ++later)
        if (loading.stage_sections[later].given())
          return refuse(first_entry(parameters_, section_of_stage(later + 1)),
                        "is of a stage without the one before it: " + section_of_stage(k + 1) +
                            " is empty. Allowed: stages " + "without a gap.");
}

void SceneCheck::tube() const {
  const Loading &loading = scene_.loading;
  if (loading.hydrostatic()) refuse("Sleeve/Kind", "presses nothing in a hydrostatic test. Allowed: rubber.");
  if (loading.cell->pressure > 0)
    refuse("Loading/Confining pressure",
           "does not go with Sleeve/Kind = tube or wrap, which stand in no cell. Allowed: 0.");
  const coupling::SleeveSettings &wall = *loading.cell->sleeve;
  if (loading.wrapped()) {
    if (!parameters_.at("Sleeve/Thickness").changed())
      refuse("Sleeve/Thickness", "is that of rubber: a wrap needs its own. Allowed: that of the wrap.");
    return;
  }
  if (!parameters_.at("Sleeve/Modulus").changed() && loading.steel == Steel::custom)
    refuse("Sleeve/Modulus",
           "is that of rubber: a tube of custom steel needs its own. Allowed: that of the metal, or a "
           "Sleeve/Steel.");
  if (wall.metal->ultimate_strength > 0 && !loading.hardening_file.empty())
    refuse("Sleeve/Hardening file", "does not go with Sleeve/Ultimate strength. Allowed: one of both.");
  if (wall.recess > 0 && wall.clearance == 0 && loading.stop_at_residual > 0 && !loading.staged())
    refuse("Loading/Stop at residual",
           "watches the stress of a specimen that Sleeve/Recess keeps off the platens. Allowed: 0.");
  if (!loading.hardening_file.empty()) read_hardening(loading.hardening_file, wall.metal->yield_strength);
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

void SceneCheck::layers_of(const std::string &path, const std::vector<NamedLayer> &layers, bool plate) const {
  if (layers.empty() || !plate) return;
  double sum = 0; // m
  for (const NamedLayer &layer : layers) {
    if (!given(layer.thickness))
      refuse(path, "gives " + layer.material + " no thickness. Allowed: \"" + layer.material + " 2 mm\".");
    sum += layer.thickness;
  }
  constexpr double round_off = 1e-9;
  const bool thick = parameters_.at("Platens/Thickness").changed();
  if (thick && sum > (1 + round_off) * scene_.platens.thickness)
    refuse(path, "is " + fmt::format("{:.6g}", sum) + " m together. Allowed: up to " +
                     shortest_text(scene_.platens.thickness) + " m, Platens/Thickness.");
}

void SceneCheck::layers() const {
  const Platens &platens = scene_.platens;
  const bool top_plate = platens.face(coupling::Side::top).mesh_file.empty(),
             bottom_plate = platens.face(coupling::Side::bottom).mesh_file.empty();
  layers_of("Platens/Layers", platens.layers,
            (top_plate && platens.top_layers.empty()) || (bottom_plate && platens.bottom_layers.empty()));
  layers_of("Platens/Top/Layers", platens.top_layers, top_plate);
  layers_of("Platens/Bottom/Layers", platens.bottom_layers, bottom_plate);
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

} // namespace platen::apps
