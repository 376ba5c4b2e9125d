#include "coupling/program/loading_stage.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace platen::coupling {

LoadingStage::LoadingStage(Parameters parameters, std::vector<std::unique_ptr<Task>> tasks, StageEnd end)
    : parameters_(std::move(parameters)), tasks_(std::move(tasks)), end_(std::move(end)) {
  forget_end();
}

void LoadingStage::on_begin(const Measures &m, const Transfer &from) {
  for (const auto &task : tasks_)
    task->begin(m, begun(), from);
  end_.begin(m, from);
}

void LoadingStage::command(const Measures &m, Commands &commands) {
  for (const auto &task : tasks_)
    task->command(m, commands);
}

void LoadingStage::update(const Measures &m) {
  for (const auto &task : tasks_)
    task->update(m);
  end_.update(m, m.time() - begun());
}

int LoadingStage::reached(const Measures &m) const {
  const double passed = m.time() - begun();
  const bool settled =
      end_.needs_settled() && passed >= end_.parameters().least &&
      std::all_of(tasks_.begin(), tasks_.end(), [&](const auto &task) { return task->has_settled(m); });
  return end_.reached(m, passed, settled);
}

void LoadingStage::end(const Measures &m) {
  ended_by_ = reached(m);
  const Until *until =
      ended_by_ > 0 ? &end_.parameters().any[static_cast<std::size_t>(ended_by_) - 1] : nullptr;
  for (std::size_t k = 0; k < tasks_.size(); ++k) {
    std::optional<Controlled> one = tasks_[k]->controlled(m);
    if (!one) continue;
    if (until != nullptr && until->what == Until::Reached::stress && one->unit == Controlled::pascal &&
        one->axis == until->of.axis)
      one->target = until->value, one->reference = std::abs(until->value);
    at_end_[k] = {true, one->target, one->reached, one->reference};
  }
}

void LoadingStage::forget_end() {
  ended_by_ = 0;
  at_end_.assign(tasks_.size(), {});
}

void LoadingStage::go_on() {
  forget_end();
}

std::string LoadingStage::ended_by() const {
  if (ended_by_ == StageEnd::too_late) return not_settled;
  return ended_by_ > 0 ? name_of(end_.parameters().any[static_cast<std::size_t>(ended_by_) - 1].what) : "";
}

std::vector<Controlled> LoadingStage::controls(const Measures &m) const {
  std::vector<Controlled> all;
  for (std::size_t k = 0; k < tasks_.size(); ++k) {
    std::optional<Controlled> one = tasks_[k]->controlled(m);
    if (!one || (ended_by_ != 0 && !at_end_[k].reported)) continue;
    if (ended_by_ != 0)
      one->target = at_end_[k].target, one->reached = at_end_[k].reached,
      one->reference = at_end_[k].reference;
    all.push_back(*one);
  }
  return all;
}

double LoadingStage::progress(const Measures &m) const {
  const double passed = m.time() - begun(), expected = parameters_.expected_seconds;
  const double by_end = end_.progress(m, passed);
  if (by_end > 0 || !(expected > 0)) return by_end;
  return std::min(1.0, passed / expected);
}

// Where only one of two opposite platens loads further, the mean stress of both is not a stress of loading.
Loads LoadingStage::loads(const Measures &m) const {
  const bool changing = parameters_.changes_sides && m.time() - begun() < end_.parameters().ramp;
  if (parameters_.consolidates || parameters_.parts || changing) return Loads::none;
  Loads all = Loads::none;
  for (const std::size_t k : parameters_.loading) {
    const Loads one = tasks_[k]->loads(parameters_.sense);
    if (one == Loads::none) return Loads::none;
    if (all == Loads::none || one != Loads::by_closure) all = one;
  }
  return all;
}

double LoadingStage::fastest() const {
  double most = 0;
  for (const auto &task : tasks_)
    most = std::max(most, task->fastest());
  return most;
}

void LoadingStage::AtEnd::describe(Archive &archive) {
  archive("told_at_end", reported, "1", false);
  archive("asked_at_end", target, "1", 0.0);
  archive("reached_at_end", reached, "1", 0.0);
  archive("whole_at_end", reference, "1", 0.0);
}

void LoadingStage::describe(Archive &archive) {
  Stage::describe(archive);
  archive("ended_by", ended_by_, "1", 0,
          between(StageEnd::too_late, static_cast<double>(end_.parameters().any.size())));
  archive.part("end", end_);
  for (std::size_t k = 0; k < tasks_.size(); ++k)
    archive.part("task_" + std::to_string(k + 1), *tasks_[k]);
  for (std::size_t k = 0; k < at_end_.size(); ++k)
    archive.part("control_" + std::to_string(k + 1), at_end_[k]);
}

} // namespace platen::coupling
