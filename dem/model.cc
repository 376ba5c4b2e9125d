#include "dem/model.h"

#include <limits>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>

#include "base/parallel.h"
#include "base/state.h"
#include "dem/packing/specimen.h"

namespace platen::dem {
namespace {

// Broken rows are dropped when they exceed this fraction of all rows.
constexpr double compaction_share = 0.02;
const ModelSettings &checked(const ModelSettings &settings) {
  require_in_range(settings);
  return settings;
}

ModelSettings completed(const Specimen &specimen, const ModelSettings &settings) {
  ModelSettings s = settings;
  if (s.bond_layout.area_factor == 0) s.bond_layout.area_factor = packing_factor(specimen, s.bond_layout);
  return s;
}

bool rubs(const ModelSettings &s) {
  return s.contact && s.contact->tangential != TangentialContact::none;
}

// Contacts between grains of two phases have the modulus factors of their bonds.
ContactSettings contact_settings(const ModelSettings &s) {
  ContactSettings contact = *s.contact;
  if (s.phases)
    for (std::size_t k = 0; k < contact.modulus_factors.size(); ++k)
      contact.modulus_factors[k] = s.phases->factors()[k].modulus;
  return contact;
}

// Each input number must occur once among the particles.
void require_each_once(const StateSource &state, const std::string &block) {
  const std::vector<int> ids = rows_of<int>(state, block);
  std::vector<char> seen(ids.size(), 0);
  for (std::size_t k = 0; k < ids.size(); ++k)
    if (std::exchange(seen[static_cast<std::size_t>(ids[k])], 1))
      refuse_row(block, k, std::to_string(ids[k]), "each number once");
}

} // namespace

double grain_density(const Specimen &specimen, double density, DensityOf of) {
  if (of == DensityOf::grains) return density;
  const double volume = specimen.shape.volume(), spheres = volume_of_spheres(specimen);
  if (!(volume > 0 && spheres > 0))
    throw std::invalid_argument("a density of the solid needs a specimen that fills a volume");
  return density * volume / spheres;
}

Model::Model(const Specimen &specimen, const ModelSettings &settings)
    : particles(
          specimen,
          grain_density(specimen, checked(settings).density, settings.density_of) * settings.mass_scaling,
          settings.rotation),
      settings_(completed(specimen, settings)),
      integrator_{settings.rotation,      settings.local_damping,   settings.gravity,
                  settings.energy_ledger, settings.instruction_set, settings.phi(),
                  settings.damping_form} {
  if (settings.phi() > 1) particles.add_excess();
  if (settings.phases) mark_phases(particles, *settings.phases);
  if (settings.bond)
    bonds = std::make_unique<Bonds>(particles, settings_.bond_layout, *settings.bond, specimen.shape.notch,
                                    settings.bond_choice);
  if (bonds) set_grain_friction(bonds->law, rubs(settings) ? settings.contact->friction : 0);
  if (bonds && settings.phases) apply_phases(*bonds, particles, *settings.phases);
  if (bonds && settings.strength_scatter) scatter_strengths(*bonds, *settings.strength_scatter);
  if (bonds) bonds->require_ductile(particles);
  if (bonds && settings.bond_dashpot > 0) bonds->add_dashpots(particles, settings.bond_dashpot);
  if (settings.contact)
    contacts = std::make_unique<Contacts>(particles, contact_settings(settings), settings_.bond_layout,
                                          settings.energy_ledger, settings.instruction_set);
}

void Model::begin_step(double dt) {
  if (exchange_ && !cut_) scatter();
  {
    StageClock::Lap lap(clock, Stage::motion);
    motion_ = integrator_.begin(particles, dt, own_blocks());
  }
  begun(dt);
}

// Broken rows are dropped before forces are computed, not after: ghosts need the present blocks until the end
// of the step.
void Model::begun(double dt) {
  time += dt;
  last_step_ = dt;
  breaks = 0;
  breaks_.clear();
  if (bonds &&
      static_cast<double>(bonds->broken_rows) > compaction_share * static_cast<double>(bonds->size())) {
    StageClock::Lap lap(clock, Stage::bonds);
    bonds->compact();
  }
  if (bonds) {
    StageClock::Lap lap(clock, Stage::bonds);
    bonds->order_rows();
  }
  known_breaks_ = broken_tension + broken_shear;
  if (exchange_) start_exchange(dt);
}

void Model::search_contacts() {
  if (!contacts) return;
  StageClock::Lap lap(clock, Stage::search);
  contacts->moved(motion_.fastest * last_step_);
  const bool wide = exchange_ && contacts->search_is_wide();
  if (wide) exchange_->gather_motion(particles);
  contacts->update(particles, bonds.get(), own_blocks());
  if (wide) exchange_->renew_contacts(*this);
}

void Model::compute_forces(double dt, const Loop &parallel_loop, const std::function<void()> &done) {
  search_contacts();
  if (exchange_) return compute_shared(dt, parallel_loop, done);
  compute_bonds(dt, nullptr, parallel_loop);
  finish_breaks(dt);
  compute_contacts(dt, nullptr);
}

void Model::compute_block_again(std::size_t block) {
  if (again_[block] != 0)
    compute_bond_forces_again(particles, *bonds, settings_.instruction_set, settings_.gravity, block);
}

// Blocks with newly broken bonds are computed again in the loop over contacts, before the contacts of the
// block are added.
void Model::compute_contacts(double dt, const BlockList *listed) {
  const auto again = [this](std::size_t block) { compute_block_again(block); };
  if (!contacts) return compute_again();
  StageClock::Lap lap(clock, Stage::contacts);
  contacts->compute(particles, dt, listed, again_.empty() ? Loop{} : loop_of(again_.size(), again));
  again_.clear();
}

void Model::compute_again() {
  StageClock::Lap lap(clock, Stage::bonds);
  for_each(
      again_.size(), [this](std::size_t block) { compute_block_again(block); }, 1);
  again_.clear();
}

void Model::compute_bonds(double dt, const BlockList *listed, const Loop &parallel_loop) {
  if (!bonds) {
    set_weight(particles, settings_.gravity, listed);
    run_loops(parallel_loop);
    return;
  }
  StageClock::Lap lap(clock, Stage::bonds);
  if (has_history(bonds->law))
    works.damping += compute_cohesive_forces(particles, *bonds, settings_.instruction_set, settings_.gravity,
                                             dt, breaks_, parallel_loop, listed);
  else
    works.damping += compute_bond_forces(particles, *bonds, settings_.instruction_set, settings_.gravity, dt,
                                         breaks_, parallel_loop, listed);
}

void Model::finish_breaks(double dt) {
  if (breaks_.empty()) return;
  StageClock::Lap lap(clock, Stage::bonds);
  if (has_history(bonds->law)) {
    note_breaks(bonds->fail_rows(breaks_, particles, time));
  } else {
    break_bonds(dt);
    works.damping += undone_work_of_dashpots(particles, *bonds, dt, breaks_);
    if (again_.empty()) again_.assign(bonds->blocks.blocks(), 0);
    for (const BondBreak &broken : breaks_)
      again_[static_cast<std::size_t>(bonds->first[broken.row]) / block_rows] = 1;
  }
  breaks += static_cast<long>(breaks_.size());
  breaks_.clear();
}

void Model::break_bonds(double dt) {
  std::vector<BrokenBond> broken = bonds->break_rows(breaks_, particles, time);
  if (contacts)
    contacts->take_over(particles, *bonds, broken, dt, exchange_ != nullptr);
  else
    for (BrokenBond &b : broken)
      b.released = b.last.energy - 0.5 * dt * b.power;
  note_breaks(broken);
}

void Model::note_breaks(const std::vector<BrokenBond> &broken) {
  for (const BrokenBond &b : broken) {
    const Vector3 xi = particles.position[b.first], xj = particles.position[b.second];
    const double ri = particles.radius[b.first], lever = ri / (ri + particles.radius[b.second]);
    const Crack crack{time,       xi + lever * (xj - xi), (xj - xi) / norm(xj - xi), b.area,   b.mode,
                      b.released, particles.id[b.first],  particles.id[b.second],    b.record, 0};
    if (exchange_)
      unsettled_.push_back(crack), ++own_breaks_;
    else
      count(crack);
  }
}

void Model::count(const Crack &crack) {
  works.fracture += crack.energy;
  (crack.mode == BondState::broken_in_tension ? broken_tension : broken_shear) += 1;
  if (settings_.crack_log) cracks.push_back(crack);
}

void Model::set_strain_of_cracks(double strain) {
  for (std::vector<Crack> *list : {&cracks, &unsettled_})
    for (std::size_t k = list->size(); k-- > 0 && (*list)[k].time == time;)
      (*list)[k].strain = strain;
}

void Model::add_sums() {
  works.damping += sums_.damping_work;
  works.weight += sums_.weight_work;
}

void Model::end_step(double dt) {
  StageClock::Lap lap(clock, Stage::motion);
  receive_ghosts();
  sums_ = integrator_.end(particles, ghosts(), dt, own_blocks());
  add_sums();
}

void Model::end_and_begin_step(double finished, double next) {
  {
    StageClock::Lap lap(clock, Stage::motion);
    receive_ghosts();
    motion_ = integrator_.end_and_begin(particles, ghosts(), finished, next, sums_, own_blocks());
    add_sums();
  }
  begun(next);
}

// Adds in the order of blocks.
template <class Part>
Part Model::sum_of_blocks(std::vector<Part> parts) const {
  static_assert(std::is_trivially_copyable_v<Part>, "sent as bytes");
  if (cut_) exchange_->gather_blocks(parts.data(), sizeof(Part));
  Part sum{};
  for (const Part &part : parts)
    sum += part;
  return sum;
}

double Model::total(const ExactSum &sum) const {
  return cut_ ? exchange_->all(sum) : sum;
}

std::size_t Model::total(std::size_t count) const {
  return cut_ ? static_cast<std::size_t>(exchange_->all(static_cast<long>(count))) : count;
}

BondTotals Model::bond_totals() const {
  return sum_of_blocks(
      bond_totals_of_blocks(particles, *bonds, settings_.instruction_set, cut_ ? own_blocks() : nullptr));
}

double Model::unbalanced() const {
  return total(sums_.unbalanced);
}

std::size_t Model::touching_count() const {
  return contacts ? total(contacts->touching_count()) : 0;
}

EnergyLedger Model::energy() const {
  EnergyLedger e;
  if (!unsettled_.empty()) throw std::logic_error("energies are asked of a specimen with unsettled cracks");
  if (!settings_.energy_ledger) {
    const double none = std::numeric_limits<double>::quiet_NaN();
    return {none, none, none, none, none, none, none, none, none};
  }
  const BlockList *own = cut_ ? own_blocks() : nullptr;
  e.kinetic = sum_of_blocks(kinetic_energy_of_blocks(particles, own));
  e.damping = total(works.damping);
  e.fracture = works.fracture;
  e.boundary = total(works.weight);
  if (contacts) {
    e.contacts = sum_of_blocks(contacts->energy_of_blocks(own));
    e.damping += total(contacts->damping_work);
    e.friction = total(contacts->friction_work);
  }
  if (bonds) {
    const BondTotals totals = bond_totals();
    e.bonds = totals.energy;
    e.fracture += totals.damage;
    e.friction += totals.friction;
    e.plastic = totals.plastic;
  }
  return e;
}

std::vector<Crack> Model::take_cracks() {
  return std::exchange(cracks, {});
}

std::size_t Model::intact_bonds() const {
  return bonds ? total(bonds->size() - bonds->broken_rows - bonds->failed_rows) : 0;
}

std::size_t Model::bytes() const {
  return particles.size() * particles.table.bytes_per_row() + (bonds ? bonds->bytes() : 0) +
         (contacts
              ? contacts->table.size() * contacts->table.bytes_per_row() + contacts->search_state().bytes()
              : 0);
}

std::size_t Model::broken(BondState mode) const {
  return static_cast<std::size_t>(mode == BondState::broken_in_tension ? broken_tension : broken_shear);
}

StableStep Model::stable_step(const std::vector<GroundSpring> &ground, double surface_dashpot,
                              double sought_below) const {
  DashpotFractions dashpots;
  dashpots.bonds = settings_.bond_dashpot;
  dashpots.contacts = settings_.contact ? settings_.contact->dashpot_reserve() : 0;
  dashpots.surfaces = surface_dashpot;
  dashpots.local = settings_.local_damping;
  dashpots.scheme = settings_.phi();
  return dem::stable_step(particles, bonds.get(), contacts.get(), ground, dashpots, sought_below);
}

void Model::describe(Archive &archive) {
  archive.version(1);
  std::string set = name(settings_.instruction_set); // for information; a state of another set is accepted
  archive.text("instruction_set", set);
  archive("time", time, "s", at_least(0));
  platen::describe(archive, "damping_work", works.damping, "J");
  platen::describe(archive, "fracture_work", works.fracture, "J");
  platen::describe(archive, "weight_work", works.weight, "J");
  double unbalanced = sums_.unbalanced; // N, of the last step; older states do not contain it
  archive("unbalanced", unbalanced, "N", std::numeric_limits<double>::quiet_NaN(), or_nan(at_least(0)));
  if (archive.reads()) sums_.unbalanced = ExactSum(unbalanced);
  archive("broken_tension", broken_tension, "1", at_least(0));
  archive("broken_shear", broken_shear, "1", at_least(0));
  archive.same_table("particles", particles.table);
  if (const StateSource *state = archive.looks_at()) require_each_once(*state, archive.path("particles/id"));
  if (bonds) archive.part("bonds", *bonds);
  if (contacts) archive.part("contacts", *contacts);
}

} // namespace platen::dem
