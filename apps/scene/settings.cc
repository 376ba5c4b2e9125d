#include "apps/scene/settings.h"

#include <cmath>

#include "apps/scene/program.h"
#include "base/portable.h"

namespace platen::apps {
namespace {

constexpr double standard_gravity = 9.80665; // m/s^2

// Those of sides that stay free are left out.
coupling::PlatenSettings platen_settings(const Scene &scene) {
  using coupling::Side;
  Platens all = scene.platens;
  if (!all.has(Side::left)) all.left.reset(), all.right.reset();
  if (!all.has(Side::front)) all.front.reset(), all.back.reset();
  if (!all.yielding) all.elastic->metal.reset();
  if (!all.deformable) all.elastic.reset();
  if (!scene.loading.bending()) all.span = not_given;
  const auto is_plate = [&](coupling::Side side) { return all.face(side).mesh_file.empty(); };
  if (!all.any_of(is_plate)) all.thickness = 0; // meshes are as thick as they are
  return all;
}

// Entries that do not apply to a kind of sleeve do not act on it.
void leave_out_other_kinds(coupling::SleeveSettings &sleeve, SleeveKind kind) {
  if (kind != SleeveKind::tube) sleeve.metal.reset(), sleeve.recess = 0;
  if (kind != SleeveKind::wrap) sleeve.wrap.reset();
  if (kind == SleeveKind::rubber) sleeve.contact.bond = {}, sleeve.gap = sleeve.clearance = 0;
}

} // namespace

dem::Shape specimen_shape(const Scene &scene) {
  const SpecimenSection &specimen = scene.specimen;
  const bool round = specimen.shape == SpecimenShape::cylinder || specimen.shape == SpecimenShape::disc ||
                     (specimen.shape == SpecimenShape::bar && specimen.round());
  return round ? dem::cylinder(specimen.radius, specimen.height)
               : dem::box(specimen.width_x, specimen.width_y, specimen.height);
}

std::optional<dem::ContactSettings> contact_settings(const Scene &scene) {
  if (!scene.effects.contact) return std::nullopt;
  dem::ContactSettings to = scene.contact;
  to.normal = *scene.effects.contact;
  return to;
}

dem::ModelSettings model_without_files(const Scene &scene) {
  dem::ModelSettings to = scene.model;
  if (scene.effects.gravity) to.gravity = {0, 0, -standard_gravity};
  to.bond = scene.bond.parameters();
  if (scene.bond.size.reference > 0) {
    const double share = scene.bond.size.share(scene.specimen);
    to.bond = scene.bond.for_size(share).parameters();
    to.bond_layout.modulus *= portable::pow(share, scene.bond.size.modulus_exponent);
  }
  to.bond_layout.by_range = scene.bond.bonds_by_range();
  if (scene.bond.bonded() && scene.bond.scattered) {
    to.strength_scatter = scene.bond.scatter;
    to.strength_scatter->seed = scene.general.seed;
  }
  if (scene.phases.by != PhasesBy::none) to.phases = scene.phases.phases;
  if (scene.phases.by == PhasesBy::file) to.phases->radius_above = not_given;
  to.contact = contact_settings(scene);
  if (scene.program != nullptr && scene.program->packs)
    for (const std::optional<dem::Flaw> &flaw : scene.specimen.flaws)
      if (flaw) to.bond_choice.flaws.push_back(*flaw);
  return to;
}

coupling::PlatenTestSettings settings_without_files(const Scene &scene) {
  coupling::PlatenTestSettings to;
  to.model = model_without_files(scene);
  to.ends = scene.specimen.ends;
  to.end_layer = scene.specimen.end_layer;
  if (to.ends > coupling::Ends::ground) to.end_height = scene.specimen.end_height;
  to.end_faces = scene.specimen.end_faces;
  to.end_seed = scene.general.seed;
  to.seat = scene.specimen.seat;
  to.net_section = scene.specimen.net_section;
  to.platens = platen_settings(scene);
  to.loading = scene.loading;
  to.loading.tension = scene.loading.test == LoadingTest::tension;
  to.loading.wall = scene.loading.walled();
  to.loading.cell->alone = scene.loading.hydrostatic();
  coupling::SleeveSettings &sleeve = *to.loading.cell->sleeve;
  leave_out_other_kinds(sleeve, scene.loading.sleeve_kind);
  if (scene.loading.tubed()) to.loading.tube = sleeve;
  if (!scene.loading.sleeved()) to.loading.cell->sleeve.reset();
  if (!scene.loading.confined()) to.loading.cell.reset();
  to.time_step = scene.time_step;
  return to;
}

} // namespace platen::apps
