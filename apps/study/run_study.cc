#include "apps/study/run_study.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <functional>
#include <iterator>
#include <memory>
#include <thread>

#include "apps/output/file.h"
#include "apps/output/machine.h"
#include "apps/output/progress.h"
#include "apps/output/stop_signal.h"
#include "apps/run/app_output.h"
#include "apps/scene/regular_file.h"
#include "apps/scene/version.h"
#include "apps/study/planned_runs.h"
#include "apps/study/study_results.h"
#include "apps/study/target_study.h"
#include "base/clock.h"

namespace platen::apps {
namespace {

namespace fs = std::filesystem;

// Runs that are asked to end finish their step and write a checkpoint, at most some hundred megabytes.
constexpr std::chrono::seconds patience_of_study{60};

bool of_target(const StudySetup &study) {
  return study.plan.kind == StudyKind::target;
}

std::size_t at_a_time(const StudySetup &study) {
  return std::min(study.runs.size(), static_cast<std::size_t>(study.threads));
}

std::string description(const StudySetup &study) {
  const StudyPlan &plan = study.plan;
  const std::string title = title_of(study.scene);
  if (of_target(study))
    return fmt::format("{}\n  study of target, {} runs at a time\n", title, study.threads);
  std::string text = fmt::format("{}\n  study of {}: {} cases on seeds {} to {}, {} runs, {} at a time\n",
                                 title, word(plan.kind), plan.cases.size(), plan.seeds.front(),
                                 plan.seeds.back(), study.runs.size(), at_a_time(study));
  for (const StudyCase &one : plan.cases)
    text += fmt::format("  {}:{}{}\n", one.name, one.overrides.empty() ? "" : " ",
                        fmt::join(one.overrides, ", "));
  return text;
}

// --dry-run: what platen-compress says of the first run of each case.
int tell_costs(const StudySetup &study) {
  for (std::size_t k = 0; k < study.runs.size(); k += study.plan.seeds.size()) {
    const TestRun &run = study.runs[k];
    fmt::print("\n{}\n", run.name);
    std::fflush(stdout);
    Process process = start(run, {"--dry-run"}, Process::Output::ours);
    while (process.running())
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    if (process.status() == status_bad_input) throw InputError(run.name + ": " + process.errors());
    if (process.status() != status_done) throw std::runtime_error(run.name + ": " + process.errors());
  }
  double all = 0;
  std::size_t counted = 0; // others end by what they come to
  for (const TestRun &run : study.runs)
    all += run.seconds, counted += run.seconds > 0 ? 1 : 0;
  const auto together = static_cast<double>(at_a_time(study));
  fmt::print("\nall {} runs: {}\n", study.runs.size(),
             counted == 0 ? "time not counted: stages, stresses or files decide it"
                          : fmt::format("{}{} of one core, {} with {:.0f} at a time, to their target strains "
                                        "(counted from the scenes)",
                                        counted < study.runs.size() ? "more than " : "", duration_text(all),
                                        duration_text(all / together), together));
  return status_done;
}

void require_same_study(const StudySetup &study) {
  require_same_scene(study.scene, study.paths, of_target(study) ? may_change_on_resume : nullptr);
  const fs::path path = study.paths.study_json();
  std::ifstream file = open_file(path);
  const Json before = Json::parse(std::istreambuf_iterator<char>(file), {}, nullptr, false);
  const std::string kind = before.is_object() ? text_in(before, "kind") : "";
  if (kind != word(study.plan.kind))
    throw InputError(path.string() +
                     ": error: " + (kind.empty() ? "is not of a study" : "is of a study of " + kind) +
                     "; resume with the KIND as it was, or leave out --resume");
}

// The lock of the folder, which holds what a study begins with, or goes on with.
std::unique_ptr<FileLock> open(const StudySetup &study, RunLog &log) {
  const OutputPaths &paths = study.paths;
  const CommandLine &command = study.command;
  std::unique_ptr<FileLock> lock;
  std::error_code none;
  if (fs::exists(paths.log(), none)) lock = lock_folder(paths.folder, patience_of_study, log);
  if (command.resume) {
    require_same_study(study);
    if (of_target(study)) write_text_aside(paths.scene(), scene_text(study.scene, paths.folder));
  } else {
    const std::vector<fs::path> inputs = input_files(study.scene);
    const FolderUse use = command.overwrite ? FolderUse::overwrite : FolderUse::fresh;
    check_output_folder(paths.folder, use, inputs);
    clear_runs(paths, command.overwrite, inputs);
    open_locked(lock, paths.folder, use, inputs, log);
    create_folder(paths.runs());
    write_text_aside(paths.scene(), scene_text(study.scene, paths.folder));
    write_summary(paths.study_json(), Json{{"kind", word(study.plan.kind)}, {"status", "running"}});
  }
  log.open(paths.log(), command.resume, {version_text(), command.text, study.threads});
  return lock;
}

int make_runs(const StudySetup &study, RunLog &log, const std::function<Json()> &costs) {
  StudyResults results(study, log);
  carry_out(
      study.runs, study.threads, log,
      [&](std::size_t k, const RunOutcome &outcome) { results.keep(study.runs[k], outcome); },
      [&](std::size_t k, const RunOutcome &outcome, std::size_t ended) {
        const TestRun &run = study.runs[k];
        const std::string head = fmt::format("  {} of {}  {}", ended, study.runs.size(), run.name);
        tell_outcome(study, head, run, outcome, log);
      });
  return results.finish(costs());
}

int make_all(const StudySetup &study, RunLog &log, const Clock::time_point &start) {
  catch_stop_signals();
  const std::unique_ptr<FileLock> lock = open(study, log);
  log.info("{}", description(study));
  const auto costs = [&] {
    return Json{{"threads", study.threads},
                {"wall_seconds", seconds_since(start)},
                {"peak_memory_bytes", peak_memory_bytes()}};
  };
  try {
    return of_target(study) ? make_target(study, log, costs) : make_runs(study, log, costs);
  } catch (const Stopped &stopped) {
    log.info("stopped by a signal; go on with: {} --resume", study.again);
    return exit_status_of_signal(stopped.signal);
  }
}

} // namespace

int run_study(const CommandLine &command, const Scene &scene) {
  const Clock::time_point start = Clock::now();
  const StudySetup study(command, scene);
  RunLog log(loudness_of(command));
  if (of_target(study)) refuse_planned(command);
  if (command.dry_run) {
    fmt::print("{}", description(study));
    return of_target(study) ? tell_target_plan(study) : tell_costs(study);
  }
  if (command.plan) return plan_runs(study, log);
  if (command.run > 0) return make_planned_run(study, log);
  if (command.collect) return collect_runs(study, log);
  return make_all(study, log, start);
}

} // namespace platen::apps
