// What a checkpoint knows of the files that a run has written or was made from, so that a resumed run
// continues with the same ones.
#pragma once

#include <cstdint>
#include <limits>
#include <string>

#include "apps/output/output_folder.h"
#include "apps/output/summary.h"
#include "apps/scene/scene.h"
#include "base/archive.h"

namespace platen::apps {

struct FileMarks {
  std::uint64_t cracks_bytes = 0, history_bytes = 0; // lengths of the tables
  std::string specimen_sum; // SHA-256 of specimen.csv; "" in checkpoints of older versions
  std::string input_sums;   // of the files that the scene names, as text of JSON (input_sums)
  double last_frame = -1;   // s
  std::int64_t frames = 0;
  double wall_seconds = 0; // of all runs so far
  // The target strain of the test: with another one now, what had finished continues.
  static constexpr double unknown_target = std::numeric_limits<double>::quiet_NaN();
  double target_strain = unknown_target;
  // What a script changed during the run, as text of JSON; "": nothing. The programs do not resume such a
  // run, because they know the scene alone.
  std::string changes;
  void describe(Archive &archive);
};

// Throws CheckpointError, with what to do, if specimen.csv is not the one of the checkpoint.
void require_same_specimen(const FileMarks &marks, const OutputPaths &paths);
// Throws InputError if a file that the scene names has changed since the run began.
void require_same_inputs(const FileMarks &marks, const Scene &scene, const Json &now);

} // namespace platen::apps
