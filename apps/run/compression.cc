#include "apps/run/compression.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/output/checkpoint_folder.h"
#include "apps/output/progress.h"
#include "apps/output/stop_signal.h"
#include "apps/run/compression_run.h"
#include "apps/run/controls.h"
#include "apps/run/estimate.h"
#include "apps/run/run_state.h"
#include "apps/scene/errors.h"
#include "apps/scene/expect.h"
#include "apps/scene/parameters.h"
#include "apps/scene/rank.h"
#include "apps/scene/shell.h"

namespace platen::apps {

RunCosts CompressionRun::costs() const {
  RunCosts c;
  c.threads = output_.threads();
  c.wall_seconds = earlier_seconds_ + output_.seconds();
  c.setup_seconds = setup_seconds_;
  c.steps_here = test_->steps() - first_step_;
  c.step_seconds = seconds_since(loop_start_);
  const std::string by = ended_by();
  c.ended_by = failed_ ? "failure" : now_.signal != 0 ? "signal" : ending_ && by.empty() ? "script" : by;
  if (!c.ended_by.empty())
    c.ended_by = with_misses(c.ended_by, *test_, results_, stages_over(*test_, !by.empty()));
  return c;
}

// As it was called, but for an entry that is to be another.
std::string CompressionRun::resuming_command(const std::string &but) const {
  return shell_command(app_of(*test_), command_, but) + " --resume";
}

ProgressSample CompressionRun::where() const {
  ProgressSample p;
  p.fraction = test_->program().progress();
  p.step = static_cast<std::uint64_t>(test_->steps());
  p.time = test_->time();
  p.strain = test_->closure_strain(results_.axis());
  p.stress = test_->platens_along(results_.axis()).stress(*test_);
  p.broken_bonds = test_->model.broken_tension + test_->model.broken_shear;
  return p;
}

// Steps that can be made before an observer is due.
long CompressionRun::steps_unobserved() const {
  constexpr double most = 16; // between two checks of signals and progress
  double steps = most;
  for (const Observer *observer : observers_)
    steps = std::min(steps, observer->steps_until_due());
  return static_cast<long>(std::max(steps, 1.0));
}

// Signals and clocks: what one rank is asked, and what the first one's clock says, holds for all.
void CompressionRun::look_around() {
  now_.ends = finished();
  now_.signal = stop_requested();
  const bool by_another_clock = checkpoints_->are_by_clock() && this_rank().is_silent();
  now_.checkpoint_asked = take_checkpoint_request() || (!by_another_clock && checkpoints_->is_due());
  if (ranks_ == nullptr) return;
  now_.signal = static_cast<int>(ranks_->largest(now_.signal));
  now_.checkpoint_asked = ranks_->largest(now_.checkpoint_asked) > 0;
}

void CompressionRun::observe() {
  Gathered needed = now_.ends || now_.signal != 0 ? Gathered::everything : Gathered::nothing;
  for (const Observer *observer : observers_)
    needed = std::max(needed, observer->needs());
  if (needed == Gathered::everything)
    test_->gather();
  else if (needed == Gathered::motion)
    test_->gather_motion();
  else
    test_->settle();
  for (Observer *observer : observers_) {
    observer->observe(now_);
    if (now_.ends || !finished()) continue;
    now_.ends = true; // by what a row shows
    test_->gather();
  }
}

bool CompressionRun::pass() {
  test_->advance(steps_unobserved());
  look_around();
  observe();
  return now_.signal == 0;
}

void CompressionRun::begin() {
  log_.info("{}", description());
  FileMarks marks;
  if (resumes_)
    marks = resume();
  else
    record_->begin(as_packed_);
  if (scene_.output.fields) { // written in parallel: a run on one thread uses one core
    frames_.emplace(scene_, *test_, results_, paths_.folder, output_.threads() > 1, expected_steps_);
    if (resumes_)
      frames_->resume(marks);
    else
      frames_->write();
  }
  messages_.emplace(scene_, *test_, results_, log_, ranks_);
  checkpoints_.emplace(scene_, *test_, results_, paths_, [this] { return marks_of_files(); });
  observers_ = {&*messages_, &*record_, &*checkpoints_};
  if (frames_) observers_.insert(observers_.end() - 1, &*frames_); // the last frame too before its checkpoint
  loop_start_ = Clock::now();
}

FileMarks CompressionRun::resume() {
  const FoundCheckpoint found = newest_whole_checkpoint(paths_.checkpoints());
  for (const std::string &remark : found.remarks)
    log_.warning("{}", remark);
  const CheckpointReader checkpoint(found.path);
  const FileMarks marks = load_state(checkpoint, *test_, results_);
  if (results_.samples().empty()) checkpoint.fail("\"results/samples\" has no row, one at least is needed");
  if (marks.target_strain != scene_.loading.target_strain) test_->go_on();
  output_.keep_changes();
  record_->resume(marks);
  earlier_seconds_ = marks.wall_seconds;
  first_step_ = test_->steps();
  log_.info("resumed at step {}, time {:.6g} s", test_->steps(), test_->time());
  return marks;
}

void CompressionRun::give_up() {
  failed_ = true;
  test_->gather(); // all ranks have the same program and boundaries: all stop here
  output_.save(summary("failed"));
}

int CompressionRun::run() {
  if (command_.dry_run) {
    if (this_rank().is_silent()) return status_done;
    if (!counted_.empty())
      fmt::print("{}\n{}", title_of(scene_), counted_);
    else
      fmt::print("{}{}", description(),
                 scene_.parameters->with_entries(cost_estimate(*test_, expected_steps_)));
    return status_done;
  }
  try {
    begin();
    Progress progress(log_);
    while (!finished() && pass())
      if (progress.due()) progress.update(where());
    progress.finish(where());
  } catch (const coupling::NumericsStopped &e) {
    give_up();
    std::error_code ignored;
    const bool kept = std::filesystem::exists(paths_.checkpoints(), ignored);
    throw NumericsError(fmt::format("{}\n{}", scene_.parameters->with_entries(e.what()),
                                    kept ? "the last checkpoint is in " + paths_.checkpoints().string()
                                         : "no checkpoint had been written"));
  }
  return end();
}

int CompressionRun::end() {
  ending_ = true;
  const double crossing = test_->shape().height / test_->facts().wave_transit; // m/s
  results_.finish(*test_, dem::event_window(dem::mean_radius(test_->model.particles), crossing,
                                            scene_.output.event_reach, scene_.output.event_time));
  for (Observer *observer : observers_)
    observer->finish();
  const bool stopped = now_.signal != 0, over = !stopped && finished();
  Json ended = summary(stopped ? "stopped" : "done");
  if (over) ended["expectations"] = check_expectations(scene_, ended);
  at_end_ = ended;
  output_.save(ended);
  log_.info("{}", report_of_run(ended));
  messages_->report_doubts(ended);
  if (stopped) {
    log_.info("stopped by a signal; go on with: {}", resuming_command());
    return exit_status_of_signal(now_.signal);
  }
  if (results_.peak().kind == PeakKind::none && ended_by() == "target" && checkpoints_->are_kept() &&
      !scene_.loading.staged() && !scene_.loading.hydrostatic())
    log_.info("it goes on from here with: {}{}", resuming_command(target_entry),
              shell_entry(fmt::format("{} = {:.3g}", target_entry, 2 * scene_.loading.target_strain)));
  log_.info("results are in {}", paths_.folder.string());
  if (!over) {
    log_.info("ended before its target: what the scene expects is not checked");
    return status_done;
  }
  return output_.report_expectations(ended);
}

Json CompressionRun::summary(const std::string &status) const {
  if (!at_end_.is_null()) return at_end_;
  const RunCosts spent = costs();
  Json made = summary_of_run(status, {scene_, *test_, results_, spent});
  if (!changes_.empty()) made["changes"] = changes_;
  made["expectations"] = unchecked_expectations(scene_, "the test has not come to its end");
  return made;
}

int run_compression(const CommandLine &command, const Scene &scene) {
  return CompressionRun(command, scene, Pressed::along_axis).run();
}

int run_brazilian(const CommandLine &command, const Scene &scene) {
  return CompressionRun(command, scene, Pressed::across_axis).run();
}

} // namespace platen::apps
