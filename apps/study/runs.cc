#include "apps/study/runs.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <list>
#include <optional>
#include <system_error>
#include <thread>

#include "apps/io/stop_signal.h"
#include "apps/scene/errors.h"

namespace platen::apps {
namespace {

namespace fs = std::filesystem;

// How often running programs are checked.
constexpr std::chrono::milliseconds glance{20};

// The summary of a whole run, nothing where it is missing, damaged or of a run that did not end.
std::optional<Json> summary_of_done(const fs::path &folder) {
  std::ifstream file(OutputPaths(folder).summary(), std::ios::binary);
  Json summary = Json::parse(file, nullptr, false);
  if (!summary.is_object() || summary.value("status", "") != "done") return std::nullopt;
  return summary;
}

bool has_checkpoint(const fs::path &folder) {
  std::error_code ignored;
  return !fs::is_empty(OutputPaths(folder).checkpoints(), ignored) && !ignored;
}

bool is_there(const fs::path &path) {
  std::error_code ignored;
  return fs::exists(path, ignored);
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
  Processes(const std::vector<StudyRun> &runs, std::size_t at_a_time, RunLog &log)
      : runs_(runs), at_a_time_(at_a_time), log_(log), outcomes_(runs.size()) {}

  void work(const std::function<void(std::size_t, const RunOutcome &)> &keep);

private:
  void pass_on_signal();
  void start_more();
  void start(std::size_t k, bool may_resume);
  void check();
  void ended(Active &one);

  const std::vector<StudyRun> &runs_;
  std::size_t at_a_time_;
  RunLog &log_;
  std::vector<std::optional<RunOutcome>> outcomes_;
  std::list<Active> active_;
  std::size_t next_ = 0;
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
  const StudyRun &run = runs_[k];
  const bool resumes = may_resume && has_checkpoint(run.folder);
  std::vector<std::string> command = run.command;
  if (resumes)
    command.emplace_back("--resume");
  else if (is_there(run.folder))
    command.emplace_back("--overwrite");
  log_.detail("{}: {}", run.name, resumes ? "goes on from its checkpoint" : "starts");
  active_.push_back({k, Process(command), resumes});
}

void Processes::start_more() {
  while (signal_ == 0 && next_ < runs_.size() && active_.size() < at_a_time_) {
    const std::size_t k = next_++;
    if (std::optional<Json> summary = summary_of_done(runs_[k].folder))
      outcomes_[k] = RunOutcome{true, true, "", std::move(*summary)};
    else
      start(k, true);
  }
}

void Processes::ended(Active &one) {
  const StudyRun &run = runs_[one.run];
  const int status = one.process.status();
  if (std::optional<Json> summary = summary_of_done(run.folder)) {
    outcomes_[one.run] = RunOutcome{true, false, "", std::move(*summary)};
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
    outcomes_[one.run] = RunOutcome{false, false, how + (errors.empty() ? "" : ": " + errors), {}};
  }
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

fs::path compress_program() {
  std::error_code failure;
  const fs::path here = fs::read_symlink("/proc/self/exe", failure);
  const fs::path program = here.parent_path() / "platen-compress";
  if (failure || ::access(program.c_str(), X_OK) != 0)
    throw InputError("error: platen-compress is not beside platen-study (looked for " + program.string() +
                     "). Allowed: both programs in one folder.");
  return program;
}

std::vector<StudyRun> runs_of(const StudyPlan &plan, const std::string &scene,
                              const std::vector<std::string> &overrides, const OutputPaths &paths,
                              int threads) {
  const std::string program = compress_program().string();
  const int count = static_cast<int>(plan.cases.size() * plan.seeds.size());
  const std::string share = std::to_string(std::max(1, threads / count));
  std::vector<StudyRun> runs;
  for (std::size_t k = 0; k < plan.cases.size(); ++k)
    for (const unsigned long seed : plan.seeds) {
      StudyRun run;
      run.of = k;
      run.seed = seed;
      run.name = plan.cases[k].name + "_seed_" + std::to_string(seed);
      run.folder = paths.runs() / run.name;
      run.command = {program, scene, "-o", run.folder.string(), "-t", share, "--quiet"};
      for (const std::string &entry : overrides_of(plan.cases[k], seed, overrides))
        run.command.insert(run.command.end(), {"-s", entry});
      runs.push_back(std::move(run));
    }
  return runs;
}

void carry_out(const std::vector<StudyRun> &runs, int at_a_time, RunLog &log,
               const std::function<void(std::size_t, const RunOutcome &)> &keep) {
  Processes(runs, static_cast<std::size_t>(at_a_time), log).work(keep);
}

} // namespace platen::apps
