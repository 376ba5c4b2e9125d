// The time step of an experiment: chosen at its start, and again where contacts have closed.
#include <algorithm>
#include <cmath>

#include "base/shortest_text.h"
#include "coupling/experiment.h"

namespace platen::coupling {
namespace {

// The step is checked after this many steps, if contacts have grown by this share of the particles.
constexpr long steps_between_choices = 400;
constexpr double growth_of_contacts = 0.02;

std::size_t near_pairs(const dem::Model &model) {
  return model.contacts ? model.contacts->table.size() : 0;
}

} // namespace

std::size_t Experiment::contacts_closed() const {
  std::size_t sum = near_pairs(model);
  for (const auto &boundary : boundaries_)
    sum += boundary->closed();
  return sum;
}

// Lists are made now, so that it is the same whether the run was stopped and resumed on its way or not.
dem::StableStep Experiment::limit_now() {
  std::vector<dem::GroundSpring> springs;
  double dashpots = 0;
  near_at_choice_ = near_pairs(model);
  for (const auto &boundary : boundaries_) {
    boundary->add_springs(model.particles, springs);
    dashpots = std::max(dashpots, boundary->dashpots());
    near_at_choice_ += boundary->near();
  }
  dem::StableStep limit = model.stable_step(springs, dashpots);
  for (const auto &boundary : boundaries_)
    if (const StepLimit own = boundary->limit(model.particles); own.seconds < limit.limit) {
      limit.limit = own.seconds;
      limit.reason = own.reason;
    }
  return limit;
}

// The step never grows: bonds that break only soften, contacts that close may stiffen.
void Experiment::choose_step(bool first) {
  const dem::StableStep limit = limit_now();
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

// A boundary that knows its limit after each of its intervals may be stiffer than one step as contacts close.
void Experiment::check_step() {
  if (steps_ == 0) return;
  const bool stiffer = std::any_of(boundaries_.begin(), boundaries_.end(), [&](const auto &boundary) {
    return time_step_ > boundary->known_limit();
  });
  if (!stiffer && steps_ % steps_between_choices != 0) return;
  const double grown = static_cast<double>(contacts_closed()) - static_cast<double>(near_at_choice_);
  if (!stiffer && grown <= growth_of_contacts * static_cast<double>(model.particles.size())) return;
  dem::StageClock::Lap lap(model.clock, dem::Stage::stable_step);
  choose_step(false);
}

} // namespace platen::coupling
