#include "coupling/program/side_loading.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace platen::coupling {

namespace {

constexpr double settled_share = 0.01; // of the stress that is asked

bool is_stress(const SideTask &task) {
  return task.ask == SideTask::Ask::stress || task.ask == SideTask::Ask::share;
}

} // namespace

double PlatensOfAxis::stress(const Measures &m) const {
  double sum = 0;
  for (const std::size_t place : places)
    sum += m.load(place);
  return sum / (static_cast<double>(places.size()) * area);
}

double PlatensOfAxis::closure(const Measures &m) const {
  double sum = 0;
  for (const std::size_t place : places)
    sum += m.closure_of(place);
  return sum / length;
}

SideLoading::SideLoading(Parameters parameters) : parameters_(std::move(parameters)) {
  if (!(parameters_.ramp > 0)) throw std::invalid_argument("a stage needs a ramp");
  std::vector<std::size_t> taken;
  for (const SideTask &task : parameters_.tasks) {
    if (task.platens.places.empty()) throw std::invalid_argument("a task asks no platen");
    taken.insert(taken.end(), task.platens.places.begin(), task.platens.places.end());
    doing_.emplace_back();
    if (is_stress(task)) doing_.back().servo.emplace(task.servo);
    if (task.ask != SideTask::Ask::share) continue;
    if (!(parameters_.lag > 0)) throw std::invalid_argument("a share of a stress needs a lag");
    for (const std::size_t place : task.followed.places)
      if (std::count(task.platens.places.begin(), task.platens.places.end(), place) > 0)
        throw std::invalid_argument("a side cannot bear a share of its own stress");
  }
  std::sort(taken.begin(), taken.end());
  if (std::adjacent_find(taken.begin(), taken.end()) != taken.end())
    throw std::invalid_argument("two tasks ask the same platen");
}

void SideLoading::find_start(const Measures &m) {
  started_ = true;
  for (std::size_t k = 0; k < doing_.size(); ++k) {
    const SideTask &task = parameters_.tasks[k];
    doing_[k].stress_found = task.platens.stress(m);
    if (task.ask == SideTask::Ask::share) doing_[k].followed = task.followed.stress(m);
  }
  if (!parameters_.end.of.places.empty()) closure_found_ = parameters_.end.of.closure(m);
}

// Smoothly from what was found; a share from it to what follows, in the time of the ramp.
double SideLoading::wanted_stress(const SideTask &task, const Doing &now, const Measures &m) const {
  const double passed = m.time() - 0.5 * m.time_step() - begun(), ahead = passed + parameters_.lead;
  const double share = smooth_start(std::max(0.0, ahead) / parameters_.ramp);
  double aim = task.value;
  if (task.ask == SideTask::Ask::share) {
    const double rate = (task.followed.stress(m) - now.followed) / parameters_.lag; // Pa/s
    aim *= now.followed + (parameters_.lag + parameters_.lead) * rate;
  }
  return now.stress_found + share * (aim - now.stress_found);
}

double SideLoading::speed(const SideTask &task, Doing &now, const Measures &m) {
  const std::vector<std::size_t> &places = task.platens.places;
  const double count = static_cast<double>(places.size()), dt = m.time_step();
  if (task.ask == SideTask::Ask::hold) return 0;
  if (!is_stress(task))
    return task.value / count * smooth_start((m.time() - 0.5 * dt - begun()) / parameters_.ramp);
  ServoLoad mean;
  double reaction = 0;
  for (const std::size_t place : places) {
    const ServoLoad load = m.servo_load(place);
    mean.stiffness += load.stiffness / count, mean.impedance += load.impedance / count;
    reaction += m.load(place) / count;
  }
  return now.servo->velocity(wanted_stress(task, now, m) * task.platens.area, reaction, mean, dt);
}

void SideLoading::command(const Measures &m, Commands &asked) {
  if (!started_) find_start(m);
  for (std::size_t k = 0; k < doing_.size(); ++k) {
    const double inward = speed(parameters_.tasks[k], doing_[k], m);
    for (const std::size_t place : parameters_.tasks[k].platens.places)
      asked[place].velocity = inward * m.inward(place);
  }
}

void SideLoading::update(const Measures &m) {
  if (!started_) return;
  for (std::size_t k = 0; k < doing_.size(); ++k) {
    const SideTask &task = parameters_.tasks[k];
    if (task.ask != SideTask::Ask::share) continue;
    const double share = std::min(1.0, m.time_step() / parameters_.lag);
    doing_[k].followed += share * (task.followed.stress(m) - doing_[k].followed);
  }
}

bool SideLoading::has_ended(const Measures &m) const {
  if (!started_) return false;
  const StageEnd &end = parameters_.end;
  const double passed = m.time() - begun();
  if (passed >= end.seconds) return true;
  if (!end.of.places.empty()) {
    if (std::abs(end.of.closure(m) - closure_found_) >= end.strain) return true;
    const double stress = end.of.stress(m);
    if ((end.rises_to && stress >= *end.rises_to) || (end.falls_to && stress <= *end.falls_to)) return true;
  }
  if (!end.settled || passed < parameters_.ramp) return false;
  return std::all_of(parameters_.tasks.begin(), parameters_.tasks.end(), [&](const SideTask &task) {
    if (!is_stress(task)) return true;
    const double asked = task.ask == SideTask::Ask::share ? task.value * task.followed.stress(m) : task.value;
    return std::all_of(task.platens.places.begin(), task.platens.places.end(), [&](std::size_t place) {
      return std::abs(m.load(place) / task.platens.area - asked) <= settled_share * std::abs(asked);
    });
  });
}

double SideLoading::fastest() const {
  double most = 0;
  for (const SideTask &task : parameters_.tasks)
    most = std::max(most, is_stress(task) ? task.servo.velocity_limit : std::abs(task.value));
  return most;
}

double SideLoading::expected_seconds() const {
  const StageEnd &end = parameters_.end;
  if (std::isfinite(end.seconds)) return end.seconds;
  for (const SideTask &task : parameters_.tasks)
    if (task.ask == SideTask::Ask::rate && std::isfinite(end.strain) && task.platens.places == end.of.places)
      return 0.5 * parameters_.ramp + end.strain * end.of.length / std::abs(task.value);
  return parameters_.ramp;
}

double SideLoading::progress(const Measures &m) const {
  const StageEnd &end = parameters_.end;
  const double by_time = (m.time() - begun()) / expected_seconds();
  if (!started_ || end.of.places.empty() || !std::isfinite(end.strain)) return std::min(1.0, by_time);
  return std::min(1.0, std::abs(end.of.closure(m) - closure_found_) / end.strain);
}

void SideLoading::Doing::describe(Archive &archive) {
  archive.version(1);
  if (servo) archive.part("servo", *servo);
  archive("stress_found", stress_found, "Pa");
  archive("followed", followed, "Pa");
}

void SideLoading::describe(Archive &archive) {
  Stage::describe(archive);
  archive("started", started_);
  archive("closure_found", closure_found_);
  for (std::size_t k = 0; k < doing_.size(); ++k)
    archive.part("task_" + std::to_string(k + 1), doing_[k]);
}

} // namespace platen::coupling
