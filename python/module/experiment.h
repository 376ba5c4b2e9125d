// A test between platens as a script drives it: built from a scene, advanced in pieces, looked at, changed,
// ended.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "apps/run/compression_run.h"
#include "apps/scene/command_line.h"
#include "apps/scene/scene.h"

namespace platen::python {

class Experiment {
public:
  struct Options {
    std::string scene, output;          // of output "": results/<name of the scene>
    std::vector<std::string> overrides; // "Section/Key = value"
    int threads = 1;
    bool disc = false; // laid on its rim, as platen-brazilian does
    bool overwrite = false, verbose = false;
  };
  // Reads the scene, packs, builds and begins to write. Throws what the apps throw.
  explicit Experiment(const Options &options);
  ~Experiment();
  Experiment(const Experiment &) = delete;
  Experiment &operator=(const Experiment &) = delete;

  // Threads of a script take turns: whoever calls what is below holds this. A callback of listen() is called
  // by the thread that makes a pass, and may look and change().
  std::recursive_mutex &turn() const { return turn_; }

  // One pass: up to 16 steps, to the next that something is written after. Throws coupling::NumericsStopped,
  // after summary.json says so, and InputError of an experiment that has ended; as end() and close() do
  // within a callback, for the pass that it is called in is not over.
  void pass();
  bool finished() const { return run_->finished(); }
  bool ended() const { return ended_; }
  // Writes what comes last, once; whether all held that the scene expects.
  bool end();
  // Without end(): nothing more is written, and the folder is free.
  void close();
  // "Section/Key = value" each, from the next step on; see CompressionRun::change.
  void change(const std::vector<std::string> &assignments);
  // After each row of history.csv.
  void listen(std::function<void(const apps::Sample &)> listener) { run_->listen(std::move(listener)); }

  const coupling::PlatenTest &test() const { return run_->test(); }
  const apps::Results &results() const { return run_->results(); }
  const std::vector<apps::Sample> &samples() const { return run_->results().samples(); }
  std::string summary() const; // text of JSON, of the state now
  const std::string &folder() const { return command_.output; }
  double stress() const; // Pa, mean of both platens of the loaded axis, compression positive
  double strain() const; // of the platens

private:
  apps::CommandLine command_;
  const apps::Program &program_;
  apps::Scene scene_; // the run holds it by reference
  std::unique_ptr<apps::CompressionRun> run_;
  void require_between_passes(const char *call) const;
  mutable std::recursive_mutex turn_;
  bool passes_ = false; // now
  bool ended_ = false, failed_ = false, closed_ = false, holds_ = false;
};

} // namespace platen::python
