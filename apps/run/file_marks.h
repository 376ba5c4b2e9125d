// What a checkpoint knows of the files that a run has written or was made from, so that a resumed run can
// tell that they are still the same.
#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "apps/io/csv_writer.h"
#include "apps/io/output_folder.h"
#include "apps/io/run_log.h"
#include "apps/io/summary.h"
#include "apps/scene/scene.h"
#include "base/archive.h"

namespace platen::apps {

// Where the files of a run stood. Checkpoints of older versions know no sums: nothing is compared then.
struct FileMarks {
  std::uint64_t cracks_bytes = 0;
  std::uint64_t history_bytes = 0;
  std::string cracks_sum, history_sum; // SHA-256 of so many bytes
  std::string specimen_sum;            // of specimen.csv
  std::string input_sums;              // of the files that the scene names, as text of JSON (input_sums)
  double last_frame = -1;              // s
  std::int64_t frames = 0;
  double wall_seconds = 0; // of all runs so far
  // That the test was to reach: with another one now, what had finished goes on.
  static constexpr double unknown_target = std::numeric_limits<double>::quiet_NaN();
  double target_strain = unknown_target;
  // What was changed on the way by who drives the run, as text of JSON; "": nothing. Such a run is not
  // resumed by an app, which knows the scene alone.
  std::string changes;
  void describe(Archive &archive);
};

// Throws CheckpointError, naming the file and what to do, where a file is not what it was at the checkpoint;
// rows after it do not count. A history.csv that is gone is no loss, for the checkpoint has its rows: the log
// is told that it is written anew.
void require_same_files(const FileMarks &marks, const OutputPaths &paths, RunLog &log);
// Throws InputError where a file that the scene names has changed since the run began.
void require_same_inputs(const FileMarks &marks, const Scene &scene, const Json &now);

} // namespace platen::apps
