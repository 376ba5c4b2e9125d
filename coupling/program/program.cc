#include "coupling/program/program.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "coupling/program/drive.h"

namespace platen::coupling {

bool Controlled::is_met() const {
  constexpr double tolerance = 0.01;
  return std::isfinite(target) && std::abs(reached - target) <= tolerance * reference;
}

void Stage::begin(const Measures &m, const Transfer &from, bool first) {
  if (!first) begun_ = m.time(), closure_at_begin_ = m.closure_strain();
  on_begin(m, from);
}

void Stage::describe(Archive &archive) {
  archive.version(1);
  archive("begun", begun_, "s");
  archive("closure_at_begin", closure_at_begin_, "1", or_nan());
}

Program::Program(const Measures &measures, std::vector<std::unique_ptr<Stage>> stages,
                 std::vector<std::shared_ptr<Drive>> drives)
    : measures_(measures), stages_(std::move(stages)), drives_(std::move(drives)) {
  if (stages_.empty()) throw std::invalid_argument("program: it has no stage");
}

Program::~Program() = default;

void Program::begin_stage(bool first) {
  if (!consolidated_ && !stage().is_consolidation()) {
    consolidated_ = true;
    if (!first)
      for (const int axis : {0, 1, 2})
        zero_[static_cast<std::size_t>(axis)] = measures_.closure_strain(axis);
  }
  stages_[now_]->begin(measures_, {first ? Commands{} : last_, zero_}, first);
}

void Program::command(Commands &commands) {
  if (!begun_) begun_ = true, begin_stage(true);
  std::fill(commands.begin(), commands.end(), Command{});
  stages_[now_]->command(measures_, commands);
  last_ = commands;
}

// A stage that begins gets the same state as the one that has ended.
void Program::update() {
  stages_[now_]->update(measures_);
  while (!finished_ && stages_[now_]->has_ended(measures_)) {
    stages_[now_]->end(measures_);
    finished_ = now_ + 1 == stages_.size();
    if (finished_) return;
    ++now_;
    begin_stage(false);
    stages_[now_]->update(measures_);
  }
}

void Program::go_on() {
  if (!finished_ || stage().has_ended(measures_)) return;
  finished_ = false;
  stages_[now_]->go_on();
}

void Program::change_rate(double rate) {
  std::vector<Drive *> driven;
  for (const auto &drive : drives_)
    if (drive->is_driven()) driven.push_back(drive.get());
  if (driven.size() != 1) throw std::invalid_argument("program: not one pair of platens is driven at a rate");
  driven.front()->change_rate(rate, measures_);
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
  return stage().is_consolidation() ? 0.0 : measures_.closure_strain() - zero_[2];
}

std::vector<Controlled> Program::controls(std::size_t number) const {
  if (number < stages_ended() && stages_[number]->ended_by().empty()) return {};
  return stages_[number]->controls(measures_);
}

std::size_t Program::stage_at(double time) const {
  std::size_t number = now_;
  while (number > 0 && stages_[number]->begun() >= time)
    --number;
  return number;
}

bool Program::is_cycling() const {
  return stage().is_cycling(measures_) || std::any_of(drives_.begin(), drives_.end(), [&](const auto &drive) {
           return drive->is_cycling(measures_);
         });
}

void Program::describe(Archive &archive) {
  archive.version(2);
  archive("stage", now_, "1", row_of(stages_.size()));
  archive("begun", begun_);
  archive("finished", finished_);
  archive("consolidated", consolidated_);
  archive("zero_x", zero_[0], "1", or_nan());
  archive("zero_y", zero_[1], "1", or_nan());
  archive("zero_z", zero_[2], "1", or_nan());
  for (std::size_t k = 0; k < drives_.size(); ++k)
    archive.part("drive_" + std::to_string(k + 1), *drives_[k]);
  for (std::size_t k = 0; k < stages_.size(); ++k)
    archive.part("stage_" + std::to_string(k + 1), *stages_[k]);
}

} // namespace platen::coupling
