// Motion of an elastic solid: frame, loads, explicit steps.
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "base/portable.h"
#include "fem/elastic_solid.h"

namespace platen::fem {
namespace {

constexpr double step_share = 0.9; // fraction of the stable step in a drift
// Fraction of the step at which kicks alone would be unstable: a mode that oscillates half a period between
// kicks grows by (omega_kicks dt)^2 / (2 pi) = 6 % a step at most, less than the loss of 15 % by damping of
// the fastest mode with 5 % of critical.
constexpr double share_of_kicks = 0.3;
// Longest time between kicks over the stable step, which two substeps then cover (2 * step_share). Under a
// constant load a body oscillates between kicks, at rest at the kicks and midway, where damping acts. With
// three substeps damping would take energy from that oscillation that no load has supplied.
constexpr double steps_between_kicks = 1.8;

} // namespace

Vector3 ElasticSolid::carried(std::size_t node) const {
  if (!turned_) return displacement_; // no rotation: a flat face stays flat to the last bit
  const Vector3 r = model_.nodes[node] - pivot_;
  return displacement_ + (rotate(rotation_, r) - r);
}

void ElasticSolid::set_velocity(const Vector3 &velocity) {
  set_velocity(velocity, turns() ? angular_velocity_ : Vector3{});
}

void ElasticSolid::set_velocity(const Vector3 &velocity, const Vector3 &angular_velocity) {
  if (velocity == velocity_ && angular_velocity == angular_velocity_) return;
  if (clamped_nodes_.empty()) throw std::logic_error("elastic solid: a body without clamp is not moved");
  const double before = is_static() ? 0.5 * dot(angular_velocity_, spin_) : held_kinetic_energy();
  if (turns()) {
    // The seat's velocity jump also acts on the rotor's inertia; a prescribed change of rotation is added.
    const Vector3 change = angular_velocity - angular_velocity_;
    spin_ = spin_ + to_space(rotor_ * to_frame(change));
    if (!is_static()) spin_ = spin_ - cross(to_space(rotor_arm_), velocity - velocity_);
    find_angular_velocity();
  } else {
    angular_velocity_ = angular_velocity;
  }
  velocity_ = velocity;
  if (!is_static()) place_held();
  clamp_work_ += (is_static() ? 0.5 * dot(angular_velocity_, spin_) : held_kinetic_energy()) - before;
  place_surface();
}

void ElasticSolid::find_angular_velocity() {
  angular_velocity_ = to_space(rotor_inverse_ * to_frame(spin_));
}

double ElasticSolid::held_kinetic_energy() const {
  double twice = 0;
  for (const int i : clamped_nodes_) {
    const auto node = static_cast<std::size_t>(i);
    twice += model_.mass[node] * dot(rate_[node], rate_[node]);
  }
  return 0.5 * twice;
}

// A free rotor rotates by its angular velocity at half the step, since its inertia rotates with it.
void ElasticSolid::move_frame(double dt) {
  displacement_ = displacement_ + dt * velocity_;
  if (angular_velocity_ == Vector3{}) return;
  const Quaternion before = rotation_;
  if (turns()) {
    rotation_ = normalised(normalised(rotation_quaternion(0.5 * dt * angular_velocity_)) * before);
    turned_ = true;
    find_angular_velocity();
  }
  rotation_ = normalised(normalised(rotation_quaternion(dt * angular_velocity_)) * before);
  turned_ = !is_identity(rotation_);
  if (turns()) find_angular_velocity();
}

void ElasticSolid::place_held() {
  for (const int i : clamped_nodes_) {
    const auto node = static_cast<std::size_t>(i);
    moved_[node] = carried(node);
    rate_[node] = carried_velocity(arm(node));
  }
}

void ElasticSolid::place_surface() {
  const double s = is_static() ? path_fraction() : 0;
  for (std::size_t v = 0; v < node_of_.size(); ++v) {
    const auto node = static_cast<std::size_t>(node_of_[v]);
    if (is_static()) {
      const Vector3 displacement = target_[node] - start_[node];
      moved_[node] = carried(node) + to_space(start_[node] + s * displacement);
      rate_[node] = carried_velocity(arm(node));
      if (on_the_path_) rate_[node] = rate_[node] + to_space((1 / duration_) * displacement);
    }
    surface_.vertices[v] = model_.nodes[node] + moved_[node];
    surface_.velocities[v] = rate_[node];
  }
}

// Transfers the body's force and moment to its clamp over dt: to the machine, the sliding clamp, or the free
// seat.
void ElasticSolid::give_to_clamp(double dt, const Vector3 &force, const Vector3 &moment) {
  if (slides()) {
    const double along = dot(force, clamp_.slides);
    clamp_work_ -= dt * dot(force - along * clamp_.slides, velocity_);
    slide(dt * along);
  } else {
    clamp_work_ -= dt * dot(force, velocity_);
  }
  if (!turns()) {
    clamp_work_ -= dt * dot(moment, angular_velocity_);
    return;
  }
  spin_ = spin_ + dt * moment;
  find_angular_velocity();
}

// A sliding seat also accelerates the rotor's mass. The effect of the rotation on the sliding is of second
// order in the tilt: a guide takes it, and its work is the machine's.
void ElasticSolid::slide(double impulse) {
  const double gain = impulse / sliding_mass_;
  if (!turns() || is_static()) {
    velocity_ = velocity_ + gain * clamp_.slides;
    return;
  }
  const auto energy = [this] {
    const double speed = sliding_velocity();
    return held_kinetic_energy() + 0.5 * attached_mass_ * speed * speed;
  };
  const double before = energy(), work = impulse * (sliding_velocity() + 0.5 * gain);
  velocity_ = velocity_ + gain * clamp_.slides;
  spin_ = spin_ - gain * cross(to_space(rotor_arm_), clamp_.slides);
  find_angular_velocity();
  place_held();
  clamp_work_ += energy() - before - work;
}

void ElasticSolid::push(double impulse) {
  const double before = sliding_velocity();
  slide(impulse);
  pushed_ = impulse;
  load_work_ += 0.5 * impulse * (before + sliding_velocity());
  if (!is_static()) place_held();
  place_surface();
}

void ElasticSolid::kick(double dt) {
  Vector3 force{}, moment{}; // transferred to the clamp
  double relative = 0;       // power in the frame, quasi-static
  kicked_.clear();
  for (const int v : loaded_) {
    const auto node = static_cast<std::size_t>(node_of_[static_cast<std::size_t>(v)]);
    const Vector3 load = contact_load(v), r = arm(node);
    if (is_static()) {
      force = force + load, moment = moment + cross(r, load);
      relative += dot(load, rate_[node] - carried_velocity(r));
      continue;
    }
    const Vector3 free = free_part(node, load), kept = load - free;
    const Vector3 gain = (dt / model_.mass[node]) * free;
    load_work_ += dt * dot(free, rate_[node] + 0.5 * gain);
    rate_[node] = rate_[node] + gain;
    surface_.velocities[static_cast<std::size_t>(v)] = rate_[node];
    kicked_.push_back({node, gain, {}});
    force = force + kept, moment = moment + cross(r, kept);
  }
  const Vector3 before = angular_velocity_, drifted = velocity_;
  give_to_clamp(dt, force, moment);
  load_work_ +=
      dt * (0.5 * dot(force, drifted + velocity_) + 0.5 * dot(moment, before + angular_velocity_) + relative);
  dissipated_ += dt * relative;
  if (moves_by_itself() && !is_static()) place_held();
  if (moves_by_itself()) place_surface();
}

// Substeps as long as the kicks: frequencies add at most as squares. Shorter ones: kicks are impulses on free
// vertices, and the damping must remove their effect on modes that oscillate half a period between them.
double ElasticSolid::stable_step(const VertexSprings &springs) const {
  if (is_static()) return stable_step_;
  double square = slides() ? springs.clamp / sliding_mass_ : 0, damping = 0; // 1/s^2, 1/s
  for (std::size_t v = 0; v < node_of_.size(); ++v) {
    const double mass = model_.mass[static_cast<std::size_t>(node_of_[v])];
    square = std::max(square, springs.stiffness[v] / mass);
    damping = std::max(damping, springs.dashpot[v] / mass);
  }
  const auto limit = [&](double omega) {
    const double xi = 0.5 * damping / omega;
    return 2 / omega * (std::sqrt(1 + xi * xi) - xi);
  };
  const double own = 2 / (step_share * stable_step_);
  const double together = limit(std::sqrt(own * own + square));
  const double kicks = square > 0 ? std::max(together, share_of_kicks * limit(std::sqrt(square)))
                                  : std::numeric_limits<double>::infinity();
  return std::min(kicks, steps_between_kicks * stable_step_);
}

int ElasticSolid::substeps(double dt) const {
  if (is_static()) return 1;
  return std::max(1, static_cast<int>(std::ceil(std::abs(dt) / (step_share * stable_step_))));
}

void ElasticSolid::drift(double dt) {
  drift(dt, substeps(dt));
}

void ElasticSolid::drift(double dt, int steps) {
  const std::vector<Vector3> before = surface_.vertices;
  if (is_static())
    drift_evenly(dt);
  else
    for (int k = 0; k < steps; ++k)
      substep(dt / steps);
  place_surface();
  last_move_ = 0;
  for (std::size_t v = 0; v < before.size(); ++v) {
    const Vector3 displacement = surface_.vertices[v] - before[v];
    last_move_ = std::max(last_move_, norm(displacement));
    if (!is_static() && dt != 0) surface_.velocities[v] = (1 / dt) * displacement;
  }
}

void ElasticSolid::substep(double dt) {
  damp(dt);
  internal_kick(0.5 * dt);
  move_frame(dt);
  for (std::size_t i = 0; i < moved_.size(); ++i)
    moved_[i] = moved_[i] + dt * rate_[i];
  place_held();
  find_internal_forces(true);
  internal_kick(0.5 * dt);
  last_step_ = dt;
}

void ElasticSolid::find_internal_forces(bool yields) {
  for (std::size_t i = 0; i < moved_.size(); ++i)
    strained_[i] = turned_ ? to_frame(arm(i)) - (model_.nodes[i] - pivot_) : moved_[i] - displacement_;
  multiply(model_.stiffness, strained_, force_);
  if (yielding_) {
    if (yields) yielding_->yield(strained_);
    for (std::size_t i = 0; i < force_.size(); ++i)
      force_[i] = force_[i] - yielding_->forces()[i];
  }
  for (Vector3 &f : force_)
    f = -1.0 * to_space(f);
}

// The clamp takes force and moment of the forces on free nodes: with those on fixed nodes, the moment for
// small strain would lack the part of second order and angular momentum would not be conserved.
void ElasticSolid::internal_kick(double dt) {
  Vector3 force{}, moment{};
  for (std::size_t i = 0; i < force_.size(); ++i) {
    const Vector3 free = free_part(i, force_[i]);
    rate_[i] = rate_[i] + (dt / model_.mass[i]) * free;
    force = force - free, moment = moment - cross(arm(i), free);
  }
  if (clamped_nodes_.empty()) return;
  give_to_clamp(dt, force, moment);
  if (moves_by_itself()) place_held();
}

// Dashpots to the frame and between the nodes. They act where both halves of the loads' impulse meet: the
// half already applied is removed meanwhile, or else a loaded body at rest would be damped.
void ElasticSolid::damp(double dt) {
  const double alpha = options_.mass_damping, beta = options_.stiffness_damping;
  if (alpha == 0 && beta == 0) return;
  for (Kicked &k : kicked_) {
    rate_[k.node] = rate_[k.node] - k.gain;
    k.before = rate_[k.node];
  }
  const double pushed = std::exchange(pushed_, 0.0);
  if (pushed != 0) slide(-pushed), place_held();
  const double slid = sliding_velocity();
  std::vector<Vector3> relative(rate_.size()), impulse(rate_.size(), Vector3{});
  for (std::size_t i = 0; i < rate_.size(); ++i)
    relative[i] = to_frame(rate_[i] - carried_velocity(arm(i)));
  if (beta > 0) multiply(model_.stiffness, relative, impulse);
  Vector3 force{}, moment{};
  const double slowed = 1 - portable::exp(-alpha * dt); // fraction of its speed that a node loses
  for (std::size_t i = 0; i < rate_.size(); ++i) {
    const double mass = model_.mass[i];
    const Vector3 w = to_space(relative[i]);
    const Vector3 push = free_part(i, (-dt * beta) * to_space(impulse[i]) + (-mass * slowed) * w);
    const Vector3 gain = (1 / mass) * push;
    rate_[i] = rate_[i] + gain;
    dissipated_ -= dot(push, w + 0.5 * gain);
    force = force - push, moment = moment - cross(arm(i), push);
  }
  for (const Kicked &k : kicked_) {
    load_work_ += model_.mass[k.node] * dot(k.gain, rate_[k.node] - k.before);
    rate_[k.node] = rate_[k.node] + k.gain;
  }
  kicked_.clear();
  if (clamped_nodes_.empty()) return;
  give_to_clamp(1, force, moment);
  if (slides()) dissipated_ -= 0.5 * dot(force, clamp_.slides) * (sliding_velocity() - slid);
  load_work_ += pushed * (sliding_velocity() - slid);
  if (pushed != 0) slide(pushed);
  if (moves_by_itself()) place_held();
}

} // namespace platen::fem
