#include "python/module/experiment.h"

#include <signal.h>

#include <array>
#include <cstddef>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <utility>

#include "apps/programs.h"
#include "apps/scene/errors.h"

namespace platen::python {
namespace {

// A run catches signals to leave a checkpoint; in a script they are Python's, who asks for Ctrl-C itself.
class KeptSignals {
public:
  KeptSignals() {
    for (std::size_t k = 0; k < numbers.size(); ++k)
      ::sigaction(numbers[k], nullptr, &former_[k]);
  }
  ~KeptSignals() {
    for (std::size_t k = 0; k < numbers.size(); ++k)
      ::sigaction(numbers[k], &former_[k], nullptr);
  }
  KeptSignals(const KeptSignals &) = delete;
  KeptSignals &operator=(const KeptSignals &) = delete;

private:
  static constexpr std::array<int, 6> numbers{SIGINT, SIGTERM, SIGHUP, SIGUSR1, SIGXFSZ, SIGPIPE};
  std::array<struct sigaction, 6> former_{};
};

apps::CommandLine command_of(const Experiment::Options &options) {
  apps::CommandLine command;
  command.scene = options.scene;
  command.output_given = !options.output.empty();
  command.output =
      command.output_given
          ? options.output
          : (std::filesystem::path("results") / std::filesystem::path(options.scene).stem()).string();
  command.overrides = options.overrides;
  command.threads = options.threads;
  command.overwrite = options.overwrite;
  command.quiet = !options.verbose;
  command.text = "platen.Experiment(" + options.scene + ") in Python";
  return command;
}

} // namespace

Experiment::Experiment(const Options &options)
    : command_(command_of(options)),
      program_(apps::program(options.disc ? "brazilian" : "compress")),
      scene_(apps::read_scene(options.scene, options.overrides, program_)) {
  const KeptSignals kept;
  run_ = std::make_unique<apps::CompressionRun>(
      command_, scene_, options.disc ? apps::Pressed::across_axis : apps::Pressed::along_axis);
  run_->begin();
}

Experiment::~Experiment() = default;

void Experiment::require_between_passes(const char *call) const {
  if (passes_)
    throw apps::InputError(
        std::string(call) +
        " is called from on_sample, within a step that is not over: call it after advance()");
}

void Experiment::pass() {
  require_between_passes("advance() or run()");
  if (ended_ || failed_ || closed_) throw apps::InputError("the experiment has ended: make a new one");
  if (run_->finished()) return;
  passes_ = true;
  try {
    run_->pass();
  } catch (...) {
    passes_ = false;
    failed_ = true;
    run_->give_up();
    throw;
  }
  passes_ = false;
}

bool Experiment::end() {
  require_between_passes("end()");
  if (failed_ || closed_)
    throw apps::InputError("the experiment has failed or was closed: it has no results");
  if (ended_) return holds_;
  try {
    holds_ = run_->end() == apps::status_done;
  } catch (...) {
    failed_ = true;
    throw;
  }
  run_->release();
  ended_ = true;
  return holds_;
}

void Experiment::close() {
  require_between_passes("close()");
  closed_ = true;
  run_->release();
}

void Experiment::change(const std::vector<std::string> &assignments) {
  if (ended_ || failed_ || closed_)
    throw apps::InputError("the experiment has ended: nothing can be changed");
  std::vector<std::string> overrides = command_.overrides;
  overrides.insert(overrides.end(), assignments.begin(), assignments.end());
  apps::Scene now = apps::read_scene(command_.scene, overrides, program_);
  run_->change(now);
  command_.overrides = std::move(overrides);
  scene_ = std::move(now);
}

std::string Experiment::summary() const {
  return run_->summary(ended_ ? "done" : failed_ ? "failed" : "running").dump();
}

double Experiment::stress() const {
  const coupling::PlatenTest &test = run_->test();
  return test.platens_along(run_->results().axis()).stress(test);
}

double Experiment::strain() const {
  return run_->test().closure_strain(run_->results().axis());
}

} // namespace platen::python
