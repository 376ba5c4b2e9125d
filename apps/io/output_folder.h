// The folder that a run writes into: which names are the run's own, what happens where a folder is in use,
// and how one run at a time has it.
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "apps/io/errors.h"

namespace platen::apps {

// Names of all that a run writes into its folder.
struct OutputPaths {
  explicit OutputPaths(std::filesystem::path output_folder) : folder(std::move(output_folder)) {}
  std::filesystem::path folder;
  std::filesystem::path scene() const { return folder / "scene.prm"; }
  std::filesystem::path history() const { return folder / "history.csv"; }
  std::filesystem::path cracks() const { return folder / "cracks.csv"; }
  std::filesystem::path cracks_vtu() const { return folder / "cracks.vtu"; }
  std::filesystem::path events() const { return folder / "events.csv"; }
  std::filesystem::path summary() const { return folder / "summary.json"; }
  std::filesystem::path log() const { return folder / "run.log"; }
  std::filesystem::path specimen_csv() const { return folder / "specimen.csv"; }
  std::filesystem::path specimen_vtu() const { return folder / "specimen.vtu"; }
  std::filesystem::path directions() const { return folder / "directions.csv"; }
  std::filesystem::path bond_stress() const { return folder / "bond_stress.csv"; }
  std::filesystem::path study() const { return folder / "study.csv"; }
  std::filesystem::path study_json() const { return folder / "study.json"; }
  std::filesystem::path costs() const { return folder / "costs.csv"; }
  std::filesystem::path comparisons() const { return folder / "comparisons.csv"; }
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
  static std::string frame_of_pieces(const std::string &series, int index); // "frames/specimen_000012.pvtu"
};

// Whether a path relative to an output folder is one that the apps write there (OutputPaths, frames,
// checkpoints, and what a killed run left half written). All else is the user's and is never touched.
bool is_output_name(const std::filesystem::path &relative);

enum class FolderUse { fresh, overwrite, resume };

// Throws FolderError, and touches nothing, where a run must not write into `folder`:
//   fresh      it holds an earlier run;
//   resume     it holds no checkpoint;
//   others     one of `inputs` (scene, specimen file) is a file that the run would replace;
//   any        it cannot be created or written.
void check_output_folder(const std::filesystem::path &folder, FolderUse use,
                         const std::vector<std::filesystem::path> &inputs = {});

// The same check, then creates folder and parents, and for overwrite removes what an earlier run wrote,
// nothing else. Throws FolderError.
void open_output_folder(const std::filesystem::path &folder, FolderUse use,
                        const std::vector<std::filesystem::path> &inputs = {});

// Held by this process and by every program that it starts from then on, until all of them have ended: the
// runs of a study that was killed may still be writing their last checkpoints when it is taken up again. The
// end of a process, however it comes, gives the folder free; nothing is left behind in it.
class FolderLock {
public:
  enum class Hold { alone, shared }; // shared: with others that hold it so
  // Waits for who holds the folder, after telling so once, for `patience` at most. Throws FolderError then,
  // and where the folder cannot be opened. A file system without locks is not locked.
  FolderLock(const std::filesystem::path &folder, std::chrono::milliseconds patience,
             const std::function<void()> &tell_that_it_waits, Hold hold = Hold::alone);
  ~FolderLock();
  FolderLock(const FolderLock &) = delete;
  FolderLock &operator=(const FolderLock &) = delete;

private:
  int file_ = -1;
};

class RunLog;

// For a run or a calibration, which waits five seconds, as one that was asked to end may need for its last
// checkpoint; null where the folder is not there yet.
std::unique_ptr<FolderLock> lock_of_run(const std::filesystem::path &folder, RunLog &log);

// open_output_folder in a folder that `lock` holds from then on, where it does not yet.
void open_locked(std::unique_ptr<FolderLock> &lock, const std::filesystem::path &folder, FolderUse use,
                 const std::vector<std::filesystem::path> &inputs, RunLog &log);

} // namespace platen::apps
