// Conditions that stop a run (numbers that are not finite, motion that could pass through a face, energy from
// the scheme), and the time step: chosen at the start, and again where contacts have closed.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/shortest_text.h"
#include "coupling/experiment.h"
#include "dem/particles.h"

namespace platen::coupling {

namespace {

// Kinetic energy comes from outside, so twice the supplied energy shows that the scheme makes energy. Above
// the limit of the step it grows by a factor in each step, so that the margin costs no time.
constexpr double most_of_work_in_motion = 2;

// The step is checked after this many steps, if contacts have grown by this fraction of the particles.
constexpr long steps_between_choices = 400;
constexpr double growth_of_contacts = 0.02;

std::size_t near_pairs(const dem::Model &model) {
  return model.contacts ? model.contacts->table.size() : 0;
}

} // namespace

void Experiment::require_finite() {
  if (any_rank(!dem::motion_is_finite(model.particles))) stop_not_finite();
}

void Experiment::require_boundaries_finite() {
  for (const auto &boundary : boundaries_)
    if (!boundary->is_finite()) stop_not_finite();
}

void Experiment::stop_not_finite() {
  gather();
  std::string where = dem::not_finite(model.particles);
  for (const auto &boundary : boundaries_)
    if (where.empty() && !boundary->is_finite()) where = "the force on the " + boundary->name();
  if (where.empty()) where = "a sum of forces";
  throw NumericsStopped("not finite: " + where + " at step " + std::to_string(steps_) + ", time " +
                        text_of(time()) + " s; try a smaller `time_step.safety` or `loading.rate`");
}

// A contact layer rejects a motion that could carry a particle through a face undetected.
void Experiment::stop_unseen(const std::string &reason) {
  gather();
  const auto slower = [](const Vector3 &a, const Vector3 &b) { return norm(a) < norm(b); };
  const dem::Particles &p = model.particles;
  const auto fastest = std::max_element(p.velocity.begin(), p.velocity.end(), slower) - p.velocity.begin();
  std::string text = "step " + std::to_string(steps_) + ", time " + text_of(time()) + " s: " + reason +
                     "; the fastest is particle " + std::to_string(p.id[static_cast<std::size_t>(fastest)]);
  for (const auto &boundary : boundaries_)
    if (time_step_ > boundary->known_limit())
      text += "; the time step of " + text_of(time_step_) + " s is above the stability limit of " +
              text_of(boundary->known_limit()) + " s (" + boundary->limit(model.particles).reason + ")";
  throw NumericsStopped(text);
}

// A lower bound costs one comparison per step, because the sum is available. Only where it exceeds the last
// limit is the energy supplied since then computed.
void Experiment::check_energy() {
  const double moving = half_lightest_ * model.last_motion().speed_squares;
  if (moving <= energy_allowed_ || !model.settings().energy_ledger) return;
  const double came_in = std::abs(work_from_outside()) + given_energy_;
  // Energy of motion with the platens, which may precede a balance that is updated once per step.
  double speed = program_->fastest();
  for (const auto &boundary : boundaries_)
    speed = std::max(speed, boundary->speed());
  const double mass = std::accumulate(model.particles.mass.begin(), model.particles.mass.end(), 0.0);
  energy_allowed_ = most_of_work_in_motion * (came_in + 0.5 * mass * speed * speed);
  if (moving <= energy_allowed_) return;
  gather();
  const dem::StableStep limit = limit_now(time_step_);
  const std::string step = "the time step of " + text_of(time_step_) + " s is ";
  const std::string cause =
      time_step_ > limit.limit
          ? step + "above the stability limit of " + text_of(limit.limit) + " s (" + limit.reason + ")"
          : step + "too long for what happens here, though below the limit of " + text_of(limit.limit) + " s";
  throw NumericsStopped("step " + std::to_string(steps_) + ", time " + text_of(time()) +
                        " s: energy from nowhere: particles move with " + text_of(moving) +
                        " J or more where only " + text_of(came_in) + " J came in: " + cause +
                        "; try a smaller `time_step.safety` or `time_step.fixed_step`");
}

std::size_t Experiment::contacts_closed() const {
  std::size_t sum = near_pairs(model);
  if (model.is_cut()) sum = static_cast<std::size_t>(model.exchange()->all(static_cast<long>(sum)));
  for (const auto &boundary : boundaries_)
    sum += boundary->closed();
  return sum;
}

// Lists are rebuilt now, so that the result is the same whether the run was stopped and resumed or not.
dem::StableStep Experiment::limit_now(double sought_below) {
  std::vector<dem::GroundSpring> springs;
  double dashpots = 0;
  near_at_choice_ = near_pairs(model);
  for (const auto &boundary : boundaries_) {
    boundary->add_springs(model.particles, springs);
    dashpots = std::max(dashpots, boundary->dashpots());
    near_at_choice_ += boundary->near();
  }
  dem::StableStep limit = model.stable_step(springs, dashpots, sought_below);
  for (const auto &boundary : boundaries_)
    if (const StepLimit own = boundary->limit(model.particles); own.seconds < limit.limit) {
      limit.limit = own.seconds;
      limit.reason = own.reason;
    }
  return limit;
}

// The step never grows: breaking bonds only soften, closing contacts may stiffen.
void Experiment::choose_step(bool first) {
  // The location is found only where this becomes the step, or an error; slightly above, because the quotient
  // is rounded.
  const double sought_below = settings_.fixed_step > 0 ? settings_.fixed_step
                              : first                  ? std::numeric_limits<double>::infinity()
                                                       : time_step_ / settings_.safety * (1 + 1e-12);
  const dem::StableStep limit = limit_now(sought_below);
  if (settings_.fixed_step > 0) {
    if (settings_.fixed_step > limit.limit) {
      const std::string above =
          "is above the stability limit of " + text_of(limit.limit) + " s (" + limit.reason + ")";
      if (first)
        throw BadSetup("time_step.fixed_step", above + ". Allowed: up to that, or 0: the program chooses.");
      throw NumericsStopped("the time step of " + text_of(settings_.fixed_step) + " s " + above + " at " +
                            text_of(time()) +
                            " s; try a smaller `time_step.fixed_step`, or leave it to the program");
    }
    time_step_ = settings_.fixed_step;
    reason_ = "given by the scene";
    return;
  }
  const double step = settings_.safety * limit.limit;
  if (!std::isfinite(step))
    throw BadSetup("time_step.fixed_step",
                   "has to be given: nothing in the scene has a stiffness that would give it.");
  if (first || step < time_step_) {
    time_step_ = step;
    reason_ = limit.reason;
  }
}

// A boundary with a known limit after each of its intervals may be stiffer than one step as contacts close.
bool Experiment::choice_is_due() {
  if (steps_ == 0) return false;
  const bool stiffer = std::any_of(boundaries_.begin(), boundaries_.end(), [&](const auto &boundary) {
    return time_step_ > boundary->known_limit() || boundary->stiffened();
  });
  if (!stiffer && steps_ % steps_between_choices != 0) return false;
  if (model.contacts) model.contacts->renew_close(model.particles);
  const double grown = static_cast<double>(contacts_closed()) - static_cast<double>(near_at_choice_);
  return stiffer || grown > growth_of_contacts * static_cast<double>(model.particles.size());
}

} // namespace platen::coupling
