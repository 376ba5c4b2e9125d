// What an app opens before its work and completes after it: output folder, log, scene.prm and summary.json.
#pragma once

#include <array>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/output/output_folder.h"
#include "apps/output/run_log.h"
#include "apps/output/summary.h"
#include "apps/run/changed_scene.h"
#include "apps/scene/command_line.h"
#include "base/clock.h"
#include "base/largest.h"
#include "base/parallel.h"
#include "dem/model.h"

namespace platen::apps {

// As loud as the command line wants it.
Loudness loudness_of(const CommandLine &command);
// That a run works with: those asked for, as far as there are cores, or all. Ranks on one machine share its
// cores.
int threads_of(const CommandLine &command);
// The scene's title, or its file's name.
std::string title_of(const Scene &scene);
// The scene, what it includes and all files that it names: what a run must not write over.
std::vector<std::filesystem::path> input_files(const Scene &scene);
// Of the files that the scene names, by entry: "Specimen/File" to the SHA-256 of what it holds now.
Json input_sums(const Scene &scene);

class AppOutput {
public:
  // Takes the time, the threads and, but for a dry run, the folder where it is there; nothing is written yet.
  // Throws FolderError where the run must not write there, or where one that goes on `from_checkpoint` has
  // none, and InputError where the folder of a resumed run was begun with another scene; one that goes on
  // from a checkpoint may be led on with some changes (require_same_physics).
  AppOutput(const CommandLine &command, const Scene &scene, bool from_checkpoint = false);

  // Opens the folder, and leaves scene.prm and the head of run.log with the threads that work. A resumed run
  // only goes on with its log.
  void open(int working_threads = loop_threads());
  // Of a resumed run, once its checkpoint is read: what has changed is said, and scene.prm is the scene now.
  void keep_changes();
  // Writes summary.json, with the SHA-256 of the scene as run and of the files that it names.
  void save(Json summary) const;
  // Checks what the scene expects, writes the summary with the verdicts, says `report`; returns the exit
  // status.
  int finish(Json summary, const std::string &report);
  // Tells each expectation of a summary's `expectations` that is not met, and those that another app would
  // have to check; returns the exit status, status_done or status_check_failed.
  int report_expectations(const Json &summary);

  // Of a run that writes no more: the folder is free for another one.
  void release() { lock_.reset(); }

  int threads() const { return loop_threads(); }
  double seconds() const; // since the start

  // Of the files that the scene names, as they were when the run began.
  const Json &inputs() const { return input_sums_; }

  const OutputPaths paths;
  RunLog log;

private:
  const CommandLine &command_;
  const Scene &scene_;
  std::vector<std::filesystem::path> inputs_;
  FolderUse use_;
  Clock::time_point start_ = Clock::now();
  ThreadLimit limit_;
  Json input_sums_ = Json::object();
  std::string scene_sum_;            // of scene.prm, once the folder is open
  std::vector<SceneChange> changes_; // of a run that is led on
  std::unique_ptr<FileLock> lock_;   // of the folder
};

// Figures that tests without platens share with those between platens, SI; NaN: not measured.
struct TestFigures {
  static constexpr double none = std::numeric_limits<double>::quiet_NaN();
  std::size_t particles = 0, bonds = 0;
  double packing_fraction = none;
  long steps = 0;
  double time_step = none; // s
  std::string time_step_reason;
  int threads = 1;
  double wall_seconds = 0, setup_seconds = none;
  std::array<double, dem::stage_count> stage_seconds{};
  double youngs_modulus = none, poisson_ratio = none; // Pa, 1
  long broken_tension = 0, broken_shear = 0;
  Largest energy_residual; // over the energy

  // What a model has stepped through and broken, and where its seconds went.
  void add(const dem::Model &model, long steps_made);
};

// The keys that every summary begins with.
Json summary_head(const Scene &scene, const std::string &app, const std::string &status,
                  const std::vector<std::string> &effects);
// Under the keys and in the order of a test between platens; what only platens measure is null.
void add_figures(Json &summary, const TestFigures &figures);

} // namespace platen::apps
