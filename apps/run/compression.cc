#include "apps/run/compression.h"
#include "apps/output/crack_discs.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <utility>

#include "apps/output/stop_signal.h"
#include "apps/run/compression_run.h"
#include "apps/run/controls.h"
#include "apps/run/estimate.h"
#include "apps/run/ranks.h"
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
  c.ended_by = failed_ ? "failure" : signal_ != 0 ? "signal" : ended_by();
  if (ending_ && c.ended_by.empty()) c.ended_by = "script";
  if (!c.ended_by.empty())
    c.ended_by = with_misses(c.ended_by, *test_, results_, stages_over(*test_, !ended_by().empty()));
  return c;
}

// What stages asked and did not reach, of those that are over after so many.
void CompressionRun::tell_misses(std::size_t from) const {
  for (std::size_t k = from; k < stages_over(*test_, !ended_by().empty()); ++k) {
    const std::string words = words_of_misses(*test_, k);
    if (words.empty()) continue;
    if (failed_in(*test_, results_, k))
      log_.info("{} (the specimen failed in it)", words);
    else
      log_.warning("{}", words);
  }
}

void CompressionRun::tell_path() const {
  const PressurePath path = pressure_path(*test_, results_);
  if (path.deviation > most_off_path)
    log_.warning(
        "the pressure was up to {:.1f} % off its path, {:.0f} % at most: a lower Loading/Axial rate helps",
        100 * path.deviation, 100 * most_off_path);
  if (!std::isnan(path.ended_at_strain))
    log_.warning(
        "the pressure had come down to nothing at the strain of {:.5f}: from there on the test goes along "
        "no path, without a pressure",
        path.ended_at_strain);
}

// As it was called, but for an entry that is to be another.
std::string CompressionRun::resuming_command(const std::string &but) const {
  return shell_command(app_of(*test_), command_, but) + " --resume";
}

void CompressionRun::tell_cut() {
  log_.info("{}", words_of_cut(*ranks_));
  if (const std::string idle = words_of_idle_ranks(*ranks_); !idle.empty()) log_.warning("{}", idle);
}

// Signals and clocks: what one rank is asked, and what the first one's clock says, holds for all.
void CompressionRun::look_around() {
  signal_ = stop_requested();
  const bool by_clock = scene_.checkpoint.every.kind == Interval::Kind::time && this_rank().is_silent();
  checkpoint_asked_ = take_checkpoint_request() || (!by_clock && checkpoint_due());
  if (ranks_ == nullptr) return;
  signal_ = static_cast<int>(ranks_->largest(signal_));
  checkpoint_asked_ = ranks_->largest(checkpoint_asked_) > 0;
}

bool CompressionRun::pass() {
  const std::size_t ended = test_->program().stages_ended();
  test_->advance(steps_unobserved());
  tell_misses(ended);
  if (std::exchange(tells_cut_, false)) tell_cut();
  look_around();
  const bool row = due(scene_.output.every, automatic_rows);
  const bool frame = fields_ && due(scene_.output.fields_every, automatic_frames);
  if (frame || signal_ != 0 || finished())
    test_->gather();
  else if (row)
    test_->gather_motion();
  else
    test_->settle();
  if (!test_->model.cracks.empty()) write_cracks();
  if (row) sample();
  if (finished()) test_->gather(); // what a row shows may end the test
  // The last frame too before its checkpoint: what contacts bear is known after a step, not after a resume.
  if (fields_ && (finished() || frame)) {
    dem::StageClock::Lap lap(test_->model.clock, dem::Stage::output);
    fields_->write(*test_, results_.moves_with(*test_));
  }
  // The last state too: a test that has not shown its peak is led on from there.
  if (signal_ != 0 || (finished() && keeps_checkpoints()) || checkpoint_asked_) {
    dem::StageClock::Lap lap(test_->model.clock, dem::Stage::output);
    checkpoint();
  }
  return signal_ == 0;
}

void CompressionRun::loop() {
  Progress progress(log_);
  while (!finished() && pass())
    if (progress.due()) progress.update(where());
  progress.finish(where());
}

void CompressionRun::begin() {
  log_.info("{}", description());
  open_files();
  loop_start_ = Clock::now();
  tells_cut_ = ranks_ != nullptr;
}

void CompressionRun::give_up() {
  failed_ = true;
  test_->gather(); // all ranks have the same program and boundaries: all stop here
  output_.save(summary("failed"));
}

int CompressionRun::run() {
  if (!counted_.empty()) {
    if (!this_rank().is_silent()) fmt::print("{}\n{}", title_of(scene_), counted_);
    return status_done;
  }
  if (command_.dry_run) {
    if (this_rank().is_silent()) return status_done;
    fmt::print("{}{}", description(),
               scene_.parameters->with_entries(cost_estimate(*test_, expected_steps_)));
    return status_done;
  }
  try {
    begin();
    loop();
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

void CompressionRun::finish_files() {
  if (test_->model.bonds) write_bond_stress();
  if (scene_.model.crack_log) write_events();
  if (!fields_) return;
  fields_->write(*test_, results_.moves_with(*test_));
  fields_->finish();
  if (!cracks_) return;
  cracks_->sync();
  write_crack_discs(paths_.cracks(), test_->time(), paths_.cracks_vtu());
}

// Of what the test ended with.
void CompressionRun::tell_doubts(const Json &summary) {
  if (ended_by() == "shortened too far")
    log_.warning(
        "the specimen is shortened by {:.0f} % of its length: the test ends, for what is between the "
        "platens is no specimen of its size any more; a smaller Loading/Target strain ends before",
        100 * std::abs(test_->closure_strain(results_.axis())));
  tell_path();
  tell_misses(0);
  if (const Json &signs = summary["signs_of_haste"]; !signs.empty())
    log_.warning("too fast to be quasi-static, a lower Loading/Axial rate helps: {}",
                 fmt::join(signs.get<std::vector<std::string>>(), "; "));
  constexpr double most_unbalanced = 0.01; // of the work
  if (const double share = number_in(summary, "platen_unbalanced_work_relative"); share > most_unbalanced)
    log_.warning(
        "platens without inertia are {:.1f} % of the work behind their loads (summary.json, "
        "platen_unbalanced_work_relative), which no more than {:.0f} % should be: "
        "Platens/Motion = explicit, or fewer Platens/Steps per solve",
        100 * share, 100 * most_unbalanced);
}

int CompressionRun::end() {
  ending_ = true;
  results_.finish(*test_, event_window());
  finish_files();
  Json ended = summary(signal_ != 0 ? "stopped" : "done");
  if (signal_ == 0 && finished()) ended["expectations"] = check_expectations(scene_, ended);
  at_end_ = ended;
  output_.save(ended);
  log_.info("{}", report_of_run(ended));
  tell_doubts(ended);
  if (signal_ != 0) {
    log_.info("stopped by a signal; go on with: {}", resuming_command());
    return exit_status_of_signal(signal_);
  }
  if (results_.peak().kind == PeakKind::none && ended_by() == "target" && keeps_checkpoints() &&
      !scene_.loading.staged() && !scene_.loading.hydrostatic())
    log_.info("it goes on from here with: {}{}", resuming_command(target_entry),
              shell_entry(fmt::format("{} = {:.3g}", target_entry, 2 * scene_.loading.target_strain)));
  log_.info("results are in {}", paths_.folder.string());
  if (!finished()) {
    log_.info("ended before its target: what the scene expects is not checked");
    return status_done;
  }
  return output_.tell_expectations(ended);
}

int run_compression(const CommandLine &command, const Scene &scene) {
  return CompressionRun(command, scene, Pressed::along_axis).run();
}

int run_brazilian(const CommandLine &command, const Scene &scene) {
  return CompressionRun(command, scene, Pressed::across_axis).run();
}

} // namespace platen::apps
