#include "apps/study/run_study.h"
#include "apps/scene/regular_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <memory>
#include <thread>

#include "apps/io/file.h"
#include "apps/io/machine.h"
#include "apps/io/output_folder.h"
#include "apps/io/run_log.h"
#include "apps/io/stop_signal.h"
#include "apps/io/summary.h"
#include "apps/run/app_output.h"
#include "apps/scene/values.h"
#include "apps/scene/version.h"
#include "apps/study/cases.h"
#include "apps/study/planned_runs.h"
#include "apps/study/process.h"
#include "apps/study/runs.h"
#include "apps/study/study_results.h"
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
        runs_(runs_of(plan_, command.scene, command.overrides, paths_, threads(),
                      command.run > 0 || command.plan || command.collect)),
        log_(loudness_of(command)) {}

  int run();

private:
  int threads() const { return command_.threads > 0 ? command_.threads : hardware_threads(); }
  std::string command_text() const;
  std::string description() const;
  int tell_costs() const;
  void open();
  void open_anew();
  void require_same_study() const;
  int make_all();

  const CommandLine &command_;
  const Scene &scene_;
  StudyPlan plan_;
  Clock::time_point start_ = Clock::now();
  OutputPaths paths_;
  std::unique_ptr<FolderLock> lock_;
  std::vector<StudyRun> runs_;
  RunLog log_;
};

// As it was called, but for what is to be done.
std::string StudyApp::command_text() const {
  std::string text = fmt::format("platen-study {} {} -o {}", command_.kind, command_.scene, command_.output);
  for (const std::string &assignment : command_.overrides)
    text += fmt::format(" -s \"{}\"", assignment);
  return text;
}

std::string StudyApp::description() const {
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
    std::vector<std::string> command = runs_[k].command;
    command.emplace_back("--dry-run");
    Process process(command, Process::Output::ours);
    while (process.running())
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    if (process.status() == status_bad_input) throw InputError(runs_[k].name + ": " + process.errors());
    if (process.status() != status_done) throw std::runtime_error(runs_[k].name + ": " + process.errors());
  }
  return status_done;
}

void StudyApp::require_same_study() const {
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
  if (fs::is_directory(paths_.folder))
    lock_ = std::make_unique<FolderLock>(paths_.folder, patience_of_study, [&] {
      log_.info("waits for runs of an earlier study in {}", paths_.folder.string());
    });
  if (command_.resume)
    require_same_study();
  else
    open_anew();
  log_.open(paths_.log(), command_.resume, {version_text(), command_.text, threads()});
}

int StudyApp::run() {
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
  StudyResults results(scene_, plan_, runs_, paths_, log_);
  try {
    carry_out(runs_, threads(), log_,
              [&](std::size_t k, const RunOutcome &outcome) { results.keep(k, outcome); });
  } catch (const Stopped &stopped) {
    log_.info("stopped by a signal; go on with: {} --resume", command_text());
    return exit_status_of_signal(stopped.signal);
  }
  return results.finish({{"threads", threads()},
                         {"wall_seconds", seconds_since(start_)},
                         {"peak_memory_bytes", peak_memory_bytes()}});
}

} // namespace

int run_study(const CommandLine &command, const Scene &scene) {
  return StudyApp(command, scene).run();
}

} // namespace platen::apps
