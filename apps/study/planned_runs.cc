#include "apps/study/planned_runs.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>
#include <set>

#include "apps/output/file.h"
#include "apps/output/machine.h"
#include "apps/output/sha256.h"
#include "apps/output/stop_signal.h"
#include "apps/run/app_output.h"
#include "apps/scene/version.h"
#include "apps/study/plan_file.h"
#include "apps/study/study_results.h"

namespace platen::apps {
namespace {

namespace fs = std::filesystem;

// Runs of a plan and the process that collects them work at the same time: run K holds byte K of the file
// that lock_folder holds as a whole, collecting holds byte 0.
constexpr std::uint64_t byte_of_collecting = 0;

std::unique_ptr<FileLock> lock_byte(const StudySetup &study, std::uint64_t byte, const std::string &what,
                                    RunLog &log) {
  std::unique_ptr<FileLock> lock =
      FileLock::take(study.paths.log(), {byte, 1}, patience_of_run, [&] { log.info("waits: {}", what); });
  if (lock == nullptr)
    throw FolderError(fmt::format("{}: error: {}, or the whole study is; wait for it, or stop it",
                                  study.paths.folder.string(), what));
  return lock;
}

// What --run says of a run that has begun and is not done: NAME.run.json beside its folder.
Json record_of(const StudySetup &study, const TestRun &run) {
  const ReadSummary read = read_summary(study.paths.run_record(run.name));
  const bool ours = read.fault.empty() && text_in(read.summary, "version") == version_line() &&
                    text_in(read.summary, "scene_sha256") == sha256_of_file(study.paths.scene()).value_or("");
  return ours ? read.summary : Json::object();
}

void write_record(const StudySetup &study, const TestRun &run, const std::string &status,
                  const RunOutcome &outcome = {}) {
  Json record{{"name", run.name}, {"status", status}, {"version", version_line()}};
  record["scene_sha256"] = sha256_of_file(study.paths.scene()).value_or("");
  if (status == "failed") record["exit_status"] = outcome.status, record["reason"] = outcome.reason;
  write_summary(study.paths.run_record(run.name), record);
}

const TestRun &run_of_number(const StudySetup &study, int number) {
  if (static_cast<std::size_t>(number) > study.runs.size())
    throw InputError(fmt::format("command line: error: --run = {} is not in the plan. Allowed: 1 ... {}.",
                                 number, study.runs.size()));
  return study.runs[static_cast<std::size_t>(number) - 1];
}

// "3, 5-9", as an array job takes them.
std::string ranges_of(const std::vector<std::size_t> &numbers) {
  std::string text;
  for (std::size_t k = 0; k < numbers.size();) {
    std::size_t last = k;
    while (last + 1 < numbers.size() && numbers[last + 1] == numbers[last] + 1)
      ++last;
    text += fmt::format("{}{}", text.empty() ? "" : ",", numbers[k]);
    if (last > k) text += fmt::format("-{}", numbers[last]);
    k = last + 1;
  }
  return text;
}

// What is there of a run that nobody has carried out here.
RunOutcome found(const StudySetup &study, std::size_t k) {
  const TestRun &run = study.runs[k];
  const auto missing = [](const std::string &why) { return RunOutcome{false, false, why, {}, 0, true}; };
  if (FileLock::is_taken(study.paths.log(), k + 1)) return missing("at work");
  Left left = left_by(run);
  if (left.summary) return RunOutcome{true, true, "", std::move(*left.summary), 0, false};
  if (!left.fault.empty()) return missing(left.fault);
  const Json record = record_of(study, run);
  if (text_in(record, "status") == "failed")
    return RunOutcome{false, false, text_in(record, "reason"), {}, record.value("exit_status", 0), false};
  if (!left.status.empty())
    return missing(left.status == "failed" ? "failed, but not in this plan" : left.status);
  return missing(record.empty() ? "not begun" : "killed");
}

// A node with other instructions rounds otherwise; see docs/clusters.md.
void tell_instruction_sets(const std::set<std::string> &sets, RunLog &log) {
  if (sets.size() > 1)
    log.warning(
        "runs were made with the instruction sets {}: on one machine they would differ by round-off; "
        "Integration/Instruction set makes them the same",
        fmt::join(sets, ", "));
}

} // namespace

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

int plan_runs(const StudySetup &study, RunLog &log) {
  const OutputPaths &paths = study.paths;
  if (!study.command.overwrite && has_plan(study, log)) {
    log.info("the plan of {} runs is there already, {}", study.runs.size(), paths.plan().string());
    return status_done;
  }
  std::error_code none;
  const bool repairs = !study.command.overwrite && fs::exists(paths.plan_json(), none);
  const FolderUse use = study.command.overwrite ? FolderUse::overwrite : FolderUse::fresh;
  if (!repairs) check_output_folder(paths.folder, use, input_files(study.scene));
  create_folder(paths.folder);
  const std::unique_ptr<FileLock> lock = lock_folder(paths.folder, patience_of_run, log);
  if (!repairs) {
    clear_runs(paths, study.command.overwrite, input_files(study.scene));
    open_output_folder(paths.folder, use, input_files(study.scene));
  }
  write_plan(study);
  log.info(
      "{} runs are planned in {}; make each with\n  {} --run K\nand, when all are done, the tables with\n  "
      "{} --collect",
      study.runs.size(), paths.plan().string(), study.again, study.again);
  return status_done;
}

int make_planned_run(const StudySetup &study, RunLog &log) {
  require_plan(study);
  TestRun run = run_of_number(study, study.command.run);
  const std::unique_ptr<FileLock> lock =
      lock_byte(study, static_cast<std::uint64_t>(study.command.run),
                fmt::format("run {} of the plan, {}, is at work already", study.command.run, run.name), log);
  catch_stop_signals();
  run.may_go_on = !record_of(study, run).empty();
  const fs::path record = study.paths.run_record(run.name);
  if (!left_by(run).summary) write_record(study, run, "begun");
  RunOutcome outcome;
  try {
    carry_out({run}, 1, log, [&](std::size_t, const RunOutcome &of) { outcome = of; });
  } catch (const Stopped &stopped) {
    log.info("stopped by a signal; go on with: {} --run {}", study.again, study.command.run);
    return exit_status_of_signal(stopped.signal);
  }
  const std::string head = fmt::format("  {} of {}  {}", study.command.run, study.runs.size(), run.name);
  if (!outcome.done) {
    write_record(study, run, "failed", outcome);
    log.error("{}: failed, {}", head, outcome.reason);
    return outcome.status < 0 ? exit_status_of_signal(-outcome.status) : outcome.status;
  }
  std::error_code ignored;
  fs::remove(record, ignored);
  return tell_outcome(study, head, run, outcome, log) ? status_done : status_check_failed;
}

int collect_runs(const StudySetup &study, RunLog &log) {
  require_plan(study);
  const std::unique_ptr<FileLock> lock =
      lock_byte(study, byte_of_collecting, "its runs are being collected", log);
  log.open(study.paths.log(), true, {version_text(), study.command.text, 1});
  StudyResults results(study, log);
  std::vector<std::size_t> missing;
  std::set<std::string> instruction_sets;
  for (std::size_t k = 0; k < study.runs.size(); ++k) {
    const RunOutcome outcome = found(study, k);
    const TestRun &run = study.runs[k];
    tell_outcome(study, fmt::format("  {} of {}  {}", k + 1, study.runs.size(), run.name), run, outcome, log);
    results.keep(run, outcome);
    if (outcome.missing) missing.push_back(k + 1);
    if (const std::string set = text_in(outcome.summary, "instruction_set"); !set.empty())
      instruction_sets.insert(set);
  }
  tell_instruction_sets(instruction_sets, log);
  // Seconds and threads are those of many processes: costs.csv has them.
  const int status = results.finish(
      {{"threads", nullptr}, {"wall_seconds", nullptr}, {"peak_memory_bytes", peak_memory_bytes()}});
  if (!missing.empty())
    log.error("{} of {} runs are missing: {}. Make them with: {} --run K", missing.size(), study.runs.size(),
              ranges_of(missing), study.again);
  return status;
}

} // namespace platen::apps
