// The folder that a run writes into: which names are the run's own, what happens if a folder is in use, and
// how one run at a time has it.
#pragma once

#include <chrono>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "apps/output/errors.h"
#include "apps/output/file_lock.h"

namespace platen::apps {

// Names of all that a run writes into its folder.
struct OutputPaths {
  explicit OutputPaths(std::filesystem::path output_folder) : folder(std::move(output_folder)) {}
  std::filesystem::path folder;
  std::filesystem::path scene() const { return folder / "scene.prm"; }
  std::filesystem::path history() const { return folder / "history.csv"; }
  std::filesystem::path cracks() const { return folder / "cracks.csv"; }
  std::filesystem::path cracks_vtu() const { return folder / "cracks.vtu"; }
  std::filesystem::path crack_state() const { return folder / "crack_state.csv"; }
  std::filesystem::path events() const { return folder / "events.csv"; }
  std::filesystem::path summary() const { return folder / "summary.json"; }
  std::filesystem::path log() const { return folder / "run.log"; } // and the file that is locked
  std::filesystem::path specimen_csv() const { return folder / "specimen.csv"; }
  std::filesystem::path specimen_vtu() const { return folder / "specimen.vtu"; }
  std::filesystem::path directions() const { return folder / "directions.csv"; }
  std::filesystem::path bond_stress() const { return folder / "bond_stress.csv"; }
  std::filesystem::path study() const { return folder / "study.csv"; }
  std::filesystem::path study_json() const { return folder / "study.json"; }
  std::filesystem::path costs() const { return folder / "costs.csv"; }
  std::filesystem::path comparisons() const { return folder / "comparisons.csv"; }
  std::filesystem::path envelope() const { return folder / "envelope.csv"; }
  std::filesystem::path accuracy() const { return folder / "accuracy.csv"; }
  std::filesystem::path runs() const { return folder / "runs"; } // of a study: an output folder for each
  std::filesystem::path plan() const { return folder / "plan.csv"; }
  std::filesystem::path plan_json() const { return folder / "plan.json"; }
  std::filesystem::path run_record(const std::string &name) const { return runs() / (name + ".run.json"); }
  std::filesystem::path packings() const { return folder / "packings"; } // that its runs share
  std::filesystem::path view() const { return folder / "view.py"; }      // for ParaView
  std::filesystem::path checkpoints() const { return folder / "checkpoint"; }
  // "frames/specimen_000012.vtu": relative to the folder, as a .pvd names it.
  static std::string frame_name(const std::string &series, int index);
};

// Whether a path relative to an output folder is one that the apps write there, or wrote as an earlier
// version (what a killed run left half written is included). All else is the user's and is never touched.
bool is_output_name(const std::filesystem::path &relative);

enum class FolderUse { fresh, overwrite, resume };

// Throws FolderError, and touches nothing, where a run must not write into `folder`:
//   fresh      it holds an earlier run (an empty run.log is none);
//   resume     it holds no checkpoint;
//   others     one of `inputs` (scene, specimen file) is a file that the run would replace;
//   any        it cannot be created or written.
void check_output_folder(const std::filesystem::path &folder, FolderUse use,
                         const std::vector<std::filesystem::path> &inputs = {});

// The same check, then creates folder and parents, and for overwrite removes what an earlier run wrote,
// nothing else. run.log is emptied, not removed: whoever holds the folder holds this file. Throws
// FolderError.
void open_output_folder(const std::filesystem::path &folder, FolderUse use,
                        const std::vector<std::filesystem::path> &inputs = {});

class RunLog;

// A run, a study or a calibration waits so long for the one before, which may need it for its last
// checkpoint.
constexpr std::chrono::seconds patience_of_run{5};

// Holds the folder, which exists, for one run: run.log is locked as a whole, and created if it is missing.
// The lock is inherited by the runs of a study and ends with the last of them, however they end: they may
// still write their last checkpoints when a study that was killed is resumed. Throws FolderError if another
// run holds it after `patience`. Null on a silent rank.
std::unique_ptr<FileLock> lock_folder(const std::filesystem::path &folder, std::chrono::milliseconds patience,
                                      RunLog &log);

// open_output_folder in a folder that `lock` holds from then on, if it does not yet.
void open_locked(std::unique_ptr<FileLock> &lock, const std::filesystem::path &folder, FolderUse use,
                 const std::vector<std::filesystem::path> &inputs, RunLog &log);

} // namespace platen::apps
