// What a checkpoint of a run holds: everything that decides the next step and the next row.
#pragma once

#include "apps/output/checkpoint.h"
#include "apps/output/run_log.h"
#include "apps/run/file_marks.h"
#include "apps/run/results.h"
#include "coupling/platen_test.h"

namespace platen::apps {

// Of its specimen in a state.
constexpr const char *specimen_part = "test/specimen/";

void save_state(StateSink &to, const coupling::PlatenTest &problem, const Results &results,
                const FileMarks &marks);
// What to go on with: the instruction set that the run began with, for forces of bonds depend on it in their
// last bits; where this machine lacks it, its own best, and a warning.
dem::InstructionSet resumed_instruction_set(const CheckpointReader &from, RunLog &log);
// Of the files alone, before a problem is made. Throws CheckpointError.
FileMarks load_marks(const CheckpointReader &from);
// Into a problem made from the same scene. Throws CheckpointError.
FileMarks load_state(const CheckpointReader &from, coupling::PlatenTest &problem, Results &results);

} // namespace platen::apps
