#include "coupling/experiment.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>
#include <stdexcept>
#include <tuple>

#include "base/parallel.h"
#include "base/shortest_text.h"
#include "dem/particles.h"

namespace platen::coupling {
namespace {

// Particles without contacts affect no sum, so all are checked after this many steps: 0.1 % of their cost.
constexpr long steps_between_checks = 100;

bool have_no_common_particle(const Boundary &a, const Boundary &b) {
  const std::vector<int> *one = a.listed_particles(), *other = b.listed_particles();
  if (one == nullptr || other == nullptr) return false;
  std::vector<int> common;
  std::set_intersection(one->begin(), one->end(), other->begin(), other->end(), std::back_inserter(common));
  return common.empty();
}

} // namespace

Experiment::Experiment(const dem::Specimen &specimen, const dem::ModelSettings &settings,
                       const TimeStepSettings &time_step)
    : model(specimen, settings), shape_(specimen.shape), settings_(time_step) {}

void Experiment::begin(std::unique_ptr<Program> program) {
  std::set<std::string> names{"specimen", "program"}; // of parts of the state
  for (const auto &boundary : boundaries_)
    if (!names.insert(boundary->name()).second)
      throw BadSetup("boundaries", "has two parts with the name " + boundary->name() +
                                       ". Allowed: names of their own, not specimen or program.");
  program_ = std::move(program);
  half_lightest_ = 0.5 * *std::min_element(model.particles.mass.begin(), model.particles.mass.end());
  // Pairs that are about to touch count in the first step too.
  if (model.contacts) model.contacts->search(model.particles, model.bonds.get(), 0.0);
  choose_step(true);
  for (const auto &boundary : boundaries_)
    boundary->fit(model.particles, time_step_);
  commands_.resize(boundaries_.size());
  for (const bool followers : {false, true})
    for (std::size_t b = 0; b < boundaries_.size(); ++b)
      if (boundaries_[b]->follows_others() == followers)
        (boundaries_[b]->drifts_long() && !followers ? at_once_ : in_turn_).push_back(b);
}

long Experiment::advance(long most) {
  if (steps_ == 0) given_energy_ = dem::kinetic_energy(model.particles);
  begin_sharing();
  const bool was_finished = program_->finished();
  for (long made = 1; made <= most; ++made) {
    make_step(made == 1);
    const bool ends = program_->finished() && !was_finished;
    if (made < most && !ends) continue;
    model.end_step(time_step_);
    if (any_rank(!std::isfinite(model.last_sums().unbalanced))) stop_not_finite();
    return made;
  }
  return 0;
}

// All of a step except its end, which the next step does in one pass with its own start.
void Experiment::make_step(bool first_of_call) {
  if (choice_is_due()) {
    if (!first_of_call) model.end_step(time_step_);
    first_of_call = true;
    gather();
    {
      dem::StageClock::Lap lap(model.clock, dem::Stage::stable_step);
      choose_step(false);
    }
    begin_sharing();
  }
  if (first_of_call)
    model.begin_step(time_step_);
  else
    model.end_and_begin_step(time_step_, time_step_);
  if (!std::isfinite(model.last_motion().speed_squares)) stop_not_finite();
  program_->command(commands_);
  try {
    compute_forces();
  } catch (const dem::NotFinite &) {
    stop_not_finite();
  }
  if (model.breaks > 0) model.set_strain_of_cracks(strain_of_cracks());
  program_->update();
  ++steps_;
  require_boundaries_finite();
  if (steps_ % steps_between_checks == 0) require_finite();
  check_energy();
}

// Forces of boundaries on particles are computed in parallel with the bonds: in small parts, for threads that
// have finished theirs.
void Experiment::compute_forces() {
  const Step step{time_step_, model.time, steps_, model.last_motion().fastest * time_step_};
  drift_boundaries(step);
  gather_for_boundaries(step);
  prepare_contacts(step);
  const auto part = [&](std::size_t p) {
    boundaries_[parts_[p].boundary]->compute_part(model.particles, step, parts_[p].k);
  };
  if (model.is_cut()) {
    model.compute_forces(time_step_, loop_of(parts_.size(), part), [this] { send_loads(); });
    receive_loads();
  } else {
    model.compute_forces(time_step_, loop_of(parts_.size(), part));
  }
  apply_boundary_forces(step);
  finish_boundaries(step);
  share_rows_of_boundaries();
}

void Experiment::drift_boundaries(const Step &step) {
  dem::StageClock::Lap lap(model.clock, dem::Stage::bodies);
  const auto drift = [&](std::size_t b) { boundaries_[b]->drift(step, commands_[b]); };
  at_once(at_once_.size(), [&](std::size_t k) { drift(at_once_[k]); });
  for (const std::size_t b : in_turn_)
    drift(b);
}

// Particles are sorted by height first, and are divided over threads by rows: parts in the order of their
// particles go to the threads that move these particles, for all boundaries.
void Experiment::prepare_contacts(const Step &step) {
  dem::StageClock::Lap lap(model.clock, dem::Stage::surfaces);
  parts_.clear();
  try {
    for (std::size_t b = 0; b < boundaries_.size(); ++b) {
      const std::size_t parts = boundaries_[b]->prepare(model.particles, step);
      for (std::size_t k = 0; k < parts; ++k)
        parts_.push_back({boundaries_[b]->particle_of_part(k), b, k});
    }
  } catch (const std::runtime_error &e) {
    stop_unseen(e.what());
  }
  std::sort(parts_.begin(), parts_.end(), [](const Part &one, const Part &other) {
    return std::tie(one.particle, one.boundary, one.k) < std::tie(other.particle, other.boundary, other.k);
  });
}

// In parallel where no particle touches two boundaries: then no sum depends on their order. Particles are
// sorted by height first, so that two threads divide them as here: each platen touches particles in its
// thread's cache.
void Experiment::apply_boundary_forces(const Step &step) {
  dem::StageClock::Lap lap(model.clock, dem::Stage::surfaces);
  group_boundaries();
  for (const std::vector<std::size_t> &group : groups_)
    at_once(group.size(), [&](std::size_t k) { boundaries_[group[k]]->apply_forces(model.particles, step); });
}

void Experiment::group_boundaries() {
  const long lists = lists_made();
  if (lists == lists_grouped_) return;
  lists_grouped_ = lists;
  groups_.clear();
  for (std::size_t b = 0; b < boundaries_.size(); ++b) {
    const auto separate = [&](std::size_t other) {
      return have_no_common_particle(*boundaries_[b], *boundaries_[other]);
    };
    if (groups_.empty() || !std::all_of(groups_.back().begin(), groups_.back().end(), separate))
      groups_.emplace_back();
    groups_.back().push_back(b);
  }
}

// A machine holds a boundary without an energy balance against the particles: its work is minus theirs, by
// the trapezoid rule over the drift.
void Experiment::finish_boundaries(const Step &step) {
  dem::StageClock::Lap lap(model.clock, dem::Stage::bodies);
  double power = 0; // W
  for (const auto &boundary : boundaries_) {
    boundary->finish(step);
    power += boundary->power_on_machine();
  }
  machine_work_ -= 0.5 * step.dt * power;
}

// One step so long that no velocity matters in it: dashpots take their fraction of critical times a period
// over this step, and forces at its end, which are in equilibrium, have no effect.
void Experiment::carry(const std::vector<Vector3> &displacement, const std::vector<Vector3> &turn,
                       const std::vector<Vector3> &of_boundaries) {
  if (steps_ > 0) throw std::logic_error("an experiment is carried to its start before its first step");
  for (const auto &boundary : boundaries_)
    if (!boundary->can_be_carried())
      throw std::logic_error(boundary->name() + ": a boundary with inertia is not carried to a start");
  constexpr double pseudo_step = 1; // s, against periods of microseconds
  dem::Particles &p = model.particles;
  for (std::size_t i = 0; i < p.size(); ++i) {
    p.velocity[i] = displacement[i] / pseudo_step;
    if (p.has_rotation() && !turn.empty()) (*p.angular_velocity)[i] = turn[i] / pseudo_step;
  }
  for (std::size_t b = 0; b < boundaries_.size(); ++b)
    commands_[b].velocity = (1 / pseudo_step) * of_boundaries.at(b);
  const ExactSum damped = model.works.damping;
  {
    struct Back { // restores the time step, also when forces throw
      double &step, chosen;
      ~Back() { step = chosen; }
    } const back{time_step_, time_step_};
    time_step_ = pseudo_step;
    model.begin_step(pseudo_step);
    compute_forces();
    model.end_step(pseudo_step);
  }
  if (model.breaks > 0)
    throw BadSetup("loading.start_strain", "breaks " + std::to_string(model.breaks) +
                                               " bonds at once, which a static solve does not follow. "
                                               "Allowed: less, before the first crack.");
  model.works.damping = damped; // of the kick alone, which is reverted
  model.time = 0;
  std::fill(p.velocity.begin(), p.velocity.end(), Vector3{});
  if (p.has_rotation()) std::fill(p.angular_velocity->begin(), p.angular_velocity->end(), Vector3{});
  for (const auto &boundary : boundaries_)
    boundary->rest();
}

dem::EnergyLedger Experiment::energy() const {
  dem::EnergyLedger around;
  for (const auto &boundary : boundaries_)
    boundary->add_energy(around);
  around.boundary += machine_work_;
  dem::EnergyLedger all = model.energy();
  all += around;
  return all;
}

std::size_t Experiment::bytes() const {
  std::size_t sum = model.bytes();
  for (const auto &boundary : boundaries_)
    sum += boundary->bytes();
  return sum;
}

void Experiment::describe(Archive &archive) {
  archive.version(1);
  archive("time_step", time_step_, "s", above(0));
  archive.text("time_step_reason", reason_);
  archive("steps", steps_, "1", at_least(0));
  archive("near_at_choice", near_at_choice_);
  archive("machine_work", machine_work_, "J");
  archive("given_energy", given_energy_, "J");
  archive.part("specimen", model);
  for (const auto &boundary : boundaries_)
    archive.part(boundary->name(), *boundary);
  archive.part("program", *program_);
}

} // namespace platen::coupling
