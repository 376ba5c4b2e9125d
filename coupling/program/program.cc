#include "coupling/program/program.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace platen::coupling {

void Stage::describe(Archive &archive) {
  archive.version(1);
  archive("begun", begun_, "s");
  archive("closure_at_begin", closure_at_begin_);
}

Program::Program(const Measures &measures, std::vector<std::unique_ptr<Stage>> stages)
    : measures_(measures), stages_(std::move(stages)) {
  if (stages_.empty()) throw std::invalid_argument("program: it has no stage");
}

void Program::command(Commands &asked) {
  std::fill(asked.begin(), asked.end(), Command{});
  stages_[now_]->command(measures_, asked);
}

// A stage that begins sees the same state as the one that has ended.
void Program::update() {
  stages_[now_]->update(measures_);
  while (!finished_ && stages_[now_]->has_ended(measures_)) {
    finished_ = now_ + 1 == stages_.size();
    if (finished_) return;
    stages_[++now_]->begin(measures_);
    stages_[now_]->update(measures_);
  }
}

double Program::fastest() const {
  double speed = 0;
  for (const auto &stage : stages_)
    speed = std::max(speed, stage->fastest());
  return speed;
}

double Program::expected_seconds() const {
  double sum = 0;
  for (const auto &stage : stages_)
    sum += stage->expected_seconds();
  return sum;
}

double Program::progress() const {
  double done = 0;
  for (std::size_t k = 0; k < now_; ++k)
    done += stages_[k]->expected_seconds();
  const double all = expected_seconds();
  if (!(all > 0)) return finished_ ? 1 : 0;
  return std::min(1.0, (done + stage().progress(measures_) * stage().expected_seconds()) / all);
}

double Program::axial_closure() const {
  return stage().is_consolidation() ? 0.0 : stage().closure_gained(measures_);
}

void Program::describe(Archive &archive) {
  archive.version(1);
  archive("stage", now_);
  archive("finished", finished_);
  if (now_ >= stages_.size()) throw StateError("program: a stage that it does not have");
  for (std::size_t k = 0; k < stages_.size(); ++k)
    archive.part("stage_" + std::to_string(k + 1), *stages_[k]);
}

} // namespace platen::coupling
