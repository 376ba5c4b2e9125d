// What stops a run: numbers that are not finite, motion that could pass through a face, energy from nowhere.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "coupling/problem.h"
#include "coupling/text_of.h"
#include "dem/not_finite.h"

namespace platen::coupling {
namespace {

// What moves has its energy from outside, so twice of what came in says that the scheme makes energy. Above
// the limit of the step it does so by a factor in each step, so that the margin costs no time.
constexpr double most_of_work_in_motion = 2;

} // namespace

void Problem::require_finite() const {
  if (!dem::motion_is_finite(model.particles)) stop_not_finite();
}

void Problem::stop_not_finite() const {
  std::string where = dem::not_finite(model.particles);
  if (where.empty()) where = "the force on a platen";
  throw NumericsStopped("not finite: " + where + " at step " + std::to_string(steps_) + ", time " +
                        text_of(time()) + " s; try a smaller Integration/Safety or Loading/Axial rate");
}

// A layer refuses a motion that could carry a particle through a face unseen.
void Problem::announce_motion(double dt) {
  const double particles = model.last_motion().fastest * dt;
  try {
    top_layer.moved(particles + top.last_move());
    bottom_layer.moved(particles + bottom.last_move());
    if (sleeve_) sleeve_->layer.moved(particles + sleeve_->largest_move(dt));
  } catch (const std::runtime_error &e) {
    const auto slower = [](const dem::Vector3 &a, const dem::Vector3 &b) { return norm(a) < norm(b); };
    const dem::Particles &p = model.particles;
    const auto fastest = std::max_element(p.velocity.begin(), p.velocity.end(), slower) - p.velocity.begin();
    std::string text = "step " + std::to_string(steps_) + ", time " + text_of(time()) + " s: " + e.what() +
                       "; the fastest is particle " + std::to_string(p.id[static_cast<std::size_t>(fastest)]);
    if (sleeve_ && time_step_ > sleeve_->longest_interval())
      text += "; the time step of " + text_of(time_step_) + " s is above the stability limit of " +
              text_of(sleeve_->longest_interval()) + " s (" + reason_of_sleeve + ")";
    throw NumericsStopped(text);
  }
}

// A bound from below costs a comparison in a step, for the sum is there. Only where it passes what was
// allowed last time is it worth while to ask what came in since.
void Problem::look_at_energy() {
  const double moving = half_lightest_ * model.last_motion().speed_squares;
  if (moving <= energy_allowed_ || !model.settings().energy_ledger) return;
  const double came_in = std::abs(energy().boundary) + given_energy_;
  // What goes along with the platens, and may be ahead of a book that is closed to the step.
  const double speed = std::max({fastest_rate(), fem::norm(top.velocity()), fem::norm(bottom.velocity())});
  const double mass = std::accumulate(model.particles.mass.begin(), model.particles.mass.end(), 0.0);
  energy_allowed_ = most_of_work_in_motion * (came_in + 0.5 * mass * speed * speed);
  if (moving <= energy_allowed_) return;
  const dem::StableStep limit = limit_now();
  const std::string step = "the time step of " + text_of(time_step_) + " s is ";
  const std::string cause =
      time_step_ > limit.limit
          ? step + "above the stability limit of " + text_of(limit.limit) + " s (" + limit.reason + ")"
          : step + "too long for what happens here, though below the limit of " + text_of(limit.limit) + " s";
  throw NumericsStopped("step " + std::to_string(steps_) + ", time " + text_of(time()) +
                        " s: energy from nowhere: particles move with " + text_of(moving) +
                        " J or more where only " + text_of(came_in) + " J came in: " + cause +
                        "; try a smaller Integration/Safety or Integration/Time step");
}

} // namespace platen::coupling
