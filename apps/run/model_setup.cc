#include "apps/run/model_setup.h"

#include <string>

#include "apps/io/id_list.h"
#include "apps/scene/parameters.h"
#include "dem/effects.h"

namespace platen::apps {
namespace {

constexpr double standard_gravity = 9.80665; // m/s^2

dem::Phases phases(const PhasesSection &from) {
  dem::Phases to = from.phases;
  if (from.by != PhasesBy::radius) to.radius_above = not_given;
  if (from.by == PhasesBy::file) to.aggregate_ids = read_id_list(from.file);
  return to;
}

// A build may leave effects out; a scene that calls for one is refused at its entry.
void refuse_left_out(const Scene &scene, const dem::ModelSettings &to) {
  const auto check = [&](bool wanted, bool compiled, const char *entry, const char *allowed) {
    if (wanted && !compiled && scene.parameters)
      scene.parameters->refuse(entry, std::string("calls for an effect that this build leaves out "
                                                  "(PLATEN_EFFECTS). Allowed: ") +
                                          allowed + ".");
  };
  using namespace dem::compiled;
  check(to.rotation, rotation, "Effects/Rotation", "off");
  check(to.rotation && to.bond && bends(bond_law(*to.bond)), bond_moments, "Effects/Bond moments", "off");
  check(norm_squared(to.gravity) > 0, gravity, "Effects/Gravity", "off");
  check(to.energy_ledger, energy_ledger, "Effects/Energy ledger", "off");
  check(to.crack_log, crack_log, "Effects/Crack log", "off");
  check(to.bond_dashpot > 0, bond_dashpots, "Bond/Damping", "0");
  check(to.local_damping > 0, local_damping, "Integration/Damping", "0");
  check(to.strength_scatter.has_value(), strength_factors, "Bond/Strength scatter", "none");
  check(to.phases && to.phases->scatters(), strength_factors, "Phases/By", "none, or strength factors of 1");
  check(to.phi() > 1, dissipative_scheme, "Integration/Scheme", "velocity verlet");
  if (!to.contact) return;
  const dem::ContactSettings &c = *to.contact;
  const bool hertzian = c.normal == dem::NormalContact::hertz;
  check(hertzian, hertz, "Effects/Contact", "none, linear");
  check(c.tangential != dem::TangentialContact::none, friction, "Effects/Tangential", "none");
  check(c.tangential == dem::TangentialContact::coulomb_with_rolling, rolling, "Effects/Tangential",
        "none, coulomb");
  check(hertzian ? c.restitution < 1 : c.damping > 0, contact_dashpots,
        hertzian ? "Contact/Restitution" : "Contact/Damping", hertzian ? "1" : "0");
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
  to.bond_layout.by_range = scene.bond.bonds_by_range();
  if (scene.bond.bonded() && scene.bond.scattered) {
    to.strength_scatter = scene.bond.scatter;
    to.strength_scatter->seed = scene.general.seed;
  }
  if (scene.phases.by != PhasesBy::none) to.phases = phases(scene.phases);
  to.contact = contact_settings(scene);
  refuse_left_out(scene, to);
  return to;
}

} // namespace platen::apps
