#include "apps/study/run_study.h"
#include "apps/scene/regular_file.h"
#include "apps/scene/shell.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <functional>
#include <iterator>
#include <memory>
#include <numeric>
#include <thread>

#include "apps/output/file.h"
#include "apps/output/machine.h"
#include "apps/output/output_folder.h"
#include "apps/output/progress.h"
#include "apps/output/run_log.h"
#include "apps/output/stop_signal.h"
#include "apps/output/summary.h"
#include "apps/run/app_output.h"
#include "apps/scene/values.h"
#include "apps/scene/version.h"
#include "apps/study/cases.h"
#include "apps/study/planned_runs.h"
#include "apps/study/runs.h"
#include "apps/study/study_results.h"
#include "apps/study/target_app.h"
#include "base/clock.h"
#include "base/parallel.h"

namespace platen::apps {
namespace {

namespace fs = std::filesystem;

// Runs that are asked to end finish their step and write a checkpoint, at most some hundred megabytes.
constexpr std::chrono::seconds patience_of_study{60};

std::string content_of(const fs::path &path) {
  std::ifstream file = open_file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

class StudyApp {
public:
  StudyApp(const CommandLine &command, const Scene &scene)
      : command_(command),
        scene_(scene),
        plan_(plan_study(study_kind(command.kind), scene, command.overrides)),
        paths_(command.output),
        runs_(targets() ? std::vector<TestRun>{}
                        : runs_of(plan_, command.scene, command.overrides, paths_, threads(),
                                  command.run > 0 || command.plan || command.collect)),
        log_(loudness_of(command)) {}

  int run();

private:
  int threads() const { return command_.threads > 0 ? command_.threads : this_machine().cores; }
  bool targets() const { return plan_.kind == StudyKind::target; }
  std::string command_text() const;
  TargetSetup target_setup() const;
  std::string description() const;
  int tell_costs() const;
  void open();
  void open_anew();
  void require_same_study() const;
  int make_all();
  int make_planned(const std::function<Json()> &costs);

  const CommandLine &command_;
  const Scene &scene_;
  StudyPlan plan_;
  Clock::time_point start_ = Clock::now();
  OutputPaths paths_;
  std::unique_ptr<FileLock> lock_; // of the folder
  std::vector<TestRun> runs_;
  RunLog log_;
};

// As it was called, but for what is to be done.
std::string StudyApp::command_text() const {
  return shell_command("platen-study", command_);
}

TargetSetup StudyApp::target_setup() const {
  return {scene_, plan_, paths_, command_.scene, command_.overrides, threads(), command_text()};
}

std::string StudyApp::description() const {
  if (targets())
    return fmt::format("{}\n  study of target, {} runs at a time\n", title_of(scene_), threads());
  std::string text =
      fmt::format("{}\n  study of {}: {} cases on seeds {} to {}, {} runs, {} at a time\n", title_of(scene_),
                  word(plan_.kind), plan_.cases.size(), plan_.seeds.front(), plan_.seeds.back(), runs_.size(),
                  std::min<std::size_t>(runs_.size(), static_cast<std::size_t>(threads())));
  for (const StudyCase &one : plan_.cases)
    text += fmt::format("  {}:{}{}\n", one.name, one.overrides.empty() ? "" : " ",
                        fmt::join(one.overrides, ", "));
  return text;
}

// --dry-run: what platen-compress says of the first run of each case.
int StudyApp::tell_costs() const {
  fmt::print("{}", description());
  for (std::size_t k = 0; k < runs_.size(); k += plan_.seeds.size()) {
    fmt::print("\n{}\n", runs_[k].name);
    std::fflush(stdout);
    Process process = start(runs_[k], {"--dry-run"}, Process::Output::ours);
    while (process.running())
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    if (process.status() == status_bad_input) throw InputError(runs_[k].name + ": " + process.errors());
    if (process.status() != status_done) throw std::runtime_error(runs_[k].name + ": " + process.errors());
  }
  const auto seconds = [](double sum, const TestRun &run) { return sum + run.seconds; };
  const double all = std::accumulate(runs_.begin(), runs_.end(), 0.0, seconds);
  const auto at_a_time =
      static_cast<double>(std::min<std::size_t>(runs_.size(), static_cast<std::size_t>(threads())));
  fmt::print(
      "\nall {} runs: {} of one core, {} with {:.0f} at a time, to their target strains (counted from the "
      "scenes)\n",
      runs_.size(), duration_text(all), duration_text(all / at_a_time), at_a_time);
  return status_done;
}

void StudyApp::require_same_study() const {
  if (targets())
    require_same_scene(scene_, paths_, may_change_on_resume);
  else
    require_same_scene(scene_, paths_);
  const Json before = Json::parse(content_of(paths_.study_json()), nullptr, false);
  const std::string kind = before.is_object() ? before.value("kind", "") : "";
  if (kind != word(plan_.kind))
    throw InputError(paths_.study_json().string() +
                     ": error: " + (kind.empty() ? "is not of a study" : "is of a study of " + kind) +
                     "; resume with the KIND as it was, or leave out --resume");
}

void StudyApp::open_anew() {
  const std::vector<fs::path> inputs = input_files(scene_);
  const FolderUse use = command_.overwrite ? FolderUse::overwrite : FolderUse::fresh;
  check_output_folder(paths_.folder, use, inputs);
  clear_runs(paths_, command_.overwrite, inputs);
  open_locked(lock_, paths_.folder, use, inputs, log_);
  create_folder(paths_.runs());
  write_text_aside(paths_.scene(), scene_text(scene_, paths_.folder));
  write_summary(paths_.study_json(), Json{{"kind", word(plan_.kind)}, {"status", "running"}});
}

void StudyApp::open() {
  std::error_code none;
  if (fs::exists(paths_.log(), none)) lock_ = lock_folder(paths_.folder, patience_of_study, log_);
  if (command_.resume) {
    require_same_study();
    if (targets()) write_text_aside(paths_.scene(), scene_text(scene_, paths_.folder));
  } else
    open_anew();
  log_.open(paths_.log(), command_.resume, {version_text(), command_.text, threads()});
}

// Which runs a target needs is not known before others are there.
void refuse_planned(const CommandLine &command) {
  const char *option = command.plan      ? "--plan"
                       : command.run > 0 ? "--run"
                       : command.collect ? "--collect"
                                         : "";
  if (*option != '\0')
    throw InputError(fmt::format(
        "command line: error: {} does not go with a study of target, whose runs follow from those "
        "that are there. Allowed: the whole study, --dry-run, --resume.",
        option));
}

int StudyApp::run() {
  if (targets()) {
    refuse_planned(command_);
    if (command_.dry_run) {
      fmt::print("{}", description());
      return tell_target_plan(target_setup());
    }
    return make_all();
  }
  if (command_.dry_run) return tell_costs();
  const PlannedStudy planned{scene_, plan_, runs_, paths_, command_text()};
  if (command_.plan) return plan_runs(command_, planned, log_);
  if (command_.run > 0) return make_planned_run(command_, planned, log_);
  if (command_.collect) return collect_runs(command_, planned, log_);
  return make_all();
}

int StudyApp::make_all() {
  catch_stop_signals();
  open();
  log_.info("{}", description());
  const auto costs = [&] {
    return Json{{"threads", threads()},
                {"wall_seconds", seconds_since(start_)},
                {"peak_memory_bytes", peak_memory_bytes()}};
  };
  try {
    if (targets()) return make_target(target_setup(), log_, costs);
    return make_planned(costs);
  } catch (const Stopped &stopped) {
    log_.info("stopped by a signal; go on with: {} --resume", command_text());
    return exit_status_of_signal(stopped.signal);
  }
}

int StudyApp::make_planned(const std::function<Json()> &costs) {
  StudyResults results(scene_, plan_, runs_, paths_, log_);
  carry_out(
      runs_, threads(), log_, [&](std::size_t k, const RunOutcome &outcome) { results.keep(k, outcome); },
      [&](std::size_t k, const RunOutcome &outcome, std::size_t ended) { results.tell(k, outcome, ended); });
  return results.finish(costs());
}

} // namespace

int run_study(const CommandLine &command, const Scene &scene) {
  return StudyApp(command, scene).run();
}

} // namespace platen::apps
