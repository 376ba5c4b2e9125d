#include "apps/run/model_setup.h"

#include <cmath>
#include <string>

#include "apps/io/specimen_csv.h"
#include "base/portable.h"

namespace platen::apps {
namespace {

constexpr double standard_gravity = 9.80665; // m/s^2

dem::Phases phases(const PhasesSection &from) {
  dem::Phases to = from.phases;
  if (from.by != PhasesBy::radius) to.radius_above = not_given;
  if (from.by == PhasesBy::file) to.aggregate_ids = read_id_list(from.file);
  return to;
}

} // namespace

std::optional<dem::ContactSettings> contact_settings(const Scene &scene) {
  if (!scene.effects.contact) return std::nullopt;
  dem::ContactSettings to = scene.contact;
  to.normal = *scene.effects.contact;
  return to;
}

dem::ModelSettings model_settings(const Scene &scene) {
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
  if (scene.phases.by != PhasesBy::none) to.phases = phases(scene.phases);
  to.contact = contact_settings(scene);
  return to;
}

} // namespace platen::apps
