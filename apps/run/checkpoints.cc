#include "apps/run/checkpoints.h"

#include <cmath>

#include "apps/output/checkpoint_folder.h"
#include "apps/run/ranks.h"
#include "apps/run/run_state.h"

namespace platen::apps {

bool Checkpoints::is_due() const {
  if (are_by_clock()) return seconds_since(last_) > every_.value;
  return are_kept() && std::fmod(static_cast<double>(test_.steps()), every_.value) == 0;
}

double Checkpoints::steps_until_due() const {
  if (every_.kind != Interval::Kind::steps) return Observer::steps_until_due();
  return every_.value - std::fmod(static_cast<double>(test_.steps()), every_.value);
}

void Checkpoints::observe(const Moment &now) {
  if (now.signal == 0 && !now.checkpoint_asked && !(now.ends && are_kept())) return;
  dem::StageClock::Lap lap(test_.model.clock, dem::Stage::output);
  test_.require_finite(); // or a run would resume from what has stopped it
  const FileMarks marks = marks_();
  const auto step = static_cast<std::uint64_t>(test_.steps());
  const auto fill = [&](StateSink &to) { save_state(to, test_, results_, marks); };
  test_.settle_state();
  if (test_.model.is_cut())
    write_checkpoint_of_ranks(test_.model, specimen_part, paths_.checkpoints(), step, fill);
  else
    write_checkpoint(paths_.checkpoints(), step, fill);
  last_ = Clock::now();
}

} // namespace platen::apps
