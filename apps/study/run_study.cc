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
#include "apps/io/sha256.h"
#include "apps/io/stop_signal.h"
#include "apps/io/summary.h"
#include "apps/run/app_output.h"
#include "apps/run/problem_setup.h"
#include "apps/scene/expect.h"
#include "apps/scene/values.h"
#include "apps/scene/version.h"
#include "apps/study/accuracy.h"
#include "apps/study/cases.h"
#include "apps/study/process.h"
#include "apps/study/runs.h"
#include "apps/study/tables.h"
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
        runs_(runs_of(plan_, command.scene, command.overrides, paths_, threads())),
        log_(loudness_of(command)) {}

  int run();

private:
  int threads() const { return command_.threads > 0 ? command_.threads : hardware_threads(); }
  std::string description() const;
  int tell_costs() const;
  void open();
  void open_anew();
  void require_same_study() const;
  void keep(StudyTables &tables, std::size_t k, const RunOutcome &outcome);
  // What the kind of study alone leaves: added to study.json, told.
  std::string compare(const StudyTables &tables, Json &study) const;
  int finish(const StudyTables &tables);

  const CommandLine &command_;
  const Scene &scene_;
  StudyPlan plan_;
  Clock::time_point start_ = Clock::now();
  OutputPaths paths_;
  std::unique_ptr<FolderLock> lock_;
  std::vector<StudyRun> runs_;
  RunLog log_;
  Accuracy accuracy_{plan_};
  std::vector<std::string> missed_; // of what the scene expects of each run
};

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
  std::error_code none;
  for (const auto &entry : fs::directory_iterator(paths_.runs(), none)) {
    if (!entry.is_directory()) continue;
    if (!command_.overwrite)
      throw FolderError(
          fmt::format("output folder {}: holds runs of an earlier study ({}); choose another "
                      "folder with --output, or replace them with --overwrite",
                      paths_.folder.string(), entry.path().filename().string()));
    open_output_folder(entry.path(), FolderUse::overwrite, inputs);
    fs::remove(entry.path(), none); // only where nothing of the user's is left in it
  }
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

void StudyApp::keep(StudyTables &tables, std::size_t k, const RunOutcome &outcome) {
  const StudyRun &run = runs_[k];
  tables.add(run, outcome);
  accuracy_.add(run, outcome);
  const std::string head = fmt::format("  {} of {}  {}", k + 1, runs_.size(), run.name);
  if (!outcome.done) {
    log_.warning("{}: failed, {}", head, outcome.reason);
    return;
  }
  log_.info("{}: {:.4g} MPa, {:.0f} s{}", head, 1e-6 * number_in(outcome.summary, "strength_pa"),
            number_in(outcome.summary, "wall_seconds"), outcome.kept ? ", kept" : "");
  const bool compared = of_platens(plan_.kind) || plan_.kind == StudyKind::accuracy;
  if (compared && !StudyTables::peaked(outcome.summary))
    log_.warning("{}: it reached no peak up to Loading/Target strain: it has no strength to compare",
                 run.name);
  for (const std::string &line : check_expectations(scene_, outcome.summary).failed) {
    missed_.push_back(run.name + ": " + line);
    log_.error("expected: {}", missed_.back());
  }
}

std::string StudyApp::compare(const StudyTables &tables, Json &study) const {
  if (of_platens(plan_.kind)) {
    const std::vector<Comparison> comparisons = tables.comparisons();
    study["comparisons"] = json_of(plan_, comparisons);
    study["laboratory"] = laboratory_figures();
    return text_of(plan_, comparisons);
  }
  if (plan_.kind != StudyKind::accuracy) return "";
  accuracy_.write_rows(paths_.accuracy());
  const std::vector<ParameterErrors> errors = accuracy_.errors();
  study["accuracy"] = json_of(plan_, errors);
  study["costs"] = costs_of(plan_, errors);
  return text_of(plan_, errors);
}

int StudyApp::finish(const StudyTables &tables) {
  const bool any = tables.failed() < static_cast<int>(runs_.size());
  Json study;
  study["kind"] = word(plan_.kind);
  study["status"] = any ? "done" : "failed";
  study["varied"] = plan_.varied;
  study["seeds"] = plan_.seeds;
  study["runs"] = runs_.size();
  study["failed_runs"] = tables.failed();
  study["cases"] = tables.cases();
  const std::string compared = compare(tables, study);
  write_summary(paths_.study_json(), study);
  Json s = summary_head(scene_, "platen-study", study["status"], effects_on(scene_, AppKind::study));
  s.update(study);
  s["missed"] = missed_;
  s["threads"] = threads();
  s["wall_seconds"] = seconds_since(start_);
  s["peak_memory_bytes"] = peak_memory_bytes();
  s["scene_sha256"] = sha256_of_file(paths_.scene()).value_or("");
  s["inputs_sha256"] = input_sums(scene_);
  write_summary(paths_.summary(), s);
  log_.info("{}{}", tables.text(), compared);
  if (tables.failed() > 0) log_.warning("{} of {} runs failed", tables.failed(), runs_.size());
  log_.info("results are in {}", paths_.folder.string());
  if (!any) {
    log_.error("no run came to its end");
    return status_numerics;
  }
  return missed_.empty() ? status_done : status_check_failed;
}

int StudyApp::run() {
  if (command_.dry_run) return tell_costs();
  catch_stop_signals();
  open();
  log_.info("{}", description());
  StudyTables tables(plan_, paths_);
  try {
    carry_out(runs_, threads(), log_,
              [&](std::size_t k, const RunOutcome &outcome) { keep(tables, k, outcome); });
  } catch (const Stopped &stopped) {
    log_.info("stopped by a signal; go on with: platen-study {} {} -o {} --resume", command_.kind,
              command_.scene, command_.output);
    return exit_status_of_signal(stopped.signal);
  }
  return finish(tables);
}

} // namespace

int run_study(const CommandLine &command, const Scene &scene) {
  return StudyApp(command, scene).run();
}

} // namespace platen::apps
