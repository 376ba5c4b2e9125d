// What a checkpoint of a run holds: everything that decides the next step and the next row.
#pragma once

#include <cstdint>

#include "apps/io/checkpoint.h"
#include "apps/io/run_log.h"
#include "apps/run/fields.h"
#include "apps/run/results.h"
#include "coupling/platen_test.h"

namespace platen::apps {

// Where the files of a run stood.
struct FileMarks {
  std::uint64_t cracks_bytes = 0; // history.csv follows from the samples
  double last_frame = -1;         // s
  std::int64_t frames = 0;
  double wall_seconds = 0; // of all runs so far
  void describe(Archive &archive);
};

void save_state(CheckpointWriter &to, const coupling::PlatenTest &problem, const Results &results,
                const FileMarks &marks);
// What to go on with: the instruction set that the run began with, for forces of bonds depend on it in their
// last bits; where this machine lacks it, its own best, and a warning.
dem::InstructionSet resumed_instruction_set(const CheckpointReader &from, RunLog &log);
// Into a problem made from the same scene. Throws CheckpointError.
FileMarks load_state(const CheckpointReader &from, coupling::PlatenTest &problem, Results &results);

} // namespace platen::apps
