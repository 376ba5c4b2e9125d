#include "apps/run/problem_setup.h"

#include <algorithm>
#include <fstream>
#include <stdexcept>
#include <utility>

#include "apps/run/model_setup.h"
#include "apps/scene/errors.h"
#include "apps/scene/program.h"
#include "apps/scene/regular_file.h"
#include "apps/scene/tubes.h"
#include "dem/laws/normal_contact.h"
#include "fem/gmsh.h"
#include "fem/load_solids.h"

namespace platen::apps {
namespace {

struct Effect {
  bool on;
  std::string word, entry; // that switches it
};

// Every effect that a scene may have: its laws by their words, then the rest.
std::vector<Effect> effects(const Scene &s) {
  const dem::ModelSettings &m = s.model;
  const std::optional<dem::BondParameters> bond = s.bond.parameters();
  const std::optional<dem::ContactSettings> contact = contact_settings(s);
  const bool bonded = bond.has_value(), touching = contact.has_value();
  const dem::TangentialContact tangential = s.contact.tangential;
  std::vector<Effect> all{{bonded, bonded ? s.bond.word() : dem::BondLaws::words.front(), "Effects/Bond"}};
  for (const auto &[word, law] : dem::NormalContacts::words())
    all.push_back({s.effects.contact == law, word + " contact", "Effects/Contact"});
  const std::vector<Effect> others{
      {touching && tangential != dem::TangentialContact::none, "coulomb friction", "Effects/Tangential"},
      {touching && tangential == dem::TangentialContact::coulomb_with_rolling, "rolling resistance",
       "Effects/Tangential"},
      {m.rotation, "rotation", "Effects/Rotation"},
      {bonded && m.rotation && dem::bends(dem::bond_law(*bond)), "bond moments", "Effects/Rotation"},
      {s.effects.gravity, "gravity", "Effects/Gravity"},
      {m.local_damping > 0,
       m.damping_form == dem::DampingForm::vector ? "local damping along the velocity" : "local damping",
       "Integration/Damping"},
      {m.phi() > 1, "dissipative scheme", "Integration/Scheme"},
      {bonded && m.bond_dashpot > 0, "bond dashpots", "Bond/Damping"},
      {bonded && s.phases.by != PhasesBy::none, "phases", "Phases/By"},
      {bonded && s.bond.scattered, "scattered strengths", "Bond/Strength scatter"},
      {touching && contact->dashpot() > 0, "contact dashpots", "Contact/Damping"},
      {s.platens.deformable, "elastic platens", "Platens/Kind"},
      {s.platens.spherical_seat, "spherical seat", "Platens/Top/Seat"},
      {s.platens.seat_friction_arm > 0, "seat that sticks", "Platens/Top/Seat friction arm"},
      {s.platens.eccentricity != 0, "eccentric load", "Platens/Top/Eccentricity"},
      {s.platens.tilt != 0, "tilted platen", "Platens/Top/Tilt"},
      {s.specimen.ends > dem::EndPreparation::ground, "ends that are not flat", "Specimen/Ends"},
      {s.platens.damping > 0, "platen dashpots", "Platens/Damping"},
      {s.platens.any_of([&](coupling::Side side) { return s.platens.at(side).friction_static > 0; }),
       "platen friction", "Platens/Friction static"},
      {s.platens.any_of([&](coupling::Side side) {
         return s.platens.at(side).weakening.by != dem::Weakening::By::nothing;
       }),
       "weakening friction", "Platens/Friction law"},
      {s.platens.glued, "glued ends", "Platens/Attachment"},
      {s.loading.confinement == ConfinementKind::particles, "confinement on particles",
       "Loading/Confinement"},
      {s.loading.sleeved(),
       s.loading.wrapped() ? "wrap"
       : s.loading.tubed() ? "tube"
                           : "sleeve",
       "Loading/Confinement"},
      {s.loading.walled(), "lateral wall", "Loading/Test"},
      {!s.loading.unload_at.empty(), "unloading", "Loading/Unload at"},
      {s.specimen.seat, "seats", "Specimen/Seat"},
      {m.mass_scaling > 1, "mass scaling", "Integration/Mass scaling"},
      {m.energy_ledger, "energy ledger", "Effects/Energy ledger"},
      {bonded && m.crack_log, "crack log", "Effects/Crack log"},
      {s.output.fields, "fields", "Output/Fields"}};
  all.insert(all.end(), others.begin(), others.end());
  const auto given = [](const std::optional<dem::Flaw> &flaw) { return flaw.has_value(); };
  if (bonded && !s.specimen.bond_file.empty()) all.push_back({true, "bonds of a file", "Specimen/Bond file"});
  if (bonded && std::any_of(s.specimen.flaws.begin(), s.specimen.flaws.end(), given))
    all.push_back({true, "flaws", "Specimen/Flaw 1"});
  if (s.platens.machine.yields()) all.push_back({true, "machine spring", "Platens/Machine stiffness"});
  return all;
}

// Of a disc all effects that a specimen between platens may have are listed.
std::vector<std::string> chosen(const Scene &scene, bool on) {
  std::vector<std::string> words;
  const bool all = scene.program->presses == Presses::discs;
  for (const Effect &e : effects(scene))
    if (e.on == on && (all || scene.program->reads_entry(e.entry))) words.push_back(e.word);
  return words;
}

fem::Grid platen_grid(const Scene &scene, const Face &face) {
  const std::string &path = face.mesh_file;
  if (path.empty()) return nullptr;
  std::ifstream file = open_file(path);
  try {
    if (!file) throw std::invalid_argument(path + ": cannot be read");
    fem::load_solids();
    return fem::read_gmsh(file, {scene.platens.mesh_unit, path});
  } catch (const std::invalid_argument &e) {
    throw InputError(e.what());
  }
}

} // namespace

std::vector<std::string> effects_on(const Scene &scene) {
  return chosen(scene, true);
}
std::vector<std::string> effects_off(const Scene &scene) {
  return chosen(scene, false);
}

coupling::PlatenTestSettings problem_settings(const Scene &scene) {
  coupling::PlatenTestSettings to = settings_without_files(scene);
  to.model = model_settings(scene);
  const auto read = [&](coupling::PlatenSide &side, coupling::Side which) {
    side.grid = platen_grid(scene, scene.platens.face(which));
  };
  if (to.loading.tube && to.loading.tube->metal && !scene.loading.hardening_file.empty())
    to.loading.tube->metal->points =
        read_hardening(scene.loading.hardening_file, to.loading.tube->metal->yield_strength);
  using coupling::Side;
  read(to.platens.top, Side::top), read(to.platens.bottom, Side::bottom);
  if (to.platens.left) read(*to.platens.left, Side::left), read(*to.platens.right, Side::right);
  if (to.platens.front) read(*to.platens.front, Side::front), read(*to.platens.back, Side::back);
  return to;
}

} // namespace platen::apps
