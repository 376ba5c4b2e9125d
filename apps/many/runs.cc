#include "apps/many/runs.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <list>
#include <numeric>
#include <optional>
#include <system_error>
#include <thread>

#include "apps/output/numbers.h"
#include "apps/output/sha256.h"
#include "apps/output/stop_signal.h"
#include "apps/programs.h"
#include "apps/run/app_output.h"
#include "apps/run/compression.h"
#include "apps/run/ranks.h"
#include "apps/scene/errors.h"
#include "apps/scene/version.h"

namespace platen::apps {
namespace {

namespace fs = std::filesystem;

// How often running programs are checked.
constexpr std::chrono::milliseconds glance{20};

// Why a summary as it was written is of another run than this one; "" where it is of this.
std::string other_run(const Json &summary, const TestRun &run) {
  if (run.of_this_version && text_in(summary, "version") != version_line())
    return fmt::format("it was made by {}, this is {}", text_in(summary, "version"), version_line());
  const OutputPaths paths(run.folder);
  if (text_in(summary, "scene_sha256") != sha256_of_file(paths.scene()).value_or("missing"))
    return "scene.prm is not the scene that summary.json was made with";
  const Scene scene = read_scene(run.scene, run.overrides, program(run.program));
  if (const std::vector<SceneChange> changes = changes_of_scene(scene, paths); !changes.empty())
    return fmt::format("it is of another scene: {} was \"{}\", now \"{}\"", changes[0].entry, changes[0].was,
                       changes[0].now);
  const Json now = input_sums(scene);
  if (summary.value("inputs_sha256", Json()) == now) return "";
  for (const auto &[entry, sum] : now.items())
    if (text_in(summary.value("inputs_sha256", Json::object()), entry) != sum)
      return fmt::format("the file that {} names has changed", entry);
  return "the files that the scene names have changed";
}

bool has_checkpoint(const fs::path &folder) {
  std::error_code ignored;
  return !fs::is_empty(OutputPaths(folder).checkpoints(), ignored) && !ignored;
}

bool is_there(const fs::path &path) {
  std::error_code ignored;
  return fs::exists(path, ignored);
}

// Without a copy of this process to run it, the program itself is started: it stands beside this one.
std::string program_beside(const std::string &name) {
  std::error_code failure;
  return (fs::read_symlink("/proc/self/exe", failure).parent_path() / name).string();
}

std::string without_line_end(std::string text) {
  while (!text.empty() && text.back() == '\n')
    text.pop_back();
  return text;
}

struct Active {
  std::size_t run;
  Process process;
  bool resumes;
};

class Processes {
public:
  Processes(const std::vector<TestRun> &runs, int at_a_time, RunLog &log, const RunTold &tell)
      : runs_(runs),
        order_(order_of_start(runs, at_a_time)),
        at_a_time_(static_cast<std::size_t>(at_a_time)),
        log_(log),
        tell_(tell),
        outcomes_(runs.size()) {}

  void work(const std::function<void(std::size_t, const RunOutcome &)> &keep);

private:
  void pass_on_signal();
  void start_more();
  void start(std::size_t k, bool may_resume);
  void check();
  void ended(Active &one);
  void come_to(std::size_t k, RunOutcome outcome);

  const std::vector<TestRun> &runs_;
  const std::vector<std::size_t> order_;
  std::size_t at_a_time_;
  RunLog &log_;
  const RunTold &tell_;
  std::vector<std::optional<RunOutcome>> outcomes_;
  std::list<Active> active_;
  std::size_t next_ = 0; // of order_
  std::size_t ended_ = 0;
  int signal_ = 0; // that was passed on
};

void Processes::pass_on_signal() {
  if (signal_ != 0) return;
  signal_ = stop_requested();
  if (signal_ == 0) return;
  for (const Active &one : active_)
    one.process.send(signal_);
}

void Processes::start(std::size_t k, bool may_resume) {
  const TestRun &run = runs_[k];
  const bool resumes = may_resume && has_checkpoint(run.folder);
  std::vector<std::string> further;
  if (resumes)
    further.emplace_back("--resume");
  else if (is_there(run.folder))
    further.emplace_back("--overwrite");
  log_.detail("{}: {}", run.name, resumes ? "goes on from its checkpoint" : "starts");
  active_.push_back({k, apps::start(run, further, Process::Output::dropped), resumes});
}

void Processes::start_more() {
  while (signal_ == 0 && next_ < runs_.size() && active_.size() < at_a_time_) {
    const std::size_t k = order_[next_++];
    Left left = left_by(runs_[k]);
    if (left.summary) {
      come_to(k, {true, true, "", std::move(*left.summary), 0, false});
      continue;
    }
    if (!left.fault.empty()) log_.warning("{}: is made again: {}", runs_[k].name, left.fault);
    start(k, left.of_this && runs_[k].may_go_on);
  }
}

void Processes::ended(Active &one) {
  const TestRun &run = runs_[one.run];
  const int status = one.process.status();
  Left left = left_by(run);
  if (left.summary) {
    come_to(one.run, {true, false, "", std::move(*left.summary), 0, false});
  } else if (signal_ != 0) {
    return; // stopped with us, to go on later
  } else if (one.resumes && status == status_bad_input) {
    log_.warning("{}: its checkpoint cannot be used, it starts anew: {}", run.name,
                 without_line_end(one.process.errors()));
    start(one.run, false);
  } else if (status == status_output) {
    const std::string told = "error: ", errors = without_line_end(one.process.errors());
    throw OutputError(run.name + ": " + (errors.rfind(told, 0) == 0 ? errors.substr(told.size()) : errors));
  } else {
    const std::string how = status < 0 ? fmt::format("ended by signal {}", -status)
                                       : fmt::format("exit status {}", status),
                      errors = without_line_end(one.process.errors());
    come_to(one.run, {false, false, how + (errors.empty() ? "" : ": " + errors), {}, status, false});
  }
}

void Processes::come_to(std::size_t k, RunOutcome outcome) {
  outcomes_[k] = std::move(outcome);
  ++ended_;
  if (tell_) tell_(k, *outcomes_[k], ended_);
}

void Processes::check() {
  for (auto one = active_.begin(); one != active_.end();) {
    if (one->process.running()) {
      ++one;
      continue;
    }
    ended(*one);
    one = active_.erase(one);
  }
}

void Processes::work(const std::function<void(std::size_t, const RunOutcome &)> &keep) {
  std::size_t kept = 0;
  while (true) {
    pass_on_signal();
    start_more();
    check();
    for (; kept < runs_.size() && outcomes_[kept]; ++kept)
      keep(kept, *outcomes_[kept]);
    if (kept == runs_.size()) return;
    if (active_.empty() && signal_ != 0) throw Stopped{signal_};
    if (active_.size() == at_a_time_ || next_ == runs_.size() || signal_ != 0)
      std::this_thread::sleep_for(glance);
  }
}

} // namespace

const char *word(const RunOutcome &outcome) {
  return outcome.done ? "done" : outcome.missing ? "missing" : "failed";
}

Left left_by(const TestRun &run) {
  std::error_code none;
  const fs::path file = OutputPaths(run.folder).summary();
  if (!fs::exists(fs::symlink_status(file, none))) return {};
  ReadSummary read = read_summary(file);
  if (!read.fault.empty()) return {std::nullopt, "summary.json " + read.fault};
  const std::string status = text_in(read.summary, "status");
  if (status != "done") return {std::nullopt, "", true, status}; // stopped or failed, as it says
  const std::string other = other_run(read.summary, run);
  if (!other.empty()) return {std::nullopt, other, false, status};
  return {std::move(read.summary), "", true, status};
}

void start_as(TestRun &run, int threads, const fs::path &packings) {
  run.command = {program_beside("platen-" + run.program),
                 run.scene,
                 "-o",
                 run.folder.string(),
                 "-t",
                 std::to_string(threads),
                 "--quiet"};
  for (const std::string &entry : run.overrides)
    run.command.insert(run.command.end(), {"-s", entry});
  if (!packings.empty()) run.command.insert(run.command.end(), {"--packings", packings.string()});
}

Process start(const TestRun &run, const std::vector<std::string> &further, Process::Output output) {
  std::vector<std::string> command = run.command;
  command.insert(command.end(), further.begin(), further.end());
  const Process::Body test = [&name = run.program](int argc, char **argv) {
    return run_app_on_ranks(argc, argv, program(name), name == "brazilian" ? run_brazilian : run_compression);
  };
  return Process(command, has_one_thread() ? test : nullptr, output);
}

void clear_runs(const OutputPaths &paths, bool overwrite, const std::vector<fs::path> &inputs) {
  std::error_code none;
  for (const auto &entry : fs::directory_iterator(paths.runs(), none)) {
    if (!entry.is_directory()) continue;
    if (!overwrite)
      throw FolderError(
          fmt::format("output folder {}: holds runs of an earlier study ({}); choose another "
                      "folder with --output, or replace them with --overwrite",
                      paths.folder.string(), entry.path().filename().string()));
    open_output_folder(entry.path(), FolderUse::overwrite, inputs);
    fs::remove(OutputPaths(entry.path()).log(), none);
    fs::remove(entry.path(), none); // only where nothing of the user's is left in it
  }
}

std::vector<std::size_t> order_of_start(const std::vector<TestRun> &runs, int at_a_time) {
  std::vector<std::size_t> order(runs.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  if (at_a_time < 2) return order;
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return runs[a].seconds > runs[b].seconds; });
  std::vector<char> packed(runs.size(), 0), first(runs.size(), 0);
  for (const std::size_t k : order)
    if (!packed[runs[k].specimen_of]) packed[runs[k].specimen_of] = first[k] = 1;
  std::stable_partition(order.begin(), order.end(), [&](std::size_t k) { return first[k] != 0; });
  return order;
}

void carry_out(const std::vector<TestRun> &runs, int at_a_time, RunLog &log,
               const std::function<void(std::size_t, const RunOutcome &)> &keep, const RunTold &tell) {
  Processes(runs, at_a_time, log, tell).work(keep);
}

} // namespace platen::apps
