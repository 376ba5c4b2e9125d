#include "apps/run/problem_setup.h"

#include <cmath>
#include <fstream>
#include <stdexcept>
#include <utility>

#include "apps/run/model_setup.h"
#include "apps/scene/errors.h"
#include "dem/laws/normal_contact.h"
#include "fem/gmsh.h"

namespace platen::apps {
namespace {

struct Effect {
  bool on;
  std::string word;
};

// Every effect that a scene may have: its laws by their words, then the rest.
std::vector<Effect> effects(const Scene &s) {
  const dem::ModelSettings &m = s.model;
  const std::optional<dem::BondParameters> bond = s.bond.parameters();
  const std::optional<dem::ContactSettings> contact = contact_settings(s);
  const bool bonded = bond.has_value(), touching = contact.has_value();
  const dem::TangentialContact tangential = s.contact.tangential;
  std::vector<Effect> all{{bonded, bonded ? s.bond.word() : dem::BondLaws::words.front()}};
  for (const auto &[word, law] : dem::NormalContacts::words())
    all.push_back({s.effects.contact == law, word + " contact"});
  const std::vector<Effect> others{
      {touching && tangential != dem::TangentialContact::none, "coulomb friction"},
      {touching && tangential == dem::TangentialContact::coulomb_with_rolling, "rolling resistance"},
      {m.rotation, "rotation"},
      {bonded && m.rotation && dem::bends(dem::bond_law(*bond)), "bond moments"},
      {s.effects.gravity, "gravity"},
      {m.local_damping > 0,
       m.damping_form == dem::DampingForm::vector ? "local damping along the velocity" : "local damping"},
      {m.phi() > 1, "dissipative scheme"},
      {bonded && m.bond_dashpot > 0, "bond dashpots"},
      {bonded && s.phases.by != PhasesBy::none, "phases"},
      {bonded && s.bond.scattered, "scattered strengths"},
      {touching && contact->dashpot() > 0, "contact dashpots"},
      {s.platens.kind == PlatenKind::deformable, "elastic platens"},
      {s.platens.top_seat == PlatenSeat::spherical, "spherical seat"},
      {s.platens.damping > 0, "platen dashpots"},
      {s.platens.top.friction_static > 0 || s.platens.bottom.friction_static > 0, "platen friction"},
      {s.platens.top.friction_law != FrictionLaw::constant ||
           s.platens.bottom.friction_law != FrictionLaw::constant,
       "weakening friction"},
      {s.platens.attachment == Attachment::glued, "glued ends"},
      {s.loading.confinement == ConfinementKind::particles, "confinement on particles"},
      {s.loading.sleeved(), "sleeve"},
      {s.loading.walled(), "lateral wall"},
      {!s.loading.unload_at.empty(), "unloading"},
      {s.specimen.seat, "seats"},
      {m.mass_scaling > 1, "mass scaling"},
      {m.energy_ledger, "energy ledger"},
      {bonded && m.crack_log, "crack log"},
      {s.output.fields, "fields"}};
  all.insert(all.end(), others.begin(), others.end());
  return all;
}

std::vector<std::string> chosen(const Scene &scene, bool on) {
  std::vector<std::string> words;
  for (const Effect &e : effects(scene))
    if (e.on == on) words.push_back(e.word);
  return words;
}

coupling::SleeveSettings sleeve_settings(const Sleeve &from) {
  coupling::SleeveSettings to;
  to.thickness = from.thickness;
  to.rubber = {from.density, fem::NeoHookean::from_young(from.modulus, from.poisson_ratio)};
  to.elements_around = from.elements_around;
  to.elements_through = from.elements_through;
  to.bonded_rims = from.rims == SleeveRims::bonded;
  to.mass_scaling = from.mass_scaling;
  to.mass_damping = from.damping;
  to.contact.friction_static = to.contact.friction_dynamic = from.friction;
  to.contact.damping = from.contact_damping;
  return to;
}

fem::Grid platen_grid(const Scene &scene, bool top) {
  const std::string &path = (top ? scene.platens.top : scene.platens.bottom).mesh_file;
  if (path.empty()) return nullptr;
  std::ifstream file(path, std::ios::binary);
  try {
    if (!file) throw std::invalid_argument(path + ": cannot be read");
    return fem::read_gmsh(file, {scene.platens.mesh_unit, path});
  } catch (const std::invalid_argument &e) {
    throw InputError(e.what());
  }
}

coupling::PlatenSide platen_side(const PlatenSide &from, fem::Grid grid) {
  using By = dem::Weakening::By;
  coupling::PlatenSide to{{from.friction_static, from.friction_dynamic, {}}, std::move(grid)};
  to.weakening.by = from.friction_law == FrictionLaw::slip_weakening       ? By::slip
                    : from.friction_law == FrictionLaw::velocity_weakening ? By::velocity
                                                                           : By::nothing;
  to.weakening.slip_length = from.slip_length;
  to.weakening.slip_velocity = from.slip_velocity;
  return to;
}

coupling::CellSettings cell_settings(const Loading &from) {
  coupling::CellSettings to;
  to.pressure = from.confining_pressure;
  to.ramp = from.confining_ramp;
  to.path = from.pressure_path;
  to.hold = from.hold;
  to.alone = from.hydrostatic();
  to.area = from.confinement_area == ConfinementArea::sphere ? dem::ConfinementArea::sphere
                                                             : dem::ConfinementArea::voronoi;
  return to;
}

} // namespace

std::vector<std::string> effects_on(const Scene &scene) {
  return chosen(scene, true);
}
std::vector<std::string> effects_off(const Scene &scene) {
  return chosen(scene, false);
}

coupling::PlatenTestSettings problem_settings(const Scene &scene) {
  const Platens &from = scene.platens;
  coupling::PlatenTestSettings to;
  to.model = model_settings(scene);
  to.ends =
      scene.specimen.ends == dem::EndPreparation::ground ? coupling::Ends::ground : coupling::Ends::as_packed;
  to.end_layer = scene.specimen.end_layer;
  to.seat = scene.specimen.seat;
  to.platens.top = platen_side(from.top, platen_grid(scene, true));
  to.platens.bottom = platen_side(from.bottom, platen_grid(scene, false));
  if (from.stiffness.kind == Stiffness::Kind::absolute)
    to.platens.stiffness_absolute = from.stiffness.value;
  else
    to.platens.stiffness_of_bond = from.stiffness.value;
  to.platens.tangential_ratio = from.tangential_ratio;
  to.platens.damping = from.damping;
  to.platens.strip_width = from.strip_width;
  if (scene.loading.bending()) to.platens.span = from.span;
  to.platens.overhang = from.overhang;
  to.platens.thickness = from.thickness;
  to.platens.elements_across = from.elements_across;
  to.platens.material = {from.density, from.young_modulus, from.poisson_ratio};
  if (from.kind == PlatenKind::deformable) {
    coupling::ElasticPlatens elastic;
    elastic.degree = from.degree;
    elastic.motion = from.motion == PlatenMotion::quasi_static ? fem::ElasticMotion::quasi_static
                                                               : fem::ElasticMotion::explicit_steps;
    elastic.damping = from.body_damping;
    elastic.steps_per_solve = from.steps_per_solve;
    elastic.seat = from.top_seat == PlatenSeat::spherical;
    elastic.pad_thickness = from.pad_thickness;
    if (!std::isnan(from.pad_modulus))
      elastic.pad = {from.pad_density, from.pad_modulus, from.pad_poisson_ratio};
    to.platens.elastic = elastic;
  }
  to.platens.glued = from.attachment == Attachment::glued;
  to.loading.tension = scene.loading.test == LoadingTest::tension;
  to.loading.rate = std::isnan(scene.loading.axial_rate) ? 0.0 : scene.loading.axial_rate;
  if (std::isnan(scene.loading.axial_rate) && !std::isnan(scene.loading.wave_crossings))
    to.loading.wave_transits = scene.loading.wave_crossings;
  to.loading.rate_multiplier = scene.loading.hurry;
  to.loading.ramp = scene.loading.ramp;
  to.loading.servo = from.top_control == PlatenControl::stress;
  to.loading.top_stress = from.top_stress;
  to.loading.hold = scene.loading.hold;
  to.loading.target_strain = scene.loading.target_strain;
  to.loading.start_strain = scene.loading.start_strain;
  to.loading.servo_gain = scene.loading.servo_gain;
  if (scene.loading.cell()) to.loading.cell = cell_settings(scene.loading);
  if (scene.loading.sleeved()) {
    to.loading.cell->sleeve = sleeve_settings(scene.sleeve);
    to.loading.cell->sleeve_stiffness = scene.sleeve.stiffness;
    to.loading.cell->sleeve_seat_depth = scene.sleeve.seat_depth;
  }
  if (scene.loading.walled()) to.loading.wall_stiffness = scene.loading.wall_stiffness;
  to.loading.unload_at = scene.loading.unload_at;
  to.loading.unload_to = scene.loading.unload_to;
  to.time_step = {scene.integration.safety, scene.integration.time_step};
  return to;
}

} // namespace platen::apps
